"""The ParaView application shows on its panel what the view shows, without being asked.

Runs as `paraview --dr --script=panel.py`. Reads what the properties hold, and updates none. Writes
panel.json: what the panel said last.
"""

import json
import os
import time
import traceback

from paraview import simple

said = {"points": "", "limits": "", "failure": None}
LONGEST = 60  # seconds


def end():
    with open(os.path.join(os.environ["POINTFRONT_OUTPUT"], "panel.json"), "w") as file:
        json.dump(said, file)
    os._exit(1 if said["failure"] else 0)


def guarded(action):
    def run(*_):
        try:
            action()
        except BaseException:
            said["failure"] = traceback.format_exc()
            end()
    return run


@guarded
def start():
    simple.GetSettingsProxy("GeneralSettings").ShowWelcomeDialog = 0
    simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())
    import scene

    shown = scene.Scene(simple.GetActiveViewOrCreate("RenderView"))
    begun = time.monotonic()
    interactor = shown.view.SMProxy.GetInteractor()

    @guarded
    def tick():
        proxy = shown.display.SMProxy
        said["points"] = proxy.GetProperty("PointsInView").GetElement(0)
        said["limits"] = proxy.GetProperty("LimitedBy").GetElement(0)
        all_points = "{0:,} of {0:,}".format(scene.POINTS)
        if said["points"] == all_points and said["limits"] == "nothing":
            end()
        if time.monotonic() - begun > LONGEST:
            raise AssertionError("the panel says %s" % said)
        interactor.CreateOneShotTimer(200)

    interactor.AddObserver("TimerEvent", tick)
    interactor.CreateOneShotTimer(200)
    shown.view.SMProxy.StillRender()


start()
