"""Answers to many questions: a ragged array."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, SupportsIndex

import numpy as np
import numpy.typing as npt

from ._arrays import Doubles, Ids, part
from ._words import counted


class Answers:
    """A ragged array: any number of answers to each question. Those to question ``i`` are ``ids[starts[i]:starts[i +
    1]]``, which is ``answers[i]``. ``len(answers)`` is the number of questions, and a loop goes through these.

    ``==`` compares no numbers, here and wherever froe returns several arrays as one object: such an object is equal to
    itself alone. ``numpy.array_equal`` compares the arrays.

    :ivar starts: int64, one more than questions
    :ivar ids: int32, objects or groups
    :ivar values: float64 beside the ids: distances, or parameters of rays; None where there are none
    :param starts, ids, values: the same
    :raises IndexError: there is no such question

    >>> import froe
    >>> tree = froe.segments([[0, 0, 2, 2], [3, 0, 3, 2]]).build(purpose="query")
    >>> answers = tree.query([[0, 0, 1, 1], [9, 9, 9, 9], [0, 0, 3, 3]])
    >>> len(answers), answers.starts.tolist(), sorted(answers[2].tolist())
    (3, [0, 1, 1, 3], [0, 1])
    """

    __slots__ = ("ids", "starts", "values")

    def __init__(self, starts: Any, ids: Any, values: Any = None) -> None:
        self.starts: npt.NDArray[np.int64] = np.asarray(starts)
        self.ids: Ids = np.asarray(ids)
        self.values: Doubles | None = None if values is None else np.asarray(values)

    def __len__(self) -> int:
        return len(self.starts) - 1

    def __getitem__(self, question: SupportsIndex) -> Ids:
        return part(self.ids, self.starts, question, "question")

    def __iter__(self) -> Iterator[Ids]:
        return (self[i] for i in range(len(self)))

    def __repr__(self) -> str:
        return f"<froe.Answers: {counted(len(self.ids), 'answer')} to {counted(len(self), 'question')}>"

    def counts(self) -> npt.NDArray[np.int64]:
        """How many answers each question has.

        :returns: (questions,) int64
        :cost: O(questions)

        >>> Answers([0, 2, 2], [5, 7]).counts().tolist()
        [2, 0]
        """
        return np.diff(self.starts)

    def pairs(self) -> npt.NDArray[np.int64]:
        """All answers as an array of two rows, questions and ids, as ``shapely.STRtree.query`` returns them.

        :returns: (2, answers) int64
        :cost: O(questions + answers)

        >>> Answers([0, 2, 2, 3], [5, 7, 6]).pairs().tolist()
        [[0, 0, 2], [5, 7, 6]]
        """
        return np.stack([np.repeat(np.arange(len(self)), self.counts()), self.ids.astype(np.int64)])
