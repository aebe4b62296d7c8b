"""The wrapped VTK classes, all of them; importing this loads VTK."""

from .pointfrontCommon import *
from .pointfrontFiltersBuild import *
from .pointfrontFiltersExtract import *
from .pointfrontIOStore import *
from .pointfrontIOLASIndex import *  # readers and mappers know side files of LAS files by it
from .pointfrontRenderingCore import *
from .pointfrontRenderingOpenGL2 import *  # the OpenGL side of the mapper, by VTK's object factory
