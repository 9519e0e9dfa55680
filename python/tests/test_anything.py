"""Arrays of any kind and any numbers: each is refused, or taken without loss and answered exactly."""

from fractions import Fraction

import hypothesis.extra.numpy as arrays
import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as some

import froe
from froe.questions import MEETINGS

KINDS = some.one_of(
    arrays.floating_dtypes(sizes=(16, 32, 64)),
    arrays.integer_dtypes(),
    arrays.unsigned_integer_dtypes(),
    arrays.boolean_dtypes(),
    arrays.complex_number_dtypes(sizes=(64,)),
    arrays.datetime64_dtypes(),
    arrays.unicode_string_dtypes(max_len=3),
)
SHAPES = some.one_of(
    arrays.array_shapes(min_dims=0, max_dims=4, min_side=0, max_side=4),
    some.sampled_from([(3, 2), (3, 4), (2, 2, 2), (2, 3, 3), (1, 9), (2, 6)]),
)
#: Numbers of all sizes, and small ones that meet often.
NUMBERS = some.one_of(
    some.integers(-4, 4).map(float),
    some.floats(allow_nan=False, allow_infinity=False),
    some.sampled_from([5e-324, -0.0]),
)
REPEATABLE = settings(deadline=None, derandomize=True, max_examples=150)


def points(count):
    return some.lists(some.lists(NUMBERS, min_size=2, max_size=2), min_size=1, max_size=count)


def segments(count):
    return some.lists(some.lists(NUMBERS, min_size=4, max_size=4), min_size=1, max_size=count)


@REPEATABLE
@given(KINDS.flatmap(lambda kind: arrays.arrays(kind, SHAPES)))
def test_arrays_of_any_kind(array):
    tree = froe.segments([[0, 0, 1, 1]]).build()
    for make in (froe.points, froe.segments, froe.boxes, froe.triangles):
        try:
            scene = make(array)
        except (froe.Error, TypeError, ValueError):
            continue
        assert set(exact(scene.arrays().coords.ravel().tolist())) == set(exact(array.ravel().tolist()))
    for ask in (tree.query, tree.count, tree.locate, tree.nearest, tree.above, tree.query_groups, tree.query_one,
                lambda one: tree.query(balls=(one, one)), lambda one: tree.query(polygon=one),
                lambda one: tree.ray(one, one), lambda one: tree.nearest_points(one, one)):  # fmt: skip
        try:
            ask(array)
        except (froe.Error, TypeError, ValueError):
            pass
    assert tree.query([[0, 0, 1, 1]]).counts().tolist() == [1]


def exact(values):
    return [Fraction(value) for value in values]


def meets(segment, box):
    """Clipping by Liang and Barsky, in fractions."""
    ax, ay, bx, by = exact(segment)
    x0, y0, x1, y1 = exact(box)
    first, last = Fraction(0), Fraction(1)
    for start, way, low, high in ((ax, bx - ax, x0, x1), (ay, by - ay, y0, y1)):
        if way == 0:
            if not low <= start <= high:
                return False
            continue
        enter, leave = sorted([(low - start) / way, (high - start) / way])
        first, last = max(first, enter), min(last, leave)
    return first <= last


@REPEATABLE
@given(segments(8), segments(4))
def test_windows(kept, asked):
    boxes = [[min(a, c), min(b, d), max(a, c), max(b, d)] for a, b, c, d in asked]
    expected = [sorted(i for i, one in enumerate(kept) if meets(one, box)) for box in boxes]
    tree = froe.segments(kept).build()
    assert [sorted(found.tolist()) for found in tree.query(boxes)] == expected
    assert tree.count(boxes).tolist() == [len(found) for found in expected]
    assert [(one >= 0) for one in tree.any(boxes)] == [bool(found) for found in expected]


def square_of_distance(point, segment):
    x, y = exact(point)
    ax, ay, bx, by = exact(segment)
    dx, dy = bx - ax, by - ay
    length = dx * dx + dy * dy
    along = min(max(((x - ax) * dx + (y - ay) * dy) / length, Fraction(0)), Fraction(1)) if length else Fraction(0)
    return (ax + along * dx - x) ** 2 + (ay + along * dy - y) ** 2


@REPEATABLE
@given(segments(8), points(4))
def test_nearest(kept, asked):
    ids, distances = froe.segments(kept).build().nearest(asked)
    for point, found, distance in zip(asked, ids, distances):
        squares = [square_of_distance(point, one) for one in kept]
        assert found == squares.index(min(squares))
        with np.errstate(over="ignore"):
            low, high = np.nextafter(distance, 0), np.nextafter(distance, np.inf)
        assert Fraction(low) ** 2 <= squares[found] and (high == np.inf or squares[found] <= Fraction(high) ** 2)


def turn(a, b, c):
    value = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    return (value > 0) - (value < 0)


def have_a_point_in_common(one, other):
    a, b, c, d = (tuple(exact(end)) for end in (one[:2], one[2:], other[:2], other[2:]))
    if max(min(a, b), min(c, d)) > min(max(a, b), max(c, d)):
        return False  # points of a segment are between its ends in the order of x, then y
    return turn(a, b, c) * turn(a, b, d) <= 0 and turn(c, d, a) * turn(c, d, b) <= 0


@REPEATABLE
@given(segments(7))
def test_pairs(kept):
    found = froe.segments(kept).build().pairs()
    expected = [(i, j) for j in range(len(kept)) for i in range(j) if have_a_point_in_common(kept[i], kept[j])]
    assert sorted(zip(found["a"].tolist(), found["b"].tolist())) == sorted(expected)
    assert all(kind < len(MEETINGS) for kind in found["kind"])
