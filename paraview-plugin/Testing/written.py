"""Data of the pipeline saved as a store, and what is saved of a store: on any number of ranks.

usage: pvbatch written.py NAME
"""

import os
import sys

from paraview import servermanager, simple

simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())

from scene import OUTPUT, POINTS, SIZE, Scene, require

name = sys.argv[1]
scene = Scene()
scene.view.ViewSize = SIZE
scene.display.Visibility = 0


def points_of(source):
    source.UpdatePipeline()
    return source.GetDataInformation().GetNumberOfPoints()


def own_points(source):
    """How many points no rank marks as another's, and the places that only marked points have."""
    data = servermanager.Fetch(source)
    marks = data.GetPointData().GetArray("vtkGhostType")
    places = [data.GetPoint(i) for i in range(data.GetNumberOfPoints())]
    marked = [bool(marks and marks.GetValue(i) & 3) for i in range(len(places))]
    own = [place for place, other in zip(places, marked) if not other]
    return len(own), {place for place, other in zip(places, marked) if other} - set(own)


def saved(source, what, **options):
    path = os.path.join(OUTPUT, "%s-%s.pfront" % (name, what))
    if os.path.exists(path):
        os.remove(path)
    simple.SaveData(path, proxy=source, **options)
    require(os.path.exists(path), "not saved: " + path)
    reader = simple.OpenDataFile(path)
    reader.OverviewPoints = 10 ** 9
    return reader


# A surface of ParaView's own, with a value.
surface = simple.Contour(Input=simple.Wavelet(), ContourBy=["POINTS", "RTData"],
                         Isosurfaces=[150.0])
reader = saved(surface, "surface", Normals="By PCA", Precision=0.001)
own, lost = own_points(surface)
require(points_of(reader) == own > 1000, "%d points of %d" % (points_of(reader), own))
require(not lost, "no rank has these places as its own: %s" % lost)
wanted = surface.GetDataInformation().GetBounds()
found = reader.GetDataInformation().GetBounds()
require(all(abs(a - b) < 0.002 for a, b in zip(wanted, found)), "%s, not %s" % (found, wanted))
require("RTData" in reader.PointData.keys(), "without the contour's value")
require("normal" in reader.PointData.keys(), "asked for, and without normals")

# LAS and LAZ: what the filter gives is in the file, coordinates to the last step. A file of another
# kind stays.
extract = PointFrontExtract(Input=scene.reader)
for ending in ("laz", "las"):
    path = os.path.join(OUTPUT, "%s-points.%s" % (name, ending))
    simple.SaveData(path, proxy=extract)
    require(os.path.exists(path), "not saved: " + path)
points_of(surface)
simple.SaveData(os.path.join(OUTPUT, name + "-surface.las"), proxy=surface, Precision=0.001)
kept = os.path.join(OUTPUT, name + "-kept.las")
with open(kept, "w") as file:
    file.write("no points\n")
print("== kept", flush=True)
try:
    simple.SaveData(kept, proxy=extract)
except RuntimeError:
    pass
print("== done", flush=True)
require(open(kept).read() == "no points\n", "a file of another kind is replaced")

# All points of a store, as the pipeline has them: the same picture as the store's.
scene.reader.OverviewPoints = POINTS
require(points_of(scene.reader) == POINTS, "%d points in memory" % points_of(scene.reader))
again = saved(scene.reader, "again")
require(points_of(again) == POINTS, "%d points written" % points_of(again))
names = set(scene.reader.PointData.keys())
require(set(again.PointData.keys()) == names, "%s, not %s" % (again.PointData.keys(), names))
display = scene.show(again)
display.TargetError, display.PointBudget = 0.01, 0
scene.color_by(display, "rgb")
scene.save(name)
