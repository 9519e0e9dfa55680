"""GeoJSON as scenes, without any other library.

>>> import froe
>>> square = {"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]]]}
>>> feature = {"type": "Feature", "properties": {"name": "a square"}, "geometry": square}
>>> tree = froe.from_geojson(feature, names="name").build()
>>> tree.groups([[0.5, 0.5], [1.5, 0.5]]).pairs().tolist()
[[0], [0]]
"""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

from froe.adapters.features import of_mappings

if TYPE_CHECKING:
    from froe.scene import Scene


def from_geojson(source: Any, names: str | None = None) -> Scene:
    """A scene of the plane from GeoJSON (RFC 7946). Feature ``i`` is group ``i``, as in :func:`froe.from_shapely`.

    :param source: a path, a mapping, or an object with ``__geo_interface__``
    :param names: the property that names the groups
    :returns: a scene; that of a file without the member ``crs`` has the coordinate system WGS 84
    :raises ValueError: it is not GeoJSON
    :cost: O(size of it), in a loop over the features; ``froe.read`` reads large files many times as fast
    """
    from froe.scene_parts import Crs

    is_file = isinstance(source, (str, os.PathLike))
    if is_file:
        source = json.loads(Path(source).read_text(encoding="utf-8"))
    source = getattr(source, "__geo_interface__", source)
    try:
        features = source["features"] if source["type"] == "FeatureCollection" else [source]
        rows = [(one["geometry"], one.get("properties") or {}) if one["type"] == "Feature" else (one, {})
                for one in features]
    except (KeyError, TypeError) as why:
        raise ValueError(f"This is not GeoJSON: {why} is missing or of another type.") from why
    labels = None if names is None else [str(properties.get(names, "")) for _, properties in rows]
    scene = of_mappings([geometry for geometry, _ in rows]).scene(labels)
    if is_file and "crs" not in source:
        scene.crs = Crs("geographic", "WGS 84", "OGC:CRS84", "degree")
    return scene
