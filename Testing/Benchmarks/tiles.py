#!/usr/bin/python3
"""The cost of a build of tiles beside that of a build of everything.

usage: Testing/Benchmarks/tiles.py TOOL [--points N] [--tile METRES] [--runs N] [--work DIR]
       [--memory SIZE]

Generates a cloud as LAS and LAZ. Builds each as one store and as tiles, in turn, RUNS times, with
and without normals, one thread each. Prints the processor seconds (user and system, of the process)
of the medians, their ratio, and the largest resident memory of a process. docs/adr/0049 explains
them.
"""

import argparse
import json
import pathlib
import resource
import shutil
import statistics
import sys
import tempfile

from programs import call

KINDS = {"": [], "normals": ["--normals", "pca"]}


def measured(*command):
    """Processor seconds of the command, and its report."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    report = json.loads(call(*command))
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, report


def compare(tool, work, args, source, options):
    """One store and tiles, in turn: medians of processor seconds, the last reports."""
    store, land = work / "one.pfront", work / "land"
    common = ["--json", "--progress", "none", "--threads", 1, "--memory", args.memory, *options]
    seconds = {"store": [], "tiles": []}
    for _ in range(args.runs):
        used, one = measured(tool, "build", source, "-o", store, "--force", *common)
        seconds["store"].append(used)
        shutil.rmtree(land, ignore_errors=True)
        used, many = measured(
            tool, "build", source, "-o", land, "--tiles", "--tile", args.tile, *common)
        seconds["tiles"].append(used)
        if one["points_stored"] != many["points_stored"]:
            sys.exit(f"{source.name}: the tiles have other points than the store")
    return {kind: statistics.median(runs) for kind, runs in seconds.items()}, one, many


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("tool", type=pathlib.Path)
    parser.add_argument("--points", type=int, default=2_000_000)
    parser.add_argument("--tile", type=float, default=160.0)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--work", type=pathlib.Path)
    parser.add_argument("--memory", default="1G")
    args = parser.parse_args()
    tool = args.tool.resolve()
    with tempfile.TemporaryDirectory(dir=args.work) as folder:
        work = pathlib.Path(folder)
        print(f"{'input':18}{'tiles':>6}{'store s':>9}{'tiles s':>9}{'ratio':>7}{'MiB':>6}"
              f"{'spilled MB':>12}")
        for extension in ("las", "laz"):
            source = work / f"cloud.{extension}"
            call(tool, "generate", "--points", args.points, "-o", source, "--seed", 3,
                 "--progress", "none")
            for kind, options in KINDS.items():
                seconds, _, many = compare(tool, work, args, source, options)
                print(f"{extension + ' ' + kind:18}{many['tiles']:6}{seconds['store']:9.2f}"
                      f"{seconds['tiles']:9.2f}{seconds['tiles'] / seconds['store']:7.2f}"
                      f"{many['peak_rss_bytes'] / 2**20:6.0f}{many['spilled_bytes'] / 1e6:12.0f}",
                      flush=True)


if __name__ == "__main__":
    main()
