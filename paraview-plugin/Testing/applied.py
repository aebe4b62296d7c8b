"""The ParaView application, by its own buttons: a filter that is applied hides the cloud.

Runs as `paraview --dr --script=applied.py --test-script=applied.xml --exit`: this script opens the
store, the other file plays the events. Writes applied.json: whether the cloud is shown, as each
render finds it, and the filters that are there.
"""

import os

from paraview import simple

from session import Session

session = Session("applied", shown=[], filters=[])


@session.guarded
def start():
    session.load()
    view = simple.GetActiveViewOrCreate("RenderView")
    reader = simple.OpenDataFile(os.environ["POINTFRONT_STORE"])
    reader.OverviewPoints = 1000
    display = simple.Show(reader, view)
    simple.SetActiveSource(reader)
    simple.Render(view)

    @session.guarded
    def rendered():
        session.found["shown"].append(int(display.Visibility))
        session.found["filters"] = [one.GetXMLName() for one in simple.GetSources().values()]
        session.write()

    view.SMProxy.AddObserver("EndEvent", rendered)


start()
