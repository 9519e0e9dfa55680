"""Bad input becomes an exception that says what is wrong, and nothing is changed."""

import pickle
import warnings
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pandas
import pytest
from matplotlib import pyplot

import froe
import froe.mpl
from froe.compat.shapely import STRtree
from froe.compat.trimesh import Ray
from froe.errors import (
    ArgumentError,
    ArrayError,
    BusyError,
    CancelledError,
    ClosedError,
    FileError,
    FormatError,
    FrozenError,
    InputError,
    OptionError,
    UnsupportedError,
)

SEGMENTS = np.array([[0.0, 0, 2, 2], [0, 2, 2, 0], [5, 5, 6, 6]])


TREE = froe.segments(SEGMENTS).build()
MOTION = froe.Motion(0, 10)


def add_still(count, **about):
    MOTION.add(np.zeros(count), np.zeros((count, 2)), range(count + 1), **about)


class Masked:
    """Something that becomes an array, of which an item has no value."""

    def __array__(self, dtype=None):
        return np.ma.masked_array(np.zeros((1, 4)), mask=[[0, 0, 1, 0]])


@pytest.fixture
def tree():
    return froe.segments(SEGMENTS).build()


@pytest.mark.parametrize(
    "bad, word",
    [
        ([[0, 0, 1, 1j]], "complex"),
        ([["a", "b", "c", "d"]], "<U1"),
        (np.zeros((2, 4), bool), "bool"),
        ([[None] * 4], "object"),
        (np.array([["2020-01-01"] * 4], "M8[D]"), "datetime"),
        ([[0, 0, 1]], r"\(1, 3\)"),
        (np.zeros((2, 3, 3)), r"\(2, 3, 3\)"),
        (np.zeros((1, 1, 4)), r"\(1, 1, 4\)"),
        (5, r"\(n, 2 dim\), and has \(\)"),
        ([[0, 0, 1], [0]], "cannot become an array"),
        ([[2**60 + 1, 0, 0, 0]], "1152921504606846977"),
        ([[2**53 + 1, 0.5, 0, 0]], r"9007199254740993 at \(0, 0\)"),
        ([[0, 0, 1, 1], [0.5, 0, 0, -(2**53) - 1]], r"-9007199254740993 at \(1, 3\)"),
        ([[2**63 + 1, 0, 0, -1]], "9223372036854775809"),
        (np.array([[2**64 - 1, 0, 0, 0]], np.uint64), "18446744073709551615"),
        ([np.array([2**60 + 1, 0]), np.array([0.5, 0])], "1152921504606846977"),
        ([[2**80, 0, 0, 0]], "object"),
        (np.ma.masked_array(np.zeros((1, 4)), mask=[[1, 0, 0, 0]]), "masked"),
        ([[0, 0, 1, 1], np.ma.masked_array(np.zeros(4), mask=[1, 0, 0, 0])], "masked"),
        ([[[0, 0], np.ma.masked_array(np.zeros(2), mask=[1, 0])]], "masked"),
        (([[0, 0], [1, 1]], (np.zeros(2), np.ma.masked_array(np.zeros(2), mask=[0, 1]))), "masked"),
        (Masked(), "masked"),
    ],
)
def test_arrays_that_are_none(bad, word):
    with pytest.raises(ArrayError, match=word):
        froe.segments(bad)


def test_large_numbers_are_refused_without_a_warning():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(ArrayError, match="float64 cannot hold"):
            froe.points(np.array([[np.longdouble("1e4000"), 0]]))


def test_one_point_is_no_array_of_points():
    with pytest.raises(ArrayError, match=r"points must have the shape \(n, dim\), and has \(2,\)"):
        froe.points([0, 1])


@pytest.mark.parametrize("number", [np.nan, np.inf, -np.inf])
def test_numbers_that_are_not_finite(number):
    scene = froe.segments(SEGMENTS)
    bad = SEGMENTS + 10
    bad[1, 3] = number
    with pytest.raises(InputError) as caught:
        scene.add_segments(bad)
    assert (caught.value.object, caught.value.corner, caught.value.axis) == (1, 1, 1)
    assert caught.value.status == "FROE_E_INPUT" and isinstance(caught.value, ValueError)
    assert len(scene) == 3


