"""The ParaView application: opens the store, comes to rest, is moved, comes to rest again.

Runs as `paraview --dr --script=application.py`. The script returns with the first frame; the rest
happens in the application's event loop, as for a user. Saves application.png. Writes
application.json: the frames of each phase, as [points drawn, complete], and what failed.
"""

import json
import os
import traceback

from paraview import simple

phases = {"opened": [], "moving": [], "at rest again": []}


def end(failure):
    """Ends the application at once: it has no way out for scripts, and nothing is left to save."""
    with open(os.path.join(os.environ["POINTFRONT_OUTPUT"], "application.json"), "w") as file:
        json.dump({"phases": phases, "failure": failure}, file)
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
    # So that 174,151 points are too many for a frame in motion.
    shown.display.TargetFrameTime = 2.0  # milliseconds
    current = ["opened"]

    @guarded
    def rendered():
        phase = current[0]
        if phase is None:
            return
        phases[phase].append(shown.frame())
        complete = phases[phase][-1][1]
        if phase == "opened" and complete:
            current[0] = None
            shown.save_complete("application")
            drag()
        elif phase == "at rest again" and complete:
            current[0] = None
            end(None)

    def drag():
        """As the interactor tells of a mouse that is pressed, moved to and fro, and let go."""
        interactor = shown.view.SMProxy.GetInteractor()
        camera = shown.view.SMProxy.GetActiveCamera()
        current[0] = "moving"
        interactor.InvokeEvent("StartInteractionEvent")
        for step in range(10):
            camera.Azimuth(1 if step % 2 == 0 else -1)
            interactor.InvokeEvent("InteractionEvent")
            interactor.InvokeEvent("RenderEvent")
        current[0] = "at rest again"
        interactor.InvokeEvent("EndInteractionEvent")

    shown.view.SMProxy.AddObserver("EndEvent", rendered)
    shown.view.SMProxy.StillRender()


start()
