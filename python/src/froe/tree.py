"""Trees: questions to scenes."""

from __future__ import annotations

import math
import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, overload

import numpy as np
import numpy.typing as npt

from . import _core, _ranges, pictures, report
from ._arrays import Doubles, Ids, Progress, doubles, point, rows, whole
from ._ranges import Points, Relation, Round
from .answers import Answers
from .errors import ClosedError, OptionError
from .pictures import Picture
from .report import Report

if TYPE_CHECKING:
    from .scene import Scene


_IDS, _COUNTS, _ANY, _GROUPS = range(4)
_FIRST, _ALL = range(2)


@dataclass(frozen=True)
class Pieces:
    """The pieces of a tree. The corners of piece ``i`` are ``coords[starts[i]:starts[i + 1]]``.

    :ivar objects: the object that each is a part of
    :ivar nodes: the node in whose list each is
    :ivar whole: 1 where nothing of the object was cut off
    :ivar starts: one more than pieces
    :ivar coords: (corners, dim)
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

    def __getitem__(self, piece: int) -> Doubles:
        """The corners of a piece."""
        return self.coords[self.starts[piece] : self.starts[piece + 1]]


@dataclass(frozen=True)
class Cells:
    """Regions of nodes. Cell ``i`` has the faces ``faces[i]`` to ``faces[i + 1]``, and face ``f`` the corners
    ``coords[starts[f]:starts[f + 1]]``. In the plane every cell is one face.

    :ivar nodes: the node of each
    :ivar depths: the number of cuts on the way to each
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
        """The corners of each face."""
        return [self.coords[a:b] for a, b in zip(self.starts[:-1], self.starts[1:])]


