"""Scenes: sets of objects, from arrays, files and generators."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any, Literal, NoReturn

import numpy as np
import numpy.typing as npt

from . import _core, _kinds
from ._arrays import Doubles, Ids, Progress, doubles, flat, rows, whole
from ._words import counted
from .errors import ArrayError, OptionError, UnsupportedError
from .report import Report
from .scene_parts import Crs, Group, ReadReport, SceneArrays
from .tree import Tree

_CRS = ("unknown", "geographic", "projected", "other")  # froe_crs_kind


class Scene:
    """A set of objects in R^dim. Objects have the ids 0, 1, ... in the order in which they were added.

    Each method that adds objects takes arrays, and adds all of them or, if it fails, none. All of them take, by name:

    - ``tags``: (n,) whole numbers up to 2^64 - 1 that name the objects to the caller
    - ``groups``: (n,) the group of each object, or ``group``: that of all
    - ``faces``: (n,) the polygon that each object is a part of
    - ``threads``: how many may work at once; 0: one for each processor
    - ``progress``: a function that is called now and then with the share done, from 0 to 1; False from it ends the call

    :ivar read_report: how the file was read, of a scene that ``froe.read`` returned and of its trees; otherwise None
    :param dim: dimension of the space, from 2 to 8
    :raises ArgumentError: the dimension is out of range
    :raises ArrayError: an array has another shape or type, or numbers that float64 does not have
    :raises InputError: NaN or infinity, a box whose upper corner is below its lower one, a polygon that is not planar
    :raises LimitError: there would be more than 2^31 - 2 objects or vertices
    :raises FrozenError: a tree has been built of the scene, which therefore cannot grow
    :raises CancelledError: the progress function returned False
    :raises OutOfMemoryError: there is not enough memory; the scene is as it was

    >>> import froe
    >>> scene = froe.Scene(2)
    >>> scene.add_segments([[0, 0, 2, 2], [0, 2, 2, 0]], tags=[7, 9])
    >>> scene.add_points([[1, 1]])
    >>> scene.add_boxes([[4, 4, 5, 6]])
    >>> scene.add_balls([[8, 8]], [0.5])
    >>> scene.add_hulls([[0, 9], [1, 9], [0, 10]], starts=[0, 3])
    >>> len(scene)
    6
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

    def __reduce__(self) -> NoReturn:
        raise TypeError("A Scene cannot be copied or pickled; trees can, and files keep it: write().")

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
        """A new group, which objects may then belong to.

        :param name, material, left, right, colour: what ``group`` returns
        :returns: its number
        :cost: O(1)

        >>> import froe
        >>> scene = froe.Scene(2)
        >>> scene.add_group("harbour"), scene.add_group("river")
        (0, 1)
        """
        return self._core.add_group(name, material, left, right, colour)

    @property
    def crs(self) -> Crs | None:
        """The coordinate system, which may be set until a tree is built; None: unknown.

        :raises OptionError: there is no such kind

        >>> import froe
        >>> scene = froe.points([[2.35, 48.86]])
        >>> scene.crs = froe.Crs("geographic", code="EPSG:4326")
        >>> scene.crs.kind
        'geographic'
        """
        kind, wkt, name, code, unit = self._core.crs()
        return Crs(_CRS[kind], name, code, unit, wkt) if kind else None  # type: ignore[arg-type]

    @crs.setter
    def crs(self, crs: Crs | None) -> None:
        if crs is None:
            self._core.set_crs(0, "", "", "", "")
            return
        if not isinstance(crs, Crs):
            raise TypeError(f"crs is {crs!r}, and must be a froe.Crs or None.")
        if crs.kind not in _CRS[1:]:
            raise OptionError(f"kind is {crs.kind!r}, and must be one of {', '.join(_CRS[1:])}.")
        self._core.set_crs(_CRS.index(crs.kind), crs.wkt, crs.name, crs.code, crs.unit)

    @property
    def across(self) -> int:
        """How many features in longitudes and latitudes have an edge that is wider than 180 degrees: as a rule their
        border crosses the antimeridian, and such edges run around the whole Earth instead. ``froe.read`` with
        ``wrap=True`` cuts them there. 0 where the coordinates are no degrees, or nothing is known of them.

        >>> import froe
        >>> scene = froe.segments([[179, 10, -179, 11], [5, 5, 6, 6]])
        >>> scene.crs = froe.Crs("geographic")
        >>> scene.across
        1
        """
        return self._core.across()

    @property
    def group_count(self) -> int:
        """How many groups there are.

        >>> import froe
        >>> froe.segments([[0, 0, 2, 2]]).group_count
        0
        """
        return self._core.counts()[3]

    def group(self, group: int) -> Group:
        """What the objects of the group with the number ``group`` have in common.

        :cost: O(1)

        >>> import froe
        >>> scene = froe.Scene(2)
        >>> scene.group(scene.add_group("harbour")).name
        'harbour'
        """
        return Group(*self._core.group(group))

    def arrays(self) -> SceneArrays:
        """The whole scene as arrays, which are copies.

        :cost: O(objects + corners)

        >>> import froe
        >>> froe.segments([[0, 0, 1, 1], [1, 1, 2, 0]]).arrays().corners.tolist()
        [0, 1, 1, 2]
        """
        return SceneArrays(*(np.asarray(part) for part in self._core.arrays()))

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes a file that ``froe.read`` gives back, exactly.

        :param path: its ending is that of the format: .geojson, .csv, .off or .obj
        :raises FileError: the file cannot be written; a file that was there before is kept
        :raises UnsupportedError: the format cannot hold these objects
        :cost: O(objects + corners)

        >>> import froe, tempfile, os
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     froe.points([[0.1, 3]]).write(os.path.join(folder, "a.csv"))
        ...     froe.read(os.path.join(folder, "a.csv")).bounds.tolist()
        [[0.1, 3.0], [0.1, 3.0]]
        """
        self._core.write(path)

    def __repr__(self) -> str:
        return f"<froe.Scene: {counted(len(self), 'object')} in R^{self.dim}>"

    def add_points(self, points: npt.ArrayLike, **about: Any) -> None:
        """Adds points.

        :param points: (n, dim)
        :param about: tags, groups and others, as the class says
        :cost: O(n) expected time
        """
        self._add(_kinds.POINT, rows(points, "points", self.dim, self.dim), **about)

    def add_segments(self, segments: npt.ArrayLike, **about: Any) -> None:
        """Adds segments.

        :param segments: (n, 2 dim) or (n, 2, dim), both ends of each
        :param about: tags, groups and others, as the class says
        :cost: O(n) expected time
        """
        self._add(_kinds.SEGMENT, rows(segments, "segments", 2 * self.dim, self.dim), **about)

    def add_boxes(self, boxes: npt.ArrayLike, **about: Any) -> None:
        """Adds boxes along the axes.

        :param boxes: (n, 2 dim) or (n, 2, dim), the lower and the upper corner of each
        :param about: tags, groups and others, as the class says
        :cost: O(n) expected time
        """
        self._add(_kinds.BOX, rows(boxes, "boxes", 2 * self.dim, self.dim), **about)

    def add_balls(self, centres: npt.ArrayLike, radii: npt.ArrayLike, **about: Any) -> None:
        """Adds balls.

        :param centres: (n, dim)
        :param radii: (n,), not negative
        :param about: tags, groups and others, as the class says
        :cost: O(n) expected time
        """
        each = flat(doubles(radii, "radii"), "radii")
        self._add(_kinds.BALL, rows(centres, "centres", self.dim, self.dim), radii=each, **about)

    def add_hulls(self, points: npt.ArrayLike, starts: npt.ArrayLike, **about: Any) -> None:
        """Adds convex hulls. Hull ``i`` is the smallest convex set around ``points[starts[i]:starts[i + 1]]``.

        :param points: (corners, dim)
        :param starts: (n + 1,)
        :param about: tags, groups and others, as the class says
        :cost: O(corners) expected time
        """
        at = flat(whole(starts, "starts", np.uint64), "starts")
        self._add(_kinds.HULL, rows(points, "points", self.dim, self.dim), starts=at, **about)

    def add_polygons(self, points: npt.ArrayLike, starts: npt.ArrayLike, **about: Any) -> None:
        """Adds polygons in space, which are planar, convex and simple. Polygon ``i`` has the corners
        ``points[starts[i]:starts[i + 1]]``, in order.

        :param points: (corners, 3)
        :param starts: (n + 1,)
        :param about: tags, groups and others, as the class says
        :raises InputError: also where a polygon is not exactly planar; triangles always are
        :cost: O(corners) expected time

        >>> import froe
        >>> scene = froe.Scene(3)
        >>> scene.add_polygons([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], starts=[0, 4])
        >>> len(scene)
        1
        """
        at = flat(whole(starts, "starts", np.uint64), "starts")
        self._add(_kinds.POLYGON, rows(points, "points", self.dim, self.dim), starts=at, **about)

    def add_triangles(self, vertices: npt.ArrayLike, triangles: npt.ArrayLike | None = None, **about: Any) -> None:
        """Adds triangles in space.

        :param vertices: (vertices, 3) if there are ``triangles``, otherwise the corners, (m, 3, 3) or (m, 9)
        :param triangles: (m, 3) numbers of vertices
        :param about: tags, groups and others, as the class says
        :raises UnsupportedError: the scene has another dimension than 3
        :cost: O(m) expected time

        >>> import froe
        >>> scene = froe.Scene(3)
        >>> scene.add_triangles([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2], [0, 1, 3]])
        >>> len(scene)
        2
        """
        if self.dim != 3:
            raise UnsupportedError(f"Triangles are added to scenes of dimension 3, and this one has {self.dim}.")
        if triangles is None:
            self._add(_kinds.POLYGON, rows(vertices, "triangles", 9, 3), **about)
        else:
            corners = whole(triangles, "triangles", np.uint32)
            if corners.shape != (0,) and (corners.ndim != 2 or corners.shape[1] != 3):
                raise ArrayError(f"triangles must have the shape (m, 3), and has {corners.shape}.")
            self._add(_kinds.POLYGON, rows(vertices, "vertices", 3, 3), indices=corners.ravel(), **about)

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
            None if tags is None else flat(whole(tags, "tags", np.uint64), "tags"),
            None if faces is None else flat(whole(faces, "faces", np.uint32), "faces"),
            None if groups is None else flat(whole(groups, "groups", np.uint32), "groups"),
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
        """Builds a tree, after which the scene cannot grow any more. Any number of trees may be built of one scene.

        :param method: one of ``froe methods``, or ``"auto"``: what suits scene and purpose
        :param purpose: ``"query"``: for questions; ``"pieces"``: as few pieces as possible; ``"draw"``: for one drawing
        :param settings: options of the method, such as ``"crossing=split"``; ``froe methods`` lists them
        :param leaf: the most objects of a leaf; None: what the method does best
        :param seed: of random choices; the same seed gives the same tree on every machine
        :param max_pieces: the most pieces that the tree may have; 0: any number
        :param threads: how many may work at once; 0: one for each processor
        :param progress: is called with the share done; False from it ends the call
        :raises OptionError: there is no such method, purpose or option
        :raises UnsupportedError: the method does not serve objects of this kind or dimension
        :raises BudgetError: there would be more pieces than ``max_pieces``
        :cost: O(n log n) for queries, about 0.1 microseconds a segment; more for fewer pieces, as the pages of methods
            say

        >>> import froe
        >>> froe.segments([[0, 0, 2, 2], [0, 2, 2, 0]]).build("autopartition", purpose="pieces").report.pieces
        3
        """
        core = self._core.build(method, purpose, settings, leaf, seed, None, max_pieces, threads, progress)
        return Tree(core, read=self.read_report)


def core_of(scene: Scene, name: str) -> _core.Scene:
    """What the extension takes of an argument that has to be a scene."""
    if not isinstance(scene, Scene):
        raise TypeError(f"{name} is {scene!r}, and must be a froe.Scene.")
    return scene._core


def _dim(array: Doubles, name: str, ends: int, dim: int | None) -> int:
    """The dimension that an array has where none is given: that of its rows of one or two ends."""
    if dim is not None:
        return dim
    width = array.shape[-1] * (ends if array.ndim == 3 else 1) if array.ndim else 0
    if array.size == 0 and (array.ndim < 2 or width == 0):
        return 2
    if array.ndim < 2 or width % ends:
        each = f"{ends} dim" if ends > 1 else "dim"
        raise ArrayError(f"{name} must have the shape (n, {each}), and has {array.shape}.")
    return width // ends


def segments(segments: npt.ArrayLike, dim: int | None = None) -> Scene:
    """A scene of segments.

    :param segments: (n, 2 dim) or (n, 2, dim), both ends of each
    :param dim: dimension of the space; None: that of the array
    :raises ArrayError, InputError: as ``Scene``
    :cost: O(n) expected time

    >>> import froe
    >>> froe.segments([[0, 0, 1, 1]]), froe.segments([[0, 0, 0, 1, 1, 1]])
    (<froe.Scene: 1 object in R^2>, <froe.Scene: 1 object in R^3>)
    """
    array = doubles(segments, "segments")
    scene = Scene(_dim(array, "segments", 2, dim))
    scene.add_segments(array)
    return scene


def points(points: npt.ArrayLike, dim: int | None = None) -> Scene:
    """A scene of points.

    :param points: (n, dim)
    :param dim: dimension of the space; None: that of the array
    :raises ArrayError, InputError: as ``Scene``
    :cost: O(n) expected time

    >>> import froe
    >>> froe.points([[0, 0, 1], [2, 2, 2]])
    <froe.Scene: 2 objects in R^3>
    """
    array = doubles(points, "points")
    scene = Scene(_dim(array, "points", 1, dim))
    scene.add_points(array)
    return scene


def boxes(boxes: npt.ArrayLike, hi: npt.ArrayLike | None = None, dim: int | None = None) -> Scene:
    """A scene of boxes along the axes.

    :param boxes: (n, 2 dim) or (n, 2, dim), the lower and the upper corner of each; with ``hi`` the lower corners, (n,
        dim)
    :param hi: (n, dim), the upper corners
    :param dim: dimension of the space; None: that of the array
    :raises ArrayError, InputError: as ``Scene``
    :cost: O(n) expected time

    >>> import froe
    >>> froe.boxes([[0, 0, 1, 1]]).bounds.tolist(), froe.boxes([[0, 0]], [[1, 1]]).bounds.tolist()
    ([[0.0, 0.0], [1.0, 1.0]], [[0.0, 0.0], [1.0, 1.0]])
    """
    array = doubles(boxes, "boxes")
    if hi is not None:
        upper = doubles(hi, "hi")
        if upper.shape != array.shape or (array.ndim != 2 and array.size):
            raise ArrayError(f"Lower and upper corners have the shapes {array.shape} and {upper.shape}.")
        array = np.hstack([array, upper])
    scene = Scene(_dim(array, "boxes", 2, dim))
    scene.add_boxes(array)
    return scene


def triangles(vertices: npt.ArrayLike, triangles: npt.ArrayLike | None = None) -> Scene:
    """A scene of triangles in space.

    :param vertices: (vertices, 3) if there are ``triangles``, otherwise the corners, (m, 3, 3) or (m, 9)
    :param triangles: (m, 3) numbers of vertices
    :raises ArrayError, InputError: as ``Scene``
    :cost: O(m) expected time

    >>> import froe
    >>> froe.triangles([[[0, 0, 0], [1, 0, 0], [0, 1, 0]]])
    <froe.Scene: 1 object in R^3>
    """
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
    """A scene from a file: GeoJSON, CSV with a header, OBJ, OFF or PLY. Its ``read_report`` tells how it was read.

    :param path: the file; its content decides of which format it is
    :param polygons: planar, convex polygons of models stay whole; otherwise all are split into triangles
    :param boxes: the bounding box of each feature in place of its shape
    :param wrap: borders on maps that cross the antimeridian are cut there
    :param progress: is called with the share done; False from it ends the call
    :raises FileError: the file cannot be opened or read
    :raises FormatError: it is not what it claims to be; the message names the line or the byte
    :raises UnsupportedError: it has another format
    :cost: O(size of the file)

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
    """A made-up scene for tests, the same on every machine.

    :param kind: one of those that ``froe generate --help`` lists
    :param count: about how many objects
    :param seed: another one gives another scene
    :raises OptionError: there is no such kind
    :cost: O(count)

    >>> import froe
    >>> len(froe.generate("segments", 100))
    100
    """
    return Scene._of(_core.generate(kind, count, seed))


def compare(scene: Scene, methods: Sequence[str], **options: Any) -> dict[str, Report]:
    """Builds a tree by each method and keeps its report alone. Methods that do not serve scenes of this kind are left
    out.

    :param scene: any scene
    :param methods: names of methods
    :param options: what ``Scene.build`` takes besides
    :returns: the reports by method
    :raises Error: what ``Scene.build`` raises, except UnsupportedError
    :cost: that of building each tree, one after the other

    >>> import froe
    >>> found = froe.compare(froe.segments([[0, 0, 2, 2], [0, 2, 2, 0]]), ["kd", "cylindrical", "autopartition"])
    >>> found["autopartition"].pieces
    3
    """
    found = {}
    core_of(scene, "scene")
    for method in methods:
        try:
            with scene.build(method, **options) as tree:
                found[method] = tree.report
        except UnsupportedError:
            continue
    return found
