"""froe: binary space partitions, exact to the last bit. Questions to maps and models, and drawings of models.

>>> import froe
>>> tree = froe.segments([[0, 0, 2, 2], [3, 0, 3, 2]]).build()
>>> tree.query([[0, 0, 1, 1], [0, 0, 3, 3]]).counts().tolist()
[1, 2]
"""

from . import errors
from ._core import version as __version__
from .answers import Answers
from .errors import Error
from .scene import Scene, segments
from .tree import Tree

__all__ = ["Answers", "Error", "Scene", "Tree", "errors", "segments", "__version__"]
