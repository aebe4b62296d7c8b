"""The ParaView application, by its own buttons: who deletes a cloud has its file closed.

Runs as `paraview --dr --script=deleted.py --test-script=deleted.xml --exit`: this script opens the
store and selects some of its points; the other file shows them in a spreadsheet, looks at the
Information panel and deletes the cloud. Writes deleted.json: how often this process has the
store's file open, before and after.
"""

import json
import os
import traceback

from paraview import simple

found = {"open": [], "sources": [], "failure": None}
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


def write():
    with open(os.path.join(os.environ["POINTFRONT_OUTPUT"], "deleted.json"), "w") as file:
        json.dump(found, file)


def guarded(action):
    def run(*_):
        try:
            action()
        except BaseException:
            found["failure"] = traceback.format_exc()
        write()
    return run


@guarded
def start():
    simple.GetSettingsProxy("GeneralSettings").ShowWelcomeDialog = 0
    simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())
    view = simple.GetActiveViewOrCreate("RenderView")
    reader = simple.OpenDataFile(store)
    simple.Show(reader, view)
    simple.SetActiveSource(reader)
    simple.Render(view)
    interactor = view.SMProxy.GetInteractor()

    @guarded
    def tick():
        found["open"].append(times_open())
        found["sources"].append(len(simple.GetSources()))
        interactor.CreateOneShotTimer(200)

    interactor.AddObserver("TimerEvent", tick)
    interactor.CreateOneShotTimer(200)


start()
