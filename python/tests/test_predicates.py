"""The predicates of froe.compat.shapely.STRtree against those of GEOS, which compute crossings in doubles, and against
brute force in fractions, which decides where the two differ."""

import random as randoms
from pathlib import Path

import geometries
import geopandas
import numpy as np
import pytest
from arrangement import holds, predicates, relate
from shapely.affinity import affine_transform
from shapely.geometry import (
    GeometryCollection,
    LineString,
    MultiLineString,
    MultiPoint,
    MultiPolygon,
    Point,
    Polygon,
    box,
)

import froe
from froe.compat.relations import PREDICATES
from froe.compat.shapely import STRtree

COUNTRIES = Path(__file__).resolve().parents[2] / "data/countries-110m.json"
SKEWED = [0.1, 0.03, 0.07, 0.3, 0.1, 0.7]  # coordinates that are rounded: what was in one line nearly is
SEEDS = range(6)


def geos(predicate, one, other):
    if predicate == "contains_properly":
        return one.relate_pattern(other, "T**FF*FF*")
    return getattr(one, predicate)(other)


def is_there(geometry):
    return geometry is not None and not geometry.is_empty


def compare(predicate, asked, kept):
    """Pairs that hold. Where GEOS says another thing, it has to be wrong."""
    found = STRtree(kept).query(asked, predicate=predicate).T.tolist()
    assert found == sorted(found)
    pairs = {tuple(pair) for pair in found}
    there = [(i, j) for i in range(len(asked)) for j in range(len(kept)) if is_there(asked[i]) and is_there(kept[j])]
    expected = {(i, j) for i, j in there if geos(predicate, asked[i], kept[j])}
    for i, j in pairs ^ expected:
        assert holds(predicate, asked[i], kept[j]) == ((i, j) in pairs), (asked[i].wkt, kept[j].wkt)
    return pairs


@pytest.mark.parametrize("kinds", [[*geometries.ALL, geometries.missing], geometries.DENSE], ids=["sparse", "dense"])
@pytest.mark.parametrize("predicate", PREDICATES)
def test_on_a_lattice(predicate, kinds):
    total = 0
    for seed in SEEDS:
        random = randoms.Random(seed)
        total += len(compare(predicate, *(geometries.some(random, 25, kinds) for _ in range(2))))
    assert total > 20


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("predicate", PREDICATES)
def test_where_coordinates_are_rounded(predicate, seed):
    random = randoms.Random(100 + seed)
    asked, kept = (
        [affine_transform(one, SKEWED) for one in geometries.some(random, 25, geometries.DENSE)] for _ in range(2)
    )
    compare(predicate, asked, kept)


@pytest.mark.parametrize("factor", [2.0**300, 2.0**-300])
@pytest.mark.parametrize("predicate", PREDICATES)
def test_the_unit_does_not_matter(predicate, factor):
    random = randoms.Random(7)
    asked, kept = (geometries.some(random, 20, geometries.DENSE) for _ in range(2))
    larger = ([affine_transform(one, [factor, 0, 0, factor, 0, 0]) for one in some] for some in (asked, kept))
    found = STRtree(kept).query(asked, predicate=predicate)
    asked, kept = larger
    assert found.size and np.array_equal(found, STRtree(kept).query(asked, predicate=predicate))


@pytest.mark.parametrize("predicate", PREDICATES)
def test_corners_that_are_repeated(predicate):
    random = randoms.Random(8)
    asked, kept = (geometries.some(random, 25, geometries.DENSE) for _ in range(2))
    found = STRtree(kept).query(asked, predicate=predicate)
    asked, kept = ([geometries.with_corners_twice(one) for one in some] for some in (asked, kept))
    assert found.size and np.array_equal(found, STRtree(kept).query(asked, predicate=predicate))


@pytest.mark.parametrize("seed", range(4))
def test_against_fractions_alone(seed):
    random = randoms.Random(200 + seed)
    asked, kept = (geometries.some(random, 7, geometries.DENSE) for _ in range(2))
    tree, expected = STRtree(kept), {(i, j): predicates(asked[i], kept[j]) for i in range(7) for j in range(7)}
    for predicate in PREDICATES:
        found = [list(pair) for pair, names in expected.items() if predicate in names]
        assert tree.query(asked, predicate=predicate).T.tolist() == found


def test_the_matrix_of_the_fractions_is_that_of_shapely():
    random = randoms.Random(5)
    for _ in range(150):
        one, other = geometries.some(random, 2, [geometries.cells, geometries.dots, geometries.a_line])
        assert relate(one, other) == one.relate(other)


@pytest.mark.parametrize("predicate", ["intersects", "touches", "overlaps", "covers", "within"])
def test_countries(predicate):
    """Neighbours share borders to the last digit, and touch."""
    valid = [one for one in geopandas.read_file(COUNTRIES).geometry if one.is_valid]
    found = STRtree(valid).query(valid, predicate=predicate).T.tolist()
    expected = [[i, j] for i, one in enumerate(valid) for j, other in enumerate(valid) if geos(predicate, one, other)]
    assert found == expected and len(valid) > 170


