"""A lens that follows the mouse: lens.py STORE.pfront [CLASS ...]

Inside the lens the named classes are hidden, by default vegetation (3, 4 and 5), and what is left
is drawn by intensity. Ctrl with the mouse wheel changes its size; the key l turns it on and off.
"""

import sys

import pointfront
from vtkmodules import vtkInteractionStyle, vtkRenderingCore


def main(store, classes):
    style = pointfront.vtkPointFrontStyle()
    style.SetTechnique("splats")
    style.SetEyeDomeStrength(0.4)
    lens = style.AddCircleLens(320, 240, 120)
    style.SetLensStyle(lens, '{"color": "intensity"}')
    for code in classes:
        style.SetLensStyle(lens, '{"visible": false}', code)

    reader = pointfront.vtkPointFrontReader()
    reader.SetFileName(store)
    mapper = pointfront.vtkPointFrontMapper()
    mapper.SetInputConnection(reader.GetOutputPort())
    mapper.SetStyle(style)
    mapper.CompleteOn()  # a view at rest shows every point that it needs; one in motion never waits
    actor = vtkRenderingCore.vtkActor()
    actor.SetMapper(mapper)
    renderer = vtkRenderingCore.vtkRenderer()
    renderer.AddActor(actor)
    window = vtkRenderingCore.vtkRenderWindow()
    window.SetSize(960, 600)
    window.AddRenderer(renderer)
    interactor = window.MakeRenderWindowInteractor()
    interactor.SetInteractorStyle(vtkInteractionStyle.vtkInteractorStyleTrackballCamera())

    widget = pointfront.vtkPointFrontLensWidget()
    widget.SetInteractor(interactor)
    widget.SetStyle(style)
    widget.SetLens(lens)
    widget.On()
    window.Render()
    interactor.Start()


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(sys.argv[1], [int(code) for code in sys.argv[2:]] or [3, 4, 5])
