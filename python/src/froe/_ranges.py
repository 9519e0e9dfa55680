"""Ranges of queries, as the extension takes them: one shape for all, and its numbers."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal, NamedTuple, get_args

import numpy as np
import numpy.typing as npt

from ._arrays import Doubles, doubles, rows
from .errors import ArrayError, OptionError

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


def of(
    dim: int,
    boxes: npt.ArrayLike | None,
    balls: Round | None,
    segments: npt.ArrayLike | None,
    capsules: Round | None,
    hulls: Points | None,
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
    return Ranges(shape, points, None, radii)


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
