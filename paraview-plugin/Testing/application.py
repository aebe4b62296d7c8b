"""The ParaView application: opens the store, comes to rest, is moved, comes to rest again.

Runs as `paraview --dr --script=application.py`. The script returns with the first frame; the rest
happens in the application's event loop, as for a user. Saves application.png. Writes
application.json: the frames of each phase, as [points drawn, complete], and what failed.
"""

from paraview import simple

from session import Session

phases = {"opened": [], "moving": [], "at rest again": []}
session = Session("application", phases=phases)


@session.guarded
def start():
    session.load()
    import scene

    shown = scene.Scene(simple.GetActiveViewOrCreate("RenderView"))
    shown.color_by(shown.display, "rgb")
    # So that 174,151 points are too many for a frame in motion.
    shown.display.TargetFrameTime = 2.0  # milliseconds
    current = ["opened"]

    @session.guarded
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
            session.end()

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
