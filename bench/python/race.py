#!/usr/bin/env python3
"""race.py GEOS [SIZE...]: froe from numpy beside GEOS, in one process and on one thread, taking turns.

GEOS is the shared object of geos.c. Prints lines of results (README.md of bench/). Ends with 1 if answers differ.
"""

import ctypes
import itertools
import json
import sys
import time
import warnings

import froe
import numpy as np
import shapely
from shapely.geometry import LineString, Point, box
from shapely.prepared import prep
from shapely.strtree import STRtree

ROUNDS = 7
SEED = 1
# work: answers to a window, and questions a round to each program; the slower ones get fewer
WINDOWS = {1: (20000, 4000, 400), 10: (20000, 2000, 200), 1000: (1000, 100, 20)}
NEAREST = (20000, 4000, 200)
COMPARED = 20
LOOP_LIMIT = 100000  # objects for which a loop in Python is tried


def pointer(array):
    return array.ctypes.data_as(ctypes.c_void_p)


class Froe:
    name, place = "froe", 0

    def __init__(self, segments):
        self.tree = froe.segments(segments).build(threads=1)

    def windows(self, windows):
        found = self.tree.query(windows, threads=1)
        return found.starts[1:], found.ids

    def nearest(self, points):
        return self.tree.nearest(points, threads=1)[1]

    def pairs(self):
        return 2 * len(self.tree.pairs(threads=1))


class FroeBoxes(Froe):
    """An index of bounding boxes, as STRtree is without a predicate."""

    name = "froe, boxes only"

    def __init__(self, segments):
        ends = segments.reshape(-1, 2, 2)
        self.tree = froe.boxes(np.hstack([ends.min(axis=1), ends.max(axis=1)])).build(threads=1)


class Geos:
    """The calls that shapely 2 makes, from C."""

    name, place, exact = "GEOS", 1, 1
    library = None

    def __init__(self, segments):
        self.count = len(segments)
        self.index = ctypes.c_void_p(self.library.geos_make(pointer(segments), ctypes.c_size_t(len(segments))))

    def __del__(self):
        self.library.geos_free(self.index)

    def found(self, ends):
        count = int(ends[-1])
        return np.ctypeslib.as_array(self.library.geos_found(self.index), (max(count, 1),))[:count].copy()

    def windows(self, windows):
        ends = np.empty(len(windows), np.int64)
        count = ctypes.c_size_t(len(windows))
        self.library.geos_windows(self.index, pointer(windows), count, self.exact, pointer(ends))
        return ends, self.found(ends)

    def nearest(self, points):
        nearest, distances = np.empty(len(points), np.int64), np.empty(len(points))
        self.library.geos_nearest(
            self.index, pointer(points), ctypes.c_size_t(len(points)), pointer(nearest), pointer(distances)
        )
        return distances

    def pairs(self):
        ends = np.empty(self.count, np.int64)
        self.library.geos_pairs(self.index, pointer(ends))
        return len(self.found(ends)) - self.count  # without each with itself


class GeosBoxes(Geos):
    name, exact = "GEOS, boxes only", 0


class Loop:
    """STRtree and prepared geometries of shapely 1.8, a question at a time."""

    name, place, exact = "shapely " + shapely.__version__, 2, True

    def __init__(self, segments):
        self.lines = [LineString([(a, b), (c, d)]) for a, b, c, d in segments.tolist()]
        self.tree = STRtree(self.lines)
        self.tree.query_items(Point(0, 0))  # packs it

    def ask(self, question):
        found = self.tree.query_items(question)
        if not self.exact:
            return found
        prepared = prep(question)
        return [i for i in found if prepared.intersects(self.lines[i])]

    def windows(self, windows):
        found = [self.ask(box(*window)) for window in windows.tolist()]
        return np.cumsum([len(ids) for ids in found]), np.array(list(itertools.chain(*found)), np.int64)

    def nearest(self, points):
        asked = [Point(*point) for point in points.tolist()]
        return np.array([point.distance(self.tree.nearest_geom(point)) for point in asked])

    def pairs(self):
        return sum(len(self.ask(line)) for line in self.lines) - len(self.lines)


class LoopBoxes(Loop):
    name, exact = Loop.name + ", boxes only", False


class Bulk:
    """shapely 2: arrays of questions."""

    name, place, predicate = Loop.name, 1, "intersects"

    def __init__(self, segments):
        self.lines = shapely.linestrings(segments.reshape(-1, 2, 2))
        self.tree = shapely.STRtree(self.lines)

    def windows(self, windows):
        question, found = self.tree.query(shapely.box(*windows.T), predicate=self.predicate)
        return np.searchsorted(question, np.arange(len(windows)), side="right"), found

    def nearest(self, points):
        asked = shapely.points(points)
        return shapely.distance(asked, self.lines[self.tree.nearest(asked)])

    def pairs(self):
        return self.tree.query(self.lines, predicate="intersects").shape[1] - len(self.lines)


