"""The ParaView application: a cloud by its address, by the menu Sources, the panel and Apply.

Runs as `paraview --dr --script=far_panel.py`; POINTFRONT_ADDRESS is what is typed into the panel.
Writes far_panel.json: points drawn, whether all are, points of the store, as the frame at rest has
them, and the first line of "Store". Saves far-panel.png.
"""

import ctypes
import json
import os
import time
import traceback

from paraview import simple

found = {"frame": [], "store": "", "failure": None}
LONGEST = 60  # seconds


def end():
    with open(os.path.join(os.environ["POINTFRONT_OUTPUT"], "far_panel.json"), "w") as file:
        json.dump(found, file, indent=1)
    os._exit(1 if found["failure"] else 0)


def guarded(action):
    def run(*_):
        try:
            action()
        except BaseException:
            found["failure"] = traceback.format_exc()
            end()
    return run


@guarded
def start():
    simple.GetSettingsProxy("GeneralSettings").ShowWelcomeDialog = 0
    probe = ctypes.CDLL(os.environ["POINTFRONT_PANEL_PROBE"])
    for name in ("Act", "Press", "Type"):
        getattr(probe, "pointfront" + name).restype = ctypes.c_bool
    simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())
    view = simple.GetActiveViewOrCreate("RenderView")
    interactor = view.SMProxy.GetInteractor()
    begun = time.monotonic()

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
        simple.SaveScreenshot(
            os.path.join(os.environ["POINTFRONT_OUTPUT"], "far-panel.png"), view)
        return end()

    steps = [chooses, types, applies, looks]

    @guarded
    def tick():
        if steps[0]():
            steps.pop(0)
        if time.monotonic() - begun > LONGEST:
            raise AssertionError("stopped at %s: %s" % (steps[0].__name__, found))
        interactor.CreateOneShotTimer(200)

    interactor.AddObserver("TimerEvent", tick)
    interactor.CreateOneShotTimer(2000)
    view.SMProxy.StillRender()


start()
