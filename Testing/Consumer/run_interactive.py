"""Runs a script that ends in an interactor's event loop: looks at the window, then ends the loop.

usage: run_interactive.py SCRIPT ARGUMENT...
"""

import runpy
import sys

from vtkmodules import vtkRenderingCore
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray

MILLISECONDS = 500  # from the start of the loop to the look at the window
shares = []


def covered_share(window):
    """Share of the pixels that do not have the colour of the first."""
    width, height = window.GetSize()
    pixels = vtkUnsignedCharArray()
    window.GetPixelData(0, 0, width - 1, height - 1, 0, pixels)
    values = vtk_to_numpy(pixels).reshape(-1, 3)
    return (values != values[0]).any(axis=1).mean()


class BriefWindow(vtkRenderingCore.vtkRenderWindow):
    """A window whose interactor looks at it once and stops."""

    def MakeRenderWindowInteractor(self):
        interactor = super().MakeRenderWindowInteractor()
        interactor.Initialize()
        interactor.AddObserver("TimerEvent", self.look)
        interactor.CreateOneShotTimer(MILLISECONDS)
        return interactor

    def look(self, interactor, _):
        shares.append(covered_share(self))
        interactor.TerminateApp()


vtkRenderingCore.vtkRenderWindow = BriefWindow
del sys.argv[0]
runpy.run_path(sys.argv[0], run_name="__main__")
if not shares:
    sys.exit("the script did not start an event loop")
print(f"{shares[0]:.3f} of the window covered")
if shares[0] < 0.05:
    sys.exit("the window shows nothing")
