"""Geometries of shapely as scenes, and cells of trees as geometries of shapely. Shapely 1.8 and 2 will do.

>>> import froe
>>> from shapely.geometry import Point, Polygon
>>> scene = froe.from_shapely([Polygon([(0, 0), (4, 0), (0, 4)]), Point(1, 1)])
>>> tree = scene.build()
>>> tree.groups([[1, 1], [3, 3]]).pairs().tolist()
[[0, 0], [0, 1]]
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from froe.adapters.features import Features, of_mappings

if TYPE_CHECKING:
    from froe.parts import Cells
    from froe.scene import Scene

_POINT, _POLYGON, _SIMPLE = 0, 3, 3  # of shapely.get_type_id(): types above are collections


def from_shapely(geometries: Any, names: Sequence[str] | None = None) -> Scene:
    """A scene of the plane. Points become points; lines, and the rings of polygons, become segments. Geometry ``i`` is
    group ``i``, so that ``tree.groups(points)`` says which geometries contain a point, and each of its objects has the
    tag ``i``.

    :param geometries: one geometry, or an array or sequence of them; None and empty ones have no objects, and third
        coordinates are left out
    :param names: names of the groups
    :raises ValueError: something is no geometry
    :cost: O(coordinates), with shapely 1.8 in a loop over the geometries
    """
    return features(geometries).scene(names)


def is_one(geometries: Any) -> bool:
    """Is this one geometry? A column of geopandas has a ``geom_type``, too, which is a column."""
    return isinstance(getattr(geometries, "geom_type", None), str)


def features(geometries: Any) -> Features:
    """The same as arrays: at once with shapely 2, geometry by geometry with shapely 1.8."""
    import shapely

    if is_one(geometries):
        geometries = [geometries]
    if hasattr(shapely, "get_parts"):
        return _of_arrays(shapely, geometries)
    return of_mappings(geometries)


def _of_arrays(shapely: Any, geometries: Any) -> Features:
    """By the functions of shapely 2 for whole arrays."""
    array = np.array(geometries, object).ravel()  # a copy: shapely 2.0 takes no read-only array
    parts, owner = shapely.get_parts(array, return_index=True)
    while len(parts) and (shapely.get_type_id(parts) > _SIMPLE).any():  # collections within collections
        parts, index = shapely.get_parts(parts, return_index=True)
        owner = owner[index]
    kinds = shapely.get_type_id(parts)
    point, polygon = kinds == _POINT, kinds == _POLYGON
    line = ~point & ~polygon

    corners, index = shapely.get_coordinates(parts[point], return_index=True)
    line_corners, line_index = shapely.get_coordinates(parts[line], return_index=True)
    rings, ring_polygon = shapely.get_rings(parts[polygon], return_index=True)
    ring_corners, ring_index = shapely.get_coordinates(rings, return_index=True)
    return Features.of_chains(
        len(array),
        (corners, owner[point][index]),
        (line_corners, line_index, owner[line]),
        (ring_corners, ring_index, ring_polygon, owner[polygon]),
    )


def to_shapely(cells: Cells) -> list[Any]:
    """The cells of a tree of the plane as polygons. Their corners are rounded.

    :param cells: what ``tree.cells()`` returns
    :raises ValueError: the cells are not those of a tree of the plane
    :cost: O(corners)

    >>> import froe
    >>> tree = froe.segments([[0, 1, 2, 1]]).build("autopartition", leaf=0)
    >>> [cell.area for cell in froe.to_shapely(tree.cells([0, 0], [2, 2]))]
    [2.0, 2.0]
    """
    from shapely.geometry import Polygon

    if cells.dim != 2:
        raise ValueError("The cells are not those of a tree of the plane.")
    return [Polygon(corners) for corners in cells.polygons()]
