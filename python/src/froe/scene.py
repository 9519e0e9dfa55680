"""Scenes: sets of objects, from arrays."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import Doubles, Ids, Progress, doubles, rows, whole
from .errors import ArrayError, UnsupportedError
from .report import Report
from .tree import Tree


_POINT, _SEGMENT, _POLYGON, _BOX, _BALL, _HULL = range(6)  # froe_kind


@dataclass(frozen=True)
class Group:
    """What the objects of one feature, mesh or layer share. ``colour`` is 0xRRGGBBAA, or 0: unknown."""

    name: str
    material: str
    left: str
    right: str
    colour: int


@dataclass(frozen=True)
class SceneArrays:
    """A scene. Object ``i`` has the vertices ``corners[starts[i]:starts[i + 1]]``, whose places are in ``coords``.

    :ivar kinds: of each object, as it was added: 0 point, 1 segment, 2 polygon, 3 box, 4 ball, 5 hull
    :ivar forms: the same, as it is: a segment without length is a point
    :ivar groups: of each object, -1: none
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
    """How a file was read: nothing is done to a scene that is not counted here."""

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
        self.read_report: ReadReport | None = None

    @classmethod
    def _of(cls, core: _core.Scene, report: ReadReport | None = None) -> Scene:
        scene = cls.__new__(cls)
        scene._core = core
        scene.read_report = report
        return scene

    @property
    def dim(self) -> int:
        """The dimension of the space."""
        return self._core.counts()[0]

    def __len__(self) -> int:
        return self._core.counts()[1]

    @property
    def bounds(self) -> Doubles | None:
        """The lower and the upper corner of everything, as two rows; None for an empty scene.

        >>> import froe
        >>> froe.points([[0, 3], [1, 1]]).bounds.tolist()
        [[0.0, 1.0], [1.0, 3.0]]
        """
        found = self._core.bounds()
        return None if found is None else np.asarray(found)

    def add_group(
        self, name: str = "", *, material: str = "", left: str = "", right: str = "", colour: int = 0
    ) -> int:
        """A group, which objects may then belong to. Returns its number. ``colour`` is 0xRRGGBBAA, or 0: unknown."""
        return self._core.add_group(name, material, left, right, colour)

    @property
    def group_count(self) -> int:
        """How many groups there are."""
        return self._core.counts()[3]

    def group(self, group: int) -> Group:
        """What the objects of a group share.

        >>> import froe
        >>> scene = froe.Scene(2)
        >>> scene.group(scene.add_group("harbour")).name
        'harbour'
        """
        return Group(*self._core.group(group))

    def arrays(self) -> SceneArrays:
        """The whole scene as arrays, which are copies.

        >>> import froe
        >>> froe.segments([[0, 0, 1, 1], [1, 1, 2, 0]]).arrays().corners.tolist()
        [0, 1, 1, 2]
        """
        return SceneArrays(*(np.asarray(part) for part in self._core.arrays()))

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes a file that ``froe.read`` gives back, exactly: .geojson, .csv, .off or .obj."""
        self._core.write(path)

    def __repr__(self) -> str:
        return f"<froe.Scene: {len(self)} objects in R^{self.dim}>"

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

    def add_hulls(self, points: npt.ArrayLike, starts: npt.ArrayLike, **about: Any) -> None:
        """Adds convex hulls: hull ``i`` is the smallest convex set around ``points[starts[i]:starts[i + 1]]``."""
        at = whole(starts, "starts", np.uint64)
        self._add(_HULL, rows(points, "points", self.dim, self.dim), starts=at, **about)

    def add_polygons(self, points: npt.ArrayLike, starts: npt.ArrayLike, **about: Any) -> None:
        """Adds polygons in space, planar, convex and simple: their corners in order, as for hulls."""
        at = whole(starts, "starts", np.uint64)
        self._add(_POLYGON, rows(points, "points", self.dim, self.dim), starts=at, **about)

    def add_triangles(self, vertices: npt.ArrayLike, triangles: npt.ArrayLike | None = None, **about: Any) -> None:
        """Adds triangles in space: (n, 3) vertices and (m, 3) numbers of these, or (m, 3, 3) or (m, 9) corners."""
        if self.dim != 3:
            raise UnsupportedError(f"Triangles are added to scenes of dimension 3, and this one has {self.dim}.")
        if triangles is None:
            self._add(_POLYGON, rows(vertices, "triangles", 9, 3), **about)
        else:
            corners = whole(triangles, "triangles", np.uint32)
            if corners.ndim != 2 or corners.shape[1] != 3:
                raise ArrayError(f"triangles must have the shape (m, 3), and has {corners.shape}.")
            self._add(_POLYGON, rows(vertices, "vertices", 3, 3), indices=corners.ravel(), **about)

    def _add(
        self,
        kind: int,
        coords: npt.NDArray[np.float64],
        *,
        indices: Any = None,
        starts: Any = None,
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
            starts,
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


def _dim(array: Doubles, name: str, ends: int, dim: int | None) -> int:
    """The dimension that an array has where none is given: that of its rows of one or two ends."""
    if dim is not None:
        return dim
    if array.size == 0:
        return 2
    width = array.shape[-1] * (ends if array.ndim == 3 else 1) if array.ndim else 0
    if array.ndim < 2 or width % ends:
        raise ArrayError(f"{name} must have the shape (n, {ends} dim), and has {array.shape}.")
    return width // ends


def segments(segments: npt.ArrayLike, dim: int | None = None) -> Scene:
    """A scene of segments: an array (n, 2 dim) or (n, 2, dim).

    >>> import froe
    >>> froe.segments([[0, 0, 1, 1]]), froe.segments([[0, 0, 0, 1, 1, 1]])
    (<froe.Scene: 1 objects in R^2>, <froe.Scene: 1 objects in R^3>)
    """
    array = doubles(segments, "segments")
    scene = Scene(_dim(array, "segments", 2, dim))
    scene.add_segments(array)
    return scene


def points(points: npt.ArrayLike, dim: int | None = None) -> Scene:
    """A scene of points: an array (n, dim).

    >>> import froe
    >>> froe.points([[0, 0, 1], [2, 2, 2]])
    <froe.Scene: 2 objects in R^3>
    """
    array = doubles(points, "points")
    scene = Scene(_dim(array, "points", 1, dim))
    scene.add_points(array)
    return scene


def boxes(boxes: npt.ArrayLike, hi: npt.ArrayLike | None = None, dim: int | None = None) -> Scene:
    """A scene of boxes: an array (n, 2 dim) of lower and upper corners, or lower and upper corners as an array (n, dim)
    each.

    >>> import froe
    >>> froe.boxes([[0, 0, 1, 1]]).bounds.tolist(), froe.boxes([[0, 0]], [[1, 1]]).bounds.tolist()
    ([[0.0, 0.0], [1.0, 1.0]], [[0.0, 0.0], [1.0, 1.0]])
    """
    array = doubles(boxes, "boxes")
    if hi is not None:
        upper = doubles(hi, "hi")
        if upper.shape != array.shape or array.ndim != 2:
            raise ArrayError(f"Lower and upper corners have the shapes {array.shape} and {upper.shape}.")
        array = np.hstack([array, upper])
    scene = Scene(_dim(array, "boxes", 2, dim))
    scene.add_boxes(array)
    return scene


def triangles(vertices: npt.ArrayLike, triangles: npt.ArrayLike | None = None) -> Scene:
    """A scene of triangles in space: vertices (n, 3) and numbers of these (m, 3), or corners (m, 3, 3)."""
    scene = Scene(3)
    scene.add_triangles(vertices, triangles)
    return scene


def read(
    path: str | os.PathLike[str],
    *,
    polygons: bool = False,
    boxes: bool = False,
    wrap: bool = False,
    progress: Progress | None = None,
) -> Scene:
    """A scene from a file: GeoJSON, CSV with a header, OBJ, OFF or PLY. ``scene.read_report`` tells how it was read.

    :param polygons: planar, convex polygons of models stay whole; otherwise all are triangulated
    :param boxes: the bounding box of each feature in place of its shape
    :param wrap: borders on maps that cross the antimeridian are cut there

    >>> import froe, tempfile, os
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     froe.segments([[0, 0, 1, 1]]).write(os.path.join(folder, "a.geojson"))
    ...     scene = froe.read(os.path.join(folder, "a.geojson"))
    >>> len(scene), scene.read_report.format
    (1, 'GeoJSON')
    """
    core, report = _core.read(path, polygons, boxes, wrap, progress)
    return Scene._of(core, ReadReport(**report))


def generate(kind: str, count: int, seed: int = 1) -> Scene:
    """A made-up scene of about so many objects, the same everywhere: ``froe generate --help`` lists the kinds.

    >>> import froe
    >>> len(froe.generate("segments", 100))
    100
    """
    return Scene._of(_core.generate(kind, count, seed))


def compare(scene: Scene, methods: Sequence[str], **options: Any) -> dict[str, Report]:
    """The report of a tree by each method; those that do not serve the scene are left out.

    >>> import froe
    >>> found = froe.compare(froe.segments([[0, 0, 2, 2], [0, 2, 2, 0]]), ["kd", "cylindrical", "autopartition"])
    >>> found["autopartition"].pieces
    3
    """
    found = {}
    for method in methods:
        try:
            with scene.build(method, **options) as tree:
                found[method] = tree.report
        except UnsupportedError:
            continue
    return found
