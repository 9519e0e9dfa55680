"""Motions, their contacts, and partitions of them, beside what simple formulas say."""

import math
from fractions import Fraction

import numpy as np
import pytest

import froe
from froe.errors import ArgumentError, ArrayError, BusyError, InputError, UnsupportedError


def movers(count, seed=5):
    """Short upright segments that move to the right at speeds of their own."""
    random = np.random.default_rng(seed)
    place, speed = random.integers(0, 1000, (count, 2)).astype(float), random.integers(1, 9, count).astype(float)
    from_, to = place.copy(), place.copy()
    to[:, 0] += 8 * speed
    up = np.array([0.0, 40.0])
    coords = np.stack([from_, to, from_ + up, to + up], axis=1).reshape(-1, 2)
    motion = froe.Motion(0, 8)
    motion.add(np.tile([0.0, 8.0], 2 * count), coords, np.arange(0, 4 * count + 1, 2))
    return motion, place, speed


def test_contacts_are_those_of_the_formula():
    """Two upright segments meet where their x agree, at a rational time, if their y overlap."""
    motion, place, speed = movers(220)
    expected = {}
    for a in range(220):
        for b in range(a + 1, 220):
            gap, gain = Fraction(place[b, 0]) - Fraction(place[a, 0]), Fraction(speed[a]) - Fraction(speed[b])
            if abs(place[a, 1] - place[b, 1]) > 40 or gain == 0 and gap:
                continue
            time = gap / gain if gain else Fraction(0)
            if 0 <= time <= 8:
                expected[a, b] = time, gain != 0
    found = motion.contacts()
    assert len(expected) > 20
    assert {(a, b) for a, b in zip(found.a.tolist(), found.b.tolist())} == set(expected)
    for i in range(len(found)):
        time, instant = expected[int(found.a[i]), int(found.b[i])]
        assert found.begin[i, 0] <= time <= found.begin[i, 1] and found.instant[i] == instant
    assert np.array_equal(motion.contacts(threads=1).begin, motion.contacts(threads=4).begin)
    assert len(motion.contacts(2, 4)) < len(found) and len(motion.contacts(first=True)) >= 1


def test_the_partition_stays_right():
    motion, place, speed = movers(60)
    kinetic = motion.kinetic()
    events = kinetic.advance(3)
    assert len(events) > 10 and 3 <= kinetic.time < 3.001 and kinetic.next > 3
    assert np.all(np.diff(events.ticks) >= 0) and np.all(events.early <= events.late)
    assert froe.motion.EVENTS[events.kinds[0]] and events.objects.shape == (len(events), 4)
    kinetic.audit()
    points = np.random.default_rng(2).random((200, 2)) * 1000
    now = place[:, 0] + kinetic.time * speed
    on, above, below = kinetic.locate(points).T  # upright segments are above or below almost no point
    assert np.all(on == -1) and len(above) == len(below) == 200
    hits = kinetic.ray(np.c_[now - 0.01, place[:, 1] + 20], np.c_[now + 0.01, place[:, 1] + 20])
    assert np.all(hits >= 0) and np.mean(hits == np.arange(60)) > 0.9
    snapshot = kinetic.snapshot()
    assert snapshot.tree.report.objects == 60
    kinetic.remove(0)
    assert kinetic.snapshot().tree.report.objects == 59


def test_objects_that_join():
    motion, _, _ = movers(10)
    kinetic = motion.kinetic()
    motion.add([0, 0], [[-50, 0], [-50, 9]], [0, 1, 2])
    kinetic.update()
    assert kinetic.snapshot().tree.report.objects == 11


def test_triangles_in_space():
    motion = froe.Motion(0, 10, dim=3)
    corners = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    motion.add([0, 10] * 3, np.stack([corners, corners + [0, 0, 10]], 1).reshape(-1, 3), [0, 2, 4, 6])
    motion.add([0] * 3, corners + [0, 0, 4], [0, 1, 2, 3])
    found = motion.contacts()
    assert found.begin[0, 0] <= 4 <= found.begin[0, 1] < 4.0001 and found.instant.tolist() == [True]


