"""freestyle.py: Blender's Freestyle and its exporter of SVG, on a mesh that is seen along -z.

    blender -b --factory-startup --python-exit-code 1 -P freestyle.py -- MESH.off DRAWING.svg

Borders, silhouettes, and creases of more than 30 degrees, where they are visible, on a page of 1000 x 1000. The picture
itself is rendered by one sample of Cycles, which needs no graphics card. Prints the seconds of the picture, of which
nearly all are Freestyle's.
"""
import math
import os
import resource
import sys

import addon_utils
import bpy

mesh_path, svg_path = sys.argv[sys.argv.index("--") + 1:]
addon_utils.enable("render_freestyle_svg")
bpy.ops.wm.read_factory_settings(use_empty=True)
addon_utils.enable("render_freestyle_svg")
scene = bpy.context.scene

words = open(mesh_path).read().split()
count, faces = int(words[1]), int(words[2])
SCALE = 1 / 64  # Freestyle loses lines of scenes that are a thousand units wide, as the page is
points = [tuple(float(w) * SCALE for w in words[4 + 3 * i:7 + 3 * i]) for i in range(count)]
first = 4 + 3 * count
triangles = [tuple(map(int, words[first + 4 * i + 1:first + 4 * i + 4])) for i in range(faces)]
mesh = bpy.data.meshes.new("mesh")
mesh.from_pydata(points, [], triangles)
scene.collection.objects.link(bpy.data.objects.new("mesh", mesh))
deep = max(abs(p[2]) for p in points)

camera = bpy.data.cameras.new("camera")
camera.type, camera.ortho_scale = "ORTHO", 1000 * SCALE
camera.clip_start, camera.clip_end = 0.1, 4 * deep + 10
scene.camera = bpy.data.objects.new("camera", camera)
scene.camera.location = (0, 0, 2 * deep + 5)
scene.collection.objects.link(scene.camera)

scene.render.engine, scene.cycles.samples, scene.cycles.max_bounces = "CYCLES", 1, 0
scene.cycles.use_denoising = False
scene.render.resolution_x = scene.render.resolution_y = 1000
scene.render.resolution_percentage = 100
scene.render.threads_mode, scene.render.threads = "FIXED", 1
scene.render.use_freestyle = True
scene.render.line_thickness_mode = "ABSOLUTE"
layer = bpy.context.view_layer
layer.use_freestyle = True
settings = layer.freestyle_settings
settings.crease_angle = math.radians(150)
lines = settings.linesets[0] if settings.linesets else settings.linesets.new("lines")
if lines.linestyle is None:
    lines.linestyle = bpy.data.linestyles.new("style")
lines.select_silhouette = lines.select_border = lines.select_crease = True
lines.linestyle.thickness = 1
scene.svg_export.use_svg_export = True
folder = os.path.dirname(os.path.abspath(svg_path))
scene.render.filepath = os.path.join(folder, "freestyle")
before = resource.getrusage(resource.RUSAGE_SELF)
bpy.ops.render.render(write_still=False)
after = resource.getrusage(resource.RUSAGE_SELF)
os.replace(os.path.join(folder, "freestyle0001.svg"), svg_path)
print("seconds %.4f" % (after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime))
