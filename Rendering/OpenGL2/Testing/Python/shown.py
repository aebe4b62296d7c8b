"""A cloud in a window of 400 by 300 pixels, as the tests of the wrapped classes show it."""

import pointfront
from vtkmodules import vtkRenderingCore
from vtkmodules.util.numpy_support import vtk_to_numpy


class Shown:
    """A mapper of the points of `reader`, and its window, which nothing has rendered yet."""

    def __init__(self, reader, offscreen=True):
        self.mapper = pointfront.vtkPointFrontMapper()
        self.mapper.SetInputConnection(reader.GetOutputPort())
        actor = vtkRenderingCore.vtkActor()
        actor.SetMapper(self.mapper)
        self.renderer = vtkRenderingCore.vtkRenderer()
        self.renderer.AddActor(actor)
        self.window = vtkRenderingCore.vtkRenderWindow()
        self.window.SetOffScreenRendering(offscreen)
        self.window.SetMultiSamples(0)
        self.window.SetSize(400, 300)
        self.window.AddRenderer(self.renderer)

    def pixels(self):
        """Returns the rows of red, green and blue that the last frame left."""
        grab = vtkRenderingCore.vtkWindowToImageFilter()
        grab.SetInput(self.window)
        grab.ReadFrontBufferOff()
        grab.ShouldRerenderOff()
        grab.Update()
        return vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars()).astype(int)
