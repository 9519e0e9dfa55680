"""Motions, their contacts, and partitions of them, beside what simple formulas say."""

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
        (lambda: froe._core.kinetic(5, 1, False, None), ArrayError),
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
