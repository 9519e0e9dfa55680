"""Tables of geopandas as scenes, with a group for each row.

>>> import froe, geopandas
>>> from shapely.geometry import box
>>> towns = geopandas.GeoDataFrame({"name": ["A", "B"]}, geometry=[box(0, 0, 1, 1), box(1, 0, 2, 1)])
>>> tree = froe.from_geopandas(towns, names="name").build()
>>> tree.groups([[0.5, 0.5], [1, 0.5]]).pairs().tolist()
[[0, 1, 1], [0, 0, 1]]
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from froe.adapters.shapely import features

if TYPE_CHECKING:
    from froe.scene_parts import Crs
    from froe.scene import Scene


def from_geopandas(table: Any, names: str | None = None) -> Scene:
    """A scene of the plane from a GeoDataFrame or GeoSeries. Row ``i``, by position, is group ``i``, as in
    :func:`froe.from_shapely`.

    :param table: the GeoDataFrame or GeoSeries
    :param names: the column that names the groups
    :raises KeyError: there is no such column
    :returns: a scene with the coordinate system of the table
    :cost: that of ``from_shapely``
    """
    labels = None if names is None else [str(label) for label in table[names]]
    scene = features(np.asarray(table.geometry, object)).scene(labels)
    scene.crs = _crs(getattr(table, "crs", None))
    return scene


def _crs(found: Any) -> Crs | None:
    """From a coordinate system of pyproj, as geopandas has them."""
    from froe.scene_parts import Crs

    if found is None:
        return None
    axes = [axis.unit_name for axis in found.axis_info[:1]]
    return Crs(
        "geographic" if found.is_geographic else "projected" if found.is_projected else "other",
        name=found.name,
        code=":".join(found.to_authority() or ()),
        unit=axes[0] if axes else "",
        wkt=found.to_wkt("WKT2_2019"),
    )
