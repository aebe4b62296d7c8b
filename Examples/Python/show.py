"""Shows a store in a window: show.py STORE.pfront"""
import sys

import pointfront
from vtkmodules import vtkInteractionStyle, vtkRenderingCore

reader = pointfront.vtkPointFrontReader()
reader.SetFileName(sys.argv[1])
mapper = pointfront.vtkPointFrontMapper()
mapper.SetInputConnection(reader.GetOutputPort())
mapper.CompleteOn()  # a view at rest shows every point that it needs; one in motion never waits
actor = vtkRenderingCore.vtkActor()
actor.SetMapper(mapper)
renderer = vtkRenderingCore.vtkRenderer()
renderer.AddActor(actor)
window = vtkRenderingCore.vtkRenderWindow()
window.AddRenderer(renderer)
interactor = window.MakeRenderWindowInteractor()
window.Render()
interactor.Start()
