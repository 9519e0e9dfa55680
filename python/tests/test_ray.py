"""froe.compat.trimesh.Ray on stand-ins with the attributes of a mesh, against fractions."""

import random as randoms
from fractions import Fraction

import numpy as np
import pytest

from froe.compat.trimesh import Ray


class Mesh:
    def __init__(self, vertices, faces):
        self.vertices, self.faces = np.array(vertices, float), np.array(faces)


CUBE = Mesh(
    [(x, y, z) for x in (0, 2) for y in (0, 2) for z in (0, 2)],
    [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4),
     (1, 5, 7), (1, 7, 3)],
)


def a_mesh(random, count=20):
    points = [[random.randint(0, 6) for _ in range(3)] for _ in range(count)]
    faces = [random.sample(range(count), 3) for _ in range(count)]
    a, b, c = (np.array(points)[np.array(faces)[:, i]] for i in range(3))
    flat = (np.cross(b - a, c - a) == 0).all(axis=1)
    return Mesh(points, np.array(faces)[~flat])


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def parameter(origin, direction, triangle):
    """Where a ray meets a triangle that it does not run along: a fraction, or None."""
    a, b, c = ([Fraction(int(x)) for x in corner] for corner in triangle)
    normal = cross([y - x for x, y in zip(a, b)], [y - x for x, y in zip(a, c)])
    if dot(normal, direction) == 0:
        return None
    t = dot(normal, [x - o for x, o in zip(a, origin)]) / Fraction(dot(normal, direction))
    if t < 0:
        return None
    at = [o + t * d for o, d in zip(origin, direction)]
    sides = [
        dot(cross([y - x for x, y in zip(p, q)], [y - x for x, y in zip(p, at)]), normal)
        for p, q in ((a, b), (b, c), (c, a))
    ]
    return t if min(sides) >= 0 else None


@pytest.mark.parametrize("seed", range(20))
def test_hits_are_those_of_fractions(seed):
    random = randoms.Random(seed)
    mesh = a_mesh(random)
    origins = np.array([[random.randint(-2, 8) for _ in range(3)] for _ in range(40)])
    directions = np.array([[random.choice([-3, -1, 1, 2, 3]) for _ in range(3)] for _ in range(40)])
    corners = mesh.vertices[mesh.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    clear = (directions @ normals.T != 0).all(axis=1)  # no ray runs along a triangle
    origins, directions = origins[clear], directions[clear]
    expected = {
        (i, j): t
        for i, (o, d) in enumerate(zip(origins.tolist(), directions.tolist()))
        for j, triangle in enumerate(corners)
        if (t := parameter(o, d, triangle)) is not None
    }
    ray = Ray(mesh)
    triangle, index = ray.intersects_id(origins, directions)
    assert sorted(zip(index, triangle)) == sorted(expected)
    assert (np.diff(index) >= 0).all()

    first = ray.intersects_first(origins, directions)
    for i in range(len(origins)):
        hits = {j: t for (k, j), t in expected.items() if k == i}
        least = min(hits.values(), default=None)
        assert first[i] == min((j for j, t in hits.items() if t == least), default=-1)
    assert ray.intersects_any(origins, directions).tolist() == (first >= 0).tolist()

    locations, index, triangle = ray.intersects_location(origins, directions)
    assert len(locations) == len({(i, t) for (i, _), t in expected.items()})
    for place, i, j in zip(locations, index, triangle):
        t = expected[i, j]
        exact = [float(int(o) + t * int(d)) for o, d in zip(origins[i], directions[i])]
        assert place == pytest.approx(exact, abs=1e-14)


def test_an_edge_is_never_missed():
    """Through the diagonal of a side, through an edge and through a corner of a cube."""
    ray = Ray(CUBE)
    origins = [[1, 1, 9], [2, 1, 9], [2, 2, 9]]
    down = [[0, 0, -1]] * 3
    assert ray.intersects_any(origins, down).all()
    locations, index, _ = ray.intersects_location(origins[:1], down[:1])
    assert locations.tolist() == [[1, 1, 2], [1, 1, 0]] and index.tolist() == [0, 0]
    triangle, index = ray.intersects_id(origins[:1], down[:1])
    assert len(triangle) == 4
    triangle, index = ray.intersects_id(origins, down, multiple_hits=False)
    assert index.tolist() == [0, 1, 2]


def test_no_hits_have_the_shapes_of_some():
    ray = Ray(CUBE)
    locations, index, triangle = ray.intersects_location([[9, 9, 9]], [[1, 0, 0]])
    assert locations.shape == (0, 3) and index.shape == (0,) and triangle.shape == (0,)
    assert ray.intersects_first([[9, 9, 9]], [[1, 0, 0]]).tolist() == [-1]
    assert ray.intersects_any(np.empty((0, 3)), np.empty((0, 3))).shape == (0,)


def test_closest_points():
    points, distances, triangles = Ray(CUBE).closest_point([[1, 0.5, 5], [-3, -4, 1], [1, 1, 1.75]])
    assert points.tolist() == [[1, 0.5, 2], [0, 0, 1], [1, 1, 2]]
    assert distances.tolist() == [3, 5, 0.25]
    assert triangles.dtype == np.int64


def test_what_is_refused():
    with pytest.raises(ValueError, match="origins"):
        Ray(CUBE).intersects_any([1, 2, 3], [[1, 0, 0]])
    with pytest.raises(ValueError, match="no triangles"):
        Ray(Mesh(np.empty((0, 3)), np.empty((0, 3), int))).closest_point([[0, 0, 0]])


@pytest.mark.parametrize("length", [5e-324, 1e-310, 1.0, 1e308])
def test_places_of_rays_of_every_length(length):
    ray = Ray(Mesh([(0, 0, 0), (4, 0, 0), (0, 4, 0), (0, 0, 0.5), (4, 0, 0.5), (0, 4, 0.5)], [(0, 1, 2), (3, 4, 5)]))
    with np.errstate(all="raise"):
        locations, index, triangle = ray.intersects_location([[0.25, 0.25, 1]], [[0, 0, -length]])
    assert locations == pytest.approx(np.array([[0.25, 0.25, 0.5], [0.25, 0.25, 0]]), abs=1e-14)
    assert index.tolist() == [0, 0] and triangle.tolist() == [1, 0]
