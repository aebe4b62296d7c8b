"""vtkPointFrontExtract gives NumPy arrays: positions as doubles, attributes by name. Arguments:
points store"""

import sys

import numpy
from vtkmodules.numpy_interface import dataset_adapter
from vtkmodules.vtkCommonCore import vtkCommand
from vtkmodules.vtkCommonDataModel import vtkPlanes
from vtkmodules.vtkRenderingCore import vtkCamera

import pointfront

points, store = sys.argv[1:3]

builder = pointfront.vtkPointFrontBuilder()
builder.AddFileName(points)
builder.SetOutputFileName(store)
builder.OverwriteOn()
assert builder.Write() == 1, builder.GetErrorCode()


def arrays(extract):
    """Positions, and a dictionary of the attributes."""
    extract.Update()
    data = dataset_adapter.WrapDataObject(extract.GetOutput())
    return numpy.asarray(data.Points), {
        name: numpy.asarray(data.PointData[name]) for name in data.PointData.keys()}


whole = pointfront.vtkPointFrontExtract()
whole.SetFileName(store)
positions, attributes = arrays(whole)
assert positions.dtype == numpy.float64 and positions.shape[1] == 3
assert len(positions) == builder.GetNumberOfPointsStored()
ids = attributes["point_id"]
assert ids.dtype == numpy.int64 and (ids == numpy.arange(len(ids))).all()
assert attributes["intensity"].dtype == numpy.uint16
assert attributes["rgb"].shape == (len(ids), 3)

# A box, classes and a range are masks over the whole.
low, high = numpy.quantile(positions, 0.3, axis=0), numpy.quantile(positions, 0.6, axis=0)
low[2], high[2] = -numpy.inf, numpy.inf
some = pointfront.vtkPointFrontExtract()
some.SetFileName(store)
some.UseBoxOn()
some.SetBox(low[0], high[0], low[1], high[1], low[2], high[2])
some.SetWhere("intensity in [20, 90]")
some.AddObjectClass(0)  # all that this cloud has
mask = ((positions >= low) & (positions <= high)).all(axis=1)
mask &= (attributes["intensity"] >= 20) & (attributes["intensity"] <= 90)
chosen, named = arrays(some)
assert 100 < mask.sum() < len(mask) / 4, mask.sum()
assert (named["point_id"] == ids[mask]).all()
assert (chosen == positions[mask]).all()
for name, values in attributes.items():
    assert (named[name] == values[mask]).all(), name

some.ClearObjectClasses()
some.AddObjectClass(2)
assert len(arrays(some)[0]) == 0
some.ClearObjectClasses()
some.Update()

# A camera's view is a region, too: vtkPlanes as pickers and cameras fill them.
camera = vtkCamera()
middle = positions.mean(axis=0)
camera.SetPosition(*(middle + (300.0, -400.0, 500.0)))
camera.SetFocalPoint(*middle)
camera.SetViewAngle(20.0)
camera.SetClippingRange(10.0, 800.0)
coefficients = [0.0] * 24
camera.GetFrustumPlanes(1.5, coefficients)
planes = vtkPlanes()
planes.SetFrustumPlanes(coefficients)
seen = pointfront.vtkPointFrontExtract()
seen.SetFileName(store)
seen.SetFrustum(planes)
inward = numpy.array(coefficients).reshape(6, 4)
mask = (positions @ inward[:, :3].T + inward[:, 3] >= 0).all(axis=1)
assert 1000 < mask.sum() < len(mask) / 2, mask.sum()
assert (arrays(seen)[1]["point_id"] == ids[mask]).all()

# By ids: what a selection names.
picked = pointfront.vtkPointFrontExtract()
picked.SetFileName(store)
wanted = some.GetOutput().GetPointData().GetArray("point_id")
picked.SetPointIds(wanted)
again, _ = arrays(picked)
assert (again == chosen).all()

# An error has a code and a message that an observer gets.
said = []
some.AddObserver(vtkCommand.ErrorEvent, lambda o, e: said.append(e))
some.SetWhere("nonsense > 3")
some.Update()
assert some.GetErrorCode() != 0 and said, said
