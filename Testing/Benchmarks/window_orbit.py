#!/usr/bin/python3
"""Measures a frame in motion through a VTK window: front, drawing, hand-over and swap.

    PYTHONPATH=build/release/lib/python3/dist-packages xvfb-run -a \\
      Testing/Benchmarks/window_orbit.py STORE [--frames 120] [--frame-ms 33] \\
        [--backend software] [--runs 1]

STORE has rgb, and normals (build --normals pca). The camera goes around the whole cloud once in
FRAMES frames of 1280 x 720 pixels, as an interactor would move it (an update rate above 1). The
first quarter of the frames teaches the mapper what a frame costs, and is not in the figures.
Prints a Markdown table: milliseconds a frame (median, 95 %), the worst error in pixels and the
median of the points. "nothing" is the window with the cloud hidden. With --runs all styles are
drawn in turn so often, and a cell spans what the runs gave.
"""

import argparse
import json
import sys
import time

import pointfront
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401: the factory of windows
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer, vtkRenderWindow

STYLES = {
    "nothing": None,
    "points, 1 px": {"technique": "points", "size": {"mode": "fixed", "px": 1}},
    "paraboloid discs": {"technique": "splats", "orientation": "view"},
    "paraboloid discs, blended": {"technique": "splats", "orientation": "view", "blended": True},
    "ellipses": {"technique": "splats"},
    "ellipses, blended": {"technique": "splats", "blended": True},
    "EWA": {"technique": "ewa"},
}


def window_of(store, style, given):
    """A window with the store in it, and the mapper."""
    reader = pointfront.vtkPointFrontReader()
    reader.SetFileName(store)
    reader.Update()
    if reader.GetErrorCode() != 0:
        sys.exit(1)
    look = pointfront.vtkPointFrontStyle()
    if not look.LoadJSON(json.dumps({"default": style or {}})):
        sys.exit(1)
    mapper = pointfront.vtkPointFrontMapper()
    mapper.SetInputConnection(reader.GetOutputPort())
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("rgb")
    mapper.SetStyle(look)
    mapper.SetTargetFrameTime(given.frame_ms)
    getattr(mapper, "SetBackendTo" + {"opengl": "OpenGL"}.get(given.backend,
                                                             given.backend.capitalize()))()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.SetVisibility(style is not None)
    renderer = vtkRenderer()
    renderer.AddActor(actor)
    window = vtkRenderWindow()
    window.SetMultiSamples(0)
    window.SetSize(1280, 720)
    window.AddRenderer(renderer)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(1, -1, 1)
    camera.SetFocalPoint(0, 0, 0)
    camera.SetViewUp(0, 0, 1)
    renderer.ResetCamera(mapper.GetBounds())
    camera.Zoom(1.5)
    return window, renderer, mapper


def orbit(store, style, given):
    """(milliseconds, error in pixels, points) of each frame but the first quarter."""
    window, renderer, mapper = window_of(store, style, given)
    mapper.CompleteOn()
    window.Render()  # everything of this view is in memory
    mapper.CompleteOff()
    window.SetDesiredUpdateRate(30.0)
    frames = []
    for _ in range(given.frames):
        renderer.GetActiveCamera().Azimuth(360.0 / given.frames)
        renderer.ResetCameraClippingRange()
        begin = time.perf_counter()
        window.Render()
        window.WaitForCompletion()
        frames.append(((time.perf_counter() - begin) * 1e3, mapper.GetLastError(),
                       mapper.GetLastPointsDrawn()))
    return frames[given.frames // 4:]


def share(values, part):
    ordered = sorted(values)
    return ordered[min(int(part * len(ordered)), len(ordered) - 1)]


def cell(values, form):
    """Returns the runs' values, from the least to the most."""
    texts = [format(value, form) for value in sorted(values)]
    return texts[0] if texts[0] == texts[-1] else f"{texts[0]} to {texts[-1]}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("store")
    parser.add_argument("--frames", type=int, default=120)
    parser.add_argument("--frame-ms", type=float, default=33.0)
    parser.add_argument("--backend", choices=("automatic", "software", "opengl"),
                        default="software")
    parser.add_argument("--runs", type=int, default=1)
    given = parser.parse_args()
    runs = []
    for _ in range(given.runs):
        runs.append({name: list(zip(*orbit(given.store, style, given)))
                     for name, style in STYLES.items()})
    print("| in motion | ms a frame, median | 95 % | error, px, worst | points |")
    print("| --- | ---: | ---: | ---: | ---: |")
    for name in STYLES:
        times, errors, points = zip(*(run[name] for run in runs))
        print(f"| {name} | {cell([share(t, .5) for t in times], '.1f')} "
              f"| {cell([share(t, .95) for t in times], '.1f')} "
              f"| {cell([max(e) for e in errors], '.2f')} "
              f"| {cell([share(p, .5) / 1e6 for p in points], '.2f')} M |")


if __name__ == "__main__":
    main()
