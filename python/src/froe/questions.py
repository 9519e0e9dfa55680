"""What trees answer."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal, overload

import numpy as np
import numpy.typing as npt

from . import _core, _ranges
from ._arrays import Doubles, Ids, Progress, doubles, rows, whole
from ._ranges import Points, Relation, Round
from .answers import Answers

if TYPE_CHECKING:
    from .tree import Tree

_IDS, _COUNTS, _ANY, _GROUPS = range(4)
_FIRST, _ALL = range(2)
_ONE_THREAD = 1

MEETINGS = ("cross", "touch", "overlap")  # froe_meeting
PAIR = np.dtype([("a", np.int32), ("b", np.int32), ("kind", np.int32)])


class Questions:
    """The questions of a tree.

    Questions are arrays; one call answers all of them, on ``threads`` threads (0: one per processor). Objects and
    ranges are closed, so that touching counts as meeting, and every answer is exact.
    """

    _core: _core.Tree

    @property
    def dim(self) -> int:
        """The dimension of the space."""
        return self._core.dim()

    @overload
    def query(  # type: ignore[misc] # a sequence of floats is an array, too
        self, boxes: Sequence[float], *, eps: float = 0.0, threads: int = 0, progress: Progress | None = None
    ) -> Ids: ...
    @overload
    def query(  # type: ignore[misc] # a call without ranges is of both kinds, and refused
        self,
        *,
        ball: tuple[npt.ArrayLike, float] | None = None,
        polygon: npt.ArrayLike | None = None,
        eps: float = 0.0,
        threads: int = 0,
        progress: Progress | None = None,
    ) -> Ids: ...
    @overload
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
    ) -> Answers: ...
    def query(
        self,
        boxes: npt.ArrayLike | None = None,
        *,
        eps: float = 0.0,
        threads: int = 0,
        progress: Progress | None = None,
        **ranges: Any,
    ) -> Answers | Ids:
        """The objects that meet each range, of one kind: boxes (n, 2 dim) of lower and upper corners; balls, centres
        (n, dim) and radii; segments (n, 2 dim); capsules, segments and radii: all points that near to them; or hulls, a
        sequence of arrays of points, each the smallest convex set around its points.

        For one box of shape (2 dim,), one ``ball`` (a centre and a radius), or one convex ``polygon`` (its corners in
        order), the answer is an array of ids.

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
        >>> tree.query([0, 0, 1, 1]), tree.query(ball=([3, 3], 1)), tree.query(polygon=[[2, 0], [4, 0], [4, 2]])
        (array([0], dtype=int32), array([1], dtype=int32), array([1], dtype=int32))
        """
        one, found = _ranges.one_or_many(self.dim, boxes, **ranges)
        if found.shape == _ranges.BOX and eps == 0:
            answers = Answers(*self._core.boxes(found.points, threads, progress))
        else:
            answers = Answers(*self._core.ranges(_IDS, *found, eps, 0, threads, progress))
        return answers.ids if one else answers

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
        self, objects: npt.ArrayLike, points: npt.ArrayLike, *, progress: Progress | None = None
    ) -> Doubles:
        """The point of each object that is nearest to the point beside it.

        >>> import froe
        >>> tree = froe.segments([[0, 0, 4, 0]]).build()
        >>> tree.nearest_points([0], [[1, 2]]).tolist()
        [[1.0, 0.0]]
        """
        ids = whole(objects, "objects", np.uint32)
        return np.asarray(self._core.nearest_points(ids, self._rows(points, "points", 1), _ONE_THREAD, progress))

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
        points, normals, distances = self._core.hit_places(ids, start, way, _ONE_THREAD, progress)
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
    ) -> npt.NDArray[np.void]:
        """All pairs of objects that meet, ``a < b``, and how they meet: an array with the fields ``a``, ``b`` and
        ``kind`` (``MEETINGS`` names it: 0 cross, 1 touch, 2 overlap). ``shared=False`` leaves out those that touch in
        nothing but one corner of both.

        >>> import froe
        >>> found = froe.segments([[0, 0, 2, 2], [0, 2, 2, 0], [3, 0, 4, 0]]).build().pairs()
        >>> found["a"].tolist(), found["b"].tolist(), froe.questions.MEETINGS[found["kind"][0]]
        ([0], [1], 'cross')
        """
        return np.asarray(self._core.pairs(shared, threads, progress)).view(PAIR).reshape(-1)
