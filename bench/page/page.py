#!/usr/bin/env python3
"""page.py RESULTS FOLDER: writes FOLDER/benchmarks.md, and its charts into the folder pictures beside FOLDER.

The text is here; every number comes from the lines of results. What has no results is left out.
"""
import pathlib
import sys

sys.dont_write_bytecode = True  # no folder of the sources gets files

import figure
from results import Results, quartiles, shown, span

SCENES = {
    "short": "short", "mixed": "mixed", "crossing": "crossing", "network": "network", "countries-110m": "countries",
    "freedoom-e1m5": "rooms", "scattered": "scattered", "city": "city", "mesh": "mesh", "fzk-haus": "houses",
    "utah-teapot": "teapots", "coast-h": "coasts", "scan-bunny": "bunnies", "scan-armadillo": "armadillos", "grid of areas": "grid", "states-albers-10m": "states", "boxes-3d": "small boxes",
}
MODELS = {"fzk-haus": "house", "utah-teapot": "teapot", "boxes1020": "boxes, 1,020", "boxes4080": "boxes, 4,080",
          "boxes16320": "boxes", "smalltri16000": "small triangles", "hyppar400": "grid of thin triangles",
          "sphere39600": "sphere", "freedoom-e1m1": "floor plan", "freedoom-e1m5": "larger floor plan",
          "countries-110m": "countries", "states-albers-10m": "states", "fzk-haus-boxes": "boxes of a house"}

# kind: heading, what is compared, the works in order, and what each of them is
KINDS = {
    "segments": ("Segments in the plane", """
*Short* segments lie anywhere and do not meet. Of *mixed* ones, a few are very long. *Crossing* ones have about as many
crossings as segments. A *network* consists of triangles that share corners. *Countries* are the borders of the world's
countries, and *rooms* the walls of a floor plan; of these two, copies are laid side by side.""", {
        "make": "from coordinates to an index that can answer",
        "window of 10": "all segments that meet a rectangle, about 10 of them",
        "window of 1000": "the same, about 1,000 of them",
        "window of 10000": "about 10,000",
        "window of 100000": "about 100,000",
        "segment above": "the first segment straight above a point",
        "nearest": "the segment nearest to a point",
        "10 nearest": "the 10 segments nearest to a point",
        "all pairs": "from coordinates to all pairs of segments that meet",
    }),
    "triangles": ("Triangles in space", """
*Scattered* triangles lie anywhere, in all directions. A *city* consists of blocks. The *mesh* is a bumpy sphere.
*Houses* and *teapots* are copies of two models, side by side. Embree computes in single precision. Its answers
count as equal within a ten-thousandth of the size of the scene.""", {
        "make": "from coordinates to an index that can answer",
        "first hit": "the first triangle that a ray meets, and where",
        "any hit": "whether a ray meets any triangle",
        "nearest": "the distance from a point to the nearest triangle",
        "window of 10": "all triangles that meet a box, about 10 of them",
        "window of 1000": "the same, about 1,000 of them",
    }),
    "points": ("Points", """
Points anywhere in a square (*plane*) or a cube (*space*). A ball may also be searched approximately: then everything
within the radius is reported, and nothing beyond the radius and a margin. For such searches froe has the method `bar`,
whose cells are never thin. It is listed beside `index`, the method for exact searches.""", {
        "make": "from coordinates to an index that can answer",
        "nearest": "the point nearest to a place",
        "10 nearest": "the 10 nearest points",
        "ball of 10": "all points in a ball, about 10 of them",
        "ball of 1000": "the same, about 1,000 of them",
        "ball of 1000, within a tenth": "the same with a margin of a tenth of the radius",
        "ball of 1000, within its radius": "the same with a margin as large as the radius",
    }),
    "boxes": ("Boxes", """
Boxes in space: *small boxes* anywhere, *towers* along streets, and *slabs*, each across one axis. Boost keeps each box
once, and its own boxes may overlap. The method `directional` of froe separates boxes from each other, which is more
than a search needs.""", {
        "make": "from coordinates to an index that can answer",
        "window of 10": "all boxes that meet a box, about 10 of them",
        "window of 1000": "the same, about 1,000 of them",
    }),
    "areas": ("Areas of maps", """
Which area of a map is a point in? A *grid* of crooked areas with 16 segments each, and two real maps, *countries* and
*states*, as they are.""", {
        "make": "from coordinates to an index that can answer",
        "area of a point": "the area that a point is in",
    }),
    "trapezoids": ("Maps of trapezoids", """
The method `cylindrical` of froe and a class of CGAL divide the plane into trapezoids, both in exact arithmetic. CGAL
gets at most 100,000 segments, for which it takes seconds.""", {
        "make": "from coordinates to a map that can answer",
        "segment above": "the first segment straight above a point",
    }),
}
ABOUT = {
    "segments": {"Boost": "the R-tree of Boost.Geometry, packed, of bounding boxes; each segment found is then tested exactly",
                 "Boost, segments": "the same R-tree of the segments themselves",
                 "GEOS": "its STRtree of bounding boxes; each segment found is then tested exactly",
                 "CGAL": "`box_self_intersection_d`; each pair found is then tested exactly",
                 "plain grid": "150 lines of C that were written for this comparison"},
    "triangles": {"Embree": "version 3, quality `high`, rays one by one", "CGAL": "its AABB tree, in doubles",
                  "Boost": "the packed R-tree of bounding boxes; each triangle found is then tested in doubles"},
    "points": {"nanoflann": "kd-trees, ten points in a leaf", "CGAL": "its kd-tree with `Fuzzy_sphere`"},
    "boxes": {"Boost": "the packed R-tree"},
    "areas": {"GEOS": "its STRtree, and prepared polygons, each of which it prepares when it is first looked at", "CGAL": "a trapezoidal map of the borders, exact"},
    "trapezoids": {"CGAL": "`Arr_trapezoid_ric_point_location`, exact"},
}


