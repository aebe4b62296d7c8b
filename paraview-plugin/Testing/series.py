"""pvbatch, on any number of ranks: stores of several times are the time steps of one source.

usage: pvbatch series.py STEPS     a JSON list: name and points of each store, in the order of time
"""

import json
import os
import sys

from paraview import simple

simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())

from scene import SIZE, require

steps = json.loads(sys.argv[1])
series = simple.OpenDataFile([name for name, _ in steps])
require(series is not None and series.GetXMLName() == "PointFrontReader", "not opened as a series")
require(list(series.FileName) == [name for name, _ in steps], "files: %s" % series.FileName)
require(list(series.TimestepValues) == list(range(len(steps))),
        "times: %s" % series.TimestepValues)
# An attribute that only some of them have is there at those times.
require("intensity" in series.PointArrays.Available, "arrays: %s" % series.PointArrays.Available)

series.OverviewPoints = 1000
view = simple.CreateView("RenderView")
view.ViewSize = SIZE
display = simple.Show(series, view)
require(display.Representation == "Point Front", "shown as %s" % display.Representation)
display.TargetError, display.PointBudget = 0.01, 0
animation = simple.GetAnimationScene()
animation.UpdateAnimationUsingDataTimeSteps()


def drawn():
    view.SMProxy.ResetCamera()
    view.SMProxy.StillRender()
    display.SMProxy.UpdatePropertyInformation()
    return display.SMProxy.GetProperty("PointsDrawn").GetElement(0)


# In any order: forwards, backwards, and the first once more.
for time in list(range(len(steps))) + [1, 0]:
    animation.AnimationTime = time
    points = drawn()
    require(points == steps[time][1], "at %d: %d points drawn, the store has %d"
            % (time, points, steps[time][1]))
    bounds = series.GetDataInformation().GetBounds()
    require(bounds[1] > bounds[0], "at %d: no overview" % time)

# One of them alone has no times, and a script names it as ever.
alone = PointFrontReader(FileName=steps[1][0])
alone.UpdatePipeline()
require(len(alone.TimestepValues) == 0, "one store has times: %s" % alone.TimestepValues)
simple.Hide(series, view)
display = simple.Show(alone, view)
display.TargetError, display.PointBudget = 0.01, 0
require(drawn() == steps[1][1], "one store alone")
