"""Pieces of the plane as lines that can be drawn."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from . import _kinds
from ._arrays import Doubles

if TYPE_CHECKING:
    from .tree import Tree

_CHORDS = 64


def of_pieces(tree: Tree) -> list[Doubles]:
    """The corners of a line for each piece: the border of a box, a ball or a hull, none of which a tree of the plane
    cuts, and a part of a segment."""
    pieces, scene = tree.pieces(), tree.scene.arrays()
    forms, radii = scene.forms[pieces.objects], scene.radii[pieces.objects]
    return [_line(form, pieces[i], radius) for i, (form, radius) in enumerate(zip(forms.tolist(), radii.tolist()))]


def _line(form: int, corners: Doubles, radius: float) -> Doubles:
    if form == _kinds.BOX:
        return np.column_stack([corners[[0, 1, 1, 0, 0], 0], corners[[0, 0, 1, 1, 0], 1]])
    if form == _kinds.BALL:
        angles = np.linspace(0, 2 * np.pi, _CHORDS + 1)
        circle: Doubles = corners[0] + radius * np.column_stack([np.cos(angles), np.sin(angles)])
        return circle
    return _around(corners) if form == _kinds.HULL else corners


def _around(points: Doubles) -> Doubles:
    """The border of the convex hull, as far as doubles tell: the lower half from left to right, and the upper half back.
    Andrew, Another efficient algorithm for convex hulls in two dimensions, 1979."""
    across = points[np.lexsort((points[:, 1], points[:, 0]))].tolist()
    border: list[list[float]] = []
    for half in (across, across[::-1]):
        start = len(border)
        for x, y in half:
            while len(border) >= start + 2:
                (ax, ay), (bx, by) = border[-2:]
                if (bx - ax) * (y - ay) > (by - ay) * (x - ax):
                    break
                border.pop()
            border.append([x, y])
        if start == 0:
            border.pop()  # the other half begins there
    return np.array(border) if len(points) > 1 else points
