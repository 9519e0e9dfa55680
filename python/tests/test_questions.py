"""Forms of questions and of answers."""

import numpy as np
import pytest

import froe
from froe.errors import ArrayError, InputError, UnsupportedError
from froe.questions import MEETINGS

SEGMENTS = np.array([[0.0, 0, 2, 2], [3, 0, 3, 2], [5, 5, 6, 6]])


@pytest.fixture
def tree():
    return froe.segments(SEGMENTS).build()


def test_one_box_has_an_array_of_ids(tree):
    for one in ([0, 0, 1, 1], np.array([0.0, 0, 1, 1]), (0, 0, 1, 1)):
        found = tree.query(one)
        assert isinstance(found, np.ndarray) and found.tolist() == [0]
    assert tree.query([0, 0, 1, 1], eps=0.5).tolist() == [0]
    assert tree.query([[0, 0, 1, 1]]).pairs().tolist() == [[0], [0]]
    with pytest.raises(ArrayError, match=r"box must have the shape \(4,\), and has \(3,\)"):
        tree.query([0, 0, 1])
    assert len(tree.query([])) == 0


def test_one_ball_and_one_polygon(tree):
    assert sorted(tree.query(ball=([3, 3], 1.5)).tolist()) == [0, 1]
    assert tree.query(polygon=[[2.5, 0], [4, 0], [4, 1], [2.5, 1]]).tolist() == [1]
    clockwise = [[2.5, 1], [4, 1], [4, 0.5], [4, 0], [2.5, 0], [2.5, 0]]  # with a corner in a side, and one twice
    assert tree.query(polygon=clockwise).tolist() == [1]
    for bad in ([3, 3, 1], ([3, 3],), ([3, 3, 3], 1)):
        with pytest.raises(ArrayError, match="ball|centre"):
            tree.query(ball=bad)
    with pytest.raises(InputError, match="radius"):
        tree.query(ball=([3, 3], -1))
    with pytest.raises(TypeError, match="one kind"):
        tree.query([[0, 0, 1, 1]], ball=([3, 3], 1))
    with pytest.raises(TypeError, match="one kind, and 2"):
        tree.query(ball=([3, 3], 1), polygon=[[0, 0], [1, 0], [0, 1]])


@pytest.mark.parametrize(
    "corners",
    [
        [[0, 0], [4, 0], [1, 1], [0, 4]],
        [[0, 0], [4, 4], [4, 0], [0, 4]],
        [[0, 3], [2, -3], [-3, 1], [3, 1], [-2, -3]],  # turns one way alone, and goes round twice
        [[0, 0], [4, 0], [2, 0]],  # a way there and back is a segment, and no polygon
        [[0, 0], [2**53, 1], [2**54, 2 - 2**-50], [0, 9]],  # a dent of 2^-50
    ],
)
def test_polygons_that_are_not_convex_are_refused(tree, corners):
    with pytest.raises(UnsupportedError, match="join_groups"):
        tree.query(polygon=corners)


@pytest.mark.parametrize("bad", [[[0, 0], [1, 1]], [[0, 0, 0]] * 3, [[0, 0], [1, 0], [0, np.nan]]])
def test_polygons_that_are_none(tree, bad):
    with pytest.raises((ArrayError, InputError)):
        tree.query(polygon=bad)


def test_pairs_have_fields():
    found = froe.segments([[0, 0, 2, 2], [0, 2, 2, 0], [2, 2, 4, 4], [3, 3, 5, 5]]).build().pairs()
    assert found.dtype.names == ("a", "b", "kind") and found.shape == (3,)
    named = {(int(pair["a"]), int(pair["b"])): MEETINGS[pair["kind"]] for pair in found}
    assert named == {(0, 1): "cross", (0, 2): "touch", (2, 3): "overlap"}
    assert froe.points([[0, 0]]).build().pairs().shape == (0,)


