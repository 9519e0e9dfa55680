"""How the geometries of an index lie to others: in bulk, by trees of both, exactly."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from froe.adapters.features import Features
from froe.compat.interiors import Meetings, interiors
from froe.compat.layers import Layer, among, joined, pairs, turned, without
from froe.errors import OptionError, UnsupportedError

if TYPE_CHECKING:
    from froe.tree import Tree

Floats = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]


class Relations(Layer):
    """The geometries of an index, and what is asked about them. Pairs are arrays of two rows: those asked about, those
    of the index."""

    @cached_property
    def _boxes(self) -> tuple[Tree, Integers]:
        """A tree of the bounding boxes of what is not empty, and the geometry of each."""
        from froe.scene import Scene

        bounds = self.features.bounds()
        there = np.flatnonzero(~np.isnan(bounds[:, 0]))
        scene = Scene(2)
        if len(there):
            scene.add_boxes(bounds[there])
        return scene.build(purpose="query"), there

    def related(self, asked: Features, predicate: str | None) -> Integers:
        """The pairs for which the predicate of shapely holds; None: of bounding boxes that meet."""
        if predicate is None:
            return self._boxes_met(asked)
        if predicate not in PREDICATES:
            names = ", ".join([*PREDICATES, "dwithin"])
            raise OptionError(f"The predicate is {predicate!r}, and must be one of {names}.")
        return PREDICATES[predicate](self, Layer(asked))

    def _intersects(self, asked: Layer) -> Integers:
        return self.intersecting(asked.features)

    def _covers(self, asked: Layer) -> Integers:
        return self.tree.join_groups(asked.tree, relation="within").pairs()

    def _covered_by(self, asked: Layer) -> Integers:
        return self.tree.join_groups(asked.tree, relation="covers").pairs()

    def equal(self, asked: Features) -> Integers:
        """Pairs that are the same set of points."""
        layer = Layer(asked)
        covers = self._covers(layer)
        return covers[:, among(covers, self._covered_by(layer))]

    def _contains(self, asked: Layer) -> Integers:
        covered = self._alike(asked, self._covers(asked))
        return without(covered, self.tree.join_groups(asked.boundary.tree, relation="within").pairs())

    def _contains_properly(self, asked: Layer) -> Integers:
        covered = self._alike(asked, self._covers(asked))
        return without(covered, self.intersecting(asked.boundary.features))

    def _within(self, asked: Layer) -> Integers:
        covering = self._alike(asked, self._covered_by(asked))
        return without(covering, self.boundary.tree.join_groups(asked.tree, relation="covers").pairs())

    def _touches(self, asked: Layer) -> Integers:
        met = self._alike(asked, self.intersecting(asked.features))
        return without(met, interiors(asked, self, Meetings(asked, self)))

    def _crosses(self, asked: Layer) -> Integers:
        """The interiors of lines have points in common but no piece; of other pairs the geometry of lower dimension
        comes out of the one whose interior it meets."""
        self._alike(asked, self.intersecting(asked.features))
        meetings = Meetings(asked, self)
        found = interiors(asked, self, meetings)
        one, other = asked.dims[found[0]], self.dims[found[1]]
        out = ~among(found, joined(self._covers(asked), self._covered_by(asked)))
        lines = (one == 1) & (other == 1) & ~among(found, meetings.runs())
        return found[:, lines | ((one != other) & out)]

    def _overlaps(self, asked: Layer) -> Integers:
        """What the two have in common has their own dimension, and neither covers the other."""
        self._alike(asked, self.intersecting(asked.features))
        meetings = Meetings(asked, self)
        found = interiors(asked, self, meetings)
        one, other = asked.dims[found[0]], self.dims[found[1]]
        alike = (one == other) & ((one != 1) | among(found, meetings.runs()))
        return without(found[:, alike], joined(self._covers(asked), self._covered_by(asked)))

    def _alike(self, asked: Layer, found: Integers) -> Integers:
        """The same pairs. A geometry with parts of several dimensions is refused: its interior is not defined."""
        for layer, numbers, what in ((asked, found[0], "asked about"), (self, found[1], "of the index")):
            mixed = numbers[layer.mixed[numbers]]
            if len(mixed):
                raise UnsupportedError(
                    f"Geometry {mixed[0]} {what} has parts of several dimensions, so that its interior is not defined."
                )
        return found

    def _boxes_met(self, asked: Features) -> Integers:
        bounds = asked.bounds()
        there = np.flatnonzero(~np.isnan(bounds[:, 0]))
        tree, geometry = self._boxes
        found = tree.query(bounds[there]).pairs()
        return pairs(there[found[0]], geometry[found[1]])

    def intersecting(self, asked: Features) -> Integers:
        """Pairs with a point in common. Where no borders, lines or points of the two meet, a connected part of one lies
        within the other, so that any point of it decides."""
        plain = ~rectangles(asked)
        boxes = np.flatnonzero(~plain)
        met = self.tree.query(asked.bounds()[boxes]).pairs()  # whole boxes: what lies in them as well
        of_segment = np.flatnonzero(plain[asked.segment_of])
        crossed = self.tree.query(segments=asked.segments[of_segment]).pairs()
        anchors, anchor_of = asked.anchors()
        around = self.tree.groups(anchors).pairs()
        return joined(
            pairs(boxes[met[0]], self.owner[met[1]]),
            pairs(asked.segment_of[of_segment[crossed[0]]], self.owner[crossed[1]]),
            pairs(anchor_of[around[0]], around[1]),
            self._inside(asked, plain & asked.areas()),
        )

    @cached_property
    def _anchors(self) -> tuple[Tree, Floats, Integers]:
        from froe.scene import Scene

        anchors, owner = self.features.anchors()
        scene = Scene(2)
        if len(anchors):
            scene.add_points(anchors)
        return scene.build(purpose="query"), anchors, owner

    def _inside(self, asked: Features, which: npt.NDArray[np.bool_]) -> Integers:
        """Pairs of those polygons asked about and the geometries of the index of which an anchor lies in them."""
        if not which.any():
            return np.empty((2, 0), np.int64)
        tree, anchors, owner = self._anchors
        near = np.unique(tree.query(asked.bounds()[which]).ids)
        found = asked.scene().build(purpose="query").groups(anchors[near]).pairs()
        found = found[:, which[found[1]]]
        return pairs(found[1], owner[near[found[0]]])

    def within_distance(self, asked: Features, distances: Floats) -> Integers:
        """Pairs that are no farther from each other than the distance of the one asked about."""
        some = np.flatnonzero(distances >= 0)
        near_points = some_of(asked.point_of, some)
        near_segments = some_of(asked.segment_of, some)
        points = self.tree.query(balls=(asked.points[near_points], distances[asked.point_of[near_points]])).pairs()
        segments = self.tree.query(
            capsules=(asked.segments[near_segments], distances[asked.segment_of[near_segments]])
        ).pairs()
        meeting = self.intersecting(asked)
        return joined(
            meeting[:, distances[meeting[0]] >= 0],
            pairs(asked.point_of[near_points[points[0]]], self.owner[points[1]]),
            pairs(asked.segment_of[near_segments[segments[0]]], self.owner[segments[1]]),
        )


#: by the names of shapely
PREDICATES: dict[str, Callable[[Relations, Layer], Integers]] = {
    "intersects": Relations._intersects,
    "covers": Relations._covers,
    "covered_by": Relations._covered_by,
    "contains": Relations._contains,
    "contains_properly": Relations._contains_properly,
    "within": Relations._within,
    "touches": Relations._touches,
    "crosses": Relations._crosses,
    "overlaps": Relations._overlaps,
}


def some_of(owner: Integers, chosen: Integers) -> Integers:
    return np.flatnonzero(np.isin(owner, chosen))


def rectangles(features: Features) -> npt.NDArray[np.bool_]:
    """Which geometries are a single rectangle along the axes, and nothing else?"""
    bounds = features.bounds()
    count = np.bincount(features.segment_of, minlength=features.count)
    rings = np.bincount(features.segment_of, features.polygon_of >= 0, minlength=features.count)
    points = np.bincount(features.point_of, minlength=features.count)
    owner = features.segment_of
    start, end = features.segments[:, :2], features.segments[:, 2:]
    lower, upper = start == bounds[owner, :2], start == bounds[owner, 2:]
    straight = (start == end).any(axis=1) & (lower | upper).all(axis=1)
    corner = 1 << (2 * upper[:, 0] + upper[:, 1])  # each of the four corners has to come once
    corners = np.bincount(owner, corner, minlength=features.count)
    good = np.bincount(owner, straight, minlength=features.count)
    wide = bounds[:, 2:] > bounds[:, :2]
    found: npt.NDArray[np.bool_] = (
        (count == 4) & (rings == 4) & (points == 0) & (good == 4) & (corners == 15) & wide.all(axis=1)
    )
    return found
