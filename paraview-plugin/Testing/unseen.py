"""pvbatch, on any number of ranks: a cloud of which a view shows nothing is complete.

usage: pvbatch unseen.py EMPTY     a store without points
"""

import os
import sys
import time

from paraview import simple

simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())

from scene import POINTS, Scene, require

ASIDE = (1e4, 0.0, 0.0)


def check(when, scene, display, points):
    scene.view.SMProxy.StillRender()
    found = scene.frame(display)
    limits = display.SMProxy.GetProperty("LimitedBy").GetElement(0)
    require(found == (points, True) and limits == "nothing",
            "%s: %d points, complete %s, limited by %s" % (when, *found, limits))


# It was never in view; then it is, and loads as ever; and then it is not any more.
scene = Scene()
scene.display.CompleteStillRenders = "Never"
scene.look(ASIDE)
check("never in view", scene, scene.display, 0)
scene.look()
hangs = time.monotonic() + 300
scene.view.SMProxy.StillRender()
while not scene.frame()[1]:
    require(time.monotonic() < hangs, "in view: not complete")
    time.sleep(0.02)
    scene.view.SMProxy.StillRender()
check("in view", scene, scene.display, POINTS)
scene.look(ASIDE)
check("not any more", scene, scene.display, 0)

# An empty cloud has nothing to wait for, and takes nothing from the one beside it.
empty = simple.Show(simple.OpenDataFile(sys.argv[1]), scene.view)
scene.look()
check("empty", scene, empty, 0)
scene.display.CompleteStillRenders = "Always"
check("beside an empty one", scene, scene.display, POINTS)