@pytest.mark.parametrize(
    "call, kind",
    [
        (lambda: froe.Motion(1, 1), (InputError, froe.errors.OptionError)),
        (lambda: froe.Motion(0, np.nan), (InputError, froe.errors.OptionError)),
        (lambda: froe.Motion(0, 1, dim=4), (InputError, froe.errors.OptionError)),
        (lambda: froe.Motion(0, 1).add([0, 0], [[0, 0]], [0, 1, 2]), ArrayError),
        (lambda: froe.Motion(0, 1).add([0, 0], [[0, 0], [1, 1]], [0, 5]), InputError),
        (lambda: froe.Motion(0, 1).add([0, 0], [[0, 0], [1, 1]], [0, 2]), ArrayError),
        (lambda: froe.Motion(0, 1).add([0, 0], [[0, 0], [1, np.nan]], [0, 1, 2]), InputError),
        (lambda: froe.Motion(0, 1).add([1, 0, 0], [[0, 0]] * 3, [0, 2, 3]), InputError),
        (
            lambda: froe.Motion(0, 1).add([0, 0], [[0, 0]] * 2, [0, 1, 2], vertices=[[0, 9]]),
            (InputError, ArgumentError),
        ),
        (lambda: froe.Motion(0, 1).contacts(5, 6), froe.errors.OptionError),
        (lambda: movers(3)[0].kinetic().advance(99), ArgumentError),
        (lambda: movers(3)[0].kinetic().advance(np.nan), ArgumentError),
        (lambda: movers(3)[0].kinetic().remove(9), ArgumentError),
        (lambda: movers(3)[0].kinetic().locate([[0, np.nan]]), ArgumentError),
        (lambda: froe._core.kinetic(5, 1, False, 1, False, None), ArrayError),
        (lambda: froe.read_motion("/nonexistent"), froe.errors.FileError),
    ],
)
def test_bad_motions(call, kind):
    with pytest.raises(kind):
        call()


def test_a_motion_in_use():
    motion, _, _ = movers(4000)
    caught = []

    def use(done):
        for call in (motion.contacts, motion.kinetic, lambda: len(motion)):
            try:
                call()
            except BusyError as error:
                caught.append(error)

    motion.kinetic(progress=use)
    motion.contacts(progress=use)
    assert caught


def test_questions_to_motions_in_space():
    motion = froe.Motion(0, 10, dim=3)
    corners = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    motion.add([0] * 3, corners, [0, 1, 2, 3])
    with pytest.raises(UnsupportedError):
        motion.kinetic().locate([[0, 0]])


TRIANGLE = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])


def falling(turns=None, height=8.0):
    """A triangle of a body that falls onto another one, which stands still at z = 2."""
    motion = froe.Motion(0, 4, dim=3)
    body = motion.add_body([0, 4], [[0, 0, height], [0, 0, 0]], turns=turns)
    motion.add([0] * 3, TRIANGLE, [0, 1, 2, 3], bodies=[body] * 3)
    motion.add([0] * 3, TRIANGLE + [0, 0, 2], [0, 1, 2, 3])
    return motion


def test_bodies():
    motion = falling()
    found = motion.contacts()
    assert len(motion) == 2 and found.begin.tolist() == [[3.0, 3.0]] and found.instant.tolist() == [True]
    assert motion.positions(1)[:3, 2].tolist() == [6, 6, 6] and motion.positions(1)[3:].tolist() == (
        TRIANGLE + [0, 0, 2]
    ).tolist()


def test_bodies_that_turn():
    """A quarter turn about x brings the corner (0, 1, 0) to (0, 0, 1): it comes down to z = 2 later than the others."""
    half = np.sqrt(0.5)
    motion = falling(turns=[[0, 0, 0, 1], [half, 0, 0, half]])
    assert np.allclose(motion.positions(4)[:3], [[0, 0, 0], [1, 0, 0], [0, 0, 1]], atol=1e-9)
    found = motion.contacts()
    assert found.begin[0, 0] <= 3 <= found.begin[0, 1] and not found.instant[0] and 3 < found.end[0, 0] < 4
    parabola = froe.Motion(0, 4, dim=3)
    body = parabola.add_body([0, 4], [[0, 0, 0], [0, 0, 0]], controls=[[0, 0, 8], [np.nan] * 3])
    parabola.add([0] * 3, TRIANGLE, [0, 1, 2, 3], bodies=[body] * 3)
    assert parabola.positions(2)[0].tolist() == [0, 0, 4]


