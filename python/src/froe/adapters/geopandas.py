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
    from froe.scene import Scene


def from_geopandas(table: Any, names: str | None = None) -> Scene:
    """A scene of the plane from a GeoDataFrame or GeoSeries. Row ``i``, by position, is group ``i``, as in
    :func:`froe.from_shapely`.

    :param table: the GeoDataFrame or GeoSeries
    :param names: the column that names the groups
    :raises KeyError: there is no such column
    :cost: that of ``from_shapely``
    """
    labels = None if names is None else [str(label) for label in table[names]]
    return features(np.asarray(table.geometry, object)).scene(labels)
