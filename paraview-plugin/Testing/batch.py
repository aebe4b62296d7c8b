"""pvbatch on one process or several: the whole cloud, colouring, and what motion draws.

usage: pvbatch batch.py NAME [alone]
NAME.png, NAME-intensity.png: our representation; NAME-moved.png: cloud and camera moved alike.
alone: on one process; the same with ParaView's own "Points", which has the whole cloud in memory,
as NAME-stock.png and NAME-stock-intensity.png; what motion draws; and what a render of a large
cloud (POINTFRONT_LARGE) draws that does not wait for it.
"""

import os
import sys

from paraview import simple

simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())

from scene import POINTS, SIZE, STORE, Scene, require

name = sys.argv[1]
scene = Scene()
scene.view.ViewSize = SIZE
scene.color_by(scene.display, "rgb")
scene.view.SMProxy.StillRender()
points, complete = scene.frame()
require(complete and points == POINTS, "a still render in batch is complete: %d points" % points)
scene.save_complete(name)

# A file that is no store is refused before a reader is made for it.
other = os.path.join(os.environ["POINTFRONT_OUTPUT"], "other.pfront")
with open(other, "w") as file:
    file.write("not a point store")
try:
    opened = simple.OpenDataFile(other)
except RuntimeError as refusal:
    opened = None
    require("No reader found" in str(refusal), str(refusal))
require(opened is None, "opened, although not a store")

# The representation's transformation reaches the front's culling and the points alike.
scene.move([3000.0, -2000.0, 500.0])
scene.save_complete(name + "-moved")
scene.move([0.0, 0.0, 0.0])

scene.color_by(scene.display, "intensity")
scene.display.RescaleTransferFunctionToDataRange(False)
scene.save_complete(name + "-intensity")

if "alone" in sys.argv[2:]:
    # While the view moves, a frame keeps to its time and draws fewer points. (A piece of this small
    # cloud is below what a frame in motion draws at the least.)
    scene.display.TargetFrameTime = 2.0  # milliseconds
    for _ in range(10):
        scene.view.SMProxy.InteractiveRender()
    moving, _ = scene.frame()
    require(0 < moving < POINTS, "in motion %d points are drawn, at rest %d" % (moving, POINTS))
    print("in motion %d of %d points" % (moving, POINTS))

    simple.Hide(scene.reader, scene.view)
    # Complete Still Renders overrules what batch does by itself: of a cloud that takes longer than
    # a frame may, one that does not wait shows a part.
    large = scene.show_large()
    large.CompleteStillRenders = "Never"
    scene.view.SMProxy.StillRender()
    points, complete = scene.frame(large)
    require(not complete and points > 0, "a render that does not wait: %d points" % points)
    large.Visibility = 0
    scene.look()
    whole = simple.OpenDataFile(STORE)
    whole.OverviewPoints = POINTS
    display = scene.show(whole)
    display.SetRepresentationType("Points")
    require(whole.GetDataInformation().GetNumberOfPoints() == POINTS,
            "the overview holds %d points" % whole.GetDataInformation().GetNumberOfPoints())
    display.Ambient, display.Diffuse = 1.0, 0.0  # unlit
    scene.color_by(display, "intensity")  # the same lookup table
    scene.save(name + "-stock-intensity")
    scene.color_by(display, "rgb")
    display.MapScalars = 0
    scene.save(name + "-stock")
