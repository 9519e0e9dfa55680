"""Pictures, files of scenes, measures and comparisons."""

import math
import pickle
import re
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest

import froe
from froe.errors import ArgumentError, ArrayError, CancelledError, FileError, OptionError, UnsupportedError

MOST = np.finfo(float).max
FRONT, BEHIND = [[0, 0, 0], [4, 0, 0], [2, 0, 3]], [[1, 5, 0.5], [3, 5, 0.5], [2, 5, 1.5]]


@pytest.fixture
def space():
    return froe.triangles([FRONT, BEHIND]).build(purpose="draw")


def test_what_is_hidden_is_not_in_the_file(space):
    seen = [space.render(eye=(0, y, 0), parallel=True, lines=["border"]) for y in (-9, 9)]
    assert [picture.report.visible_faces for picture in seen] == [1, 2]
    assert [picture.report.hidden_faces for picture in seen] == [1, 0]
    for picture in seen:
        assert ElementTree.fromstring(picture.svg).tag.endswith("svg") and picture._repr_svg_() == picture.svg
    assert seen[0].svg == space.render(eye=(0, -9, 0), parallel=True, lines=["border"]).svg


def test_options_reach_the_picture(space):
    plain = space.render(size=(200, 100), title="A <title>", shading="plain", background="#a0b1c2")
    found = ElementTree.fromstring(plain.svg)
    assert found.get("viewBox").split()[2:] == ["200", "100"] and "A &lt;title" in plain.svg and "a0b1c2" in plain.svg
    assert space.render(shading="none").report.shapes == 0
    assert space.render(decimals=6).report.bytes > space.render(decimals=0).report.bytes
    assert space.render(lines=[]).report.lines == 0 < space.render(lines="border").report.lines


def test_saved_pictures(space, tmp_path):
    picture = space.render()
    heads = {"a.svg": b"<svg", "a.pdf": b"%PDF", "a.eps": b"%!PS", "a.csv": b"", "a.geojson": b"{"}
    for name, head in heads.items():
        picture.save(tmp_path / name)
        assert (tmp_path / name).read_bytes().lstrip(b"<?xml version='1.0' encoding='UTF-8'?>\n")[:1] or head == b""
        assert head in (tmp_path / name).read_bytes()[:200]
    assert (tmp_path / "a.svg").read_text() == picture.svg
    for name in ("a.png", "a.DXF"):  # what can be done from Python, and not the names of functions in C
        with pytest.raises(UnsupportedError, match=rf"{name}: Pictures are saved as .svg, .* froe makes .png"):
            picture.save(tmp_path / name)
    again = pickle.loads(pickle.dumps(picture))  # as processes that draw return it
    assert again.svg == picture.svg and again.report == picture.report
    again.save(tmp_path / "b.pdf")
    assert (tmp_path / "b.pdf").read_bytes() == (tmp_path / "a.pdf").read_bytes()


@pytest.mark.parametrize(
    "options, kind, word",
    [
        ({"shading": "glossy"}, OptionError, "glossy"),
        ({"lines": ["dotted"]}, OptionError, "dotted"),
        ({"background": "blue"}, OptionError, "blue"),
        ({"background": 0xFF0000FF}, OptionError, "0xFF0000FF is not like 0xRRGGBB"),
        ({"colour": 5}, OptionError, "colour"),
        ({"eye": (1, 2)}, ArrayError, "eye"),
        ({"eye": (0, 0, 0)}, ArgumentError, "no direction"),
        ({"eye": (np.nan, 0, 0)}, (ArgumentError, OptionError), ""),
        ({"size": (0, 100)}, OptionError, ""),
        ({"title": 5}, ArrayError, "title"),
        ({"decimals": 9}, OptionError, ""),
        ({"decimals": -1}, ArgumentError, "decimals"),
        ({"fov": "wide"}, TypeError, "real"),
    ],
)
def test_bad_options(space, options, kind, word):
    with pytest.raises(kind, match=word):
        space.render(**options)


