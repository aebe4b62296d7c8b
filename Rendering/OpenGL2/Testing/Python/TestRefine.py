"""A window with an interactor refines by itself: RenderWhenDataArrives().

usage: TestRefine.py STORE
"""
import sys

import pointfront
from vtkmodules import vtkInteractionStyle, vtkRenderingCore, vtkRenderingUI  # X11's interactor

reader = pointfront.vtkPointFrontReader()
reader.SetFileName(sys.argv[1])
mapper = pointfront.vtkPointFrontMapper()
mapper.SetInputConnection(reader.GetOutputPort())
actor = vtkRenderingCore.vtkActor()
actor.SetMapper(mapper)
renderer = vtkRenderingCore.vtkRenderer()
renderer.AddActor(actor)
window = vtkRenderingCore.vtkRenderWindow()
window.SetSize(400, 300)
window.AddRenderer(renderer)
interactor = vtkRenderingCore.vtkRenderWindowInteractor()
interactor.SetRenderWindow(window)
window.Render()
first = mapper.GetLastPointsDrawn()
if mapper.GetLastComplete():
    sys.exit("TestRefine.py: the first frame is complete already: there is nothing to test")

frames = []
mapper.AddObserver("UpdateDataEvent", lambda caller, event: frames.append(1))
interactor.Initialize()
mapper.RenderWhenDataArrives(interactor)
ticks = []


def end(caller, event):
    ticks.append(1)
    if mapper.GetLastComplete() or len(ticks) > 600:
        interactor.TerminateApp()


interactor.AddObserver("TimerEvent", end)
interactor.Start()
mapper.RenderWhenDataArrives(None)
if not mapper.GetLastComplete() or not frames or mapper.GetLastPointsDrawn() <= first:
    sys.exit("TestRefine.py: %d points, then %d after %d frames; complete: %s" % (
        first, mapper.GetLastPointsDrawn(), len(frames), mapper.GetLastComplete()))
