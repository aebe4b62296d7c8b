"""The ParaView application, by its own buttons and the mouse: a rubber band, and Extract Selection.

Runs as `paraview --dr --script=rubber_band.py --test-script=rubber_band.xml --exit`: this script
opens the store, the other file plays the events, and each render is looked at. Writes
rubber_band.json: the bounds of what was selected and extracted, their points, and the rectangle's.
Saves rubber_band.png.
"""

import json
import os
import traceback

from paraview import simple

found = {"failure": None}


def end():
    with open(os.path.join(os.environ["POINTFRONT_OUTPUT"], "rubber_band.json"), "w") as file:
        json.dump(found, file)


def describe(information):
    return {"points": information.GetNumberOfPoints(), "bounds": information.GetBounds()}


def start():
    simple.GetSettingsProxy("GeneralSettings").ShowWelcomeDialog = 0
    simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())
    view = simple.GetActiveViewOrCreate("RenderView")
    reader = simple.OpenDataFile(os.environ["POINTFRONT_STORE"])
    reader.OverviewPoints = 1000
    display = simple.Show(reader, view)
    display.CompleteStillRenders = "Always"
    simple.SetActiveSource(reader)
    view.InteractionMode = "2D"
    view.CameraParallelProjection = 1
    simple.ResetCamera(view)
    simple.Render(view)
    looking = []

    def rendered(*_):
        if looking:
            return  # it renders itself
        looking.append(True)
        try:
            if reader.SMProxy.GetSelectionInput(0) and "selected" not in found:
                output = reader.SMProxy.GetSelectionOutput(0)
                found["selected"] = describe(output.GetDataInformation(0))
                simple.SaveScreenshot(
                    os.path.join(os.environ["POINTFRONT_OUTPUT"], "rubber_band.png"), view)
            for source in simple.GetSources().values():
                if source.GetXMLName() == "ExtractSelection":
                    found["extracted"] = describe(source.GetDataInformation())
        except BaseException:
            found["failure"] = traceback.format_exc()
        looking.clear()
        end()

    view.SMProxy.AddObserver("EndEvent", rendered)


start()
