#!/usr/bin/python3
"""A flight over a store with a small memory budget: do the budgets and the frame time hold?

    Testing/Benchmarks/flight.py TOOL STORE [--memory 256M] [--gpu-memory 64M] [--point-budget N]
                                 [--frame-ms MS] [--backend software] [--work DIR]

The back end opengl needs an X server (xvfb-run -a). Flies from a height down to the points and low
across the store, turns, and rushes off to another corner, faster than can be loaded; there the
camera stops. Before the flight the store is dropped from the disk cache. Prints a Markdown table:
what was asked, what came out, the ratio, and whether it holds. Mesa's own cache of shaders is
switched off, so that a read by the rendering thread is one of ours.

The bytes' own time: the bytes that were missing when the camera stopped, at the rates of this run:
read at the disk's (bytes over the time that reads took), then decoded by one thread (bytes over CPU
time).
"""

import argparse
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile

MIB = 1 << 20
ALLOWANCE = 64 * MIB  # held by a process beside its budgets and an empty scene


def flight(bounds):
    """Keys of the path: share of width and depth, height above the ground's lower part in shares of
    the longer side, heading, frames to the next key."""
    low, high = bounds[:3], bounds[3:]
    size = [high[axis] - low[axis] for axis in range(3)]
    longer = max(size[0], size[1])
    keys = [(0.15, 0.15, 0.080, (0.7, 0.7), 60), (0.40, 0.40, 0.016, (0.7, 0.7), 100),
            (0.60, 0.60, 0.016, (-0.3, 0.9), 60), (0.50, 0.75, 0.032, (-0.7, 0.1), 8),
            (0.20, 0.30, 0.024, (0.6, 0.6), 1)]
    cameras = []
    for across, along, height, heading, frames in keys:
        eye = [low[0] + across * size[0], low[1] + along * size[1],
               low[2] + 0.2 * size[2] + height * longer]
        ahead = [0.1 * longer * heading[0], 0.1 * longer * heading[1], -0.05 * longer]
        cameras.append({"position": eye, "focal_point": [e + a for e, a in zip(eye, ahead)],
                        "view_up": [0, 0, 1], "view_angle": 30, "frames": frames})
    return cameras


def drop_from_cache(path):
    descriptor = os.open(path, os.O_RDONLY)
    os.posix_fadvise(descriptor, 0, 0, os.POSIX_FADV_DONTNEED)
    os.close(descriptor)


def fly(given, work):
    info = json.loads(subprocess.check_output([given.tool, "info", given.store, "--json"]))
    path, stats, frames = work / "path.json", work / "flight.json", work / "flight.csv"
    path.write_text(json.dumps(flight(info["bounds"])))
    drop_from_cache(given.store)
    subprocess.run(
        [given.tool, "bench", given.store, "--path", path, "--interactive", "--settle",
         "--backend", given.backend,
         "--frame-ms", str(given.frame_ms), "--memory", given.memory,
         "--gpu-memory", given.gpu_memory, "--point-budget", str(given.point_budget),
         "--stats", stats, "--frames-csv", frames, "--picture", work / "flight.png"],
        check=True, stdout=subprocess.DEVNULL,
        env={**os.environ, "MESA_SHADER_CACHE_DISABLE": "true"})
    with open(frames, encoding="ascii") as file:
        rows = list(csv.DictReader(file))
    return info["points"], json.loads(stats.read_text()), rows


def bytes_time_ms(told):
    """At this run's rates."""
    all_of, needed = told["loading"], told["settle"]
    read = all_of["read_seconds"] / max(1, all_of["bytes_read"])
    decode = all_of["decode_cpu_seconds"] / max(1, all_of["bytes_decoded"])
    return 1e3 * (needed["bytes_read"] * read + needed["bytes_decoded"] * decode)


def report(points, told, rows, frame_ms):
    resident = max(int(row["resident_bytes"]) for row in rows)
    in_software = told["backend"] == "software"
    budget, gpu = told["budget_bytes"], 0 if in_software else told["gpu_budget_bytes"]
    allowed = budget + gpu + told["empty_scene_rss_bytes"] + ALLOWANCE
    settle, loading = told["settle"], told["loading"]
    own = bytes_time_ms(told)
    checks = [
        ("decoded points in memory, the most at any time, MiB",
         max(resident, told["resident_bytes_max"]) / MIB, budget / MIB),
        (f"peak RSS, MiB (limit: host {budget / MIB:.0f} + GPU {gpu / MIB:.0f} + empty scene "
         f"{told['empty_scene_rss_bytes'] / MIB:.0f} + {ALLOWANCE / MIB:.0f})",
         told["peak_rss_bytes"] / MIB, allowed / MIB),
        ("frame time, p99, ms", told["frame_ms"]["p99"], 2 * frame_ms),
        ("frames whose thread read from a file", told["frames_that_read_files"], 0),
        ("from the stop to the last byte, decoded, ms", settle["loaded_ms"], 1.2 * own),
    ]
    if not in_software:
        checks.insert(1, ("GPU memory for points, the most of any frame, MiB",
                          told["gpu_bytes_max"] / MIB, gpu / MIB))
    print(f"{points:,} points, {told['frames']} frames; drawn p50 "
          f"{told['points_drawn']['p50']:,}, most {told['points_drawn']['max']:,} points; frame "
          f"p50 {told['frame_ms']['p50']:.0f} ms, longest {told['frame_ms']['max']:.0f} ms")
    print(f"read {loading['bytes_read'] / MIB:.0f} MiB at "
          f"{loading['bytes_read'] / MIB / max(1e-9, loading['read_seconds']):.0f} MiB/s, decoded "
          f"{loading['bytes_decoded'] / MIB:.0f} MiB at "
          f"{loading['bytes_decoded'] / MIB / max(1e-9, loading['decode_cpu_seconds']):.0f} MiB/s "
          "a thread")
    print(f"after the stop: {settle['bytes_read'] / MIB:.1f} MiB read, "
          f"{settle['bytes_decoded'] / MIB:.1f} MiB decoded; complete picture after "
          f"{settle['ms']:.0f} ms, {settle['drawing_ms']:.0f} of them in {settle['frames']} "
          f"drawings; {settle['points_drawn']:,} points, {settle['error_px']:.2f} px\n")
    print("| what | measured | limit | ratio |")
    print("| --- | ---: | ---: | ---: |")
    held = settle["complete"]
    for name, value, limit in checks:
        held = held and value <= limit
        ratio = f"{value / limit:.2f}" if limit else ""
        print(f"| {name} | {value:.0f} | {limit:.0f} | {ratio} |")
    return held


def main():
    options = argparse.ArgumentParser()
    options.add_argument("tool")
    options.add_argument("store")
    options.add_argument("--memory", default="256M")
    options.add_argument("--gpu-memory", default="64M")
    options.add_argument("--point-budget", type=int, default=1_500_000)
    options.add_argument("--frame-ms", type=float, default=33.0)
    options.add_argument("--backend", default="software", choices=("software", "opengl"))
    options.add_argument("--work", type=pathlib.Path)
    given = options.parse_args()
    work = given.work or pathlib.Path(tempfile.mkdtemp())
    work.mkdir(parents=True, exist_ok=True)
    points, told, rows = fly(given, work)
    sys.exit(0 if report(points, told, rows, given.frame_ms) else 1)


if __name__ == "__main__":
    main()
