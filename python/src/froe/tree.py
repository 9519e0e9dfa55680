"""Trees: what they answer, and how they are saved, opened, looked at and drawn."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from . import _core, pictures, report
from ._arrays import Ids, Progress, doubles, point
from ._words import counted
from .errors import ClosedError, OptionError
from .parts import Cells, Pieces
from .pictures import Picture
from .questions import Questions
from .report import Report

if TYPE_CHECKING:
    from .scene import Scene
    from .scene_parts import ReadReport


class Tree(Questions):
    """A binary space partition of a scene. Made by ``Scene.build``, or opened from a file by ``froe.open``.

    Questions are arrays, and one call answers all of them. Objects and ranges are closed sets, so that touching counts
    as meeting, and every answer is exact for the numbers given. A tree never changes, so that any number of Python's
    threads may use it at once. Most questions take, by name:

    - ``threads``: how many may work on it at once; 0: one for each processor
    - ``progress``: a function that is called now and then with the share done, from 0 to 1; False from it ends the call

    Ctrl-C ends calls that take ``progress``, too, and others once they are done. In a ``with`` statement the tree is
    closed at its end.

    :raises ArrayError: an array has another shape or type, or numbers that float64 does not have
    :raises InputError: NaN or infinity, or a box whose upper corner is below its lower one; ``.object`` is its row
    :raises UnsupportedError: trees of this kind cannot serve the question; the message says which can
    :raises ClosedError: the tree is closed
    :raises CancelledError: the progress function returned False
    :raises OutOfMemoryError: there is not enough memory for the answers
    """

    def __init__(self, core: _core.Tree, path: str | None = None, read: ReadReport | None = None) -> None:
        self._core = core
        self._path = path
        self._read = read  # how its scene was

    @property
    def scene(self) -> Scene:
        """The scene that the tree was built of. It cannot grow any more, and it keeps the tree alive.

        >>> import froe
        >>> len(froe.points([[0, 0], [1, 1]]).build().scene)
        2
        """
        from .scene import Scene

        return Scene._of(self._core.scene(), self._read)

    @property
    def report(self) -> Report:
        """What the tree consists of: method, objects, nodes, pieces, height, bytes and more.

        >>> import froe
        >>> froe.points([[0, 0], [1, 1]]).build().report.objects
        2
        """
        return report.of(self._core.report())

    def pieces(self) -> Pieces:
        """All pieces of the tree, as arrays.

        :cost: O(nodes + pieces)

        >>> import froe
        >>> tree = froe.segments([[0, 0, 2, 2], [0, 2, 2, 0]]).build("autopartition", purpose="pieces")
        >>> len(tree.pieces())
        3
        """
        return Pieces(*(np.asarray(part) for part in self._core.pieces()))

    def cells(
        self, lo: npt.ArrayLike | None = None, hi: npt.ArrayLike | None = None, *, inner: bool = False
    ) -> Cells:
        """The regions of all leaves that meet a box, clipped to it.

        :param lo, hi: (dim,), the corners of the box; None: those of ``scene.bounds``
        :param inner: the regions of all nodes, not only of leaves
        :raises UnsupportedError: the dimension is neither 2 nor 3
        :cost: O(height) for each cell, and its corners

        >>> import froe
        >>> tree = froe.segments([[0, 1, 2, 1], [1, 0, 1, 2]]).build("autopartition")
        >>> len(tree.cells()), tree.cells([0, 0], [0.5, 0.5]).polygons()[0].tolist()
        (2, [[0.0, 0.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5]])
        """
        bounds = self.scene.bounds
        lower, upper = np.zeros((2, self.dim)) if bounds is None else bounds
        box = np.stack(
            [
                lower if lo is None else point(lo, "lo", self.dim),
                upper if hi is None else point(hi, "hi", self.dim),
            ]
        )
        return Cells(*(np.asarray(part) for part in self._core.cells(box, inner)))

    def order(self, eye: npt.ArrayLike, *, parallel: bool = False) -> Ids:
        """All pieces, back to front, as they are seen.

        :param eye: (dim,), the point that they are seen from
        :param parallel: the eye is infinitely far away, in the direction ``eye``
        :returns: numbers of pieces, those of ``pieces()``
        :raises UnsupportedError: the tree was built for queries, and has no cut between some of its pieces
        :cost: O(nodes + pieces)

        >>> import froe
        >>> tree = froe.segments([[0, 1, 2, 1], [0, 5, 2, 5]]).build("autopartition", purpose="draw")
        >>> [int(tree.pieces().objects[piece]) for piece in tree.order([1, 0])]
        [1, 0]
        """
        return np.asarray(self._core.order(point(eye, "eye", self.dim), parallel))

    def audit(self, *, exact_only: bool = False, threads: int = 0, progress: Progress | None = None) -> None:
        """Proves that the tree is right: every object is exactly the union of its pieces, and every piece is in the
        list of its cell. It returns nothing when all is well.

        :param exact_only: decides everything by exact numbers, without the doubles that decide most of it; much slower
        :raises AuditError: the tree is wrong; the message says where
        :cost: about as much as building the tree

        >>> import froe
        >>> froe.points([[0, 0], [1, 1]]).build().audit()
        """
        self._core.audit(exact_only, threads, progress)

    def check(self) -> None:
        """Checks all of an opened tree, its scene and the checksums of the file. It returns nothing when all is well.

        :raises FormatError: the file is corrupted
        :cost: O(size of the file); O(1) for a tree that was built, or has been found right

        >>> import froe
        >>> froe.points([[0, 0]]).build().check()
        """
        self._core.check()

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the tree with its scene. The old file or the whole new one is there, whatever happens.

        :param path: where to
        :raises FileError: the file cannot be written
        :cost: O(size of the tree and its scene)

        >>> import froe, tempfile, os
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     froe.points([[0, 0]]).build().save(os.path.join(folder, "a.froe"))
        ...     os.listdir(folder)
        ['a.froe']
        """
        self._core.save(path)

    def export(
        self,
        path: str | os.PathLike[str],
        what: Literal["fragments", "cells", "cuts"] = "fragments",
        *,
        progress: Progress | None = None,
    ) -> None:
        """Writes pieces, cells or cuts for other programs.

        :param path: its ending is that of the format: .geojson of the plane, .obj of space, or .csv
        :param what: ``"fragments"``, which are the pieces, ``"cells"`` or ``"cuts"``
        :raises OptionError: there is no such part
        :raises FileError: the file cannot be written
        :cost: O(size of the tree)

        >>> import froe, tempfile, os
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     froe.segments([[0, 0, 1, 1]]).build().export(os.path.join(folder, "a.geojson"), "cells")
        ...     os.listdir(folder)
        ['a.geojson']
        """
        parts = ("fragments", "cells", "cuts")
        if what not in parts:
            raise OptionError(f"what is {what!r}, and must be one of {', '.join(parts)}.")
        self._core.export(path, parts.index(what), progress)

    def render(self, *, progress: Progress | None = None, **options: Any) -> Picture:
        """A picture of a tree in space with hidden surfaces removed, exactly. The tree has to be built with
        ``purpose="draw"`` or ``"pieces"``. These options may be given by name; the page on drawings describes each:

        ============================================================== ==============================================
        ``eye, target, up``                                            points; with ``fit`` only their direction counts
        ``parallel, fit, fov, scale``                                  how the scene becomes a page
        ``size, margin, millimetres, background``                      of the page; a colour like ``"#a0b1c2"``
        ``shading``                                                    ``flat, cel, plain, white, none``
        ``cel_levels, own_colours, cull_back, min_area``               how faces are filled, and which
        ``paint, seams, seam_width``                                   ``whole, regions, fragments``; ``underlap, ...``
        ``lines``                                                      kinds: ``border, silhouette, crease, ...``
        ``line_width, point_width, crease, halo, hidden, interleaved`` how lines are drawn
        ``decimals, ids, layers, title, description``                  of the file
        ============================================================== ==============================================

        :param options: as the table says
        :raises OptionError: there is no such option, or its value is out of range
        :raises UnsupportedError: the scene is not in space, or the tree was built for queries
        :cost: O(pieces + visible pieces) times the depth of the tree of what is in front, about 20 to 60 in models

        >>> import froe
        >>> scene = froe.triangles([[[0, 0, 0], [4, 0, 0], [2, 0, 3]], [[0, 5, 0], [4, 5, 0], [2, 5, 3]]])
        >>> picture = scene.build(purpose="draw").render(eye=(0, -9, 0), parallel=True, lines=["border"])
        >>> picture.report.visible_faces, picture.report.hidden_faces, picture.svg[:4]
        (1, 1, '<svg')
        """
        return pictures.render(self, progress, options)

    def draw(
        self, *, width: float = 800, lo: npt.ArrayLike | None = None, hi: npt.ArrayLike | None = None
    ) -> Picture:
        """A picture of a partition of the plane: its cells, deeper in colour where more cuts lead to them, and its
        pieces.

        :param width: of the picture, in pixels
        :param lo, hi: (2,), corners of the box that is shown; None: all objects, and a little more
        :raises UnsupportedError: the tree is not one of the plane
        :raises OptionError: the width is not a finite number above 0
        :raises ArgumentError: the box has no extent
        :cost: O(height) for each cell that is shown

        >>> import froe
        >>> froe.segments([[0, 0, 2, 2], [0, 2, 2, 0]]).build("autopartition").draw().svg[:4]
        '<svg'
        """
        return pictures.draw(self, width, lo, hi)

    def __reduce__(self) -> tuple[Any, ...]:
        """A pickle holds the path of a tree that was opened, and the bytes of another one."""
        if self._path is not None:
            return open, (self._path,)
        return _from_bytes, (self._core.to_bytes(),)

    def __copy__(self) -> Tree:
        """Of the bytes of the tree: there may be another one in the file that it was opened from."""
        return Tree(_core.from_bytes(self._core.to_bytes()), read=self._read)

    def __deepcopy__(self, _: object) -> Tree:
        return self.__copy__()

    def __enter__(self) -> Tree:
        return self

    def __exit__(self, *failure: object) -> None:
        self.close()

    def __repr__(self) -> str:
        try:
            found = self.report
        except ClosedError:
            return "<froe.Tree: closed>"
        objects, pieces = counted(found.objects, "object"), counted(found.pieces, "piece")
        return f"<froe.Tree: {objects} in R^{found.dim}, {pieces}, by {found.method}>"

    def close(self) -> None:
        """Frees the tree. Every later question raises ClosedError. Without it the tree is freed with its last
        reference.

        :cost: O(nodes)

        >>> import froe
        >>> tree = froe.points([[0, 0]]).build()
        >>> tree.close()
        >>> tree
        <froe.Tree: closed>
        """
        self._core.close()


def open(path: str | os.PathLike[str]) -> Tree:
    """Opens a tree that ``Tree.save`` or ``froe build`` has written. The file is mapped into memory, and its parts are
    checked when they are first read, so that questions may raise FormatError, too. ``Tree.check`` checks all at once.

    :param path: the file
    :raises FileError: the file cannot be opened
    :raises FormatError: the file is no tree, truncated, or of another version of froe
    :cost: O(1); what is checked later costs O(size of the file) at most

    >>> import froe, tempfile, os
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     froe.points([[0, 0]]).build().save(os.path.join(folder, "a.froe"))
    ...     froe.open(os.path.join(folder, "a.froe")).report.objects
    1
    """
    return Tree(_core.open(path), os.path.abspath(os.fsdecode(path)))


def _from_bytes(saved: bytes) -> Tree:
    return Tree(_core.from_bytes(saved))
