#!/usr/bin/python3
"""The cost of a build of tiles beside that of a build of everything.

usage: Testing/Benchmarks/tiles.py TOOL [--points N] [--tile METRES] [--runs N] [--work DIR]
       [--package DIR --workers N --inputs N] [--memory SIZE]

Generates a cloud as LAS and LAZ. Builds each as one store and as tiles, in turn, RUNS times, with
and without normals, one thread each. Prints the processor seconds (user and system, of the process)
of the medians, their ratio, and the largest resident memory of a process. docs/adr/0049 explains
them.

With --package (the folder that the Python package `pointfront` of the same build lies in), also
builds LAZ with normals by `cluster build` with one process and with N, of one thread each: as many
files as --inputs says, of --points each, over one ground. One process surveys each file.
Prints seconds on the clock, their ratio, which means something on a machine that does nothing else,
and the largest resident memory of any process (generating and Dask's included) beside --memory.
"""

import argparse
import json
import os
import pathlib
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

from programs import call

KINDS = {"": [], "normals": ["--normals", "pca"]}


def measured(command, environment=None):
    """Processor seconds of the command and what it started, seconds, its output."""
    before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True,
                          check=False, env={**os.environ, **(environment or {})})
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: status {done.returncode}\n{done.stderr}")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return (after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime,
            time.monotonic() - begin, json.loads(done.stdout))


def compare(tool, work, args, source, options):
    """One store and tiles, in turn: medians of processor seconds, the last reports."""
    store, land = work / "one.pfront", work / "land"
    common = ["--json", "--progress", "none", "--threads", 1, "--memory", args.memory, *options]
    seconds = {"store": [], "tiles": []}
    for _ in range(args.runs):
        used, _, one = measured([tool, "build", source, "-o", store, "--force", *common])
        seconds["store"].append(used)
        shutil.rmtree(land, ignore_errors=True)
        used, _, many = measured(
            [tool, "build", source, "-o", land, "--tiles", "--tile", args.tile, *common])
        seconds["tiles"].append(used)
        if one["points_stored"] != many["points_stored"]:
            sys.exit(f"{source.name}: the tiles have other points than the store")
    return {kind: statistics.median(runs) for kind, runs in seconds.items()}, one, many


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("tool", type=pathlib.Path)
    parser.add_argument("--points", type=int, default=2_000_000)
    parser.add_argument("--tile", type=float, default=160.0)
    parser.add_argument("--runs", type=int, default=3, help="0: only the cluster")
    parser.add_argument("--work", type=pathlib.Path)
    parser.add_argument("--package", type=pathlib.Path)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--inputs", type=int, default=4)
    parser.add_argument("--memory", default="1G")
    args = parser.parse_args()
    tool = args.tool.resolve()
    with tempfile.TemporaryDirectory(dir=args.work) as folder:
        work = pathlib.Path(folder)
        if args.runs:
            print(f"{'input':18}{'tiles':>6}{'store s':>9}{'tiles s':>9}{'ratio':>7}{'MiB':>6}"
                  f"{'spilled MB':>12}")
        for extension in ("las", "laz") if args.runs else ():
            source = work / f"cloud.{extension}"
            call(tool, "generate", "--points", args.points, "-o", source, "--seed", 3,
                 "--progress", "none")
            for kind, options in KINDS.items():
                seconds, _, many = compare(tool, work, args, source, options)
                print(f"{extension + ' ' + kind:18}{many['tiles']:6}{seconds['store']:9.2f}"
                      f"{seconds['tiles']:9.2f}{seconds['tiles'] / seconds['store']:7.2f}"
                      f"{many['peak_rss_bytes'] / 2**20:6.0f}{many['spilled_bytes'] / 1e6:12.0f}",
                      flush=True)
        if args.package:
            cluster(tool, work, args)


def cluster(tool, work, args):
    """One process and several, on the clock."""
    sources = work / "inputs"
    sources.mkdir()
    for seed in range(1, args.inputs + 1):
        call(tool, "generate", "--points", args.points, "-o", sources / f"{seed}.laz",
             "--seed", seed, "--progress", "none")
    clock = {}
    for workers in (1, args.workers):
        land = work / f"cluster-{workers}"
        used, clock[workers], _ = measured(
            [sys.executable, "-m", "pointfront", "cluster", "build", sources, "-o", land,
             "--tile", args.tile, "--local", workers, "--threads", 1, "--memory", args.memory,
             "--normals", "pca", "--json", "--progress", "none"],
            {"PYTHONPATH": str(args.package.resolve())})
        print(f"cluster, {workers} processes: {clock[workers]:.1f} s, {used:.1f} s of processors")
    largest = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    print(f"{args.workers} processes: {clock[1] / clock[args.workers]:.2f} times one; largest "
          f"process {largest:.0f} MiB, --memory {args.memory}")


if __name__ == "__main__":
    main()
