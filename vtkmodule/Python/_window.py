"""A window of this machine's display that shows a stored cloud."""

import os
import signal
import threading

from . import _host
from ._errors import PointFrontError
from .pointfrontIOStore import vtkPointFrontReader
from .pointfrontRenderingCore import vtkPointFrontMapper
from .pointfrontRenderingOpenGL2 import vtkOpenGLPointFrontMapper  # registers the drawing

LOOK_MS = 100  # for an interrupt


class _Interrupts:
    """Ctrl-C while VTK's loop runs, which no Python code would see: ends that loop."""

    def __init__(self, interactor):
        self._interactor = interactor
        self._came = False

    def _end(self, *_):
        self._came = True
        self._interactor.TerminateApp()

    def run(self):
        if threading.current_thread() is not threading.main_thread():
            self._interactor.Start()
            return
        before = signal.signal(signal.SIGINT, self._end)
        # Python calls its handler only when it runs: at these events.
        looks = self._interactor.AddObserver("TimerEvent", lambda *_: None)
        timer = self._interactor.CreateRepeatingTimer(LOOK_MS)
        try:
            self._interactor.Start()
        finally:
            self._interactor.DestroyTimer(timer)
            self._interactor.RemoveObserver(looks)
            if before is not None:  # a handler that is not Python's cannot be set again
                signal.signal(signal.SIGINT, before)
        if self._came:
            raise KeyboardInterrupt


def show(path, size, title):
    """See Cloud.show."""
    if os.name == "posix" and not os.environ.get("DISPLAY"):
        raise PointFrontError("there is no display (DISPLAY is not set); use screenshot()")
    _host.vtk("vtkInteractionStyle")
    _host.vtk("vtkRenderingUI")
    core = _host.vtk("vtkRenderingCore")
    reader = vtkPointFrontReader()
    reader.SetFileName(path)
    mapper = vtkPointFrontMapper()
    assert isinstance(mapper, vtkOpenGLPointFrontMapper)
    mapper.SetInputConnection(reader.GetOutputPort())
    actor = core.vtkActor()
    actor.SetMapper(mapper)
    renderer = core.vtkRenderer()
    renderer.AddActor(actor)
    window = core.vtkRenderWindow()
    window.SetSize(*size)
    window.SetWindowName(title)
    window.AddRenderer(renderer)
    interactor = window.MakeRenderWindowInteractor()
    interactor.Initialize()
    mapper.RenderWhenDataArrives(interactor)
    window.Render()
    try:
        _Interrupts(interactor).run()
    finally:
        mapper.RenderWhenDataArrives(None)
