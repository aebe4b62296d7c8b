"""pvbatch: "Select Points Through" keeps the millimetre where coordinates have seven digits.

Told by POINTFRONT_STORE of level points at whole millimetres.
"""

import os
import random

import numpy
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy

simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())

from scene import POINTS, SIZE, STORE, Scene, require

NEAR = 0.01  # pixels: a tenth of a millimetre

scene = Scene()
scene.view.ViewSize = SIZE
simple.Render(scene.view)  # the first one resets the camera


def places_of(source):
    source.UpdatePipeline()
    data = servermanager.Fetch(source)
    if data.GetNumberOfPoints() == 0:
        return numpy.zeros((0, 3))
    return vtk_to_numpy(data.GetPoints().GetData()).copy()


whole = simple.OpenDataFile(STORE)
whole.OverviewPoints = POINTS
cloud = places_of(whole)
simple.Delete(whole)
require(len(cloud) == POINTS, "an overview of %d points of %d" % (len(cloud), POINTS))
middle = cloud.mean(axis=0)


def look(parallel):
    """A pixel is a centimetre in the middle of the picture."""
    view = scene.view
    half = 0.01 * SIZE[1] / 2
    view.CameraParallelProjection, view.CameraParallelScale = int(parallel), half
    view.CameraViewAngle, view.CameraViewUp = 30, [0, 1, 0]
    away = [0.5, -0.3, half / numpy.tan(numpy.radians(15))]
    view.CameraFocalPoint, view.CameraPosition = middle.tolist(), (middle + away).tolist()
    simple.Render(view)


def on_screen(places):
    matrix = scene.view.SMProxy.GetActiveCamera().GetCompositeProjectionTransformMatrix(
        SIZE[0] / SIZE[1], -1, 1)
    matrix = numpy.array([[matrix.GetElement(i, j) for j in range(4)] for i in range(4)])
    clip = numpy.c_[places, numpy.ones(len(places))] @ matrix.T
    return (clip[:, :2] / clip[:, 3:] + 1) / 2 * SIZE


def check(found, wanted, nearly, what):
    """All of `wanted` and nothing beside `nearly`, which are places."""
    rows = {tuple(place) for place in found.tolist()}
    least, most = ({tuple(place) for place in cloud[chosen].tolist()}
                   for chosen in (wanted, nearly))
    require(len(rows) == len(found), what + ": a point came twice")
    require(least <= rows <= most, "%s: %d points, %d missed, %d strangers" % (
        what, len(rows), len(least - rows), len(rows - most)))


generator = random.Random(1)
total = 0
for number in range(12):
    look(parallel=number % 2)
    # It has two metres at least: ParaView looks in 32 bits for what lies in a frustum at all.
    left, low = generator.randrange(0, SIZE[0] - 350), generator.randrange(0, SIZE[1] - 260)
    area = [left, low, left + generator.randrange(200, 340), low + generator.randrange(200, 250)]
    simple.SetActiveSource(scene.reader)
    simple.SelectPointsThrough(Rectangle=area, View=scene.view)
    require(scene.reader.SMProxy.GetSelectionInput(0), "nothing is selected in %s" % area)
    # ParaView's frustum is that of the rectangle, and its points are exact.
    selection = servermanager._getPyProxy(scene.reader.SMProxy.GetSelectionInput(0))
    corners = on_screen(numpy.array(selection.Input[0].Frustum).reshape(8, 4)[:, :3])
    low, high = corners.min(axis=0), corners.max(axis=0)
    require(numpy.abs(numpy.r_[low, high] - area).max() < 1.01, "a frustum of %s" % corners)
    places = on_screen(cloud)

    def inside(slack):
        return numpy.all((places >= low - slack) & (places <= high + slack), axis=1)

    wanted, nearly = inside(-NEAR), inside(NEAR)
    extract = simple.ExtractSelection(Input=scene.reader)
    check(places_of(extract), wanted, nearly, "Extract Selection in %s" % area)
    simple.Delete(extract)
    region = PointFrontExtract(Input=scene.reader, UseRegion=0)
    region.Selection = selection
    check(places_of(region), wanted, nearly, "PointFront Extract in %s" % area)
    simple.Delete(region)
    simple.ClearSelection(scene.reader)
    total += int(wanted.sum())
print("%d points" % total)
require(total > 10000, "the rectangles have %d points" % total)