@pytest.mark.parametrize(
    "same",
    [
        SEGMENTS.astype(">f8"),
        np.asfortranarray(SEGMENTS),
        np.repeat(SEGMENTS, 2, axis=1)[:, ::2],
        SEGMENTS[::-1][::-1],
        SEGMENTS.astype("f4"),
        SEGMENTS.astype("i2"),
        SEGMENTS.tolist(),
        SEGMENTS.reshape(3, 2, 2),
        np.frombuffer(b"x" + SEGMENTS.tobytes(), "f8", 12, 1).reshape(3, 4),
        np.ma.masked_array(SEGMENTS),
        [[0, 0, 2, 2], [0.0, 2, np.float32(2), np.int8(0)], np.array([5, 5, 6, 6])],
    ],
)
def test_layouts_that_lose_nothing(same):
    assert np.array_equal(froe.segments(same).arrays().coords, froe.segments(SEGMENTS).arrays().coords)


BOX = np.array([0.0, 0, 3, 3])


@pytest.mark.parametrize(
    "same",
    [
        BOX.astype(">f8"),
        BOX.astype("f4"),
        BOX.astype("i8"),
        BOX.astype("u1"),
        np.repeat(BOX, 2)[::2],
        BOX[::-1].copy()[::-1],
        np.frombuffer(b"x" + BOX.tobytes(), "f8", 4, 1),
        BOX.astype(np.longdouble),
        BOX.tolist(),
        tuple(BOX),
    ],
)
def test_layouts_of_one_box(tree, same):
    assert sorted(tree.query_one(same).tolist()) == [0, 1]


@pytest.mark.parametrize("number", [2**60, -(2**63), 2**63, 2**54 + 4])
def test_large_whole_numbers_that_are_doubles(number):
    kind = np.uint64 if number >= 2**63 else np.int64
    assert froe.points(np.array([[number, 0]], kind)).bounds[0, 0] == number
    assert froe.points([[number, 0.5]]).bounds[0, 0] == number


def at_odd_address(array):
    """The same at an address that no item of more than one byte should have."""
    return np.frombuffer(b"x" + array.tobytes(), array.dtype, array.size, 1).reshape(array.shape)


def test_columns_of_pandas_whose_items_may_be_missing(tree):
    whole, half = pandas.Series([1, 2], dtype="Int64"), pandas.Series([1.5, 2], dtype="Float64")
    table = pandas.DataFrame({"x": whole, "y": half})
    assert froe.points(table).arrays().coords.tolist() == [[1, 1.5], [2, 2]]
    assert froe.points(table[["x", "x"]]).arrays().coords.tolist() == [[1, 1], [2, 2]]
    assert np.array_equal(tree.nearest(table)[1], tree.nearest([[1, 1.5], [2, 2]])[1])
    scene = froe.Scene(2)
    scene.add_points(table, tags=whole, groups=None)
    scene.add_points([[0, 0], [1, 1]], tags=pandas.array(np.array([2**64 - 1, 7], np.uint64), dtype="UInt64"))
    assert scene.arrays().tags.tolist() == [1, 2, 2**64 - 1, 7]
    for row, column in ((0, "x"), (1, "y")):
        lost = table.copy()
        lost.loc[row, column] = pandas.NA
        with pytest.raises(ArrayError, match=rf"points has no value at \({row}, {row}\)\."):
            froe.points(lost)
    with pytest.raises(ArrayError, match=r"tags has no value at \(1,\)\."):
        scene.add_points([[0, 0], [1, 1]], tags=pandas.Series([1, None], dtype="Int64"))
    large = pandas.DataFrame({"x": pandas.Series([2**53 + 1], dtype="Int64"), "y": half[:1]})
    with pytest.raises(ArrayError, match="9007199254740993"):
        froe.points(large)
    for other in (table.astype("string"), table.assign(y=[True, False]), table.assign(y=pandas.array([True, False]))):
        with pytest.raises(ArrayError, match="must be an array of float64"):
            froe.points(other)


def test_arrays_at_odd_addresses(tree):
    scene = froe.Scene(2)
    scene.add_points(np.zeros((2, 2)), tags=at_odd_address(np.array([7, 9], np.uint64)))
    scene.add_hulls(at_odd_address(np.eye(2)), at_odd_address(np.array([0, 2], np.uint64)))
    assert scene.arrays().tags.tolist() == [7, 9, 2]
    room = np.zeros(17, np.uint8)
    nothing = np.ndarray((0, 2), np.float64, room.data, 1)  # which numpy takes for aligned
    assert len(tree.locate(nothing)) == 0 and len(froe.points(nothing)) == 0
    assert len(froe.triangles(np.eye(3), np.ndarray((0, 3), np.uint32, room.data, 1))) == 0