def test_bodies_of_the_plane_turn_on_circles() -> None:
    half = math.sqrt(0.5)
    motion = froe.Motion(0, 4)
    hand = motion.add_body([0, 4], [[0, 0], [0, 0]], turns=[[0, 1], [half, half]])
    motion.add([0, 0], [[1, 0], [5, 0]], [0, 1, 2], bodies=[hand] * 2)
    motion.add([0, 0], [[3, 4], [9, 4]], [0, 1, 2])
    where = motion.positions(2)
    assert np.allclose(np.hypot(*where[:2].T), [1, 5], rtol=1e-15)
    contacts = motion.contacts()
    assert len(contacts) == 1 and contacts.instant[0]
    assert len(motion.kinetic().advance(4)) > 0


def test_cubics_are_followed_and_may_be_learned_of():
    """A cubic whose control points are those of a line or a parabola is that; another one passes where Bezier says."""
    nan = [np.nan, np.nan]
    motion = froe.Motion(0, 4)
    motion.add([0, 4, 0, 4, 0, 0], [[0, 0], [12, 0], [0, 5], [12, 5], [6, -9], [6, 9]], [0, 2, 4, 5, 6],
               controls=[[0, 9], nan, [4, 5], nan, nan, nan],
               second_controls=[[12, -9], nan, [8, 5], nan, nan, nan])  # fmt: skip
    u = np.linspace(0, 1, 9)
    places = np.array([motion.positions(4 * share) for share in u])
    assert np.allclose(places[:, 0, 0], 36 * (1 - u) * u**2 + 12 * u**3)
    assert np.allclose(places[:, 0, 1], 27 * (1 - u) ** 2 * u - 27 * (1 - u) * u**2)
    assert np.allclose(places[:, 1], np.stack([12 * u, 5 + 0 * u], axis=1))
    contacts = motion.contacts()
    assert len(contacts) == 1 and contacts.begin[0, 0] > 0 and contacts.end[0, 1] < 4
    kinetic = motion.kinetic()
    kinetic.advance(1)
    kinetic.replan(3, [1, 4], [[6, 9], [6, 9]], controls=[[9, 9], nan], second_controls=[[3, 9], nan])
    while kinetic.time < 3.9:
        kinetic.advance(min(kinetic.time + 0.5, 4))
        kinetic.audit()
    for wrong in ({"second_controls": [[1, 1], nan]}, {"controls": [[1, 1], nan], "second_controls": [[1, np.nan], nan]}):
        with pytest.raises(InputError):
            motion.add([0, 4], [[0, 0], [1, 1]], [0, 2], vertices=[[0, 0]], **wrong)


def test_replans_are_as_if_planned_before():
    """A partition that learns of a plan when it begins is one that knew it."""
    plans = [[0, 0], [0, 9], [20, 3], [20, 7]]
    known, told = froe.Motion(0, 10), froe.Motion(0, 10)
    known.add([0, 2, 10, 0, 2, 10, 0, 0], [plans[0], plans[0], [40, 0], plans[1], plans[1], [40, 9], *plans[2:]],
              [0, 3, 6, 7, 8])  # fmt: skip
    told.add([0] * 4, plans, [0, 1, 2, 3, 4])
    expected, kinetic = known.kinetic(), told.kinetic()
    expected.advance(2)
    kinetic.advance(2)
    now = kinetic.time
    for vertex in (0, 1):
        kinetic.replan(vertex, [2, 10], [plans[vertex], [40, plans[vertex][1]]])
    for time in (4, 6, 9.5):
        expected.advance(time)
        kinetic.advance(time)
        kinetic.audit()
        points = np.random.default_rng(3).random((100, 2)) * [40, 10]
        assert np.array_equal(expected.locate(points), kinetic.locate(points))
        assert np.array_equal(told.positions(time), known.positions(time))
    assert now >= 2
    for bad in (lambda: kinetic.replan(9, [2, 10], [[0, 0], [1, 1]]), lambda: kinetic.replan(0, [2], [[0, 0], [1, 1]]),
                lambda: kinetic.replan(0, [10, 2], [[0, 0], [1, 1]]), lambda: kinetic.replan(-1, [2], [[0, 0]]),
                lambda: kinetic.replan(0, [2, 10], [[0, np.nan], [1, 1]])):  # fmt: skip
        with pytest.raises((ArgumentError, ArrayError, InputError)):
            bad()
    kinetic.audit()


