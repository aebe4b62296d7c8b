"""pvbatch: draws random scenes, all in one process.

usage: pvbatch random_drawing.py FILE    JSON: a list of cases, each "name", "style" (a style file),
"camera", "error". Saves NAME-opengl.png and NAME-software.png of each.
"""

import json
import os
import sys

from paraview import simple

simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())

from scene import OUTPUT, Scene, require

with open(sys.argv[1]) as file:
    known = json.load(file)
scene = Scene()
view, display = scene.view, scene.display
view.ViewSize = known["size"]
view.Background = [0.2, 0.1, 0.3]
# The tool's light is one at the eye.
view.UseLight = 0
light = simple.AddLight(view=view)
light.Coords = "Headlight"

simple.Render(view)  # the first one resets the camera
for case in known["cases"]:
    display.StyleFile = case["style"]
    display.TargetError = float(case["error"])
    scene.look_as(case["camera"])
    for backend in ("OpenGL", "Software"):
        display.Backend = backend
        name = "%s-%s" % (case["name"], backend.lower())
        path = os.path.join(OUTPUT, name + ".png")
        require(simple.SaveScreenshot(path, view, ImageResolution=known["size"]), "not saved")
        require(scene.frame()[1], name + " is not complete")
