"""What is looked at when the package is imported: that the extension was compiled so that its arithmetic can be
trusted. With flags like -ffast-math answers would still be exact where they can, by slow arithmetic alone, and wrong
where such flags break that, too."""

from __future__ import annotations

import numpy as np

from . import _core

# The doubles next to 0.1 and 0.3: the point (1, 0.1) is not on the segment, by 3 * 0.1 - 0.3 = 2.8e-17.
_SEGMENTS = np.array([[0.0, 0.0, 3.0, 0.3], [0.0, 2.0, 3.0, -1.0], [1.0, -1.0, 2.0, 3.0]])
_POINTS = np.array([[1.0, 0.1], [0.0, 0.0], [1.5, 0.5]])
_LOCATED = [0, 0, 1, 2]


def check() -> None:
    """ImportError, which says why, if something is wrong.

    >>> check()
    """
    scene = _core.scene(2)
    scene.add(1, _SEGMENTS, None, None, None, None, None, None, None, 1, None)
    tree = scene.build("autopartition", "pieces", "", None, 1, None, 0, 1, None)
    located = np.asarray(tree.locate(_POINTS, 1, None)[0]).tolist()
    if located != _LOCATED:
        raise ImportError(f"froe was compiled so that exact questions get wrong answers: {located}, not {_LOCATED}.")
    if not tree.report()["predicates_filtered"]:
        raise ImportError(
            "froe was compiled so that sums and products of doubles are not rounded one by one, to nearest. "
            "It needs -ffp-contract=off, and no -ffast-math."
        )
