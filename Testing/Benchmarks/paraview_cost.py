#!/usr/bin/python3
"""Measures a cloud in ParaView: as a store with the plugin, as PLY with ParaView's own means.

    xvfb-run -a Testing/Benchmarks/paraview_cost.py --build build/paraview --work FOLDER CLOUD.laz

Builds a store and exports it as PLY, once. Then runs pvbatch on each in turn, three times, and
prints one Markdown table: of each step the smallest wall time, and the largest memory of the
process so far (VmHWM).

    open            the reader's output is there
    first picture   1280 x 720, from above, in rgb, points of 2 pixels
    still frame     the camera has turned by a degree
    selection       what a rectangle of a sixteenth of the view shows, extracted
    extract         the points of a box that covers 1 % of the cloud's ground
    all points      a picture of every point

The plugin draws to a spacing of 1 pixel (Target Error), but for the last step; ParaView's Point
Gaussian draws all points always.
The build folder's cache says where ParaView's Python package is.
"""

import argparse
import json
import os
import pathlib
import re
import sys
import time

import programs

SIZE = [1280, 720]
STEPS = ("open", "first picture", "still frame", "selection", "extract of 1 %",
         "picture of all points")


def peak_gib():
    with open("/proc/self/status") as status:
        line = next(line for line in status if line.startswith("VmHWM"))
    return int(line.split()[1]) / 2 ** 20


