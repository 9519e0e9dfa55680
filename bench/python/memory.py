#!/usr/bin/env python3
"""memory.py SIZE: by how much the process grows while froe takes segments from an array and makes a tree, in bytes a
segment. Prints lines of results (README.md of bench/). Linux tells the memory in /proc/self.
"""

import json
import sys

import froe
import numpy as np


def resident(name):
    with open("/proc/self/status") as status:
        return next(int(line.split()[1]) * 1024 for line in status if line.startswith(name))


class Growth:
    """From now on."""

    def __init__(self, count):
        self.count, self.begin = count, resident("VmRSS")
        with open("/proc/self/clear_refs", "w") as peaks:
            peaks.write("5")  # the peak begins anew

    def say(self, work, program):
        for measure, name in (("bytes", "VmRSS"), ("bytes at most", "VmHWM")):
            value = (resident(name) - self.begin) / self.count
            line = {"work": "python: " + work, "scene": "short", "objects": self.count, "program": program}
            print(json.dumps({**line, "measure": measure, "values": [value]}), flush=True)


def main():
    count = int(sys.argv[1])
    random = np.random.default_rng(1)
    segments = np.empty((count, 4))
    segments[:, :2] = random.random((count, 2))
    segments[:, 2:] = segments[:, :2] + (random.random((count, 2)) - 0.5) / np.sqrt(count)
    for writeable in (True, False):
        segments.flags.writeable = writeable
        growth = Growth(count)
        scene = froe.segments(segments)
        growth.say("scene of an array", "writeable" if writeable else "read-only")
        if writeable:
            del scene
    growth = Growth(count)
    tree = scene.build()
    growth.say("tree", "froe")
    assert tree.report.objects == count


if __name__ == "__main__":
    main()
