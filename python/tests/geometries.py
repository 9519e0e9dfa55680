"""Random geometries of small whole numbers, on which shapely's predicates are right and touches are frequent."""

from shapely.geometry import LineString, MultiLineString, MultiPoint, MultiPolygon, Point, Polygon, box
from shapely.ops import unary_union


def a_point(random):
    return Point(random.randint(0, 8), random.randint(0, 8))


def a_line(random):
    while True:
        line = LineString([(random.randint(0, 8), random.randint(0, 8)) for _ in range(random.randint(2, 4))])
        if line.is_simple and line.is_valid and line.length > 0:
            return line


def a_ring(random):
    """A closed line, which is no area."""
    return LineString(a_polygon(random).exterior.coords)


def a_box(random):
    x, y = random.randint(0, 6), random.randint(0, 6)
    return box(x, y, x + random.randint(1, 3), y + random.randint(1, 3))


def a_polygon(random):
    while True:
        polygon = Polygon([(random.randint(0, 9), random.randint(0, 9)) for _ in range(random.randint(3, 5))])
        if polygon.is_valid and polygon.area > 0:
            return polygon


def with_hole(random):
    x, y = random.randint(0, 3), random.randint(0, 3)
    hole = [(x + 1, y + 1), (x + 3, y + 1), (x + 3, y + 3), (x + 1, y + random.randint(2, 3))]
    return Polygon(box(x, y, x + random.randint(4, 6), y + random.randint(4, 6)).exterior, [hole])


def several(random):
    kind = random.randrange(3)
    if kind == 0:
        return MultiPoint([a_point(random) for _ in range(3)])
    if kind == 1:
        return MultiLineString([a_line(random) for _ in range(2)])
    while True:
        both = MultiPolygon([a_polygon(random) for _ in range(2)])
        if both.is_valid:
            return both


def missing(random):
    return random.choice([None, Point(), Polygon(), LineString()])


ALL = [a_point, a_line, a_ring, a_box, a_polygon, with_hole, several]


def some(random, count, kinds=ALL):
    return [random.choice(kinds)(random) for _ in range(count)]


# On a lattice of five by five points nearly everything touches: borders run along each other, lines pass through
# corners, ends meet, and geometries are equal.


def cells(random):
    """Squares put together, with holes and several parts at times."""
    return unary_union([box(x, y, x + 1, y + 1) for x, y in lattice(random, random.randint(2, 7), 3)])


def halves(random):
    """Halves of squares put together."""
    triangles = []
    for x, y in lattice(random, random.randint(1, 4), 3):
        corners = [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)]
        del corners[random.randrange(4)]
        triangles.append(Polygon(corners))
    return unary_union(triangles)


def paths(random):
    """Lines that may cross and touch each other, so that ends lie on other lines."""
    while True:
        parts = [lattice(random, random.randint(2, 3)) for _ in range(random.randint(1, 4))]
        lines = [LineString(part) for part in parts]
        if all(line.is_simple and line.length > 0 for line in lines):
            return MultiLineString(lines) if len(lines) > 1 else lines[0]


def outline(random):
    """The border of an area."""
    return random.choice([cells, halves])(random).boundary


def dots(random):
    return MultiPoint(lattice(random, random.randint(1, 4)))


def with_corners_twice(geometry):
    """The same set of points, with segments without length."""
    if hasattr(geometry, "geoms"):
        return type(geometry)([with_corners_twice(part) for part in geometry.geoms])
    if isinstance(geometry, Polygon):
        return Polygon(twice(geometry.exterior), [twice(ring) for ring in geometry.interiors])
    return geometry if isinstance(geometry, Point) else LineString(twice(geometry))


def twice(line):
    return [corner for corner in line.coords for _ in range(2)]


def lattice(random, count, most=4):
    return [(random.randint(0, most), random.randint(0, most)) for _ in range(count)]


DENSE = [cells, halves, paths, paths, outline, dots, a_point]
