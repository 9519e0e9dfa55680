"""What a scene consists of, and how it was read."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from ._arrays import Doubles, Ids


@dataclass(frozen=True)
class Group:
    """What the objects of one feature, mesh or layer of a file have in common.

    :ivar name: its name, for example that of a country; "" where the file has none
    :ivar material: of a mesh its material, of a map the layer
    :ivar left, right: what is on the left and on the right of its segments, where the file says so; otherwise ""
    :ivar colour: 0xRRGGBBAA, or 0 where it is unknown
    """

    name: str
    material: str
    left: str
    right: str
    colour: int


@dataclass(frozen=True)
class Crs:
    """A coordinate reference system. Scenes carry it, files keep it, and no number is ever changed by it.

    :ivar kind: ``"geographic"``: longitudes and latitudes in degrees; ``"projected"``: lengths on a map; ``"other"``
    :ivar name: for example ``"WGS 84 / UTM zone 32N"``
    :ivar code: authority and number, for example ``"EPSG:32632"``; empty: unknown
    :ivar unit: of the coordinates, for example ``"metre"``
    :ivar wkt: the definition, WKT 2 (ISO 19162:2019); empty: unknown
    """

    kind: Literal["geographic", "projected", "other"]
    name: str = ""
    code: str = ""
    unit: str = ""
    wkt: str = ""


@dataclass(frozen=True, eq=False)
class SceneArrays:
    """A whole scene as arrays. Object ``i`` has the vertices ``corners[starts[i]:starts[i + 1]]``, whose places are the
    rows of ``coords`` with these numbers.

    :ivar coords: (vertices, dim) places; equal places are one vertex
    :ivar kinds: of each object, as it was added: 0 point, 1 segment, 2 polygon, 3 box, 4 ball, 5 hull
    :ivar forms: of each object, as it is: a segment without length is a point (0)
    :ivar starts: one more than objects
    :ivar corners: numbers of vertices; of a box its lower and upper corner, of a ball its centre
    :ivar radii: of each object, 0 except for balls
    :ivar tags: of each object, the number that the caller gave it, or its own
    :ivar faces: of each object, the polygon that it is a part of, or -1
    :ivar groups: of each object, its group, or -1
    """

    coords: Doubles
    kinds: npt.NDArray[np.uint8]
    forms: npt.NDArray[np.uint8]
    starts: npt.NDArray[np.int64]
    corners: Ids
    radii: Doubles
    tags: npt.NDArray[np.uint64]
    faces: Ids
    groups: Ids


@dataclass(frozen=True)
class ReadReport:
    """How a file was read. Nothing is done to a scene that is not counted here.

    :ivar format: for example ``"GeoJSON"``
    :ivar precision: of the coordinates as they were read, ``"float64"`` or ``"float32"``
    :ivar features: features, rows, or named parts of a model
    :ivar groups: groups of the scene
    :ivar triangulated: polygons of more than three corners that were split into triangles
    :ivar closed: rings whose last edge was missing and was added
    :ivar skipped: geometries that are empty, of no known type, or lines of one point
    :ivar no_geometry: features without geometry
    :ivar wrapped: features that were cut at the antimeridian
    :ivar unread_library: of OBJ the first file of materials that is missing or unreadable, otherwise ""
    :ivar no_degrees: the format promises longitudes and latitudes, and the numbers are none (beyond 180 or 90)
    """

    format: str
    precision: str
    features: int
    groups: int
    triangulated: int
    closed: int
    skipped: int
    no_geometry: int
    wrapped: int
    unread_library: str
    no_degrees: bool
