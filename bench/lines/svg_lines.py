#!/usr/bin/env python3
"""svg_lines.py FILE.svg: the lines of a drawing on a page of 1000 x 1000 as the judge reads them.

Each path, polyline or line that is stroked, in a row: x y x y ..., in pixels from the middle of the page, y upwards.
Understands what froe, Blender's Freestyle and three-svg-renderer write: commands M L H V Z in both cases, scales, and
groups that are not shown.
"""
import re
import sys
import xml.etree.ElementTree as tree


def outlines(d):
    words = re.findall(r"[A-Za-z]|[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?", d)
    out, at, start, command, i = [], [0.0, 0.0], [0.0, 0.0], "", 0
    while i < len(words):
        if words[i].isalpha():
            command = words[i]
            i += 1
        if command in "zZ":
            out[-1].append(list(start))
            at = list(start)
            continue
        base = at if command.islower() else [0.0, 0.0]
        if command in "hH":
            at = [base[0] + float(words[i]), at[1]]
        elif command in "vV":
            at = [at[0], base[1] + float(words[i])]
        elif command in "mMlL":
            at = [base[0] + float(words[i]), base[1] + float(words[i + 1])]
            i += 1
        else:
            raise SystemExit("svg_lines: unknown command " + command)
        i += 1
        if command in "mM":
            out.append([])
            start, command = list(at), "l" if command == "m" else "L"
        out[-1].append(list(at))
    return out


def walk(node, scale, visit):
    found = re.search(r"scale\(([-.\d]+)\)", node.get("transform", ""))
    scale *= float(found[1]) if found else 1
    if node.get("display") == "none":
        return
    visit(node, scale)
    for child in node:
        walk(child, scale, visit)


def put(node, scale):
    kind = node.tag.rsplit("}", 1)[-1]
    if kind == "path":
        lines = outlines(node.get("d", ""))
    elif kind in ("polyline", "polygon"):
        numbers = list(map(float, re.split(r"[\s,]+", node.get("points", "").strip())))
        lines = [[list(p) for p in zip(numbers[::2], numbers[1::2])]]
    elif kind == "line":
        lines = [[[float(node.get(k + i)) for k in "xy"] for i in "12"]]
    else:
        return
    for line in lines:
        print(*("%.9g %.9g" % (x * scale - 500, 500 - y * scale) for x, y in line))


walk(tree.parse(sys.argv[1]).getroot(), 1.0, put)
