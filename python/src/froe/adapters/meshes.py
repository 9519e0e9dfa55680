"""Meshes of trimesh and pyvista as scenes. Only their attributes are read, so that any object that has them will do.

>>> import froe, numpy as np
>>> class Mesh:
...     vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
...     faces = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
>>> tree = froe.from_trimesh(Mesh()).build()
>>> tree.nearest([[0.1, 0.1, -1]])
(array([0], dtype=int32), array([1.]))
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from froe.errors import ArrayError

if TYPE_CHECKING:
    from froe.scene import Scene


def from_trimesh(mesh: Any) -> Scene:
    """A scene in space of the triangles of a mesh. Triangle ``i`` is object ``i``.

    :param mesh: any object with the attributes ``vertices`` (n, 3) and ``faces`` (m, 3)
    :raises ValueError: the faces are not triangles
    :cost: O(m) expected time
    """
    from froe.scene import Scene

    faces = np.asarray(mesh.faces)
    if faces.ndim != 2 or faces.shape[1] != 3:
        raise ValueError(f"The faces of the mesh have the shape {faces.shape}, and (m, 3) is needed.")
    scene = Scene(3)
    scene.add_triangles(mesh.vertices, faces)
    return scene


def from_pyvista(mesh: Any) -> Scene:
    """A scene in space of the polygons of a mesh. A triangle becomes one object. A polygon of more corners becomes a
    fan of triangles, as most of them are not exactly planar. All objects of polygon ``i`` have the tag ``i`` and the
    face ``i``.

    :param mesh: any object with the attributes ``points`` (n, 3) and ``faces``, which has the number of corners of each
        polygon before its corners, as PolyData of pyvista has
    :raises ValueError: a polygon has less than three corners, or the list ends within one
    :cost: O(corners), in a loop over the polygons

    >>> import froe, numpy as np
    >>> class PolyData:
    ...     points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float)
    ...     faces = np.array([4, 0, 1, 2, 3])
    >>> froe.from_pyvista(PolyData()).arrays().tags.tolist()
    [0, 0]
    """
    from froe.scene import Scene

    scene = Scene(3)
    add_polygons(scene, mesh)
    return scene


def add_polygons(scene: Scene, mesh: Any, first_face: int = 0, group: int | None = None) -> int:
    """Adds the polygons of a mesh as pyvista has them to a scene. Returns the number of the face after them."""
    corners = np.asarray(mesh.faces).ravel()
    if corners.size and corners.dtype.kind not in "iu":
        raise ArrayError(f"The faces of the mesh must be whole numbers, and their type is {corners.dtype}.")
    triangles, polygon = _fans(corners.astype(np.int64))
    scene.add_triangles(mesh.points, triangles, tags=polygon, faces=first_face + polygon, group=group)
    return first_face + int(polygon.max(initial=-1)) + 1


def _fans(faces: npt.NDArray[np.int64]) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64]]:
    """Triangles (m, 3) of polygons [count, corner, corner, ..., count, ...], and the polygon of each."""
    triangles, polygons = [], []
    at = number = 0
    while at < len(faces):
        count = int(faces[at])
        corners = faces[at + 1 : at + 1 + count]
        if count < 3 or len(corners) < count:
            raise ValueError(
                f"Polygon {number} of the mesh has {count} corners, of which {len(corners)} exist."
            )
        fan = np.empty((count - 2, 3), np.int64)
        fan[:, 0], fan[:, 1], fan[:, 2] = corners[0], corners[1:-1], corners[2:]
        triangles.append(fan)
        polygons.append(np.full(count - 2, number))
        at, number = at + 1 + count, number + 1
    if not triangles:
        return np.empty((0, 3), np.int64), np.empty(0, np.int64)
    return np.concatenate(triangles), np.concatenate(polygons)
