#!/usr/bin/python3
"""Time from a cold open to the first and to the complete picture, for stores of different sizes;
against loading points into a vtkPolyData.

    Testing/Benchmarks/first_image.py TOOL [--backends software,opengl]
        [--polydata FILE.las --points N] STORE...

Each run is a process of its own. "Cold": the store's pages are dropped from the disk cache before
(posix_fadvise; program and libraries stay warm). Times count from the start of the command to the
first frame with points, and to the frame that has all it needs; opening of the store, and of OpenGL
where that draws, included. Prints a Markdown table. OpenGL needs an X server (xvfb-run).

--polydata loads the first N points of an uncompressed LAS file (positions as float, colours, one
vertex a point: what vtkPolyDataMapper draws) and scales the time to the largest store. It draws
nothing.
"""

import argparse
import json
import os
import pathlib
import statistics
import struct
import subprocess
import tempfile
import time

RUNS = 5


def drop_from_cache(path):
    descriptor = os.open(path, os.O_RDONLY)
    os.fsync(descriptor)
    os.posix_fadvise(descriptor, 0, 0, os.POSIX_FADV_DONTNEED)
    os.close(descriptor)


def pictures(tool, store, backend, cold, work, frames=()):
    """Medians, the least time, and what the last run told, of RUNS runs."""
    milliseconds, told = [], {}
    name = "time_to_first_image_ms" if frames else "time_to_complete_ms"
    for _ in range(RUNS):
        if cold:
            drop_from_cache(store)
        report = work / "stats.json"
        subprocess.run([tool, "render", store, "-o", work / "a.png", "--size", "1280x720",
                        "--backend", backend, *frames, "--stats", report],
                       check=True, stdout=subprocess.DEVNULL)
        told = json.loads(report.read_text())
        milliseconds.append(told[name])
    return statistics.median(milliseconds), min(milliseconds), told


def row(tool, store, backend, work):
    """Prints a row of the table. The store's points and the slowest first picture."""
    points = json.loads(subprocess.check_output([tool, "info", store, "--json"]))["points"]
    one = ("--frames", "1")
    cold, cold_least, told = pictures(tool, store, backend, True, work, one)
    warm, warm_least, _ = pictures(tool, store, backend, False, work, one)
    complete, complete_least, whole = pictures(tool, store, backend, True, work)
    print(f"| {points:,} | {os.path.getsize(store) / 1e9:.2f} | {backend} "
          f"| {cold:.0f}, {cold_least:.0f} | {warm:.0f}, {warm_least:.0f} "
          f"| {told['points_drawn']:,} | {told['bytes_read'] / 1e6:.1f} "
          f"| {complete:.0f}, {complete_least:.0f} | {whole['points_drawn']:,} |", flush=True)
    return points, cold


def load_polydata(path, count):
    """Seconds to have `count` points of a LAS file in a vtkPolyData, and what that held."""
    import numpy
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

    with open(path, "rb") as file:
        header = file.read(375)
    offset, = struct.unpack_from("<I", header, 96)
    record, = struct.unpack_from("<H", header, 105)
    scale = struct.unpack_from("<3d", header, 131)
    rgb = {2: 20, 3: 28, 5: 28, 7: 30, 8: 30}.get(header[104] & 0x3F)
    drop_from_cache(path)
    begin = time.perf_counter()
    with open(path, "rb") as file:
        file.seek(offset)
        rows = numpy.frombuffer(file.read(count * record), numpy.uint8).reshape(count, record)
    steps = numpy.ascontiguousarray(rows[:, :12]).view("<i4")
    points = vtkPoints()
    points.SetData(numpy_to_vtk((steps * scale).astype(numpy.float32), deep=False))
    cloud = vtkPolyData()
    cloud.SetPoints(points)
    if rgb:
        colours = numpy.ascontiguousarray(rows[:, rgb:rgb + 6]).view("<u2") >> 8
        cloud.GetPointData().SetScalars(numpy_to_vtk(colours.astype(numpy.uint8), deep=True))
    vertices = vtkCellArray()
    vertices.SetData(numpy_to_vtkIdTypeArray(numpy.arange(count + 1), deep=True),
                     numpy_to_vtkIdTypeArray(numpy.arange(count), deep=True))
    cloud.SetVerts(vertices)
    return time.perf_counter() - begin, cloud.GetNumberOfPoints()


def main():
    options = argparse.ArgumentParser()
    options.add_argument("tool")
    options.add_argument("stores", nargs="+")
    options.add_argument("--backends", default="software")
    options.add_argument("--polydata")
    options.add_argument("--points", type=int, default=20_000_000)
    given = options.parse_args()
    work = pathlib.Path(tempfile.mkdtemp())
    print("| points | GB | drawn by | first, cold: median, fastest, ms | first, warm, ms "
          "| points in it | MB read | complete, cold, ms | points in it |")
    print("| ---: | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: |")
    largest, slowest = 0, 0.0
    for backend in given.backends.split(","):
        for store in given.stores:
            points, cold = row(given.tool, store, backend, work)
            largest, slowest = max(largest, points), max(slowest, cold)
    if given.polydata:
        seconds, loaded = load_polydata(given.polydata, given.points)
        scaled = seconds * largest / loaded
        print(f"\nvtkPolyData: {loaded:,} points in {seconds:.2f} s; {largest:,} would take "
              f"{scaled:.1f} s, {1000 * scaled / slowest:.0f} times the slowest first picture")


if __name__ == "__main__":
    main()
