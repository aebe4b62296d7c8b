"""Point clouds larger than memory in VTK.

    report = pointfront.build(["tile1.laz", "tile2.laz"], "city.pfront", overwrite=True)
    cloud = pointfront.open("city.pfront")
    arrays = cloud.query(where="classification == 2")    # NumPy arrays by name

    reader = pointfront.vtkPointFrontReader()
    reader.SetFileName("city.pfront")
    mapper = pointfront.vtkPointFrontMapper()
    mapper.SetInputConnection(reader.GetOutputPort())

The functions raise PointFrontError. The classes are VTK classes (their C++ headers document them),
go together with vtkmodules, and report errors as VTK does.
"""

from .pointfrontCommon import *
from .pointfrontFiltersBuild import *
from .pointfrontFiltersExtract import *
from .pointfrontIOStore import *
from .pointfrontIOLASIndex import *  # readers and mappers know side files of LAS files by it
from .pointfrontRenderingCore import *
from .pointfrontRenderingOpenGL2 import *  # the OpenGL side of the mapper, by VTK's object factory

from ._calls import BuildReport, PointFrontError, build, index
from ._clouds import Cloud, open
from ._version import __version__