def test_the_dimension_of_arrays():
    assert froe.points([[0, 0, 0, 0]]).dim == 4 and froe.points([[0, 0]]).dim == 2 and froe.points([]).dim == 2
    assert froe.segments([[[0, 0, 0], [1, 1, 1]]]).dim == 3 and froe.segments([[0, 0, 1, 1]]).dim == 2
    assert froe.boxes([[0] * 8]).dim == 4 and froe.boxes([[0, 0, 0]], [[1, 1, 1]]).dim == 3
    for bad in (lambda: froe.boxes([[0, 0, 0]]), lambda: froe.boxes([[0, 0]], [[1, 1, 1]]), lambda: froe.points([1, 2]),
                lambda: froe.points([[0, 0, 0]], dim=2)):  # fmt: skip
        with pytest.raises(ArrayError):
            bad()


def test_cells_of_the_whole_scene():
    tree = froe.segments([[0, 1, 2, 1], [0.5, 0, 0.5, 2]]).build("autopartition", purpose="pieces")
    cells = tree.cells()
    area = sum(
        abs(np.dot(p[:, 0], np.roll(p[:, 1], 1)) - np.dot(p[:, 1], np.roll(p[:, 0], 1))) / 2 for p in cells.polygons()
    )
    assert len(cells) == 2 and area == 4
    assert len(froe.segments([]).build("autopartition").cells()) == 1


def test_a_tree_of_whole_objects_names_the_purpose_to_draw():
    tree = froe.triangles([[[0, 0, 0], [4, 0, 0], [2, 0, 3]]]).build()
    with pytest.raises(UnsupportedError, match='purpose "draw"'):
        tree.render()
    with pytest.raises(UnsupportedError, match='purpose "draw"'):
        tree.order([0, 0, 1])


def test_rows_of_ragged_arrays_are_counted_from_both_ends(tree):
    pieces, answers = tree.pieces(), tree.query(SEGMENTS)
    for ragged, first, last in ((pieces, pieces.coords[:2], pieces.coords[-2:]), (answers, [0], [2])):
        assert np.array_equal(ragged[0], first) and np.array_equal(ragged[-3], first)
        assert np.array_equal(ragged[-1], last) and np.array_equal(ragged[np.uint8(2)], last)
        for number in (3, -4):
            with pytest.raises(IndexError, match=f"no (piece|question) {number}: there are 3"):
                ragged[number]
        for wrong in (slice(2), 1.0, np.array([0, 1])):
            with pytest.raises(TypeError, match="integer|index"):
                ragged[wrong]
        assert len(list(ragged)) == 3
    all_of_them = froe.Answers(np.arange(257), np.arange(256))
    assert all_of_them[np.uint8(255)].tolist() == [255]  # numpy 2 adds 1 to it and has 0


def test_what_holds_arrays_is_equal_to_itself_alone(tree):
    motion = froe.generate_motion("moving", 4)
    for make in (
        lambda: tree.query([[0, 0, 1, 1]]),
        tree.pieces,
        tree.cells,
        tree.scene.arrays,
        motion.contacts,
        lambda: motion.kinetic().advance(1),
    ):
        one, other = make(), make()
        assert one == one and one != other and {one, other} == {other, one} and len({one, other}) == 2


def test_one_thing_is_not_called_several():
    scene, motion = froe.points([[0, 0]]), froe.Motion(0, 1)
    tree = scene.build()
    motion.add([0, 0], [[0, 0], [1, 1]], [0, 1, 2])
    assert repr(scene) == "<froe.Scene: 1 object in R^2>"
    assert repr(tree) == "<froe.Tree: 1 object in R^2, 1 piece, by index>"
    assert repr(tree.query([[0, 0, 1, 1]])) == "<froe.Answers: 1 answer to 1 question>"
    assert repr(motion) == "<froe.Motion: 1 object in R^2, from 0 to 1>"
    assert "<title>1 cell, 1 piece</title>" in tree.draw().svg
