#!/usr/bin/python3
"""Measures a frame of each technique: over the points, far and near, against VTK's mappers.

    xvfb-run -a Testing/Benchmarks/technique_cost.py --build build/release --work FOLDER STORE

Prints two Markdown tables. STORE has normals (build --normals pca) and rgb.

1. Milliseconds a frame (median of an orbit) with so many points, every one of them drawn. Rows of
   VTK draw as many random points of the store from memory, from the same cameras: 1-px points by
   vtkPolyDataMapper, opaque discs of 0.85 spacings by vtkPointGaussianMapper (LAYERS figure 8).
2. Far (an orbit) and near (a flight) with points at most 1 pixel apart, with a third of the memory
   that all points take: median and 95 % of the frames, and how many points the median frame has
   (LAYERS table 2).
"""

import argparse
import json
import math
import pathlib
import statistics
import sys
import time

import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

from programs import call

SIZE = (1280, 720)
TECHNIQUES = {
    "points, 1 px": {"technique": "points", "size": {"mode": "fixed", "px": 1}},
    "paraboloid discs": {"technique": "splats", "orientation": "view"},
    "ellipses": {"technique": "splats"},
    "ellipses, blended": {"technique": "splats", "blended": True},
    "EWA": {"technique": "ewa"},
    "spheres": {"technique": "spheres"},
    "silhouettes": {"technique": "silhouettes"},
}
DISC = """//VTK::Color::Impl
if (dot(offsetVCVSOutput.xy, offsetVCVSOutput.xy) > 1.0) { discard; }
"""


class PointFront:
    def __init__(self, options):
        self.options = options
        self.tool = options.build / "bin/pointfront"
        for name, style in TECHNIQUES.items():
            self.style(name).write_text(json.dumps({"default": style}))

    def style(self, name):
        return self.options.work / ("".join(c if c.isalnum() else "_" for c in name) + ".json")

    def bench(self, name, backend, *words):
        out = self.options.work / "bench.json"
        call(self.tool, "bench", self.options.store, "--backend", backend, "--stats", out,
             "--style", self.style(name), "--size", "x".join(map(str, SIZE)), "--grow-ms", 0,
             *words)
        return json.loads(out.read_text())

    def orbit_ms(self, name, backend, points):
        # The first frames load: their time and points are not in the medians of so many.
        told = self.bench(name, backend, "--path", "orbit", "--frames", 8 * self.options.frames,
                          "--error", 0.01, "--point-budget", points)
        drawn = told["points_drawn"]["p50"]
        if drawn < 0.7 * points:
            sys.exit(f"{name}: {drawn} of {points} points were drawn")
        return told["frame_ms"]["p50"]


