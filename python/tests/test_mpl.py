"""Pictures of matplotlib, by the colours of their pixels."""

import warnings

import matplotlib

matplotlib.use("agg")

import numpy as np  # noqa: E402
import pytest  # noqa: E402
from matplotlib import pyplot  # noqa: E402
from matplotlib.colors import to_rgb  # noqa: E402
from mpl_toolkits.mplot3d import proj3d  # noqa: E402

import froe  # noqa: E402
import froe.mpl  # noqa: E402

def turned(triangle, degrees):
    a = np.radians(degrees)
    return np.array(triangle) @ [[np.cos(a), np.sin(a), 0], [-np.sin(a), np.cos(a), 0], [0, 0, 1]]


# Three wedges that rise: each lies above the next in a circle, so that no order of whole triangles is right.
CIRCLE = np.array([turned([[-4, -1, 0], [4, -2.5, 2], [4, 0, 2]], angle) for angle in (0, 120, 240)])
CROSSING = np.array([[[0, 0, 0], [4, 0, 0], [2, 0, 3]], [[2, -2, 1], [2, 2, 1], [2, 0, 2]]], float)
COLOURS = ["red", "lime", "blue"]


def nearest(triangles, matrix, x, y):
    """The triangle seen at a point of the page, by the depths of all triangles there; -1: none."""
    found = [(np.inf, -1)]
    for number, triangle in enumerate(triangles):
        a, b, c = np.array(proj3d.proj_transform(*triangle.T, matrix)).T
        sides = np.array([[b[0] - a[0], c[0] - a[0]], [b[1] - a[1], c[1] - a[1]]])
        if abs(np.linalg.det(sides)) < 1e-9:
            continue
        u, v = np.linalg.solve(sides, [x - a[0], y - a[1]])
        if min(u, v, 1 - u - v) > 0:
            found.append((a[2] + u * (b[2] - a[2]) + v * (c[2] - a[2]), number))
    return min(found)[1]


def wrong_pixels(draw, triangles, view, projection):
    """How many pixels of triangles show another one than the nearest, apart from those beside an edge."""
    figure = pyplot.figure(figsize=(4, 4), dpi=100)
    axes = figure.add_subplot(projection="3d", proj_type=projection)
    axes.view_init(*view)
    draw(axes)
    axes.set_axis_off()
    figure.canvas.draw()
    image = np.asarray(figure.canvas.buffer_rgba())[:, :, :3] / 255
    wrong = seen = 0
    for row in range(50, 350, 12):
        for column in range(50, 350, 12):
            around = axes.transData.inverted().transform(
                [(column + 0.5 + dx, 400 - row - 0.5 + dy) for dx in range(-2, 3) for dy in range(-2, 3)]
            )
            numbers = {nearest(triangles, axes.M, *point) for point in around}
            if len(numbers) > 1 or -1 in numbers:
                continue
            (number,) = numbers
            seen += 1
            shown = np.abs(np.array([to_rgb(c) for c in [*COLOURS, "white"]]) - image[row, column]).max(axis=1).argmin()
            wrong += shown != number
    pyplot.close(figure)
    assert seen > 5
    return wrong


@pytest.mark.parametrize("triangles", [CIRCLE, CROSSING])
@pytest.mark.parametrize("view", [(30, -60), (70, 20), (-25, 130)])
@pytest.mark.parametrize("projection", ["persp", "ortho"])
def test_what_is_nearer_hides_what_is_farther(triangles, view, projection):
    tree = froe.triangles(triangles).build(purpose="draw")

    def draw(axes):
        froe.mpl.draw3d(axes, tree, color=COLOURS[: len(triangles)], shade=False)

    assert wrong_pixels(draw, triangles, view, projection) == 0


def test_matplotlib_alone_is_wrong():
    """Otherwise the test above would prove nothing."""
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    def draw(axes):
        axes.add_collection3d(Poly3DCollection(CROSSING, facecolors=COLOURS[:2]))
        axes.auto_scale_xyz(*CROSSING.reshape(-1, 3).T)

    assert wrong_pixels(draw, CROSSING, (30, -60), "persp") > 0


def test_cells_and_pieces_of_a_map():
    tree = froe.segments([[0, 0, 4, 4], [0, 4, 4, 0]]).build("autopartition")
    figure, axes = pyplot.subplots()
    cells, lines = froe.mpl.draw(axes, tree)
    assert len(cells.get_paths()) == len(tree.cells([0, 0], [4, 4])) > 1
    assert len(lines.get_segments()) == len(tree.pieces())
    assert axes.get_xlim() == (0, 4)
    pyplot.close(figure)


@pytest.mark.parametrize("ends", [[3, 4, 3, 4], [0, 1, 5, 1], [2, 0, 2, 9]])
def test_scenes_without_extent_are_drawn_without_a_warning(ends):
    figure, axes = pyplot.subplots()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        froe.mpl.draw(axes, froe.segments([ends]).build())
        figure.canvas.draw()
    low, high = np.transpose([axes.get_xlim(), axes.get_ylim()])
    assert (low < high).all() and (low <= ends[:2]).all() and (high >= ends[2:]).all()
    pyplot.close(figure)


def test_solids_of_the_plane_are_drawn_by_their_borders():
    scene = froe.Scene(2)
    scene.add_boxes([[0, 0, 4, 2]])
    scene.add_balls([[6, 6]], [2])
    figure, axes = pyplot.subplots()
    tree = scene.build("kd")
    _, lines = froe.mpl.draw(axes, tree)
    found = dict(zip(tree.pieces().objects.tolist(), lines.get_segments()))
    assert len(np.unique(found[0], axis=0)) == 4 and np.allclose(np.hypot(*(found[1] - 6).T), 2)
    assert axes.get_xlim() == (0, 8) and axes.get_ylim() == (0, 8)
    froe.mpl.draw(axes, froe.Scene(2).build())
    pyplot.close(figure)


def test_as_many_colours_as_triangles():
    axes = pyplot.figure().add_subplot(projection="3d")
    for colours in (COLOURS[:2], COLOURS + ["red"], []):
        with pytest.raises(ValueError, match=rf"^There are {len(colours)} colours for 3 triangles\.$"):
            froe.mpl.draw3d(axes, CIRCLE, color=colours)
    for colours in (COLOURS, COLOURS[:1], "red", []):
        froe.mpl.draw3d(axes, CIRCLE if len(colours) else np.empty((0, 3, 3)), color=colours)
    pyplot.close("all")
