"""froe.compat.shapely.STRtree against the predicates of shapely, geometry by geometry."""

import pickle
import random as randoms

import geometries
import numpy as np
import pytest
from shapely.geometry import LineString, Point, Polygon, box

import froe
from froe.compat.shapely import STRtree


def by_hand(asked, kept, holds):
    """Two rows, as the tree has them."""
    found = [
        (i, j)
        for i, one in enumerate(asked)
        for j, other in enumerate(kept)
        if one is not None and other is not None and not one.is_empty and not other.is_empty and holds(one, other)
    ]
    return np.array(found, np.int64).reshape(-1, 2).T.tolist()


def case(seed, count=30):
    random = randoms.Random(seed)
    kinds = [*geometries.ALL, geometries.missing]
    return geometries.some(random, count, kinds), geometries.some(random, count, kinds)


@pytest.mark.parametrize("seed", range(40))
def test_what_meets_is_what_shapely_says(seed):
    kept, asked = case(seed)
    expected = by_hand(asked, kept, lambda one, other: one.intersects(other))
    assert STRtree(kept).query(asked, predicate="intersects").tolist() == expected


@pytest.mark.parametrize("seed", range(10))
def test_boxes_meet_without_a_predicate(seed):
    kept, asked = case(seed)

    def boxes_meet(one, other):
        (a, b, c, d), (e, f, g, h) = one.bounds, other.bounds
        return a <= g and e <= c and b <= h and f <= d

    expected = by_hand(asked, kept, boxes_meet)
    assert STRtree(kept).query(asked).tolist() == expected


@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize("distance", [0, 1, 2.5])
def test_within_a_distance(seed, distance):
    kept, asked = case(seed)
    expected = by_hand(asked, kept, lambda one, other: one.distance(other) <= distance)
    assert STRtree(kept).query(asked, predicate="dwithin", distance=distance).tolist() == expected


def test_each_geometry_has_a_distance_of_its_own():
    tree = STRtree([Point(0, 0), Point(3, 0)])
    found = tree.query([Point(1, 0), Point(1, 0)], predicate="dwithin", distance=[1, 2])
    assert found.tolist() == [[0, 1, 1], [0, 0, 1]]


@pytest.mark.parametrize("seed", range(30))
@pytest.mark.parametrize("limit", [None, 1.5])
def test_nearest_are_those_that_shapely_measures(seed, limit):
    kept, asked = case(seed, 20)
    distances = {
        (i, j): one.distance(other)
        for i, one in enumerate(asked)
        for j, other in enumerate(kept)
        if one is not None and other is not None and not one.is_empty and not other.is_empty
    }
    found, lengths = STRtree(kept).query_nearest(asked, max_distance=limit, return_distance=True)
    least = {i: min(length for (k, _), length in distances.items() if k == i) for i, _ in distances}
    if limit is not None:
        least = {i: length for i, length in least.items() if length <= limit}
    assert sorted(set(found[0])) == sorted(least)
    for i, j, length in zip(*found, lengths):
        assert length == pytest.approx(least[i], rel=1e-15)
        assert distances[i, j] == pytest.approx(length, rel=1e-15)
    for (i, j), length in distances.items():  # none is missing; shapely's own distances may differ by rounding
        if i in least and length < least[i] * (1 - 1e-12):
            raise AssertionError(f"{j} is nearer to {i}")
        if i in least and length == least[i] == 0:
            assert (i, j) in set(zip(*found.tolist()))


@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize("limit", [None, 1.5])
def test_nearest_but_for_equal_ones(seed, limit):
    """Nothing but what shapely calls equal is left out, so that an index may be asked for its own geometries."""
    random = randoms.Random(seed)
    kept = geometries.some(random, 12, [*geometries.ALL, geometries.missing])
    asked = kept + [one.buffer(0) if one and one.area else one for one in kept[:4]]  # equal, from another corner on
    found, lengths = STRtree(kept).query_nearest(asked, max_distance=limit, return_distance=True, exclusive=True)
    distances = {}
    for i, one in enumerate(asked):
        for j, other in enumerate(kept):
            if one is not None and other is not None and not one.is_empty and not other.is_empty:
                if not one.equals(other) and (limit is None or one.distance(other) <= limit):
                    distances[i, j] = one.distance(other)
    assert {i for i, _ in distances} == set(found[0].tolist())
    for i, j, length in zip(*found.tolist(), lengths):
        assert length == pytest.approx(min(far for (k, _), far in distances.items() if k == i), rel=1e-12)
        assert distances[i, j] == pytest.approx(length, rel=1e-12)


