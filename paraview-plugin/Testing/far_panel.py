"""The ParaView application: a cloud by its address, by the menu Sources, the panel and Apply.

Runs as `paraview --dr --script=far_panel.py`; POINTFRONT_ADDRESS is what is typed into the panel.
Writes far_panel.json: points drawn, whether all are, points of the store, as the frame at rest has
them, and the first line of "Store". Saves far-panel.png.
"""

import ctypes
import os

from paraview import simple

from session import OUTPUT, Session

session = Session("far_panel", frame=[], store="")
found = session.found


@session.guarded
def start():
    probe = ctypes.CDLL(os.environ["POINTFRONT_PANEL_PROBE"])
    for name in ("Act", "Press", "Type"):
        getattr(probe, "pointfront" + name).restype = ctypes.c_bool
    session.load()
    view = simple.GetActiveViewOrCreate("RenderView")

    def chooses():
        return probe.pointfrontAct(b"PointFrontRemoteCloud")

    def types():
        address = os.environ["POINTFRONT_ADDRESS"].encode()
        return simple.GetActiveSource() and probe.pointfrontType(b"URL", address)

    def applies():
        return probe.pointfrontPress(b"Accept")

    def looks():
        source = simple.GetActiveSource()
        if not simple.servermanager.GetRepresentation(source, view):
            return False
        proxy = simple.GetDisplayProperties(source, view).SMProxy
        proxy.UpdatePropertyInformation()
        found["frame"] = [proxy.GetProperty(name).GetElement(0)
                          for name in ("FrameComplete", "PointsInView", "LimitedBy")]
        found["store"] = source.SMProxy.GetProperty("StoreFacts").GetElement(0).split("\n")[0]
        if not found["frame"][0] or found["frame"][1].startswith("0 "):
            return False
        simple.SaveScreenshot(os.path.join(OUTPUT, "far-panel.png"), view)
        return session.end()

    steps = [chooses, types, applies, looks]

    def step():
        if steps[0]():
            steps.pop(0)

    session.every_tick(view, step, lambda: steps[0].__name__)
    view.SMProxy.StillRender()


start()
