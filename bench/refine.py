#!/usr/bin/env python3
"""refine.py MESH.off N: every triangle as N x N smaller ones on a rippled surface, as OFF on standard output.

Large meshes of real shape: the bunny of 3,674 triangles and N = 17 make 1,061,786. Common edges stay common.
"""
import math, sys

lines = (line for line in open(sys.argv[1]) if line.strip() and not line.startswith(('OFF', '#')))
n = int(sys.argv[2])
counts = [int(x) for x in next(lines).split()]
points = [tuple(float(x) for x in next(lines).split()[:3]) for _ in range(counts[0])]
triangles = [tuple(int(x) for x in next(lines).split()[1:4]) for _ in range(counts[1])]
size = max(max(p[k] for p in points) - min(p[k] for p in points) for k in range(3))

def ripple(p):
    """Moved by a smooth field, a function of the place alone."""
    wave = [math.sin(300 * p[k] / size + 1.7 * p[(k + 1) % 3]) for k in range(3)]
    return tuple(p[k] + 1e-3 * size * wave[(k + 1) % 3] for k in range(3))

out, known, made = [], {}, []

def place(weights):
    """The point at weights (vertex, share of N), the same for every triangle that has it."""
    key = tuple(sorted(w for w in weights if w[1]))
    if key not in known:
        known[key] = len(out)
        out.append(ripple(tuple(sum(points[v][k] * w for v, w in key) / n for k in range(3))))
    return known[key]

for a, b, c in triangles:
    at = lambda i, j: place(((a, n - i - j), (b, i), (c, j)))
    for i in range(n):
        for j in range(n - i):
            made.append((at(i, j), at(i + 1, j), at(i, j + 1)))
            if i + j < n - 1:
                made.append((at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)))

print(f'OFF\n{len(out)} {len(made)} 0')
print('\n'.join('%.9g %.9g %.9g' % p for p in out))
print('\n'.join('3 %d %d %d' % t for t in made))
