"""pvbatch: a state of everything the plugin has, saved and loaded, and written by the trace.

usage: pvbatch state.py save     saves state.pvsm, state.py, trace.py and state.png
       pvbatch state.py load     loads state.pvsm, knowing nothing else; saves state-loaded.png
state.py and trace.py are run by pvbatch as they are; saved-by-NAME.png is what they show then.
"""

import os
import sys

from paraview import simple, smstate, smtrace

OUTPUT = os.environ["POINTFRONT_OUTPUT"]
SIZE = [640, 360]


def build():
    simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())
    view = simple.CreateView("RenderView")
    view.ViewSize = SIZE
    view.UseColorPaletteForBackground = 0
    view.BackgroundColorMode = "Single Color"
    view.Background = [0.0, 0.0, 0.0]
    view.OrientationAxesVisibility = 0
    reader = simple.OpenDataFile(os.environ["POINTFRONT_STORE"])
    reader.OverviewPoints = 2000
    display = simple.Show(reader, view)
    display.TargetError = 0.5
    display.Technique = "splats"
    display.ClosingSize = 1
    display.EyeDomeStrength = 0.3
    display.Where = "intensity < 200"
    display.ClassStyles = ["6", "spheres", "#ff0000", "4"]
    simple.ColorBy(display, ("POINTS", "elevation"))
    extract = PointFrontExtract(Input=reader)
    extract.Region = "Sphere"
    extract.Region.Center = [637400.0, 851850.0, 430.0]
    extract.Region.Radius = 60.0
    extract.Where = "return_number == 1"
    part = simple.Show(extract, view)
    part.AmbientColor = part.DiffuseColor = [0.0, 1.0, 0.0]
    simple.ColorBy(part, None)
    part.PointSize = 4
    simple.ResetCamera(view)
    simple.Render(view)
    return view


def save(name, view):
    simple.SaveScreenshot(os.path.join(OUTPUT, name + ".png"), view, ImageResolution=SIZE)


if sys.argv[1] == "save":
    smtrace.start_trace()
    view = build()
    save("state", view)
    trace = smtrace.stop_trace()
    simple.SaveState(os.path.join(OUTPUT, "state.pvsm"))
    for name, text in (("state", smstate.get_state()), ("trace", trace)):
        with open(os.path.join(OUTPUT, "saved-%s.py" % name), "w") as file:
            file.write(text)
            # Nothing but the picture that it is judged by.
            file.write("\nimport os\nfrom paraview import simple\n"
                       "simple.SaveScreenshot(os.path.join(os.environ['POINTFRONT_OUTPUT'], "
                       "'by-%s.png'), simple.GetActiveViewOrCreate('RenderView'), "
                       "ImageResolution=%s)\n" % (name, SIZE))
else:
    simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())
    simple.LoadState(os.path.join(OUTPUT, "state.pvsm"))
    save("state-loaded", simple.GetActiveViewOrCreate("RenderView"))
