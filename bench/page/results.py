"""results.py: lines of results (README.md of bench/) as numbers and ratios."""
import json
import math
import statistics


def shown(number):
    """Two or three digits, as people write them. None: no result."""
    if number is None:
        return ""
    if number == 0:
        return "0"
    if number >= 1e6:
        return "%.3g M" % (number / 1e6)
    if number >= 1000:
        return "{:,.0f}".format(float("%.3g" % number))
    return "%.3g" % number if number >= 100 else "%.2g" % number


def span(values):
    low, high = shown(min(values)), shown(max(values))
    return low if low == high else "%s\u2013%s" % (low, high)


def quartiles(values):
    return statistics.quantiles(values, n=4, method="inclusive") if len(values) > 1 else [values[0]] * 3


class Results:
    def __init__(self, paths):
        self.heads, self.values, self.notes, self.failed, self.objects = {}, {}, {}, {}, {}
        self.order = []  # keys as they came
        for path in paths:
            for line in path.read_text().splitlines():
                self.take(path.stem, json.loads(line))

    def take(self, part, line):
        if "head" in line:
            self.heads[part] = line["head"]
            return
        if part in ("paths", "threads"):  # other runs of the same work
            line["work"] = part + ", " + line["work"]
        key = (line["work"], line["scene"], round(math.log10(line["objects"])), line["program"], line["measure"])
        self.order.append(key)
        self.objects[key[:3]] = line["objects"]
        if "failed" in line:
            self.failed[key] = line["failed"]
        else:
            self.values[key] = line["values"]
        if "note" in line:
            self.notes[key] = line["note"]

    def select(self, place, work=None, size=None, measure=None, scene=None):
        """What stands at a place of the keys, in the order of the results: 1 scenes, 2 sizes, 3 programs."""
        want = (work, scene, size, None, measure)
        return list(dict.fromkeys(k[place] for k in self.order if all(w is None or w == v for w, v in zip(want, k))))

    def median(self, *key):
        return statistics.median(self.values[key]) if key in self.values else None

    def ratios(self, work, scene, size, program, measure, froe="froe", part=None):
        """By how much froe is better, round by round: faster, smaller; `part`: by another measure of froe. None: one of
        them has no result."""
        ours, theirs = (work, scene, size, froe, part or measure), (work, scene, size, program, measure)
        if ours not in self.values or theirs not in self.values:
            return None
        more = measure == "per second"
        return [a / b if more else b / a for a, b in zip(self.values[ours], self.values[theirs])]

    def ratio(self, *key, **froe):
        values = self.ratios(*key, **froe)
        return statistics.median(values) if values else None
