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

Clouds, arrays, files and pictures need no VTK. The functions raise PointFrontError. The classes
vtkPointFront... are VTK classes (their C++ headers document them), belong to the VTK whose Python
package VTK_PACKAGE names, and report errors as VTK does. Where that VTK is installed, the import
loads it with its OpenGL side: actors and windows that are made afterwards can be drawn. Where it is
not, asking for such a class is an ImportError that says what to install.
"""

from . import _host
from ._calls import BuildReport, build, index
from ._clouds import Cloud, open
from ._errors import PointFrontError, PointFrontWarning, did_you_mean
from ._far import traffic
from ._host import VTK_PACKAGE
from ._pictures import Picture
from ._version import __version__

if _host.missing_vtk() is None:
    from ._classes import *


def __getattr__(name):
    missing = _host.missing_vtk() if name.startswith("vtk") else None
    if missing is not None:
        raise ImportError(missing)
    raise AttributeError(f"module 'pointfront' has no attribute '{name}'"
                         f"{did_you_mean(name, globals())}")
