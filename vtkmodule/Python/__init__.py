"""Point clouds larger than memory in VTK.

    report = pointfront.build(["tile1.laz", "tile2.laz"], "city.pfront", overwrite=True)
    with pointfront.open("city.pfront") as cloud:
        ground = cloud.points(classes=2, spacing=0.5)    # NumPy arrays by name
        cloud.screenshot("city.png", color_by="elevation")    # no display, no OpenGL
        cloud.show()

    plotter = pyvista.Plotter()
    pointfront.open("city.pfront").add_to(plotter, scalars="intensity")

    reader = pointfront.vtkPointFrontReader()
    reader.SetFileName("city.pfront")
    mapper = pointfront.vtkPointFrontMapper()
    mapper.SetInputConnection(reader.GetOutputPort())

The functions raise PointFrontError. The classes are VTK classes (their C++ headers document them),
belong to the VTK whose Python package VTK_PACKAGE names, and report errors as VTK does. VTK is
loaded when something of it is first used.
"""

import importlib

from ._errors import PointFrontError
from ._host import VTK_PACKAGE
from ._version import __version__

_PLACES = {
    "BuildReport": "_calls",
    "Cloud": "_clouds",
    "Picture": "_pictures",
    "build": "_calls",
    "index": "_calls",
    "open": "_clouds",
}


def __getattr__(name):
    if name.startswith("_"):
        raise AttributeError(f"module 'pointfront' has no attribute '{name}'")
    place = importlib.import_module("." + _PLACES.get(name, "_classes"), __name__)
    try:
        value = getattr(place, name)
    except AttributeError:
        raise AttributeError(f"module 'pointfront' has no attribute '{name}'") from None
    globals()[name] = value
    return value


def __dir__():
    classes = importlib.import_module("._classes", __name__)
    names = {name for name in dir(classes) if name.startswith("vtk")}
    return sorted(names | set(_PLACES) | set(globals()))