def test_trees_that_cannot_be_rendered_or_drawn(space):
    with pytest.raises(UnsupportedError):
        froe.segments([[0, 0, 1, 1]]).build().render()
    with pytest.raises(UnsupportedError, match="dimension 3"):
        space.draw()
    many = froe.generate("triangles", 20000).build(purpose="draw")
    with pytest.raises(CancelledError):
        many.render(progress=lambda done: False)


def test_a_partition_as_a_picture(tmp_path):
    tree = froe.segments([[0, 0, 2, 2], [0, 2, 2, 0]]).build("autopartition", purpose="pieces")
    picture = tree.draw(width=300)
    assert ElementTree.fromstring(picture.svg).get("width") == "300.00"
    assert "3 pieces" in picture.svg and picture.report is None
    picture.save(tmp_path / "a.svg")
    assert (tmp_path / "a.svg").read_text() == picture.svg
    with pytest.raises(UnsupportedError, match="svg"):
        picture.save(tmp_path / "a.pdf")
    for scene in (froe.Scene(2), froe.points([[1, 1]])):
        assert scene.build("kd").draw().svg.startswith("<svg")


def drawn_lines(svg):
    """The corners of each piece in a picture, in pixels."""
    (path,) = re.findall(r'<path fill="none"[^>]* d="([^"]*)"', svg)
    return [[tuple(map(float, corner.split())) for corner in line.split("L")] for line in path.split("M")[1:]]


def test_solids_of_the_plane_are_drawn_by_their_borders():
    scene = froe.Scene(2)
    scene.add_boxes([[0, 0, 4, 2]])
    scene.add_balls([[6, 6]], [2])
    scene.add_hulls([[0, 8], [2, 8], [0.5, 7.5], [0, 6]], [0, 4])  # not in order, with a point inside
    tree = scene.build("kd")
    lines = dict(zip(tree.pieces().objects.tolist(), drawn_lines(tree.draw(width=800, lo=[0, 0], hi=[8, 8]).svg)))
    assert lines[0] == [(0, 800), (400, 800), (400, 600), (0, 600), (0, 800)]
    assert all(abs(math.hypot(x - 600, y - 200) - 200) < 0.02 for x, y in lines[1]) and len(lines[1]) > 32
    assert set(lines[2]) == {(0, 0), (200, 0), (0, 200)} and lines[2][0] == lines[2][-1] and len(lines[2]) == 4


@pytest.mark.parametrize("points", [[[3, 4]], [[3, 4]] * 5, [[3, 4], [3, 4], [5, 4]]])
def test_hulls_without_area_are_drawn(points):
    scene = froe.Scene(2)
    scene.add_hulls(points, [0, len(points)])
    (line,) = drawn_lines(scene.build("kd").draw(width=800, lo=[0, 0], hi=[8, 8]).svg)
    assert set(line) == {(100 * x, 800 - 100 * y) for x, y in points}


@pytest.mark.parametrize("ends", [
    [1e17, 1e17, 1e17, 1e17], [1e17, 1e17, 1e17 + 64, 1e17], [0, 0, 5e-324, 5e-324], [3, 3, 3, 3], [0, 7, 9, 7],
    [-1.7e308, -1.7e308, 1.7e308, 1.7e308], [1.7e308, 0, 1.7e308, 0], [-MOST, -MOST, MOST, MOST], [0, 0, MOST, MOST],
])  # fmt: skip
def test_pictures_of_scenes_of_every_size(ends):
    svg = froe.segments([ends]).build("kd").draw(width=500).svg
    root = ElementTree.fromstring(svg)
    assert root.get("width") == "500.00" and 0 < float(root.get("height")) < 600
    (line,) = drawn_lines(svg)
    assert all(0 <= x <= 500 and 0 <= y <= float(root.get("height")) for x, y in line)


@pytest.mark.parametrize("wrong", [{"width": -5}, {"width": 0}, {"width": math.nan}, {"width": math.inf},
                                   {"lo": [1, 1], "hi": [1, 1]}, {"lo": [5, 5], "hi": [1, 1]},
                                   {"lo": [0, math.nan]}, {"hi": [math.inf, 9]}])  # fmt: skip
