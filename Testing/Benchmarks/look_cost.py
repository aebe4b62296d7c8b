#!/usr/bin/python3
"""Measures light and eye-dome lighting by class (docs/adr/0041): prints a Markdown table.

    Testing/Benchmarks/look_cost.py TOOL WORK STORE

STORE has classes and normals. CPU milliseconds of a frame of an orbit, 1280x720, software back end:
the median of some rounds, in each of which all styles have their turn.
"""

import json
import statistics
import sys

from papers import Tool, head, row

ROUNDS = 5
SPLATS = {"technique": "splats", "color": "classification"}
SPHERES = {"technique": "spheres", "color": "classification"}
LIT_AND_EDL = {"mode": ["lit", "edl"]}
STYLES = {
    "splats": {"default": SPLATS},
    "all lit, with eye-dome lighting": {"default": SPLATS, "shading": LIT_AND_EDL},
    "... class 2 of another strength": {
        "default": SPLATS, "shading": LIT_AND_EDL, "classes": {"2": {"edl": {"strength": 0.1}}}},
    "... class 2 without either": {
        "default": SPLATS, "shading": LIT_AND_EDL,
        "classes": {"2": {"edl": False, "light": False}}},
    "... five classes, each of its own": {
        "default": SPLATS, "shading": LIT_AND_EDL,
        "classes": {str(code): {"light": {"ambient": 0.1 * code}, "edl": {"strength": 0.1 * code}}
                    for code in (1, 2, 3, 5, 6)}},
    "spheres, flat": {"default": {**SPHERES, "light": False}},
    "spheres": {"default": SPHERES},
}


def main():
    tool, store = Tool(*sys.argv[1:3]), sys.argv[3]
    times = {name: [] for name in STYLES}
    for _ in range(ROUNDS):
        for name, style in STYLES.items():
            sheet = tool.work / "style.json"
            sheet.write_text(json.dumps(style))
            times[name].append(tool.frame(store, "--style", sheet)[0])
    head("style", "CPU ms a frame", "from, to")
    for name, rounds in times.items():
        row(name, f"{statistics.median(rounds):.1f}", f"{min(rounds):.1f}, {max(rounds):.1f}")


if __name__ == "__main__":
    main()