def test_the_order_of_painting():
    motion, place, speed = movers(40)
    kinetic = motion.kinetic()
    kinetic.advance(2)
    objects, ends = kinetic.order([500, -9000])
    assert set(objects.tolist()) == set(range(40)) and ends.shape == (len(objects), 4)
    drawn = np.zeros(40)
    for thing, (_, y, _, top) in zip(objects, ends):
        drawn[thing] += abs(top - y)
    assert np.allclose(drawn, 40)
    heights = ends[:, [1, 3]].max(axis=1)
    columns = {}
    for x, height in zip(np.round(ends[:, 0], 6), heights):  # of what is one above the other, the upper comes first
        assert height <= columns.get(x, np.inf)
        columns[x] = height


def test_events_in_space_name_edges():
    """A triangle that passes over another one, as seen from above."""
    motion = froe.Motion(0, 4, dim=3)
    moving = np.stack([TRIANGLE + [-3, 0.25, 5], TRIANGLE + [5, 0.25, 5]], axis=1).reshape(-1, 3)
    motion.add([0, 4] * 3, moving, [0, 2, 4, 6])
    motion.add([0] * 3, TRIANGLE * 2, [0, 1, 2, 3])
    kinetic = motion.kinetic()
    events = kinetic.advance(3.5)
    assert len(events) > 3 and events.edges.shape == (len(events), 4) and events.edge_counts.max() > 0
    named = events.edges[events.edges >= 0]
    assert set((named // 3).tolist()) <= {0, 1}
    plane = movers(30)[0].kinetic().advance(3)
    assert plane.edge_counts.max() == 0 and (plane.edges == -1).all()


def test_poses(tmp_path):
    model = froe.Scene(3)
    for name in ("a", "b"):
        model.add_triangles([TRIANGLE + [0, 0, 9 * (name == "b")]], group=model.add_group(name))
    path = tmp_path / "poses.csv"
    path.write_text("time,body,x,y,z,qx,qy,qz,qw\n0,a,0,0,0,0,0,0,1\n10,a,0,0,10,0,0,0,1\n")
    motion = froe.read_poses(path, model)
    begin, end = motion.contacts().begin[0]
    assert motion.window == (0, 10) and begin <= 9 <= end < 9 + 1e-12
    assert froe.read_poses(path, model, 2, 5).window == (2, 5)
    path.write_text("time,body,x,y,z\n0,c,0,0,0\n")
    with pytest.raises(InputError, match="c"):
        froe.read_poses(path, model, 0, 1)
    with pytest.raises(froe.errors.FileError):
        froe.read_poses("/nonexistent", model)
    with pytest.raises(ArrayError, match="no scene"):
        froe._core.read_poses(str(path), motion._core, 0.0, 1.0)
    with pytest.raises(UnsupportedError):
        froe.read_poses(path, froe.points([[0, 0, 0, 0]]), 0, 1)


@pytest.mark.parametrize("kind, dim", [("moving", 2), ("moving-boxes", 3)])
def test_made_up_motions(kind, dim):
    motion = froe.generate_motion(kind, 24, seed=2)
    assert motion.dim == dim and len(motion) > 0 and motion.window == (0, 60)
    assert np.array_equal(motion.positions(30), froe.generate_motion(kind, 24, seed=2).positions(30))
    assert not np.array_equal(motion.positions(30), motion.positions(31))


@pytest.mark.parametrize(
    "call, kind",
    [
        (lambda: froe.Motion(0, 1).add_body([0], [[0, 0, 0]]), ArrayError),
        (lambda: froe.Motion(0, 1).add_body([0], [[0, 0]], turns=[[0, 0, 0, 1]]), ArrayError),
        (lambda: froe.Motion(0, 1).add_body([0], [[0, 0]], turns=[[1, 1]]), InputError),
        (lambda: froe.Motion(0, 1, dim=3).add_body([0, 0], [[0, 0, 0]] * 2), InputError),
        (lambda: froe.Motion(0, 1, dim=3).add_body([0], [[0, 0, np.inf]]), InputError),
        (lambda: froe.Motion(0, 1, dim=3).add_body([0], [[0, 0, 0]], turns=[[1, 1, 1, 1]]), InputError),
        (lambda: froe.Motion(0, 1, dim=3).add_body([0], [[0, 0, 0]], turns=[[0, 0, 1]]), ArrayError),
        (lambda: froe.Motion(0, 1, dim=3).add_body([0, 1], [[0, 0, 0]]), ArrayError),
        (lambda: froe.Motion(0, 1, dim=3).add([0] * 3, TRIANGLE, [0, 1, 2, 3], bodies=[0] * 3), InputError),
        (lambda: froe.Motion(0, 1, dim=3).add([0] * 3, TRIANGLE, [0, 1, 2, 3], bodies=[0]), ArrayError),
        (lambda: froe.Motion(0, 1).positions("now"), TypeError),
        (lambda: movers(3)[0].kinetic().order([0, np.nan]), ArgumentError),
        (lambda: movers(3)[0].kinetic().order([0, 0, 0]), ArrayError),
        (lambda: froe.generate_motion("wild", 5), froe.errors.OptionError),
        (lambda: froe.generate_motion("moving", -5), ArgumentError),
        (lambda: froe.generate_motion("moving", 0), ArgumentError),
    ],
)
def test_bad_bodies_and_plans(call, kind):
    with pytest.raises(kind):
        call()


def test_threads_change_no_event():
    """Events and trees are the same for any number of threads."""
    found = []
    for threads in (1, 3, 0):
        motion = froe.generate_motion("moving", 3000, 4)
        kinetic = motion.kinetic(threads=threads)
        events = kinetic.advance(1.5)
        found.append((events.kinds.tolist(), events.objects.tolist(), events.ticks.tolist(), kinetic.time))
        kinetic.audit()
    assert len(found[0][0]) > 3000 and found[0] == found[1] == found[2]


def test_bodies_that_turn_are_followed_on_parabolas():
    """No vertex is farther from its body than is told, and triangles that meet are ghosts."""
    bodies = froe.generate_motion("moving-boxes", 24)
    with pytest.raises(UnsupportedError):
        bodies.kinetic()
    curved, off = bodies.without_bodies(1e-3)
    assert 0 < off <= 1e-3 and len(curved) == len(bodies)
    for time in np.linspace(0, 60, 200):
        far = np.linalg.norm(curved.positions(time) - bodies.positions(time), axis=1)
        assert far.max() <= off + 1e-12
    kinetic = curved.kinetic(ghosts=True)
    assert len(kinetic.advance(60)) > 1000
    kinetic.audit()
    with pytest.raises(InputError):
        curved.kinetic().advance(60)
    with pytest.raises(ArgumentError):
        bodies.without_bodies(0)
    assert len(froe.Motion(0, 1).without_bodies(1)[0]) == 0


def test_times_out_of_reach_are_named_with_those_in_reach():
    motion = froe.Motion(1577836800000, 1577836810000)
    kinetic = motion.kinetic()
    kinetic.advance(1577836805000)
    with pytest.raises(ArgumentError, match="Time 1577836804000 has passed: the partition has reached 157783680500"):
        kinetic.advance(1577836804000)
    with pytest.raises(ArgumentError, match="Time 1577836810001 is not in the window, which ends at 1577836810000"):
        kinetic.advance(1577836810001)
