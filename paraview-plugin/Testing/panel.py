"""The ParaView application shows on its panel what the view shows, without being asked, and then
rests: no frame, no processor time. So it is of a cloud that is out of view. A quality is typed into
the panel.

Runs as `paraview --dr --script=panel.py`. Reads what the properties hold, and updates none. Writes
panel.json: what the panel said last.
"""

import ctypes
import os
import time

from paraview import simple

from session import AT_REST, Session

RESTS = 10  # ticks of the event loop in which nothing else happens

session = Session("panel", points="", limits="", unseen=[], quality=[], frames=-1, seconds=-1.0)
said = session.found


@session.guarded
def start():
    probe = ctypes.CDLL(os.environ["POINTFRONT_PANEL_PROBE"])
    probe.pointfrontType.restype = ctypes.c_bool
    session.load()
    import scene

    shown = scene.Scene(simple.GetActiveViewOrCreate("RenderView"))
    # Another is turned about the origin, out of the view.
    unseen = shown.show(simple.OpenDataFile(scene.STORE))
    unseen.Orientation = [180, 0, 0]
    simple.SetActiveSource(shown.reader)

    drawn, states = [], []  # a frame each; at each tick of a complete view, frames and seconds
    shown.view.SMProxy.AddObserver("EndEvent", lambda *_: drawn.append(1))

    def rested():
        states.append((len(drawn), time.process_time()))
        if len(states) == AT_REST + RESTS:
            said["frames"], said["seconds"] = (
                round(last - first, 3) for first, last in zip(states[AT_REST - 1], states[-1]))
        return len(states) >= AT_REST + RESTS

    def tick():
        proxy = shown.display.SMProxy
        said["points"] = proxy.GetProperty("PointsInView").GetElement(0)
        said["limits"] = proxy.GetProperty("LimitedBy").GetElement(0)
        said["unseen"] = [unseen.SMProxy.GetProperty(name).GetElement(0) for name in
                          ("FrameComplete", "LimitedBy")]
        all_points = "{0:,} of {0:,}".format(scene.POINTS)
        if not said["quality"]:
            if said["points"] != all_points or said["limits"] != "nothing" or not rested() \
                    or not probe.pointfrontType(b"Quality", b" 0.9 "):
                return
        said["quality"] = [proxy.GetProperty(name).GetElement(0) for name in
                           ("Quality", "Technique", "TargetError", "QualityChosen")]
        if said["quality"][0] == "0.9":
            session.end()

    session.every_tick(shown.view, tick)
    shown.view.SMProxy.StillRender()


start()