def table(head, rows):
    line = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(line + ["| " + " | ".join(str(c) for c in row) + " |" for row in rows])


def count(size):
    return "{:,}".format(10 ** size)


def label(work):
    return {"make": "making the index"}.get(work, work)


def ordinary(kind, work):
    """The way of using froe that suits the work."""
    return "froe, bar" if kind == "points" and "within" in work else "froe"


def measure_of(work):
    return "seconds" if work in ("make", "all pairs") else "per second"


def is_other(program):
    return not program.startswith("froe")


class Page:
    def __init__(self, results, pictures):
        self.r, self.pictures, self.parts = results, pictures, []

    def say(self, *text):
        self.parts += [t.strip("\n") for t in text]

    def fold(self, summary, text):
        """What opens when it is clicked on. MkDocs needs the attribute."""
        self.say('<details markdown="1"><summary>%s</summary>' % summary, text, "</details>")

    def draw(self, name, svg, what):
        (self.pictures / name).write_text(svg)
        self.say("![%s](../pictures/%s)" % (what, name))

    # ------------------------------------------------------------------ ratios
    def pairs(self, kind):
        """(work, program) of all other programs, in the order of the works."""
        for work in KINDS[kind][2]:
            for program in self.r.select(3, kind + ": " + work):
                if is_other(program):
                    yield work, program

    def sizes(self, kind):
        return sorted(self.r.select(2, kind + ": make"))

    def by_scene(self, kind, work, program, size, measure=None):
        name = kind + ": " + work
        out = {}
        for scene in self.r.select(1, name, size):
            value = self.r.ratio(name, scene, size, program, measure or measure_of(work), froe=ordinary(kind, work))
            if value:
                out[scene] = value
        return out

    def chart(self, name, title, kinds):
        """Of kinds of objects, each in the largest number up to a million."""
        rows = []
        for kind in kinds:
            size = max([s for s in self.sizes(kind) if s <= 6], default=0)
            for work, program in self.pairs(kind):
                values = list(self.by_scene(kind, work, program, size).values())
                if values:
                    rows.append((label(work) if len(kinds) == 1 else "%s: %s" % (kind, label(work).replace(" the index", "")),
                                 program, values))
        if rows:
            title += ": how many times as fast is froe?"
            self.draw("bench-%s.svg" % name, figure.ratios(title, rows), title)

    def ratio_cell(self, kind, work, program, scene, size, froe="froe", part=None):
        values = self.r.ratios(kind + ": " + work, scene, size, program, measure_of(work), froe, part)
        if not values:
            return ""
        low, middle, high = quartiles(values)
        return "%s (%s)" % (shown(middle), span([low, high]))

    def ratio_table(self, kind, size):
        scenes = self.r.select(1, kind + ": make", size)
        rows = []
        for work in KINDS[kind][2]:
            programs = self.r.select(3, kind + ": " + work, size, measure_of(work))
            ours = sorted((p for p in programs if p.startswith("froe")), key=lambda p: "in batches" in p)
            for froe in ours:
                others = ["froe"] if "in batches" in froe else [p for p in programs if is_other(p)]
                for other in others:
                    cells = [self.ratio_cell(kind, work, other, s, size, froe) for s in scenes]
                    rows.append([label(work), froe, other] + cells)
                    if work == "make":
                        cells = [self.ratio_cell(kind, work, other, s, size, froe, "seconds of the tree") for s in scenes]
                        rows.append(["the tree alone", froe, other] + cells if any(cells) else None)
        return table(["work", "this", "is so many times as fast as"] + [SCENES.get(s, s) for s in scenes],
                     [row for row in rows if row])

    def rate_table(self, kind, size):
        scenes = self.r.select(1, kind + ": make", size)
        rows = []
        for work in KINDS[kind][2]:
            name, measure = kind + ": " + work, measure_of(work)
            unit = "seconds" if measure == "seconds" else "a second"
            for program in self.r.select(3, name, size, measure):
                cells = [self.r.median(name, s, size, program, measure) for s in scenes]
                rows.append([label(work) + ", " + unit, program] + [shown(c) if c else "" for c in cells])
        for measure in ("seconds of the scene", "seconds of the tree"):
            cells = [self.r.median(kind + ": make", s, size, "froe", measure) for s in scenes]
            rows.append(["of making, " + measure, "froe"] + [shown(c) if c else "" for c in cells])
        for measure in ("bytes", "bytes at peak", "bytes of the tree"):
            for program in self.r.select(3, kind + ": make", size, measure):
                cells = [self.r.median(kind + ": make", s, size, program, measure) for s in scenes]
                rows.append([measure + " an object", program] + [shown(c) if c else "" for c in cells])
        return table(["", ""] + [SCENES.get(s, s) for s in scenes], rows)

    # ------------------------------------------------------------------ parts
    def machine(self):
        heads = self.r.heads.values()
        first = next(iter(heads))
        commits = sorted({h["commit"] for h in heads})
        loads = [l for h in heads for l in h["load"]]
        versions = ", ".join("%s %s" % (k.replace("lib", "", 1).replace("-dev", ""), v.split("+")[0].split("-")[0])
                             for k, v in first["versions"].items())
        self.say(table(["", ""], [row for row in [
            ["commit", ", ".join(commits)],
            ["date", " to ".join(sorted({h["date"] for h in heads}))],
            ["processor", "%s, %d of them, %d GB" % (first["processor"], first["processors"], first["memory"])],
            ["vector instructions", ", ".join(sorted({n.split("instructions ")[1] for k, n in self.r.notes.items()
                                                     if "instructions " in n and k[3] == "froe"}))],
            ["system, compiler", "%s; %s" % (first["system"], first["compiler"])],
            ["other programs, from Debian", versions],
            ["load before and after each part", "%.1f to %.1f processes that ran or waited" % (min(loads), max(loads))],
            ["duration", "%d minutes" % round(sum(h["seconds"] for h in heads) / 60)],
        ] if row[1]]))
        if len(commits) > 1:
            print("page: the results are of several commits: " + ", ".join(commits), file=sys.stderr)

    def slower(self):
        rows = []
        for kind in KINDS:
            sizes = self.sizes(kind)
            for work, program in self.pairs(kind):
                by_size = [self.by_scene(kind, work, program, size) for size in sizes]
                if all(not b or min(b.values()) >= 1 for b in by_size):
                    continue
                cells = {s: span(b.values()) if b else "" for s, b in zip(sizes, by_size)}
                rows.append(["%s: %s" % (kind, label(work)), program] + [cells.get(s, "") for s in (4, 5, 6)])
        self.say(table(["work", "beside", "10,000", "100,000", "1,000,000"], rows))
        larger = []
        for kind in KINDS:
            for program in self.r.select(3, kind + ": make"):
                values = [v for size in self.sizes(kind) if size >= 5
                          for v in self.by_scene(kind, "make", program, size, "bytes").values()]
                if is_other(program) and values and min(values) < 1:
                    larger.append([kind, program, span([1 / v for v in values])])
        if larger:
            self.say("The memory that froe keeps, scene and tree together, by that of the other program:",
                     table(["objects", "beside", "so many times as much"], larger))

        self.say("""
What costs this time and memory, and what else does:

- **Making.** An R-tree sorts boxes. froe finds equal corners, cuts every segment or triangle exactly, and keeps the
  scene with the tree, so that all other questions can be answered, too.
- **Rays.** Embree computes in single precision and leaves open what lies within that. froe decides exactly which
  triangle is met.
- **Small scenes.** Below 100,000 objects everything fits into the caches, and a simple index is as good as a clever one.
- **Few pieces.** The method `grain` takes up to ten times as long as `density`, which makes more pieces. The table of
  [pieces](#pieces) shows both.
- **Convex models.** Other programs do not cut a sphere at all, in trees that are half as high as the number of triangles.
  froe keeps trees low. `grain` then cuts 2 triangles in 1,000, `density` a third.
- **Walls that intersect.** A model like the house, with thousands of walls that cross, has no tree with few pieces.
- **Drawings.** gl2ps needs no tree of its own, and so is faster for a single drawing of the house.
- **Coordinates near the end of the range of doubles** take ten times as long, since exact arithmetic decides.
""")

    def kind(self, kind):
        heading, text, works = KINDS[kind]
        if not self.sizes(kind):
            return
        self.say("## " + heading, text, "The work:\n\n" + "\n".join("- *%s*: %s" % (label(w), what) for w, what in works.items()),
                 "The other programs:\n\n" + "\n".join("- *%s*: %s" % a for a in ABOUT[kind].items()))
        for size in reversed(self.sizes(kind)):
            self.say("### %s: %s" % (heading, count(size)), self.ratio_table(kind, size))
            self.fold("Questions a second, seconds, bytes", self.rate_table(kind, size))
        notes = sorted({n for k, n in self.r.notes.items() if k[0].startswith(kind + ":") and "differ" in n})
        if notes:
            self.say("Single precision changes a few answers: " + " ".join(notes))

    def pieces(self):
        scenes = self.r.select(1, "pieces")
        if not scenes:
            return
        shapes = [s for s in scenes if any(is_other(p) for p in self.r.select(3, "pieces", scene=s))]
        flat = [s for s in scenes if s not in shapes]
        everyone = self.r.select(3, "pieces")
        npm = [p for p in ("csg.js", "@jscad/modeling") if any(e.split(",")[0] == p for e in everyone)]
        text = """
A binary space partition cuts objects into pieces. Here cuts go on until each triangle or segment is part of a cut; of
boxes, until one is left in each cell. The other programs do the same with triangles: %sgl2ps,
which sorts polygons by such a tree.""" % "".join(p + ", " for p in npm)
        text += " *Shuffled*: the same triangles in random order." if npm else """
csg.js and @jscad/modeling, which [README](../../README.md) shows with a scanned bunny, come from the registry of npm: `bench/run npm pieces`
measures them, and all programs on the bunny."""
        text += """
*Failed*: the method refuses polygons that cross. These numbers are counts, the same on every machine. A cell shows the
pieces of one object, and in brackets the height of the tree, which gl2ps does not show."""
        self.say("## Pieces", text)
        for some, what in ((shapes, "Triangles"), (flat, "Segments and boxes")):
            names = [MODELS.get(s, s) for s in some]
            head = [what] + ["%s, %s" % (n, "{:,}".format(self.r.objects[("pieces", s, z)])) if not n[-1].isdigit() else n
                             for s, n in zip(some, names) for z in self.r.select(2, "pieces", scene=s)[:1]]
            programs = list(dict.fromkeys(p for s in some for p in self.r.select(3, "pieces", scene=s)))
            programs.sort(key=lambda p: (is_other(p), p.split(",")[0], p))
            rows = [[p] + [self.pieces_cell(s, p) for s in some] for p in programs]
            self.say(table(head, [row for row in rows if any(c and c != "failed" for c in row[1:])]))
        programs = ["froe, grain", "froe, density", "froe, autopartition"] + [p for p in self.r.select(3, "pieces") if is_other(p)]
        rows = [[p] + [self.seconds_cell(s, p) for s in shapes] for p in programs]
        self.say("Processor time of the same runs, seconds:",
                 table(["Triangles"] + [MODELS.get(s, s) for s in shapes], [row for row in rows if any(row[1:])]))

    def places(self):
        """Pieces of the same models as they are, shifted, turned."""
        names = ["as it is", "shifted", "turned", "turned, floats"]
        rows = []
        for program in ("froe, grain", "froe, density"):
            for scene in self.r.select(1, "places, " + names[0]):
                size = self.r.select(2, "places, " + names[0], scene=scene)[0]
                keys = [("places, " + n, scene, size, program) for n in names]
                counts = [self.r.median(*k, "pieces") for k in keys]
                heights = [self.r.median(*k, "height") for k in keys]
                objects = self.r.objects[keys[0][:3]]
                rows.append([program[len("froe, "):], "%s, %s" % (MODELS.get(scene, scene), "{:,}".format(objects))] +
                            ["%.3f (%d)" % (c / objects, h) for c, h in zip(counts, heights)] +
                            ["%.2f" % (counts[2] / counts[3])])
        if rows:
            self.say("## Models that are turned or far from the origin", """
The same models in four places: *as it is*, on a grid of 2^-24 of the size; *shifted* by 2^20 sizes, exactly; *turned* about
two axes by 0.7, and rounded to doubles; and turned and rounded to *floats*. Corners of a wall that was turned lie in no
plane. Doubles see that where they were rounded to floats, but not where they were rounded to doubles, so the last column
shows what that costs. Cells show pieces of one triangle, and in brackets the height. They are the same on every
machine.""", table(["", "model"] + names + ["turned / floats"], rows))

    def pieces_key(self, scene, program, measure):
        size = self.r.select(2, "pieces", scene=scene)[0]
        return ("pieces", scene, size, program, measure)

    def pieces_cell(self, scene, program):
        key = self.pieces_key(scene, program, "pieces")
        if key in self.r.failed:
            return self.r.failed[key]
        if key not in self.r.values:
            return ""
        each = self.r.values[key][0] / self.r.objects[key[:3]]
        height = self.r.median(*self.pieces_key(scene, program, "height"))
        return "%.2f%s" % (each, " (%d)" % height if height else "") if each < 100 else "{:,.0f}".format(each)

    def seconds_cell(self, scene, program):
        value = self.r.median(*self.pieces_key(scene, program, "seconds"))
        return shown(value) if value else ""

    def pieces_chart(self):
        groups = []
        for scene in ("bunny", "fandisk", "fzk-haus", "utah-teapot", "boxes16320", "smalltri16000"):
            sizes = self.r.select(2, "pieces", scene=scene)
            if not sizes:
                continue
            objects = self.r.objects[("pieces", scene, sizes[0])]
            best = {}
            for program in self.r.select(3, "pieces", scene=scene, measure="pieces"):
                name = program.split(",")[0] if is_other(program) else program
                value = self.r.median("pieces", scene, sizes[0], program, "pieces")
                if value and (is_other(program) or program == "froe, grain"):
                    best[name] = min(best.get(name, 1e9), value / objects)
            groups.append((MODELS.get(scene, scene), [("froe" if p == "froe, grain" else p, v) for p, v in best.items()]))
        groups = [g for g in groups if len(g[1]) > 1]
        if groups:
            title = "Pieces of each triangle, best setting of each program: fewer are better"
            self.draw("bench-pieces.svg", figure.bars(title, groups, lambda v: "%.2f" % v), title)

    def drawings(self):
        scenes = self.r.select(1, "picture")
        if not scenes:
            return
        self.say("## Drawings without hidden surfaces", """
The same scene, view and colours on a page of 1000 x 1000, fills only. gl2ps is told to choose the best root and to leave
out what is hidden. Seconds begin with the scene in memory and end with the file; froe makes its tree in that time.
*Tree there*: a further view of the same scene. *Percent wrong*: points of a fine grid that have another colour than the
nearest face. All of them lie on borders, where coordinates of the file are rounded; froe writes two decimals, gl2ps six
digits. *Pixels off*: pixels that differ by more than 16 of 255 from exact ones, painted by librsvg.""")
        size = {s: self.r.select(2, "picture", scene=s)[0] for s in scenes}
        rows = []
        for measure in ("shapes", "bytes", "seconds", "percent wrong", "pixels off"):
            for program in self.r.select(3, "picture", measure=measure):
                cells = [self.r.median("picture", s, size[s], program, measure) for s in scenes]
                rows.append([measure, program] + [shown(c) if c is not None else "" for c in cells])
        self.say(table(["", ""] + ["%s, %s triangles" % (MODELS.get(s, s), "{:,}".format(self.r.objects[("picture", s, size[s])]))
                                   for s in scenes], rows))

    def generic(self, work, heading, text):
        """A table for each scene: programs by measures."""
        scenes = self.r.select(1, work)
        if not scenes:
            return
        self.say("## " + heading, text)
        measures = self.r.select(4, work)
        rows = []
        for scene in scenes:
            for size in self.r.select(2, work, scene=scene):
                for program in self.r.select(3, work, size, scene=scene):
                    cells = []
                    for m in measures:
                        key = (work, scene, size, program, m)
                        value = self.r.median(*key)
                        cells.append(shown(value) if value is not None else self.r.failed.get(key, ""))
                    rows.append(["%s, %s" % (MODELS.get(scene, scene), "{:,}".format(self.r.objects[(work, scene, size)])),
                                 program] + cells)
        self.say(table(["scene", "program"] + measures, rows))
        notes = list(dict.fromkeys(n for k, n in self.r.notes.items() if k[0] == work))
        if notes:
            self.say(" ".join(notes))

    def paths(self):
        rows = []
        programs = []
        for work in self.r.select(0, measure="per second"):
            if not work.startswith("paths, "):
                continue
            size, scene = self.r.select(2, work)[0], self.r.select(1, work)[0]
            programs = [p for p in self.r.select(3, work) if p.startswith("froe, ") and "plain" not in p and "batches" not in p]
            kind, name = work[len("paths, "):].split(": ")
            rows.append([kind, name] + [shown(self.r.ratio(work, scene, size, "froe, plain", "per second", froe=p))
                                        for p in ["froe"] + programs])
        if rows:
            self.say("## Instructions", """
froe chooses the widest vector instructions that the processor has. How many times as fast is it with these as with
plain C, on a million short segments and a million triangles of a city? The answers and the trees are the same.""",
                     table(["", "", "as chosen"] + [p[len("froe, "):] for p in programs], rows))

    def reading(self):
        work, rows = "reading", []
        for scene in self.r.select(1, work):
            size = self.r.select(2, work, scene=scene)[0]
            for program in self.r.select(3, work, size, "seconds", scene):
                if is_other(program):
                    key = (work, scene, size, program, "seconds")
                    rows.append([scene, "%.1f" % (self.r.objects[key[:3]] / 1e6),
                                 shown(self.r.median(work, scene, size, "froe", "seconds")), program,
                                 shown(self.r.median(*key)), shown(self.r.ratio(*key))])
        if rows:
            self.say("## Reading files", """
From a file to a scene, beside a program that reads the file into arrays. froe reads CSV, OBJ, OFF and GeoJSON by
itself, and other files by GDAL and assimp; then its time includes theirs. The file is in the system's cache.""",
                     table(["file", "MB", "froe, seconds", "beside", "seconds", "so many times as fast"], rows))

    def threads(self):
        rows = []
        measure = "seconds of the clock"
        for kind in KINDS:
            work = "threads, %s: make" % kind
            for scene in self.r.select(1, work, measure=measure):
                size = self.r.select(2, work, scene=scene, measure=measure)[0]
                for program in self.r.select(3, work, size, measure, scene):
                    if "threads" not in program:
                        continue
                    one = program.rsplit(",", 1)[0]
                    faster = self.r.ratio(work, scene, size, one, measure, froe=program)
                    rows.append([program, "%s, %s" % (SCENES.get(scene, scene), "{:,}".format(self.r.objects[(work, scene, size)])),
                                 shown(self.r.median(work, scene, size, one, measure)),
                                 shown(self.r.median(work, scene, size, program, measure)), shown(faster)])
        if rows:
            self.say("## Threads", "From coordinates in memory to a tree, scene and tree together, by the time that passes.",
                     table(["", "scene", "one thread, seconds", "several, seconds", "so many times as fast"], rows))

    # ------------------------------------------------------------------- whole
    def write(self, path):
        self.say("<!-- Written by bench/page/page.py from the results of `make bench`. Change that program, not this page. -->",
                 "# Benchmarks", """
This page compares froe with other programs, on one machine, from one commit. `make bench` runs all of it and writes this
page. Each chart shows how many times as fast froe is: a mark for each scene, right of 1 where froe is faster.""")
        self.chart("segments", "A million segments in the plane", ["segments"])
        self.chart("triangles", "A million triangles in space", ["triangles"])
        self.chart("others", "Points, boxes, areas of maps", ["points", "boxes", "areas", "trapezoids"])
        self.pieces_chart()
        self.say("## How this was measured")
        self.machine()
        self.say("""
- All programs run in one process and take turns. Each of them gets new questions in every round, and the shares go
  round, so that no program finds its data in the caches because another one has just used them. At the end each has
  answered every question.
- The clock starts at the user's arrays and ends with the answers in the user's arrays. *Making* counts all that a program
  does before it can answer. For froe that is the scene and the tree. *The tree alone*: the same without the scene.
- Seconds are processor time of one thread, unless a table says otherwise. Other work on the machine disturbs that least.
- A ratio compares two programs in the same round. The tables show the median of the rounds, five of making and nine of
  questions, and in brackets the quartiles. Above 1 froe is faster.
- All answers are compared. `make bench` fails if one differs.
- Memory is what the process has resident, before and after; the user's arrays are not counted.""",
                 "## Where froe is slower or larger", """
Every comparison in which froe is slower than another program on at least one scene. The cells show the range over the
scenes: 0.5 means that froe takes twice as long. Approximate searches are those by the method `bar`.""")
        self.slower()
        for kind in KINDS:
            self.kind(kind)
        self.pieces()
        self.places()
        self.drawings()
        self.generic("lines", "Line drawings", """
Drawings of visible edges: silhouettes, borders and creases. *Percent wrong*: length of lines that are drawn but hidden.
*Percent missing*: length of lines that are visible but not drawn. Both are found by casting rays.""")
        self.reading()
        self.threads()
        self.paths()
        self.generic("motion", "Segments in motion", """
A partition that follows short segments, which move along straight lines in a square. An *event* is a change of the tree,
at the exact time at which it is due. A *rebuild* makes the tree again from nothing. Frames miss what happens between two
of them; the partition in motion misses nothing. *Work of 60 rebuilds a second*: above 1, following the segments is less
work than 60 rebuilds for each second of the motion.""")
        path.write_text("\n\n".join(self.parts) + "\n")


def main():
    results, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    pictures = folder.parent / "pictures"
    r = Results(p for p in sorted(results.glob("*.jsonl")) if p.stem != "python")  # which has its own page
    if not r.heads:
        sys.exit("page: there are no results in %s" % results)
    Page(r, pictures).write(folder / "benchmarks.md")
    print("page: %s" % (folder / "benchmarks.md"), file=sys.stderr)


if __name__ == "__main__":
    main()
