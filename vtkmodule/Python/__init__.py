"""Point clouds larger than memory in VTK.

    reader = pointfront.vtkPointFrontReader()
    reader.SetFileName("cloud.pfront")
    mapper = pointfront.vtkPointFrontMapper()
    mapper.SetInputConnection(reader.GetOutputPort())

The classes are VTK classes (their C++ headers document them) and go together with vtkmodules.
"""

from .pointfrontCommon import *
from .pointfrontFiltersBuild import *
from .pointfrontFiltersExtract import *
from .pointfrontIOStore import *
from .pointfrontIOLASIndex import *  # readers and mappers know side files of LAS files by it
from .pointfrontRenderingCore import *
from .pointfrontRenderingOpenGL2 import *  # the OpenGL side of the mapper, by VTK's object factory