class BulkBoxes(Bulk):
    name, predicate = Bulk.name + ", boxes only", None


def short_segments(count):
    """Anywhere in the unit square, half as long as a square is wide that holds one: few meet."""
    random = np.random.default_rng(SEED)
    start, angle = random.random((count, 2)), random.random(count) * 2 * np.pi
    way = np.stack([np.cos(angle), np.sin(angle)], axis=1) * (0.5 / np.sqrt(count))
    return np.hstack([start, start + way])


class Race:
    def __init__(self, segments, programs):
        self.segments, self.programs, self.good = segments, programs, True
        self.made = {}

    def say(self, work, program, measure, values, **more):
        line = {"work": "python: " + work, "scene": "short", "objects": len(self.segments), "program": program}
        print(json.dumps({**line, "measure": measure, "values": values, **more}), flush=True)

    def clock(self, call, *arguments):
        start = time.process_time()
        result = call(*arguments)
        return result, time.process_time() - start

    def make(self):
        rounds = 3 if len(self.segments) > LOOP_LIMIT else 5
        for program in self.programs:
            seconds = []
            for _ in range(rounds if program.place < 2 else 1):
                self.made.pop(program, None)
                self.made[program], spent = self.clock(program, self.segments)
                seconds.append(spent)
            self.say("make", program.name, "seconds", seconds)

    def turns(self, work, programs, questions, counts, ask):
        """Programs take turns; every program gets another share of the questions in each round."""
        rates = {program: [] for program in programs}
        share = len(questions) // ROUNDS
        for turn in range(ROUNDS):
            for number, program in enumerate(programs):
                first = (turn + number) % ROUNDS * share
                mine = np.ascontiguousarray(questions[first : first + counts[program.place]])
                _, seconds = self.clock(ask, self.made[program], mine)
                rates[program].append(len(mine) / seconds)
        for program, values in rates.items():
            self.say(work, program.name, "per second", values)

    def agree(self, work, answers):
        """All programs answer the same few questions; lists of answers are sorted."""
        if any(not np.array_equal(answers[0], other) for other in answers[1:]):
            print("race: answers differ: " + work, file=sys.stderr)
            self.good = False

    def windows(self):
        random = np.random.default_rng(SEED + 1)
        for answers, counts in WINDOWS.items():
            middle = random.random((ROUNDS * counts[0], 2))
            half = np.sqrt(answers / len(self.segments)) / 2
            windows = np.hstack([middle - half, middle + half])
            for boxes_only in (False, True):
                mine = [p for p in self.programs if p.name.endswith("boxes only") == boxes_only]
                work = "window of %d%s" % (answers, ", boxes only" if boxes_only else "")
                self.turns(work, mine, windows, counts, lambda index, asked: index.windows(asked))
                some = windows[:COMPARED].copy()
                self.agree(work, [by_question(*self.made[p].windows(some)) for p in mine])

    def nearest(self):
        points = np.random.default_rng(SEED + 2).random((ROUNDS * NEAREST[0], 2))
        mine = [p for p in self.programs if not p.name.endswith("boxes only")]
        self.turns("nearest", mine, points, NEAREST, lambda index, asked: index.nearest(asked))
        some = [self.made[p].nearest(points[:COMPARED].copy()) for p in mine]
        self.agree("nearest", [np.isclose(s, some[0], rtol=1e-9) for s in some])  # GEOS rounds its distances

    def pairs(self):
        mine = [p for p in self.programs if not p.name.endswith("boxes only")]
        seconds, found = {p: [] for p in mine}, {}
        for _ in range(3):
            for program in mine:
                found[program], spent = self.clock(self.made[program].pairs)
                seconds[program].append(spent)
        for program, values in seconds.items():
            self.say("all pairs", program.name, "seconds", values)
        self.agree("all pairs", [np.array(count) for count in found.values()])


def by_question(ends, ids):
    return np.stack([np.searchsorted(ends, np.arange(len(ids)), side="right"), ids])[
        :, np.lexsort((ids, np.searchsorted(ends, np.arange(len(ids)), side="right")))
    ]


def main():
    warnings.simplefilter("ignore")  # of shapely 1.8 about shapely 2
    Geos.library = ctypes.CDLL(sys.argv[1])
    Geos.library.geos_make.restype = ctypes.c_void_p
    Geos.library.geos_found.restype = ctypes.POINTER(ctypes.c_int64)
    good = True
    for size in map(int, sys.argv[2:]):
        programs = [Froe, FroeBoxes, Geos, GeosBoxes]
        if hasattr(shapely, "linestrings"):
            programs += [Bulk, BulkBoxes]
        elif size <= LOOP_LIMIT:
            programs += [Loop, LoopBoxes]
        race = Race(short_segments(size), programs)
        race.make()
        race.windows()
        race.nearest()
        race.pairs()
        good &= race.good
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
