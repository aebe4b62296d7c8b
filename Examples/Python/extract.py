"""The points of an area as NumPy arrays: extract.py STORE.pfront 'POLYGON ((x y, ...))' [CONDITION]

Only the parts of the store that the area meets are read, so this works on clouds that are larger
than memory as long as the answer is not.
"""

import sys

import pointfront
from vtkmodules.util.numpy_support import vtk_to_numpy


def main(store, area, condition=""):
    extract = pointfront.vtkPointFrontExtract()
    extract.SetFileName(store)
    extract.SetWellKnownText(area)
    extract.SetWhere(condition)
    extract.SetMaximumNumberOfPoints(50_000_000)  # more is an error, not a machine without memory
    extract.Update()
    if extract.GetErrorCode() != 0:
        sys.exit(1)  # VTK has said why

    chosen = extract.GetOutput()
    positions = vtk_to_numpy(chosen.GetPoints().GetData())  # n x 3 doubles
    data = chosen.GetPointData()
    attributes = {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i))
                  for i in range(data.GetNumberOfArrays())}
    print(f"{len(positions)} points, {extract.GetNumberOfBytesRead()} bytes read")
    for name, values in sorted(attributes.items()):
        span = f", {values.min()} to {values.max()}" if len(values) else ""
        print(f"  {name}: {values.dtype}{span}")


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    main(*sys.argv[1:])
