"""The ParaView application, by its own dialog: several files chosen in File > Open.

Runs as `paraview --dr --script=opened.py` in a folder with the files of POINTFRONT_LINES, which are
lists of lines of the dialog. Chooses one list after the other, presses OK and Apply, and writes
opened.json: for each list the sources that came, as [reader, file names, points of the store], and
saves opened-NUMBER.png.
"""

import ctypes
import json
import os

from paraview import simple

from session import OUTPUT, Session

session = Session("opened", rounds=[])
found = session.found
lines = json.loads(os.environ["POINTFRONT_LINES"])


def stored(source):
    told = source.GetDataInformation().DataInformation.GetFieldDataInformation()
    array = told.GetArrayInformation("store_points")
    return int(array.GetComponentRange(0)[0]) if array else 0


@session.guarded
def start():
    probe = ctypes.CDLL(os.environ["POINTFRONT_PANEL_PROBE"])
    probe.pointfrontAct.restype = probe.pointfrontPress.restype = ctypes.c_bool
    session.load()
    view = simple.GetActiveViewOrCreate("RenderView")
    steps, known = [], set()

    def opens():
        if not probe.pointfrontAct(b"actionFileOpen"):
            raise AssertionError("no File > Open")
        steps.append(chooses)

    def chooses():
        if probe.pointfrontChoose("/".join(lines[len(found["rounds"])]).encode()) > 0:
            steps.append(applies)

    def applies():
        if simple.GetSources().keys() - known and probe.pointfrontPress(b"Accept"):
            steps.append(looks)

    def looks():
        came = {key: source for key, source in simple.GetSources().items() if key not in known}
        rows = [[source.GetXMLName(), [os.path.basename(name) for name in source.FileName],
                 stored(source)] for source in came.values()]
        if not all(points for _, _, points in rows):
            return
        number = len(found["rounds"])
        found["rounds"].append(sorted(rows))
        known.update(simple.GetSources())
        simple.ResetCamera(view)
        simple.SaveScreenshot(os.path.join(OUTPUT, "opened-%d.png" % number), view)
        for source in came.values():
            simple.Hide(source, view)
        if len(found["rounds"]) == len(lines):
            session.end()
        steps.append(opens)

    steps.append(opens)

    session.every_tick(view, lambda: steps[-1](), lambda: steps[-1].__name__)
    view.SMProxy.StillRender()


start()
