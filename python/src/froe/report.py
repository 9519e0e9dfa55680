"""What a tree consists of, and what its method promised."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any


@dataclass(frozen=True)
class Promise:
    """A bound that a method promises of its trees, and what was measured. It holds where measured <= promised."""

    name: str
    promised: float
    measured: float

    @property
    def holds(self) -> bool:
        """Is what was measured within what was promised?"""
        return self.measured <= self.promised


@dataclass(frozen=True)
class Report:
    """Counts of a tree, as ``froe build`` prints them.

    >>> import froe
    >>> report = froe.points([[0, 0], [1, 1]]).build("kd").report
    >>> report.method, report.objects, report.pieces
    ('kd', 2, 2)

    :ivar method: that built the tree, and ``settings`` all its options
    :ivar pieces: in all lists; of these ``in_cut`` lie in the cut of their node, and ``covers`` contain its region
    :ivar size: nodes and entries of lists; ``height`` is the number of cuts on the longest path
    :ivar inseparable: leaves over capacity that nothing can separate; ``crowded``: that more cuts would not thin out
    :ivar bytes: of the tree, without its scene
    :ivar predicates: sides that were asked for while building, and by which stage each was decided
    """

    method: str
    settings: str
    dim: int
    leaf: int
    seed: int
    objects: int
    nodes: int
    leaves: int
    pieces: int
    in_cut: int
    covers: int
    size: int
    height: int
    mean_depth: float
    max_leaf: int
    inseparable: int
    crowded: int
    bytes: int
    predicates: int
    predicates_by_id: int
    predicates_filtered: int
    predicates_refined: int
    predicates_exact: int
    promises: tuple[Promise, ...]

    @property
    def pieces_per_object(self) -> float:
        """At least 1, unless there are no objects."""
        return self.pieces / self.objects if self.objects else 0.0


def of(found: dict[str, Any]) -> Report:
    """The report from what the extension tells."""
    known: dict[str, Any] = {field.name: found[field.name] for field in fields(Report)}
    known["promises"] = tuple(Promise(*promise) for promise in found["promises"])
    return Report(**known)
