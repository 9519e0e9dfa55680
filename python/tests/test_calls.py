"""Long calls: signals, threads, processes, and arrays that change meanwhile."""

import copy
import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import froe


def windows(count, side, seed=3):
    corners = np.random.default_rng(seed).random((count, 2))
    return np.hstack([corners, corners + side])


@pytest.fixture(scope="module")
def tree():
    return froe.segments(short_segments(100000)).build()


def short_segments(count, seed=1):
    random = np.random.default_rng(seed)
    middles = random.random((count, 2))
    return np.hstack([middles, middles + random.normal(size=(count, 2)) * 0.002])


@pytest.mark.parametrize(
    "call",
    [
        lambda tree, told: froe.segments(short_segments(300000)).build("autopartition", progress=told),
        lambda tree, told: tree.query(windows(10**6, 0.05), threads=1, progress=told),
        lambda tree, told: tree.count(windows(10**6, 0.05), threads=2, progress=told),
        lambda tree, told: tree.nearest(np.random.default_rng(1).random((10**6, 2)), k=20, progress=told),
        lambda tree, told: tree.query(balls=(windows(10**6, 0)[:, :2], 0.05), progress=told),
        lambda tree, told: tree.audit(progress=told),
    ],
    ids=["build", "query", "count", "nearest", "balls", "audit"],
)
def test_interrupted(tree, call):
    """A signal that comes once a share has been told ends the call itself, so that the last share is below 1. Python
    handles a signal in its own code alone, and what is told of the share runs none."""

    class Alarm(Exception):
        pass

    def ring(number, frame):
        raise Alarm

    def ring_once_told():
        while not shares:
            time.sleep(0.001)
        signal.pthread_kill(threading.main_thread().ident, signal.SIGALRM)

    before = signal.signal(signal.SIGALRM, ring)
    try:
        for _ in range(20):  # the signal may also come between two calls
            shares = []
            with pytest.raises(Alarm):
                threading.Thread(target=ring_once_told, daemon=True).start()
                while True:
                    call(tree, shares.append)
            if shares[-1] < 1:
                break
    finally:
        signal.signal(signal.SIGALRM, before)
    assert shares[-1] < 1
    assert len(tree.query([[0, 0, 1, 1]])[0]) > 90000


