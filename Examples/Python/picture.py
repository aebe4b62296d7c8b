"""Writes a picture of a store, without a window:

    picture.py STORE.pfront PICTURE.png [ATTRIBUTE]

Coloured by the attribute through a lookup table; by the colours of the points if none is named.
"""

import sys

import pointfront
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkRenderer,
    vtkRenderWindow,
    vtkWindowToImageFilter,
)


def open_store(path):
    """A reader of the store, updated. If it cannot be read, VTK says why and the script ends."""
    reader = pointfront.vtkPointFrontReader()
    reader.SetFileName(path)
    reader.Update()
    if reader.GetErrorCode() != 0:
        sys.exit(1)
    return reader


def mapper_of(reader, attribute):
    """A mapper that waits until the picture is complete."""
    mapper = pointfront.vtkPointFrontMapper()
    mapper.SetInputConnection(reader.GetOutputPort())
    mapper.CompleteOn()
    if attribute:
        values = reader.GetOutput().GetPointData().GetArray(attribute)
        if values is None:
            sys.exit(f"{reader.GetFileName()} has no attribute '{attribute}'")
        table = vtkLookupTable()
        table.SetHueRange(0.66, 0.0)  # blue to red
        table.Build()
        mapper.SetLookupTable(table)
        mapper.SetScalarRange(values.GetRange())
        mapper.SetScalarModeToUsePointFieldData()
        mapper.SelectColorArray(attribute)
    return mapper


def main(store, picture, attribute=None):
    actor = vtkActor()
    actor.SetMapper(mapper_of(open_store(store), attribute))
    actor.GetProperty().SetPointSize(2)
    renderer = vtkRenderer()
    renderer.AddActor(actor)
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetSize(1280, 720)
    window.AddRenderer(renderer)
    window.Render()

    image = vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetInputConnection(image.GetOutputPort())
    writer.SetFileName(picture)
    writer.Write()
    print(actor.GetMapper().GetLastPointsDrawn(), "points drawn")


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    main(*sys.argv[1:])
