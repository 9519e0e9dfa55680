#!/usr/bin/env python3
"""python.py RESULTS FOLDER: writes FOLDER/python.md from the lines of RESULTS/python.jsonl.

The text is here; every number comes from the lines of results.
"""
import pathlib
import sys

sys.dont_write_bytecode = True  # no folder of the sources gets files

from results import Results, quartiles, shown, span

WORKS = {
    "make": "making the index, seconds",
    "window of 1": "windows of about 1 answer, a second",
    "window of 10": "windows of about 10",
    "window of 1000": "windows of about 1,000",
    "window of 1, boxes only": "boxes only, about 1",
    "window of 10, boxes only": "boxes only, about 10",
    "window of 1000, boxes only": "boxes only, about 1,000",
    "nearest": "nearest segments, a second",
    "all pairs": "all pairs that meet, seconds",
}

TEXT = """\
<!-- Written by bench/page/python.py from the results of `bench/run python`. Change that program, not this page. -->

# froe from numpy beside GEOS

`bench/run python` writes this page. froe is called from Python with numpy arrays, as [Python](../howto/python.md)
shows. Two others answer the same questions in the same process, and all take turns:

- *GEOS*: the calls of GEOS that shapely 2 makes for arrays of questions, from C, without the share of Python. An STR
  tree of bounding boxes finds candidates; the prepared question is then tested with each.
- *shapely 1.8*: its STRtree and prepared geometries, a question at a time in a loop of Python. It takes part up to
  100,000 segments. Where shapely 2 is installed, its bulk calls take part instead.

The segments are short and lie anywhere (seed 1). The questions are other ones in each of the seven rounds; making the
index and all pairs have three to five. Times are processor times on one thread, from arrays of doubles to arrays of
answers. The answers to 20 questions of each kind are compared, and the number of all pairs. Of all pairs froe lists
each once; the calls of GEOS find each from both sides, and every segment with itself, and have no other way. *Boxes
only* is what STRtree answers without a predicate; froe then has a tree of the bounding boxes, by the method
`directional`, whose leaves hold one box, since only trees of segments and triangles are packed. Exact answers about the
segments themselves are several times as fast as both.
"""

GROWN = [
    ("scene of an array", "read-only", "a scene of an array that is read-only"),
    ("scene of an array", "writeable", "a scene of an array that is not"),
    ("tree", "froe", "the tree"),
]

MEMORY = """## Memory

By how much the process grows while froe takes {:,} segments from an array, which itself has 32 bytes for each.
An array that another thread might write into is copied for the call. One whose `flags.writeable` is false is used where
it lies.
"""


def table(head, rows):
    return "\n".join("| " + " | ".join(row) + " |" for row in [head, ["---"] * len(head), *rows])


def row(results, work, size, label, others):
    measure = "seconds" if work in ("make", "all pairs") else "per second"
    end = ", boxes only" if work.endswith("boxes only") else ""
    cells = [shown(results.median("python: " + work, "short", size, p + end, measure)) for p in ["froe"] + others]
    for other in others:
        ratios = results.ratios("python: " + work, "short", size, other + end, measure, "froe" + end)
        low, middle, high = quartiles(ratios)
        cells.append("%s (%s)" % (shown(middle), span([low, high])))
    return [label, *cells]


def memory(results):
    parts = []
    for size in results.select(2, "python: tree"):
        rows = []
        for work, program, label in GROWN:
            key = ("python: " + work, "short", size, program)
            rows.append([label, *(shown(results.median(*key, measure)) for measure in ("bytes", "bytes at most"))])
        parts += [MEMORY.format(10**size), table(["bytes a segment", "afterwards", "at most meanwhile"], rows)]
    return parts


def page(results):
    head = results.heads["python"]
    parts = [TEXT, table(["", ""], [
        ["commit, date", "%s, %s" % (head["commit"], head["date"])],
        ["processor", "%s, %d of them, %d GB" % (head["processor"], head["processors"], head["memory"])],
        ["system, compiler", "%s; %s" % (head["system"], head["compiler"])],
        ["GEOS", head["versions"].get("libgeos-dev", "unknown")],
        ["load before and after", "%.1f, %.1f" % tuple(head["load"])],
    ])]
    for size in results.select(2, "python: make"):
        programs = results.select(3, "python: make", size)
        others = [p for p in programs if p != "froe" and not p.endswith("boxes only")]
        parts.append("## {:,} segments".format(10 ** size))
        parts.append("The last columns tell how many times as fast froe is: medians of the rounds, and quartiles.")
        parts.append(table(["", "froe", *others, *("froe beside " + p for p in others)],
                           [row(results, work, size, label, others) for work, label in WORKS.items()]))
        boxes = [results.median("python: make", "short", size, p + ", boxes only", "seconds") for p in ("froe", "GEOS")]
        parts.append("Making the index of boxes only takes froe %s seconds, and GEOS %s." % tuple(map(shown, boxes)))
    parts += memory(results)
    return "\n\n".join(part.strip("\n") for part in parts) + "\n"


def main():
    results, folder = map(pathlib.Path, sys.argv[1:])
    (folder / "python.md").write_text(page(Results([results / "python.jsonl"])))
    print("python: %s/python.md" % folder)


if __name__ == "__main__":
    main()
