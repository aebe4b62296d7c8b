"""The ParaView application, by its own buttons and the mouse: a rubber band, and Extract Selection.

Runs as `paraview --dr --script=rubber_band.py --test-script=rubber_band.xml --exit`: this script
opens the store, the other file plays the events, and each render is looked at. Writes
rubber_band.json: the bounds of what was selected and extracted, their points, and the rectangle's.
Saves rubber_band.png.
"""

import os

from paraview import simple

from session import OUTPUT, Session

session = Session("rubber_band")
found = session.found


def describe(information):
    return {"points": information.GetNumberOfPoints(), "bounds": information.GetBounds()}


@session.guarded
def start():
    session.load()
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

    @session.guarded
    def rendered():
        if looking:
            return  # it renders itself
        looking.append(True)
        if reader.SMProxy.GetSelectionInput(0) and "selected" not in found:
            output = reader.SMProxy.GetSelectionOutput(0)
            found["selected"] = describe(output.GetDataInformation(0))
            simple.SaveScreenshot(os.path.join(OUTPUT, "rubber_band.png"), view)
        for source in simple.GetSources().values():
            if source.GetXMLName() == "ExtractSelection":
                found["extracted"] = describe(source.GetDataInformation())
        looking.clear()
        session.write()

    view.SMProxy.AddObserver("EndEvent", rendered)


start()
