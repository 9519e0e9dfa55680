"""Scenes: sets of objects, from arrays."""

from __future__ import annotations

from collections.abc import Callable

import numpy.typing as npt

from . import _core
from ._arrays import rows
from .tree import Tree

Progress = Callable[[float], object]


class Scene:
    """A set of objects in R^dim. Objects have the ids 0, 1, ... in the order they were added.

    >>> import froe
    >>> scene = froe.Scene(2)
    >>> scene.add_segments([[0, 0, 2, 2], [0, 2, 2, 0]])
    >>> len(scene)
    2
    """

    def __init__(self, dim: int = 2) -> None:
        self._core = _core.scene(dim)

    @property
    def dim(self) -> int:
        """The dimension of the space."""
        return self._core.counts()[0]

    def __len__(self) -> int:
        return self._core.counts()[1]

    def add_segments(self, segments: npt.ArrayLike, *, threads: int = 0, progress: Progress | None = None) -> None:
        """Adds segments: an array (n, 2 dim) or (n, 2, dim)."""
        coords = rows(segments, "segments", 2 * self.dim, self.dim)
        self._core.add(1, coords, None, None, None, None, None, None, None, threads, progress)

    def build(
        self,
        method: str = "auto",
        *,
        purpose: str = "query",
        settings: str = "",
        leaf: int | None = None,
        seed: int = 1,
        max_pieces: int = 0,
        threads: int = 0,
        progress: Progress | None = None,
    ) -> Tree:
        """Builds a tree, which freezes the scene."""
        return Tree(self._core.build(method, purpose, settings, leaf, seed, None, max_pieces, threads, progress))


def segments(segments: npt.ArrayLike, dim: int = 2) -> Scene:
    """A scene of segments: an array (n, 4) or (n, 2, 2), or of more columns in higher dimensions."""
    scene = Scene(dim)
    scene.add_segments(segments)
    return scene