def test_large_tags():
    tags = [2**64 - 1, 2**53 + 1, 2**63, 0]  # numpy 1 makes doubles of such a list
    scene = froe.Scene(2)
    scene.add_points(np.zeros((4, 2)), tags=tags)
    assert scene.arrays().tags.tolist() == tags
    with pytest.raises(ArrayError, match="18446744073709551616"):
        scene.add_points([[0, 0], [1, 1]], tags=[1, 2**64])
    with pytest.raises(ArrayError, match="float64"):
        scene.add_points([[0, 0], [1, 1]], tags=[1.0, 2])


def test_empty_arrays(tree):
    for empty in ([], np.zeros((0, 4)), np.zeros((0, 2, 2))):
        assert len(froe.segments(empty)) == 0 and len(tree.query(empty)) == 0
    assert froe.segments(np.zeros((0, 6))).dim == froe.points(np.zeros((0, 3))).dim == 3
    assert froe.boxes(np.zeros((0, 2, 4))).dim == 4 and len(froe.boxes([], [])) == 0
    assert len(froe.triangles(np.eye(3), [])) == len(froe.triangles([], [])) == 0
    for rows_of_nothing in ([[]], np.zeros((5, 0))):
        with pytest.raises(ArrayError, match=r"has \([15], 0\)"):
            tree.query(rows_of_nothing)
        with pytest.raises(ArrayError, match=r"has \([15], 0\)"):
            froe.points(rows_of_nothing)
    nothing = froe.segments([]).build()
    assert nothing.query([[0, 0, 1, 1]]).counts().tolist() == [0]
    ids, distances = nothing.nearest([[0, 0]])
    assert ids.tolist() == [-1] and distances.tolist() == [np.inf]
    assert len(nothing.pairs()) == 0 and nothing.scene.bounds is None


@pytest.mark.parametrize(
    "ask, kind, word",
    [
        (lambda t: t.query([[0, 0, 1, 1], [1, 1, 0, 0]]), InputError, "low corner"),
        (lambda t: t.query([[0, 0, np.nan, 1]]), InputError, "nan"),
        (lambda t: t.query(), TypeError, "one kind"),
        (lambda t: t.query([[0, 0, 1, 1]], segments=[[0, 0, 1, 1]]), TypeError, "one kind"),
        (lambda t: t.query(balls=([[0, 0]], [-1])), InputError, "radius"),
        (lambda t: t.query(balls=([[0, 0]], [1, 2])), ArrayError, "2 rows"),
        (lambda t: t.query(balls=[[0, 0, 1]]), ArrayError, "tuple"),
        (lambda t: t.query(hulls=[[[0, 0]], []]), InputError, "no points"),
        (lambda t: t.query([[0, 0, 1, 1]], eps=-1), InputError, "eps"),
        (lambda t: t.query_one([0, 0, 1]), ArrayError, "do not make rows"),
        (lambda t: t.query_one(np.zeros((2, 4))), ArrayError, "4 numbers"),
        (lambda t: t.query_one(np.zeros(4, bool)), ArrayError, "float64"),
        (lambda t: t.query_one(np.ma.masked_array(np.zeros(4), [0, 0, 0, 1])), ArrayError, "masked"),
        (lambda t: t.query_one(np.array([2**53 + 1, 0, 2**54, 1])), ArrayError, "9007199254740993"),
        (lambda t: t.query([[0, 0, 1, 1]], threads=-1), ArgumentError, "threads"),
        (lambda t: t.query([[0, 0, 1, 1]], threads=2**40), ArgumentError, "threads"),
        (lambda t: t.query([[0, 0, 1, 1]], threads=1.5), ArrayError, "threads"),
        (lambda t: t.nearest([[0, 0]], k=-1), ArgumentError, "k is -1"),
        (lambda t: t.nearest([[0, 0]], k=1.5), ArrayError, "whole"),
        (lambda t: t.nearest([[0, 0]], max_distance=-1), InputError, "-1"),
        (lambda t: t.nearest([[0, 0]], max_distance=np.nan), InputError, "nan"),
        (lambda t: t.ray([[0, 0]], [[0, 0]]), InputError, "direction"),
        (lambda t: t.ray([[0, 0]], [[0, 1], [1, 1]]), ArrayError, "2 rows"),
        (lambda t: t.nearest_points([9], [[0, 0]]), ArgumentError, "object 9"),
        (lambda t: t.nearest_points([-1], [[0, 0]]), ArrayError, "-1"),
        (lambda t: t.hit_places([0], [[9, 9]], [[1, 0]]), InputError, "not meet"),
        (lambda t: t.query_groups([[0, 0, 1, 1]], relation="near"), OptionError, "near"),
        (lambda t: t.query_groups([[0, 0, np.nan, 1]]), InputError, "nan"),
        (lambda t: t.query_groups(), TypeError, "one kind"),
        (lambda t: t.join_groups(t, relation=0), OptionError, "0"),
        (lambda t: t.join_groups(froe.triangles([np.eye(3)]).build()), UnsupportedError, "plane"),
        (lambda t: t.cells([0, 0], [np.nan, 1]), ArgumentError, "nan"),
        (lambda t: t.cells([0, 0, 0], [1, 1]), ArrayError, r"\(3,\)"),
        (lambda t: t.order([0]), ArrayError, r"\(1,\)"),
        (lambda t: t.export("x.csv", "trees"), OptionError, "trees"),
        (lambda t: t.save("/dev/null/nonexistent/a"), FileError, "nonexistent"),
    ],
)
def test_bad_questions(tree, ask, kind, word):
    with pytest.raises(kind, match=word):
        ask(tree)
    assert tree.query([[0, 0, 9, 9]]).counts().tolist() == [3]


