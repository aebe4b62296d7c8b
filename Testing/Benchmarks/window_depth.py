#!/usr/bin/python3
"""The depths of a picture that vtkPointFrontMapper draws, against the true ones.

    PYTHONPATH=build/bench/lib/python3/dist-packages xvfb-run -a \\
      Testing/Benchmarks/window_depth.py STORE FOLDER < CASES

FOLDER is one that `truth` wrote: camera.json, depth.f32 (distance along the view direction, 0
where there is no surface), mask.png. A line of CASES is a JSON object with "style" and "error_px".
Prints for each a JSON object: the median and 95 % of |depth - true depth| in units of the
coordinates, over the pixels where both have a surface.
"""

import json
import pathlib
import sys

import numpy
import pointfront
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401: the factory of windows
from vtkmodules.util import numpy_support
from vtkmodules.vtkCommonCore import vtkFloatArray
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer, vtkRenderWindow


class Window:
    """A store in a window with the camera of a folder of `truth`."""

    def __init__(self, store, folder):
        facts = json.loads((folder / "truth.json").read_text())
        self.size = facts["width"], facts["height"]
        reader = pointfront.vtkPointFrontReader()
        reader.SetFileName(store)
        reader.Update()
        if reader.GetErrorCode() != 0:
            sys.exit(1)
        self.mapper = pointfront.vtkPointFrontMapper()
        self.mapper.SetInputConnection(reader.GetOutputPort())
        self.mapper.SetScalarModeToUsePointFieldData()
        self.mapper.SelectColorArray("rgb")
        self.mapper.SetBackendToSoftware()
        self.mapper.CompleteOn()
        actor = vtkActor()
        actor.SetMapper(self.mapper)
        self.renderer = vtkRenderer()
        self.renderer.AddActor(actor)
        self.window = vtkRenderWindow()
        self.window.SetMultiSamples(0)
        self.window.SetOffScreenRendering(True)
        self.window.SetSize(*self.size)
        self.window.AddRenderer(self.renderer)
        seen = json.loads((folder / "camera.json").read_text())
        camera = self.renderer.GetActiveCamera()
        camera.SetPosition(seen["position"])
        camera.SetFocalPoint(seen["focal_point"])
        camera.SetViewUp(seen["view_up"])
        camera.SetViewAngle(seen["view_angle"])
        self.renderer.ResetCameraClippingRange()

    def depths(self, style, error_px):
        """Distances along the view direction, first row on top; infinite where nothing is."""
        look = pointfront.vtkPointFrontStyle()
        if not look.LoadJSON(json.dumps(style)):
            sys.exit(1)
        self.mapper.SetStyle(look)
        self.mapper.SetTargetError(error_px)
        self.window.Render()
        values = vtkFloatArray()
        width, height = self.size
        self.window.GetZbufferData(0, 0, width - 1, height - 1, values)
        z = numpy_support.vtk_to_numpy(values).reshape(height, width)[::-1].astype(float)
        near, far = self.renderer.GetActiveCamera().GetClippingRange()
        with numpy.errstate(divide="ignore"):
            return numpy.where(z < 1.0, far * near / (far - z * (far - near)), numpy.inf)


def main():
    folder = pathlib.Path(sys.argv[2])
    window = Window(sys.argv[1], folder)
    width, height = window.size
    truth = numpy.fromfile(folder / "depth.f32", numpy.float32).reshape(height, width)
    surface = numpy.isfinite(truth) & (truth > 0)
    for line in sys.stdin:
        case = json.loads(line)
        drawn = window.depths(case["style"], case["error_px"])
        both = surface & numpy.isfinite(drawn)
        off = numpy.abs(drawn[both] - truth[both])
        print(json.dumps({"depth_off_p50": float(numpy.quantile(off, .5)),
                          "depth_off_p95": float(numpy.quantile(off, .95))}), flush=True)


if __name__ == "__main__":
    main()
