"""Scenes: sets of objects, from arrays."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import doubles, rows, whole
from .tree import Tree

Progress = Callable[[float], object]

_POINT, _SEGMENT, _POLYGON, _BOX, _BALL, _HULL = range(6)  # froe_kind


class Scene:
    """A set of objects in R^dim. Objects have the ids 0, 1, ... in the order they were added.

    Every method that adds objects takes arrays, and adds all of them or, if it fails, none. ``tags`` are whole numbers
    that name the objects to the caller, ``groups`` say which group each belongs to (``group`` of all), and ``faces``
    which polygon it is a part of.

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

    def add_group(self, name: str = "") -> int:
        """A group, which objects may then belong to. Returns its number."""
        return self._core.add_group(name)

    def add_points(self, points: npt.ArrayLike, **about: Any) -> None:
        """Adds points: an array (n, dim)."""
        self._add(_POINT, rows(points, "points", self.dim, self.dim), **about)

    def add_segments(self, segments: npt.ArrayLike, **about: Any) -> None:
        """Adds segments: an array (n, 2 dim) or (n, 2, dim)."""
        self._add(_SEGMENT, rows(segments, "segments", 2 * self.dim, self.dim), **about)

    def add_boxes(self, boxes: npt.ArrayLike, **about: Any) -> None:
        """Adds boxes: an array (n, 2 dim) or (n, 2, dim) of their lower and upper corners."""
        self._add(_BOX, rows(boxes, "boxes", 2 * self.dim, self.dim), **about)

    def add_balls(self, centres: npt.ArrayLike, radii: npt.ArrayLike, **about: Any) -> None:
        """Adds balls: an array (n, dim) of centres, and n radii."""
        self._add(_BALL, rows(centres, "centres", self.dim, self.dim), radii=doubles(radii, "radii"), **about)

    def add_triangles(self, vertices: npt.ArrayLike, triangles: npt.ArrayLike | None = None, **about: Any) -> None:
        """Adds triangles in space: (n, 3) vertices and (m, 3) numbers of these, or (m, 3, 3) or (m, 9) corners."""
        if triangles is None:
            self._add(_POLYGON, rows(vertices, "triangles", 9, 3), **about)
        else:
            corners = whole(triangles, "triangles", np.uint32)
            self._add(_POLYGON, rows(vertices, "vertices", 3, 3), indices=corners.ravel(), **about)

    def _add(
        self,
        kind: int,
        coords: npt.NDArray[np.float64],
        *,
        indices: Any = None,
        radii: Any = None,
        tags: npt.ArrayLike | None = None,
        faces: npt.ArrayLike | None = None,
        groups: npt.ArrayLike | None = None,
        group: int | None = None,
        threads: int = 0,
        progress: Progress | None = None,
    ) -> None:
        self._core.add(
            kind,
            coords,
            indices,
            None,
            radii,
            None if tags is None else whole(tags, "tags", np.uint64),
            None if faces is None else whole(faces, "faces", np.uint32),
            None if groups is None else whole(groups, "groups", np.uint32),
            group,
            threads,
            progress,
        )

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


def points(points: npt.ArrayLike, dim: int = 2) -> Scene:
    """A scene of points: an array (n, dim)."""
    scene = Scene(dim)
    scene.add_points(points)
    return scene


def boxes(boxes: npt.ArrayLike, dim: int = 2) -> Scene:
    """A scene of boxes: an array (n, 2 dim) of lower and upper corners."""
    scene = Scene(dim)
    scene.add_boxes(boxes)
    return scene


def triangles(vertices: npt.ArrayLike, triangles: npt.ArrayLike | None = None) -> Scene:
    """A scene of triangles in space: vertices (n, 3) and numbers of these (m, 3), or corners (m, 3, 3)."""
    scene = Scene(3)
    scene.add_triangles(vertices, triangles)
    return scene
