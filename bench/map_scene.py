#!/usr/bin/env python3
"""map_scene.py MAP.bsp: the surfaces of a Quake III map (IBSP, version 46) as OFF on standard output.

Architecture as designers build it: walls that meet in T-junctions, thousands of coplanar faces, rooms within rooms.
Plane surfaces and models are taken as they are, curved ones (biquadratic patches) as 4 x 4 squares of two triangles;
what is never drawn (shaders of sky, clips, triggers) is left out. OpenArena's maps are in Debian's openarena-081-maps.
"""
import struct, sys

data = open(sys.argv[1], 'rb').read()
magic, version = struct.unpack_from('<4si', data)
if magic != b'IBSP' or version != 46:
    sys.exit(f'{sys.argv[1]}: not a Quake III map')

def lump(number, layout):
    offset, length = struct.unpack_from('<ii', data, 8 + 8 * number)
    return list(struct.iter_unpack(layout, data[offset:offset + length]))

shaders = [name.split(b'\0')[0].decode('latin-1') for name, _, _ in lump(1, '<64sii')]
points = [v[:3] for v in lump(10, '<10f4B')]
offsets = [o for o, in lump(11, '<i')]
triangles = []
LEVEL = 4

def curve(first, wide, high):
    """Squares of 3 x 3 control points, each a biquadratic surface."""
    weights = [((1 - t) ** 2, 2 * t * (1 - t), t * t) for t in (i / LEVEL for i in range(LEVEL + 1))]
    for y in range(0, high - 2, 2):
        for x in range(0, wide - 2, 2):
            base = len(points)
            for v in weights:
                for u in weights:
                    points.append(tuple(sum(v[j] * u[i] * points[first + (y + j) * wide + x + i][k]
                                            for j in range(3) for i in range(3)) for k in range(3)))
            for j in range(LEVEL):
                for i in range(LEVEL):
                    a = base + j * (LEVEL + 1) + i
                    b, c, d = a + 1, a + LEVEL + 1, a + LEVEL + 2
                    triangles.extend([(a, c, b), (b, c, d)])

for f in lump(13, '<12i12f2i'):
    shader, kind, first, first_offset, count = f[0], f[2], f[3], f[5], f[6]
    if any(word in shaders[shader] for word in ('sky', 'common/', 'noshader')):
        continue
    if kind in (1, 3):
        ids = [first + o for o in offsets[first_offset:first_offset + count]]
        triangles.extend(zip(ids[0::3], ids[1::3], ids[2::3]))
    elif kind == 2:
        curve(first, f[24], f[25])

print(f'OFF\n{len(points)} {len(triangles)} 0')
for p in points:
    print('%.9g %.9g %.9g' % p)
for t in triangles:
    print('3 %d %d %d' % t)
