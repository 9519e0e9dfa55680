"""Measures of scenes, on which the bounds of methods depend: fatness, density, clutter, directional density, defects.

Bounds are certified for the numbers of the scene. Where there are more than ``samples`` objects, a random sample of so
many is used (0: all), the same for the same seed.

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
from .scene import Scene

Measure = TypeVar("Measure")


@dataclass(frozen=True)
class Spread:
    """How values are distributed; all 0 without any."""

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
    """What is odd about a scene: objects without extent or equal to others, and pairs that cross, touch or overlap."""

    zero_length: int
    zero_area: int
    duplicates: int
    crossings: int
    t_junctions: int
    overlaps: int


@dataclass(frozen=True)
class Fatness:
    """Volume over that of the smallest enclosing ball; of polygons area over that of the disc (``flat``) and width over
    length (``sliver``). ``thin`` counts objects without volume."""

    full: Spread
    flat: Spread
    sliver: Spread
    thin: int


@dataclass(frozen=True)
class Density:
    """lower <= density <= upper; the ball at ``centre`` meets ``lower`` objects of at least its size. ``upper`` is that
    of the ``count`` objects in the sample. ``load``: neighbours of at least its own size, for each object."""

    lower: int
    upper: int
    count: int
    centre: tuple[float, ...]
    radius: float
    load: Spread


@dataclass(frozen=True)
class Clutter:
    """The cube from ``lo`` to ``hi`` has no corner of a bounding box inside, and ``lower`` objects meet it."""

    lower: int
    lo: tuple[float, ...]
    hi: tuple[float, ...]
    count: int
    load: Spread


@dataclass(frozen=True)
class Directional:
    """How many other boxes cross the plane of a face near it, by four ways to say near."""

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
    """Counts what is odd, exactly.

    >>> import froe
    >>> defects(froe.segments([[0, 0, 2, 2], [0, 2, 2, 0], [1, 1, 1, 1]])).crossings
    1
    """
    return _filled(Defects, scene._core.defects(0, 1, threads, progress))


def fatness(scene: Scene, *, samples: int = 20000, seed: int = 1, progress: Progress | None = None) -> Fatness:
    """How fat objects are.

    >>> import froe
    >>> fatness(froe.boxes([[0, 0, 1, 1]])).full.median > 0.6
    True
    """
    return _filled(Fatness, scene._core.fatness(samples, seed, 0, progress))


def density(
    scene: Scene, *, diameter: bool = False, samples: int = 20000, seed: int = 1, progress: Progress | None = None
) -> Density:
    """The most objects, of at least the size of a ball, that meet a ball: by the radius of the smallest enclosing ball,
    or by the diameter.

    >>> import froe
    >>> density(froe.segments([[0, 0, 1, 0], [0, 1, 1, 1]])).count
    2
    """
    return _filled(Density, scene._core.density(diameter, samples, seed, 0, progress))


def clutter(scene: Scene, *, samples: int = 20000, seed: int = 1, progress: Progress | None = None) -> Clutter:
    """The most objects that meet a cube without a corner of a bounding box inside: a lower bound.

    >>> import froe
    >>> clutter(froe.segments([[0, 0, 1, 0], [0, 1, 1, 1]])).lower >= 1
    True
    """
    return _filled(Clutter, scene._core.clutter(samples, seed, 0, progress))


def directional(
    scene: Scene, delta: float = 1.0, *, samples: int = 20000, seed: int = 1, progress: Progress | None = None
) -> Directional:
    """Directional density of bounding boxes, with neighbourhoods of ``delta`` times a side.

    >>> import froe
    >>> directional(froe.boxes([[0, 0, 1, 1], [2, 0, 3, 1]]), 2.0).count
    2
    """
    return _filled(Directional, scene._core.directional(delta, samples, seed, 0, progress))
