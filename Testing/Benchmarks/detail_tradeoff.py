#!/usr/bin/python3
"""The two ways to choose detail on the same camera paths: rendering front and view-specific level.

    Testing/Benchmarks/detail_tradeoff.py TOOL STORE WORK_FOLDER [overview] [zoom]

Replays the paths of front_trace.py with --detail front and --detail view and prints a Markdown
table: time of an update, points, front moves and requests while the camera moves, and points and
error where it rests. Needs an X server (xvfb-run).
"""

import json
import pathlib
import statistics
import subprocess
import sys

import front_trace


def parts(rows, tour):
    """Rows of the moving stretches; the last row of each rest."""
    ends = [frame for frame, _ in tour.stretches[1:]] + [len(rows)]
    moving, rests = [], []
    for (begin, name), end in zip(tour.stretches, ends):
        if name == "rest":
            rests.append(rows[min(end, len(rows)) - 1])
        else:
            moving += rows[begin:end]
    return moving, rests


def column(rows, name):
    return [float(row[name]) for row in rows]


def main():
    tool, store, folder = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    described = json.loads(subprocess.check_output([tool, "info", store, "--json"]))
    print("| path | detail | update p50 / p99, ms | moving: points | moves | requests "
          "| at rest: points | error, px |")
    print("| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: |")
    tours = front_trace.tours(described["bounds"])
    for name in sys.argv[4:] or tours:
        tour = tours[name]
        for detail in ("front", "view"):
            work = folder / detail
            work.mkdir(parents=True, exist_ok=True)
            rows = front_trace.replay(tool, store, tour, work, name, ["--detail", detail])
            moving, rests = parts(rows, tour)
            update = sorted(column(moving, "front_ms"))
            print(f"| {name} | {detail} | {statistics.median(update):.2f} / "
                  f"{update[len(update) * 99 // 100]:.2f} "
                  f"| {statistics.median(column(moving, 'points')):,.0f} "
                  f"| {sum(column(moving, 'moves')):,.0f} "
                  f"| {sum(column(moving, 'requests')):,.0f} "
                  f"| {statistics.median(column(rests, 'points')):,.0f} "
                  f"| {statistics.median(column(rests, 'error_px')):.2f} |", flush=True)


if __name__ == "__main__":
    main()
