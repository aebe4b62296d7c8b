"""The ParaView application: what the panel of a cloud needs in width, and the heads of its tables.

Runs as `paraview --dr --script=panel_width.py`. Writes panel_width.json: what PanelProbe.cxx saw of
a sphere of ParaView's, and of a cloud.
"""

import ctypes
import json
import os

from paraview import simple

from session import AT_REST, Session

session = Session("panel_width")
said = session.found


@session.guarded
def start():
    probe = ctypes.CDLL(os.environ["POINTFRONT_PANEL_PROBE"])
    probe.pointfrontPanel.restype = ctypes.c_char_p
    probe.pointfrontWrite.restype = ctypes.c_bool
    session.load()
    import scene

    view = simple.GetActiveViewOrCreate("RenderView")
    sphere = simple.Sphere()
    simple.Show(sphere, view)
    simple.SetActiveSource(sphere)
    seen, rows = [], []  # the panel and the rows of its table at each tick

    def rests(states):
        return len(states) >= AT_REST and all(one == states[-1] for one in states[-AT_REST:])

    def show_cloud():
        simple.Delete(sphere)
        shown = scene.Scene(view)
        shown.display.LensShape = "Around a class"
        shown.display.ClassStyles = ["6", "splats", "#ff0000", "3", "2", "", "intensity", ""]
        simple.SetActiveSource(shown.reader)
        view.SMProxy.StillRender()

    def write_cells():
        """A row is written into the empty one, and one is emptied."""
        for row, column, text in ((2, 0, b"5"), (2, 1, b"hidden"), (1, 0, b""), (1, 2, b"")):
            scene.require(probe.pointfrontWrite(b"ClassStyles", row, column, text), "no cell")

    def tick():
        if "cloud" in said:
            display = simple.GetDisplayProperties(simple.GetActiveSource(), view)
            rows.append(list(display.ClassStyles))
            said["written"] = rows[-1]
            if rows[-1][4:5] == ["5"] and rests(rows):
                session.end()
            return
        seen.append(json.loads(probe.pointfrontPanel()))
        if not rests(seen):
            return
        tables = seen[-1].get("tables", {}).values()
        if "sphere" not in said:
            if seen[-1].get("content", 0) > 0:
                said["sphere"] = seen[-1]
                seen.clear()
                show_cloud()
        elif len(tables) == 3 and all(table["heads"] for table in tables):
            said["cloud"] = seen[-1]
            write_cells()

    session.every_tick(view, tick, lambda: "a panel with tables, or a row: %s" % seen[-1:])
    view.SMProxy.StillRender()


start()
