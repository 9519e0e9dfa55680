"""What a tree consists of, as arrays."""

from __future__ import annotations

from dataclasses import dataclass
from typing import SupportsIndex

import numpy as np
import numpy.typing as npt

from ._arrays import Doubles, Ids, part


@dataclass(frozen=True, eq=False)
class Pieces:
    """The pieces of a tree. The corners of piece ``i`` are ``coords[starts[i]:starts[i + 1]]``, which is ``pieces[i]``.

    :ivar objects: the object that each is a part of
    :ivar nodes: the node in whose list each is
    :ivar whole: 1 where nothing of the object was cut off
    :ivar starts: one more than pieces
    :ivar coords: (corners, dim), rounded to the nearest doubles where cuts made them
    :ivar made: of the edge that leaves each corner, the node whose cut made it, or -1
    """

    objects: Ids
    nodes: Ids
    whole: npt.NDArray[np.uint8]
    starts: npt.NDArray[np.int64]
    coords: Doubles
    made: Ids

    def __len__(self) -> int:
        return len(self.objects)

    def __getitem__(self, piece: SupportsIndex) -> Doubles:
        """The corners of a piece."""
        return part(self.coords, self.starts, piece, "piece")


@dataclass(frozen=True, eq=False)
class Cells:
    """Regions of nodes. Cell ``i`` has the faces ``faces[i]`` to ``faces[i + 1] - 1``, and face ``f`` the corners
    ``coords[starts[f]:starts[f + 1]]``. In the plane every cell is one face.

    :ivar nodes: the node of each cell
    :ivar depths: the number of cuts on the way to each cell
    :ivar faces: one more than cells
    :ivar starts: one more than faces
    :ivar coords: (corners, dim), rounded
    """

    nodes: Ids
    depths: Ids
    faces: npt.NDArray[np.int64]
    starts: npt.NDArray[np.int64]
    coords: Doubles

    @property
    def dim(self) -> int:
        """2 or 3."""
        return int(self.coords.shape[1])

    def __len__(self) -> int:
        return len(self.nodes)

    def polygons(self) -> list[Doubles]:
        """The corners of each face, as a list of arrays (corners, dim).

        :cost: O(faces)
        :raises: nothing

        >>> import froe
        >>> tree = froe.segments([[0, 1, 2, 1]]).build("autopartition", leaf=0)
        >>> [len(corners) for corners in tree.cells([0, 0], [2, 2]).polygons()]
        [4, 4]
        """
        return [self.coords[a:b] for a, b in zip(self.starts[:-1], self.starts[1:])]
