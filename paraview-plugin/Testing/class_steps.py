"""pvbatch, on any number of ranks: the property Classes says what is drawn when the store changes.

usage: pvbatch class_steps.py STEPS     a JSON list: name of each store, points of its classes. The
first has ground and buildings, the second ground and high vegetation, the third high vegetation
"""

import json
import os
import sys

from paraview import simple

simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())

from scene import OUTPUT, SIZE, require

steps = json.loads(sys.argv[1])
names = [name for name, _ in steps]
GROUND, BUILDING, TREES = "ground", "building", "high vegetation"
require([sorted(classes) for _, classes in steps] == [[BUILDING, GROUND], [GROUND, TREES], [TREES]],
        "classes: %s" % steps)
animation = simple.GetAnimationScene()


def shown(files):
    view = simple.CreateView("RenderView")
    view.ViewSize = SIZE
    reader = simple.OpenDataFile(files)
    reader.OverviewPoints = 1000
    display = simple.Show(reader, view)
    display.TargetError, display.PointBudget = 0.01, 0
    animation.UpdateAnimationUsingDataTimeSteps()
    return reader, view, display


def check(when, view, display, step, *wanted):
    """The wanted classes of that step's store are drawn and listed as shown, and no others."""
    view.SMProxy.ResetCamera()
    view.SMProxy.StillRender()
    classes = steps[step][1]
    proxy = display.SMProxy
    proxy.UpdatePropertyInformation()
    points = proxy.GetProperty("PointsDrawn").GetElement(0)
    listed = proxy.GetProperty("Classes")
    pairs = [listed.GetElement(i) for i in range(listed.GetNumberOfElements())]
    found = "%s: %d points of %s, listed %s" % (when, points, classes, pairs)
    require(points == sum(classes[name] for name in wanted), found)
    require(sorted(display.Classes) == sorted(wanted), found)
    require(set(classes) <= set(pairs[::2]), found)
    require(sorted(display.GetProperty("Classes").Available) == sorted(classes), found)


def loaded(when, step, *classes):
    """Saves a state at that step, and loads it."""
    animation.AnimationTime = step
    check("saved " + when, view, display, step, *classes)
    state = os.path.join(OUTPUT, "class_steps.pvsm")
    simple.SaveState(state)
    simple.ResetSession()
    simple.LoadState(state)
    again = simple.GetActiveViewOrCreate("RenderView")
    source, = simple.GetSources().values()
    return simple.GetAnimationScene(), again, simple.GetDisplayProperties(source, again)


# Classes that come are shown.
series, view, display = shown(names)
for time, classes in enumerate(((GROUND, BUILDING), (GROUND, TREES), (TREES,),
                                (GROUND, BUILDING))):
    animation.AnimationTime = time % 3
    check("time %d" % (time % 3), view, display, time % 3, *classes)

# A class that is switched off stays off, in steps, too, that are behind one without it.
display.Classes = [GROUND]
for time, classes in ((0, (GROUND,)), (1, (GROUND, TREES)), (2, (TREES,)), (0, (GROUND,))):
    animation.AnimationTime = time
    check("no buildings, time %d" % time, view, display, time, *classes)
animation.AnimationTime = 2
display.Classes = []
check("no trees, time 2", view, display, 2)
animation.AnimationTime = 0
check("no trees, time 0", view, display, 0, GROUND)

# A state has it all.
for when, chosen in (("with all", (GROUND, BUILDING)), ("without buildings", (GROUND,))):
    animation.AnimationTime = 2
    display.Classes = [TREES]
    check(when, view, display, 2, TREES)
    animation.AnimationTime = 0
    display.Classes = chosen
    animation, view, display = loaded(when, 2, TREES)
    for time, classes in ((2, (TREES,)), (1, (GROUND, TREES)), (0, chosen)):
        animation.AnimationTime = time
        check("loaded %s, time %d" % (when, time), view, display, time, *classes)

# Another file.
simple.ResetSession()
animation = simple.GetAnimationScene()
reader, view, display = shown(names[0])
check("a file", view, display, 0, GROUND, BUILDING)
display.Classes = [BUILDING]
reader.FileName = [names[1]]
check("another file", view, display, 1, TREES)

# A script chooses before anything has been drawn.
reader, view, display = shown(names[0])
display.Classes = [BUILDING]
check("chosen at once", view, display, 0, BUILDING)
