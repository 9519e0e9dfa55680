"""Moving objects: segments of the plane, or triangles in space; when they touch, and a partition that is kept right
while they move."""

from __future__ import annotations

import math
import os
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import Doubles, Ids, Progress, doubles, rows, whole
from .errors import ArrayError
from .tree import Tree

Bools = npt.NDArray[np.bool_]

EVENTS = (
    "vertices",
    "vertex crossing",
    "crossings",
    "contact",
    "triple",
    "turn",
    "batch",
    "plan",
    "appear",
    "disappear",
)
_UPDATE, _REMOVE, _AUDIT = range(3)


@dataclass(frozen=True)
class Contacts:
    """Pairs of objects that meet, each from one instant to another, in the order of their beginnings.

    :ivar begin: (n, 2): the true time lies between these two doubles, which are equal or nearly neighbours; so ``end``
    :ivar instant: they meet at one instant alone
    :ivar since_start: they meet already when the time asked for begins; ``to_stop``: still when it ends
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


@dataclass(frozen=True)
class Events:
    """Changes of a partition, in order of time. Event ``i`` is of the kind ``EVENTS[kinds[i]]``.

    :ivar objects: (n, 4): what each is about, -1 where there are fewer; ``counts`` tells how many there are
    :ivar early, late: it happened between these times
    """

    kinds: Ids
    objects: Ids
    counts: Ids
    ticks: npt.NDArray[np.int64]
    early: Doubles
    late: Doubles

    def __len__(self) -> int:
        return len(self.kinds)


@dataclass(frozen=True)
class Snapshot:
    """The present as an ordinary tree, over a scene of its own. ``rounded`` vertices are not exactly where the tree has
    them; ``alike``: the tree has the cuts of the partition, as if nothing had been rounded."""

    tree: Tree
    rounded: int
    alike: bool


class Motion:
    """Moving objects in a window of time: segments of the plane (``dim`` 2), or triangles in space (3).

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
        """A group, which objects may then belong to. Returns its number."""
        return self._core.add_group(name)

    def add(
        self,
        times: npt.ArrayLike,
        coords: npt.ArrayLike,
        starts: npt.ArrayLike,
        *,
        controls: npt.ArrayLike | None = None,
        vertices: npt.ArrayLike | None = None,
        births: npt.ArrayLike | None = None,
        deaths: npt.ArrayLike | None = None,
        tags: npt.ArrayLike | None = None,
        groups: npt.ArrayLike | None = None,
    ) -> None:
        """Adds objects. Vertex ``v`` passes ``coords[i]`` at ``times[i]``, for ``i`` from ``starts[v]`` to
        ``starts[v + 1] - 1``; in between it goes straight on at constant speed, or on the parabola with the control
        point ``controls[i]`` where that is not NaN. A vertex with one time stands still. Objects join the vertices in
        the rows of ``vertices``, by default each vertex once, in order.
        """
        plans = doubles(times, "times").ravel()
        self._core.add(
            plans,
            rows(coords, "coords", self.dim, self.dim),
            whole(starts, "starts", np.uint64).ravel(),
            None if controls is None else rows(controls, "controls", self.dim, self.dim),
            None if vertices is None else whole(vertices, "vertices", np.uint32).ravel(),
            None if births is None else doubles(births, "births"),
            None if deaths is None else doubles(deaths, "deaths"),
            None if tags is None else whole(tags, "tags", np.uint64),
            None if groups is None else whole(groups, "groups", np.uint32),
        )

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
        """All contacts, none of which is missed, however short; NaN: from the beginning and to the end of the window.
        ``first``: only what may be the first of all. ``apart``: without pairs of objects of one group."""
        a, b, begins, ends, *flags = map(np.asarray, self._core.contacts(begin, end, first, apart, threads, progress))
        return Contacts(a, b, begins, ends, *(flag.view(np.bool_) for flag in flags))

    def kinetic(self, *, seed: int = 1, augmented: bool = False, progress: Progress | None = None) -> Kinetic:
        """A partition of the motion, which is at the beginning of the window."""
        return Kinetic(self, _core.kinetic(self._core, seed, augmented, progress))

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes OGC Moving Features JSON, which ``froe.read_motion`` gives back."""
        self._core.write(path)

    def __repr__(self) -> str:
        begin, end = self.window
        return f"<froe.Motion: {len(self)} objects in R^{self.dim}, from {begin:g} to {end:g}>"


class Kinetic:
    """A partition of moving objects, exact at every instant it stands at.

    >>> import froe
    >>> motion = froe.Motion(0, 10)
    >>> motion.add([0, 10, 0, 10], [[0, 0], [10, 0], [0, 1], [10, 1]], [0, 2, 4])
    >>> motion.add([0, 0], [[5, 3], [6, 3]], [0, 1, 2])
    >>> kinetic = motion.kinetic()
    >>> events = kinetic.advance(5.5)
    >>> len(events) > 0, kinetic.locate([[5.4, 2]]).tolist()
    (True, [[-1, 1, -1]])
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
        """The time of the next event at the earliest; infinity: nothing happens in the rest of the window."""
        return self._core.now()[1]

    def advance(self, time: float, *, progress: Progress | None = None) -> Events:
        """Lets time go on, and returns what happened; in space, where events are not told, none."""
        plane = self.motion.dim == 2
        found = self._core.advance(time, plane, progress)
        if found is None:
            nothing = np.empty(0)
            ids, ticks = nothing.astype(np.int32), nothing.astype(np.int64)
            return Events(ids, ids.reshape(0, 4), ids, ticks, nothing, nothing)
        return Events(*(np.asarray(part) for part in found))

    def update(self) -> None:
        """Objects that were added to the motion meanwhile take part from now on."""
        self._core.change(_UPDATE, 0)

    def remove(self, number: int) -> None:
        """Takes an object out, for good."""
        self._core.change(_REMOVE, number)

    def audit(self) -> None:
        """Compares the partition with one made from scratch; InputError if something is wrong."""
        self._core.change(_AUDIT, 0)

    def locate(self, points: npt.ArrayLike) -> Ids:
        """For each point the segment that it lies on, the next one above, and the next one below; -1: none."""
        return np.asarray(self._core.locate(rows(points, "points", 2, 2)))

    def ray(self, origins: npt.ArrayLike, ends: npt.ArrayLike) -> Ids:
        """The first segment met on each way from one point to another, -1: none."""
        start, stop = rows(origins, "origins", 2, 2), rows(ends, "ends", 2, 2)
        if len(start) != len(stop):
            raise ArrayError(f"There are {len(start)} origins and {len(stop)} ends.")
        return np.asarray(self._core.ray(np.hstack([start, stop])))

    def snapshot(self, *, refuse: bool = False, progress: Progress | None = None) -> Snapshot:
        """The present as a tree, for all other questions; ``refuse``: rather none than one with rounded places.

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
    """A motion from OGC Moving Features JSON.

    >>> import froe, tempfile, os
    >>> motion = froe.Motion(0, 4)
    >>> motion.add([0, 4, 0, 4], [[0, 0], [4, 0], [0, 1], [4, 1]], [0, 2, 4])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     motion.write(os.path.join(folder, "a.mfjson"))
    ...     len(froe.read_motion(os.path.join(folder, "a.mfjson")))
    1
    """
    return Motion._of(_core.read_motion(path))
