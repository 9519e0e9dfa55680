"""References are balanced: many calls of each kind leave as many objects and as much memory as before."""

import gc
import sys

import numpy as np
import pytest

import froe

SEGMENTS = np.array([[0.0, 0, 2, 2], [0, 2, 2, 0], [5, 5, 6, 6]])
BOXES = np.array([[0.0, 0, 9, 9]])
POINT, WAY = np.array([[1.0, 0.5]]), np.array([[0.0, 1.0]])
IDS = np.array([0], np.uint32)
OPTIONS = {"title": "a", "eye": np.array([[0.0, -9, 0]])}


def refused(call, *arguments):
    try:
        call(*arguments)
    except (froe.Error, TypeError):
        return
    raise AssertionError("It was not refused.")


def moving():
    motion = froe.Motion(0, 4)
    motion.add([0, 4, 0, 4], [[0, 0], [4, 0], [0, 1], [4, 1]], [0, 2, 4])
    motion.add([0, 0], [[2, 0], [2, 1]], [0, 1, 2])
    return motion


def solid():
    motion = froe.Motion(0, 1, dim=3)
    body = motion.add_body([0, 1], [[0, 0, 0], [0, 0, 8]], turns=[[0, 0, 0, 1]] * 2)
    motion.add([0] * 3, np.eye(3), [0, 1, 2, 3], bodies=[body] * 3)


SCENE = froe.points([[0, 0]])
MOTION = moving()
KINETIC = MOTION.kinetic()
TREE = froe.segments(SEGMENTS).build("autopartition", purpose="pieces")
SPACE = froe.triangles([[[0, 0, 0], [4, 0, 0], [2, 0, 3]]]).build(purpose="draw")
CALLS = {
    "scene": lambda: froe._core.scene(2).counts(),
    "add": lambda: froe.segments(SEGMENTS),
    "add refused": lambda: refused(froe._core.scene(2).add, 1, SEGMENTS, IDS, BOXES, *[None] * 7),
    "groups of a scene": lambda: TREE.scene.group_count,
    "arrays": lambda: TREE.scene.arrays(),
    "bounds": lambda: TREE.scene.bounds,
    "crs": lambda: (setattr(SCENE, "crs", froe.Crs("other", "a")), SCENE.crs, SCENE.across),
    "defects": lambda: TREE.scene._core.defects(0, 1, 1, None),
    "density": lambda: TREE.scene._core.density(False, 0, 1, 1, None),
    "build": lambda: TREE.scene.build("kd", threads=1),
    "query": lambda: TREE.query(BOXES, threads=1),
    "query refused": lambda: refused(TREE.query, [[np.nan] * 4]),
    "query of another type": lambda: refused(TREE._core.boxes, IDS, 1, None),
    "query_one": lambda: TREE.query_one(BOXES[0]),
    "count": lambda: TREE.count(BOXES, threads=1),
    "any": lambda: TREE.any(BOXES, threads=1),
    "balls": lambda: TREE.query(balls=(POINT, 1.0), threads=1),
    "hulls": lambda: TREE.query(hulls=[SEGMENTS[:, :2]], threads=1),
    "locate": lambda: TREE.locate(POINT, threads=1),
    "groups met": lambda: TREE.query_groups(BOXES, threads=1),
    "groups that cover": lambda: TREE.query_groups(segments=SEGMENTS, relation="covers", threads=1),
    "groups of a tree": lambda: TREE.join_groups(TREE, threads=1),
    "groups of no tree": lambda: refused(TREE._core.group_join, 0, None, 1, None),
    "nearest": lambda: TREE.nearest(POINT, threads=1),
    "nearest points": lambda: TREE.nearest_points(IDS, POINT),
    "ray": lambda: TREE.ray(POINT, WAY, threads=1),
    "all of a ray": lambda: TREE.ray(POINT, WAY, all=True, threads=1),
    "above": lambda: TREE.above(POINT, threads=1),
    "pairs": lambda: TREE.pairs(threads=1),
    "report": lambda: TREE.report,
    "pieces": lambda: TREE.pieces(),
    "cells": lambda: TREE.cells([0, 0], [9, 9]),
    "order": lambda: TREE.order([9, 9]),
    "bytes": lambda: froe.tree._from_bytes(TREE._core.to_bytes()),
    "bytes refused": lambda: refused(froe._core.from_bytes, b"froe"),
    "open refused": lambda: refused(froe._core.open, "/nonexistent"),
    "render": lambda: SPACE._core.render(None, 0, OPTIONS, None),
    "render refused": lambda: refused(SPACE._core.render, None, 0, {"title": 5}, None),
    "render of an option too many": lambda: refused(SPACE._core.render, None, 0, {"tidle": 5}, None),
    "motion": lambda: moving(),
    "motion refused": lambda: refused(froe._core.motion, 2, 1.0, 1.0, 0.0),
    "bodies": lambda: solid(),
    "bodies refused": lambda: refused(MOTION.add_body, [0], [[0, 0, 0]]),
    "positions": lambda: MOTION.positions(2),
    "replan": lambda: KINETIC.replan(2, [0, 4], [[2, 0], [2, 0]]),
    "replan refused": lambda: refused(KINETIC.replan, 99, [0], [[2, 0]]),
    "order of a partition": lambda: KINETIC.order([9, 9]),
    "poses refused": lambda: refused(froe.read_poses, "/nonexistent", TREE.scene),
    "made-up motions": lambda: froe.generate_motion("moving", 3),
    "contacts": lambda: MOTION._core.contacts(0.0, 4.0, False, False, 1, None),
    "kinetic": lambda: MOTION.kinetic().advance(2),
    "snapshot": lambda: KINETIC.snapshot(),
    "points of a partition": lambda: KINETIC.locate(POINT),
    "generate": lambda: froe.generate("segments", 3),
    "closed": lambda: froe.segments(SEGMENTS).build(threads=1).close(),
}
WATCHED = (None, True, False, SEGMENTS, BOXES, POINT, WAY, IDS, OPTIONS, TREE._core, SPACE._core, froe._core.Array,
           froe._core.Tree, froe._core.Scene, froe._core.Motion, froe._core.Kinetic, MOTION._core)


@pytest.mark.parametrize("name", CALLS)
def test_references(name):
    """Of 2500 calls each: 10^5 in all."""
    call = CALLS[name]
    for _ in range(50):
        call()
    gc.collect()
    before = [sys.getrefcount(watched) for watched in WATCHED], len(gc.get_objects()), sys.getallocatedblocks()
    for _ in range(2500):
        call()
    gc.collect()
    after = [sys.getrefcount(watched) for watched in WATCHED], len(gc.get_objects()), sys.getallocatedblocks()
    assert max(abs(a - b) for a, b in zip(after[0], before[0])) < 100
    assert abs(after[1] - before[1]) < 100
    assert abs(after[2] - before[2]) < 500
