"""The ParaView application: opens the store, comes to rest over several frames, saves a picture.

Runs as `paraview --dr --script=application.py`. The script returns with the first frame; the rest
happens in the application's event loop, as for a user who does nothing. Writes application.json:
{"frames": [[points drawn, complete], ...], "failure": ...}.
"""

import json
import os
import traceback

from paraview import simple

frames = []  # (points drawn, complete) of each, in order


def end(failure):
    """Ends the application at once: it has no way out for scripts, and nothing is left to save."""
    with open(os.path.join(os.environ["POINTFRONT_OUTPUT"], "application.json"), "w") as file:
        json.dump({"frames": frames, "failure": failure}, file)
    os._exit(1 if failure else 0)


def guarded(action):
    def run(*_):
        try:
            action()
        except BaseException:
            end(traceback.format_exc())
    return run


@guarded
def start():
    # A modal dialog would wait for somebody.
    simple.GetSettingsProxy("GeneralSettings").ShowWelcomeDialog = 0
    simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())
    import scene

    shown = scene.Scene(simple.GetActiveViewOrCreate("RenderView"))
    shown.color_by(shown.display, "rgb")
    saving = []

    @guarded
    def rendered():
        if saving:
            return
        frames.append(shown.frame())
        if frames[-1][1]:
            saving.append(True)
            shown.save_complete("application")
            end(None)

    shown.view.SMProxy.AddObserver("EndEvent", rendered)
    shown.view.SMProxy.StillRender()


start()
