"""pvbatch: colours span what the store has, and a user can read what the store and the view are.

usage: pvbatch facts.py STATISTICS     what `pointfront info --stats --json` says, a file
"""

import json
import os
import sys

import numpy
from paraview import simple

simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())

from scene import POINTS, STORE, Scene, require

with open(sys.argv[1]) as file:
    told = json.load(file)
values = {one["name"]: one for one in told["stats"]["attributes"]}

scene = Scene()
scene.view.ViewSize = [640, 360]
reader, display = scene.reader, scene.display
overview = reader.GetDataInformation().GetNumberOfPoints()
require(0 < overview <= 5000 < POINTS, "an overview of %d points" % overview)

# Colour maps span the store's values when an attribute is chosen, and when they are asked to.
checked = 0
for array in ["elevation"] + [a.GetName() for a in reader.PointData.values()]:
    known = values.get("z" if array == "elevation" else array)
    # The length of a colour is in no statistics.
    if array == "rgb" or not known or known["minimum"] == known["maximum"]:
        continue
    wanted = [known["minimum"], known["maximum"]]
    for attempt in ("chosen", "rescaled", "stretched"):
        if attempt == "chosen":
            simple.ColorBy(display, ("POINTS", array))
        else:
            if attempt == "rescaled":
                simple.GetColorTransferFunction(array).RescaleTransferFunction(-7.0, -6.0)
            display.RescaleTransferFunctionToDataRange(attempt == "stretched")
        points = simple.GetColorTransferFunction(array).RGBPoints
        found = [points[0], points[-4]]
        close = 1e-9 * max(map(abs, wanted))
        require(all(abs(a - b) <= close for a, b in zip(found, wanted)),
                "%s, %s: the map spans %s, the store %s" % (array, attempt, found, wanted))
    checked += 1
require(checked >= 3, "%d attributes" % checked)

# The properties of the reader say what the store is.
reader.UpdatePropertyInformation()
facts = reader.SMProxy.GetProperty("StoreFacts").GetElement(0)
print(facts)
require("{:,} points".format(POINTS) in facts, "points of the store: " + facts)
require("Information counts an overview of at most 5,000 of them" in facts, facts)
# The Information panel has the box of the store, and its count beside that of the overview.
information = reader.GetDataInformation()
box = numpy.reshape(told["bounds"], (2, 3)).T.ravel()
require(numpy.allclose(information.GetBounds(), box, 0, 1e-9), "bounds: %s, not %s"
        % (information.GetBounds(), box))
counted = information.GetFieldDataInformation().GetArrayInformation("store_points")
require(counted.GetComponentRange(0) == (POINTS, POINTS), "points of the store, as field data")
intensity = values["intensity"]
require("intensity  %d to %d" % (intensity["minimum"], intensity["maximum"]) in facts, facts)


def view():
    scene.view.SMProxy.StillRender()
    proxy = display.SMProxy
    proxy.UpdatePropertyInformation()
    return [proxy.GetProperty(name).GetElement(0)
            for name in ("PointsDrawn", "ProjectedSpacing", "LimitedBy")]


# The view has all, what the budget allows, and what a coarser target gives.
points, error, limit = view()
require(points == POINTS and error <= 0.01 and limit == "nothing", str((points, error)))
told = display.SMProxy.GetProperty("PointsInView").GetElement(0)
require(told == "{0:,} of {0:,}".format(POINTS), told)
display.PointBudget = 20000
points, error, limit = view()
print(points, error, limit)
require(0 < points < POINTS and error > 0.01 and limit == "Point Budget", limit)
display.PointBudget, display.TargetError = 0, 3.0
points, error, limit = view()
print(points, error, limit)
require(0 < points < POINTS and 0.01 < error < 3.01 and limit == "nothing", limit)
technique = display.Technique
told = display.SMProxy.GetProperty("ExpectedDifference").GetElement(0)
print(told)
require(technique == "points" and " dB, " in told, f"as it is without a style: {told}")
for quality, word in (("draft", " dB, "), ("custom", "not measured")):
    display.Quality = quality
    display.Technique = "splats" if quality == "draft" else "spheres"
    view()
    told = display.SMProxy.GetProperty("ExpectedDifference").GetElement(0)
    print(told)
    require(word in told and ("docs/tradeoffs.md" in told) == (quality == "draft"), told)
display.Technique, display.ClosingSize = technique, 0
display.TargetError = 0.01
simple.GetSettingsProxy("PointFrontSettings").HostMemoryBudgetMiB = 1
points, error, limit = view()
print(points, error, limit)
require(points < POINTS and limit == "Host Memory Budget (Settings)", limit)
# While the view moves.
simple.GetSettingsProxy("PointFrontSettings").HostMemoryBudgetMiB = 1024
view()
display.TargetFrameTime = 0.5
for _ in range(10):
    scene.view.SMProxy.InteractiveRender()
display.SMProxy.UpdatePropertyInformation()
limit = display.SMProxy.GetProperty("LimitedBy").GetElement(0)
print(limit)
if "alone" in sys.argv[2:]:
    require("the time of a frame in motion" in limit, limit)
