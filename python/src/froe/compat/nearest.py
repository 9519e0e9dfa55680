"""The nearest geometries of an index, exactly: found by distances rounded to doubles, decided by fractions where these
are equal or where the question is no point."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import numpy.typing as npt

from froe.adapters.features import Features
from froe.compat.layers import among, pairs, without
from froe.compat.relations import Relations

Floats = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]


class Nearest:
    """The nearest geometries of an index."""

    def __init__(self, relations: Relations) -> None:
        self.relations = relations
        features = relations.features
        points = np.concatenate([features.points, features.points], axis=1)
        #: the two ends of each object of the tree; those of points are equal
        self.ends = np.concatenate([features.segments, points, features.flat()[0]])

    def nearest(self, asked: Features, limit: float | None, exclusive: bool = False) -> tuple[Integers, Floats]:
        """Pairs, all that are equally near, and their distances: those below or at the limit; with `exclusive` without
        geometries that are the same set of points."""
        passed_over = self.relations.equal(asked) if exclusive else np.empty((2, 0), np.int64)
        met = without(self.relations.intersecting(asked), passed_over)
        found = [met]
        distances = [np.zeros(met.shape[1])]
        empty = np.isnan(asked.bounds()[:, 0])
        empty[met[0]] = True
        apart = np.flatnonzero(~empty)
        single = (np.bincount(asked.point_of, minlength=asked.count) == 1) & (
            np.bincount(asked.segment_of, minlength=asked.count) == 0
        )
        for pair, distance in (
            self._of_points(asked, apart[single[apart]], limit, passed_over),
            *(self._of_geometry(asked, int(one), limit, passed_over) for one in apart[~single[apart]]),
        ):
            found.append(pair)
            distances.append(distance)
        both, lengths = np.concatenate(found, axis=1), np.concatenate(distances)
        order = np.lexsort((both[1], both[0]))
        return both[:, order], lengths[order]

    def _of_points(
        self, asked: Features, which: Integers, limit: float | None, passed_over: Integers
    ) -> tuple[Integers, Floats]:
        """Of geometries that are one point each and meet nothing but what is passed over."""
        place = np.full(asked.count, -1)
        place[asked.point_of] = np.arange(len(asked.points))
        points = asked.points[place[which]]
        first, second, lengths = [np.empty(0, np.int64)], [np.empty(0, np.int64)], [np.empty(0)]
        rows, wanted = np.arange(len(which)), 4
        objects = len(self.ends)
        while len(rows):
            answers = self.relations.tree.nearest(
                points[rows], k=wanted, max_distance=math.inf if limit is None else limit
            )
            row, value = np.repeat(np.arange(len(rows)), answers.counts()), answers.values
            assert value is not None
            passed = among(np.stack([which[rows[row]], self.relations.owner[answers.ids]]), passed_over)
            least = np.full(len(rows), np.inf)
            np.minimum.at(least, row[~passed], value[~passed])
            tied = (value == least[row]) & ~passed
            seen = np.bincount(row, tied | passed, minlength=len(rows))
            more = (seen == wanted) & (wanted < objects)  # those farther on may be as near
            use = tied & ~more[row]
            first.append(rows[row[use]])
            second.append(answers.ids[use].astype(np.int64))
            lengths.append(value[use])
            rows, wanted = rows[more], 4 * wanted
        return self._decide(which, points, np.concatenate(first), np.concatenate(second), np.concatenate(lengths))

    def _decide(
        self, which: Integers, points: Floats, row: Integers, objects: Integers, lengths: Floats
    ) -> tuple[Integers, Floats]:
        """Leaves out what is farther by less than doubles show."""
        owner = self.relations.owner[objects]
        several = pairs(row, owner)[0]
        doubtful = np.isin(row, several[1:][several[1:] == several[:-1]])
        keep = ~doubtful
        squares: dict[int, Fraction] = {}
        exact = {}
        for i in np.flatnonzero(doubtful):
            exact[i] = point_square(points[row[i]], self.ends[objects[i]])
            squares[row[i]] = min(exact[i], squares.get(row[i], exact[i]))
        for i, square in exact.items():
            keep[i] = square == squares[row[i]]
        found = np.stack([which[row[keep]], owner[keep]])
        both, index = np.unique(found, axis=1, return_index=True)
        return both, lengths[keep][index]

    def _of_geometry(
        self, asked: Features, one: int, limit: float | None, passed_over: Integers
    ) -> tuple[Integers, Floats]:
        """Of one geometry that meets nothing but what is passed over. Segments that do not meet are nearest at an end
        of one of them. The nearest object to any corner bounds the distance; what is within that of a segment is
        compared exactly."""
        corners, owner = asked.corners()
        bound = math.inf if limit is None else limit
        passed = passed_over[1, passed_over[0] == one]
        best = self._least(corners[owner == one], bound, passed)
        reach = min(bound, math.nextafter(best, math.inf))
        segments = np.concatenate(
            [asked.segments[asked.segment_of == one], np.tile(asked.points[asked.point_of == one], 2)]
        )
        squares: dict[int, Fraction] = {}
        for segment, thing in self._within(segments, reach, passed).T:
            square = segment_square(segments[segment], self.ends[thing])
            geometry = int(self.relations.owner[thing])
            squares[geometry] = min(square, squares.get(geometry, square))
        if not squares:
            return np.empty((2, 0), np.int64), np.empty(0)
        least = min(squares.values())
        nearest = sorted(geometry for geometry, square in squares.items() if square == least)
        return np.array([[one] * len(nearest), nearest]), np.full(len(nearest), rounded_root(least))

    def _within(self, segments: Floats, reach: float, passed: Integers) -> Integers:
        """Pairs of a segment and an object that is no farther from it, without the geometries passed over. A distance
        that no double holds is infinite, and then every object is near enough."""
        if math.isinf(reach):
            found = np.indices((len(segments), len(self.ends))).reshape(2, -1)
        else:
            found = self.relations.tree.query(capsules=(segments, np.full(len(segments), reach))).pairs()
        others: Integers = found[:, ~np.isin(self.relations.owner[found[1]], passed)]
        return others

    def _least(self, corners: Floats, bound: float, passed: Integers) -> float:
        """The distance of the nearest object to any of the corners, but for those of the geometries passed over."""
        wanted, objects = 2, len(self.ends)
        while True:
            answers = self.relations.tree.nearest(corners, k=wanted, max_distance=bound)
            assert answers.values is not None
            others = ~np.isin(self.relations.owner[answers.ids], passed)
            if others.any() or wanted >= objects:
                return float(answers.values[others].min(initial=math.inf))
            wanted *= 4


def point_square(point: Floats, ends: Floats) -> Fraction:
    """The square of the distance of a point from a segment."""
    x, y = (Fraction(float(value)) for value in point)
    ax, ay, bx, by = (Fraction(float(value)) for value in ends)
    dx, dy, px, py = bx - ax, by - ay, x - ax, y - ay
    length, along = dx * dx + dy * dy, px * dx + py * dy
    if along <= 0:
        return px * px + py * py
    if along >= length:
        return (x - bx) ** 2 + (y - by) ** 2
    return (px * dy - py * dx) ** 2 / length


def segment_square(one: Floats, other: Floats) -> Fraction:
    """The square of the distance of two segments that do not meet."""
    return min(
        point_square(one[:2], other),
        point_square(one[2:], other),
        point_square(other[:2], one),
        point_square(other[2:], one),
    )


def rounded_root(square: Fraction) -> float:
    """The double nearest to the square root, ties to even; infinity beyond their range."""
    if square == 0:
        return 0.0
    # 2^shift is chosen so that the root has 64 bits at least before its point; what is cut off is kept as a last bit.
    shift = max(0, 64 - (square.numerator.bit_length() - square.denominator.bit_length()) // 2)
    scaled = square * Fraction(4) ** shift
    whole = math.isqrt(scaled.numerator // scaled.denominator)
    sticky = int(whole * whole != scaled)
    root = Fraction(2 * whole + sticky, 2 << shift)
    try:
        return float(root)
    except OverflowError:
        return math.inf
