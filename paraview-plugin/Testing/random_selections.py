"""pvbatch: random selections name the points that NumPy finds.

Of the seeds (Testing/Whole/random_cases.py) each is one selection of a random view: a rectangle or
a polygon of what the view shows, a rectangle through the cloud, or a query. The overview has 5,000
of the store's points.
"""

import json
import os
import random
import sys

import numpy
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy

simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())
sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../Testing/Whole"))

import visible
from random_cases import seeds
from random_scenes import random_camera
from scene import POINTS, STORE, Scene, require

SIZE = [320, 240]
SLACK = 1.5  # pixels: a point is drawn two pixels wide, and its place is rounded
# At most this share of a picture's points has depths or places that only the last bits tell apart.
DIFFERENT, FEW = 0.005, 3
# A query may name these functions of its arrays, ParaView's own.
FUNCTIONS = {"min": numpy.min, "max": numpy.max, "mean": numpy.mean, "abs": numpy.abs}

scene = Scene()
scene.view.ViewSize = SIZE
scene.color_by(scene.display, "rgb")
simple.Render(scene.view)  # the first one resets the camera


def points_of(source):
    """Places, and the other columns by name."""
    source.UpdatePipeline()
    data = servermanager.Fetch(source)
    if data.GetNumberOfPoints() == 0:
        return numpy.zeros((0, 3)), {"point_id": numpy.zeros(0, numpy.int64)}
    arrays = data.GetPointData()
    return vtk_to_numpy(data.GetPoints().GetData()).copy(), {
        arrays.GetArrayName(i): vtk_to_numpy(arrays.GetArray(i)).copy()
        for i in range(arrays.GetNumberOfArrays()) if arrays.GetArray(i)}


def whole_cloud():
    """Every point of the store, by its rank."""
    whole = simple.OpenDataFile(STORE)
    whole.OverviewPoints = POINTS
    places, columns = points_of(whole)
    simple.Delete(whole)
    require(len(places) == POINTS, "an overview of %d points of %d" % (len(places), POINTS))
    order = numpy.argsort(columns["point_id"])
    return places[order], {name: values[order] for name, values in columns.items()}


cloud, columns = whole_cloud()
bounds = [*cloud.min(axis=0), *cloud.max(axis=0)]
SCALARS = sorted(name for name, values in columns.items()
                 if values.ndim == 1 and name != "point_id" and values.min() < values.max())


def look(camera):
    scene.look_as(camera)
    simple.Render(scene.view)


def on_screen():
    """Pixels from the lower left corner, depths, and who lies between the clipping planes by how
    much: negative beyond them."""
    camera = scene.view.SMProxy.GetActiveCamera()
    matrix = camera.GetCompositeProjectionTransformMatrix(SIZE[0] / SIZE[1], -1, 1)
    matrix = numpy.array([[matrix.GetElement(i, j) for j in range(4)] for i in range(4)])
    clip = numpy.c_[cloud, numpy.ones(len(cloud))] @ matrix.T
    w = numpy.where(clip[:, 3] > 0, clip[:, 3], numpy.nan)
    depths = clip[:, 2] / w
    between = numpy.nan_to_num(1 - numpy.abs(depths), nan=-1.0)
    places = numpy.nan_to_num((clip[:, :2] / w[:, None] + 1) / 2 * SIZE, nan=-1e6)
    return places, numpy.nan_to_num(depths, nan=9.0), between


def shown():
    places, depths, between = on_screen()
    seen = numpy.flatnonzero(between > 0)
    if len(seen) == 0:
        return numpy.full(SIZE[::-1], -1)
    picture = visible.winners(places[seen], depths[seen], SIZE)
    return numpy.where(picture >= 0, seen[picture], -1)


def selected():
    """Ids of what "Extract Selection" takes; they are whole points, each once."""
    extract = simple.ExtractSelection(Input=scene.reader)
    places, found = points_of(extract)
    simple.Delete(extract)
    ids = found["point_id"]
    require(len(set(ids.tolist())) == len(ids), "a point came twice")
    require(numpy.array_equal(places, cloud[ids]), "points are not where the store has them")
    for name, column in columns.items():
        require(len(ids) == 0 or numpy.array_equal(found[name], column[ids], equal_nan=True)
                if column.dtype.kind == "f" else
                len(ids) == 0 or numpy.array_equal(found[name], column[ids]), "other " + name)
    return set(ids.tolist())