LARGE = 2**53


@pytest.mark.parametrize(
    "call, name",
    [
        (lambda x: froe.points([[LARGE + 4, 0]]).build().nearest([[0, 0]], max_distance=x), "max_distance"),
        (lambda x: TREE.ray([[0, 0]], [[1, 0]], x), "t_max"),
        (lambda x: TREE.query(segments=[[0, 0, 1, 1]], eps=x), "eps"),
        (lambda x: froe.Motion(0, x), "end"),
        (lambda x: froe.Motion(x, 2.0**60), "begin"),
        (lambda x: froe.Motion(0, 2.0**60, tick=x), "tick"),
        (lambda x: MOTION.contacts(begin=x), "begin"),
        (lambda x: MOTION.contacts(end=x), "end"),
        (lambda x: MOTION.positions(x), "time"),
        (lambda x: MOTION.without_bodies(x), "deviation"),
        (lambda x: MOTION.kinetic().advance(x), "time"),
        (lambda x: froe.read_poses("none.csv", froe.Scene(3), x, 1), "begin"),
        (lambda x: froe.measure.directional(TREE.scene, x), "delta"),
    ],
)
def test_numbers_beside_arrays_lose_nothing(call, name):
    for number in (LARGE + 3, Fraction(1, 3), Decimal("0.1"), np.longdouble(1) / 3, 10**400):
        with pytest.raises(ArrayError, match=rf"^{name} is .*, which float64 cannot hold\.$"):
            call(number)
    for other in (None, "1", np.array([1.0, 2]), 1j, []):
        with pytest.raises(ArrayError, match=rf"^{name} is .*, and must be a number\.$"):
            call(other)


def test_numbers_beside_arrays_of_any_type():
    fives = (5, 5.0, np.float32(5), np.int8(5), np.longdouble(5), Fraction(5), Decimal(5), np.array(5))
    for far in (*fives, np.inf, np.float32(np.inf)):
        assert TREE.nearest([[2, 5]], max_distance=far)[0].tolist() == [0]
    with pytest.raises(InputError, match="nan"):
        TREE.nearest([[0, 0]], max_distance=Decimal("nan"))


def test_which_question_is_bad(tree):
    with pytest.raises(InputError) as caught:
        tree.query([[0, 0, 1, 1], [0, 0, 1, 1], [0, 0, np.nan, 1]])
    assert caught.value.object == 2


