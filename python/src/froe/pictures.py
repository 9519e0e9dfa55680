"""Pictures: of trees in space with hidden surfaces removed, exactly, and of partitions of the plane."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _outlines
from ._arrays import Doubles, doubles, point
from ._words import counted
from .errors import ArgumentError, FileError, OptionError, UnsupportedError

if TYPE_CHECKING:
    from .tree import Tree

# In the order of the C interface's enumerators.
SHADINGS = ("flat", "cel", "plain", "white", "none")
PAINTS = ("whole", "regions", "fragments")
SEAMS = ("underlap", "none", "twice", "stroke")
IDS = ("none", "object", "face")
LAYERS = ("none", "object", "kind")
LINES = ("border", "silhouette", "object", "material", "crease", "mesh", "crossing", "section", "wire", "point")
CHOICES = {"shading": SHADINGS, "paint": PAINTS, "seams": SEAMS, "ids": IDS, "layers": LAYERS}
SVG, PDF, EPS = range(3)
FORMATS = {".svg": SVG, ".pdf": PDF, ".eps": EPS}


@dataclass(frozen=True)
class RenderReport:
    """What a picture shows. Neighbouring triangles in one plane count as one face.

    :ivar paint: how faces were filled: ``"whole"``, ``"regions"`` or ``"fragments"``
    :ivar pieces: pieces of the tree that were looked at, until the picture was full
    :ivar visible_pieces: convex parts that are visible
    :ivar visible_faces: faces of which something is visible
    :ivar hidden_faces: faces that are wholly behind others, or beside the picture
    :ivar shapes: filled shapes in the file
    :ivar lines: strokes in the file
    :ivar points: points of the scene in the file
    :ivar paths: elements of the file that hold shapes and lines
    :ivar bytes: size of the file
    """

    paint: str
    pieces: int
    visible_pieces: int
    visible_faces: int
    hidden_faces: int
    shapes: int
    lines: int
    points: int
    paths: int
    bytes: int


class Picture:
    """A picture as SVG, which notebooks show. ``save`` writes a file of any format.

    :ivar svg: the picture as text
    :ivar report: what it shows, for pictures with hidden surfaces removed; otherwise None
    :param svg, report, writer: are those of ``Tree.render`` and ``Tree.draw``, which make pictures
    """

    def __init__(
        self, svg: str, report: RenderReport | None = None, writer: Callable[[str], object] | None = None
    ) -> None:
        self.svg = svg
        self.report = report
        self._writer = writer

    def _repr_svg_(self) -> str:
        return self.svg

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a file.

        :param path: ends in .svg; for pictures with hidden surfaces removed also .pdf, .eps, and .csv or .geojson with
            the lines alone
        :raises UnsupportedError, OptionError: the picture cannot be written in that format, or there is no such ending
        :raises FileError: the file cannot be written
        :cost: that of making the picture again

        >>> import froe, tempfile, os
        >>> picture = froe.segments([[0, 0, 1, 1]]).build().draw()
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     picture.save(os.path.join(folder, "a.svg"))
        ...     os.listdir(folder)
        ['a.svg']
        """
        if self._writer is not None:
            if Path(path).suffix.lower() in (".png", ".dxf"):
                raise UnsupportedError(
                    f"{os.fspath(path)}: Pictures are saved as .svg, .pdf or .eps, and their lines as .csv or "
                    ".geojson. The program froe makes .png and .dxf of a saved tree."
                )
            self._writer(os.fspath(path))
        elif Path(path).suffix.lower() == ".svg":
            try:
                Path(path).write_text(self.svg, encoding="utf-8")
            except OSError as why:
                raise FileError(f"{os.fspath(path)}: The file cannot be written: {why.strerror}.") from why
        else:
            raise UnsupportedError(f"{os.fspath(path)}: Pictures of partitions are saved as .svg only.")


def _bits(lines: Any) -> int:
    names = [lines] if isinstance(lines, str) else list(lines)
    for name in names:
        if name not in LINES:
            raise OptionError(f"There is no kind of line {name!r}. There are: {', '.join(LINES)}.")
    return sum(1 << LINES.index(name) for name in set(names))


def _colour(value: Any) -> int:
    """0xRRGGBB of a number, or of text like #a0b1c2."""
    if not isinstance(value, str):
        return int(value)
    digits = value.removeprefix("#")
    if len(digits) != 6 or any(digit not in "0123456789abcdefABCDEF" for digit in digits):
        raise OptionError(f"{value!r} is no colour like '#a0b1c2'.")
    return int(digits, 16)