SQUARE = box(0, 0, 4, 4)
CASES = {
    "a line through two corners comes into the square": (LineString([(-1, -1), (5, 5)]), SQUARE, "crosses"),
    "a line from corner to corner lies in it": (LineString([(0, 0), (4, 4)]), SQUARE, "within"),
    "a line along the border only touches": (LineString([(0, 1), (0, 3)]), SQUARE, "touches"),
    "and is covered, too": (LineString([(0, 1), (0, 3)]), SQUARE, "covered_by"),
    "a corner only touches": (Point(0, 0), SQUARE, "touches"),
    "equal squares are within each other": (SQUARE, Polygon([(4, 4), (0, 4), (0, 0), (4, 0)]), "within"),
    "a square fills a hole": (box(1, 1, 2, 2), SQUARE - box(1, 1, 2, 2), "touches"),
    "squares side by side": (SQUARE, box(4, 1, 6, 2), "touches"),
    "no border comes into the other square": (
        MultiPolygon([box(0, 0, 1, 1), box(5, 5, 6, 6)]),
        MultiPolygon([box(0, 0, 1, 1), box(8, 8, 9, 9)]),
        "overlaps",
    ),
    "a triangle through the middle of two sides": (Polygon([(0, 2), (2, 0), (4, 4)]), SQUARE, "within"),
    "half of the square, cut along its diagonal": (Polygon([(0, 0), (4, 4), (4, 0)]), SQUARE, "covered_by"),
    "a part of a line": (LineString([(1, 0), (3, 0)]), LineString([(0, 0), (4, 0)]), "within"),
    "lines that share a piece": (LineString([(1, 0), (5, 0)]), LineString([(0, 0), (4, 0)]), "overlaps"),
    "the end of a line is no point within it": (Point(0, 0), LineString([(0, 0), (4, 0)]), "touches"),
    "but an end of two lines is": (Point(2, 0), MultiLineString([[(0, 0), (2, 0)], [(2, 0), (4, 4)]]), "within"),
    "and all of a closed line": (Point(0, 0), LineString([(0, 0), (4, 0), (0, 4), (0, 0)]), "within"),
    "some points within": (MultiPoint([(1, 1), (9, 9)]), SQUARE, "crosses"),
    "some points on the border": (MultiPoint([(0, 0), (9, 9)]), SQUARE, "touches"),
}


@pytest.mark.parametrize("name", CASES)
def test_case(name):
    one, other, predicate = CASES[name]
    assert geos(predicate, one, other), "GEOS agrees"
    assert STRtree([other]).query(one, predicate=predicate).tolist() == [0]
    back = {"within": "contains", "covered_by": "covers"}.get(predicate, predicate)
    assert STRtree([one]).query(other, predicate=back).tolist() == [0]
    for name in set(PREDICATES):
        assert STRtree([other]).query(one, predicate=name).tolist() == [0] * geos(name, one, other)


def test_lines_that_cross_at_an_end_of_another_line_only_touch():
    """(3, 3) is an end of one line, and so no point of the interior of the four, though another passes through it."""
    four = MultiLineString([[(2, 2), (0, 2)], [(0, 0), (4, 4)], [(4, 3), (1, 3)], [(3, 3), (4, 3)]])
    upright = LineString([(2, 4), (3, 4), (3, 0)])
    assert holds("touches", four, upright)
    for one, other in ((four, upright), (upright, four)):
        assert STRtree([other]).query(one, predicate="touches").tolist() == [0]
        assert STRtree([other]).query(one, predicate="crosses").tolist() == []


@pytest.mark.parametrize("predicate", PREDICATES)
def test_what_is_empty_matches_nothing(predicate):
    nothing = [None, Point(), Polygon()]
    assert STRtree([*nothing, SQUARE]).query([*nothing, SQUARE], predicate=predicate).tolist() == (
        [[3], [3]] if geos(predicate, SQUARE, SQUARE) else [[], []]
    )
    assert STRtree([]).query([SQUARE], predicate=predicate).shape == (2, 0)
    assert STRtree([SQUARE]).query([], predicate=predicate).shape == (2, 0)


def test_collections_of_several_dimensions():
    """They are sets of points, but have no interior that shapely defines."""
    mixed = GeometryCollection([box(0, 0, 2, 2), LineString([(2, 1), (4, 1)])])
    tree = STRtree([Point(9, 9), mixed])
    assert tree.query(LineString([(1, 1), (3, 1)]), predicate="covered_by").tolist() == [1]
    assert tree.query(LineString([(1, 1), (5, 1)]), predicate="covered_by").tolist() == []
    assert tree.query(box(0, 0, 4, 4), predicate="covers").tolist() == [1]
    assert tree.query(Point(9, 9), predicate="within").tolist() == [0]  # far from the collection
    for predicate in ("contains", "contains_properly", "touches", "crosses", "overlaps"):
        with pytest.raises(froe.errors.UnsupportedError, match="Geometry 1 of the index"):
            tree.query(box(0, 0, 4, 4), predicate=predicate)
        with pytest.raises(froe.errors.UnsupportedError, match="Geometry 0 asked about"):
            STRtree([Point(1, 1), box(0, 0, 1, 1)]).query(mixed, predicate=predicate)
    with pytest.raises(froe.errors.UnsupportedError, match="Geometry 1 of the index"):
        tree.query(Point(1, 1), predicate="within")


def test_predicates_have_the_names_of_shapely():
    tree = STRtree([Point(0, 0)])
    with pytest.raises(ValueError, match="'surrounds', and must be one of") as refused:
        tree.query(Point(0, 0), predicate="surrounds")
    assert refused.type is froe.errors.OptionError
    for name in str(refused.value).rstrip(".").split("must be one of ")[1].split(", "):
        assert tree.query(Point(0, 0), predicate=name, distance=1).shape in ((0,), (1,))


def test_shapes_of_results_are_those_of_shapely_2():
    tree = STRtree([SQUARE, box(1, 1, 2, 2)])
    for found in (tree.query(Point(1, 1), "within"), tree.query([Point(1, 1), SQUARE], "covered_by")):
        assert found.dtype == np.int64
    assert tree.query(Point(1, 1), "within").tolist() == [0]
    assert tree.query([Point(1, 1), SQUARE], "covered_by").tolist() == [[0, 0, 1], [0, 1, 0]]
