#!/usr/bin/python3
"""A subset of the points against mean representatives: bytes, CPU time of the build, pictures.

    Testing/Benchmarks/refinement_tradeoff.py TOOL INPUT [WORK_FOLDER]

Builds the input as an octree with `add`, with `replace`, and as a kd-tree, one layer each, and
compares their pictures at several errors with the one of all points (of the first). Prints two
Markdown tables. Needs an X server (xvfb-run).
"""

import json
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "Whole"))
import pictures  # noqa: E402 (found by the line above)

ERRORS_PX = [1, 2, 4, 8]
BUILDS = {"octree, add": ["--structure", "octree", "--refinement", "add"],
          "octree, replace": ["--structure", "octree", "--refinement", "replace"],
          "kd-tree, add": ["--structure", "kdtree"]}


def run(*command):
    return subprocess.run([str(c) for c in command], check=True, stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL).stdout


def picture(tool, store, work, error_px):
    path, statistics = work / "picture.png", work / "picture.json"
    run(tool, "render", store, "-o", path, "--size", "1280x720", "--point-size", "auto",
        "--error", error_px, "--stats", statistics)
    return pictures.read_png(path), json.loads(statistics.read_text())


def main():
    tool, source = sys.argv[1:3]
    work = pathlib.Path(sys.argv[3] if len(sys.argv) > 3 else tempfile.mkdtemp())
    work.mkdir(parents=True, exist_ok=True)
    print("| store | bytes a point | nodes | CPU ns a point to build |")
    print("| --- | ---: | ---: | ---: |")
    stores = {}
    for name, options in BUILDS.items():
        store = work / (name.replace(", ", "-") + ".pfront")
        report = json.loads(run(tool, "build", source, "-o", store, "--force", "--layers", "none",
                                "--json", *options))
        described = json.loads(run(tool, "info", store, "--json"))
        points = described["points"]
        print(f"| {name} | {described['bytes'] / points:.2f} | {described['nodes']:,} "
              f"| {1e9 * report['cpu_seconds']['total'] / points:.0f} |", flush=True)
        stores[name] = store
    reference, _ = picture(tool, next(iter(stores.values())), work, 0.01)
    print("\n| store | error, px | points drawn | MB read | mean difference of a channel "
          "| pixels within 8, % |")
    print("| --- | ---: | ---: | ---: | ---: | ---: |")
    for name, store in stores.items():
        for error_px in ERRORS_PX:
            drawn, statistics = picture(tool, store, work, error_px)
            difference = abs(drawn.astype(int) - reference.astype(int)).mean()
            print(f"| {name} | {error_px} | {statistics['points_drawn']:,} "
                  f"| {statistics['bytes_read'] / 1e6:.1f} | {difference:.2f} "
                  f"| {100 * pictures.share_alike(drawn, reference):.2f} |", flush=True)


if __name__ == "__main__":
    main()
