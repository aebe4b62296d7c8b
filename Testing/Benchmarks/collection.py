#!/usr/bin/python3
"""A collection of many tiles against the same tiles as a list.

    Testing/Benchmarks/collection.py TOOL [--tiles 10000] [--stores 576] [--points 5000]
                                     [--work DIR]

Makes some stores and copies of them, and measures with the disk cache warm: to open, the first
picture, a complete far picture, how many tiles each opens, and one change of each kind. Prints a
Markdown table. Copies of a store lie in one place.
"""

import argparse
import json
import math
import pathlib
import resource
import shutil
import struct
import subprocess
import tempfile
import time

RUNS = 5
FAR = ["--view", "top", "--size", "200x120", "--backend", "software"]


def timed(command):
    """The least seconds of some runs."""
    least = float("inf")
    for _ in range(RUNS):
        begin = time.monotonic()
        subprocess.run([*map(str, command)], check=True, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL)
        least = min(least, time.monotonic() - begin)
    return least


def opened_tiles(command):
    """How many times the program opens a tile; None where nothing traces it."""
    if shutil.which("strace") is None:
        return None
    done = subprocess.run(["strace", "-f", "-e", "trace=openat", *map(str, command)], text=True,
                          check=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    return sum('.pfront"' in line and "ENOENT" not in line for line in done.stderr.splitlines())


def shifted(las, east, north):
    """Moves a LAS file's points: its header alone says where they are."""
    with open(las, "r+b") as file:
        header = bytearray(file.read(227))
        for axis, shift in enumerate((east, north)):
            for place in (155 + 8 * axis, 179 + 16 * axis, 187 + 16 * axis):
                value = struct.unpack_from("<d", header, place)[0]
                struct.pack_into("<d", header, place, value + shift)
        file.seek(0)
        file.write(header)


def make_tiles(given, work):
    """Stores that lie beside each other in a square, and copies of them, since a list takes links
    to one file once."""
    tiles, made = work / "tiles", work / "made.las"
    tiles.mkdir()
    subprocess.run([given.tool, "generate", "--points", str(given.points), "-o", made], check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    header = made.read_bytes()[:227]
    east = struct.unpack_from("<d", header, 179)[0] - struct.unpack_from("<d", header, 187)[0]
    north = struct.unpack_from("<d", header, 195)[0] - struct.unpack_from("<d", header, 203)[0]
    edge = math.isqrt(given.stores - 1) + 1
    stores = [work / f"made_{number}.pfront" for number in range(given.stores)]
    for number, store in enumerate(stores):
        las = work / "moved.las"
        shutil.copyfile(made, las)
        shifted(las, east * (number % edge), north * (number // edge))
        subprocess.run([given.tool, "build", las, "-o", store], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    for number in range(given.tiles):
        shutil.copyfile(stores[number % given.stores], tiles / f"tile_{number}.pfront")
    listed = work / "all.pfronts"
    listed.write_text("\n".join(f"tiles/tile_{n}.pfront" for n in range(given.tiles)))
    return tiles, listed


def changed(given, city, *words):
    """Processor seconds, which other work of the machine changes less than the clock's."""
    def spent():
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return usage.ru_utime + usage.ru_stime

    begin = spent()
    subprocess.run([given.tool, "collection", words[0], city, *map(str, words[1:])], check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return spent() - begin


def measure(given, work):
    tiles, listed = make_tiles(given, work)
    city, stats, picture = work / "city.pfcollection", work / "stats.json", work / "far.png"
    begin = time.monotonic()
    subprocess.run([given.tool, "collection", "create", city, tiles], check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    rows = [("created, s", time.monotonic() - begin, None),
            ("bytes of the file", city.stat().st_size, listed.stat().st_size)]
    pair = [city, listed]
    nothing = timed([given.tool, "--version"])

    def both(name, command):
        rows.append((name, *(timed(command(cloud)) - nothing for cloud in pair)))

    both("opened (`info --together`), s", lambda cloud: [given.tool, "info", "--together", cloud])
    first = lambda cloud: [given.tool, "render", cloud, "-o", picture, *FAR, "--frames", "1"]
    complete = lambda cloud: [given.tool, "render", cloud, "-o", picture, *FAR, "--stats", stats]
    both("first picture, s", first)
    both("complete far picture, s", complete)
    drawn = []
    for cloud in pair:
        subprocess.run([*map(str, complete(cloud))], check=True, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL)
        drawn.append(json.loads(stats.read_text()))
    for key in ("points_drawn", "nodes_drawn", "bytes_read", "peak_rss_bytes"):
        rows.append((f"... {key}", *(told[key] for told in drawn)))
    rows.append(("... tiles opened", *(opened_tiles(complete(cloud)) for cloud in pair)))
    extra = work / "extra.pfront"
    shutil.copyfile(work / "made_0.pfront", extra)
    rows.append(("add one tile, processor s", changed(given, city, "add", extra), None))
    rows.append(("replace it, processor s", changed(given, city, "replace", extra), None))
    rows.append(("remove it, processor s", changed(given, city, "remove", "extra"), None))
    rows.append(("undo that, processor s", changed(given, city, "undo"), None))
    return rows


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("tool")
    arguments.add_argument("--tiles", type=int, default=10000)
    arguments.add_argument("--stores", type=int, default=576)
    arguments.add_argument("--points", type=int, default=5000)
    arguments.add_argument("--work")
    given = arguments.parse_args()
    with tempfile.TemporaryDirectory(dir=given.work) as folder:
        rows = measure(given, pathlib.Path(folder))
    print(f"| {given.tiles:,} tiles of {given.points:,} points | collection | list |")
    print("|---|---|---|")
    for name, *values in rows:
        words = ["" if value is None else f"{value:.3f}" if isinstance(value, float)
                 else f"{value:,}" for value in values]
        print(f"| {name} | {' | '.join(words)} |")


if __name__ == "__main__":
    main()
