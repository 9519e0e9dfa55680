"""Trees: questions to scenes."""

from __future__ import annotations

import numpy.typing as npt

from . import _core
from ._arrays import doubles
from .answers import Answers


class Tree:
    """A binary space partition of a scene. Made by ``Scene.build``."""

    def __init__(self, core: _core.Tree) -> None:
        self._core = core

    def query(self, boxes: npt.ArrayLike, *, threads: int = 0) -> Answers:
        """The objects that meet each box: an array (n, 2 dim), lower corners, then upper ones."""
        return Answers(*self._core.boxes(doubles(boxes, "boxes"), threads, None))

    def close(self) -> None:
        """Frees the tree. Questions raise ClosedError from now on."""
        self._core.close()
