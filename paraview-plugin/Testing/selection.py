"""Selections name the points that are shown: on one process, or as the client of several ranks.

usage: pvbatch selection.py            on one process
       python3 selection.py PORT       as a client of the server at that port
The overview has 5,000 of the cloud's points, so nearly all that is selected is not among them.
"""

import os
import random
import sys

import numpy
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkCollection

if len(sys.argv) > 1:
    simple.Connect("127.0.0.1", int(sys.argv[1]))
    simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=True, ns=globals())
simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())

from scene import POINTS, SIZE, STORE, Scene, require

RECTANGLES = 50
PICKS = 200
DIFFERENT = 0.05  # share of points that are selected in one of two pictures only
SLACK = 1.5  # pixels: a point is drawn two pixels wide, and its place is rounded

scene = Scene()
scene.view.ViewSize = SIZE
scene.color_by(scene.display, "rgb")
scene.save_complete("selection")


def points_of(source):
    """Coordinates and attributes of all points of a source, gathered from all ranks."""
    data = servermanager.Fetch(source)
    if data.GetNumberOfPoints() == 0:
        return numpy.zeros((0, 3)), {"point_id": numpy.zeros(0, numpy.int64)}
    arrays = data.GetPointData()
    return (vtk_to_numpy(data.GetPoints().GetData()),
            {arrays.GetArrayName(i): vtk_to_numpy(arrays.GetArray(i))
             for i in range(arrays.GetNumberOfArrays())})


def whole_cloud(whole):
    """Every point of the store, by its rank."""
    places, attributes = points_of(whole)
    require(len(places) == POINTS, "the overview of everything has %d points" % len(places))
    order = numpy.argsort(attributes["point_id"])
    return places[order], {name: values[order] for name, values in attributes.items()}


# The same cloud with all points in memory, for ParaView's own points and their selections.
whole = simple.OpenDataFile(STORE)
whole.OverviewPoints = POINTS
stock = simple.Show(whole, scene.view)
stock.SetRepresentationType("Points")
stock.PointSize = 2
stock.Visibility = 0
scene.look()
cloud, attributes = whole_cloud(whole)


def pixels(places):
    """Where points are on the screen, from its lower left corner."""
    camera = scene.view.SMProxy.GetActiveCamera()
    matrix = camera.GetCompositeProjectionTransformMatrix(SIZE[0] / SIZE[1], -1, 1)
    matrix = numpy.array([[matrix.GetElement(i, j) for j in range(4)] for i in range(4)])
    clip = numpy.c_[places, numpy.ones(len(places))] @ matrix.T
    return (clip[:, :2] / clip[:, 3:] + 1) / 2 * SIZE


on_screen = pixels(cloud)


def select(rectangle, cells=False):
    """The selection of a rectangle of pixels, as the rubber band makes it; None if it is empty."""
    representations, sources = vtkCollection(), vtkCollection()
    view = scene.view.SMProxy
    way = view.SelectSurfaceCells if cells else view.SelectSurfacePoints
    way(rectangle, representations, sources, True, 0, False, None)
    require(sources.GetNumberOfItems() < 2, "selected in %d sources" % sources.GetNumberOfItems())
    return sources.GetItemAsObject(0)


def inside(rectangle, slack):
    low, high = numpy.array(rectangle[:2]) - slack, numpy.array(rectangle[2:]) + 1 + slack
    return numpy.all((on_screen >= low) & (on_screen <= high), axis=1)


def check(found, rectangle, what):
    """That extracted points are stored points, whole and each once, and lie in the rectangle."""
    places, values = found
    ids = values["point_id"]
    require(len(set(ids.tolist())) == len(ids), what + ": a point came twice")
    require(numpy.array_equal(places, cloud[ids]), what + ": not where the store has them")
    for name, column in attributes.items():
        require(name in values, "%s: without %s" % (what, name))
        require(numpy.array_equal(values[name], column[ids]), "%s: other %s" % (what, name))
    outside = int((~inside(rectangle, SLACK)[ids]).sum())
    require(outside == 0, "%s: %d of %d outside of the rectangle" % (what, outside, len(ids)))


def extracted(selection, source=scene.reader):
    """What "Extract Selection" makes of it."""
    extract = simple.ExtractSelection(Input=source,
                                      Selection=servermanager._getPyProxy(selection))
    found = points_of(extract)
    simple.Delete(extract)
    return found


def stock_ids():
    """For each rectangle, of the points that ParaView selects when it draws them all itself."""
    scene.display.Visibility, stock.Visibility = 0, 1
    scene.view.SMProxy.StillRender()
    ids = []
    for rectangle in rectangles():
        selection = select(rectangle)
        found = set() if selection is None else extracted(selection, whole)[1]["point_id"].tolist()
        ids.append(set(found))
    scene.display.Visibility, stock.Visibility = 1, 0
    scene.view.SMProxy.StillRender()
    return ids


def rectangles():
    generator = random.Random(1)
    for _ in range(RECTANGLES):
        left, low = generator.randrange(0, SIZE[0] - 20), generator.randrange(0, SIZE[1] - 20)
        yield [left, low, min(left + generator.randrange(1, 160), SIZE[0] - 1),
               min(low + generator.randrange(1, 90), SIZE[1] - 1)]


def check_rectangles():
    ours = theirs = different = 0
    for number, (rectangle, wanted) in enumerate(zip(rectangles(), stock_ids())):
        selection = select(rectangle, cells=number % 5 == 4)
        ids = set()
        if selection is not None:
            found = extracted(selection)
            check(found, rectangle, "rectangle %s" % rectangle)
            ids = set(found[1]["point_id"].tolist())
        ours, theirs = ours + len(ids), theirs + len(wanted)
        different += len(ids ^ wanted)
    print("%d points in %d rectangles; ParaView's own points: %d, not in both: %d"
          % (ours, RECTANGLES, theirs, different))
    require(theirs > 20000, "the rectangles show next to nothing")
    # Mesa rounds places to 1/256 of a pixel, and of points in one pixel the nearer one is shown.
    require(different < DIFFERENT * theirs, "not all that is shown is selected")


def check_shown_selection():
    """What the view highlights, the spreadsheet and tooltips show: the selection set in ParaView."""
    rectangle = [200, 100, 420, 220]
    selection = select(rectangle)
    scene.reader.SMProxy.SetSelectionInput(0, selection, 0)
    shown = servermanager._getPyProxy(scene.reader.SMProxy.GetSelectionOutput(0))
    shown.UpdatePipeline()
    check(points_of(shown), rectangle, "the active selection")
    scene.save("selection-shown")
    scene.reader.SMProxy.SetSelectionInput(0, None, 0)


check_rectangles()
check_shown_selection()
if len(sys.argv) > 1:
    simple.Disconnect()
