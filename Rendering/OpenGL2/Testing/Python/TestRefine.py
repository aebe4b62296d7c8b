"""A window with an interactor refines by itself: RenderWhenDataArrives().

usage: TestRefine.py STORE
"""
import sys

import pointfront
from vtkmodules import vtkInteractionStyle, vtkRenderingCore, vtkRenderingUI  # X11's interactor

from shown import Shown
reader = pointfront.vtkPointFrontReader()
reader.SetFileName(sys.argv[1])
shown = Shown(reader, offscreen=False)
mapper, window = shown.mapper, shown.window
mapper.SetScalarModeToUsePointFieldData()
mapper.SetUploadLimit(1 << 16)  # bytes a frame in motion: less than the colours take
interactor = vtkRenderingCore.vtkRenderWindowInteractor()
interactor.SetRenderWindow(window)


def drag(array):
    """A frame as while a user drags, with other colours: it leaves something to do."""
    mapper.SelectColorArray(array)
    window.SetDesiredUpdateRate(15.0)
    window.Render()
    window.SetDesiredUpdateRate(0.0001)
    return mapper.GetLastComplete()


if drag("rgb"):
    sys.exit("TestRefine.py: the frame in motion is complete: there is nothing to test")

frames = []
mapper.AddObserver("UpdateDataEvent", lambda caller, event: frames.append(1))
interactor.Initialize()
mapper.RenderWhenDataArrives(interactor)
ticks = []


def tick(caller, event):
    ticks.append(1)
    if (frames and mapper.GetLastComplete()) or len(ticks) > 600:
        interactor.TerminateApp()
    elif mapper.GetLastComplete():
        # The window's own events have rendered it meanwhile.
        drag(("rgb", "intensity")[len(ticks) % 2])


interactor.AddObserver("TimerEvent", tick)
interactor.Start()
mapper.RenderWhenDataArrives(None)
if not mapper.GetLastComplete() or not frames or mapper.GetLastPointsDrawn() < 10000:
    sys.exit("TestRefine.py: %d points after %d frames; complete: %s" % (
        mapper.GetLastPointsDrawn(), len(frames), mapper.GetLastComplete()))
