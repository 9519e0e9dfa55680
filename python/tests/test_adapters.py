"""Scenes from the objects of other libraries."""

import json
import random as randoms
import re
from types import SimpleNamespace

import geometries
import geopandas
import numpy as np
import pytest
from shapely.geometry import GeometryCollection, LineString, Point, Polygon, box, mapping

import froe
import froe.compat.pyvista
from froe.adapters.features import of_mappings
from froe.adapters.shapely import features
from froe.compat.shapely import STRtree

DATA = __import__("pathlib").Path(__file__).resolve().parents[2] / "data"


def same(one, other):
    return all(np.array_equal(getattr(one, name), getattr(other, name)) for name in one.__dataclass_fields__)


@pytest.mark.parametrize("seed", range(10))
def test_groups_of_points_are_the_geometries_that_shapely_finds(seed):
    random = randoms.Random(seed)
    kept = geometries.some(random, 20, [*geometries.ALL, geometries.missing])
    tree = froe.from_shapely(kept).build()
    points = [[x / 2, y / 2] for x in range(18) for y in range(18)]
    expected = [[i, j] for i, p in enumerate(points) for j, g in enumerate(kept) if g and g.intersects(Point(p))]
    assert tree.groups(points).pairs().T.tolist() == expected


def test_a_collection_is_all_of_its_parts():
    inner = GeometryCollection([Point(5, 5), box(0, 0, 1, 1)])
    found = features([GeometryCollection([inner, Point(7, 7)])])
    assert found.points.tolist() == [[5, 5], [7, 7]] and len(found.segments) == 4


def test_mappings_and_geometries_are_the_same():
    kept = geometries.some(randoms.Random(1), 30)
    assert same(features(kept), of_mappings([mapping(one) for one in kept]))


def test_a_geometry_that_is_none_is_named():
    with pytest.raises(ValueError, match="Object 1 .*Circle"):
        of_mappings([Point(0, 0), {"type": "Circle"}])


def test_geojson_files_and_collections(tmp_path):
    collection = {
        "type": "FeatureCollection",
        "features": [
            {"type": "Feature", "properties": {"name": "A"}, "geometry": mapping(box(0, 0, 1, 1))},
            {"type": "Feature", "properties": None, "geometry": None},
            {"type": "Feature", "properties": {"name": "C"}, "geometry": mapping(box(5, 5, 6, 6))},
        ],
    }
    path = tmp_path / "a.geojson"
    path.write_text(json.dumps(collection))
    for source in (collection, path, str(path)):
        tree = froe.from_geojson(source, names="name").build()
        assert tree.groups([[0.5, 0.5], [5.5, 5.5]]).ids.tolist() == [0, 2]
    path.write_text(json.dumps(collection), encoding="utf-8-sig")  # as Windows writes files
    assert len(froe.from_geojson(path)) == 8
    point = {"type": "Point", "coordinates": [1, 2]}
    for wrong in ({"features": []}, [point], 5, {"type": "FeatureCollection", "features": None},
                  {"type": "FeatureCollection", "features": [None]},
                  {"type": "Feature", "properties": ["A"], "geometry": point}):  # fmt: skip
        with pytest.raises(ValueError, match=r"^This is not GeoJSON: .* is missing or of another type\.$") as caught:
            froe.from_geojson(wrong, names="name")
        assert "subscriptable" not in str(caught.value) and "iterable" not in str(caught.value)


def test_heights_that_only_some_places_have_are_left_out():
    line = {"type": "LineString", "coordinates": [[0, 0], [1, 1, 1], [2, 0, 3, 4]]}
    assert froe.from_geojson(line).bounds.tolist() == [[0, 0], [2, 1]]
    with pytest.raises(ValueError, match="Object 0 is not a geometry"):
        froe.from_geojson({"type": "LineString", "coordinates": [[0, 0], [1], [2, 2]]})


