"""What ``Plotter.save_graphic`` of pyvista saves, as vectors. That one saves surfaces as pixels, or else sorts whole
polygons by one depth each, which is wrong where they pass through each other.

>>> import froe.compat.pyvista, numpy as np
>>> class PolyData:
...     points, faces = np.array([[0, 0, 0], [4, 0, 0], [2, 0, 3]], float), np.array([3, 0, 1, 2])
>>> class Camera:
...     position, focal_point, up, view_angle = (2, -9, 1), (2, 0, 1), (0, 0, 1), 30.0
...     parallel_projection, parallel_scale = False, 1.0
>>> class Plotter:
...     meshes, camera, window_size = [PolyData()], Camera(), (400, 300)
>>> froe.compat.pyvista.picture(Plotter()).report.visible_faces
1
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from froe.adapters.meshes import add_polygons

if TYPE_CHECKING:
    from froe.pictures import Picture
    from froe.scene import Scene


def picture(plotter: Any, **options: Any) -> Picture:
    """The meshes of a plotter as it shows them, with hidden surfaces removed exactly. Notebooks show the picture.

    :param plotter: any object with the attributes ``meshes``, ``camera`` and ``window_size``, as ``Plotter`` of pyvista
        has. The camera has ``position``, ``focal_point``, ``up``, ``view_angle``, ``parallel_projection`` and
        ``parallel_scale``
    :param options: as for ``Tree.render``; they go before what the plotter says
    :raises ValueError: a mesh has polygons of less than three corners
    :cost: that of a tree with the purpose ``draw``, and of ``Tree.render``

    >>> from types import SimpleNamespace as Some
    >>> import froe.compat.pyvista
    >>> mesh = Some(points=[[0, 0, 0], [4, 0, 0], [2, 0, 3]], faces=[3, 0, 1, 2])
    >>> camera = Some(position=(2, -9, 1), focal_point=(2, 0, 1), up=(0, 0, 1), view_angle=30.0,
    ...               parallel_projection=True, parallel_scale=2.0)
    >>> plotter = Some(meshes=[mesh], camera=camera, window_size=(400, 300))
    >>> froe.compat.pyvista.picture(plotter, lines=["border"]).report.lines > 0
    True
    """
    return _scene(plotter.meshes).build(purpose="draw").render(**{**_view(plotter), **options})


def save_graphic(
    plotter: Any, filename: str | os.PathLike[str], title: str = "PyVista Export", **options: Any
) -> None:
    """Takes the place of ``plotter.save_graphic(filename)``.

    :param plotter: as for ``picture``
    :param filename: it ends with ``.svg``, ``.pdf`` or ``.eps``
    :param title: of the file
    :param options: as for ``picture``
    :raises OptionError: the name ends otherwise
    :raises FileError: the file cannot be written
    :cost: that of ``picture``

    >>> from types import SimpleNamespace as Some
    >>> import froe.compat.pyvista, os, tempfile
    >>> mesh = Some(points=[[0, 0, 0], [4, 0, 0], [2, 0, 3]], faces=[3, 0, 1, 2])
    >>> camera = Some(position=(2, -9, 1), focal_point=(2, 0, 1), up=(0, 0, 1), view_angle=30.0,
    ...               parallel_projection=False, parallel_scale=1.0)
    >>> plotter = Some(meshes=[mesh], camera=camera, window_size=(400, 300))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     froe.compat.pyvista.save_graphic(plotter, os.path.join(folder, "a.pdf"))
    ...     os.listdir(folder)
    ['a.pdf']
    """
    picture(plotter, title=title, **options).save(filename)


def _scene(meshes: Any) -> Scene:
    """Each mesh is a group. What is no surface shows its surface."""
    from froe.scene import Scene

    scene, face = Scene(3), 0
    for mesh in meshes:
        surface = mesh if hasattr(mesh, "faces") else mesh.extract_surface()
        face = add_polygons(scene, surface, face, scene.add_group())
    return scene


def _view(plotter: Any) -> dict[str, Any]:
    """Camera and page as options of ``Tree.render``. The angle of view and the scale are those of the whole height."""
    camera, (width, height) = plotter.camera, plotter.window_size
    view = {
        "eye": camera.position,
        "target": camera.focal_point,
        "up": camera.up,
        "fit": False,
        "margin": 0.0,
        "size": (width, height),
        "parallel": bool(camera.parallel_projection),
    }
    if view["parallel"]:
        view["scale"] = height / (2 * camera.parallel_scale)
    else:
        view["fov"] = camera.view_angle
    colour = getattr(getattr(plotter, "background_color", None), "hex_rgb", None)
    return view if colour is None else {**view, "background": colour}
