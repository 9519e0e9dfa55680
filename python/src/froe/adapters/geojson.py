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
from collections.abc import Mapping, Sequence
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
    :raises ValueError: it is not GeoJSON, or a coordinate is a whole number that float64 does not have
    :cost: O(size of it), in a loop over the features; ``froe.read`` reads large files many times as fast
    """
    from froe.scene_parts import Crs

    is_file = isinstance(source, (str, os.PathLike))
    if is_file:
        source = json.loads(Path(source).read_text(encoding="utf-8-sig"))
    source = getattr(source, "__geo_interface__", source)
    features = _member(source, "features", Sequence) if _type(source) == "FeatureCollection" else [source]
    rows = [_row(one) for one in features]
    labels = None if names is None else [str(properties.get(names, "")) for _, properties in rows]
    scene = of_mappings([geometry for geometry, _ in rows]).scene(labels)
    if is_file and "crs" not in source:
        scene.crs = Crs("geographic", "WGS 84", "OGC:CRS84", "degree")
    return scene


def _member(of: Any, name: str, kind: type) -> Any:
    found = of.get(name) if isinstance(of, Mapping) else None
    if not isinstance(found, kind):
        raise ValueError(f"This is not GeoJSON: '{name}' is missing or of another type.")
    return found


def _type(of: Any) -> str:
    found: str = _member(of, "type", str)
    return found


def _row(feature: Any) -> tuple[Any, Mapping[str, Any]]:
    """The geometry of a feature, and its properties."""
    if _type(feature) != "Feature":
        return feature, {}
    if "geometry" not in feature:
        raise ValueError("This is not GeoJSON: 'geometry' is missing or of another type.")
    return feature["geometry"], _member(feature, "properties", Mapping) if feature.get("properties") else {}
