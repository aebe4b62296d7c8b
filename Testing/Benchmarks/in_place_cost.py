#!/usr/bin/python3
"""Measures a LAS file that is drawn in place against a store of its points.

    Testing/Benchmarks/in_place_cost.py TOOL CLOUD.las WORK_FOLDER

Prints a Markdown table. The points come in the order of the file, in lines as of an airborne
scanner, and shuffled. CPU time is of all threads of `pointfront index` and `pointfront build`.
Pictures (iso, 1280x720, points of 2 px at most 1 px apart) are from the disk cache, medians of
three.
"""

import json
import pathlib
import resource
import statistics
import struct
import sys

import numpy

from programs import call

RUNS = 3
STRIPS = 10  # the flight has so many
OFFSET_AT = 96  # LAS: where the points begin, 32 bits
RECORD_AT = 105  # bytes of a point, 16 bits


def in_lines(places):
    """Strips along y; the lines of a strip run along x and are as far apart as its points."""
    low, size = places.min(axis=0), numpy.ptp(places, axis=0).astype(float)
    spacing = (size[0] * size[1] / len(places)) ** 0.5
    x, y = (places - low).T
    return numpy.lexsort((x, y // spacing, x * STRIPS // (size[0] + 1)))


def shuffled(places):
    return numpy.random.default_rng(1).permutation(len(places))


def reorder(source, target, order_of):
    """Writes a LAS file's points in another order."""
    data = source.read_bytes()
    begin, = struct.unpack_from("<I", data, OFFSET_AT)
    record, = struct.unpack_from("<H", data, RECORD_AT)
    count = (len(data) - begin) // record
    rows = numpy.frombuffer(data, numpy.uint8, count * record, begin).reshape(count, record)
    order = order_of(numpy.ascontiguousarray(rows[:, :8]).view("<i4"))
    target.write_bytes(data[:begin] + rows[order].tobytes() + data[begin + count * record:])


def cpu_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def column(tool, cloud, way, work):
    """A cell for each row: what it costs to make the file, then what a picture of it costs."""
    made, told = work / f"{way}.{'pfindex' if way == 'index' else 'pfront'}", work / "drawn.json"
    before = cpu_seconds()
    report = json.loads(call(tool, way, cloud, "-o", made, "--force", "--json", "--progress",
                             "none"))
    nanoseconds = 1e9 * (cpu_seconds() - before)
    pictures = []
    for _ in range(RUNS):
        call(tool, "render", made, "-o", work / "drawn.png", "--view", "iso", "--size", "1280x720",
             "--point-size", 2, "--error", 1, "--stats", told)
        pictures.append(json.loads(told.read_text()))

    def of(name):
        return statistics.median(picture[name] for picture in pictures)

    points = report["points_read"]
    return [f"{nanoseconds / points:.0f}", f"{report['peak_rss_bytes'] / 2**20:.0f}",
            f"{report['bytes_written'] / points:.2f}",
            f"{points / report['runs']:,.1f}" if "runs" in report else "",
            f"{of('points_drawn'):,.0f}", f"{of('bytes_read') / 1e6:,.1f}",
            f"{of('time_to_first_image_ms'):,.0f}", f"{of('time_to_complete_ms'):,.0f}"]


ROWS = ("CPU to make it, ns a point", "peak RSS, MiB", "bytes a point, beside the LAS file",
        "points a run", "points drawn at 1 px", "MB read for that picture", "first image, ms",
        "complete at 1 px, ms")


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    tool, cloud, work = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    work.mkdir(parents=True, exist_ok=True)
    clouds = {"the file's order": cloud}
    for head, order_of in (("lines", in_lines), ("shuffled", shuffled)):
        clouds[head] = work / f"{head}.las"
        reorder(cloud, clouds[head], order_of)
    heads = [f"{made}, {head}" for head in clouds for made in ("index", "store")]
    columns = [column(tool, path, way, work) for path in clouds.values()
               for way in ("index", "build")]
    print("| | " + " | ".join(heads) + " |")
    print("| --- |" + " ---: |" * len(columns))
    for name, *cells in zip(ROWS, *columns):
        print(f"| {name} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
