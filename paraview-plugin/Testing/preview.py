"""The ParaView application opens point files: the view shows a preview while the store is built.

Runs as `paraview --dr --script=preview.py`: chooses the files as File > Open does and, a while
later, shows them as Apply does. Each render is looked at until the store is there. Writes
preview.json. Saves preview-while.png, preview-cancelled.png and preview.png.
Told by the environment: POINTFRONT_FILES, and POINTFRONT_CANCEL if the build is to be cancelled, or
"deleted" if the cloud is to be deleted meanwhile.
"""

import json
import os
import time
import traceback

from paraview import simple

FILES = json.loads(os.environ["POINTFRONT_FILES"])
STORE = FILES[0] + ".pfront"
CANCEL = os.environ.get("POINTFRONT_CANCEL")
seen = {"while": [], "after": [], "failure": None}


def end():
    """Ends the application at once: it has no way out for scripts, and nothing is left to save."""
    with open(os.path.join(os.environ["POINTFRONT_OUTPUT"], "preview.json"), "w") as file:
        json.dump(seen, file)
    os._exit(1 if seen["failure"] else 0)


def guarded(action):
    def run(*_):
        try:
            action()
        except BaseException:
            seen["failure"] = traceback.format_exc()
            end()
    return run


def save(view, name):
    simple.SaveScreenshot(os.path.join(os.environ["POINTFRONT_OUTPUT"], name + ".png"), view)


@guarded
def start():
    simple.GetSettingsProxy("GeneralSettings").ShowWelcomeDialog = 0
    # Here first: what the server tells of the plugin makes its settings here at once.
    simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())
    if simple.servermanager.ActiveConnection.IsRemote():
        simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=True, ns=globals())
    import scene

    view = simple.GetActiveViewOrCreate("RenderView")
    reader = simple.OpenDataFile(FILES)
    reader.PreviewPoints = 1000
    reader.Normals = "By PCA"  # so that the build takes some seconds
    simple.SetActiveSource(reader)
    looking, deleted = [], []

    def look():
        display = simple.GetDisplayProperties(reader, view)
        proxy = display.SMProxy
        proxy.UpdatePropertyInformation()
        limits = proxy.GetProperty("LimitedBy").GetElement(0)
        total = int(proxy.GetProperty("PointsInView").GetElement(0).split()[-1].replace(",", ""))
        drawn, complete = scene.Scene.frame(None, display)
        output = simple.servermanager.Fetch(reader)
        names = output.GetFieldData().GetAbstractArray("PointFrontStore")
        name = os.path.basename(names.GetValue(0)) if names else ""
        stored = output.GetFieldData().GetArray("store_points")
        building = "the build" in limits
        seen["while" if building else "after"].append(
            {"drawn": drawn, "complete": complete, "limits": limits, "store": name,
             "store_points": int(stored.GetValue(0)) if stored else 0, "drawn_of": total,
             "there": os.path.exists(STORE)})
        if building and len(seen["while"]) == 3:
            save(view, "preview-while")
            if CANCEL and CANCEL != "deleted":
                reader.SMProxy.InvokeCommand("CancelBuild")
        whole = stored is not None and total == int(stored.GetValue(0))
        if not building and name == os.path.basename(STORE) and complete and whole:
            # As the panel has it, which nobody here has brought up to date.
            seen["panel"] = reader.SMProxy.GetProperty("StoreFacts").GetElement(0)
            save(view, "preview")
            end()
        if CANCEL and not building and seen["while"] and not names:
            save(view, "preview-cancelled")
            end()

    @guarded
    def rendered():
        if looking or deleted or not simple.servermanager.GetRepresentation(reader, view):
            return  # it renders itself, or nothing is shown yet
        looking.append(True)
        look()
        looking.clear()

    begun, shown = [], []

    def delete():
        """Once three previews are in view; and some time later all is to be said."""
        if deleted:
            end()
        if len(seen["while"]) >= 3:
            deleted.append(True)
            simple.Delete(reader)
        interactor.CreateOneShotTimer(2000 if deleted else 50)

    @guarded
    def tick():
        """After a while: by then the application has asked the reader whether it has news."""
        if shown:
            if CANCEL == "deleted":
                delete()
            return
        begun.append(time.monotonic())
        if begun[-1] - begun[0] < 2:
            interactor.CreateOneShotTimer(200)
            return
        shown.append(True)
        simple.Show(reader, view)
        simple.ResetCamera(view)
        simple.Render(view)
        interactor.CreateOneShotTimer(50)

    view.SMProxy.AddObserver("EndEvent", rendered)
    interactor = view.SMProxy.GetInteractor()
    interactor.AddObserver("TimerEvent", tick)
    interactor.CreateOneShotTimer(100)


start()
