#!/usr/bin/python3
"""A survey of many files: one store of all, and tiles by one worker and by several.

usage: Testing/Benchmarks/workers.py TOOL --package DIR [--inputs N] [--points N] [--workers N]
       [--tile METRES] [--memory SIZE] [--decode once|twice] [--several-only] [--kill SECONDS]
       [--potree PotreeConverter] [--work DIR] [-- OPTIONS OF THE BUILD]

DIR is the folder that the Python package `pointfront` of the same build lies in. Generates INPUTS
LAZ files of POINTS each that lie side by side, eight landscapes in turn. Builds one store with as
many threads as there are workers, then tiles by `cluster build` with one worker and with several,
of one thread each. Prints seconds on the clock, the ratios, which mean something on a machine that
does nothing else, and the largest resident memory of any process (Dask's included) beside --memory.
With --several-only, builds the tiles by several workers alone. --decode is that of `cluster build`.
With --potree, PotreeConverter 2 converts the same files, by Poisson sampling, on all processors.

With --kill, one more build by several workers loses a worker each SECONDS, and once the command
itself with its scheduler; it is given again until it ends, and its tiles must have the same bytes.
"""

import argparse
import contextlib
import hashlib
import json
import math
import os
import pathlib
import random
import shutil
import struct
import subprocess
import sys
import tempfile
import time

import psutil

from programs import call

# Bytes of a LAS header: offsets of x, y, z; largest and smallest value of each.
OFFSETS, BOUNDS = 155, 179


def place(source, target, column, row, edge):
    """A copy of a LAS or LAZ file that lies elsewhere: its header says so, no point is touched."""
    shutil.copyfile(source, target)
    with open(target, "r+b") as file:
        for axis, shift in enumerate((column * edge, row * edge)):
            for position in (OFFSETS + 8 * axis, BOUNDS + 16 * axis, BOUNDS + 16 * axis + 8):
                file.seek(position)
                value, = struct.unpack("<d", file.read(8))
                file.seek(position)
                file.write(struct.pack("<d", value + shift))