def _numbers(options: Mapping[str, Any]) -> dict[str, Any]:
    """Options of ``Tree.render`` as the extension takes them."""
    found: dict[str, Any] = {}
    for name, value in options.items():
        if value is None:
            continue
        if name in CHOICES:
            if value not in CHOICES[name]:
                raise OptionError(f"{name} is {value!r}, and must be one of {', '.join(CHOICES[name])}.")
            found[name] = CHOICES[name].index(value)
        elif name in ("eye", "target", "up"):
            found[name] = doubles(value, name)
        elif name == "lines":
            found[name] = _bits(value)
        elif name == "background":
            found[name] = _colour(value)
        elif name == "size":
            if len(lengths := np.atleast_1d(value)) != 2:
                raise OptionError(f"size is {value!r}, and must be two lengths, like (800, 600).")
            found["width"], found["height"] = (float(length) for length in lengths)
        else:
            found[name] = value
    return found


def render(tree: Tree, progress: Callable[[float], object] | None, options: Mapping[str, Any]) -> Picture:
    """The picture that ``Tree.render`` returns."""
    numbers = _numbers(options)
    svg, report = tree._core.render(None, SVG, numbers, progress)
    return Picture(svg.decode(), RenderReport(**report), partial(_write, tree, numbers))


def _write(tree: Tree, numbers: Mapping[str, Any], path: str) -> None:
    tree._core.render(path, SVG, dict(numbers), None)


# --------------------------------------------------------------------- partitions

PALE, DEEP = np.array([0xF3, 0xF6, 0xE4]), np.array([0x1F, 0x6F, 0x78])


def _shade(depth: int, most: int) -> str:
    """Pale near the root, deep far from it."""
    mixed = PALE + (DEEP - PALE) * (depth / most if most else 0.0)
    return "#" + "".join(f"{round(float(part)):02x}" for part in mixed)


def _window(tree: Tree, lo: npt.ArrayLike | None, hi: npt.ArrayLike | None) -> tuple[Doubles, Doubles]:
    """The box that is drawn: all objects, and a little more."""
    bounds = tree.scene.bounds
    found = np.array([[0.0, 0.0], [1.0, 1.0]]) if bounds is None else bounds
    half = float((found[1] / 2 - found[0] / 2).max())
    margin = max(0.06 * half or 1.0, 2.0**-50 * float(np.abs(found).max()))
    most = np.finfo(np.float64).max
    lower = np.maximum(found[0], margin - most) - margin if lo is None else point(lo, "lo", 2)
    upper = np.minimum(found[1], most - margin) + margin if hi is None else point(hi, "hi", 2)
    if not (np.isfinite([lower, upper]).all() and (lower < upper).all()):
        raise ArgumentError(f"The box from {lower.tolist()} to {upper.tolist()} has no extent that is a finite number.")
    return lower, upper


def draw(tree: Tree, width: float, lo: npt.ArrayLike | None, hi: npt.ArrayLike | None) -> Picture:
    """The picture that ``Tree.draw`` returns."""
    if tree.dim != 2:
        raise UnsupportedError(f"Partitions of the plane are drawn, and this tree has dimension {tree.dim}.")
    if not 0 < width < math.inf:
        raise OptionError(f"width is {width!r}, and must be a finite number above 0.")
    lower, upper = _window(tree, lo, hi)
    cells, shapes = tree.cells(lower, upper), _outlines.of_pieces(tree)
    unit = 2.0 ** (math.frexp(float(np.abs([lower, upper]).max()))[1] - 1)  # so that no difference is too large
    across, up = (float(length) for length in upper / unit - lower / unit)
    height = width * (up / across)

    def page(points: Any) -> Any:
        return (points / unit - lower / unit) / [across, up] * [width, -height] + [0.0, height]

    def path(points: Any, end: str) -> str:
        return "M" + "L".join(f"{x:.2f} {y:.2f}" for x, y in page(points)) + end

    most = int(cells.depths.max(initial=0))
    by_depth: dict[int, list[str]] = {}
    for depth, corners in zip(cells.depths.tolist(), cells.polygons()):
        by_depth.setdefault(depth, []).append(path(corners, "Z"))
    fills = [f'<path fill="{_shade(depth, most)}" d="{"".join(by_depth[depth])}"/>' for depth in sorted(by_depth)]
    lines = "".join(path(corners if len(corners) > 1 else corners[[0, 0]], "") for corners in shapes)
    contents = f"{counted(len(cells), 'cell')}, {counted(len(shapes), 'piece')}"
    return Picture(
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.2f}" height="{height:.2f}" '
        f'viewBox="0 0 {width:.2f} {height:.2f}">\n<title>{contents}</title>\n'
        f'<g stroke="#ffffff" stroke-width="0.6" stroke-linejoin="round">{"".join(fills)}</g>\n'
        f'<path fill="none" stroke="#1b2630" stroke-width="1.4" stroke-linecap="round" d="{lines}"/>\n</svg>\n'
    )
