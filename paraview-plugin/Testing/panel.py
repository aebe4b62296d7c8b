"""The ParaView application shows on its panel what the view shows, without being asked.

Runs as `paraview --dr --script=panel.py`. Reads what the properties hold, and updates none. Writes
panel.json: what the panel said last.
"""

from paraview import simple

from session import Session

session = Session("panel", points="", limits="")
said = session.found


@session.guarded
def start():
    session.load()
    import scene

    shown = scene.Scene(simple.GetActiveViewOrCreate("RenderView"))

    def tick():
        proxy = shown.display.SMProxy
        said["points"] = proxy.GetProperty("PointsInView").GetElement(0)
        said["limits"] = proxy.GetProperty("LimitedBy").GetElement(0)
        all_points = "{0:,} of {0:,}".format(scene.POINTS)
        if said["points"] == all_points and said["limits"] == "nothing":
            session.end()

    session.every_tick(shown.view, tick)
    shown.view.SMProxy.StillRender()


start()
