"""froe: binary space partitions, exact to the last bit. Questions to maps and models, and drawings of models.

>>> import froe
>>> tree = froe.segments([[0, 0, 2, 2], [3, 0, 3, 2]]).build()
>>> tree.query([[0, 0, 1, 1], [0, 0, 3, 3]]).counts().tolist()
[1, 2]
"""

from . import _selftest, errors, measure
from ._core import version as __version__
from .adapters.geojson import from_geojson
from .adapters.geopandas import from_geopandas
from .adapters.meshes import from_pyvista, from_trimesh
from .adapters.shapely import from_shapely, to_shapely
from .answers import Answers
from .errors import Error
from .motion import Contacts, Events, Kinetic, Motion, Snapshot, generate_motion, read_motion, read_poses
from .parts import Cells, Pieces
from .pictures import Picture, RenderReport
from .report import Promise, Report
from .scene import (
    Scene,
    boxes,
    compare,
    generate,
    points,
    read,
    segments,
    triangles,
)
from .scene_parts import Crs, Group, ReadReport, SceneArrays
from .tree import Tree, open

__all__ = [
    "Answers",
    "Cells",
    "Contacts",
    "Crs",
    "Error",
    "Events",
    "Group",
    "Kinetic",
    "Motion",
    "Picture",
    "Pieces",
    "Promise",
    "ReadReport",
    "RenderReport",
    "Report",
    "Scene",
    "SceneArrays",
    "Snapshot",
    "Tree",
    "boxes",
    "compare",
    "errors",
    "from_geojson",
    "from_geopandas",
    "from_pyvista",
    "from_shapely",
    "from_trimesh",
    "generate",
    "generate_motion",
    "measure",
    "open",
    "points",
    "read",
    "read_motion",
    "read_poses",
    "segments",
    "to_shapely",
    "triangles",
    "__version__",
]

_selftest.check()
