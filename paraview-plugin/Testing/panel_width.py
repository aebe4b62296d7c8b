"""The ParaView application: what the panel of a cloud needs in width, and the heads of its tables.

Runs as `paraview --dr --script=panel_width.py`. Writes panel_width.json: what PanelProbe.cxx saw of
a sphere of ParaView's, and of a cloud.
"""

import ctypes
import json
import os
import time

from paraview import simple

from session import Session

session = Session("panel_width")
said = session.found
LONGEST = 60  # seconds


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
    begun = time.monotonic()

    def show_cloud():
        simple.Delete(sphere)
        shown = scene.Scene(view)
        shown.display.LensShape = "Around a class"
        shown.display.ClassStyles = ["6", "splats", "#ff0000", "3", "2", "", "intensity", ""]
        simple.SetActiveSource(shown.reader)
        view.SMProxy.StillRender()

    def tick():
        found = json.loads(probe.pointfrontPanel())
        seconds = time.monotonic() - begun
        if "sphere" not in said and seconds > 4:
            said["sphere"] = found
            show_cloud()
        tables = found.get("tables", {}).values()
        if "cloud" in said:
            said["written"] = list(simple.GetDisplayProperties(
                simple.GetActiveSource(), view).ClassStyles)
            if said["written"][4:5] == ["5"] or seconds > LONGEST:
                session.end()
        elif seconds > 10 and len(tables) == 3 and all(table["heads"] for table in tables):
            said["cloud"] = found
            # A row is written into the empty one, and one is emptied.
            cells = ((2, 0, b"5"), (2, 1, b"hidden"), (1, 0, b""), (1, 2, b""))
            for row, column, text in cells:
                scene.require(probe.pointfrontWrite(b"ClassStyles", row, column, text), "no cell")
        if seconds > LONGEST:
            raise AssertionError("no panel with tables: %s" % found)

    session.every_tick(view, tick)
    view.SMProxy.StillRender()


start()
