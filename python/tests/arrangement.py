"""How two geometries lie to each other (DE-9IM), in fractions and by brute force: every node of the arrangement of all
their segments, a point on every edge, and a point in every cell between two neighbouring nodes' verticals."""

from fractions import Fraction
from itertools import combinations

INSIDE, BORDER, OUTSIDE = range(3)


def pair(point):
    return Fraction(point[0]), Fraction(point[1])


def parts(geometry):
    for part in getattr(geometry, "geoms", [geometry]):
        if part.geom_type.startswith("Multi") or part.geom_type == "GeometryCollection":
            yield from parts(part)
        elif not part.is_empty:
            yield part


def turn(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def is_on(point, segment):
    a, b = segment
    return turn(a, b, point) == 0 and min(a, b) <= point <= max(a, b)


class Shape:
    """The points, lines and rings of a geometry."""

    def __init__(self, geometry):
        self.points, self.lines, self.rings = [], [], []
        for part in parts(geometry):
            if part.geom_type == "Point":
                self.points.append(pair(part.coords[0]))
            elif part.geom_type == "Polygon":
                self.rings += [[pair(c) for c in ring.coords] for ring in (part.exterior, *part.interiors)]
            else:
                self.lines.append([pair(c) for c in part.coords])
        self.of_lines = [edge for line in self.lines for edge in zip(line, line[1:])]
        self.of_rings = [edge for ring in self.rings for edge in zip(ring, ring[1:])]

    def place(self, point):
        """Inside, on the border, or outside."""
        if point in self.points:
            return INSIDE
        if any(is_on(point, edge) for edge in self.of_rings):
            return BORDER
        if any(is_on(point, edge) for edge in self.of_lines):
            return BORDER if sum((line[0] == point) + (line[-1] == point) for line in self.lines) % 2 else INSIDE
        left = 0
        for a, b in self.of_rings:
            if (a[1] <= point[1]) != (b[1] <= point[1]):
                left += a[0] + (point[1] - a[1]) * (b[0] - a[0]) / (b[1] - a[1]) < point[0]
        return INSIDE if left % 2 else OUTSIDE


def crossing(one, other):
    """Points in which two segments meet, and ends of one on the other."""
    (a, b), (c, d) = one, other
    found = [point for point in (a, b) if is_on(point, other)] + [point for point in (c, d) if is_on(point, one)]
    t, u = turn(a, b, c), turn(a, b, d)
    if t * u < 0 and turn(c, d, a) * turn(c, d, b) < 0:
        found.append((c[0] + t * (d[0] - c[0]) / (t - u), c[1] + t * (d[1] - c[1]) / (t - u)))
    return found


def samples(edges, points):
    """Points and the dimensions of what they stand for."""
    on = {edge: {*edge} for edge in edges}
    for one, other in combinations(edges, 2):
        for point in crossing(one, other):
            on[one].add(point)
            on[other].add(point)
    nodes = set(points).union(*on.values())
    for node in nodes:
        yield node, 0
    for within in on.values():
        ordered = sorted(within)
        for a, b in zip(ordered, ordered[1:]):
            yield ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2), 1
    verticals = sorted({x for x, _ in nodes})
    for left, right in zip(verticals, verticals[1:]):
        x = (left + right) / 2
        over = [(a, b) for a, b in edges if min(a, b)[0] < x < max(a, b)[0]]
        heights = sorted({a[1] + (x - a[0]) * (b[1] - a[1]) / (b[0] - a[0]) for a, b in over})
        for low, high in zip(heights, heights[1:]):
            yield (x, (low + high) / 2), 2


def relate(one, other):
    """The nine dimensions as shapely writes them: "0F1FF0102"."""
    a, b = Shape(one), Shape(other)
    edges = list({edge for shape in (a, b) for edge in shape.of_lines + shape.of_rings})
    found = [[-1] * 3 for _ in range(3)]
    for point, dimension in samples(edges, a.points + b.points):
        i, j = a.place(point), b.place(point)
        found[i][j] = max(found[i][j], dimension)
    found[OUTSIDE][OUTSIDE] = 2
    return "".join("F" if dimension < 0 else str(dimension) for row in found for dimension in row)


def dimension(geometry):
    return max({"Point": 0, "Polygon": 2}.get(part.geom_type, 1) for part in parts(geometry))


def holds(predicate, one, other):
    """Does a predicate of shapely hold? By the definitions of OGC Simple Features."""
    return predicate in predicates(one, other)


def predicates(one, other):
    """All that hold."""
    matrix = relate(one, other)
    ii, ib, ie, bi, bb, be, ei, eb, _ = (entry != "F" for entry in matrix)
    meets, first, second = ii or ib or bi or bb, dimension(one), dimension(other)
    if first == second == 1:
        crosses, overlaps = matrix[0] == "0", matrix[0] == "1" and ie and ei
    else:
        crosses = ii and (ie if first < second else ei if first > second else False)
        overlaps = first == second and ii and ie and ei
    found = {
        "intersects": meets,
        "covers": meets and not ei and not eb,
        "covered_by": meets and not ie and not be,
        "contains": ii and not ei and not eb,
        "contains_properly": ii and not bi and not bb and not ei and not eb,
        "within": ii and not ie and not be,
        "touches": meets and not ii,
        "crosses": crosses,
        "overlaps": overlaps,
    }
    return {name for name, true in found.items() if true}
