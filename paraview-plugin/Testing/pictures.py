"""Pictures as arrays, and how much two of them differ."""

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter


def load(path):
    """Rows x columns x (red, green, blue), 8 bits."""
    reader = vtkPNGReader()
    reader.SetFileName(path)
    if not reader.CanReadFile(path):
        raise AssertionError("no picture: " + path)
    reader.Update()
    image = reader.GetOutput()
    columns, rows, _ = image.GetDimensions()
    scalars = vtk_to_numpy(image.GetPointData().GetScalars())
    return scalars.reshape(rows, columns, -1)[:, :, :3].astype(numpy.int16)


def shown(view):
    """Returns the window of a render view: as load(), without a further frame."""
    grab = vtkWindowToImageFilter()
    grab.SetInput(view.SMProxy.GetRenderWindow())
    grab.ShouldRerenderOff()
    grab.ReadFrontBufferOff()
    grab.Update()
    image = grab.GetOutput()
    columns, rows, _ = image.GetDimensions()
    scalars = vtk_to_numpy(image.GetPointData().GetScalars())
    return scalars.reshape(rows, columns, -1)[:, :, :3].astype(numpy.int16)


def save(path, picture):
    """As load() gives it."""
    rows, columns, _ = picture.shape
    image = vtkImageData()
    image.SetDimensions(columns, rows, 1)
    image.GetPointData().SetScalars(
        numpy_to_vtk(picture.reshape(-1, 3).astype(numpy.uint8), deep=True))
    writer = vtkPNGWriter()
    writer.SetFileName(path)
    writer.SetInputData(image)
    writer.Write()


def covered(picture):
    """Share of pixels that are not background (black)."""
    return float(numpy.mean(picture.max(axis=2) > 0))


def differing(one, other, channel):
    """Share of pixels whose largest channel difference is more than `channel` (0..255)."""
    if one.shape != other.shape:
        raise AssertionError("sizes differ: %s and %s" % (one.shape, other.shape))
    return float(numpy.mean(numpy.abs(one - other).max(axis=2) > channel))