@pytest.mark.parametrize(
    "add, kind, word",
    [
        (lambda s: s.add_segments(SEGMENTS, group=3), InputError, "group 3"),
        (lambda s: s.add_segments(SEGMENTS, groups=[0, 0, 7]), InputError, "group 0|group 7"),
        (lambda s: s.add_segments(SEGMENTS, tags=[1, 2]), ArrayError, "2 rows"),
        (lambda s: s.add_segments(SEGMENTS, tags=[1, -2, 3]), ArrayError, "-2"),
        (lambda s: s.add_balls([[0, 0]], [-1]), InputError, "radius"),
        (lambda s: s.add_boxes([[1, 1, 0, 0]]), InputError, "above"),
        (lambda s: s.add_hulls([[0, 0], [1, 1]], [0, 5]), InputError, "2 corners"),
        (lambda s: s.add_hulls([[0, 0], [1, 1]], [2, 0]), InputError, "falls"),
        (lambda s: s.add_hulls([[0, 0], [1, 1]], []), ArrayError, "at least one"),
        (lambda s: s.add_triangles(np.eye(3)), UnsupportedError, "dimension"),
        (lambda s: s.add_group(5), ArrayError, "name"),
        (lambda s: s.add_group("a\0b"), ArgumentError, "name"),
        (lambda s: s.add_group("\udc80"), ArgumentError, "name"),
        (lambda s: s.group(0), ArgumentError, "group 0"),
        (lambda s: s.build("best"), OptionError, "best"),
        (lambda s: s.build(5), ArrayError, "method"),
        (lambda s: s.build(leaf=-1), ArgumentError, "leaf"),
        (lambda s: s.build(seed=-1), ArgumentError, "seed"),
        (lambda s: s.build(seed=2**70), ArgumentError, "seed"),
        (lambda s: s.build(settings="x=1"), OptionError, "x"),
        (lambda s: s.write("/dev/null/nonexistent/a.csv"), FileError, "nonexistent"),
    ],
)
def test_bad_scenes(add, kind, word):
    scene = froe.Scene(2)
    with pytest.raises(kind, match=word):
        add(scene)
    assert len(scene) == 0
    scene.add_segments(SEGMENTS)
    assert len(scene) == 3


@pytest.mark.parametrize(
    "add, name, shape",
    [
        (lambda s: s.add_points(np.zeros((4, 2)), tags=[[1, 2], [3, 4]]), "tags", r"\(2, 2\)"),
        (lambda s: s.add_points(np.zeros((4, 2)), tags=np.zeros((4, 1), int)), "tags", r"\(4, 1\)"),
        (lambda s: s.add_points(np.zeros((1, 2)), tags=5), "tags", r"\(\)"),
        (lambda s: s.add_points(np.zeros((4, 2)), faces=[[1, 2], [3, 4]]), "faces", r"\(2, 2\)"),
        (lambda s: s.add_points(np.zeros((4, 2)), groups=[[1, 2], [3, 4]]), "groups", r"\(2, 2\)"),
        (lambda s: s.add_balls(np.zeros((4, 2)), [[1, 2], [3, 4]]), "radii", r"\(2, 2\)"),
        (lambda s: s.add_hulls(np.eye(2), [[0], [2]]), "starts", r"\(2, 1\)"),
        (lambda s: s.add_polygons(np.eye(2), [[0, 2]]), "starts", r"\(1, 2\)"),
        (lambda s: TREE.query(balls=(np.zeros((4, 2)), [[1, 2], [3, 4]])), "radii", r"\(2, 2\)"),
        (lambda s: TREE.nearest_points([[0, 1]], np.zeros((2, 2))), "objects", r"\(1, 2\)"),
        (lambda s: TREE.hit_places([[0], [1]], np.zeros((2, 2)), np.ones((2, 2))), "objects", r"\(2, 1\)"),
        (lambda s: add_still(4, vertices=[[0, 1, 2, 3]]), "vertices", r"\(1, 4\)"),
        (lambda s: add_still(4, births=[[0, 1]]), "births", r"\(1, 2\)"),
        (lambda s: add_still(4, tags=[[0, 1]]), "tags", r"\(1, 2\)"),
    ],
)
def test_arrays_that_have_one_number_for_each_have_one_axis(add, name, shape):
    scene = froe.Scene(2)
    with pytest.raises(ArrayError, match=rf"^{name} must have the shape \(n, ?2?\), and has {shape}\.$"):
        add(scene)
    assert len(scene) == len(MOTION) == 0


def test_triangles_and_dimensions():
    with pytest.raises(InputError, match="point 7"):
        froe.triangles(np.eye(3), [[0, 1, 7]])
    with pytest.raises(ArrayError, match=r"\(1, 2\)"):
        froe.triangles(np.eye(3), [[0, 1]])
    for dim in (1, 9, -1, 2**40):
        with pytest.raises(ArgumentError, match="dim"):
            froe.Scene(dim)
    with pytest.raises(ArrayError, match="whole"):
        froe.Scene("2")