def test_whole_numbers_that_are_no_doubles_are_no_places():
    """As arrays with them are refused: 2^53 + 1 would become its neighbour."""
    for number in (2**53 + 1, -(2**53) - 1, 2**60 + 1, 2**63 - 1):
        for place in ([number, 0], [0.5, number], [0, number, 7], [0, np.int64(number)]):
            with pytest.raises(ValueError, match=f"Object 0 .*{number}, which float64 cannot hold"):
                froe.from_geojson({"type": "LineString", "coordinates": [[1, 1], place]})
    for number in (2**53, 2**60, float(2**53) + 2):
        point = {"type": "Point", "coordinates": [number, 0.5, 2**53 + 1]}
        assert froe.from_geojson(point).bounds[0, 0] == number


def test_tables_of_geopandas():
    table = geopandas.GeoDataFrame({"name": ["A", "B"]}, geometry=[box(0, 0, 1, 1), box(1, 0, 2, 1)], index=[7, 9])
    for one in (table, table.geometry):
        assert froe.from_geopandas(one).build().groups([[1, 0.5]]).ids.tolist() == [0, 1]


def test_a_column_of_geometries_is_many():
    column = geopandas.GeoSeries([Point(0, 0), None, LineString([(1, 0), (1, 4)])])
    scene = froe.from_shapely(column)
    assert len(scene) == len(froe.from_shapely(list(column))) and scene.group_count == 3
    index = STRtree(column)
    assert index.query(column, predicate="intersects").tolist() == [[0, 2], [0, 2]]
    assert index.nearest(column.dropna()).tolist() == [0, 2]


def test_cells_as_polygons_cover_the_window():
    tree = froe.segments([[0, 0, 4, 4], [0, 4, 4, 0], [1, 3, 3, 3]]).build("autopartition")
    cells = froe.to_shapely(tree.cells([0, 0], [4, 4]))
    assert sum(cell.area for cell in cells) == pytest.approx(16)
    with pytest.raises(ValueError, match="plane"):
        froe.to_shapely(froe.triangles([[[0, 0, 0], [1, 0, 0], [0, 1, 0]]]).build().cells([0, 0, 0], [1, 1, 1]))


