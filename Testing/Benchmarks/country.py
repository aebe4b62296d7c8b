#!/usr/bin/python3
"""The cost of building a cloud of 10^11 points as tiles on a cluster: bytes, hours, dollars.

usage: Testing/Benchmarks/country.py TOOL [--sample N] [--points N] [--tile-points N] [--cores N]
       [--efficiency SHARE] [--rate GB] [--core-hour USD] [--gigabyte-month USD] [--work DIR]

Measured: generates SAMPLE points as LAZ and builds them as some sixteen tiles with normals and
heights above ground, one thread, points decoded once. That gives, for a point, the processor
seconds and the bytes of its input, of what is kept until the tiles are done, and of the tiles. ADR
0048 has the bytes and seconds of a collection of 10,000 tiles.

Computed: all of these grow with the points, the collection with the tiles. Processors take
POINTS * seconds / (CORES * EFFICIENCY): EFFICIENCY is what more workers cost than one, measured
with two (workers.py). The shared storage carries each byte of the inputs once, of kept
points twice (written, read), of tiles once, RATE gigabytes a second. The build lasts as long as the
slower of the two, and the making of the collection, which one process does. Small tiles have
relatively large margins, so the sample's seconds are an upper bound.

Prices are assumptions: give those of the cluster. docs/user/cluster.md has the table.
"""

import argparse
import json
import pathlib
import resource
import tempfile

from programs import call

# A tile of a collection that has thousands takes so much: ADR 0048.
MAKING, LISTED = 10.7 / 10000, 38e6 / 10000  # seconds, bytes
DENSITY = 11.1  # points a square metre that `generate` makes


def measure(tool, work, points):
    """The processor seconds and bytes that one point takes."""
    survey, land = work / "survey.laz", work / "land"
    call(tool, "generate", "--points", points, "-o", survey, "--seed", 3, "--progress", "none")
    edge = (points / DENSITY) ** 0.5 / 3
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    told = json.loads(call(
        tool, "build", survey, "-o", land, "--tiles", "--tile", f"{edge:.0f}", "--normals", "pca",
        "--height-above-ground", "--decode", "once", "--threads", 1, "--memory", "1G", "--json",
        "--progress", "none"))
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    kept = json.loads((land / "work/tiles.json").read_text())["kept_bytes"]
    tiles = sum(file.stat().st_size for file in (land / "tiles").iterdir())
    return {"tiles": told["tiles"],
            "seconds": (after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
                       / points,
            "input": survey.stat().st_size / points, "kept": kept / points,
            "stored": tiles / points, "peak": told["peak_rss_bytes"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("tool", type=pathlib.Path)
    parser.add_argument("--sample", type=int, default=4_000_000)
    parser.add_argument("--points", type=float, default=1e11)
    parser.add_argument("--tile-points", type=float, default=1e7)
    parser.add_argument("--cores", type=int, default=320)
    parser.add_argument("--efficiency", type=float, default=0.97)
    parser.add_argument("--rate", type=float, default=2.0, help="GB/s of the shared storage")
    parser.add_argument("--core-hour", type=float, default=0.05, help="US dollars")
    parser.add_argument("--gigabyte-month", type=float, default=0.023, help="US dollars")
    parser.add_argument("--work", type=pathlib.Path)
    args = parser.parse_args()
    with tempfile.TemporaryDirectory(dir=args.work) as folder:
        one = measure(args.tool.resolve(), pathlib.Path(folder), args.sample)
    print(f"measured with {args.sample / 1e6:.0f} M points in {one['tiles']} tiles, one thread, "
          f"peak memory {one['peak'] / 2**20:.0f} MiB:\n"
          f"  {1e6 * one['seconds']:.2f} s of a processor for a million points\n"
          f"  a point: {one['input']:.1f} bytes of LAZ, {one['kept']:.1f} kept meanwhile, "
          f"{one['stored']:.1f} in tiles")
    tiles = args.points / args.tile_points
    hours = args.points * one["seconds"] / args.cores / args.efficiency / 3600
    carried = args.points * (one["input"] + 2 * one["kept"] + one["stored"])
    carrying = carried / (args.rate * 1e9) / 3600
    total = max(hours, carrying) + tiles * MAKING / 3600
    stored = args.points * one["stored"]
    print(f"computed for {args.points:.0e} points in {tiles:.0f} tiles on {args.cores} cores:\n"
          f"  inputs {args.points * one['input'] / 1e12:.2f} TB, kept meanwhile "
          f"{args.points * one['kept'] / 1e12:.2f} TB, tiles {stored / 1e12:.2f} TB, collection "
          f"{tiles * LISTED / 1e6:.0f} MB\n"
          f"  processors {hours:.1f} h, storage {carrying:.1f} h, making the collection "
          f"{tiles * MAKING:.0f} s: {total:.1f} h\n"
          f"  {total * args.cores * args.core_hour:.0f} dollars for {total * args.cores:.0f} core "
          f"hours, {stored / 1e9 * args.gigabyte_month:.0f} dollars a month for the tiles")


if __name__ == "__main__":
    main()
