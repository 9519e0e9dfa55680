"""Ranges of queries, as the extension takes them: one shape for all, and its numbers."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any, Literal, NamedTuple, get_args

import numpy as np
import numpy.typing as npt

from ._arrays import Doubles, doubles, flat, point, rows
from .errors import ArrayError, OptionError, UnsupportedError

BOX, BALL, CAPSULE, HULL, SEGMENT = 0, 1, 3, 5, 6  # froe_range_shape

Round = tuple[npt.ArrayLike, npt.ArrayLike]  # points or segments, and radii
Points = Sequence[npt.ArrayLike]
Relation = Literal["meets", "within", "covers"]  # froe_relation, in this order


class Ranges(NamedTuple):
    """As the extension takes them."""

    shape: int
    points: Doubles
    starts: npt.NDArray[np.uint64] | None = None
    radii: Doubles | None = None


def one_or_many(
    dim: int,
    boxes: npt.ArrayLike | None = None,
    ball: Any = None,
    polygon: npt.ArrayLike | None = None,
    **many: Any,
) -> tuple[bool, Ranges]:
    """Is a single range asked for? And the ranges."""
    if ball is not None and polygon is not None:
        raise TypeError("A query takes ranges of one kind, and 2 are given.")
    if ball is not None:
        if not isinstance(ball, tuple) or len(ball) != 2:
            raise ArrayError("A ball is a tuple of its centre and its radius.")
        return True, of(dim, boxes, balls=(point(ball[0], "centre", dim)[None], ball[1]), **many)
    if polygon is not None:
        return True, of(dim, boxes, hulls=[convex(rows(polygon, "polygon", dim, dim))], **many)
    array = None if boxes is None else doubles(boxes, "boxes")
    if array is not None and array.ndim == 1 and len(array):
        return True, of(dim, point(array, "box", 2 * dim)[None], **many)
    return False, of(dim, array, **many)


def convex(corners: Doubles) -> Doubles:
    """The corners of a polygon of the plane, if it is convex."""
    if corners.shape[1] != 2 or len(corners) < 3:
        raise ArrayError(f"polygon must have the shape (n, 2) with 3 corners at least, and has {corners.shape}.")
    if not np.isfinite(corners).all():
        return corners  # which is refused as any range is
    points = [(Fraction(x), Fraction(y)) for x, y in corners.tolist()]
    steps = [(b[0] - a[0], b[1] - a[1]) for a, b in zip(points, points[1:] + points[:1]) if a != b]
    nowhere = (Fraction(0), Fraction(0))
    turns = [u[0] * v[1] - u[1] * v[0] for u, v in zip(steps, steps[1:] + steps[:1])]
    back = any(turn == 0 and u[0] * v[0] + u[1] * v[1] < 0 for turn, u, v in zip(turns, steps, steps[1:] + steps[:1]))
    # Of a polygon that turns one way alone and goes round once, the steps go up once and down once.
    ups = [v > nowhere for v in steps]
    rounds = sum(a != b for a, b in zip(ups, ups[1:] + ups[:1]))
    if back or rounds > 2 or (min(turns, default=0) < 0 < max(turns, default=0)):
        raise UnsupportedError(
            "The polygon is not convex. What lies in other polygons is answered by join_groups(), where they are "
            "groups of a tree, and by froe.compat.shapely.STRtree."
        )
    return corners


def of(
    dim: int,
    boxes: npt.ArrayLike | None = None,
    balls: Round | None = None,
    segments: npt.ArrayLike | None = None,
    capsules: Round | None = None,
    hulls: Points | None = None,
) -> Ranges:
    """The one kind that is given."""
    given = sum(shape is not None for shape in (boxes, balls, segments, capsules, hulls))
    if given != 1:
        raise TypeError(f"A query takes ranges of one kind, and {given} are given.")
    if boxes is not None:
        return Ranges(BOX, rows(boxes, "boxes", 2 * dim, dim))
    if segments is not None:
        return Ranges(SEGMENT, rows(segments, "segments", 2 * dim, dim))
    if balls is not None:
        return _round(BALL, balls, "centres", dim, dim)
    if capsules is not None:
        return _round(CAPSULE, capsules, "segments", 2 * dim, dim)
    assert hulls is not None
    return _hulls(hulls, dim)


def _round(shape: int, given: Any, name: str, width: int, dim: int) -> Ranges:
    if not isinstance(given, tuple) or len(given) != 2:
        raise ArrayError(f"Ranges with radii are a tuple of {name} and radii.")
    points = rows(given[0], name, width, dim)
    radii = doubles(given[1], "radii")
    if radii.ndim == 0:
        radii = np.full(len(points), float(radii))
    return Ranges(shape, points, None, flat(radii, "radii"))


def _hulls(hulls: Points, dim: int) -> Ranges:
    parts = [rows(points, f"hull {i}", dim, dim) for i, points in enumerate(hulls)]
    starts = np.cumsum([0] + [len(part) for part in parts], dtype=np.uint64)
    return Ranges(HULL, np.concatenate(parts) if parts else np.empty((0, dim)), starts)


def relation(name: str) -> int:
    """The number of a relation of groups to ranges."""
    names = get_args(Relation)
    if name not in names:
        raise OptionError(f"relation is {name!r}, and must be one of {', '.join(names)}.")
    return names.index(name)
