#!/usr/bin/python3
"""The rendering front over the frames of a session: FRONT, figures 9 and 10, for one store.

    Testing/Benchmarks/front_trace.py TOOL STORE OUT_FOLDER

Replays two camera paths as a user would fly them, each part followed by a rest: an overview and a
turn around the cloud (figure 9), then a zoom in and out (figure 10). Writes overview.csv, zoom.csv
and a picture of each: points drawn, length of the front, threshold. Needs an X server (xvfb-run)
and python3-matplotlib.
"""

import csv
import json
import math
import pathlib
import subprocess
import sys

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402 (the line above decides what it draws with)

REST, MOVE = 60, 60  # frames


class Tour:
    """Cameras with the frames that lead from each to the next, and what each stretch is."""

    def __init__(self):
        self.cameras, self.stretches, self.frame = [], [], 0

    def go(self, name, cameras, frames):
        self.stretches.append((self.frame, name))
        for camera in cameras:
            self.cameras.append(dict(camera, frames=max(1, frames // len(cameras))))
            self.frame += self.cameras[-1]["frames"]


def camera(centre, distance, azimuth, elevation=35.0):
    a, e = math.radians(azimuth), math.radians(elevation)
    arm = (math.cos(e) * math.sin(a), -math.cos(e) * math.cos(a), math.sin(e))
    return {"position": [c + distance * d for c, d in zip(centre, arm)],
            "focal_point": list(centre), "view_up": [0, 0, 1], "view_angle": 30}


def tours(bounds):
    low, high = bounds[:3], bounds[3:]
    centre = [(a + b) / 2 for a, b in zip(low, high)]
    far = 1.1 * math.dist(low, high)
    overview = Tour()
    whole = camera(centre, far, 45)
    overview.go("rest", [whole], REST)
    overview.go("turn", [camera(centre, far, 45 + 10 * k) for k in range(36)], 2 * MOVE)
    overview.go("rest", [whole], REST)
    zoom = Tour()
    near = [camera(centre, far * 0.04 ** (k / 12), 45) for k in range(13)]
    zoom.go("rest", [near[0]], REST)
    zoom.go("zoom in", near[:-1], MOVE)
    zoom.go("rest", [near[-1]], REST)
    zoom.go("zoom out", near[:0:-1], MOVE)
    zoom.go("rest", [near[0]], REST)
    return {"overview": overview, "zoom": zoom}


def replay(tool, store, tour, folder, name, options=()):
    path, table = folder / f"{name}-path.json", folder / f"{name}.csv"
    path.write_text(json.dumps(tour.cameras))
    subprocess.run([tool, "bench", store, "--path", path, "--interactive", "--size", "1280x720",
                    "--stats", folder / f"{name}.json", "--frames-csv", table, *options],
                   check=True, stdout=subprocess.DEVNULL)
    with open(table, newline="") as rows:
        return list(csv.DictReader(rows))


def plot(rows, tour, title, picture):
    figure, charts = pyplot.subplots(4, 1, sharex=True, figsize=(8, 8))
    curves = [("points", 1e-6, "points drawn, million"), ("front_length", 1, "front, nodes"),
              ("threshold_px", 1, "threshold, px"), ("ms", 1, "frame, ms")]
    for chart, (column, scale, label) in zip(charts, curves):
        chart.plot([scale * float(row[column]) for row in rows], linewidth=1.2)
        chart.set_ylabel(label)
        chart.grid(alpha=0.3)
        for frame, _ in tour.stretches:
            chart.axvline(frame, color="0.6", linewidth=0.8)
    charts[2].set_yscale("log")
    for frame, name in tour.stretches:
        charts[0].text(frame + 2, charts[0].get_ylim()[1], name, va="top", fontsize=8)
    charts[0].set_title(title)
    charts[-1].set_xlabel("frame")
    figure.tight_layout()
    figure.savefig(picture, dpi=90)


def main():
    tool, store, folder = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    folder.mkdir(parents=True, exist_ok=True)
    described = json.loads(subprocess.check_output([tool, "info", store, "--json"]))
    for name, tour in tours(described["bounds"]).items():
        rows = replay(tool, store, tour, folder, name)
        title = f"{name}: {described['points']:,} points, {described['nodes']:,} nodes"
        plot(rows, tour, title, folder / f"{name}.png")
        print(folder / f"{name}.png")


if __name__ == "__main__":
    main()
