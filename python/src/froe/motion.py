"""Moving objects, which are segments of the plane or triangles in space: when they touch, and a partition that is kept
right while they move. Times and lengths have the caller's units.
"""

from __future__ import annotations

import math
import os
from dataclasses import dataclass
from typing import NoReturn

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import Doubles, Ids, Progress, doubles, flat, point, rows, whole
from ._words import counted
from .errors import ArrayError
from .scene import Scene, core_of
from .tree import Tree

Bools = npt.NDArray[np.bool_]

EVENTS = _core.event_names()
_UPDATE, _REMOVE, _AUDIT = range(3)


@dataclass(frozen=True, eq=False)
class Contacts:
    """Pairs of objects that meet, each from one instant to another, in the order of their beginnings.

    :ivar a, b: the two objects
    :ivar begin: (n, 2): the true time lies between these two doubles, which are equal or nearly neighbours
    :ivar end: (n, 2): the same of the last instant
    :ivar instant: they meet at one instant alone
    :ivar since_start: they meet already when the time that was asked for begins
    :ivar to_stop: they still meet when it ends
    """

    a: Ids
    b: Ids
    begin: Doubles
    end: Doubles
    instant: Bools
    since_start: Bools
    to_stop: Bools

    def __len__(self) -> int:
        return len(self.a)


@dataclass(frozen=True, eq=False)
class Events:
    """Changes of a partition, in order of time. Event ``i`` is of the kind ``froe.motion.EVENTS[kinds[i]]``.

    :ivar kinds: numbers of kinds
    :ivar objects: (n, 4): what each is about, -1 where there are fewer
    :ivar counts: how many of these there are
    :ivar edges: (n, 4): in space the edges that it is about, as seen from above: 3 object + the number of the corner
        that each goes on from; -1 where there are fewer, as in the plane
    :ivar edge_counts: how many of these there are
    :ivar ticks: the instant at which the partition was changed, in ticks of the motion
    :ivar early, late: it happened between these times
    """

    kinds: Ids
    objects: Ids
    counts: Ids
    edges: Ids
    edge_counts: Ids
    ticks: npt.NDArray[np.int64]
    early: Doubles
    late: Doubles

    def __len__(self) -> int:
        return len(self.kinds)


@dataclass(frozen=True)
class Snapshot:
    """The present as an ordinary tree, over a scene of its own.

    :ivar tree: answers all questions; the tags of its objects are those of the motion's, or their numbers there
    :ivar rounded: how many vertices are not exactly where the tree has them
    :ivar alike: the tree has the cuts of the partition, as if nothing had been rounded
    """

    tree: Tree
    rounded: int
    alike: bool


