"""Geometries with what is made of them once: a tree, their boundaries, their polygons."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from froe.adapters.features import Features

if TYPE_CHECKING:
    from froe.tree import Tree

Floats = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]


class Layer:
    """The points and segments of geometries in one tree, in which each geometry is a group."""

    def __init__(self, features: Features) -> None:
        self.features = features
        #: the geometry of each object of the tree
        self.owner = features.owners()

    @cached_property
    def tree(self) -> Tree:
        """Of all segments, then all points."""
        return self.features.scene().build(purpose="query")

    @cached_property
    def boundary(self) -> Layer:
        """The boundary of each geometry."""
        return Layer(self.features.boundary())

    @cached_property
    def dims(self) -> Integers:
        """The dimension of each geometry: that of what it has of the highest one, -1 of an empty one."""
        kinds = self.features.kinds()
        dims: Integers = np.where(kinds.any(axis=0), 2 - np.argmax(kinds[::-1], axis=0), -1)
        return dims

    @cached_property
    def mixed(self) -> npt.NDArray[np.bool_]:
        """Has the geometry parts of several dimensions?"""
        mixed: npt.NDArray[np.bool_] = self.features.kinds().sum(axis=0) > 1
        return mixed

    @cached_property
    def polygons(self) -> tuple[Layer, Integers]:
        """Each polygon as a geometry of its own, and the geometry that it is a part of."""
        polygons, owner = self.features.polygons()
        return Layer(polygons), owner


def pairs(first: npt.NDArray[Any], second: npt.NDArray[Any]) -> Integers:
    """Two rows, sorted, each pair once."""
    both = np.stack([np.asarray(first, np.int64), np.asarray(second, np.int64)])
    both = both[:, np.lexsort((both[1], both[0]))]
    new = np.ones(both.shape[1], bool)
    new[1:] = (both[:, 1:] != both[:, :-1]).any(axis=0)
    found: Integers = both[:, new]
    return found


def joined(*lists: Integers) -> Integers:
    """Pairs that are in any of the lists."""
    both = np.concatenate(lists, axis=1)
    return pairs(both[0], both[1])


def among(some: Integers, others: Integers) -> npt.NDArray[np.bool_]:
    """Which pairs are among the others?"""
    width = 1 + max(some[1].max(initial=0), others[1].max(initial=0))
    return np.isin(some[0] * width + some[1], others[0] * width + others[1])


def without(some: Integers, others: Integers) -> Integers:
    """Pairs that are not among the others."""
    return some[:, ~among(some, others)]


def turned(some: Integers) -> Integers:
    """The second of each pair first."""
    return pairs(some[1], some[0])