def inside_run(way, path, plugin):
    """In pvbatch: the steps, as JSON."""
    from paraview import simple
    if way == "ours":
        simple.LoadPlugin(plugin, remote=False, ns=globals())
    results = []
    begin = [time.perf_counter()]

    def step(**facts):
        results.append({"seconds": time.perf_counter() - begin[0], "gib": peak_gib(), **facts})
        begin[0] = time.perf_counter()

    view = simple.CreateView("RenderView")
    view.ViewSize = SIZE
    view.OrientationAxesVisibility = 0
    simple.Render(view)
    begin[0] = time.perf_counter()
    if way == "ours":
        cloud = simple.OpenDataFile(path)
    else:
        cloud = simple.PLYReader(FileNames=[path])
    cloud.UpdatePipeline()
    bounds = cloud.GetDataInformation().GetBounds()
    step()

    display = simple.Show(cloud, view)
    if way == "ours":
        simple.ColorBy(display, ("POINTS", "rgb"))
        display.PointSize = 2
    else:
        display.SetRepresentationType("Point Gaussian")
        display.GaussianRadius = 0.0
        simple.ColorBy(display, ("POINTS", "RGB"))
        display.MapScalars = 0
    display.SetScalarBarVisibility(view, False)
    simple.ResetCamera(view)
    view.GetActiveCamera().Zoom(1.4)
    simple.Render(view)
    step()

    view.GetActiveCamera().Azimuth(1)
    simple.Render(view)
    step()

    width, height = (size // 8 for size in SIZE)
    rectangle = [SIZE[0] // 2 - width, SIZE[1] // 2 - height,
                 SIZE[0] // 2 + width, SIZE[1] // 2 + height]
    simple.SetActiveSource(cloud)
    simple.SelectSurfacePoints(Rectangle=rectangle, View=view)
    selected = simple.ExtractSelection(Input=cloud)
    selected.UpdatePipeline()
    step(points=selected.GetDataInformation().GetNumberOfPoints())
    simple.ClearSelection(cloud)

    low = [bounds[2 * axis] + 0.45 * (bounds[2 * axis + 1] - bounds[2 * axis]) for axis in (0, 1)]
    high = [bounds[2 * axis] + 0.55 * (bounds[2 * axis + 1] - bounds[2 * axis]) for axis in (0, 1)]
    begin[0] = time.perf_counter()
    if way == "ours":
        part = globals()["PointFrontExtract"](Input=cloud)
        part.Region = "Box"
        part.Region.Position = [*low, bounds[4] - 1]
        part.Region.Length = [high[0] - low[0], high[1] - low[1], bounds[5] - bounds[4] + 2]
    else:
        # Points of a PLY have no cells: they cannot be clipped, and a query is the quickest way.
        inside = " & ".join("(inputs[0].Points[:,%d] >= %.17g) & (inputs[0].Points[:,%d] <= %.17g)"
                            % (axis, low[axis], axis, high[axis]) for axis in (0, 1))
        simple.QuerySelect(QueryString=inside, FieldType="POINT", Source=cloud)
        part = simple.ExtractSelection(Input=cloud)
    part.UpdatePipeline()
    step(points=part.GetDataInformation().GetNumberOfPoints())
    if way == "ours":
        simple.Delete(part)
        display.TargetError, display.PointBudget = 0.01, 0
        begin[0] = time.perf_counter()
    simple.Render(view)
    if way == "ours":
        display.SMProxy.UpdatePropertyInformation()
        step(points=display.SMProxy.GetProperty("PointsDrawn").GetElement(0))
    else:
        step()
    print("RESULT " + json.dumps(results), flush=True)


def call(*words):
    begin = time.perf_counter()
    printed = programs.call(*words)
    return time.perf_counter() - begin, printed


def find_package(build):
    """Lets what is run find ParaView's Python package."""
    found = re.search(r"^POINTFRONT_PARAVIEW_PYTHON:PATH=(.+)$",
                      (build / "CMakeCache.txt").read_text(), flags=re.M)
    if found is None:
        sys.exit(f"{build}/CMakeCache.txt names no POINTFRONT_PARAVIEW_PYTHON: build the preset "
                 "paraview with its tests")
    known = os.environ.get("PYTHONPATH")
    os.environ["PYTHONPATH"] = os.pathsep.join([found.group(1), *([known] if known else [])])


def measured(options):
    find_package(options.build)
    tool = options.build / "bin/pointfront"
    plugin = next(options.build.glob("lib/paraview-*/plugins/PointFront/PointFront.so"))
    store, ply = options.work / "cloud.pfront", options.work / "cloud.ply"
    if not store.exists():
        call(tool, "build", options.cloud, "-o", store, "--progress", "none")
    if not ply.exists():
        call(tool, "export", store, "-o", ply)
    rounds = {"ours": [], "stock": []}
    for _ in range(options.rounds):
        for way, path in (("ours", store), ("stock", ply)):
            _, output = call(options.pvbatch, os.path.abspath(__file__), "--inside", way, path,
                             plugin)
            line = next(line for line in output.splitlines() if line.startswith("RESULT "))
            rounds[way].append(json.loads(line[len("RESULT "):]))
            print(way, *("%.2f" % one["seconds"] for one in rounds[way][-1]), file=sys.stderr)
    return rounds


def main():
    if "--inside" in sys.argv:
        inside_run(*sys.argv[sys.argv.index("--inside") + 1:])
        return
    options = argparse.ArgumentParser()
    options.add_argument("--build", type=lambda text: pathlib.Path(text).resolve(), required=True)
    options.add_argument("--work", type=lambda text: pathlib.Path(text).resolve(), required=True)
    options.add_argument("--rounds", type=int, default=3)
    options.add_argument("--pvbatch", default="pvbatch")
    options.add_argument("cloud", type=pathlib.Path)
    given = options.parse_args()
    given.work.mkdir(parents=True, exist_ok=True)
    load = os.getloadavg()[0]
    rounds = measured(given)
    print("| step | plugin, s | stock, s | plugin, GiB | stock, GiB | points: plugin, stock |")
    print("| --- | --- | --- | --- | --- | --- |")
    for at, step in enumerate(STEPS):
        cells = [step]
        for what, choose, form in (("seconds", min, "%.2f"), ("gib", max, "%.2f")):
            cells += [form % choose(one[at][what] for one in rounds[way])
                      for way in ("ours", "stock")]
        points = [rounds[way][0][at].get("points") for way in ("ours", "stock")]
        cells.append(", ".join("all" if count is None else f"{count:,}" for count in points)
                     if any(points) else "")
        print("| " + " | ".join(cells) + " |")
    print("\nload average, before and after: %.1f, %.1f on %d cores"
          % (load, os.getloadavg()[0], os.cpu_count()))


if __name__ == "__main__":
    main()