def survey(tool, folder, inputs, points):
    """Files side by side, and the edge of one."""
    landscapes = folder / "landscapes"
    landscapes.mkdir()
    for seed in range(1, min(8, inputs) + 1):
        call(tool, "generate", "--points", points, "-o", landscapes / f"{seed}.laz", "--seed", seed,
             "--progress", "none")
    bounds = json.loads(call(tool, "info", landscapes / "1.laz", "--json"))["bounds"]
    edge = math.ceil(bounds[3] - bounds[0])
    sources, columns = folder / "inputs", math.ceil(math.sqrt(inputs))
    sources.mkdir()
    for number in range(inputs):
        place(landscapes / f"{number % 8 + 1}.laz", sources / f"{number}.laz", number % columns,
              number // columns, edge)
    shutil.rmtree(landscapes)
    return sources, edge


class Measured:
    """A command that runs: seconds, and the largest resident memory of its processes."""

    def __init__(self, command, environment=None):
        self.begin, self.peak = time.monotonic(), 0
        self.output = tempfile.TemporaryFile("w+")
        self.process = subprocess.Popen([str(word) for word in command], stdout=self.output,
                                        stderr=subprocess.STDOUT, text=True,
                                        env={**os.environ, **(environment or {})})

    def family(self):
        with contextlib.suppress(psutil.Error):
            own = psutil.Process(self.process.pid)
            return [own, *own.children(recursive=True)]
        return []

    def wait(self, seconds):
        """Whether the command ended in this time; looks at the memory ten times a second."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            for process in self.family():
                with contextlib.suppress(psutil.Error):
                    self.peak = max(self.peak, process.memory_info().rss)
            with contextlib.suppress(subprocess.TimeoutExpired):
                self.process.wait(0.1)
                return True
        return False

    def seconds(self):
        while not self.wait(60):
            pass
        took = time.monotonic() - self.begin
        if self.process.returncode != 0:
            self.output.seek(0)
            sys.exit(f"{' '.join(self.process.args)}: status {self.process.returncode}\n"
                     f"{self.output.read()}")
        return took


def beset(command, environment, every):
    """Runs the command until it ends well, while workers die, and once it does itself."""
    draw, begin, deaths = random.Random(3), time.monotonic(), 0
    running = Measured(command, environment)
    while not running.wait(every):
        if deaths == 2:
            family = running.family()
            for process in family:
                with contextlib.suppress(psutil.Error):
                    process.kill()
            running.process.wait()
            running = Measured(command, environment)
        else:
            workers = [process for process in running.family() if "spawn_main" in
                       " ".join(process.cmdline())]
            if workers:
                draw.choice(workers).kill()
        deaths += 1
    if running.process.returncode != 0:  # it gave up after many deaths: the same command goes on
        running = Measured(command, environment)
        running.seconds()
    return time.monotonic() - begin, deaths


def digests(land):
    """SHA-256 of each tile by its name: two surveys of 10^9 points need not be on disk at once."""
    found = {}
    for path in (land / "tiles").iterdir():
        with open(path, "rb") as file:
            found[path.name] = hashlib.file_digest(file, "sha256").hexdigest()
    return found


def compare(work, args, sources, common, told, cluster, environment):
    """Seconds of one store, of tiles by one worker and by several; the last tiles stay."""
    store = work / "one.pfront"
    one = told(f"one store, {args.workers} threads", Measured(
        [args.tool, "build", sources, "-o", store, "--threads", args.workers, *common]))
    store.unlink()
    clock = {}
    for workers in (1, args.workers):
        name = f"land-{workers}"
        clock[workers] = told(f"tiles, {workers} workers",
                              Measured(cluster(name, workers), environment))
        if workers == 1 and args.workers > 1:
            shutil.rmtree(work / name)
    several = clock[args.workers]
    print(f"{args.workers} workers: {clock[1] / several:.2f} times one; "
          f"{several / one:.2f} times the seconds of one store; --memory {args.memory}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("tool", type=pathlib.Path)
    parser.add_argument("--package", type=pathlib.Path, required=True)
    parser.add_argument("--inputs", type=int, default=40)
    parser.add_argument("--points", type=int, default=5_000_000)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--tile", type=float, help="(the edge of a file)")
    parser.add_argument("--memory", default="1G")
    parser.add_argument("--decode", choices=("once", "twice"), default="once")
    parser.add_argument("--several-only", action="store_true")
    parser.add_argument("--kill", type=float)
    parser.add_argument("--potree", type=pathlib.Path)
    parser.add_argument("--work", type=pathlib.Path)
    parser.add_argument("options", nargs="*")
    args = parser.parse_args()
    tool = args.tool = args.tool.resolve()
    environment = {"PYTHONPATH": str(args.package.resolve())}
    common = ["--memory", args.memory, "--json", "--progress", "none", *args.options]
    with tempfile.TemporaryDirectory(dir=args.work) as folder:
        work = pathlib.Path(folder)
        sources, edge = survey(tool, work, args.inputs, args.points)

        def cluster(name, workers):
            return [sys.executable, "-m", "pointfront", "cluster", "build", sources,
                    "-o", work / name, "--tile", args.tile or edge, "--local", workers,
                    "--threads", 1, "--decode", args.decode, *common]

        def told(name, running):
            took = running.seconds()
            print(f"{name}: {took:.1f} s, largest process {running.peak / 2**20:.0f} MiB",
                  flush=True)
            return took

        land = work / f"land-{args.workers}"
        if args.several_only:
            told(f"tiles, {args.workers} workers",
                 Measured(cluster(land.name, args.workers), environment))
        else:
            compare(work, args, sources, common, told, cluster, environment)
        if args.potree:
            told("PotreeConverter", Measured([args.potree, sources, "-o", work / "potree"]))
            shutil.rmtree(work / "potree")
        if args.kill:
            # A folder's name is the collection's, so the land with deaths has the same.
            calm = digests(land)
            shutil.rmtree(land)
            took, deaths = beset(cluster(land.name, args.workers), environment, args.kill)
            print(f"a death each {args.kill:g} s, {deaths} deaths: {took:.1f} s, "
                  f"{len(calm)} tiles, {'the same' if digests(land) == calm else 'OTHER'} bytes")


if __name__ == "__main__":
    main()