def test_many_points_at_one_place_are_passed_over():
    tree = STRtree([Point(0, 0)] * 30 + [Point(3, 4), Point(-3, -4)])
    found, distances = tree.query_nearest(Point(0, 0), exclusive=True, return_distance=True)
    assert found.tolist() == [30, 31] and distances.tolist() == [5, 5]
    line = LineString([(0, 0), (0, 1)])
    tree = STRtree([line, LineString([(0, 1), (0, 0.25), (0, 0)]), LineString([(2, 0), (2, 1)])])
    assert tree.query_nearest(line, exclusive=True).tolist() == [2]
    assert STRtree([line]).query_nearest(line, exclusive=True).tolist() == []
    assert STRtree([Point(1, 1)] * 5).query_nearest([Point(1, 1)], exclusive=True).shape == (2, 0)


def test_ties_are_decided_exactly():
    """Both are 0.1 away from the point, as doubles say; the second is nearer by 10^-30."""
    near = np.nextafter(0.1, 0)
    tree = STRtree([Point(0, 0.1), Point(near, np.sqrt(0.1**2 - near**2))])
    index, distance = tree.query_nearest(Point(0, 0), return_distance=True)
    squares = [np.float64(0), np.float64(0)]
    from fractions import Fraction

    squares = [sum(Fraction(c) ** 2 for c in point.coords[0]) for point in tree.geometries]
    assert squares[0] != squares[1]
    assert index.tolist() == [squares.index(min(squares))]
    assert distance.tolist() == [0.1]


def test_nearest_beyond_the_range_of_doubles():
    """A distance that no double holds is infinite, and which geometry is nearest is decided all the same."""
    far = 1.7e308
    kept = [LineString([(-far, -far), (-far, 0)]), Point(-far, far), Point(-far / 2, far), None]
    asked = [LineString([(far, far), (far, far / 2)]), Point(far, far), LineString([(far, -far), (far, -far / 2)])]
    found, lengths = STRtree(kept).query_nearest(asked, return_distance=True)
    assert found.tolist() == [[0, 1, 2], [2, 2, 0]] and np.isinf(lengths).all()
    assert STRtree(kept).nearest(asked).tolist() == [2, 2, 0]
    assert STRtree(kept[:1]).query_nearest(kept[0], exclusive=True).tolist() == []
    across = LineString([(-far, 0), (far, 0)])  # its ends are farther from the point than doubles go, and its middle is not
    found, lengths = STRtree([Point(0, far)]).query_nearest([across], return_distance=True)
    assert found.tolist() == [[0], [0]] and lengths.tolist() == [far]


def test_shapes_of_results():
    tree = STRtree([Point(0, 0), Point(2, 0), None])
    assert len(tree) == 2
    assert tree.query(Point(0, 0)).shape == (1,)
    assert tree.query([Point(0, 0)]).shape == (2, 1)
    assert tree.query([]).shape == (2, 0)
    assert tree.nearest(Point(0.5, 0)) == 0
    assert tree.nearest([Point(0.5, 0), Point(1.5, 0)]).tolist() == [0, 1]
    assert tree.query_nearest(Point(1, 0)).tolist() == [0, 1]
    assert tree.query_nearest(Point(1, 0), all_matches=False).tolist() == [0]
    indices, distances = tree.query_nearest([Point(1, 0)], return_distance=True)
    assert indices.tolist() == [[0, 0], [0, 1]] and distances.tolist() == [1, 1]
    assert pickle.loads(pickle.dumps(STRtree([Point(0, 0)]))).query(Point(0, 0)).tolist() == [0]
    assert STRtree([]).nearest(Point(0, 0)) is None
    assert STRtree([]).query(Point(0, 0), predicate="intersects").tolist() == []


def test_what_is_refused():
    tree = STRtree([Point(0, 0)])
    with pytest.raises(ValueError, match="distance"):
        tree.query(Point(0, 0), predicate="dwithin")
    with pytest.raises(ValueError, match="max_distance"):
        tree.query_nearest(Point(0, 0), max_distance=0)
    with pytest.raises(ValueError, match="empty"):
        tree.nearest(Polygon())


def test_a_closed_line_is_no_area():
    tree = STRtree([LineString([(0, 0), (4, 0), (4, 4), (0, 4), (0, 0)])])
    assert tree.query(Point(2, 2), predicate="intersects").tolist() == []
    assert tree.query(Point(2, 0), predicate="intersects").tolist() == [0]
