"""Geometries of the plane as arrays: what the adapters of maps have in common.

A geometry may be of any type of OGC Simple Features. It becomes points, lines as segments, and polygons as the segments
of their rings. A third coordinate is left out, as the predicates of GEOS leave it out.
"""

from __future__ import annotations

import reprlib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from froe._arrays import EXACT

if TYPE_CHECKING:
    from froe.scene import Scene

Floats = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]

_PARTS = {"MultiPoint": "Point", "MultiLineString": "LineString", "MultiPolygon": "Polygon"}


@dataclass(frozen=True, eq=False)
class Features:
    """The points and segments of ``count`` geometries.

    :ivar count: number of geometries, with those that are missing or empty
    :ivar points: ``(p, 2)``
    :ivar point_of: the geometry of each point
    :ivar segments: ``(s, 4)``, those of a line or ring one after the other
    :ivar segment_of: the geometry of each segment
    :ivar chain_of: the line or ring of each segment
    :ivar polygon_of: the polygon of each segment, -1 for those of lines
    """

    count: int
    points: Floats
    point_of: Integers
    segments: Floats
    segment_of: Integers
    chain_of: Integers
    polygon_of: Integers

    @classmethod
    def of_chains(
        cls,
        count: int,
        points: tuple[Floats, Integers],
        lines: tuple[Floats, Integers, Integers],
        rings: tuple[Floats, Integers, Integers, Integers],
    ) -> Features:
        """From points and the geometry of each; the corners of lines, the line of each corner, the geometry of each
        line; the corners of rings, the ring of each corner, the polygon of each ring, the geometry of each polygon."""
        line_segments, line = _joined(lines[0], lines[1])
        ring_segments, ring = _joined(rings[0], rings[1])
        polygon = rings[2][ring]
        return cls(
            count,
            points[0],
            points[1],
            np.concatenate([line_segments, ring_segments]),
            np.concatenate([lines[2][line], rings[3][polygon]]),
            np.concatenate([line, ring + len(lines[2])]),
            np.concatenate([np.full(len(line), -1, np.int64), polygon]),
        )

    def scene(self, names: Sequence[str] | None = None) -> Scene:
        """A scene in which each geometry is a group, and its number the tag of its objects."""
        from froe.scene import Scene

        scene = Scene(2)
        for number in range(self.count):
            scene.add_group("" if names is None else str(names[number]))
        if len(self.segments):
            of_line = self.polygon_of < 0
            faces = self.polygon_of.copy()  # segments of one polygon share a face, each other one has its own
            faces[of_line] = np.arange(np.count_nonzero(of_line)) + (faces.max(initial=-1) + 1)
            scene.add_segments(self.segments, tags=self.segment_of, groups=self.segment_of, faces=faces)
        if len(self.points):
            scene.add_points(self.points, tags=self.point_of, groups=self.point_of)
        flat, flat_of = self.flat()
        if len(flat):
            scene.add_segments(flat, tags=flat_of, groups=flat_of, faces=flat_of + len(self.segments))
        return scene

    def flat(self) -> tuple[Floats, Integers]:
        """Two segments for each geometry that has lines and no polygon: its first segment that has a length, there and
        back, which are the border of a polygon without area. A group with such a border is no area, though its lines
        may close."""
        long = np.flatnonzero((self.segments[:, :2] != self.segments[:, 2:]).any(axis=1))
        geometry, first = np.unique(self.segment_of[long], return_index=True)
        first = long[first[~self.areas()[geometry]]]
        back = self.segments[first][:, [2, 3, 0, 1]]
        both = np.stack([self.segments[first], back], axis=1).reshape(-1, 4)
        return both, np.repeat(self.segment_of[first], 2)

    def owners(self) -> Integers:
        """The geometry of each object of the scene."""
        return np.concatenate([self.segment_of, self.point_of, self.flat()[1]])

    def anchors(self) -> tuple[Floats, Integers]:
        """A point of every connected part of each geometry's points, lines and borders, and the geometry of each."""
        first = np.flatnonzero(np.diff(self.chain_of, prepend=-1))
        return (
            np.concatenate([self.points, self.segments[first, :2]]),
            np.concatenate([self.point_of, self.segment_of[first]]),
        )

    def corners(self) -> tuple[Floats, Integers]:
        """All points and ends of segments, and the geometry of each."""
        return (
            np.concatenate([self.points, self.segments[:, :2], self.segments[:, 2:]]),
            np.concatenate([self.point_of, self.segment_of, self.segment_of]),
        )

    def bounds(self) -> Floats:
        """``(count, 4)``: the least and the largest coordinates of each geometry; NaN where it is empty."""
        corners, owner = self.corners()
        order = np.argsort(owner, kind="stable")
        found, first = np.unique(owner[order], return_index=True)
        bounds = np.full((self.count, 4), np.nan)
        if len(found):
            bounds[found, :2] = np.minimum.reduceat(corners[order], first)
            bounds[found, 2:] = np.maximum.reduceat(corners[order], first)
        return bounds

    def kinds(self) -> npt.NDArray[np.bool_]:
        """``(3, count)``: has the geometry points, lines, polygons?"""
        found = np.zeros((3, self.count), bool)
        found[0, self.point_of] = True
        found[1, self.segment_of[self.polygon_of < 0]] = True
        found[2, self.segment_of[self.polygon_of >= 0]] = True
        return found

    def areas(self) -> npt.NDArray[np.bool_]:
        """Has the geometry a polygon?"""
        found: npt.NDArray[np.bool_] = self.kinds()[2]
        return found

    def boundary(self) -> Features:
        """Of each geometry the rings of its polygons as lines, and the ends of an odd number of its lines."""
        rings = self.polygon_of >= 0
        ends, end_of = self._ends()
        return Features(
            self.count,
            ends,
            end_of,
            self.segments[rings],
            self.segment_of[rings],
            self.chain_of[rings],
            np.full(np.count_nonzero(rings), -1, np.int64),
        )

    def _ends(self) -> tuple[Floats, Integers]:
        lines = np.flatnonzero(self.polygon_of < 0)
        chain = self.chain_of[lines]
        first, last = lines[np.diff(chain, prepend=-1) != 0], lines[np.diff(chain, append=-1) != 0]
        ends = np.concatenate([self.segments[first, :2], self.segments[last, 2:]])
        geometry = np.concatenate([self.segment_of[first], self.segment_of[last]])
        rows = np.column_stack([geometry, ends])
        found, times = np.unique(rows, axis=0, return_counts=True)
        odd = found[times % 2 == 1]
        return odd[:, 1:], odd[:, 0].astype(np.int64)

    def polygons(self) -> tuple[Features, Integers]:
        """Each polygon as a geometry of its own, and the geometry that it is a part of."""
        rings = np.flatnonzero(self.polygon_of >= 0)
        owner, first, polygon = np.unique(self.polygon_of[rings], return_index=True, return_inverse=True)
        nothing = np.empty((0, 2)), np.empty(0, np.int64)
        features = Features(
            len(owner), *nothing, self.segments[rings], polygon, self.chain_of[rings], polygon.astype(np.int64)
        )
        return features, self.segment_of[rings[first]]


