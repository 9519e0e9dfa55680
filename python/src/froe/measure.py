"""Measures of scenes, on which the bounds of methods depend: fatness, density, clutter, directional density, defects.

Every function takes a ``scene``, ``seed`` and ``progress``, a function that is called with the share done and ends the
call by returning False. Where there are more than ``samples`` objects, a random sample of so many is used (0: all), the
same for the same seed. Lower bounds hold for the whole scene, upper bounds for the sample.

:raises CancelledError: the progress function returned False
:raises ArgumentError: an argument is out of range
:raises TypeError: the scene is something else, such as a tree, whose ``scene`` can be measured

>>> import froe, froe.measure
>>> scene = froe.generate("segments", 1000)
>>> found = froe.measure.density(scene)
>>> 1 <= found.lower <= found.upper
True
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any, TypeVar

from ._arrays import Progress
from .scene import Scene, core_of

Measure = TypeVar("Measure")


@dataclass(frozen=True)
class Spread:
    """How values are distributed; all are 0 where there are none.

    :ivar count: how many there are
    :ivar least, most: the least and the largest
    :ivar q05, q25, median, q75, q95: 5, 25, 50, 75 and 95 % of the values are not above these
    :ivar mean: the average
    """

    count: int
    least: float
    q05: float
    q25: float
    median: float
    q75: float
    q95: float
    most: float
    mean: float


@dataclass(frozen=True)
class Defects:
    """What is odd about a scene. Pairs are of segments in the plane and of polygons in space, and are counted once.

    :ivar zero_length: segments without length
    :ivar zero_area: polygons without area
    :ivar duplicates: objects that are equal to earlier ones
    :ivar crossings: pairs that meet where neither has a corner, and do not overlap
    :ivar t_junctions: pairs of which a corner of one lies in the other, where that has none
    :ivar overlaps: pairs with a segment (in the plane) or an area (in space) in common, which are not equal
    """

    zero_length: int
    zero_area: int
    duplicates: int
    crossings: int
    t_junctions: int
    overlaps: int


@dataclass(frozen=True)
class Fatness:
    """How fat objects are: near 1 for balls, near 0 for needles.

    :ivar full: volume divided by that of the smallest enclosing ball
    :ivar flat: of polygons in space, area divided by that of the smallest enclosing disc
    :ivar sliver: of these, width divided by length
    :ivar thin: how many objects have no volume
    """

    full: Spread
    flat: Spread
    sliver: Spread
    thin: int


@dataclass(frozen=True)
class Density:
    """The most objects that meet a ball and are at least as large as the ball: between ``lower`` and ``upper``.

    :ivar lower: the ball at ``centre`` meets so many
    :ivar upper: no ball meets more of the objects in the sample
    :ivar count: objects in the sample
    :ivar centre, radius: of a ball that meets ``lower`` objects
    :ivar load: of each object: those of at least its size within three radii of its centre
    """

    lower: int
    upper: int
    count: int
    centre: tuple[float, ...]
    radius: float
    load: Spread


@dataclass(frozen=True)
class Clutter:
    """The most objects that meet a cube without a corner of a bounding box inside it: at least ``lower``.

    :ivar lower: the cube from ``lo`` to ``hi`` meets so many
    :ivar lo, hi: corners of that cube
    :ivar count: cubes that were tried
    :ivar load: of each cube that cannot grow any more: the objects that meet it
    """

    lower: int
    lo: tuple[float, ...]
    hi: tuple[float, ...]
    count: int
    load: Spread


@dataclass(frozen=True)
class Directional:
    """How many other boxes cross the plane of a face of a box near that face, by four definitions of near.

    :ivar delta: how far near is, in sides of a box
    :ivar count: boxes in the sample
    :ivar simple: each face is widened by ``delta`` times its own sides
    :ivar extended: by 1 + 2 ``delta`` times its longest side
    :ivar two_directional: by as much, but on one axis by ``delta`` times the side
    :ivar paired: the same for the two faces across that axis alone
    """

    delta: float
    count: int
    simple: Spread
    extended: Spread
    two_directional: Spread
    paired: Spread


def _filled(kind: type[Measure], found: dict[str, Any]) -> Measure:
    """A measure of the numbers that the extension has found; those of a spread come as a tuple."""
    spreads = {field.name for field in fields(kind) if str(field.type) == Spread.__name__}
    return kind(**{name: Spread(*value) if name in spreads else value for name, value in found.items()})


def defects(scene: Scene, *, threads: int = 0, progress: Progress | None = None) -> Defects:
    """Counts what is odd about a scene, exactly.

    :param threads: how many may work at once; 0: one for each processor
    :cost: O(n log n + pairs of bounding boxes that touch)

    >>> import froe
    >>> defects(froe.segments([[0, 0, 2, 2], [0, 2, 2, 0], [1, 1, 1, 1]])).crossings
    1
    """
    return _filled(Defects, core_of(scene, "scene").defects(0, 1, threads, progress))


def fatness(scene: Scene, *, samples: int = 20000, seed: int = 1, progress: Progress | None = None) -> Fatness:
    """How fat objects are.

    :cost: O(n)

    >>> import froe
    >>> fatness(froe.boxes([[0, 0, 1, 1]])).full.median > 0.6
    True
    """
    return _filled(Fatness, core_of(scene, "scene").fatness(samples, seed, 0, progress))


def density(
    scene: Scene, *, diameter: bool = False, samples: int = 20000, seed: int = 1, progress: Progress | None = None
) -> Density:
    """The most objects that meet a ball and are at least as large as the ball.

    :param diameter: how large an object is, is told by its diameter; otherwise by its smallest enclosing ball
    :cost: O(n log n + neighbours)

    >>> import froe
    >>> density(froe.segments([[0, 0, 1, 0], [0, 1, 1, 1]])).count
    2
    """
    return _filled(Density, core_of(scene, "scene").density(diameter, samples, seed, 0, progress))


def clutter(scene: Scene, *, samples: int = 20000, seed: int = 1, progress: Progress | None = None) -> Clutter:
    """The most objects that meet a cube without a corner of a bounding box inside it: a lower bound.

    :cost: O(n log n + samples (log n + objects that meet each cube))

    >>> import froe
    >>> clutter(froe.segments([[0, 0, 1, 0], [0, 1, 1, 1]])).lower >= 1
    True
    """
    return _filled(Clutter, core_of(scene, "scene").clutter(samples, seed, 0, progress))


def directional(
    scene: Scene, delta: float = 1.0, *, samples: int = 20000, seed: int = 1, progress: Progress | None = None
) -> Directional:
    """How many other boxes cross the plane of a face of a bounding box near that face.

    :param delta: how far near is, in sides of a box
    :cost: O(n log n + samples (log n + boxes))

    >>> import froe
    >>> directional(froe.boxes([[0, 0, 1, 1], [2, 0, 3, 1]]), 2.0).count
    2
    """
    return _filled(Directional, core_of(scene, "scene").directional(delta, samples, seed, 0, progress))
