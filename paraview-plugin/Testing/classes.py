"""pvbatch: the classes of a store in the representation's properties, and our page of settings.

usage: pvbatch classes.py CLASSES     a JSON object: points of each class of POINTFRONT_STORE
"""

import json
import os
import sys

import numpy
from paraview import servermanager, simple

simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())

import pictures
from scene import OUTPUT, POINTS, SIZE, Scene, require

classes = json.loads(sys.argv[1])
names = list(classes)
require(len(names) > 2, "too few classes to tell them apart: %s" % names)

scene = Scene()
scene.view.ViewSize = SIZE
scene.view.ResetCamera(True)


def drawn():
    scene.view.SMProxy.StillRender()
    points, complete = scene.frame()
    require(complete, "a still render in batch is complete")
    return points


# The list is that of the store, and everything is shown at first.
require(drawn() == POINTS, "not all points are in sight")
require(list(scene.display.Classes.Available) == names,
        "listed: %s, in the store: %s" % (scene.display.Classes.Available, names))
require(list(scene.display.Classes) == names, "shown at first: %s" % scene.display.Classes)

# A class that is switched off is not drawn; and comes back.
for shown in (names[:1], names[1:], names):
    scene.display.Classes = shown
    wanted = sum(classes[name] for name in shown)
    require(drawn() == wanted, "%s: %d points, not %d" % (shown, drawn(), wanted))

# A threshold for one class alone: its points may be 100 pixels apart, those of the others 1 pixel.
largest = max(names, key=lambda name: classes[name])
scene.display.ClassTargetErrorFactors = [largest, "100"]
scene.display.TargetError = 1.0
coarse = drawn()
scene.display.ClassTargetErrorFactors = []
fine = drawn()
require(coarse < fine, "%s a hundred times coarser: %d points, before %d" % (largest, coarse, fine))

# A share: of a budget that is too small, the class gets what it is promised.
scene.display.TargetError = 0.01
scene.display.PointBudget = POINTS // 4
smallest = min(names, key=lambda name: classes[name])
scene.display.ClassTargetErrorFactors = [smallest, "100"]  # its errors count for nothing
without = drawn()
scene.display.ClassBudgetShares = [smallest, "1"]
require(0 < drawn() <= POINTS // 4, "the budget is broken: %d points" % drawn())
scene.display.ClassBudgetShares = []
require(drawn() == without, "without its share it is as before")

# Classes are categories with names and colours; what a user makes of them stays.
scene.display.ClassTargetErrorFactors = []
scene.display.TargetError, scene.display.PointBudget = 0.01, 0
scene.color_by(scene.display, "classification")
scene.display.SetScalarBarVisibility(scene.view, True)
scene.save("classes-coloured")
table = simple.GetColorTransferFunction("classification")
named = dict(zip(table.Annotations[::2], table.Annotations[1::2]))
require(table.InterpretValuesAsCategories == 1, "classes are no categories")
require(named["2"] == "ground" and named["6"] == "building", "named %s" % named)
require(set(names) == set(named.values()), "named %s" % named)

# A cloud that comes later has its classes named, too, and only classes that a cloud has are in the
# legend. The colours that a class had already stay.
wide = simple.OpenDataFile(os.environ["POINTFRONT_WIDE"])
wide.OverviewPoints = 5000
shown = scene.show(wide)
shown.TargetError = 0.01
scene.color_by(shown, "classification")
# It lies elsewhere: 67 columns, one of each class, seen from above.
scene.look_as({"position": [33, 49.5, 100], "focal_point": [33, 49.5, 0], "view_up": [0, 1, 0],
               "parallel_scale": 50})
scene.save("classes-wide")
scene.view.CameraParallelProjection = 0
scene.look()
many = dict(zip(table.Annotations[::2], table.Annotations[1::2]))
require(set(range(1, 68)) | set(map(int, named)) == set(map(int, many)), "named %s" % sorted(many))
require(list(table.Annotations[::2]) == sorted(many, key=int), "in no order: %s" % many)
require(len(table.IndexedColors) == 3 * len(many), "colours of %d" % len(many))
require({code: many[code] for code in named} == named, "names changed: %s" % many)
picture = pictures.load(os.path.join(OUTPUT, "classes-wide.png")).reshape(-1, 3)
colours = numpy.round(255 * numpy.array(table.IndexedColors).reshape(-1, 3))
unseen = [code for code, colour in zip(map(int, table.Annotations[::2]), colours)
          if 1 <= code <= 67 and numpy.abs(picture - colour).max(axis=1).min() > 1]
require(not unseen, "classes in other colours: %s" % unseen)
require("40" not in named, "absent classes in the first legend: %s" % named)
simple.Hide(wide, scene.view)
table.InterpretValuesAsCategories = 0
table.Annotations = []
scene.save("classes-mapped")
require(len(table.Annotations) == 0, "a user's colour map is changed")

# The store is described where users look: in the Information panel, by the field data.
fields = servermanager.Fetch(scene.reader).GetFieldData()
told = {fields.GetArrayName(i): fields.GetAbstractArray(i)
        for i in range(fields.GetNumberOfArrays())}
require(told["store_points"].GetValue(0) == POINTS, "points of the store")
require([told["store_classes"].GetValue(i) for i in range(len(names))] == names, "its classes")
require([told["store_class_points"].GetValue(i) for i in range(len(names))]
        == list(classes.values()), "points of its classes")
require("octree" in told["store_structure"].GetValue(0), told["store_structure"].GetValue(0))
require("PointFront Extract" in told["output_is"].GetValue(0), told["output_is"].GetValue(0))

# One host memory for all clouds: a page of the settings, which is there although nobody loaded the
# plugin through the application's dialog.
settings = simple.GetSettingsProxy("PointFrontSettings")
require(settings is not None, "no page of settings")
require(settings.HostMemoryBudgetMiB == 1024, "by default %s MiB" % settings.HostMemoryBudgetMiB)
require(scene.budget() == 1024, "in use: %d MiB" % scene.budget())
settings.HostMemoryBudgetMiB = 300
require(scene.budget() == 300, "set to 300 MiB, in use: %d" % scene.budget())
