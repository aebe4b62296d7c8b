"""vtkPointFrontBuilder from Python: observers, an abort, an error. Arguments: points store"""

import os
import sys

from vtkmodules.vtkCommonCore import vtkCommand
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm

import pointfront

points, store = sys.argv[1:3]
fractions, phases, previews = [], [], []


def progress(builder, event):
    fractions.append(builder.GetProgress())
    if not phases or phases[-1] != builder.GetProgressText():
        phases.append(builder.GetProgressText())


def preview(builder, event):
    early = pointfront.vtkPointFrontReader()
    early.SetFileName(builder.GetPreviewFileName())
    early.Update()
    previews.append(early.GetOutput().GetNumberOfPoints())


builder = pointfront.vtkPointFrontBuilder()
assert isinstance(builder, vtkAlgorithm)
builder.AddFileName(points)
builder.SetOutputFileName(store)
builder.OverwriteOn()
builder.SetMemoryLimit(1 << 30)
builder.SetPreviewPoints(1000)
builder.AddObserver(vtkCommand.ProgressEvent, progress)
builder.AddObserver(vtkCommand.UpdateDataEvent, preview)
assert builder.Write() == 1, builder.GetErrorCode()
assert builder.GetNumberOfPointsRead() == builder.GetNumberOfPointsStored() > 100000
assert fractions and fractions == sorted(fractions) and fractions[-1] == 1.0, fractions
assert phases, phases

reader = pointfront.vtkPointFrontReader()
reader.SetFileName(store)
reader.Update()
assert reader.GetStore().GetNumberOfPoints() == builder.GetNumberOfPointsStored()
assert not os.path.exists(builder.GetPreviewFileName())

# An abort from an observer ends the build; what was there stays.
size = os.path.getsize(store)
builder.AddObserver(vtkCommand.ProgressEvent, lambda b, e: b.AbortExecuteOn())
assert builder.Write() == 0
assert os.path.getsize(store) == size
assert not [name for name in os.listdir(os.path.dirname(store)) if name.endswith(".tmp")]

# The tool's options are properties here: structure, attributes, normals, heights.
shaped = pointfront.vtkPointFrontBuilder()
shaped.AddFileName(points)
shaped.SetOutputFileName(store + ".shaped.pfront")
shaped.OverwriteOn()
shaped.SetStructureToKdTree()
shaped.SetLayersToNone()
shaped.SetNormalsToScanLine()
shaped.LocalHeightOn()
assert not shaped.GetSplatRadius()
shaped.SplatRadiusOn()
for name in ("intensity", "normal", "local_height", "splat_radius"):
    shaped.AddAttribute(name)
assert shaped.Write() == 1, shaped.GetErrorCode()
reader.SetFileName(store + ".shaped.pfront")
reader.Update()
opened = reader.GetStore()
names = {opened.GetAttributeName(i) for i in range(opened.GetNumberOfAttributes())}
assert names == {"intensity", "normal", "local_height", "splat_radius"}, names
shaped.CurvatureOn()  # comes from PCA, which is not asked for
refused = []
shaped.AddObserver(vtkCommand.ErrorEvent, lambda b, e: refused.append(e))
assert shaped.Write() == 0 and shaped.GetErrorCode() != 0 and len(refused) == 1, refused

# An error has a code, and a message that an observer gets.
said = []
wrong = pointfront.vtkPointFrontBuilder()
wrong.AddObserver(vtkCommand.ErrorEvent, lambda b, e: said.append(e))
assert wrong.Write() == 0 and wrong.GetErrorCode() != 0
wrong.AddFileName("no/such.las")
wrong.SetOutputFileName(store + ".other")
assert wrong.Write() == 0
assert len(said) == 2, said