def test_control_c_ends_a_program():
    program = """
import signal, froe
signal.signal(signal.SIGINT, signal.default_int_handler)  # which shells ignore for what they start in the background
scene = froe.generate("segments", 300000)
print("begins", flush=True)
while True:
    scene.build("autopartition")
"""
    path = os.pathsep.join(path for path in sys.path if path)
    child = subprocess.Popen(
        [sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        env={**os.environ, "PYTHONPATH": path},
    )
    assert child.stdout.readline() == "begins\n"
    time.sleep(0.2)
    child.send_signal(signal.SIGINT)
    _, complaint = child.communicate(timeout=600)
    assert complaint.strip().endswith("KeyboardInterrupt")


def test_progress_grows_to_one():
    shares = []
    froe.segments(short_segments(200000)).build("autopartition", progress=shares.append, threads=1)
    assert shares == sorted(shares) and 0 <= shares[0] and shares[-1] == 1


def test_threads_ask_one_tree(tree):
    ranges, wrong = windows(2000, 0.02), []
    expected = [tree.query(ranges), tree.nearest(ranges[:, :2])[1], tree.count(ranges), tree.above(ranges[:, :2])]

    def ask():
        for _ in range(5):
            found = [tree.query(ranges, threads=1), tree.nearest(ranges[:, :2])[1], tree.count(ranges)]
            found.append(tree.above(ranges[:, :2]))
            same = found[0].ids.tolist() == expected[0].ids.tolist()
            if not same or any(not np.array_equal(a, b) for a, b in zip(found[1:], expected[1:])):
                wrong.append(found)
            tree.query_one(ranges[0])

    threads = [threading.Thread(target=ask) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


def test_other_threads_run_meanwhile(tree):
    seen, done = [0], threading.Event()

    def count():
        while not done.is_set():
            seen[0] += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    ranges, most = windows(200000, 0.05), 0
    for _ in range(50):  # a machine may be so busy that no other thread has its turn during one call
        begun = seen[0]
        tree.query(ranges, threads=1)
        most = max(most, seen[0] - begun)
        if most > 10:
            break
    done.set()
    thread.join()
    assert most > 10


def test_closed_while_asked():
    """A tree that is closed while a call uses it lasts until the call returns."""
    ranges = windows(200000, 0.03)
    tree = froe.segments(short_segments(50000)).build()
    expected, found, begun = tree.count(ranges).sum(), [], threading.Event()

    def ask():
        found.append(tree.count(ranges, threads=1, progress=lambda done: begun.set()).sum())

    thread = threading.Thread(target=ask)
    thread.start()
    begun.wait()
    tree.close()
    with pytest.raises(froe.errors.ClosedError):
        tree.query(ranges)
    thread.join()
    assert found == [expected]


def test_arrays_that_change_meanwhile():
    """A call answers what its arrays held when it began."""
    tree = froe.segments(short_segments(50000)).build()
    ranges = windows(300000, 0.05)
    expected = tree.count(ranges)
    changing, begun = ranges.copy(), []

    def spoil(done):  # is called while the call is at work, and so after it has its copy
        begun.append(done)
        changing[:] = np.nan

    assert np.array_equal(tree.count(changing, threads=1, progress=spoil), expected)
    assert begun and begun[0] < 1

    ranges, stop = ranges[:20000], threading.Event()
    changing = ranges.copy()

    def change():
        while not stop.is_set():
            changing[:] = np.nan
            changing[:] = ranges[:, [2, 3, 0, 1]]
            changing[:] = ranges

    thread = threading.Thread(target=change)
    thread.start()
    for _ in range(20):  # torn arrays may be refused, and nothing else may happen
        try:
            froe.boxes(changing).build().query(changing)
        except froe.errors.InputError:
            pass
    stop.set()
    thread.join()


def read_only(array):
    view = array.view()
    view.flags.writeable = False
    return view


def test_what_views_show_that_are_read_only_changes_meanwhile():
    """A view that nothing can be written through may show what others write to."""
    tree = froe.segments(short_segments(50000)).build()
    ranges = windows(300000, 0.05)
    expected, changing, begun = tree.count(ranges), ranges.copy(), []

    def spoil(done):
        begun.append(done)
        changing[:] = np.nan

    assert np.array_equal(tree.count(read_only(changing), threads=1, progress=spoil), expected)
    assert begun and begun[0] < 1

    random = np.random.default_rng(3)
    corners, numbers = random.random((200000, 3)), random.integers(0, 200000, (200000, 3)).astype(np.uint32)
    expected, changing, begun = froe.triangles(corners, numbers).arrays().corners, numbers.copy(), []

    def spoil_numbers(done):
        begun.append(done)
        changing[:] = 2**32 - 2

    scene = froe.Scene(3)
    scene.add_triangles(corners, read_only(changing), progress=spoil_numbers)
    assert np.array_equal(scene.arrays().corners, expected)
    assert begun and begun[0] < 1


def test_an_array_that_is_read_only_is_not_copied():
    ranges = windows(1000, 0.02)
    ranges.flags.writeable = False
    tree = froe.segments(short_segments(1000)).build()
    assert np.array_equal(tree.count(ranges), tree.count(ranges.copy()))


def ask_in_child(tree, ranges, queue):
    queue.put(int(tree.count(ranges).sum()))


@pytest.mark.parametrize("how", ["fork", "spawn"])
def test_processes(tree, how):
    """A fork between two calls, on several threads each, and a process that gets a pickle."""
    ranges = windows(5000, 0.02)
    expected = int(tree.count(ranges, threads=4).sum())
    context = multiprocessing.get_context(how)
    queue = context.Queue()
    children = [context.Process(target=ask_in_child, args=(tree, ranges, queue)) for _ in range(2)]
    for child in children:
        child.start()
    assert [queue.get(timeout=600) for _ in children] == [expected] * 2
    for child in children:
        child.join()
        assert child.exitcode == 0


@pytest.mark.parametrize("how", ["fork", "spawn", "forkserver"])
def test_processes_while_another_thread_asks(tree, how):
    ranges, stop = windows(3000, 0.02), threading.Event()
    expected = int(tree.count(ranges).sum())

    def ask():
        while not stop.is_set():
            tree.count(ranges, threads=4)

    thread = threading.Thread(target=ask)
    thread.start()
    try:
        context = multiprocessing.get_context(how)
        queue = context.Queue()
        children = [context.Process(target=ask_in_child, args=(tree, ranges, queue)) for _ in range(4)]
        for child in children:
            child.start()
        assert [queue.get(timeout=600) for _ in children] == [expected] * 4
        for child in children:
            child.join()
            assert child.exitcode == 0
    finally:
        stop.set()
        thread.join()


def test_fork_while_a_scene_is_in_use():
    """The child finds it in use, for good: the thread that would end the call is not there."""
    scene, statuses = froe.segments(short_segments(50000)), []

    def fork_once(done):
        if not statuses:
            child = os.fork()
            if child == 0:
                try:
                    scene.build()
                except froe.errors.BusyError:
                    os._exit(7)
                os._exit(1)
            statuses.append(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))

    assert len(scene.build("autopartition", progress=fork_once).scene) == 50000
    assert statuses == [7]


def squares(count):
    """Of a chequered map, each a group."""
    scene = froe.Scene(2)
    for i in range(count):
        for j in range(count):
            ring = np.array([[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1], [i, j]], float)
            group = scene.add_group(f"{i}, {j}")
            scene.add_segments(np.hstack([ring[:-1], ring[1:]]), group=group, faces=[group] * 4)
    return scene.build()


def test_threads_ask_for_groups_at_once():
    """What is prepared at the first question about groups is prepared by all of them at a time."""
    places = np.random.default_rng(5).random((200, 2)) * 12
    boxes = np.hstack([places, places + 1.5])

    def all_of(tree):
        answers = [tree.groups(places, threads=2)]
        for relation in ("meets", "within", "covers"):
            answers.append(tree.query_groups(boxes, relation=relation))
            answers.append(tree.join_groups(tree, relation=relation, threads=2))
        return [answer.pairs().tolist() for answer in answers]

    expected, tree, found = all_of(squares(12)), squares(12), []
    barrier = threading.Barrier(8)

    def ask():
        barrier.wait()
        found.append(all_of(tree))

    threads = [threading.Thread(target=ask) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [expected] * 8 and len(expected[0][0]) >= 200


def test_fork_while_another_thread_asks(tree):
    ranges, stop = windows(20000, 0.03), threading.Event()

    def ask():
        while not stop.is_set():
            tree.count(ranges, threads=2)

    thread = threading.Thread(target=ask)
    thread.start()
    try:
        for _ in range(5):
            child = os.fork()
            if child == 0:
                os._exit(0 if tree.count(ranges[:100], threads=2).sum() > 0 else 1)
            assert os.waitpid(child, 0)[1] == 0
    finally:
        stop.set()
        thread.join()


def test_pickles(tmp_path):
    tree = froe.segments(short_segments(1000)).build()
    ranges = windows(100, 0.05)
    again = pickle.loads(pickle.dumps(tree))
    assert np.array_equal(again.query(ranges).ids, tree.query(ranges).ids)
    tree.save(tmp_path / "a.froe")
    opened = froe.open(tmp_path / "a.froe")
    assert len(pickle.dumps(opened)) < 500 < len(pickle.dumps(tree))
    assert np.array_equal(pickle.loads(pickle.dumps(opened)).query(ranges).ids, tree.query(ranges).ids)


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy, pickle.dumps])
def test_what_has_no_copy_says_so(copied):
    said = r"^A Scene cannot be copied or pickled; trees can, and files keep it: write\(\)\.$"
    with pytest.raises(TypeError, match=said):
        copied(froe.segments(short_segments(10)))
    with pytest.raises(TypeError, match=r"^A Motion cannot be copied or pickled; files keep it: write\(\)\.$"):
        copied(froe.Motion(0, 1))


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy])
def test_a_copy_is_of_the_tree_and_not_of_what_its_file_has_become(tmp_path, copied):
    froe.segments(short_segments(1000)).build().save(tmp_path / "a.froe")
    ranges, opened = windows(100, 0.05), froe.open(tmp_path / "a.froe")
    froe.points([[9, 9]]).build().save(tmp_path / "a.froe")
    again = copied(opened)
    expected = opened.query(ranges).ids.tolist()
    opened.close()
    assert again.query(ranges).ids.tolist() == expected and len(expected) > 1


def test_answers_outlive_the_tree(tree):
    asked = froe.segments(short_segments(1000)).build()
    answers, pieces, rays = asked.query([[0, 0, 1, 1]]), asked.pieces(), asked.ray([[0, 0]], [[1, 1]])
    expected = answers.ids.tolist(), pieces.coords.tolist(), rays[1].tolist()
    asked.close()
    del asked
    assert (answers.ids.tolist(), pieces.coords.tolist(), rays[1].tolist()) == expected
