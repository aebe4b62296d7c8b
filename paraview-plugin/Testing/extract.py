"""pvbatch, on any number of ranks: "PointFront Extract" gives the stored points of a region.

usage: pvbatch extract.py NAME BOX SPHERE BUILDINGS
BOX: six ends, low and high; SPHERE: centre and radius; BUILDINGS: stores, and points of class 6
Writes NAME.npz, sorted: the points of the box, of the sphere, of conditions, of a frustum, of a
turned box; and what each rank read from the disk for the box.
"""

import json
import os
import sys

import numpy
from paraview import servermanager, simple
from vtkmodules.vtkCommonCore import vtkCollection
from vtkmodules.util.numpy_support import vtk_to_numpy

simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())

from scene import OUTPUT, POINTS, SIZE, STORE, Scene, require

name, (box, sphere, buildings) = sys.argv[1], map(json.loads, sys.argv[2:5])
RANKS = servermanager.ActiveConnection.GetNumberOfDataPartitions()
scene = Scene()
scene.view.ViewSize = SIZE


def ranks_of(source):
    """Returns, for each rank, its points and a function of the field data's arrays."""
    source.UpdatePipeline()
    for rank in range(RANKS):
        data = servermanager.Fetch(source, rank)
        yield data, lambda array: data.GetFieldData().GetArray(array).GetValue(0)


def points_of(source):
    """Rows of x, y, z, intensity and id; sorted by id."""
    rows = [numpy.zeros((0, 5))]
    for data, _ in ranks_of(source):
        if data.GetNumberOfPoints() > 0:
            arrays = [vtk_to_numpy(data.GetPointData().GetArray(array)).astype(float)
                      for array in ("intensity", "point_id")]
            rows.append(numpy.c_[vtk_to_numpy(data.GetPoints().GetData()), arrays[0], arrays[1]])
    table = numpy.concatenate(rows)
    require(len(set(table[:, 4])) == len(table), "a point came from two ranks")
    return table[numpy.argsort(table[:, 4])]


# The filter suggests the whole cloud at first, though its input is an overview of it.
suggested = PointFrontExtract(Input=scene.reader)
require(len(points_of(suggested)) == POINTS,
        "the suggested box has %d of %d points" % (len(points_of(suggested)), POINTS))
simple.Delete(suggested)
# So it is where nobody has updated the reader.
early = PointFrontExtract(Input=simple.OpenDataFile(STORE), Classes=[0])
require(len(points_of(early)) == POINTS, "of a reader not yet updated: %d points of %d"
        % (len(points_of(early)), POINTS))
simple.Delete(early)
# One class of several, with a tree of its own and without.
for store, points in buildings.items():
    for region in (True, False):
        early = PointFrontExtract(Input=simple.OpenDataFile(store), Classes=[6], UseRegion=region)
        require(len(points_of(early)) == points, "class 6 of %s, not yet updated: %d points of %d"
                % (store, len(points_of(early)), points))
        simple.Delete(early)

found = {}
extract = PointFrontExtract(Input=scene.reader)
require("intensity" in extract.PointArrays.Available, "arrays: %s" % extract.PointArrays.Available)
extract.Region = "Box"
extract.Region.Position = box[:3]
extract.Region.Length = [high - low for low, high in zip(box[:3], box[3:])]
found["box"] = points_of(extract)
found["bytes"] = numpy.array([read("bytes_read") for _, read in ranks_of(extract)])
require(sum(read("points_chosen") for _, read in ranks_of(extract)) == len(found["box"]), "counts")

# How many, before they are read.
extract.CountOnly = 1
require(len(points_of(extract)) == 0, "points come although they are only counted")
counted = sum(read("points_chosen") for _, read in ranks_of(extract))
require(counted == len(found["box"]), "counted %d, extracted %d" % (counted, len(found["box"])))
extract.CountOnly = 0

# Conditions besides; fewer attributes; a coarser subset.
extract.Where = "intensity > 60 and return_number == 1"
extract.Classes = [0, 2]
found["conditions"] = points_of(extract)
extract.Where, extract.Classes = "", []
extract.PointArrays = ["intensity"]
for data, _ in ranks_of(extract):
    require(data.GetPointData().GetNumberOfArrays() <= 2, "attributes that were not asked for")
extract.Spacing = 10.0
coarse = points_of(extract)
require(0 < len(coarse) < len(found["box"]), "%d points at a coarser spacing" % len(coarse))
extract.Spacing = 0.0

# A box that is turned by a quarter has its other sides. Half a step of the points' grid larger, for
# its sides are rounded.
low, high = numpy.array(box[:3]) - 0.005, numpy.array(box[3:]) + 0.005
extract.Region.Position = [high[0], low[1], low[2]]
extract.Region.Length = [high[1] - low[1], high[0] - low[0], high[2] - low[2]]
extract.Region.Rotation = [0.0, 0.0, 90.0]
found["turned"] = points_of(extract)

# A box lies between its ends, whichever is the lower one.
extract.Region.Position = [high[0], high[1], low[2]]
extract.Region.Length = [low[1] - high[1], high[0] - low[0], high[2] - low[2]]
found["turned-negative"] = points_of(extract)
extract.Region.Rotation = [0.0, 0.0, 0.0]
extract.Region.Position = high.tolist()
extract.Region.Length = (low - high).tolist()
found["negative"] = points_of(extract)

extract.Region = "Sphere"
extract.Region.Center, extract.Region.Radius = sphere[:3], sphere[3]
found["sphere"] = points_of(extract)

# Extracts the points of the view's frustum, by a selection through it.
representations, sources = vtkCollection(), vtkCollection()
scene.view.SMProxy.SelectFrustumPoints([390, 110, 470, 160], representations, sources, True)
extract.UseRegion = 0
extract.Selection = servermanager._getPyProxy(sources.GetItemAsObject(0))
found["frustum"] = points_of(extract)
extract.Selection = None
found["all"] = points_of(extract)
require(len(found["all"]) == POINTS, "of %d points %d come" % (POINTS, len(found["all"])))

# It is shown as points in the colours that they have.
simple.Hide(scene.reader, scene.view)
extract.PointArrays = ["intensity", "rgb"]
display = simple.Show(extract, scene.view)
require(display.Representation == "Points", "shown as %s" % display.Representation)
display.MapScalars = 0
scene.look()
scene.save(name)

# An input that is no store has no points to extract.
wrong = PointFrontExtract(Input=simple.MaskPoints(Input=scene.reader), UseRegion=0)
wrong.UpdatePipeline()
require(wrong.GetDataInformation().GetNumberOfPoints() == 0, "a filter's output is extracted from")
numpy.savez(os.path.join(OUTPUT, name + ".npz"), **found)
