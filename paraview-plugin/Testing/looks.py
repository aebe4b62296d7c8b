"""pvbatch: how points look, by the representation's properties.

Saves looks-*.png.
"""

import json
import os
import time

import numpy
from paraview import simple

simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())

import pictures
from scene import OUTPUT, POINTS, SIZE, Scene, require

scene = Scene()
scene.view.ViewSize = SIZE
scene.color_by(scene.display, "rgb")
display = scene.display


def picture(name):
    scene.save("looks-" + name)
    return pictures.load(os.path.join(OUTPUT, "looks-" + name + ".png"))


def colours(image):
    return numpy.unique(image.reshape(-1, 3), axis=0)


plain = picture("points")
# A style sheet that says the same is the same picture.
display.Where = "z > -1000000"
same = picture("same")
require(pictures.differing(plain, same, 2) < 0.001, "a condition that all meet changes the picture")
display.Where = "intensity > 100"
some = picture("where")
require(0.1 < pictures.covered(some) < 0.9 * pictures.covered(plain), "a condition is not kept")
display.Where = ""

# Splats close the surface; each technique is another picture.
display.Technique, display.ClosingSize = "splats", 1
splats = picture("splats")
require(pictures.covered(splats) > 1.02 * pictures.covered(plain), "splats close nothing")
others = []
for technique in ("spheres", "ewa"):
    display.Technique = technique
    others.append(picture(technique))
    require(pictures.differing(others[-1], splats, 8) > 0.02, technique + " looks like splats")
display.Technique, display.ClosingSize = "points", 0

# A technique alone closes the surface, unless it is not to; points alone do not.
display.ClosingSize = "All but points"
require(pictures.differing(plain, picture("alone-points"), 0) == 0, "points have another size")
display.Technique = "splats"
require(pictures.differing(splats, picture("alone-splats"), 0) == 0, "splats alone close nothing")
display.ClosingSize = "Never"
require(pictures.differing(splats, picture("never"), 8) > 0.02, "splats cannot be small")
display.Technique = "points"
# So does the technique of a class, and points stay points.
display.ClosingSize = "All but points"
display.ClassStyles = ["0", "splats", "", ""]
require(pictures.differing(splats, picture("class-splats"), 0) == 0, "a class's splats are small")
display.Technique, display.ClassStyles = "splats", ["0", "points", "", ""]
require(pictures.differing(plain, picture("class-points"), 2) < 0.001, "a class's points are large")
display.ClassStyles = []


def widgets():
    """Returns the panel's properties of quality."""
    return [display.Quality, display.Technique, display.TargetError, display.ClosingSize]


# A quality sets what it stands for; what is set of that afterwards ends it.
closing = "All but points"
for quality, technique, error in (("draft", "splats", 2.0), ("balanced", "blended", 1.0),
                                  ("exact", "ewa", 0.5)):
    display.Quality = quality
    require(widgets() == [quality, technique, error, closing], "%s says %s" % (quality, widgets()))
for name, value in (("Technique", "points"), ("TargetError", 0.7), ("ClosingSize", "Never")):
    display.Quality = "balanced"
    setattr(display, name, value)
    require(display.Quality == "custom", "%s, and still %s" % (name, widgets()))
# A number is the place on the curve that has it, and the panel says which.
for number, unit in (("0.9", "SSIM"), ("12ms", "ms")):
    display.Quality = number
    technique, error = display.Technique, display.TargetError
    told = display.SMProxy.GetProperty("QualityChosen").GetElement(0)
    print(widgets(), told)
    require(widgets() == [number, technique, error, closing], str(widgets()))
    require(technique in ("splats", "blended", "ewa") and told.startswith(
        "quality %s: " % number) and unit in told and " at %g px" % error in told, told)
    asked = picture("quality-" + number)
    display.Quality = "custom"
    require(display.SMProxy.GetProperty("QualityChosen").GetElement(0) == "", "it is still told")
    require(pictures.differing(asked, picture("parts-" + number), 0) == 0 or technique == "ewa",
            "%s is not what it says" % number)
    display.Quality = number
    display.TargetError = error + 0.1
    require(display.Quality == "custom", "another error, and still %s" % widgets())
display.Quality = "balanced"
balanced = picture("balanced")
display.Quality = "custom"
require(widgets()[1:] == ["blended", 1.0, closing], "custom changes something: %s" % widgets())
require(pictures.differing(balanced, picture("blended"), 0) == 0, "blended is not balanced")

# A quality is what its parts are, whatever is set of them.
display.Technique, display.ClosingSize, display.TargetError = "splats", 1, 2
parts = picture("parts")
display.Technique, display.ClosingSize, display.TargetError = "points", 0, 0.01
display.Quality = "draft"
draft = picture("draft")
require(pictures.differing(draft, parts, 2) < 0.001, "draft is not splats at 2 px")
display.Quality = "exact"
exact = picture("exact")
display.Technique, display.ClosingSize, display.TargetError = "ewa", 1, 0.5
display.Quality = "custom"
ewa = picture("ewa-half")
require(pictures.differing(exact, ewa, 16) < 0.02, "exact is not EWA splats at 0.5 px")
require(pictures.differing(exact, draft, 8) > 0.02, "exact looks like draft")
display.Technique, display.ClosingSize, display.TargetError = "points", 0, 0.01

# Eye-dome lighting darkens, and only that.
display.EyeDomeStrength = 0.4
dark = picture("eye-dome")
require((dark.sum() < 0.97 * plain.sum()) and (dark <= plain + 2).all(), "no eye-dome lighting")
display.EyeDomeStrength = 0.0

