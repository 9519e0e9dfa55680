"""The index of shapely 2, ``shapely.STRtree``, with answers about the geometries themselves, decided exactly.

>>> from shapely.geometry import LineString, Point, box
>>> from froe.compat.shapely import STRtree
>>> tree = STRtree([LineString([(0, 0), (4, 4)]), box(3, 0, 5, 1)])
>>> tree.query(box(0, 3, 1, 4)).tolist()  # boxes, as in shapely: that of the line meets it
[0]
>>> tree.query(box(0, 3, 1, 4), predicate="intersects").tolist()  # the line does not
[]
>>> tree.query([Point(1, 1), Point(4, 0)], predicate="intersects").tolist()
[[0, 1], [0, 1]]
>>> tree.query_nearest(Point(5, 2), return_distance=True)
(array([1]), array([1.]))
"""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from froe._arrays import doubles
from froe.adapters.features import Features
from froe.adapters.shapely import features, is_one
from froe.compat.nearest import Nearest
from froe.compat.relations import Relations

Floats = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]


class STRtree:
    """Takes the place of ``shapely.STRtree``. Geometries of shapely 1.8 will do as well.

    Answers have the shapes that those of shapely 2 have: indices for one geometry, two rows of indices for an array
    of them. They are sorted by the geometries asked for, then by those of the tree. Missing and empty geometries
    match nothing.

    Predicates are decided exactly, as OGC Simple Features defines them; nothing falls back to rounding. Collections of
    several dimensions have no interior there, and raise ``froe.errors.UnsupportedError`` where it matters. Polygons
    count by parity, so that what two polygons of one geometry both cover is outside, as it would be in a hole.
    """

    def __init__(self, geoms: Any, node_capacity: int = 10) -> None:
        self._geometries = _array(geoms)
        self._geometries.flags.writeable = False
        self._features = features(self._geometries)

    def __len__(self) -> int:
        return int(np.count_nonzero(~np.isnan(self._bounds[:, 0])))

    def __reduce__(self) -> tuple[Any, ...]:
        return STRtree, (self._geometries,)

    @property
    def geometries(self) -> npt.NDArray[np.object_]:
        """The geometries of the tree, in the order of their indices.

        >>> from froe.compat.shapely import STRtree
        >>> from shapely.geometry import Point
        >>> STRtree([Point(0, 3)]).geometries[0].y
        3.0
        """
        return self._geometries

    @cached_property
    def _bounds(self) -> Floats:
        return self._features.bounds()

    @cached_property
    def _relations(self) -> Relations:
        return Relations(self._features)

    @cached_property
    def _nearest(self) -> Nearest:
        return Nearest(self._relations)

    def query(self, geometry: Any, predicate: str | None = None, distance: Any = None) -> Integers:
        """The geometries of the tree that ``predicate(geometry, tree_geometry)`` holds for.

        :param geometry: one geometry, or an array of them
        :param predicate: None: their bounding boxes meet; otherwise the name of a predicate of ``shapely.STRtree``
        :param distance: for ``"dwithin"``: a number, or one for each geometry
        :returns: indices (m,) for one geometry, and (2, m) for an array: those of geometries, and of geometries of the
            tree
        :raises ValueError: there is no such predicate, or ``"dwithin"`` has no distance
        :raises UnsupportedError: the interior of a collection of several dimensions would decide
        :cost: that of ``Tree.query`` for bounding boxes, of ``Tree.join_groups`` for predicates

        >>> from froe.compat.shapely import STRtree
        >>> from shapely.geometry import LineString, box
        >>> tree = STRtree([box(0, 0, 4, 4), box(4, 0, 8, 4), LineString([(0, 0), (8, 4)])])
        >>> tree.query(box(0, 0, 4, 4), predicate="touches").tolist()
        [1]
        >>> tree.query([box(0, 0, 4, 4), LineString([(1, 0), (1, 4)])], predicate="crosses").tolist()
        [[0, 1], [2, 2]]
        >>> tree.query(box(9, 3, 9, 4), predicate="dwithin", distance=1).tolist()
        [1, 2]
        """
        single, asked = _asked(geometry)
        if predicate == "dwithin":
            if distance is None:
                raise ValueError("The predicate dwithin needs a distance.")
            distances = np.broadcast_to(doubles(distance, "distance"), (asked.count,))
            found = self._relations.within_distance(asked, distances)
        else:
            found = self._relations.related(asked, predicate)
        indices: Integers = found[1] if single else found
        return indices

    def nearest(self, geometry: Any) -> Any:
        """The nearest geometry of the tree to each geometry, of several the first.

        :param geometry: one geometry, or an array of them
        :returns: an index, or (n,) for an array; None where the tree is empty
        :raises ValueError: a geometry is missing or empty
        :cost: that of ``Tree.nearest`` for the corners of each geometry

        >>> from froe.compat.shapely import STRtree
        >>> from shapely.geometry import Point
        >>> int(STRtree([Point(0, 0), Point(5, 5)]).nearest(Point(4, 4)))
        1
        """
        if len(self) == 0:
            return None
        single, asked = _asked(geometry)
        if np.isnan(asked.bounds()).any():
            raise ValueError("A missing or empty geometry has no nearest one.")
        found, _ = self._nearest.nearest(asked, None)
        first = found[1][np.unique(found[0], return_index=True)[1]]
        return first[0] if single else first

    def query_nearest(
        self,
        geometry: Any,
        max_distance: float | None = None,
        return_distance: bool = False,
        exclusive: bool = False,
        all_matches: bool = True,
    ) -> Any:
        """The geometries of the tree that are nearest to each geometry. That two are equally near is decided exactly.

        :param geometry: one geometry, or an array of them
        :param max_distance: those farther away do not count
        :param return_distance: also the distances
        :param exclusive: pass over those that are the same set of points as the geometry
        :param all_matches: all that are equally near; otherwise the first of them
        :returns: indices as ``query`` returns them; with ``return_distance`` also their distances (m,), the doubles
            nearest to the exact ones
        :raises ValueError: ``max_distance`` is not above 0
        :cost: that of ``Tree.nearest`` for the corners of each geometry

        >>> from froe.compat.shapely import STRtree
        >>> from shapely.geometry import LineString, Point
        >>> points = [Point(0, 0), Point(0, 3), Point(9, 9)]
        >>> STRtree(points).query_nearest(points, exclusive=True, max_distance=5).tolist()
        [[0, 1], [1, 0]]
        >>> STRtree(points).query_nearest(LineString([(5, 0), (9, 4)]), return_distance=True)
        (array([0, 2]), array([5., 5.]))
        """
        if max_distance is not None and not max_distance > 0:
            raise ValueError("max_distance must be greater than 0.")
        single, asked = _asked(geometry)
        found, distances = self._nearest.nearest(asked, max_distance, exclusive)
        if not all_matches:
            first = np.unique(found[0], return_index=True)[1]
            found, distances = found[:, first], distances[first]
        indices = found[1] if single else found
        return (indices, distances) if return_distance else indices


def _array(geometries: Any) -> npt.NDArray[np.object_]:
    """One dimension of objects. (numpy takes some geometries of shapely 1.8 for sequences.)"""
    given = list(geometries)
    array = np.empty(len(given), object)
    for i, geometry in enumerate(given):
        array[i] = geometry
    return array


def _asked(geometry: Any) -> tuple[bool, Features]:
    single = geometry is None or is_one(geometry)
    return single, features(_array([geometry] if single else geometry))
