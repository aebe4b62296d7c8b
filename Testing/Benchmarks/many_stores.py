#!/usr/bin/python3
"""One scene of many stores against one store of the same points.

    Testing/Benchmarks/many_stores.py TOOL ONE.pfront FOLDER_OF_STORES [--memory 128M]
                                      [--frame-ms MS] [--work DIR]

Both are drawn complete from the disk cache, then along the same orbit in motion, with the same
budgets. Prints a Markdown table: threads (the most of the process), memory, times, and the ratio of
many to one.
"""

import argparse
import json
import pathlib
import subprocess
import tempfile
import time

RUNS = 3
FRAMES = 120  # more than a second: what is loaded grows for a quarter of one (SMOOTH-6)


def run_and_count(command):
    """The most threads that the process ever had."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    threads = 0
    status = pathlib.Path(f"/proc/{process.pid}/status")
    while process.poll() is None:
        try:
            for line in status.read_text(encoding="ascii").splitlines():
                if line.startswith("Threads:"):
                    threads = max(threads, int(line.split()[1]))
        except (FileNotFoundError, ProcessLookupError):
            break
        time.sleep(0.02)
    if process.wait() != 0:
        raise SystemExit(f"{' '.join(map(str, command))}: status {process.returncode}")
    return threads


def measure(given, stores, work):
    stats = work / "stats.json"
    first, complete = [], []
    for _ in range(RUNS):
        subprocess.run([given.tool, "render", *stores, "-o", work / "still.png", "--memory",
                        given.memory, "--stats", stats], check=True, stdout=subprocess.DEVNULL)
        still = json.loads(stats.read_text())
        first.append(still["time_to_first_image_ms"])
        complete.append(still["time_to_complete_ms"])
    threads = run_and_count(
        [given.tool, "bench", *stores, "--path", "orbit", "--frames", str(FRAMES),
         "--interactive", "--frame-ms", str(given.frame_ms), "--settle", "--memory", given.memory,
         "--stats", stats])
    told = json.loads(stats.read_text())
    mib = 1 << 20
    return [
        ("points of the complete picture", still["points_drawn"]),
        ("its error, px", still["error_px"]),
        ("first picture, ms (least of 3)", min(first)),
        ("complete picture, ms (least of 3)", min(complete)),
        ("threads, all of the process", threads),
        ("peak RSS beside the empty scene's, MiB",
         (told["peak_rss_bytes"] - told["empty_scene_rss_bytes"]) / mib),
        ("decoded points in memory, MiB", told["resident_bytes_max"] / mib),
        ("points of a frame in motion, p50", told["points_drawn"]["p50"]),
        ("frame in motion, p50, ms", told["frame_ms"]["p50"]),
        ("frame in motion, p99, ms", told["frame_ms"]["p99"]),
        ("of it fronts, p50, ms", told["front_update_ms"]["p50"]),
        ("complete after the stop, ms", told["settle"]["ms"]),
    ]


def shown(value):
    """Whole numbers from 100 on, else three digits."""
    return f"{value:,.0f}" if value >= 100 or value == int(value) else f"{value:.3g}"


def main():
    options = argparse.ArgumentParser()
    options.add_argument("tool")
    options.add_argument("one")
    options.add_argument("folder", type=pathlib.Path)
    options.add_argument("--memory", default="128M")
    options.add_argument("--frame-ms", type=float, default=100.0)
    options.add_argument("--work", type=pathlib.Path)
    given = options.parse_args()
    work = given.work or pathlib.Path(tempfile.mkdtemp())
    work.mkdir(parents=True, exist_ok=True)
    stores = sorted(given.folder.glob("*.pfront"))
    one = measure(given, [given.one], work)
    many = measure(given, stores, work)
    print(f"| | 1 store | {len(stores)} stores | ratio |\n| --- | ---: | ---: | ---: |")
    for (name, single), (_, several) in zip(one, many):
        ratio = f"{several / single:.2f}" if single else "-"
        print(f"| {name} | {shown(single)} | {shown(several)} | {ratio} |")


if __name__ == "__main__":
    main()
