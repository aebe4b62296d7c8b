"""pvbatch on any number of processes: each technique by each back end, of all points and of some.

usage: pvbatch backends.py NAME      saves NAME-TECHNIQUE-ERROR-BACKEND.png
"""

import json
import os
import sys

from paraview import simple

simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())

import pictures
from scene import OUTPUT, SIZE, Scene, require

name = sys.argv[1]
scene = Scene()
scene.view.ViewSize = SIZE
scene.color_by(scene.display, "rgb")
for backend in ("OpenGL", "Software"):
    scene.display.Backend = backend
    for technique in ("points", "splats", "spheres", "ewa"):
        scene.display.Technique = technique
        scene.display.ClosingSize = technique != "points"
        for error in (0.01, 2):
            scene.display.TargetError = error
            picture = "%s-%s-%g-%s" % (name, technique, error, backend.lower())
            scene.save(picture)
            require(scene.frame()[1], picture + " is not complete")

# Translucent: on ranks one surface, whose points are those of the opaque picture.
scene.display.Technique, scene.display.ClosingSize, scene.display.TargetError = "points", 0, 0.01
scene.save(name + "-opaque")
scene.display.Opacity = 0.5
scene.save(name + "-translucent")
require(scene.frame()[1], "translucent points are not complete")
scene.display.Opacity = 1

# Techniques that look at the pixels around one see those of all ranks.
for technique, error in (("points", 0.01), ("splats", 1), ("blended", 1)):
    scene.display.Technique, scene.display.TargetError = technique, error
    scene.display.ClosingSize = "All but points"
    for way, strength, fill in (("edl", 0.4, 0), ("filled", 0.2, 1)):
        scene.display.EyeDomeStrength, scene.display.FillHoles = strength, fill
        scene.save("%s-%s-%s" % (name, way, technique))
scene.display.EyeDomeStrength, scene.display.FillHoles = 0, 0

# Blended splats by a preset; from within the cloud; from where nothing of it is seen.
scene.display.Quality = "balanced"
camera = scene.view.SMProxy.GetActiveCamera()
for place, way in (("all", None), ("inside", lambda: camera.Dolly(4)),
                   ("edge", lambda: camera.Yaw(28)), ("away", lambda: camera.Yaw(150))):
    if way:
        way()
    for look, strength, fill in (("", 0, 0), ("-edl", 0.4, 0), ("-filled", 0.4, 1)):
        scene.display.EyeDomeStrength, scene.display.FillHoles = strength, fill
        scene.save("%s-balanced%s-%s" % (name, look, place))
scene.display.EyeDomeStrength, scene.display.FillHoles = 0, 0

# A color map's opacities, which ranks leave out.
scene.look()
scene.display.Quality, scene.display.Technique = "custom", "points"
scene.display.TargetError = 0.01
scene.color_by(scene.display, "intensity")
scene.display.RescaleTransferFunctionToDataRange(False)
scene.save(name + "-mapped")
simple.GetOpacityTransferFunction("intensity").Points = [0, 0, 0.5, 0, 255, 1, 0.5, 0]
simple.GetColorTransferFunction("intensity").EnableOpacityMapping = 1
scene.save(name + "-map-translucent")
scene.color_by(scene.display, "rgb")

# A lens around a class is around the points of all ranks: discs around each 40th point, which a
# class of its own has.
if "POINTFRONT_SPARSE" in os.environ:
    simple.Hide(scene.reader, scene.view)
    scene.display = scene.show(simple.OpenDataFile(os.environ["POINTFRONT_SPARSE"]))
    scene.display.TargetError, scene.display.PointBudget = 0.01, 0
    scene.color_by(scene.display, "rgb")
    display = scene.display
    display.LensShape, display.LensClass, display.LensClassRadius = "Around a class", 9, 12.0
    for backend in ("OpenGL", "Software"):
        display.Backend = backend
        for way, inside in (("points", ["", "", "#ff0000", ""]),
                            ("blended", ["", "blended", "", ""]),
                            ("hidden", ["2", "hidden", "", ""])):
            display.LensStyles = inside
            scene.save("%s-around-%s-%s" % (name, way, backend.lower()))
    # In motion, with the time and pixels of a picture at rest: what is shown is what is shown then.
    display.TargetFrameTime, display.GrowthTime = 10000, 0
    scene.view.ImageReductionFactor = 1

    def save_moving(way):
        scene.save("%s-%s-rest" % (name, way))
        for _ in range(3):
            scene.view.SMProxy.InteractiveRender()
        pictures.save(os.path.join(OUTPUT, "%s-%s-moving.png" % (name, way)),
                      pictures.shown(scene.view))

    for backend in ("OpenGL", "Software"):
        display.Backend = backend
        display.LensShape, display.LensStyles = "Around a class", ["", "", "#ff0000", ""]
        save_moving("around-" + backend.lower())
        display.LensShape = "Off"
        with open(name + ".json", "w") as file:
            json.dump({"classes": {"9": {"technique": "splats", "opacity": 0.4,
                                         "size": {"mode": "fixed", "metres": 8}}},
                       "highlight": [{"class": 2, "halo_px": 3}]}, file)
        display.StyleFile = os.path.abspath(name + ".json")
        save_moving("translucent-" + backend.lower())
        display.StyleFile = ""

    # Only a corner of the cloud is in view, or just its edge.
    display.LensShape = "Around a class"
    low, high = (json.loads(os.environ["POINTFRONT_SPARSE_BOUNDS"])[i:i + 3] for i in (0, 3))
    height = high[1] - low[1]
    width = height * SIZE[0] / SIZE[1]
    for way, up in (("edge", 0), ("corner", 0.8 * height)):
        at = [high[0] + 0.485 * width, 0.5 * (low[1] + high[1]) + up, high[2]]
        scene.look_as({"position": [*at[:2], at[2] + 1000], "focal_point": at,
                       "view_up": [0, 1, 0], "parallel_scale": 0.5 * height})
        for style, inside in (("points", ["", "", "#ff0000", ""]),
                              ("blended", ["", "blended", "", ""])):
            display.LensStyles = inside
            scene.save("%s-small-%s-%s" % (name, style, way))
    # Ranks add what each draws beyond the cloud's box, half a point or splat, too.
    display.LensShape, display.PointSize = "Off", 15
    at = [*(0.5 * (low[i] + high[i]) for i in (0, 1)), high[2]]
    scene.look_as({"position": [*at[:2], at[2] + 1000], "focal_point": at,
                   "view_up": [0, 1, 0], "parallel_scale": 0.6 * height})
    for technique, backend in (("points", "OpenGL"), ("points", "Software"),
                               ("spheres", "Software")):
        display.Technique, display.Backend = technique, backend
        scene.save("%s-beyond-%s-%s" % (name, technique, backend.lower()))
    display.Technique, display.PointSize, display.LensShape = "points", 2, "Around a class"
    scene.view.CameraParallelProjection = 0
    scene.look()
    camera.Yaw(150)  # seen from nowhere: no rank waits for the others
    scene.save(name + "-around-away")
