"""pvbatch: a store is shown as "Point Front" in each kind of view; a damaged one is told of once.

usage: pvbatch views.py DAMAGED     a store whose file ends too early
Saves views-KIND.png. What is written to stderr after the line "damaged" is about that store.
"""

import json
import os
import sys

from paraview import simple

simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())

import pictures
from scene import OUTPUT, SIZE, STORE, require



def look(view):
    with open(os.environ["POINTFRONT_CAMERA"]) as file:
        camera = json.load(file)
    view.CameraPosition, view.CameraFocalPoint = camera["position"], camera["focal_point"]
    view.CameraViewUp, view.CameraViewAngle = camera["view_up"], camera["view_angle"]


reader = simple.OpenDataFile(STORE)
reader.OverviewPoints = 1000
for kind in ("RenderView", "RenderViewWithEDL", "ComparativeRenderView", "OrthographicSliceView"):
    try:
        view = simple.CreateView(kind)
    except (AttributeError, RuntimeError, TypeError) as missing:
        require(kind == "RenderViewWithEDL", "%s: %s" % (kind, missing))
        print("this ParaView has no", kind)
        continue
    view.ViewSize = SIZE
    display = simple.Show(reader, view)
    require(display.Representation == "Point Front",
            "%s: shown as %s" % (kind, display.Representation))
    display.SetScalarBarVisibility(view, False)
    simple.Render(view)
    if kind == "ComparativeRenderView":
        look(view)  # it has no camera to reset
    else:
        simple.ResetCamera(view)
    simple.Render(view)
    path = os.path.join(OUTPUT, "views-%s.png" % kind)
    simple.SaveScreenshot(path, view, ImageResolution=SIZE)
    require(len(set(map(tuple, pictures.load(path).reshape(-1, 3)))) > 100, kind + " is empty")
    simple.Delete(view)

print("damaged", file=sys.stderr, flush=True)
view = simple.CreateView("RenderView")
try:
    damaged = simple.OpenDataFile(sys.argv[1])
except RuntimeError:
    damaged = None  # "No reader found": the file is no store any more
if damaged:
    simple.Show(damaged, view)
    simple.Render(view)
    simple.Render(view)