class PolyData:
    points = np.array([[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [0, 0, 5]], float)
    faces = np.array([4, 0, 1, 2, 3, 3, 0, 1, 4])


def test_polygons_of_pyvista_become_fans():
    tree = froe.from_pyvista(PolyData()).build()
    assert tree.report.objects == 3
    assert tree.ray([[1.5, 0.5, 9], [0.5, 1.5, 9]], [[0, 0, -1]] * 2)[0].tolist() == [0, 1]

    class Broken(PolyData):
        faces = np.array([4, 0, 1, 2])

    with pytest.raises(ValueError, match="Polygon 0"):
        froe.from_pyvista(Broken())


def test_meshes_need_triangles():
    class Quads:
        vertices, faces = PolyData.points, np.array([[0, 1, 2, 3]])

    with pytest.raises(ValueError, match=r"\(1, 4\)"):
        froe.from_trimesh(Quads())


def plotter(**about):
    """Two triangles, of which the left one is behind the right one, as pyvista describes what it shows."""
    meshes = [
        SimpleNamespace(points=[[-3, 5, -1], [1, 5, -1], [-1, 5, 1]], faces=[3, 0, 1, 2]),
        SimpleNamespace(extract_surface=lambda: SimpleNamespace(points=np.eye(3) * 2, faces=[3, 0, 1, 2])),
    ]
    camera = {"position": (0, -10, 0), "focal_point": (0, 0, 0), "up": (0, 0, 1), "view_angle": 30.0,
              "parallel_projection": False, "parallel_scale": 4.0}  # fmt: skip
    color = SimpleNamespace(hex_rgb="#102030")
    return SimpleNamespace(
        meshes=meshes, camera=SimpleNamespace(**{**camera, **about}), window_size=[400, 200], background_color=color
    )


def starts(picture):
    """Where the outlines begin, on the page: at their upper corners. The file has hundredths."""
    return {(round(float(x) / 100, 1), round(float(y) / 100, 1)) for x, y in re.findall(r"m(\d+) (\d+)", picture.svg)}


def test_pictures_of_a_plotter_have_its_camera(tmp_path):
    picture = froe.compat.pyvista.picture(plotter(), lines=[])
    assert picture.report.visible_faces == 2 and "#102030" in picture.svg and 'viewBox="0 0 400 200"' in picture.svg
    # 30 degrees over 200 pixels; the upper corner of the left triangle is 15 away, 1 to the left, and 1 up
    off = 1 / 15 * 100 / np.tan(np.pi / 12)
    assert (round(200 - off, 1), round(100 - off, 1)) in starts(picture)
    flat = froe.compat.pyvista.picture(plotter(parallel_projection=True), lines=[])
    assert (175, 75) in starts(flat)  # 200 pixels show 2 times 4
    close = froe.compat.pyvista.picture(plotter(parallel_projection=True, parallel_scale=2.0), lines=[], title="Close")
    assert (150, 50) in starts(close) and "Close" in close.svg
    for name, head in {"a.svg": b"<svg", "a.pdf": b"%PDF", "a.eps": b"%!PS"}.items():
        froe.compat.pyvista.save_graphic(plotter(), tmp_path / name, title="Two")
        assert head in (tmp_path / name).read_bytes()[:200]
    with pytest.raises(froe.errors.OptionError, match="tex"):
        froe.compat.pyvista.save_graphic(plotter(), tmp_path / "a.tex")


def test_tables_bring_their_coordinate_system(tmp_path):
    places = [Point(2.35, 48.86), box(0, 0, 1, 1)]
    scene = froe.from_geopandas(geopandas.GeoDataFrame(geometry=places, crs="EPSG:4326"))
    assert (scene.crs.kind, scene.crs.code, scene.crs.unit) == ("geographic", "EPSG:4326", "degree")
    scene = froe.from_geopandas(geopandas.GeoSeries(places, crs="EPSG:32632"))
    assert (scene.crs.kind, scene.crs.code, scene.crs.unit) == ("projected", "EPSG:32632", "metre")
    assert scene.crs.wkt.startswith("PROJCRS") and "UTM zone 32N" in scene.crs.name
    tree = scene.build()
    assert tree.scene.crs == scene.crs == froe.tree._from_bytes(tree._core.to_bytes()).scene.crs  # files keep it
    tree.scene.write(tmp_path / "a.geojson")
    assert "EPSG" in (tmp_path / "a.geojson").read_text()
    with pytest.raises(froe.errors.FrozenError, match=r"^The scene takes no coordinate system: scene is frozen\.$"):
        scene.crs = None
    assert froe.from_geopandas(geopandas.GeoSeries(places)).crs is None


def test_borders_across_the_antimeridian_are_counted(tmp_path):
    island = Polygon([(179, -17), (-179, -17), (-179, -16), (179, -16)])
    here = box(0, 0, 1, 1)
    assert froe.from_geopandas(geopandas.GeoSeries([island, here], crs="EPSG:4326")).across == 1
    assert froe.from_geopandas(geopandas.GeoSeries([island, here], crs="EPSG:32632")).across == 0
    assert froe.from_geopandas(geopandas.GeoSeries([island, here])).across == 0
    path = tmp_path / "a.geojson"
    for member, expected in (({}, 1), ({"crs": None}, 0)):
        path.write_text(json.dumps({"type": "Feature", "properties": {}, "geometry": mapping(island), **member}))
        assert froe.from_geojson(path).across == expected
    assert froe.from_geojson(mapping(island)).crs is None
    wrapped = froe.from_geopandas(geopandas.GeoSeries([here], crs="EPSG:4326"))
    assert wrapped.across == 0


def test_coordinate_systems_that_are_none():
    scene = froe.points([[0, 0]])
    wrong = {"round": froe.Crs("round"), "wkt": froe.Crs("other", wkt=5), "name": froe.Crs("other", "a\0b")}
    for word, kind in wrong.items():
        with pytest.raises((froe.errors.OptionError, froe.errors.ArrayError, froe.errors.ArgumentError), match=word):
            scene.crs = kind
    assert scene.crs is None
    scene.crs = froe.Crs("other", "of a game", unit="inch")
    assert scene.crs.name == "of a game"
    scene.crs = None
    assert scene.crs is None