def test_a_frozen_scene(tree):
    with pytest.raises(FrozenError):
        tree.scene.add_segments(SEGMENTS)
    assert tree.scene.build("kd").report.method == "kd"


def test_a_closed_tree(tree):
    scene = tree.scene
    tree.close()
    tree.close()
    for ask in (
        lambda: tree.query([[0, 0, 1, 1]]),
        lambda: tree.query_one([0, 0, 1, 1]),
        lambda: tree.query_groups([[0, 0, 1, 1]]),
        lambda: tree.join_groups(tree),
        lambda: tree.cells(),
        lambda: tree.pairs(),
        lambda: tree.check(),
        lambda: tree.report,
        lambda: tree.scene,
        lambda: pickle.dumps(tree),
        lambda: tree.pieces(),
        lambda: tree.save("x"),
        lambda: tree.render(),
        lambda: tree.audit(),
    ):
        with pytest.raises(ClosedError, match="closed"):
            ask()
    assert repr(tree) == "<froe.Tree: closed>" and len(scene) == 3  # the scene keeps what it needs


def test_groups_of_a_closed_tree(tree):
    other = froe.segments(SEGMENTS).build()
    other.close()
    with pytest.raises(ClosedError):
        tree.join_groups(other)
    with pytest.raises(TypeError, match="questions is None"):
        tree.join_groups(None)
    with pytest.raises(ArrayError, match="no tree"):
        tree._core.group_join(0, froe.segments(SEGMENTS)._core, 0, None)
    assert tree.join_groups(tree).counts().tolist() == []


def test_what_lies_in_a_group_is_refused_by_name():
    scene = froe.Scene(2)
    group = scene.add_group("a square")
    scene.add_segments([[0, 0, 4, 0], [4, 0, 4, 4], [4, 4, 0, 4], [0, 4, 0, 0]], group=group)
    tree = scene.build()
    assert tree.query_groups(balls=([[2, 2]], 1)).counts().tolist() == [1]
    assert tree.query_groups(balls=([[2, 2]], 9), relation="within").counts().tolist() == [1]
    with pytest.raises(UnsupportedError, match="ball"):
        tree.query_groups(balls=([[2, 2]], 1), relation="covers")
    assert tree.query_groups(hulls=[[[1, 1], [3, 1], [2, 3]]], relation="covers").counts().tolist() == [1]


def test_files_whose_end_is_wrong_open_and_are_refused_by_what_reads_it(tree, tmp_path):
    saved = tree._core.to_bytes()
    (tmp_path / "bad.froe").write_bytes(saved[:-1] + bytes([saved[-1] ^ 1]))
    bad = froe.open(tmp_path / "bad.froe")
    assert bad.report.objects == tree.report.objects
    with pytest.raises(FormatError, match="corrupted"):
        bad.save(tmp_path / "copy.froe")
    with pytest.raises(FormatError, match="corrupted"):
        bad.audit()
    assert not (tmp_path / "copy.froe").exists()


def test_files_that_are_no_trees(tree, tmp_path):
    saved = tree._core.to_bytes()
    version = bytearray(saved)
    version[8:12] = b"\xff\xff\xff\x7f"
    for bad in (b"", b"x", saved[:100], b"nope" + saved[4:], bytes(version), saved[:-1], saved + b"x"):
        (tmp_path / "bad.froe").write_bytes(bad)
        with pytest.raises(FormatError):
            froe.open(tmp_path / "bad.froe")
        with pytest.raises(FormatError):
            froe.tree._from_bytes(bad)
    with pytest.raises(FormatError, match="version 2147483647"):
        froe.tree._from_bytes(bytes(version))
    (tmp_path / "bad.froe").write_bytes(version)
    with pytest.raises(FormatError, match="bad.froe.*version 2147483647"):
        froe.open(tmp_path / "bad.froe")
    with pytest.raises(FileError) as caught:
        froe.open(tmp_path / "none.froe")
    assert isinstance(caught.value, OSError) and "none.froe" in str(caught.value)
    with pytest.raises(TypeError):
        froe.open(5)
    with pytest.raises(FileError):
        froe.read(tmp_path / "none.geojson")


