#!/usr/bin/python3
"""Measures what a larger error buys, on one store: points, bytes, time against all points.

    Testing/Benchmarks/error_tradeoff.py TOOL STORE [WORK_FOLDER]

Prints a Markdown table; the pictures stay in the work folder. Needs an X server (xvfb-run). Each
picture is a process of its own, so the times hold opening the store and a cold start of OpenGL; the
disk cache is warm after the first.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "Whole"))
import pictures  # noqa: E402 (found by the line above)

ERRORS_PX = [0.05, 0.25, 0.5, 1, 2, 4, 8, 16]
VIEWS = ["iso", "top"]


def render(tool, store, work, view, error_px):
    name = f"{view}_{error_px}"
    picture, statistics = work / f"{name}.png", work / f"{name}.json"
    subprocess.run(
        [tool, "render", store, "-o", picture, "--size", "1280x720", "--view", view,
         "--error", str(error_px), "--point-size", "2", "--stats", statistics],
        check=True, stdout=subprocess.DEVNULL)
    return pictures.read_png(picture), json.loads(statistics.read_text())


def main():
    tool, store = sys.argv[1:3]
    work = pathlib.Path(sys.argv[3] if len(sys.argv) > 3 else tempfile.mkdtemp())
    work.mkdir(parents=True, exist_ok=True)
    print("| view | error, px | points drawn | MB read | complete, ms "
          "| pixels within 8 of all points, % |")
    print("| --- | ---: | ---: | ---: | ---: | ---: |")
    for view in VIEWS:
        reference, _ = render(tool, store, work, view, ERRORS_PX[0])
        for error_px in ERRORS_PX:
            picture, statistics = render(tool, store, work, view, error_px)
            alike = 100 * pictures.share_alike(picture, reference)
            print(f"| {view} | {error_px:g} | {statistics['points_drawn']:,} "
                  f"| {statistics['bytes_read'] / 1e6:.1f} "
                  f"| {statistics['time_to_complete_ms']:.0f} | {alike:.2f} |", flush=True)


if __name__ == "__main__":
    main()
