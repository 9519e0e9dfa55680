#!/usr/bin/env python3
"""wad.py WAD [MAP]: a floor plan of a Doom map as GeoJSON; without MAP: the names of the maps.

The walls are the lines (lump LINEDEFS) between corners (lump VERTEXES) of the map, as whole coordinates. Lines of no
length are left out. Formats: Doom, 14 bytes a line; Hexen, 16 bytes.
"""
import json
import struct
import sys


def lumps(data):
    kind, count, at = struct.unpack_from("<4sii", data, 0)
    if kind not in (b"IWAD", b"PWAD"):
        sys.exit("not a WAD")
    for i in range(count):
        start, size, name = struct.unpack_from("<ii8s", data, at + 16 * i)
        yield name.rstrip(b"\0").decode("ascii", "replace"), data[start : start + size]


def maps(data):
    """Name of each map -> its lumps by name: those that follow its name, up to the next map."""
    found, before = {}, ""
    current = None
    for name, body in lumps(data):
        if name == "THINGS":
            current = found[before] = {}
        if current is not None and name not in current and len(current) < 11:
            current[name] = body
        before = name
    return found


def walls(level):
    corners = [xy for xy in struct.iter_unpack("<hh", level["VERTEXES"])]
    form = "<HH12x" if "BEHAVIOR" in level else "<HH10x"
    for a, b in struct.iter_unpack(form, level["LINEDEFS"]):
        if corners[a] != corners[b]:
            yield [corners[a], corners[b]]


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    with open(sys.argv[1], "rb") as file:
        found = maps(file.read())
    if len(sys.argv) == 2:
        print("\n".join(found))
        return
    if sys.argv[2] not in found:
        sys.exit(f"no map {sys.argv[2]}; there are: {' '.join(found)}")
    features = [
        {"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": wall}}
        for wall in walls(found[sys.argv[2]])
    ]
    json.dump({"type": "FeatureCollection", "features": features}, sys.stdout)


main()
