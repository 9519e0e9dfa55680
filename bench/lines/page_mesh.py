#!/usr/bin/env python3
"""page_mesh.py MODEL[:y] OUT.off: a model as every program of the part `lines` is given it.

The model (OFF, OBJ or binary glTF; :y when y points up) is turned so that parallel rays of view run along -z, y points
up on a page of 1000 x 1000, and all of it fits. The page is centred at the origin. Coordinates are rounded to 65,537
steps and then turned by whole numbers, so that what lies in one plane stays there, and single precision holds them: all
programs get the same numbers. Vertices of one place are one where they belong to one object: a node of a glTF, or all
of another file.
"""
import json
import math
import struct
import sys


def read_off(path):
    words = open(path).read().split()
    count, faces = int(words[1]), int(words[2])
    at = 4 + 3 * count
    points = [tuple(map(float, words[4 + 3 * i:7 + 3 * i])) for i in range(count)]
    polygons = []
    for _ in range(faces):
        n = int(words[at])
        polygons.append([int(w) for w in words[at + 1:at + 1 + n]])
        at += n + 1
    return points, polygons, [0] * count


def read_obj(path):
    points, polygons = [], []
    for line in open(path):
        words = line.split()
        if words[:1] == ["v"]:
            points.append(tuple(map(float, words[1:4])))
        if words[:1] == ["f"]:
            polygons.append([int(w.split("/")[0]) - 1 for w in words[1:]])
    return points, polygons, [0] * len(points)


def matrix_of(node):
    if "matrix" in node:
        m = node["matrix"]
        return [[m[4 * c + r] for c in range(4)] for r in range(4)]
    x, y, z, w = node.get("rotation", (0, 0, 0, 1))
    s, t = node.get("scale", (1, 1, 1)), node.get("translation", (0, 0, 0))
    turn = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    return [[turn[r][c] * s[c] for c in range(3)] + [t[r]] for r in range(3)] + [[0, 0, 0, 1]]


def read_glb(path):
    data = open(path, "rb").read()
    length = struct.unpack_from("<I", data, 12)[0]
    scene, binary = json.loads(data[20:20 + length]), 28 + length

    def values(number):
        accessor = scene["accessors"][number]
        view = scene["bufferViews"][accessor["bufferView"]]
        n = {"SCALAR": 1, "VEC3": 3}[accessor["type"]]
        form = {5126: "f", 5125: "I", 5123: "H", 5121: "B"}[accessor["componentType"]]
        start = binary + view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        step = view.get("byteStride", n * struct.calcsize(form))
        rows = [struct.unpack_from("<%d%s" % (n, form), data, start + i * step) for i in range(accessor["count"])]
        return rows if n > 1 else [row[0] for row in rows]

    points, polygons, objects = [], [], []
    stack = [(n, [[float(r == c) for c in range(4)] for r in range(4)])
             for n in scene["scenes"][scene.get("scene", 0)]["nodes"]]
    while stack:
        number, above = stack.pop()
        node = scene["nodes"][number]
        own = matrix_of(node)
        at = [[sum(above[r][k] * own[k][c] for k in range(4)) for c in range(4)] for r in range(4)]
        stack += [(child, at) for child in node.get("children", ())]
        for part in scene["meshes"][node["mesh"]]["primitives"] if "mesh" in node else ():
            if part.get("mode", 4) != 4:
                continue
            first, corners = len(points), values(part["attributes"]["POSITION"])
            points += [tuple(sum(at[r][k] * p[k] for k in range(3)) + at[r][3] for r in range(3)) for p in corners]
            indices = values(part["indices"]) if "indices" in part else range(len(corners))
            objects += [number] * len(corners)
            polygons += [[first + i for i in indices[k:k + 3]] for k in range(0, len(indices), 3)]
    return points, polygons, objects


# To the right, upwards and towards the eye, each 65 long: turned by 3-4-5 about the vertical, tilted by 5-12-13.
AXES = (52, 39, 0), (-15, 20, 60), (36, -48, 25)


def cross(a, b):
    return [a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3] for i in range(3)]


def main():
    name, out = sys.argv[1:]
    path, y_up = name.removesuffix(":y"), name.endswith(":y")
    points, polygons, objects = {"off": read_off, "obj": read_obj, "glb": read_glb}[path.rsplit(".", 1)[1]](path)
    if y_up:
        points = [(p[0], -p[2], p[1]) for p in points]
    lo, hi = [min(p[k] for p in points) for k in range(3)], [max(p[k] for p in points) for k in range(3)]
    step = max(hi[k] - lo[k] for k in range(3)) / 65536
    whole = [[round((p[k] - lo[k]) / step) for k in range(3)] for p in points]
    seen = [[sum(a * x for a, x in zip(axis, p)) for axis in AXES] for p in whole]
    lo, hi = [min(p[k] for p in seen) for k in range(3)], [max(p[k] for p in seen) for k in range(3)]
    scale = 2.0 ** math.floor(math.log2(980 / max(hi[k] - lo[k] for k in range(2))))
    numbers, kept, triangles = {}, [], []
    places = []
    for p, object_of in zip(seen, objects):
        q = tuple((p[k] - (lo[k] + hi[k]) // 2) * scale for k in range(3))
        places.append(numbers.setdefault((object_of, q), len(numbers)))
        if len(kept) < len(numbers):
            kept.append(q)
    for p in polygons:
        for i in range(1, len(p) - 1):
            t = (places[p[0]], places[p[i]], places[p[i + 1]])
            u, v = [[kept[t[i]][k] - kept[t[0]][k] for k in range(3)] for i in (1, 2)]
            if any(x != 0 for x in cross(u, v)):
                triangles.append(t)
    with open(out, "w") as file:
        file.write("OFF\n%d %d 0\n" % (len(kept), len(triangles)))
        file.writelines("%.15g %.15g %.15g\n" % p for p in kept)
        file.writelines("3 %d %d %d\n" % t for t in triangles)


main()
