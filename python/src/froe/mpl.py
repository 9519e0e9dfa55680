"""Trees and triangles in pictures of matplotlib.

``draw`` shows the partition of a map. ``draw3d`` shows triangles in space so that what is nearer hides what is farther,
also where they pass through each other or hide each other in a circle. There matplotlib's own ``plot_trisurf`` and
``Poly3DCollection`` are wrong, because they sort whole polygons by one depth each. Both make vectors, which SVG and PDF
keep.

>>> import froe, froe.mpl, matplotlib
>>> matplotlib.use("agg")
>>> from matplotlib import pyplot
>>> axes = pyplot.figure().add_subplot(projection="3d")
>>> faces = froe.mpl.draw3d(axes, [[[0, 0, 0], [4, 0, 0], [2, 0, 3]], [[2, -2, 1], [2, 2, 1], [2, 0, 2]]])
>>> axes.figure.canvas.draw()
>>> len(faces.tree.pieces()) > 2  # the triangles pass through each other, so that one is cut
True
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _outlines
from ._words import counted

if TYPE_CHECKING:
    from froe.tree import Tree

Floats = npt.NDArray[np.float64]


def draw(
    ax: Any,
    tree: Tree,
    *,
    lo: npt.ArrayLike | None = None,
    hi: npt.ArrayLike | None = None,
    cmap: Any = "viridis_r",
    alpha: float = 0.35,
    color: Any = "black",
    linewidth: float = 0.8,
) -> tuple[Any, Any]:
    """Draws the cells of a tree of the plane, coloured by the number of cuts on the way to each, and its pieces over
    them.

    :param ax: axes of matplotlib
    :param tree: a tree of the plane
    :param lo, hi: (2,), corners of what is drawn; None: those of all objects
    :param cmap, alpha: colours of the cells
    :param color, linewidth: of the pieces
    :returns: the two collections that were added to the axes
    :raises ValueError: the tree is not one of the plane
    :cost: O(height) for each cell that is drawn

    >>> import froe, froe.mpl
    >>> from matplotlib import pyplot
    >>> tree = froe.segments([[0, 0, 2, 2], [0, 2, 2, 0]]).build("autopartition", leaf=0)
    >>> cells, lines = froe.mpl.draw(pyplot.figure().add_subplot(), tree)
    >>> len(cells.get_paths())
    4
    """
    from matplotlib.collections import LineCollection, PolyCollection
    from matplotlib.transforms import nonsingular

    if tree.dim != 2:
        raise ValueError("The tree is not one of the plane.")
    found = tree.cells(lo, hi)
    lower, upper = found.coords.min(axis=0), found.coords.max(axis=0)
    cells = PolyCollection(found.polygons(), cmap=cmap, alpha=alpha, edgecolors="white", linewidths=0.4)
    cells.set_array(found.depths.astype(np.float64))
    lines = LineCollection(_outlines.of_pieces(tree), colors=color, linewidths=linewidth)
    ax.add_collection(cells)
    ax.add_collection(lines)
    ax.set_xlim(nonsingular(lower[0], upper[0]))
    ax.set_ylim(nonsingular(lower[1], upper[1]))
    ax.set_aspect("equal")
    return cells, lines


def draw3d(ax: Any, triangles: npt.ArrayLike | Tree, *, color: Any = "0.8", shade: bool = True, **style: Any) -> Any:
    """Draws triangles in axes with ``projection="3d"``. The order is found anew whenever the axes are drawn, so that
    they may be turned.

    :param ax: axes of matplotlib
    :param triangles: (n, 3, 3), or a tree of triangles that was built with ``purpose="draw"``
    :param color: one colour, or one for each triangle
    :param shade: triangles are darker the more they are turned away from a light at the upper left
    :param style: goes to ``Poly3DCollection``
    :returns: the collection; its ``tree`` is the tree
    :raises ArrayError: the array has another shape or type
    :raises ValueError: the tree is not one of space; or there are more or fewer colours than triangles, and not one for
        all
    :cost: that of building a tree, once, and O(pieces) whenever the axes are drawn
    """
    from froe.scene import triangles as scene_of
    from froe.tree import Tree

    tree = triangles if isinstance(triangles, Tree) else scene_of(triangles).build(purpose="draw")
    if tree.dim != 3:
        raise ValueError("The tree is not one of space.")
    faces = _faces()(tree, color, shade, **style)
    ax.add_collection3d(faces)
    corners = tree.pieces().coords
    if len(corners):
        ax.auto_scale_xyz(*corners.T)
    return faces


def _faces() -> Any:
    """The class, which is made when matplotlib is there."""
    from matplotlib.collections import PolyCollection
    from matplotlib.colors import to_rgba_array
    from mpl_toolkits.mplot3d import proj3d
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    class Faces(Poly3DCollection):  # type: ignore[misc]
        """Pieces of triangles, painted back to front by the cuts of a tree."""

        def __init__(self, tree: Tree, color: Any, shade: bool, **style: Any) -> None:
            self.tree = tree
            self.pieces = tree.pieces()
            polygons = [self.pieces[i] for i in range(len(self.pieces))]
            colors = to_rgba_array(color)
            if len(colors) not in (1, len(tree.scene)):
                raise ValueError(f"There are {len(colors)} colours for {counted(len(tree.scene), 'triangle')}.")
            colors = np.array(colors[self.pieces.objects if len(colors) > 1 else [0] * len(polygons)])
            if shade:
                colors[:, :3] *= _brightness(polygons)[:, None]
            # Outlines of their own colour close the gaps that antialiasing leaves between pieces. Round joins keep
            # them from sticking out at sharp corners.
            about = {"facecolors": colors, "edgecolors": colors, "linewidths": 0.5, "joinstyle": "round"}
            super().__init__(polygons, **{**about, **style})

        def do_3d_projection(self, renderer: Any = None) -> float:
            """Before the axes are drawn: order and outlines, as they are seen now."""
            eye, parallel = _eye(self.axes.M)
            order = self.tree.order(eye, parallel=parallel)
            x, y, z = proj3d.proj_transform(*self.pieces.coords.T, self.axes.M)
            flat = np.stack([x, y], axis=1)
            starts = self.pieces.starts
            PolyCollection.set_verts(self, [flat[starts[i] : starts[i + 1]] for i in order], True)
            self._facecolors2d = self._facecolor3d[order] if len(self._facecolor3d) == len(order) else self._facecolor3d
            self._edgecolors2d = self._edgecolor3d[order] if len(self._edgecolor3d) == len(order) else self._edgecolor3d
            return float(np.min(z)) if len(z) else np.nan

    return Faces


def _eye(matrix: Floats) -> tuple[Floats, bool]:
    """Where a projection looks from: the one point, maybe infinitely far away, that it takes to no point of the page.
    Its homogeneous coordinates are orthogonal to the rows of x, y and w."""
    rows = matrix[[0, 1, 3]]
    centre = np.array([(-1) ** i * np.linalg.det(np.delete(rows, i, axis=1)) for i in range(4)])
    if abs(centre[3]) > 1e-12 * np.abs(centre[:3]).max():
        return centre[:3] / centre[3], False
    away = matrix[2, :3] @ centre[:3]  # depth grows away from the eye
    return (-centre[:3] if away > 0 else centre[:3]), True


def _brightness(polygons: list[Floats]) -> Floats:
    """From 0.55 to 1, by the angle to the light, from both sides alike."""
    light = np.array([-0.4, -0.6, 0.7])
    normals = np.array([np.cross(p[1] - p[0], p[2] - p[0]) if len(p) > 2 else np.zeros(3) for p in polygons])
    normals = normals.reshape(-1, 3)
    length = np.linalg.norm(normals, axis=1)
    cosine = np.divide(normals @ light, length, out=np.zeros(len(normals)), where=length > 0)
    brightness: Floats = 0.55 + 0.45 * np.abs(cosine / np.linalg.norm(light))
    return brightness