class Tree:
    """A binary space partition of a scene. Made by ``Scene.build``, or opened from a file by ``froe.open``.

    Questions are arrays; one call answers all of them, on ``threads`` threads (0: one per processor). Objects and
    ranges are closed, so that touching counts as meeting, and every answer is exact.
    """

    def __init__(self, core: _core.Tree, path: str | None = None) -> None:
        self._core = core
        self._path = path

    def query(
        self,
        boxes: npt.ArrayLike | None = None,
        *,
        balls: Round | None = None,
        segments: npt.ArrayLike | None = None,
        capsules: Round | None = None,
        hulls: Points | None = None,
        eps: float = 0.0,
        threads: int = 0,
        progress: Progress | None = None,
    ) -> Answers:
        """The objects that meet each range, of one kind: boxes (n, 2 dim) of lower and upper corners; balls, centres
        (n, dim) and radii; segments (n, 2 dim); capsules, segments and radii: all points that near to them; or hulls, a
        sequence of arrays of points, each the smallest convex set around its points.

        With ``eps`` above 0 answers may be found faster: all objects that meet a range, and some others that are no
        farther from it than ``eps`` times its diameter.

        >>> import froe
        >>> tree = froe.segments([[0, 0, 2, 2], [3, 0, 3, 2]]).build()
        >>> tree.query([[0, 0, 1, 1]]).pairs().tolist()
        [[0], [0]]
        >>> tree.query(balls=([[3, 3]], 1)).pairs().tolist()
        [[0], [1]]
        >>> tree.query(hulls=[[[2, 0], [4, 0], [4, 2]]]).pairs().tolist()
        [[0], [1]]
        """
        found = _ranges.of(self.dim, boxes, balls, segments, capsules, hulls)
        if found.shape == _ranges.BOX and eps == 0:
            return Answers(*self._core.boxes(found.points, threads, progress))
        return Answers(*self._core.ranges(_IDS, *found, eps, 0, threads, progress))

    def query_one(self, box: npt.ArrayLike) -> Ids:
        """The objects that meet one box, for loops: less than a microsecond around the search.

        >>> import froe
        >>> froe.segments([[0, 0, 2, 2], [3, 0, 3, 2]]).build().query_one([0, 0, 1, 1])
        array([0], dtype=int32)
        """
        return np.asarray(self._core.box(box if type(box) is np.ndarray else doubles(box, "box")))

    def count(
        self,
        boxes: npt.ArrayLike | None = None,
        *,
        balls: Round | None = None,
        segments: npt.ArrayLike | None = None,
        capsules: Round | None = None,
        hulls: Points | None = None,
        threads: int = 0,
        progress: Progress | None = None,
    ) -> npt.NDArray[np.int64]:
        """How many objects meet each range.

        >>> import froe
        >>> froe.points([[0, 0], [1, 1]]).build().count([[0, 0, 1, 1], [5, 5, 6, 6]]).tolist()
        [2, 0]
        """
        found = _ranges.of(self.dim, boxes, balls, segments, capsules, hulls)
        return np.asarray(self._core.ranges(_COUNTS, *found, 0.0, 0, threads, progress))

    def any(
        self,
        boxes: npt.ArrayLike | None = None,
        *,
        balls: Round | None = None,
        segments: npt.ArrayLike | None = None,
        capsules: Round | None = None,
        hulls: Points | None = None,
        threads: int = 0,
        progress: Progress | None = None,
    ) -> Ids:
        """One object that meets each range, -1 where there is none.

        >>> import froe
        >>> froe.points([[0, 0], [1, 1]]).build().any([[1, 1, 1, 1], [5, 5, 6, 6]]).tolist()
        [1, -1]
        """
        found = _ranges.of(self.dim, boxes, balls, segments, capsules, hulls)
        return np.asarray(self._core.ranges(_ANY, *found, 0.0, 0, threads, progress))

    def _rows(self, values: npt.ArrayLike, name: str, width: int) -> Doubles:
        return rows(values, name, width * self.dim, self.dim)

    def locate(self, points: npt.ArrayLike, *, threads: int = 0, progress: Progress | None = None) -> Answers:
        """The objects that contain each point.

        >>> import froe
        >>> froe.segments([[0, 0, 2, 2]]).build().locate([[1, 1], [1, 0]]).counts().tolist()
        [1, 0]
        """
        return Answers(*self._core.locate(self._rows(points, "points", 1), threads, progress))

    def groups(self, points: npt.ArrayLike, *, threads: int = 0, progress: Progress | None = None) -> Answers:
        """The groups that each point of the plane lies in: countries of a map, for example.

        >>> import froe
        >>> scene = froe.Scene(2)
        >>> group = scene.add_group("a triangle")
        >>> scene.add_segments([[0, 0, 4, 0], [4, 0, 0, 4], [0, 4, 0, 0]], group=group)
        >>> scene.build().groups([[1, 1], [4, 4]]).counts().tolist()
        [1, 0]
        """
        return Answers(*self._core.groups(self._rows(points, "points", 1), threads, progress))

    def query_groups(
        self,
        boxes: npt.ArrayLike | None = None,
        *,
        balls: Round | None = None,
        segments: npt.ArrayLike | None = None,
        capsules: Round | None = None,
        hulls: Points | None = None,
        relation: Relation = "meets",
        threads: int = 0,
        progress: Progress | None = None,
    ) -> Answers:
        """The groups of the plane that meet each range (``"meets"``), lie within it (``"within"``), or cover it
        (``"covers"``), ascending. Ranges are those of ``query``. A group whose segments are closed rings is an area
        with its border, and other groups are the points of their objects; all are closed sets, and every answer is
        exact. What balls and capsules are covered by is refused.

        >>> import froe
        >>> scene = froe.Scene(2)
        >>> group = scene.add_group("a triangle")
        >>> scene.add_segments([[0, 0, 4, 0], [4, 0, 0, 4], [0, 4, 0, 0]], group=group)
        >>> tree, boxes = scene.build(), [[1, 1, 2, 2], [1, 1, 3, 3], [0, 0, 4, 4]]
        >>> [tree.query_groups(boxes, relation=name).counts().tolist() for name in ("meets", "within", "covers")]
        [[1, 1, 1], [0, 0, 1], [1, 0, 0]]
        """
        found = _ranges.of(self.dim, boxes, balls, segments, capsules, hulls)
        number = _ranges.relation(relation)
        if found.shape == _ranges.BOX:
            return Answers(*self._core.group_boxes(number, found.points, threads, progress))
        return Answers(*self._core.ranges(_GROUPS + number, *found, 0.0, 0, threads, progress))

    def join_groups(
        self,
        questions: Tree,
        *,
        relation: Relation = "meets",
        threads: int = 0,
        progress: Progress | None = None,
    ) -> Answers:
        """The groups of this tree that meet each group of another one of the plane, lie within it, or cover it:
        polygons with holes, paths and sets of points as questions. The two may be the same tree.

        >>> import froe
        >>> from shapely.geometry import Point, box
        >>> parks = froe.from_shapely([box(0, 0, 4, 4), box(2, 2, 8, 8)]).build()
        >>> things = froe.from_shapely([Point(3, 3), box(0, 0, 1, 1), box(0, 0, 9, 9)]).build()
        >>> parks.join_groups(things, relation="covers").pairs().tolist()
        [[0, 0, 1], [0, 1, 0]]
        >>> parks.join_groups(things, relation="within").pairs().tolist()
        [[2, 2], [0, 1]]
        """
        return Answers(*self._core.group_join(_ranges.relation(relation), questions._core, threads, progress))

    @overload
    def nearest(  # type: ignore[misc] # an int that is 1 is of both kinds
        self,
        points: npt.ArrayLike,
        k: Literal[1] = 1,
        max_distance: float = math.inf,
        *,
        threads: int = 0,
        progress: Progress | None = None,
    ) -> tuple[Ids, Doubles]: ...
    @overload
    def nearest(
        self,
        points: npt.ArrayLike,
        k: int,
        max_distance: float = math.inf,
        *,
        threads: int = 0,
        progress: Progress | None = None,
    ) -> Answers: ...
    def nearest(
        self,
        points: npt.ArrayLike,
        k: int = 1,
        max_distance: float = math.inf,
        *,
        threads: int = 0,
        progress: Progress | None = None,
    ) -> Answers | tuple[Ids, Doubles]:
        """The nearest object to each point and its distance, -1 and infinity where none is within ``max_distance``.
        With ``k`` above 1 answers with distances as values, nearest first. Of equally near ones the lowest id is first.

        >>> import froe
        >>> tree = froe.points([[0, 0], [3, 0]]).build()
        >>> tree.nearest([[1, 0], [9, 0]])
        (array([0, 1], dtype=int32), array([1., 6.]))
        >>> tree.nearest([[1, 0]], k=2).values.tolist()
        [1.0, 2.0]
        """
        found = Answers(*self._core.near(self._rows(points, "points", 1), k, max_distance, threads, progress))
        if k != 1:
            return found
        if found.values is not None and len(found.ids) == len(found):
            return found.ids, found.values
        there = found.counts() > 0
        ids, distances = np.full(len(found), -1, np.int32), np.full(len(found), np.inf)
        ids[there], distances[there] = found.ids, found.values
        return ids, distances

    def nearest_points(
        self, objects: npt.ArrayLike, points: npt.ArrayLike, *, threads: int = 0, progress: Progress | None = None
    ) -> Doubles:
        """The point of each object that is nearest to the point beside it.

        >>> import froe
        >>> tree = froe.segments([[0, 0, 4, 0]]).build()
        >>> tree.nearest_points([0], [[1, 2]]).tolist()
        [[1.0, 0.0]]
        """
        ids = whole(objects, "objects", np.uint32)
        return np.asarray(self._core.nearest_points(ids, self._rows(points, "points", 1), threads, progress))

    @overload
    def ray(
        self,
        origins: npt.ArrayLike,
        directions: npt.ArrayLike,
        t_max: float = math.inf,
        *,
        all: Literal[False] = False,
        threads: int = 0,
        progress: Progress | None = None,
    ) -> tuple[Ids, Doubles]: ...
    @overload
    def ray(
        self,
        origins: npt.ArrayLike,
        directions: npt.ArrayLike,
        t_max: float = math.inf,
        *,
        all: Literal[True],
        threads: int = 0,
        progress: Progress | None = None,
    ) -> Answers: ...
    def ray(
        self,
        origins: npt.ArrayLike,
        directions: npt.ArrayLike,
        t_max: float = math.inf,
        *,
        all: bool = False,
        threads: int = 0,
        progress: Progress | None = None,
    ) -> Answers | tuple[Ids, Doubles]:
        """The object that each ray meets first, and where: at ``origin + t * direction``; -1 and infinity where there
        is none. With ``all`` answers with every object met, by ``t``.

        >>> import froe
        >>> tree = froe.segments([[2, -1, 2, 1], [5, -1, 5, 1]]).build()
        >>> tree.ray([[0, 0]], [[1, 0]])
        (array([0], dtype=int32), array([2.]))
        >>> tree.ray([[0, 0]], [[1, 0]], all=True).values.tolist()
        [2.0, 5.0]
        """
        start, way = self._rows(origins, "origins", 1), self._rows(directions, "directions", 1)
        found = self._core.rays(_ALL if all else _FIRST, start, way, t_max, threads, progress)
        if all:
            return Answers(*found)
        return np.asarray(found[0]), np.asarray(found[1])

    def hit_places(
        self,
        objects: npt.ArrayLike,
        origins: npt.ArrayLike,
        directions: npt.ArrayLike,
        *,
        threads: int = 0,
        progress: Progress | None = None,
    ) -> tuple[Doubles, Doubles, Doubles]:
        """Where each ray meets the object beside it first: points, normals and distances from the origin.

        >>> import froe
        >>> tree = froe.segments([[2, -1, 2, 1]]).build()
        >>> [found.tolist() for found in tree.hit_places([0], [[0, 0]], [[1, 0]])]
        [[[2.0, 0.0]], [[-1.0, 0.0]], [2.0]]
        """
        ids = whole(objects, "objects", np.uint32)
        start, way = self._rows(origins, "origins", 1), self._rows(directions, "directions", 1)
        points, normals, distances = self._core.hit_places(ids, start, way, threads, progress)
        return np.asarray(points), np.asarray(normals), np.asarray(distances)

    def above(
        self, points: npt.ArrayLike, *, below: bool = False, threads: int = 0, progress: Progress | None = None
    ) -> Ids:
        """The first segment of the plane above each point, or below it; -1 where there is none.

        >>> import froe
        >>> froe.segments([[0, 2, 4, 2]]).build().above([[1, 1], [1, 3]]).tolist()
        [0, -1]
        """
        return np.asarray(self._core.vertical(self._rows(points, "points", 1), below, threads, progress))

    def pairs(
        self, *, shared: bool = True, threads: int = 0, progress: Progress | None = None
    ) -> npt.NDArray[np.int32]:
        """All pairs of objects that meet: rows of two objects and how they meet (0: cross, 1: touch, 2: overlap).
        ``shared=False`` leaves out those that touch in nothing but one corner of both.

        >>> import froe
        >>> froe.segments([[0, 0, 2, 2], [0, 2, 2, 0]]).build().pairs().tolist()
        [[0, 1, 0]]
        """
        return np.asarray(self._core.pairs(shared, threads, progress))

    @property
    def dim(self) -> int:
        """The dimension of the space."""
        return self._core.dim()

    @property
    def scene(self) -> Scene:
        """The scene, which can no longer grow, and which keeps the tree.

        >>> import froe
        >>> len(froe.points([[0, 0], [1, 1]]).build().scene)
        2
        """
        from .scene import Scene

        return Scene._of(self._core.scene())

    @property
    def report(self) -> Report:
        """What the tree consists of: method, objects, nodes, pieces, height, bytes and more.

        >>> import froe
        >>> froe.points([[0, 0], [1, 1]]).build().report.objects
        2
        """
        return report.of(self._core.report())

    def pieces(self) -> Pieces:
        """All pieces.

        >>> import froe
        >>> tree = froe.segments([[0, 0, 2, 2], [0, 2, 2, 0]]).build("autopartition", purpose="pieces")
        >>> len(tree.pieces())
        3
        """
        return Pieces(*(np.asarray(part) for part in self._core.pieces()))

    def cells(self, lo: npt.ArrayLike, hi: npt.ArrayLike, *, inner: bool = False) -> Cells:
        """The regions of all leaves that meet a box, clipped to it; with ``inner`` those of all nodes.

        >>> import froe
        >>> froe.segments([[0, 1, 2, 1]]).build("autopartition").cells([0, 0], [2, 2]).polygons()[0].shape
        (4, 2)
        """
        box = np.stack([point(lo, "lo", self.dim), point(hi, "hi", self.dim)])
        return Cells(*(np.asarray(part) for part in self._core.cells(box, inner)))

    def order(self, eye: npt.ArrayLike, *, parallel: bool = False) -> Ids:
        """All pieces, back to front, as they are seen from a point, or with ``parallel`` from a direction.

        >>> import froe
        >>> tree = froe.segments([[0, 1, 2, 1], [0, 5, 2, 5]]).build("autopartition", purpose="draw")
        >>> [int(tree.pieces().objects[piece]) for piece in tree.order([1, 0])]
        [1, 0]
        """
        return np.asarray(self._core.order(point(eye, "eye", self.dim), parallel))

    def audit(self, *, exact_only: bool = False, threads: int = 0, progress: Progress | None = None) -> None:
        """Proves that the tree is right; otherwise AuditError.

        >>> import froe
        >>> froe.points([[0, 0], [1, 1]]).build().audit()
        """
        self._core.audit(exact_only, threads, progress)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the tree with its scene: the old file or the whole new one is there, whatever happens."""
        self._core.save(path)

    def export(
        self,
        path: str | os.PathLike[str],
        what: Literal["fragments", "cells", "cuts"] = "fragments",
        *,
        progress: Progress | None = None,
    ) -> None:
        """Writes pieces, cells or cuts for other programs: .geojson of the plane, .obj of space, or .csv."""
        parts = ("fragments", "cells", "cuts")
        if what not in parts:
            raise OptionError(f"what is {what!r}, and must be one of {', '.join(parts)}.")
        self._core.export(path, parts.index(what), progress)

    def render(self, *, progress: Progress | None = None, **options: Any) -> Picture:
        """A picture of a tree in space with hidden surfaces removed, exactly. The tree has to be built with
        ``purpose="draw"`` or ``"pieces"``. Options, all of which may be left out:

        ============================================================== ==============================================
        ``eye, target, up``                                            points; with ``fit`` only their direction counts
        ``parallel, fit, fov, scale``                                  how the scene becomes a page
        ``size, margin, millimetres, background``                      of the page; a colour like ``"#a0b1c2"``
        ``shading``                                                    ``flat, cel, plain, white, none``
        ``cel_levels, own_colours, cull_back, min_area``               how faces are filled, and which
        ``paint, seams, seam_width``                                   ``whole, regions, fragments``; ``underlap, ...``
        ``lines``                                                      kinds: ``border, silhouette, crease, ...``
        ``line_width, point_width, crease, halo, hidden, interleaved`` how lines are drawn
        ``decimals, ids, layers, title, description``                  of the file
        ============================================================== ==============================================

        >>> import froe
        >>> scene = froe.triangles([[[0, 0, 0], [4, 0, 0], [2, 0, 3]], [[0, 5, 0], [4, 5, 0], [2, 5, 3]]])
        >>> picture = scene.build(purpose="draw").render(eye=(0, -9, 0), parallel=True, lines=["border"])
        >>> picture.report.visible_faces, picture.report.hidden_faces, picture.svg[:4]
        (1, 1, '<svg')
        """
        return pictures.render(self, progress, options)

    def draw(
        self, *, width: float = 800, lo: npt.ArrayLike | None = None, hi: npt.ArrayLike | None = None
    ) -> Picture:
        """A picture of a partition of the plane: cells, deeper in colour where more cuts lead to them, and pieces.

        >>> import froe
        >>> froe.segments([[0, 0, 2, 2], [0, 2, 2, 0]]).build("autopartition").draw().svg[:4]
        '<svg'
        """
        return pictures.draw(self, width, lo, hi)

    def __reduce__(self) -> tuple[Any, ...]:
        """A pickle holds the path of a tree that was opened, and the bytes of another one."""
        if self._path is not None:
            return open, (self._path,)
        return _from_bytes, (self._core.to_bytes(),)

    def __enter__(self) -> Tree:
        return self

    def __exit__(self, *failure: object) -> None:
        self.close()

    def __repr__(self) -> str:
        try:
            found = self.report
        except ClosedError:
            return "<froe.Tree: closed>"
        return f"<froe.Tree: {found.objects} objects in R^{found.dim}, {found.pieces} pieces, by {found.method}>"

    def close(self) -> None:
        """Frees the tree. Questions raise ClosedError from now on."""
        self._core.close()


def open(path: str | os.PathLike[str]) -> Tree:
    """A tree that ``Tree.save`` or ``froe build`` has written.

    >>> import froe, tempfile, os
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     froe.points([[0, 0]]).build().save(os.path.join(folder, "a.froe"))
    ...     froe.open(os.path.join(folder, "a.froe")).report.objects
    1
    """
    return Tree(_core.open(path), os.path.abspath(os.fsdecode(path)))


def _from_bytes(saved: bytes) -> Tree:
    return Tree(_core.from_bytes(saved))