def test_pictures_without_extent_are_refused(wrong):
    with pytest.raises((OptionError, ArgumentError), match="width|extent"):
        froe.segments([[0, 0, 2, 2]]).build().draw(**wrong)


def test_scenes_as_files(tmp_path):
    scene = froe.generate("segments", 50)
    scene.write(tmp_path / "a.csv")
    again = froe.read(tmp_path / "a.csv")
    assert np.array_equal(again.arrays().coords, scene.arrays().coords)
    assert again.read_report.precision == "float64" and again.read_report.features == 50
    assert len(froe.read(tmp_path / "a.csv", boxes=True)) == 50
    with pytest.raises(OptionError):
        froe.generate("nothing", 5)
    with pytest.raises(ArgumentError):
        froe.generate("segments", 0)


def test_pictures_that_cannot_be_saved(space, tmp_path):
    for picture in (space.render(), froe.segments([[0, 0, 1, 1]]).build().draw()):
        with pytest.raises(FileError, match="no-folder.*The file cannot be written: No such file"):
            picture.save(tmp_path / "no-folder" / "a.svg")
        with pytest.raises((OptionError, UnsupportedError), match="no-ending"):
            picture.save(tmp_path / "no-ending")


def test_the_scene_of_a_tree_tells_how_it_was_read(tmp_path):
    froe.segments([[0, 0, 1, 1]]).write(tmp_path / "a.geojson")
    scene = froe.read(tmp_path / "a.geojson")
    assert scene.build().scene.read_report == scene.read_report and scene.read_report.format == "GeoJSON"
    assert froe.segments([[0, 0, 1, 1]]).build().scene.read_report is None


def test_parts_of_trees_as_files(tmp_path):
    tree = froe.generate("segments", 20).build("kd")
    for what in ("fragments", "cells", "cuts"):
        tree.export(tmp_path / f"{what}.geojson", what)
        assert b"FeatureCollection" in (tmp_path / f"{what}.geojson").read_bytes()[:200]


def test_measures():
    scene = froe.boxes([[0, 0, 1, 1], [2, 0, 3, 1], [0.5, 0.5, 2.5, 0.75]])
    square = 2 / np.pi  # of a square: its area over that of its circle
    assert abs(froe.measure.fatness(scene).full.most - square) < 1e-9
    found = froe.measure.density(scene)
    assert 2 <= found.lower <= found.upper <= 3 and len(found.centre) == 2
    assert froe.measure.density(scene, diameter=True).upper <= 3
    assert 1 <= froe.measure.clutter(scene).lower <= 3
    assert froe.measure.directional(scene, 0.5).count == 3
    crossing = froe.segments([[0, 0, 2, 2], [0, 2, 2, 0], [1, 1, 1, 1], [0, 0, 2, 2]])
    assert froe.measure.defects(crossing) == froe.measure.Defects(1, 0, 1, 1, 0, 0)
    with pytest.raises(ArgumentError):
        froe.measure.directional(scene, -1)
    with pytest.raises(ArgumentError):
        froe.measure.density(scene, samples=-1)


def test_methods_side_by_side():
    found = froe.compare(froe.generate("segments", 200), ["autopartition", "kd", "index"], leaf=None)
    assert set(found) == {"autopartition", "kd", "index"} and found["autopartition"].pieces >= 200
    assert all(promise.holds for report in found.values() for promise in report.promises)
    assert froe.compare(froe.generate("triangles", 50), ["cylindrical", "kd"]).keys() >= {"kd"}


def test_everything_is_documented():
    """Every public function, class, method and property says what it is for."""
    for name in froe.__all__:
        thing = getattr(froe, name)
        if name == "__version__":
            continue
        assert thing.__doc__, name
        if isinstance(thing, type):
            for part, value in vars(thing).items():
                known = callable(value) or isinstance(value, (property, classmethod))
                assert not known or part.startswith("_") or value.__doc__, f"{name}.{part}"