class VTKMappers:
    """The store's points in memory, drawn by VTK's own mappers."""

    def __init__(self, options, tool):
        self.options = options
        path = options.work / "all.ply"
        if not path.exists():
            call(tool, "export", options.store, "-o", path)
        reader = vtk.vtkPLYReader()
        reader.SetFileName(str(path))
        reader.Update()
        cloud = reader.GetOutput()
        self.places = vtk_to_numpy(cloud.GetPoints().GetData())
        self.order = numpy.random.default_rng(1).permutation(len(self.places))
        self.colours = vtk_to_numpy(cloud.GetPointData().GetScalars())[:, :3]

    def cloud(self, points):
        chosen = numpy.sort(self.order[:points])
        places = vtk.vtkPoints()
        places.SetData(numpy_to_vtk(self.places[chosen], deep=True))
        cloud = vtk.vtkPolyData()
        cloud.SetPoints(places)
        colours = numpy_to_vtk(numpy.ascontiguousarray(self.colours[chosen]), deep=True)
        cloud.GetPointData().SetScalars(colours)
        cells = vtk.vtkCellArray()
        cells.InsertNextCell(len(chosen), range(len(chosen)))
        cloud.SetVerts(cells)
        return cloud

    def orbit_ms(self, kind, points):
        cloud = self.cloud(points)
        low, high = numpy.reshape(cloud.GetBounds(), (3, 2)).T
        if kind == "points":
            mapper = vtk.vtkPolyDataMapper()
        else:
            mapper = vtk.vtkPointGaussianMapper()
            spacing = math.sqrt((high[0] - low[0]) * (high[1] - low[1]) / points)
            mapper.SetScaleFactor(0.85 * spacing)
            mapper.EmissiveOff()
            mapper.SetTriangleScale(1.8)
            mapper.SetSplatShaderCode(DISC)
        mapper.SetInputData(cloud)
        actor = vtk.vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().LightingOff()
        renderer = vtk.vtkRenderer()
        renderer.AddActor(actor)
        window = vtk.vtkRenderWindow()
        window.SetOffScreenRendering(1)
        window.SetMultiSamples(0)
        window.SetSize(*SIZE)
        window.AddRenderer(renderer)
        renderer.GetActiveCamera().SetViewUp(0, 0, 1)
        renderer.GetActiveCamera().SetPosition(0, -1, 0.7)
        renderer.ResetCamera()
        window.Render()  # compiles and uploads
        pixel = vtk.vtkUnsignedCharArray()
        times = []
        for _ in range(self.options.frames):
            renderer.GetActiveCamera().Azimuth(360 / self.options.frames)
            begin = time.perf_counter()
            window.Render()
            window.GetPixelData(0, 0, 0, 0, 0, pixel, 0)  # waits for GL
            times.append(1e3 * (time.perf_counter() - begin))
        return statistics.median(times)


def over_points(options, cloud):
    counts = options.points
    print("| ms a frame, points | " + " | ".join(f"{n / 1e6:g} M" for n in counts) + " |")
    print("| --- |" + " ---: |" * len(counts))

    def row(label, measure):
        print(f"| {label} | " + " | ".join(f"{measure(n):.0f}" for n in counts) + " |", flush=True)

    peers = VTKMappers(options, cloud.tool)
    row("vtkPolyDataMapper, 1 px", lambda n: peers.orbit_ms("points", n))
    row("vtkPointGaussianMapper, opaque discs", lambda n: peers.orbit_ms("discs", n))
    for backend in options.backends:
        for name in TECHNIQUES:
            row(f"{name}, {backend}", lambda n, b=backend, t=name: cloud.orbit_ms(t, b, n))


def far_and_near(options, cloud):
    told = json.loads(call(cloud.tool, "info", options.store, "--json"))
    memory = int(told["points"] * 20 / 3)
    print(f"\n| at 1 px, {memory / 1e6:.0f} MB | far: p50 / p95, ms | points "
          "| near: p50 / p95, ms | points |")
    print("| --- | ---: | ---: | ---: | ---: |")
    for backend in options.backends:
        for name in TECHNIQUES:
            cells = []
            for path in ("orbit", "flight"):
                one = cloud.bench(name, backend, "--path", path, "--frames", 4 * options.frames,
                                  "--memory", memory)
                cells += [f"{one['frame_ms']['p50']:.0f} / {one['frame_ms']['p95']:.0f}",
                          f"{one['points_drawn']['p50'] / 1e6:.2f} M"]
            print(f"| {name}, {backend} | " + " | ".join(cells) + " |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("store", metavar="STORE")
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    parser.add_argument("--points", type=lambda text: [int(float(n)) for n in text.split(",")],
                        default=[100_000, 300_000, 1_000_000, 3_000_000])
    parser.add_argument("--frames", type=int, default=8)
    parser.add_argument("--backends", type=lambda text: text.split(","),
                        default=["software", "opengl"])
    options = parser.parse_args()
    options.work.mkdir(parents=True, exist_ok=True)
    cloud = PointFront(options)
    over_points(options, cloud)
    far_and_near(options, cloud)


if __name__ == "__main__":
    main()
