"""Opens a store with the wrapped classes, shows it, refines it and colours it by a table.

usage: TestShow.py STORE
"""
import sys
import time

import pointfront
from vtkmodules import vtkCommonCore

from shown import Shown

def check(condition, message):
    if not condition:
        sys.exit("TestShow.py: " + message)


reader = pointfront.vtkPointFrontReader()
reader.SetFileName(sys.argv[1])
shown = Shown(reader)
mapper, window = shown.mapper, shown.window
check(mapper.IsA("vtkOpenGLPointFrontMapper"), "the factory gave " + mapper.GetClassName())
shown.renderer.ResetCamera()
window.Render()
first = mapper.GetLastPointsDrawn()
check(first > 0, "the first frame is empty")
deadline = time.time() + 60
while not mapper.GetLastComplete() and time.time() < deadline:
    if mapper.NeedsRender():
        window.Render()
    else:
        time.sleep(0.001)
check(mapper.GetLastComplete(), "did not settle in a minute")
refined = shown.pixels()
mapper.CompleteOn()
window.Render()
check((shown.pixels() == refined).all(), "a complete render differs from the refined picture")
check((refined.max(axis=1) > 0).mean() > 0.2, "most of the picture is empty")

store = mapper.GetStore()
names = [store.GetAttributeName(i) for i in range(store.GetNumberOfAttributes())]
check("intensity" in names and "rgb" in names, "attributes: %s" % names)
bounds = mapper.GetBounds()
table = vtkCommonCore.vtkLookupTable()
table.SetTableRange(bounds[4], bounds[5])
table.Build()
mapper.SetScalarModeToUsePointFieldData()
mapper.SelectColorArray("elevation")
mapper.SetLookupTable(table)
mapper.UseLookupTableScalarRangeOn()
window.Render()
check((shown.pixels() != refined).any(axis=1).mean() > 0.2, "elevation changed no colour")
