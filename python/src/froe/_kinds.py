"""Kinds of objects, as the library numbers them (froe_kind)."""

POINT, SEGMENT, POLYGON, BOX, BALL, HULL = range(6)
