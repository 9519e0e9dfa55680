"""What trees answer."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal, overload

import numpy as np
import numpy.typing as npt

from . import _core, _ranges
from ._arrays import Doubles, Ids, Progress, doubles, flat, rows, whole
from ._ranges import Points, Relation, Round
from .answers import Answers
from .errors import ArrayError

if TYPE_CHECKING:
    from .tree import Tree

_IDS, _COUNTS, _ANY, _GROUPS = range(4)
_FIRST, _ALL = range(2)
_ONE_THREAD = 1

MEETINGS = ("cross", "touch", "overlap")  # froe_meeting
PAIR = np.dtype([("a", np.int32), ("b", np.int32), ("kind", np.int32)])


class Questions:
    """What a tree answers: the base class of ``froe.Tree``, which says how."""

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
        """The objects that meet each range. The ranges of one call are of one kind.

        :param boxes: (n, 2 dim) or (n, 2, dim), lower and upper corners; or one box, (2 dim,)
        :param balls: a tuple of centres (n, dim) and radii, one for all or (n,); or ``ball``, one centre and its radius
        :param segments: (n, 2 dim) or (n, 2, dim), both ends
        :param capsules: a tuple of segments and radii: all points that near to the segments
        :param hulls: a sequence of n arrays (corners, dim): the smallest convex set around each
        :param polygon: one convex polygon of the plane, (corners, 2), in order
        :param eps: above 0 answers may be found sooner: all objects that meet a range, and perhaps others that are no
            farther from it than ``eps`` times its diameter
        :returns: ids of objects, of each question in no particular order; for one box, ``ball`` or ``polygon`` an array
            of them
        :raises TypeError: there are no ranges, or ranges of several kinds
        :cost: O(log n + answers) for a range where density is low, about 0.3 microseconds in a map; O(n) at worst

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

        :param box: (2 dim,), its lower and its upper corner
        :returns: ids of objects
        :cost: that of ``query`` for one box

        >>> import froe
        >>> froe.segments([[0, 0, 2, 2], [3, 0, 3, 2]]).build().query_one([0, 0, 1, 1])
        array([0], dtype=int32)
        """
        if type(box) is np.ndarray:
            try:
                return np.asarray(self._core.box(box))
            except ArrayError:
                pass  # it has another type or layout, which most boxes of a loop do not have
        return np.asarray(self._core.box(doubles(box, "box")))

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

        :param boxes, balls, segments, capsules, hulls: ranges as for ``query``
        :returns: (n,) int64
        :cost: that of ``query`` at most, without memory for answers

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

        :param boxes, balls, segments, capsules, hulls: ranges as for ``query``
        :returns: (n,) ids; which of several it is, is the same at each call
        :cost: that of ``query`` at most; it ends at the first object

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

        :param points: (n, dim)
        :returns: ids of objects
        :cost: O(log n) for a point where density is low

        >>> import froe
        >>> froe.segments([[0, 0, 2, 2]]).build().locate([[1, 1], [1, 0]]).counts().tolist()
        [1, 0]
        """
        return Answers(*self._core.locate(self._rows(points, "points", 1), threads, progress))

    def groups(self, points: npt.ArrayLike, *, threads: int = 0, progress: Progress | None = None) -> Answers:
        """The groups that each point of the plane lies in: countries of a map, for example. A point on a border is in
        every group whose border it is.

        :param points: (n, 2)
        :returns: numbers of groups, ascending
        :raises UnsupportedError: also where the rings of a group do not close
        :cost: O(log n + groups) for a point; the first call takes about as long as building the tree

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
        """The groups of the plane that meet each range, lie within it, or cover it. A group whose segments are closed
        rings is an area with its border, and every other group is the set of the points of its objects.

        :param boxes, balls, segments, capsules, hulls: ranges as for ``query``
        :param relation: ``"meets"``: they have a point in common; ``"within"``: every point of the group is one of the
            range; ``"covers"``: every point of the range is one of the group
        :returns: numbers of groups, ascending
        :raises UnsupportedError: also for groups that are to cover balls or capsules, which is not decided
        :cost: that of ``query``, and for ``"covers"`` O(log) for each piece of a border in the range

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
        """The groups of this tree that meet each group of another tree of the plane, lie within it, or cover it. So
        polygons with holes, paths and sets of points are questions.

        :param questions: the other tree, whose groups are the questions; it may be this tree
        :param relation: ``"meets"``, ``"within"`` or ``"covers"``, as for ``query_groups``
        :returns: numbers of groups, ascending
        :cost: that of ``query`` for each object of a question; a few microseconds for each piece of a border near both

        >>> import froe
        >>> from shapely.geometry import Point, box
        >>> parks = froe.from_shapely([box(0, 0, 4, 4), box(2, 2, 8, 8)]).build()
        >>> things = froe.from_shapely([Point(3, 3), box(0, 0, 1, 1), box(0, 0, 9, 9)]).build()
        >>> parks.join_groups(things, relation="covers").pairs().tolist()
        [[0, 0, 1], [0, 1, 0]]
        >>> parks.join_groups(things, relation="within").pairs().tolist()
        [[2, 2], [0, 1]]
        """
        if not isinstance(questions, Questions):
            raise TypeError(f"questions is {questions!r}, and must be a froe.Tree.")
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
        """The nearest object to each point, and its distance. Of equally near ones the lowest id comes first; that they
        are equally near is decided exactly.

        :param points: (n, dim)
        :param k: how many objects
        :param max_distance: those farther away do not count
        :returns: for ``k`` = 1 ids and distances, (n,) each, -1 and infinity where there is none; otherwise answers,
            nearest first, with distances as values, which are the doubles nearest to the exact ones
        :raises InputError: also for a ``max_distance`` that is negative or NaN
        :cost: O(log n + k) for a point where density is low, about 0.6 microseconds in a map

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

        :param objects: (n,) ids
        :param points: (n, dim)
        :returns: (n, dim), the doubles nearest to the exact coordinates
        :cost: O(1) for each

        >>> import froe
        >>> tree = froe.segments([[0, 0, 4, 0]]).build()
        >>> tree.nearest_points([0], [[1, 2]]).tolist()
        [[1.0, 0.0]]
        """
        ids = flat(whole(objects, "objects", np.uint32), "objects")
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
        """The object that each ray meets first, and where: at ``origin + t * direction``.

        :param origins: (n, dim)
        :param directions: (n, dim), of any length but 0
        :param t_max: rays end there; infinity: nowhere
        :param all: every object that a ray meets, not only the first
        :returns: ids and ``t``, (n,) each, -1 and infinity where there is none; with ``all`` answers by ``t``, which
            are values
        :raises InputError: also for a direction that is 0
        :cost: O(log n) for each cell on the way of a ray where density is low

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
        """Where each ray first meets the object beside it, which it has to meet.

        :param objects: (n,) ids, as ``ray`` returns them
        :param origins: (n, dim)
        :param directions: (n, dim)
        :returns: points (n, dim); normals (n, dim) of length 1, or 0 where there is none; distances from the origin
            (n,); a normal is the object's own, whichever side the ray comes from. Seen from where it points to, the
            corners of a polygon turn left. That of a segment of the plane points to its left, and others outwards
        :cost: O(1) for each

        >>> import froe
        >>> tree = froe.segments([[2, -1, 2, 1]]).build()
        >>> [found.tolist() for found in tree.hit_places([0, 0], [[0, 0], [5, 0]], [[1, 0], [-1, 0]])]
        [[[2.0, 0.0], [2.0, 0.0]], [[-1.0, 0.0], [-1.0, 0.0]], [2.0, 3.0]]
        """
        ids = flat(whole(objects, "objects", np.uint32), "objects")
        start, way = self._rows(origins, "origins", 1), self._rows(directions, "directions", 1)
        points, normals, distances = self._core.hit_places(ids, start, way, _ONE_THREAD, progress)
        return np.asarray(points), np.asarray(normals), np.asarray(distances)

    def above(
        self, points: npt.ArrayLike, *, below: bool = False, threads: int = 0, progress: Progress | None = None
    ) -> Ids:
        """The first segment of the plane straight above each point, -1 where there is none. A segment through the point
        counts.

        :param points: (n, 2)
        :param below: the first one straight below instead
        :returns: (n,) ids
        :cost: that of ``ray``

        >>> import froe
        >>> froe.segments([[0, 2, 4, 2]]).build().above([[1, 1], [1, 3]]).tolist()
        [0, -1]
        """
        return np.asarray(self._core.vertical(self._rows(points, "points", 1), below, threads, progress))

    def pairs(
        self, *, shared: bool = True, threads: int = 0, progress: Progress | None = None
    ) -> npt.NDArray[np.void]:
        """All pairs of objects that meet, and how.

        :param shared: False leaves out pairs that touch in nothing but one corner of both
        :returns: (m,) with the fields ``a`` and ``b``, two objects, the lower id first, and ``kind``, a number of
            ``froe.questions.MEETINGS``: 0 they cross, 1 they touch, 2 they overlap
        :cost: O(n log n + pairs) where density is low

        >>> import froe
        >>> found = froe.segments([[0, 0, 2, 2], [0, 2, 2, 0], [3, 0, 4, 0]]).build().pairs()
        >>> found["a"].tolist(), found["b"].tolist(), froe.questions.MEETINGS[found["kind"][0]]
        ([0], [1], 'cross')
        """
        return np.asarray(self._core.pairs(shared, threads, progress)).view(PAIR).reshape(-1)
