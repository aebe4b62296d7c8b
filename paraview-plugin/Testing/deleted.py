"""The ParaView application, by its own buttons: who deletes a cloud has its file closed.

Runs as `paraview --dr --script=deleted.py --test-script=deleted.xml --exit`: this script opens the
store and selects some of its points; the other file shows them in a spreadsheet, looks at the
Information panel and deletes the cloud. Writes deleted.json: how often this process has the
store's file open, before and after.
"""

import os

from paraview import simple

from session import Session

session = Session("deleted", open=[], sources=[])
store = os.environ["POINTFRONT_STORE"]


def times_open():
    paths = []
    for number in os.listdir("/proc/self/fd"):
        try:
            paths.append(os.readlink("/proc/self/fd/" + number))
        except OSError:
            pass  # closed meanwhile
    with open("/proc/self/maps") as maps:
        paths += {line.split(None, 5)[-1].strip() for line in maps if store in line}
    return paths.count(store)


@session.guarded
def start():
    session.load()
    view = simple.GetActiveViewOrCreate("RenderView")
    reader = simple.OpenDataFile(store)
    simple.Show(reader, view)
    simple.SetActiveSource(reader)
    simple.Render(view)

    def tick():
        session.found["open"].append(times_open())
        session.found["sources"].append(len(simple.GetSources()))
        session.write()

    session.every_tick(view, tick)


start()
