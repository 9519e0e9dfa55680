"""What ``trimesh.ray`` and ``trimesh.proximity`` answer about a mesh, decided exactly.

>>> import numpy as np
>>> from froe.compat.trimesh import Ray
>>> class Mesh:
...     vertices = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0], [4, 4, 0]], float)
...     faces = np.array([[0, 1, 2], [1, 3, 2]])
>>> ray = Ray(Mesh())
>>> ray.intersects_first([[1, 1, 5], [9, 9, 5]], [[0, 0, -1], [0, 0, -1]]).tolist()
[0, -1]
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from froe._arrays import doubles
from froe.adapters.meshes import from_trimesh

Floats = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]


class Ray:
    """Takes the place of ``mesh.ray`` (``trimesh.ray.ray_triangle.RayMeshIntersector``).

    A ray through an edge or a corner meets all triangles there: none is missed, and no tolerance decides. A ray begins
    at its origin, and triangles that contain the origin are met. Every method takes ``ray_origins`` and
    ``ray_directions``, (n, 3) each; directions have any length but 0. With ``multiple_hits=False`` only the first
    triangle of a ray counts.

    :ivar mesh: the mesh that was given
    :ivar tree: a tree of its triangles, for all other questions
    :param mesh: any object with the attributes ``vertices`` (n, 3) and ``faces`` (m, 3)
    :raises ValueError: an array has another shape
    :raises InputError: NaN, infinity, or a direction that is 0
    """

    def __init__(self, mesh: Any) -> None:
        self.mesh = mesh
        self.tree = from_trimesh(mesh).build(purpose="query")

    def intersects_id(
        self,
        ray_origins: npt.ArrayLike,
        ray_directions: npt.ArrayLike,
        return_locations: bool = False,
        multiple_hits: bool = True,
    ) -> tuple[Integers, Integers] | tuple[Integers, Integers, Floats]:
        """The triangle and the ray of each hit, by ray, then from its origin on.

        :param return_locations: also where that is, and of triangles that a ray meets in one point the first alone
        :returns: triangles and rays, (hits,) each; with ``return_locations`` also places (hits, 3)
        :cost: that of ``Tree.ray``

        >>> from froe.compat.trimesh import Ray
        >>> class Mesh:
        ...     vertices, faces = [[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]]
        >>> [found.tolist() for found in Ray(Mesh).intersects_id([[1, 1, 5]], [[0, 0, -1]], return_locations=True)]
        [[0], [0], [[1.0, 1.0, 0.0]]]
        """
        origins, directions = _vectors(ray_origins, "origins"), _vectors(ray_directions, "directions")
        triangle, ray, along = self._hits(origins, directions, multiple_hits)
        if not return_locations:
            return triangle, ray
        start, way = origins[ray], directions[ray]
        with np.errstate(over="ignore", invalid="ignore"):
            locations = start + along[:, None] * way
        far = ~np.isfinite(locations).all(axis=1)  # more steps of a tiny direction than a double tells
        locations[far] = self.tree.hit_places(triangle[far], start[far], way[far])[0]
        same = np.arange(len(ray)) > 0
        for found in (ray[:, None], along[:, None], locations):
            same[1:] &= (found[1:] == found[:-1]).all(axis=1)
        return triangle[~same], ray[~same], locations[~same]

    def intersects_location(
        self, ray_origins: npt.ArrayLike, ray_directions: npt.ArrayLike, multiple_hits: bool = True
    ) -> tuple[Floats, Integers, Integers]:
        """Where rays meet the mesh, each point of a ray once.

        :returns: places (hits, 3), and the ray and the triangle of each
        :cost: that of ``Tree.ray``

        >>> from froe.compat.trimesh import Ray
        >>> class Mesh:
        ...     vertices, faces = [[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]]
        >>> Ray(Mesh).intersects_location([[1, 1, 5]], [[0, 0, -1]])[0].tolist()
        [[1.0, 1.0, 0.0]]
        """
        found = self.intersects_id(ray_origins, ray_directions, return_locations=True, multiple_hits=multiple_hits)
        triangle, ray, locations = found  # type: ignore[misc]
        return locations, ray, triangle

    def intersects_first(self, ray_origins: npt.ArrayLike, ray_directions: npt.ArrayLike) -> Integers:
        """The triangle that each ray meets first, -1 where there is none.

        :returns: (n,)
        :cost: that of ``Tree.ray``
        """
        origins, directions = _vectors(ray_origins, "origins"), _vectors(ray_directions, "directions")
        triangle, ray, _ = self._hits(origins, directions, False)
        first = np.full(len(origins), -1, np.int64)
        first[ray] = triangle
        return first

    def intersects_any(self, ray_origins: npt.ArrayLike, ray_directions: npt.ArrayLike) -> npt.NDArray[np.bool_]:
        """Does each ray meet any triangle?

        :returns: (n,) of bool
        :cost: that of ``Tree.ray``

        >>> from froe.compat.trimesh import Ray
        >>> class Mesh:
        ...     vertices, faces = [[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]]
        >>> Ray(Mesh).intersects_any([[1, 1, 5], [9, 9, 5]], [[0, 0, -1], [0, 0, -1]]).tolist()
        [True, False]
        """
        return self.intersects_first(ray_origins, ray_directions) >= 0

    def closest_point(self, points: npt.ArrayLike) -> tuple[Floats, Floats, Integers]:
        """Takes the place of ``trimesh.proximity.closest_point(mesh, points)``.

        :param points: (n, 3)
        :returns: the nearest places of the mesh (n, 3), their distances (n,), and their triangles (n,), of several that
            are equally near the first
        :raises ValueError: also where the mesh has no triangles
        :cost: that of ``Tree.nearest``

        >>> from froe.compat.trimesh import Ray
        >>> class Mesh:
        ...     vertices, faces = [[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]]
        >>> [found.tolist() for found in Ray(Mesh).closest_point([[1, 1, 5]])]
        [[[1.0, 1.0, 0.0]], [5.0], [0]]
        """
        at = _vectors(points, "points")
        if not len(self.mesh.faces):
            raise ValueError("The mesh has no triangles.")
        triangle, distance = self.tree.nearest(at)
        return self.tree.nearest_points(triangle, at), distance, triangle.astype(np.int64)

    def _hits(self, origins: Floats, directions: Floats, every: bool) -> tuple[Integers, Integers, Floats]:
        """Triangle, ray and parameter of each hit."""
        if every:
            answers = self.tree.ray(origins, directions, all=True)
            ray, triangle = answers.pairs()
            return triangle, ray, np.asarray(answers.values)
        first, along = self.tree.ray(origins, directions)
        ray = np.flatnonzero(first >= 0)
        return first[ray].astype(np.int64), ray, along[ray]


def _vectors(given: npt.ArrayLike, what: str) -> Floats:
    vectors = doubles(given, what)
    if vectors.ndim != 2 or vectors.shape[1] != 3:
        raise ValueError(f"The {what} have the shape {vectors.shape}, and (n, 3) is needed.")
    return vectors
