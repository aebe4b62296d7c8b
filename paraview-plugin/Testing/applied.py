"""The ParaView application, by its own buttons: a filter that is applied hides the cloud.

Runs as `paraview --dr --script=applied.py --test-script=applied.xml --exit`: this script opens the
store, the other file plays the events. Writes applied.json: whether the cloud is shown, as each
render finds it, and the filters that are there.
"""

import json
import os
import traceback

from paraview import simple

found = {"shown": [], "filters": [], "failure": None}


def write():
    with open(os.path.join(os.environ["POINTFRONT_OUTPUT"], "applied.json"), "w") as file:
        json.dump(found, file)


def start():
    simple.GetSettingsProxy("GeneralSettings").ShowWelcomeDialog = 0
    simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())
    view = simple.GetActiveViewOrCreate("RenderView")
    reader = simple.OpenDataFile(os.environ["POINTFRONT_STORE"])
    reader.OverviewPoints = 1000
    display = simple.Show(reader, view)
    simple.SetActiveSource(reader)
    simple.Render(view)

    def rendered(*_):
        try:
            found["shown"].append(int(display.Visibility))
            found["filters"] = [source.GetXMLName() for source in simple.GetSources().values()]
        except BaseException:
            found["failure"] = traceback.format_exc()
        write()

    view.SMProxy.AddObserver("EndEvent", rendered)


start()
