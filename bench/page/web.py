#!/usr/bin/env python3
"""web.py RESULTS FOLDER: writes FOLDER/web.md from the lines of RESULTS/web.jsonl.

The text is here; every number comes from the lines of results.
"""
import pathlib
import sys

sys.dont_write_bytecode = True  # no folder of the sources gets files

from results import Results, quartiles, shown, span

PLANE = {
    "make": "making the index, seconds",
    "window of 1": "exact windows of about 1 answer, a second",
    "window of 10": "exact windows of about 10",
    "window of 1000": "exact windows of about 1,000",
    "window of 1, boxes only": "boxes only, about 1",
    "window of 10, boxes only": "boxes only, about 10",
    "window of 1000, boxes only": "boxes only, about 1,000",
    "nearest": "nearest, a second",
}
SPACE = {"make": "making the index, seconds", "rays": "rays, a second", "closest": "nearest points, a second"}
DRAWINGS = {"first drawing": "first drawing, seconds", "another view": "another view, seconds"}
NAMES = {"utah-teapot": "the teapot", "fzk-haus": "the house"}

TEXT = """<!-- Written by bench/page/web.py from the results of `bench/run web`. Change that program, not this page. -->

# froe in JavaScript beside other packages

`make web && bench/run web` writes this page. The npm package is WebAssembly with vector instructions, as
[JavaScript](../howto/javascript.md) shows it. The others are written in JavaScript. All run in one process of Node, on
one thread, and take turns. Times are processor times. The last column of a table tells how many times as fast froe is:
medians of the rounds, and quartiles.
"""
OF_PLANE = """The segments are short and lie anywhere. The indexes of flatbush and rbush are of bounding boxes. For
exact answers, a function of the race tests each candidate in doubles. *Boxes only* leaves that test out, and froe then has
a tree of the bounding boxes. Nearest is the nearest segment for froe, and the nearest bounding box for flatbush; rbush
has no such question."""
OF_EXACT = """How right is that? Segments and windows of the next table have coordinates on a lattice of tenths, where much
touches. Wrong answers are those that froe does not give and those that are missing, in percent of the right ones."""
OF_SPACE = """The triangles have coordinates of 32 bits, as three-mesh-bvh keeps them. Half of the rays go to a corner or to
the middle of an edge. Wrong is what lies more than a thousandth of the model's size elsewhere than froe's exact
answer, and missing of it where the ray has passed what it meets first: between two triangles, or at a border."""
OF_DRAWINGS = """SVGRenderer of three.js paints triangles in the order of their distances, and removes nothing that is
hidden. Both draw faces without lines, on a page of 1000 by 1000. The first drawing begins with arrays, and another view
with what is there already. Samples lie on the model, at least one unit away from the border of a face. A sample is
wrong where the drawing shows another face than a ray meets. three-svg-renderer 1.0.4 removes hidden lines, but needs a
package that is not in the registry, and was not measured."""


def table(head, rows):
    return "\n".join("| " + " | ".join(row) + " |" for row in [head, ["---"] * len(head), *rows])


def cells(results, work, scene, size, label, others):
    """A row: what froe and the others have reached, and how many times as fast froe is."""
    measure = "seconds" if "second" in label.split(", ")[-1] and "a second" not in label else "per second"
    end = ", boxes only" if work.endswith("boxes only") else ""
    row = [shown(results.median("web: " + work, scene, size, "froe" + end, measure))]
    row += [shown(results.median("web: " + work, scene, size, other, measure)) for other in others]
    for other in others:
        ratios = results.ratios("web: " + work, scene, size, other, measure, "froe" + end)
        low, middle, high = quartiles(ratios) if ratios else (None, None, None)
        row.append("%s (%s)" % (shown(middle), span([low, high])) if ratios else "")
    return [label, *row]


def plane(results):
    others = ["flatbush", "rbush"]
    for size in results.select(2, "web: make", scene="short"):
        yield "### {:,} segments".format(10 ** size)
        yield table(["", "froe", *others, *("froe beside " + other for other in others)],
                    [cells(results, work, "short", size, label, others) for work, label in PLANE.items()])
    yield OF_EXACT
    wrong = {p: results.values[k][0] for k in results.values for p in [k[3]] if k[0] == "web: exactness"}
    yield table(["", "wrong, percent"], [[name, shown(value)] for name, value in sorted(wrong.items(), key=lambda item: item[1])])


def wrong(results, *key):
    """Percents: wrong, and of these missing."""
    return [shown(results.median(*key, "percent " + what)) for what in ("wrong", "missing")]


def space(results):
    other = "three-mesh-bvh"
    for scene in results.select(1, "web: rays"):
        size = results.select(2, "web: rays", scene=scene)[0]
        yield "### {}: {:,} triangles".format(NAMES[scene].capitalize(), results.objects["web: rays", scene, size])
        yield table(["", "froe", other, "froe beside " + other, "wrong, percent", "of it missing"],
                    [cells(results, work, scene, size, label, [other]) + wrong(results, "web: " + work, scene, size, other)
                     for work, label in SPACE.items()])


def drawings(results):
    other = "three.js SVGRenderer"
    for scene in results.select(1, "web: another view"):
        size = results.select(2, "web: another view", scene=scene)[0]
        yield "### {}: {:,} triangles, drawn".format(NAMES[scene].capitalize(), results.objects["web: another view", scene, size])
        rows = [cells(results, work, scene, size, label, [other]) for work, label in DRAWINGS.items()]
        for measure, label in {"bytes": "bytes of the SVG", "shapes": "paths", "percent wrong": "wrong samples, percent"}.items():
            values = [results.median("web: another view", scene, size, program, measure) for program in ("froe", other)]
            rows.append([label, *map(shown, values), ""])
        yield table(["", "froe", other, "froe beside it"], rows)


def page(results):
    head = results.heads["web"]
    parts = [TEXT, table(["", ""], [
        ["commit, date", "%s, %s" % (head["commit"], head["date"])],
        ["processor", "%s, %d of them, %d GB" % (head["processor"], head["processors"], head["memory"])],
        ["system, compiler", "%s; %s" % (head["system"], "emscripten of Debian 12")],
        ["packages", "flatbush 4.7.0, rbush 4.0.1, three-mesh-bvh 0.9.17, three 0.170.0"],
        ["load before and after", "%.1f, %.1f" % tuple(head["load"])],
    ])]
    parts += ["## Maps", OF_PLANE, *plane(results), "## Rays and nearest points", OF_SPACE, *space(results),
              "## Drawings", OF_DRAWINGS, *drawings(results)]
    return "\n\n".join(part.strip("\n") for part in parts) + "\n"


def main():
    results, folder = map(pathlib.Path, sys.argv[1:])
    (folder / "web.md").write_text(page(Results([results / "web.jsonl"])))
    print("web: %s/web.md" % folder)


if __name__ == "__main__":
    main()