def test_files_in_which_a_bit_is_wrong(tree, tmp_path):
    """What was not looked at when the file was opened is refused when it is read."""
    saved = tree._core.to_bytes()
    for place in range(0, len(saved), 3):
        wrong = saved[:place] + bytes([saved[place] ^ 1 << place % 8]) + saved[place + 1 :]
        with pytest.raises(FormatError):
            froe.tree._from_bytes(wrong).check()
        with pytest.raises(FormatError):
            froe.tree._from_bytes(wrong).pairs()
    (tmp_path / "bad.froe").write_bytes(wrong)
    with pytest.raises(FormatError):
        froe.open(tmp_path / "bad.froe").check()
    (tmp_path / "good.froe").write_bytes(saved)
    froe.open(tmp_path / "good.froe").check()


def test_progress_that_stops_or_fails(tree):
    with pytest.raises(CancelledError) as caught:
        froe.generate("segments", 100000).build("autopartition", progress=lambda done: False)
    assert isinstance(caught.value, KeyboardInterrupt)

    def fail(done):
        raise ZeroDivisionError("of the function's own")

    with pytest.raises(ZeroDivisionError):
        froe.generate("segments", 100000).build("autopartition", progress=fail)
    with pytest.raises(TypeError, match="not callable"):
        froe.generate("segments", 100000).build("autopartition", progress=5)


def test_a_scene_in_use():
    scene, caught = froe.generate("segments", 100000), []

    def use(done):
        for call in (lambda: scene.add_segments(SEGMENTS), lambda: scene.build(), lambda: len(scene)):
            try:
                call()
            except BusyError as error:
                caught.append(error)

    scene.build("autopartition", progress=use)
    assert len(caught) >= 3 and len(scene) == 100000


def test_objects_of_the_extension_are_not_made_by_hand():
    for kind in (froe._core.Tree, froe._core.Scene, froe._core.Array):
        with pytest.raises(TypeError):
            kind()


def test_calls_of_the_extension_with_any_arguments(tree):
    """Whatever the package passes on by mistake, the extension refuses."""
    anything = (None, -1, 1.5, "x", b"x", [], {}, np.zeros(3), np.zeros((2, 2), "f4"), object())
    for owner in (tree._core, froe.segments(SEGMENTS)._core):
        for name in (name for name in dir(owner) if not name.startswith("_") and name not in ("close", "save")):
            call = getattr(owner, name)
            for count in range(12):
                for value in anything:
                    try:
                        call(*[value] * count)
                    except (froe.Error, TypeError, ValueError, OSError):
                        pass
    assert tree.query([[0, 0, 9, 9]]).counts().tolist() == [3]


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda tree: tree.query([[0, 0, 1, 1], [0, 0, 1, np.nan]]), "question 1: A coordinate of a box is nan, "),
        (lambda tree: tree.nearest([[0, 0], [0, 0], [0, np.inf]]), "question 2: Coordinate 1 of a point is inf, "),
        (lambda tree: tree.nearest_points([0, 7], [[0, 0], [1, 1]]), "question 1: There is no object 7 in a scene of 1."),
        (lambda tree: tree.ray([[0, 0]], [[0, 1], [1, 0]]), "directions has 2 rows, and must have 1."),
        (lambda tree: froe.points([[0, 2**53 + 1]]), "points has the number 9007199254740993 at (0, 1), which float64 "),
        (lambda tree: tree.render(fov=50, zoom=3), "There is no option 'zoom' of pictures."),
        (lambda tree: tree.render(size=800), "size is 800, and must be two lengths, like (800, 600)."),
        (lambda tree: tree.render(eye=(0, 1)), "eye has 2 items, which do not make rows of 3."),
        (lambda tree: froe.from_shapely([{"type": "Point", "coordinates": [0, 0]}, 3]), "Object 1 is not a geometry: it is 3."),
        (lambda tree: froe.Motion(0, 1).add([0], [[0, 0]], [0, 1]), "Each object takes 2 vertices, and their number is 1."),
    ],
)
def test_messages_name_what_is_to_blame(call, message):
    tree = froe.segments([[0, 0, 1, 1]]).build()
    with pytest.raises((froe.Error, ValueError)) as caught:
        call(tree)
    assert str(caught.value).startswith(message)


def test_every_false_ends_a_call():
    scene = froe.generate("segments", 50000)
    for no in (False, np.False_, np.bool_(False)):
        with pytest.raises(CancelledError):
            scene.build("autopartition", progress=lambda done: no)
    for yes in (None, True, np.True_, "", []):
        assert len(scene.build("autopartition", progress=lambda done: yes).scene) == 50000


