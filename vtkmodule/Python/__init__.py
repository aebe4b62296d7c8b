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
belong to the VTK whose Python package VTK_PACKAGE names, and report errors as VTK does. OpenGL's
side of VTK is loaded, too: actors and windows that are made after this import can be drawn.
"""

from . import _host

_host.require_vtk()  # before what would only say which library it misses

from ._calls import BuildReport, build, index
from ._classes import *
from ._clouds import Cloud, open
from ._errors import PointFrontError, PointFrontWarning
from ._host import VTK_PACKAGE
from ._pictures import Picture
from ._version import __version__
