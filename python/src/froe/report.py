"""What a tree consists of, and what its method promised."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any


@dataclass(frozen=True)
class Promise:
    """A bound that a method promises of its trees, beside what was measured.

    :ivar name: what is bounded, for example ``"height"``
    :ivar promised: the bound, for this scene
    :ivar measured: the value of this tree
    """

    name: str
    promised: float
    measured: float

    @property
    def holds(self) -> bool:
        """Is what was measured within what was promised?

        >>> import froe
        >>> report = froe.generate("segments", 200).build("density", purpose="pieces").report
        >>> all(promise.holds for promise in report.promises)
        True
        """
        return self.measured <= self.promised


@dataclass(frozen=True)
class Report:
    """Counts of a tree, as ``froe build`` prints them.

    :ivar method: that built the tree
    :ivar settings: all options of the method, as ``"name=value ..."``
    :ivar dim: dimension of the space
    :ivar leaf: the most objects of a leaf that were asked for
    :ivar seed: of random choices
    :ivar objects: of the scene
    :ivar nodes: of the tree, with its leaves
    :ivar leaves: nodes without a cut
    :ivar pieces: in all lists of nodes
    :ivar in_cut: pieces that lie in the cut of their node
    :ivar covers: pieces that contain the whole region of their node
    :ivar size: nodes and entries of lists
    :ivar height: the number of cuts on the longest path
    :ivar mean_depth: the number of cuts on the way to a piece, on average
    :ivar max_leaf: pieces in the fullest leaf
    :ivar inseparable: leaves over capacity that nothing can separate
    :ivar crowded: leaves over capacity that more cuts would not thin out
    :ivar bytes: of the tree, without its scene
    :ivar predicates: how often the side of a point was decided while the tree was built; 0 for one that was opened
    :ivar predicates_by_id: of these, because the point is known to be on the line or plane
    :ivar predicates_filtered: in doubles, with a bound of the error
    :ivar predicates_refined: with more digits
    :ivar predicates_exact: by exact numbers
    :ivar promises: bounds that the method promises

    >>> import froe
    >>> report = froe.points([[0, 0], [1, 1]]).build("kd").report
    >>> report.method, report.objects, report.pieces
    ('kd', 2, 2)
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
        """The number of pieces divided by that of objects: at least 1, and 0 where there are no objects.

        >>> import froe
        >>> froe.segments([[0, 0, 2, 2], [0, 2, 2, 0]]).build("autopartition").report.pieces_per_object
        1.5
        """
        return self.pieces / self.objects if self.objects else 0.0


def of(found: dict[str, Any]) -> Report:
    """The report from what the extension tells."""
    known: dict[str, Any] = {field.name: found[field.name] for field in fields(Report)}
    known["promises"] = tuple(Promise(*promise) for promise in found["promises"])
    return Report(**known)