def _joined(corners: Floats, chain: Integers) -> tuple[Floats, Integers]:
    """The segments between neighbouring corners of one chain, and the chain of each."""
    same = chain[1:] == chain[:-1]
    return np.concatenate([corners[:-1], corners[1:]], axis=1)[same], chain[:-1][same]


def _refuse_rounded(coordinates: Any) -> None:
    """Whole numbers that are no doubles: numpy rounds them without a word."""
    for corner in coordinates:
        for number in corner[:2]:
            if isinstance(number, (int, np.integer)) and int(number) != int(float(number)):
                raise ValueError(f"it has the number {number}, which float64 cannot hold")


class _Chains:
    """Corners of chains as they come, one chain after the other."""

    def __init__(self) -> None:
        self.corners: list[Floats] = []
        self.owners: list[int] = []

    def add(self, coordinates: Any, owner: int) -> None:
        try:
            corners = np.asarray(coordinates)
        except ValueError:  # some places have heights, others have none
            corners = np.asarray([corner[:2] for corner in coordinates])
        if corners.size:
            if corners.dtype.kind not in "fiu":
                raise ValueError(f"its coordinates are of the type {corners.dtype}")
            if corners.ndim != 2 or corners.shape[1] < 2:
                raise ValueError(f"its coordinates have the shape {corners.shape}, and (n, 2) or (n, 3) is needed")
            places = corners[:, :2].astype(np.float64)
            if (np.abs(places) >= EXACT).any():
                _refuse_rounded(coordinates)
            self.corners.append(places)
            self.owners.append(owner)

    def arrays(self) -> tuple[Floats, Integers, Integers]:
        lengths = [len(corners) for corners in self.corners]
        return (
            np.concatenate([np.empty((0, 2)), *self.corners]),
            np.repeat(np.arange(len(lengths)), lengths),
            np.array(self.owners, np.int64),
        )


def of_mappings(geometries: Iterable[Any]) -> Features:
    """From geometries as GeoJSON describes them: mappings, objects with ``__geo_interface__``, or None."""
    points, lines, rings = _Chains(), _Chains(), _Chains()
    polygons: list[int] = []
    count = 0
    for number, geometry in enumerate(geometries):
        count += 1
        waiting = [geometry]
        while waiting:
            part = waiting.pop()
            if part is None or getattr(part, "is_empty", False):
                continue
            try:
                part = getattr(part, "__geo_interface__", part)
                kind = part["type"]
                if kind == "GeometryCollection":
                    waiting.extend(reversed(part["geometries"]))
                elif kind in _PARTS:
                    waiting.extend({"type": _PARTS[kind], "coordinates": one} for one in reversed(part["coordinates"]))
                elif kind == "Point":
                    points.add([part["coordinates"]] if len(part["coordinates"]) else [], number)
                elif kind in ("LineString", "LinearRing"):
                    lines.add(part["coordinates"], number)
                elif kind == "Polygon":
                    for ring in part["coordinates"]:
                        rings.add(ring, len(polygons))
                    polygons.append(number)
                else:
                    raise ValueError(f"its type is {kind!r}")
            except (KeyError, TypeError, ValueError, IndexError) as why:
                reason = why if isinstance(why, ValueError) else f"it is {reprlib.repr(part)}"
                raise ValueError(f"Object {number} is not a geometry: {reason}.") from why
    corners, _, owners = points.arrays()
    return Features.of_chains(
        count, (corners, owners), lines.arrays(), (*rings.arrays(), np.array(polygons, np.int64))
    )