class Motion:
    """Moving objects in a window of time: segments of the plane, or triangles in space.

    :param begin, end: the window; nothing is known before and after it
    :param dim: 2 for segments of the plane, 3 for triangles in space
    :param tick: the length of time that is told apart, a power of 2; 0: chosen by the window
    :raises OptionError: the dimension is another one, or the tick no power of 2
    :raises ArrayError: an array has another shape or type, or numbers that float64 does not have
    :raises InputError: the window is empty; NaN or infinity, times that do not ascend, or a plan that does not cover
        the life of its object
    :raises CancelledError: the progress function returned False

    >>> import froe
    >>> motion = froe.Motion(0, 10)
    >>> motion.add([0, 10, 0, 10], [[0, 0], [10, 0], [0, 1], [10, 1]], [0, 2, 4])   # an upright one moves to the right
    >>> motion.add([0, 0], [[5, 0], [5, 1]], [0, 1, 2])                             # another stands still
    >>> contacts = motion.contacts()
    >>> contacts.begin.tolist(), contacts.instant.tolist()
    ([[5.0, 5.0]], [True])
    """

    def __init__(self, begin: float, end: float, *, dim: int = 2, tick: float = 0.0) -> None:
        self._core = _core.motion(dim, begin, end, tick)

    @classmethod
    def _of(cls, core: _core.Motion) -> Motion:
        motion = cls.__new__(cls)
        motion._core = core
        return motion

    def __reduce__(self) -> NoReturn:
        raise TypeError("A Motion cannot be copied or pickled; files keep it: write().")

    @property
    def dim(self) -> int:
        """2 or 3."""
        return self._core.counts()[0]

    @property
    def window(self) -> tuple[float, float]:
        """The time that is considered.

        >>> import froe
        >>> froe.Motion(0, 10).window
        (0.0, 10.0)
        """
        return self._core.counts()[4:]

    def __len__(self) -> int:
        return self._core.counts()[1]

    def add_group(self, name: str = "") -> int:
        """A new group, which objects may then belong to.

        :param name: its name
        :returns: its number
        :cost: O(1)

        >>> import froe
        >>> froe.Motion(0, 10).add_group("lorry")
        0
        """
        return self._core.add_group(name)

    def add(
        self,
        times: npt.ArrayLike,
        coords: npt.ArrayLike,
        starts: npt.ArrayLike,
        *,
        controls: npt.ArrayLike | None = None,
        second_controls: npt.ArrayLike | None = None,
        vertices: npt.ArrayLike | None = None,
        bodies: npt.ArrayLike | None = None,
        births: npt.ArrayLike | None = None,
        deaths: npt.ArrayLike | None = None,
        tags: npt.ArrayLike | None = None,
        groups: npt.ArrayLike | None = None,
    ) -> None:
        """Adds objects. Vertex ``v`` passes ``coords[i]`` at ``times[i]``, for ``i`` from ``starts[v]`` to ``starts[v +
        1] - 1``, and in between it goes straight on at constant speed. A vertex with one time stands still.

        :param times: (m,), ascending for each vertex
        :param coords: (m, dim)
        :param starts: (vertices + 1,)
        :param controls: (m, dim); where it is not NaN, the vertex follows the parabola with this control point
        :param second_controls: (m, dim); where it is not NaN, the vertex follows the cubic with both control points
        :param vertices: (objects, dim) numbers of vertices that each object joins; None: each vertex once, in order
        :param bodies: (vertices,) the body of each vertex, which then has one time and its place in the body, from the
            centre; None: of none
        :param births, deaths: (objects,), times at which each appears and disappears; None: it is there all the time
        :param tags: (objects,) whole numbers that name them to the caller
        :param groups: (objects,) the group of each
        :cost: O(times + objects)
        """
        plans = doubles(times, "times").ravel()
        self._core.add(
            plans,
            rows(coords, "coords", self.dim, self.dim),
            whole(starts, "starts", np.uint64).ravel(),
            None if controls is None else rows(controls, "controls", self.dim, self.dim),
            None if second_controls is None else rows(second_controls, "second_controls", self.dim, self.dim),
            None if vertices is None else self._corners(whole(vertices, "vertices", np.uint32)),
            None if bodies is None else flat(whole(bodies, "bodies", np.uint32), "bodies"),
            None if births is None else flat(doubles(births, "births"), "births"),
            None if deaths is None else flat(doubles(deaths, "deaths"), "deaths"),
            None if tags is None else flat(whole(tags, "tags", np.uint64), "tags"),
            None if groups is None else flat(whole(groups, "groups", np.uint32), "groups"),
        )

    def _corners(self, vertices: npt.NDArray[np.uint32]) -> npt.NDArray[np.uint32]:
        """One after the other; so may they be given."""
        if vertices.ndim != 1 and (vertices.ndim != 2 or vertices.shape[1] != self.dim):
            raise ArrayError(f"vertices must have the shape (n, {self.dim}), and has {vertices.shape}.")
        return vertices.ravel()

    def add_body(
        self,
        times: npt.ArrayLike,
        coords: npt.ArrayLike,
        *,
        turns: npt.ArrayLike | None = None,
        controls: npt.ArrayLike | None = None,
    ) -> int:
        """A rigid body, which vertices may then belong to. Its centre passes ``coords[i]`` at ``times[i]``. In between it
        turns along the arc that a spherical interpolation takes, at nearly constant speed: in the plane, each vertex
        goes exactly along a circle around the centre.

        :param times: (m,), ascending
        :param coords: (m, dim)
        :param turns: (m, 4) quaternions x, y, z, w of length 1; in the plane (m, 2), the sine and the cosine of half of
            the angle; None: it does not turn
        :param controls: (m, dim); where it is not NaN, the centre follows the parabola with this control point
        :returns: its number
        :cost: O(times)

        >>> import froe
        >>> motion = froe.Motion(0, 2, dim=3)
        >>> body = motion.add_body([0, 2], [[0, 0, 0], [0, 0, 8]])
        >>> motion.add([0] * 3, [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [0, 1, 2, 3], bodies=[body] * 3)
        >>> motion.positions(1).tolist()
        [[0.0, 0.0, 4.0], [1.0, 0.0, 4.0], [0.0, 1.0, 4.0]]
        """
        each = 2 if self.dim == 2 else 4
        return self._core.add_body(
            doubles(times, "times").ravel(),
            rows(coords, "coords", self.dim, self.dim),
            None if controls is None else rows(controls, "controls", self.dim, self.dim),
            None if turns is None else rows(turns, "turns", each, each),
        )

    def positions(self, time: float) -> Doubles:
        """Where all vertices are at a time, for pictures: rounded to a few units in the last place.

        :param time: in the window
        :returns: (vertices, dim); NaN where the plan of a vertex does not cover the time
        :cost: O(vertices log times)

        >>> import froe
        >>> motion = froe.Motion(0, 4)
        >>> motion.add([0, 4, 0], [[0, 0], [4, 0], [9, 9]], [0, 2, 3])
        >>> motion.positions(1).tolist()
        [[1.0, 0.0], [9.0, 9.0]]
        """
        return np.asarray(self._core.positions(time))

    def contacts(
        self,
        begin: float = math.nan,
        end: float = math.nan,
        *,
        first: bool = False,
        apart: bool = False,
        threads: int = 0,
        progress: Progress | None = None,
    ) -> Contacts:
        """All contacts, none of which is missed, however short it is.

        :param begin, end: the time that counts; NaN: from the beginning and to the end of the window
        :param first: only what may be the first contact of all
        :param apart: without pairs of objects of one group
        :param threads: how many may work at once; 0: one for each processor
        :param progress: is called with the share done; False from it ends the call
        :cost: O(n log^2 n + candidates)
        """
        a, b, begins, ends, *flags = map(np.asarray, self._core.contacts(begin, end, first, apart, threads, progress))
        return Contacts(a, b, begins, ends, *(flag.view(np.bool_) for flag in flags))

    def without_bodies(self, deviation: float) -> tuple[Motion, float]:
        """The same motion, by the same numbers, but without bodies: their vertices fly along parabolas of their own. So
        partitions in space can follow bodies that turn. Corners in one place of a body become one vertex.

        :param deviation: how far a vertex may be from where its body has it, at any instant
        :returns: the motion, and a bound of how far vertices are off
        :raises ArgumentError: the deviation is not a number above 0
        :raises LimitError: doubles, or instants, are too far apart for this deviation
        :cost: O(times of the result)

        >>> import froe
        >>> motion = froe.Motion(0, 2, dim=3)
        >>> body = motion.add_body([0, 2], [[0, 0, 0]] * 2, turns=[[0, 0, 0, 1], [0, 0, 0.6, 0.8]])
        >>> motion.add([0] * 3, [[0, 0, 0], [1, 0, 0], [0, 1, 1]], [0, 1, 2, 3], bodies=[body] * 3)
        >>> curved, off = motion.without_bodies(0.001)
        >>> 0 < off <= 0.001, len(curved.kinetic().advance(2)) > 0
        (True, True)
        """
        core, reached = self._core.without_bodies(deviation)
        return Motion._of(core), reached

    def kinetic(
        self,
        *,
        seed: int = 1,
        augmented: bool = False,
        threads: int = 1,
        ghosts: bool = False,
        progress: Progress | None = None,
    ) -> Kinetic:
        """A partition of the motion, which is at the beginning of the window.

        :param seed: of random choices; the same seed gives the same partition on every machine
        :param augmented: a segment that turns upright costs nothing, however many it crosses
        :param threads: how many may work at once while time goes on, and on the tree of a snapshot, which changes
            nothing but the time it takes; 0: one for each processor
        :param ghosts: in space: of two triangles that meet, the one with the greater number is left out meanwhile;
            without it, time ends before the first contact
        :param progress: is called with the share done; False from it ends the call
        :raises UnsupportedError: the motion has objects that no partition follows
        :cost: O(n log^2 n + crossings log n) expected

        >>> import froe
        >>> motion = froe.Motion(0, 10)
        >>> motion.add([0, 10, 0, 10], [[0, 0], [10, 0], [0, 1], [10, 1]], [0, 2, 4])
        >>> 0 <= motion.kinetic().time < 1
        True
        """
        return Kinetic(self, _core.kinetic(self._core, seed, augmented, threads, ghosts, progress))

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes OGC Moving Features JSON, which ``froe.read_motion`` gives back.

        :param path: the file
        :raises FileError: the file cannot be written
        :cost: O(times + objects)

        >>> import froe, tempfile, os
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     froe.Motion(0, 4).write(os.path.join(folder, "a.mfjson"))
        ...     os.listdir(folder)
        ['a.mfjson']
        """
        self._core.write(path)

    def __repr__(self) -> str:
        begin, end = self.window
        return f"<froe.Motion: {counted(len(self), 'object')} in R^{self.dim}, from {begin:g} to {end:g}>"


class Kinetic:
    """A partition of moving objects, which is exact at every instant. It is made by ``Motion.kinetic``.

    :ivar motion: the motion
    :raises ArgumentError: a time before the present or after the window, or an object that does not exist
    :raises ArrayError: an array has another shape or type
    :raises BusyError: another thread is using it

    >>> import froe
    >>> motion = froe.Motion(0, 10)
    >>> motion.add([0, 10, 0, 10], [[0, 0], [10, 0], [0, 1], [10, 1]], [0, 2, 4])
    >>> motion.add([0, 0], [[5, 3], [6, 3]], [0, 1, 2])
    >>> kinetic = motion.kinetic()
    >>> events = kinetic.advance(5.5)
    >>> len(events) > 0, kinetic.locate([[5.4, 2]]).tolist(), kinetic.ray([[5, 0.5]], [[9, 0.5]]).tolist()
    (True, [[-1, 1, -1]], [0])
    >>> motion.add([0, 0], [[8, 0], [8, 1]], [0, 1, 2])
    >>> kinetic.update()
    >>> kinetic.remove(0)
    >>> kinetic.audit()
    >>> kinetic.ray([[5, 0.5]], [[9, 0.5]]).tolist()
    [2]
    """

    def __init__(self, motion: Motion, core: _core.Kinetic) -> None:
        self.motion = motion
        self._core = core

    @property
    def time(self) -> float:
        """The time that the partition has reached."""
        return self._core.now()[0]

    @property
    def next(self) -> float:
        """The time of the next event at the earliest; infinity where nothing happens in the rest of the window.

        >>> import froe
        >>> motion = froe.Motion(0, 4)
        >>> motion.add([0, 0], [[2, 0], [2, 1]], [0, 1, 2])   # it stands still
        >>> motion.kinetic().next
        inf
        """
        return self._core.now()[1]

    def advance(self, time: float, *, progress: Progress | None = None) -> Events:
        """Lets time go on, and repairs the partition at each event on the way.

        :param time: from the present to the end of the window
        :param progress: is called with the share done; False from it ends the call, between two events
        :returns: the events
        :cost: O(log n) expected for each event
        """
        return Events(*(np.asarray(part) for part in self._core.advance(time, progress)))

    def update(self) -> None:
        """Objects that were added to the motion meanwhile take part from now on.

        :cost: O(log n) expected for each object, and for each crossing
        """
        self._core.change(_UPDATE, 0)

    def remove(self, number: int) -> None:
        """Takes an object out, for good.

        :param number: the object
        :cost: O(log n) expected for each crossing
        """
        self._core.change(_REMOVE, number)

    def replan(
        self,
        vertex: int,
        times: npt.ArrayLike,
        coords: npt.ArrayLike,
        *,
        controls: npt.ArrayLike | None = None,
        second_controls: npt.ArrayLike | None = None,
    ) -> None:
        """Gives a vertex another plan from the present on. Where it is now may change, too.

        :param vertex: its number
        :param times: (m,), ascending, from the present or earlier on
        :param coords: (m, dim)
        :param controls, second_controls: (m, dim), as for ``Motion.add``
        :cost: O(log n) expected for each crossing of its objects

        >>> import froe
        >>> motion = froe.Motion(0, 10)
        >>> motion.add([0, 0, 0, 0], [[0, 0], [0, 1], [5, 0], [5, 1]], [0, 1, 2, 3, 4])   # two that stand still
        >>> kinetic = motion.kinetic()
        >>> kinetic.replan(1, [0, 10], [[0, 1], [10, 1]])                     # the upper end of the first moves
        >>> kinetic.advance(8).kinds.size > 0
        True
        """
        dim = self.motion.dim
        self._core.replan(
            vertex,
            doubles(times, "times").ravel(),
            rows(coords, "coords", dim, dim),
            None if controls is None else rows(controls, "controls", dim, dim),
            None if second_controls is None else rows(second_controls, "second_controls", dim, dim),
        )

    def order(self, eye: npt.ArrayLike) -> tuple[Ids, Doubles]:
        """All pieces of segments between the walls of the partition, at the present: what comes later is never hidden,
        as seen from the eye, by what came before.

        :param eye: (2,)
        :returns: (n,) objects, and (n, 4) the two ends of each piece, rounded
        :cost: O(pieces)

        >>> import froe
        >>> motion = froe.Motion(0, 10)
        >>> motion.add([0] * 4, [[0, 1], [2, 1], [0, 5], [2, 5]], [0, 1, 2, 3, 4])
        >>> motion.kinetic().order([1, 0])[0].tolist()
        [1, 1, 0]
        """
        objects, ends = self._core.order(point(eye, "eye", 2))
        return np.asarray(objects), np.asarray(ends)

    def audit(self) -> None:
        """Proves that the partition is right, by comparing it with one that is made anew. It returns nothing when all
        is well.

        :raises InputError: something is wrong; the message says what
        :cost: that of making a partition
        """
        self._core.change(_AUDIT, 0)

    def locate(self, points: npt.ArrayLike) -> Ids:
        """For each point the segment that it lies on, the next one above, and the next one below, at the present.

        :param points: (n, 2)
        :returns: (n, 3) objects, -1: none
        :cost: O(log n) expected for a point
        """
        return np.asarray(self._core.locate(rows(points, "points", 2, 2)))

    def ray(self, origins: npt.ArrayLike, ends: npt.ArrayLike) -> Ids:
        """The first segment on each way from one point straight to another, at the present.

        :param origins, ends: (n, 2)
        :returns: (n,) objects, -1: none
        :cost: O(log n + segments and cells passed) expected for each
        """
        start, stop = rows(origins, "origins", 2, 2), rows(ends, "ends", 2, 2)
        if len(start) != len(stop):
            raise ArrayError(f"There are {len(start)} origins and {len(stop)} ends.")
        return np.asarray(self._core.ray(np.hstack([start, stop])))

    def snapshot(self, *, refuse: bool = False, progress: Progress | None = None) -> Snapshot:
        """The present as an ordinary tree, for all other questions.

        :param refuse: rather none than one with rounded places
        :param progress: is called with the share done; False from it ends the call
        :raises UnsupportedError: with ``refuse``, places have more digits than doubles have
        :cost: O(nodes)

        >>> import froe
        >>> motion = froe.Motion(0, 4)
        >>> motion.add([0, 4, 0, 4], [[0, 0], [4, 0], [0, 1], [4, 1]], [0, 2, 4])
        >>> kinetic = motion.kinetic()
        >>> _ = kinetic.advance(2)
        >>> kinetic.snapshot().tree.count([[1.9, 0, 2.1, 1]]).tolist()
        [1]
        """
        tree, rounded, alike = self._core.snapshot(refuse, progress)
        return Snapshot(Tree(tree), rounded, alike)


def read_motion(path: str | os.PathLike[str]) -> Motion:
    """A motion from OGC Moving Features JSON (``MovingLineString`` and ``MovingPolygon``).

    :param path: the file
    :raises FileError: the file cannot be opened or read
    :raises FormatError: it is not what it claims to be; the message says where
    :cost: O(size of the file)

    >>> import froe, tempfile, os
    >>> motion = froe.Motion(0, 4)
    >>> motion.add([0, 4, 0, 4], [[0, 0], [4, 0], [0, 1], [4, 1]], [0, 2, 4])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     motion.write(os.path.join(folder, "a.mfjson"))
    ...     len(froe.read_motion(os.path.join(folder, "a.mfjson")))
    1
    """
    return Motion._of(_core.read_motion(path))


def read_poses(
    path: str | os.PathLike[str], model: Scene, begin: float = math.nan, end: float = math.nan
) -> Motion:
    """A model in motion, from a CSV file with the header ``body,time,x,y,z,qx,qy,qz,qw``. A row is where the group of
    that name is at an instant: turned about the origin by the quaternion, and then moved. Columns may be in any order,
    and those of the turn may be missing.

    :param path: the file
    :param model: polygons in space
    :param begin, end: the window; NaN: the first and the last instant in the file
    :raises FileError: the file cannot be opened or read
    :raises FormatError: a column is missing
    :raises InputError: the model has no such group, or a row is wrong; the message says which
    :cost: O(rows + size of the model)

    >>> import froe, tempfile, os
    >>> model = froe.Scene(3)
    >>> model.add_triangles([[[0, 0, 0], [1, 0, 0], [0, 1, 0]]], group=model.add_group("door"))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     with open(os.path.join(folder, "a.csv"), "w") as file:
    ...         _ = file.write("body,time,x,y,z\\ndoor,0,0,0,0\\ndoor,4,0,0,8\\n")
    ...     froe.read_poses(os.path.join(folder, "a.csv"), model).positions(2)[0].tolist()
    [0.0, 0.0, 4.0]
    """
    return Motion._of(_core.read_poses(path, core_of(model, "model"), begin, end))


def generate_motion(kind: str, count: int, seed: int = 1) -> Motion:
    """A made-up motion, the same everywhere, in a window from 0 to 60.

    :param kind: ``froe generate --help`` lists them
    :param count: about so many objects
    :param seed: of the random numbers
    :raises OptionError: there is no such kind
    :raises ArgumentError: the count is 0
    :cost: O(count)

    >>> import froe
    >>> froe.generate_motion("moving", 20)
    <froe.Motion: 20 objects in R^2, from 0 to 60>
    """
    return Motion._of(_core.generate_motion(kind, count, seed))
