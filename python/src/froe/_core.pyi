from collections.abc import Callable
from typing import Any

from ._arrays import Doubles

Progress = Callable[[float], object] | None

version: str

class Array:
    """Memory of froe's, by the buffer protocol: ``numpy.asarray`` of it is a view."""

    def __len__(self) -> int: ...

Ragged = tuple[Array, Array, Array | None]

class Scene:
    def add(
        self,
        kind: int,
        coords: Doubles,
        indices: Any,
        starts: Any,
        radii: Any,
        tags: Any,
        faces: Any,
        groups: Any,
        group: int | None,
        threads: int,
        progress: Progress,
        /,
    ) -> None: ...
    def build(
        self,
        method: str,
        purpose: str,
        settings: str,
        leaf: int | None,
        seed: int,
        order: Any,
        max_pieces: int,
        threads: int,
        progress: Progress,
        /,
    ) -> Tree: ...
    def counts(self) -> tuple[int, int, int, int]: ...

class Tree:
    def boxes(self, boxes: Doubles, threads: int, progress: Progress, /) -> Ragged: ...
    def close(self) -> None: ...

def scene(dim: int, /) -> Scene: ...
