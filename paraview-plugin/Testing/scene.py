"""One scene for every way to run ParaView: a store opened as File > Open does it, a fixed camera.

The application hands no arguments to its scripts, so all of them are told by the environment what
to use (see drive.py): POINTFRONT_PLUGIN, POINTFRONT_STORE, POINTFRONT_POINTS, POINTFRONT_CAMERA,
POINTFRONT_OUTPUT.
"""

import json
import os

from paraview import simple

SIZE = [640, 360]
PLUGIN = os.environ["POINTFRONT_PLUGIN"]
STORE = os.environ["POINTFRONT_STORE"]
POINTS = int(os.environ["POINTFRONT_POINTS"])  # in the store, each to be drawn once
OUTPUT = os.environ["POINTFRONT_OUTPUT"]


def require(condition, message):
    if not condition:
        raise AssertionError(message)


def moved(point, by):
    return [coordinate + offset for coordinate, offset in zip(point, by)]


class Scene:
    """A render view that shows the store and nothing else, so that pictures can be compared."""

    def __init__(self, view=None):
        self.view = view or simple.CreateView("RenderView")
        simple.SetActiveView(self.view)
        # As pointfront render draws: black behind, and no filter over the points.
        self.view.UseColorPaletteForBackground = 0
        self.view.BackgroundColorMode = "Single Color"
        self.view.Background = [0, 0, 0]
        self.view.OrientationAxesVisibility = 0
        self.view.UseFXAA = 0
        self.reader = simple.OpenDataFile(STORE)
        require(self.reader is not None, "no reader opens " + STORE)
        require(self.reader.GetXMLName() == "PointFrontReader",
                "opened by " + self.reader.GetXMLName())
        # Few, for the overview's nodes are loaded before the first frame.
        self.reader.OverviewPoints = 5000
        self.display = self.show(self.reader)
        require(self.display.Representation == "Point Front",
                "shown as " + str(self.display.Representation))
        self.display.TargetError = 0.01  # pixels: every point
        self.display.PointBudget = 0     # no limit

    def show(self, source):
        display = simple.Show(source, self.view)
        display.PointSize = 2
        self.look()  # after what is shown first has reset the camera
        return display

    def show_large(self):
        """All of a cloud whose points take longer to load than a frame may."""
        display = self.show(simple.OpenDataFile(os.environ["POINTFRONT_LARGE"]))
        display.TargetError, display.PointBudget = 0.01, 0
        self.view.SMProxy.ResetCamera()
        return display

    def look(self, by=(0.0, 0.0, 0.0)):
        if not os.environ["POINTFRONT_CAMERA"]:  # a cloud of which nobody has chosen a view
            self.view.CameraViewUp, self.view.CameraPosition = [0, 0, 1], [0.3, -2, 1.2]
            self.view.CameraFocalPoint = [0, 0, 0]
            self.view.SMProxy.ResetCamera()
            self.view.SMProxy.GetActiveCamera().Zoom(1.5)
            return
        with open(os.environ["POINTFRONT_CAMERA"]) as file:
            camera = json.load(file)
        self.view.CameraPosition = moved(camera["position"], by)
        self.view.CameraFocalPoint = moved(camera["focal_point"], by)
        self.view.CameraViewUp = camera["view_up"]
        self.view.CameraViewAngle = camera["view_angle"]

    def look_as(self, camera):
        """As a camera file of the tool says."""
        view = self.view
        view.CameraPosition, view.CameraFocalPoint = camera["position"], camera["focal_point"]
        view.CameraViewUp = camera["view_up"]
        view.CameraParallelProjection = int("parallel_scale" in camera)
        if "parallel_scale" in camera:
            view.CameraParallelScale = camera["parallel_scale"]
        else:
            view.CameraViewAngle = camera["view_angle"]

    def move(self, by):
        """Cloud and camera, so that the picture stays the same."""
        # The property has been called Translation since ParaView 5.13.
        known = hasattr(type(self.display), "Translation")
        setattr(self.display, "Translation" if known else "Position", by)
        self.look(by)

    def color_by(self, display, array):
        simple.ColorBy(display, ("POINTS", array))
        display.SetScalarBarVisibility(self.view, False)

    def frame(self, display=None):
        """Returns of the last frame, over all processes: points drawn, whether it is complete."""
        proxy = (display or self.display).SMProxy
        proxy.UpdatePropertyInformation()
        return (proxy.GetProperty("PointsDrawn").GetElement(0),
                bool(proxy.GetProperty("FrameComplete").GetElement(0)))

    def budget(self):
        """Memory for points, MiB, of the process that has least."""
        proxy = self.display.SMProxy
        proxy.UpdatePropertyInformation()
        return proxy.GetProperty("HostMemoryBudget").GetElement(0)

    def save(self, name):
        path = os.path.join(OUTPUT, name + ".png")
        saved = simple.SaveScreenshot(path, self.view, ImageResolution=SIZE)
        require(saved, "not saved: " + path)

    def save_complete(self, name):
        """A screenshot, which must hold every point whatever was drawn before it."""
        self.save(name)
        points, complete = self.frame()
        require(complete, name + ": the screenshot is not complete")
        require(points == POINTS, "%s: %d points drawn of %d" % (name, points, POINTS))
