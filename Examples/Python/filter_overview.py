"""Uses a store's overview with VTK's filters and NumPy: filter_overview.py STORE.pfront

The reader's output is an ordinary vtkPolyData that holds a fair subset of the cloud, so every
filter works on it at once, however large the cloud is.
"""

import sys

import pointfront
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkThresholdPoints


def main(store):
    reader = pointfront.vtkPointFrontReader()
    reader.SetFileName(store)
    reader.SetOverviewPoints(20000)
    reader.UpdateInformation()
    if reader.GetErrorCode() != 0:
        sys.exit(1)  # VTK has said why
    # Model only what is needed: one attribute.
    for index in range(reader.GetNumberOfPointArrays()):
        name = reader.GetPointArrayName(index)
        reader.SetPointArrayStatus(name, name == "intensity")
    reader.Update()

    overview = reader.GetOutput()
    points = vtk_to_numpy(overview.GetPoints().GetData())
    print(f"{len(points)} points of {reader.GetStore().GetNumberOfPoints()}")
    print("mean x, y, z:", *(f"{value:.2f}" for value in points.mean(axis=0)))

    bright = vtkThresholdPoints()
    bright.SetInputConnection(reader.GetOutputPort())
    bright.SetInputArrayToProcess(0, 0, 0, 0, "intensity")
    bright.ThresholdByUpper(128)
    bright.Update()
    print(bright.GetOutput().GetNumberOfPoints(), "of them have an intensity of 128 or more")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