@pytest.mark.parametrize(
    "geometry, word",
    [
        ({"type": "LineString", "coordinates": [0, 0, 1, 1]}, r"Object 1 .*\(4,\)"),
        ({"type": "Point", "coordinates": [1]}, r"Object 1 .*\(1, 1\)"),
        ({"type": "Polygon", "coordinates": [[[[0, 0], [1, 1]]]]}, r"Object 1 .*\(1, 2, 2\)"),
        ({"type": "Point", "coordinates": ["1", "2"]}, "Object 1 .*<U1"),
    ],
)
def test_coordinates_that_are_no_places(geometry, word):
    with pytest.raises(ValueError, match=word):
        froe.from_shapely([None, geometry])


def test_polygons_of_pyvista_with_negative_counts():
    class mesh:
        points, faces = np.eye(3), [3, 0, 1, 2, -1, 0, 1]

    with pytest.raises(ValueError, match="Polygon 1 of the mesh has -1 corners"):
        froe.from_pyvista(mesh)
    mesh.faces = [0, 0, 0]
    with pytest.raises(ValueError, match="Polygon 0 of the mesh has 0 corners"):
        froe.from_pyvista(mesh)


class Square:
    """As meshes of trimesh and of pyvista are."""

    def __init__(self, places, faces):
        self.vertices = self.points = places
        self.faces = faces


FLAT = np.array([[0.0, 0, 0], [4, 0, 0], [4, 4, 0]])


@pytest.mark.parametrize(
    "lost, word",
    [
        (np.array([[2**53 + 1, 0, 0], [4, 0, 0], [4, 4, 0]]), "9007199254740993"),
        (np.ma.masked_array(FLAT, mask=FLAT == 4), "masked"),
        (FLAT + 1j, "complex"),
        (FLAT.astype(str), "<U"),
        (FLAT.astype(np.longdouble) / 3, "float64 cannot hold"),
    ],
)
def test_meshes_and_what_they_are_asked_lose_nothing(lost, word):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for call in (
            lambda: froe.from_trimesh(Square(lost, [[0, 1, 2]])),
            lambda: froe.from_pyvista(Square(lost, [3, 0, 1, 2])),
            lambda: Ray(Square(FLAT, [[0, 1, 2]])).intersects_first(lost, FLAT + 1),
            lambda: Ray(Square(FLAT, [[0, 1, 2]])).closest_point(lost),
        ):
            with pytest.raises(ArrayError, match=word):
                call()
        index = STRtree([{"type": "Point", "coordinates": [0, 0]}])
        with pytest.raises(ArrayError, match=word):
            index.query([{"type": "Point", "coordinates": [0, 3]}] * 3, predicate="dwithin", distance=lost[:, 0])
    with pytest.raises(ArrayError, match="whole numbers, and their type is float64"):
        froe.from_pyvista(Square(FLAT, [3, 0, 1.5, 2]))


def test_trees_of_the_plane_are_not_drawn_in_space():
    axes = pyplot.figure().add_subplot(projection="3d")
    with pytest.raises(ValueError, match="The tree is not one of space."):
        froe.mpl.draw3d(axes, froe.segments(SEGMENTS).build())
    assert not axes.collections


def test_arguments_of_other_kinds():
    tree = froe.segments(SEGMENTS).build()
    with pytest.raises(TypeError, match="questions is 5, and must be a froe.Tree"):
        tree.join_groups(5)
    with pytest.raises(TypeError, match="crs is 'EPSG:4326', and must be a froe.Crs or None"):
        froe.Scene(2).crs = "EPSG:4326"
    for measure in (froe.measure.defects, froe.measure.fatness, froe.measure.density, froe.measure.clutter):
        with pytest.raises(TypeError, match="scene is <froe.Tree: .*>, and must be a froe.Scene"):
            measure(tree)
    with pytest.raises(TypeError, match="scene is <froe.Tree: .*>, and must be a froe.Scene"):
        froe.compare(tree, ["kd"])
    with pytest.raises(TypeError, match="scene is None, and must be a froe.Scene"):
        froe.measure.directional(None)
    with pytest.raises(TypeError, match="model is <froe.Tree: .*>, and must be a froe.Scene"):
        froe.read_poses("poses.csv", tree)
