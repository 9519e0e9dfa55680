#!/usr/bin/env python3
"""measure.py [FOLDER]: measures the scenes of data/ and those that `get` fetched into FOLDER (build/real-scenes), and
writes the tables of docs/evidence/real-scenes.md between its marks, and docs/evidence/real-scenes.csv, which bench_plot
draws. FROE names the program (build/bin/froe).
"""
import json
import math
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
FROE = os.environ.get("FROE", str(ROOT / "build/bin/froe"))
KINDS = [
    ("floor plans", ["data/freedoom-e1m1.geojson", "data/freedoom-e1m5.geojson", "plan-*.geojson"]),
    ("maps", ["data/states-albers-10m.json", "counties.json", "countries-*.json", "coast-?.geojson"]),
    ("architecture", ["data/fzk-haus.glb", "data/fzk-haus-boxes.csv", "arena-*"]),
    ("scans", ["scan-*"]),
]
# The same thing at several sizes, or many things of a kind: how do measures grow with n?
SERIES = [
    ("68 floor plans of one maker", "plan-"),
    ("coasts of the world at four resolutions", "coast-"),
    ("countries of the world at three resolutions", "countries-"),
    ("four arenas, triangles", "arena-", "-boxes"),
    ("four arenas, boxes of brushes", "arena-", None, "-boxes"),
    ("four scanned meshes", "scan-"),
]


def froe(*words):
    done = subprocess.run([FROE, *words, "--json", "--quiet"], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def measure(path, kind):
    report = froe("measure", str(path))
    tree = froe("build", str(path), "--method", "density" if kind in ("floor plans", "maps") else "auto")
    spread = report["distributions"]
    fat = spread.get("fatness") or spread.get("fatness in the plane") or {}
    paired = [row for row in report["directional density"] if row["delta"] == 0.5][0]
    density = report["density (radius)"]
    return {
        "scene": path.name.split(".")[0],
        "n": report["objects"],
        "clutter": report["clutter factor"]["at least"],
        "cubes": spread["clutter of cubes"],
        "density": (density["at least"], density["at most"], density["of all objects"]),
        "load": spread["load within 3 radii"],
        "fatness": fat.get("median"),
        "paired": (paired["paired 95 %"], paired["paired most"]),
        "pieces": tree["pieces_per_object"],
        "method": tree["method"],
        "seconds": sum(part["seconds"] for part in report.values() if isinstance(part, dict) and "seconds" in part),
    }


def number(value):
    return "" if value is None else f"{value:.3g}" if isinstance(value, float) else f"{value:,}".replace(",", " ")


def row(kind, m):
    low, high, whole = m["density"]
    cubes = m["cubes"]
    cells = [kind, m["scene"], number(m["n"]), m["clutter"], f"{cubes['mean']:.2f}", number(int(cubes["95 %"])),
             f"{low} to {high}" if whole else f"{low} or more", number(int(m["load"]["median"])), number(m["fatness"]),
             f"{m['paired'][0]:.0f}, {m['paired'][1]:.0f}", f"{m['pieces']:.2f}"]
    return "| " + " | ".join(str(c) for c in cells) + " |"


def csv_line(kind, m):
    low, high, whole = m["density"]
    if kind == "architecture":
        kind = ("boxes" if m["scene"].endswith("-boxes") else "triangles") + " of architecture"
    return f"{kind},{m['scene']},{m['n']},{m['clutter']},{low},{high if whole else ''}"


def slope(points):
    logs = [(math.log(x), math.log(y)) for x, y in points]
    mx, my = (sum(v[i] for v in logs) / len(logs) for i in (0, 1))
    spread = sum((x - mx) ** 2 for x, _ in logs)
    exponent = sum((x - mx) * (y - my) for x, y in logs) / spread
    rest = sum((y - my - exponent * (x - mx)) ** 2 for x, y in logs)
    error = math.sqrt(rest / (len(logs) - 2) / spread) if len(logs) > 2 else float("nan")
    return f"{exponent:.2f} ± {2 * error:.2f}"


def series_row(name, found):
    sizes = [m["n"] for m in found]
    cells = [name, len(found), f"{number(min(sizes))} to {number(max(sizes))}",
             f"{min(m['clutter'] for m in found)} to {max(m['clutter'] for m in found)}",
             slope([(m["n"], m["clutter"]) for m in found]),
             slope([(m["n"], m["cubes"]["mean"]) for m in found]),
             slope([(m["n"], m["density"][0]) for m in found]),
             slope([(m["n"], m["pieces"]) for m in found])]
    return "| " + " | ".join(str(c) for c in cells) + " |"


def summary(name, found):
    """One line for many scenes: medians."""
    def middle(values):
        values = sorted(values)
        return values[len(values) // 2]
    sizes = sorted(m["n"] for m in found)
    return (f"Medians over the {len(found)} {name} ({number(sizes[0])} to {number(sizes[-1])} objects): clutter at least "
            f"{middle([m['clutter'] for m in found])} (most {max(m['clutter'] for m in found)}), mean load of cubes "
            f"{middle([m['cubes']['mean'] for m in found]):.2f}, density at least {middle([m['density'][0] for m in found])}, "
            f"pieces per object {middle([m['pieces'] for m in found]):.2f}.")


def put(page, mark, text):
    before, rest = page.split(f"<!-- {mark} -->\n", 1)
    after = rest.split(f"<!-- end of {mark} -->", 1)[1]
    return f"{before}<!-- {mark} -->\n{text}\n<!-- end of {mark} -->{after}"


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build/real-scenes"
    rows, everything = [], {}
    lines = ["kind,scene,objects,clutter_at_least,density_at_least,density_at_most"]
    for kind, patterns in KINDS:
        for pattern in patterns:
            base = ROOT if pattern.startswith("data/") else folder
            for path in sorted(base.glob(pattern)):
                m = measure(path, kind)
                lines.append(csv_line(kind, m))
                everything[m["scene"]] = m
                print(m["scene"], m["n"], m["clutter"], m["density"], f"{m['seconds']:.1f} s", file=sys.stderr)
                if not m["scene"].startswith("plan-"):
                    rows.append(row(kind, m))
    plans = [m for name, m in everything.items() if name.startswith("plan-")]
    table = ["| kind | scene | objects | clutter at least | mean load of cubes | 95 % | density | median load | median fatness "
             "| paired directional, 95 % and most | pieces / n |", "|" + "---|" * 11, *rows]
    if plans:
        table += ["", summary("floor plans", plans)]
    growth = ["| scenes | number | objects | clutter at least | its exponent in n | of the mean load | of density | of pieces / n |",
              "|" + "---|" * 8]
    for name, prefix, *marks in SERIES:
        without, within = (marks + [None, None])[:2]
        found = [m for key, m in everything.items() if key.startswith(prefix) and
                 not (without and without in key) and (not within or within in key)]
        if len(found) > 2:
            growth.append(series_row(name, found))
    (ROOT / "docs/evidence/real-scenes.csv").write_text("\n".join(lines) + "\n")
    document = ROOT / "docs/evidence/real-scenes.md"
    page = put(document.read_text(), "scenes", "\n".join(table))
    document.write_text(put(page, "growth", "\n".join(growth)))


main()
