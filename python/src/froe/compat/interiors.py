"""Which interiors meet? Exactly, without a point that would have to be rounded.

The interior of a polygon is what is not on its rings, that of lines what is no end of an odd number of them, that of
points all of them (OGC Simple Features). Two segments that meet either cross within both, or an end of one lies on the
other: a place, which is a point given.

Let the interior of a polygon P have a point in common with a segment S. Then S crosses a ring of P, or an end of S lies
in the interior of P, or S goes through it from one place on a ring to the next: the piece of S between two neighbouring
places is covered by P, and not by its rings. Of two polygons of which no ring comes into the interior of the other, and
whose interiors meet, one covers the other, since interiors of polygons are connected.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from froe.compat.layers import Layer, among, joined, pairs, turned, without

Floats = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]


class Meetings:
    """Pairs of segments that meet, with the places at which an end of one lies on the other."""

    def __init__(self, asked: Layer, kept: Layer) -> None:
        self.asked, self.kept = asked, kept
        ours, theirs = asked.features.segments, kept.features.segments
        met = _segments(kept.tree.query(segments=ours).pairs(), len(theirs))
        here = _segments(kept.tree.locate(ours.reshape(-1, 2)).pairs(), len(theirs))
        there = _segments(asked.tree.locate(theirs.reshape(-1, 2)).pairs(), len(ours))
        first = np.concatenate([here[0] // 2, there[1]])
        second = np.concatenate([here[1], there[0] // 2])
        points = np.concatenate([ours.reshape(-1, 2)[here[0]], theirs.reshape(-1, 2)[there[0]]]) + 0.0  # no -0
        order = np.lexsort((points[:, 1], points[:, 0], second, first))
        first, second, points = first[order], second[order], points[order]
        new = np.ones(len(first), bool)
        new[1:] = (np.diff(first) != 0) | (np.diff(second) != 0) | (points[1:] != points[:-1]).any(axis=1)
        #: rows of a segment asked about and one of the index, with a place of both
        self.places = np.stack([first[new], second[new]])
        self.points: Floats = points[new]
        at_ends = _at_own_ends(asked, kept), turned(_at_own_ends(kept, asked))
        #: those that cross
        self.crossing = self._geometries(without(met, joined(self.places, *at_ends)))

    def _geometries(self, found: Integers) -> Integers:
        return pairs(self.asked.features.segment_of[found[0]], self.kept.features.segment_of[found[1]])

    def runs(self) -> Integers:
        """Geometries with segments that have two places in common, and so a piece of a length."""
        again = np.zeros(self.places.shape[1], bool)
        again[1:] = (self.places[:, 1:] == self.places[:, :-1]).all(axis=0)
        return self._geometries(self.places[:, again])

    def pieces(self, turn: bool) -> tuple[Floats, Integers]:
        """Segments asked about (or with `turn` those of the index), between neighbouring places on one geometry of the
        other side: the pieces, and the two geometries of each."""
        ours, theirs = (self.kept, self.asked) if turn else (self.asked, self.kept)
        segment, other = self.places[::-1] if turn else self.places
        against = theirs.features.segment_of[other]
        ends = ours.features.segments[segment]
        along = np.where(ends[:, 0] != ends[:, 2], self.points[:, 0], self.points[:, 1])
        order = np.lexsort((along, against, segment))
        segment, against, along, points = segment[order], against[order], along[order], self.points[order]
        follows = (np.diff(segment) == 0) & (np.diff(against) == 0) & (np.diff(along) != 0)
        pieces = np.concatenate([points[:-1], points[1:]], axis=1)[follows]
        geometry = ours.features.segment_of[segment[1:][follows]]
        return pieces, np.stack([geometry, against[1:][follows]])


def _segments(found: Integers, count: int) -> Integers:
    """Without the objects of a tree that are none of its segments."""
    return found[:, found[1] < count]


def _at_own_ends(ours: Layer, theirs: Layer) -> Integers:
    """Segments that meet lines in a point of their own boundary, which then is no point of their interior: it is an end
    of another line of the same geometry."""
    ends = ours.boundary.features
    end, segment = _segments(ours.tree.locate(ends.points).pairs(), len(ours.features.segments))
    own = ends.point_of[end] == ours.features.segment_of[segment]
    end, segment = end[own], segment[own]
    at, other = _segments(theirs.tree.locate(ends.points[end]).pairs(), len(theirs.features.segments))
    of_line = theirs.dims[theirs.features.segment_of[other]] == 1
    return np.stack([segment[at[of_line]], other[of_line]])


def interiors(asked: Layer, kept: Layer, meetings: Meetings) -> Integers:
    """Pairs of geometries whose interiors have a point in common."""
    found = joined(
        meetings.crossing,
        _of_dims(meetings.runs(), asked, kept, 1, 1),
        _corners(asked, kept),
        turned(_corners(kept, asked)),
    )
    found = joined(found, _passing(asked, kept, meetings, False, found))
    found = joined(found, turned(_passing(kept, asked, meetings, True, turned(found))))
    return joined(found, _covering(asked, kept))


def _of_dims(found: Integers, ours: Layer, theirs: Layer, one: int, other: int) -> Integers:
    return found[:, (ours.dims[found[0]] == one) & (theirs.dims[found[1]] == other)]


def _inner(points: Floats, layer: Layer) -> Integers:
    """Points that lie in the interior of a geometry of the layer, and that geometry."""
    return without(layer.tree.groups(points).pairs(), layer.boundary.tree.groups(points).pairs())


def _corners(ours: Layer, theirs: Layer) -> Integers:
    """Pairs in which a corner of the first lies in the interior of the second. It need not be in the interior of the
    first where points of that are beside it."""
    corners, owner = ours.features.corners()
    found = _inner(corners, theirs)
    one, other = ours.dims[owner[found[0]]], theirs.dims[found[1]]
    at_end = _own_ends(ours, corners, owner)[found[0]]
    use = (one <= other) & ~((one == 1) & (other == 1) & at_end)
    return pairs(owner[found[0, use]], found[1, use])


def _own_ends(layer: Layer, corners: Floats, owner: Integers) -> npt.NDArray[np.bool_]:
    """Which corners are in the boundary of their own geometry?"""
    ends = np.zeros(len(corners), bool)
    found = layer.boundary.tree.groups(corners).pairs()
    ends[found[0, owner[found[0]] == found[1]]] = True
    return ends


def _passing(ours: Layer, theirs: Layer, meetings: Meetings, turn: bool, known: Integers) -> Integers:
    """Pairs, but for those known, in which a segment of the first goes through the interior of the second, a polygon,
    from one place to another."""
    pieces, owners = meetings.pieces(turn)
    of_polygon = (ours.dims[owners[0]] >= 1) & (theirs.dims[owners[1]] == 2)
    wanted = np.flatnonzero(of_polygon & ~among(owners, known))
    covered = theirs.tree.query_groups(segments=pieces[wanted], relation="covers").pairs()
    covered = covered[:, covered[1] == owners[1, wanted[covered[0]]]]
    on_rings = theirs.boundary.tree.query_groups(segments=pieces[wanted], relation="covers").pairs()
    found = wanted[without(covered, on_rings)[0]]
    return pairs(*owners[:, found])


def _covering(asked: Layer, kept: Layer) -> Integers:
    """Pairs in which a polygon of one covers a polygon of the other."""
    ours, our_geometry = asked.polygons
    theirs, their_geometry = kept.polygons
    found = joined(
        theirs.tree.join_groups(ours.tree, relation="covers").pairs(),
        theirs.tree.join_groups(ours.tree, relation="within").pairs(),
    )
    return pairs(our_geometry[found[0]], their_geometry[found[1]])