# Sizes, where users look for them.
require(display.SMProxy.GetProperty("PointSize").GetPanelVisibility() == "default", "hidden size")
display.PointSize = 5
require(pictures.covered(picture("large")) > pictures.covered(plain), "points are not larger")
display.PointSize = 2

# A colour map of ParaView's goes with techniques, too: the colours of both pictures are the map's.
scene.color_by(display, "intensity")
display.RescaleTransferFunctionToDataRange(False)
mapped = picture("intensity")
display.Where = "z > -1000000"
styled = picture("intensity-styled")
require(pictures.differing(mapped, styled, 4) < 0.005, "a style has other colours")
display.Where = ""

# Classes: this cloud has one, 0.
display.ClassStyles = ["0", "spheres", "#0000ff", "3"]
blue = colours(picture("class"))
shades = blue[(blue[:, :2] == 0).all(axis=1)]  # spheres are lit, no pixel is in the middle of one
require(len(blue) - len(shades) <= 1 and len(shades) > 2 and shades[-1][2] > 220,
        "a class in blue: %s ... %s" % (blue[:5], blue[-5:]))
display.ClassLights = ["0", "off", ""]
flat = colours(picture("class-flat"))
require(len(flat) <= 2 and flat[-1].tolist() == [0, 0, 255], "a class without light: %s" % flat[:5])
display.ClassLights = ["0", "off", "0.4"]
require(len(colours(picture("class-eye-dome"))) > 8, "a class has no eye-dome lighting")
display.ClassLights, display.Lit = [], 2
require(len(colours(picture("class-unlit"))) <= 2, "spheres are lit though light is off")
display.Lit = 0
display.ClassStyles = ["0", "hidden", "", ""]
scene.view.SMProxy.StillRender()
require(scene.frame()[0] == 0, "a hidden class is drawn: %d points" % scene.frame()[0])
display.ClassStyles = []

# A style sheet's file says everything.
sheet = os.path.join(OUTPUT, "sheet.json")
with open(sheet, "w") as file:
    json.dump({"default": {"technique": "points", "color": "#00ff00",
                           "size": {"mode": "fixed", "px": 3}}}, file)
display.StyleFile = sheet
green = colours(picture("sheet"))
require(len(green) == 2 and green[-1].tolist() == [0, 255, 0], "not the sheet's: %s" % green)
# A wrong row of a class counts for nothing, and the sheet for as much as without it.
display.ClassStyles = ["0", "no technique", "", ""]
require(numpy.array_equal(colours(picture("sheet-row")), green), "a wrong row takes the sheet away")
# Nor does a sheet that cannot be read count.
display.Technique, display.ClassStyles = "splats", ["0", "", "#0000ff", ""]
display.StyleFile = ""
before = picture("no-sheet")
broken = os.path.join(OUTPUT, "broken.json")
with open(broken, "w") as file:
    file.write("{ \"default\": ")
for name in ("no such sheet.json", broken):
    display.StyleFile = name
    for shot in ("first", "then"):
        require(pictures.differing(before, picture("sheet-" + shot), 0) == 0,
                "%s, %s: the picture changes" % (name, shot))
display.StyleFile, display.Technique, display.ClassStyles = "", "points", []

# In a view that waits for nothing, a new colour or filter is complete when its points are there,
# and not before: no further frame shows more.
display.CompleteStillRenders = "Never"
for name, change in (("Where", "scan_angle < 5"), ("Where", "user_data < 200 and z > 420"),
                     ("Where", ""), ("colour", "point_source_id"), ("colour", "rgb")):
    if name == "Where":
        display.Where = change
    else:
        scene.color_by(display, change)
    hangs = time.monotonic() + 300
    scene.view.SMProxy.StillRender()
    while not scene.frame()[1]:
        require(time.monotonic() < hangs, "%s %s: not complete" % (name, change))
        time.sleep(0.02)
        scene.view.SMProxy.StillRender()
    found = pictures.shown(scene.view)
    time.sleep(0.5)
    scene.view.SMProxy.StillRender()
    share = pictures.differing(found, pictures.shown(scene.view), 8)
    require(share == 0, "%s %s: %.2f %% come after what is complete" % (name, change, 100 * share))
display.CompleteStillRenders = "When unattended"

# Both back ends draw points.
scene.color_by(display, "rgb")
for backend in ("OpenGL", "Software"):
    display.Backend = backend
    found = picture(backend.lower())
    require(pictures.differing(plain, found, 8) < 0.01, backend + " draws something else")
display.Backend = "What is faster"

# A wrong property is told once, and points are drawn as if it were not there.
display.Where = "no_such_attribute > 1"
picture("wrong")
picture("wrong")
display.Where = ""
require(pictures.differing(plain, picture("again"), 0) == 0, "not as before")

# FXAA, ParaView's default, does not eat points; unless somebody wants it. It is as it was behind.
display.PointSize = 1
thin = picture("one-pixel")
scene.view.UseFXAA = 1
crisp = picture("one-pixel-crisp")
require(pictures.differing(thin, crisp, 0) == 0, "FXAA changes points")
display.CrispPoints = 0
require(pictures.differing(thin, picture("one-pixel-fxaa"), 30) > 0.01, "no FXAA at all")
display.CrispPoints = 1
simple.Hide(scene.reader, scene.view)
ball = simple.Show(simple.Sphere(Center=[637400.0, 851860.0, 450.0], Radius=100.0), scene.view)
for use in (0, 1):
    scene.view.UseFXAA = use
    scene.save("looks-ball-%d" % use)
edges = [pictures.load(os.path.join(OUTPUT, "looks-ball-%d.png" % use)) for use in (0, 1)]
require(pictures.differing(*edges, 5) > 0, "FXAA is gone for what is no point")
