#!/usr/bin/env python3
"""openarena.py PK3 MAP [--boxes]: the architecture of a map (IBSP 46) as OFF; with --boxes the bounding boxes of its
brushes as CSV. Without MAP: the names of the maps.

Faces are triangulated by the map itself; triangles of no area are left out, curved patches (a few decorations) too.
Coordinates are those of the file, in single precision.
"""
import struct
import sys
import zipfile

PLANES, MODELS, BRUSHES, SIDES, VERTICES, MESHVERTS, FACES = 2, 7, 8, 9, 10, 11, 13
POLYGON, MESH = 1, 3


def lump(data, number):
    start, size = struct.unpack_from("<ii", data, 8 + 8 * number)
    return data[start : start + size]


def triangles(data):
    points = [v[:3] for v in struct.iter_unpack("<3f32x", lump(data, VERTICES))]
    order = [i for (i,) in struct.iter_unpack("<i", lump(data, MESHVERTS))]
    for face in struct.iter_unpack("<12i12f2i", lump(data, FACES)):
        kind, vertex, mesh, count = face[2], face[3], face[5], face[6]
        if kind not in (POLYGON, MESH):
            continue
        for i in range(mesh, mesh + count, 3):
            corners = [points[vertex + order[i + k]] for k in range(3)]
            if len(set(corners)) == 3:
                yield corners


def boxes(data):
    """The first six sides of a brush are axis-parallel, in the order -x, +x, -y, +y, -z, +z."""
    planes = list(struct.iter_unpack("<4f", lump(data, PLANES)))
    sides = [p for p, _ in struct.iter_unpack("<ii", lump(data, SIDES))]
    for first, count, _ in struct.iter_unpack("<iii", lump(data, BRUSHES)):
        if count < 6:
            continue
        far = [planes[sides[first + i]][3] for i in range(6)]
        lo, hi = [-far[0], -far[2], -far[4]], [far[1], far[3], far[5]]
        if all(a <= b for a, b in zip(lo, hi)):
            yield lo + hi


def put_off(data):
    index, faces = {}, []
    for corners in triangles(data):
        faces.append([index.setdefault(c, len(index)) for c in corners])
    print("OFF")
    print(len(index), len(faces), 0)
    for point in index:
        print(*(repr(x + 0.0) for x in point))
    for face in faces:
        print(3, *face)


def main():
    if len(sys.argv) not in (2, 3, 4) or sys.argv[3:] not in ([], ["--boxes"]):
        sys.exit(__doc__)
    with zipfile.ZipFile(sys.argv[1]) as pack:
        names = {n[5:-4]: n for n in pack.namelist() if n.startswith("maps/") and n.endswith(".bsp")}
        if len(sys.argv) == 2:
            print("\n".join(sorted(names)))
            return
        if sys.argv[2] not in names:
            sys.exit(f"no map {sys.argv[2]}; there are: {' '.join(sorted(names))}")
        data = pack.read(names[sys.argv[2]])
    if struct.unpack_from("<4si", data, 0) != (b"IBSP", 46):
        sys.exit("not an IBSP map of version 46")
    if sys.argv[3:]:
        print("lo_x,lo_y,lo_z,hi_x,hi_y,hi_z")
        for box in boxes(data):
            print(*(repr(x + 0.0) for x in box), sep=",")
    else:
        put_off(data)


main()