def differ(found, least, most):
    """How many points are missed, and how many are strangers."""
    return len(least - found), len(found - most)


def of_rectangle(rng):
    left, low = rng.randrange(0, SIZE[0] - 20), rng.randrange(0, SIZE[1] - 20)
    return [left, low, min(left + rng.randrange(1, 200), SIZE[0] - 1),
            min(low + rng.randrange(1, 160), SIZE[1] - 1)]


def rectangle(rng):
    area = of_rectangle(rng)
    simple.SelectSurfacePoints(Rectangle=area, View=scene.view)
    wanted = set(shown()[area[1]:area[3] + 1, area[0]:area[2] + 1].ravel().tolist()) - {-1}
    return area, wanted, wanted, DIFFERENT


def polygon(rng):
    """Selects in a polygon: its corners, the points surely in it, and those its edges may cut."""
    corners = [(rng.randrange(2, SIZE[0] - 2), rng.randrange(2, SIZE[1] - 2))
               for _ in range(rng.randint(3, 6))]
    simple.SelectSurfacePoints(Polygon=[c for corner in corners for c in corner], View=scene.view)
    picture = shown()
    rows, columns_ = numpy.indices(picture.shape)
    centres = numpy.stack([columns_.ravel() + 0.5, rows.ravel() + 0.5], axis=1)
    moved = [visible.inside_polygon(centres + [x, y], corners).reshape(picture.shape)
             for x in (-1.5, 0, 1.5) for y in (-1.5, 0, 1.5)]
    least, most = (set(picture[inside].ravel().tolist()) - {-1}
                   for inside in (numpy.all(moved, axis=0), numpy.any(moved, axis=0)))
    return corners, least, most, DIFFERENT


def through(rng):
    """Every stored point behind a rectangle, seen or not."""
    area = of_rectangle(rng)
    simple.SelectPointsThrough(Rectangle=area, View=scene.view)
    places, _, between = on_screen()

    def inside(slack, near):
        low, high = numpy.array(area[:2]) - slack, numpy.array(area[2:]) + 1 + slack
        chosen = numpy.all((places >= low) & (places <= high), axis=1) & (between > near)
        return set(numpy.flatnonzero(chosen).tolist())

    return area, inside(-SLACK, 1e-4), inside(SLACK, -1e-4), 0


def condition(rng):
    name = rng.choice(SCALARS)
    value = float(rng.choice(columns[name]))
    operator = rng.choice(("<", "<=", ">", ">=", "==", "!="))
    form = rng.random()
    if form < 0.15:
        return "(%s == %s(%s))" % (name, rng.choice(("min", "max")), name)
    if form < 0.3:
        return "(%s > mean(%s))" % (name, name)
    if form < 0.4:
        return "(abs(%s) %s %r)" % (name, operator, abs(value))
    return "(%s %s %r)" % (name, operator, value)


def query(rng):
    text = condition(rng)
    for _ in range(rng.choice((0, 0, 1, 2))):
        text = "(%s %s %s)" % (text, rng.choice("&|"), condition(rng))
    inverted = rng.random() < 0.3
    simple.QuerySelect(QueryString=text, FieldType="POINT", Source=scene.reader,
                       InsideOut=int(inverted))
    wanted = eval(text, dict(FUNCTIONS), columns) != inverted  # the text is of condition()
    wanted = set(numpy.flatnonzero(wanted).tolist())
    return [text, inverted], wanted, wanted, 0


KINDS = (rectangle, polygon, through, query)
failed = []
totals = {kind.__name__: [0, 0] for kind in KINDS}
for seed in seeds():
    rng = random.Random(seed)
    camera = random_camera(rng, bounds)[1]
    look(camera)
    simple.SetActiveSource(scene.reader)
    kind = KINDS[seed % len(KINDS)]
    case, least, most, share = kind(rng)
    found = selected() if scene.reader.SMProxy.GetSelectionInput(0) else set()
    simple.ClearSelection(scene.reader)
    missed, strangers = differ(found, least, most)
    totals[kind.__name__][0] += 1
    totals[kind.__name__][1] += len(found)
    if missed + strangers > (FEW + share * len(most) if share else 0):
        failed.append(seed)
        print("seed %d, %s %s of %s: %d points, %d missed, %d strangers" % (
            seed, kind.__name__, json.dumps(case), json.dumps(camera), len(found), missed,
            strangers), flush=True)
print("selections and points of them:", totals)
require(not failed, "other points are selected than NumPy finds: seeds %s" % failed)
