"""pvbatch on one process or several: a lens keeps its place in pictures of any size.

usage: pvbatch lens.py NAME     saves NAME-*.png
"""

import os
import sys

import numpy
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter

simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())

import pictures
from scene import OUTPUT, SIZE, Scene, require

scene = Scene()
scene.view.ViewSize = SIZE
scene.color_by(scene.display, "rgb")
display = scene.display


def picture(name, size=SIZE):
    path = os.path.join(OUTPUT, sys.argv[1] + "-" + name + ".png")
    require(simple.SaveScreenshot(path, scene.view, ImageResolution=size), path)
    return pictures.load(path)


def check(name, size, inside):
    """Red points and nothing else inside, and outside what is there without a lens."""
    display.LensShape = "Off"
    without = picture(name + "-off", size)
    display.LensShape = name
    found = picture(name, size)
    # Rows from below; the centres of the pixels as parts of width and height.
    rows, columns = numpy.mgrid[0:size[1], 0:size[0]]
    mask = inside((columns + 0.5) / size[0], (rows + 0.5) / size[1], size)
    changed = (found != without).any(axis=2)
    require(not changed[~mask].any(), "%s: %d pixels outside differ" % (name, changed[~mask].sum()))
    colours = numpy.unique(found[mask], axis=0).tolist()
    require(colours == [[0, 0, 0], [255, 0, 0]], "%s: inside %s" % (name, colours[:5]))
    require((found[mask][:, 0] == 255).mean() > 0.3, name + ": hardly any points inside")


display.LensStyles = ["", "", "#ff0000", ""]
display.LensCenter, display.LensRadius, display.LensSize = [0.4, 0.5], 0.2, [0.3, 0.4]
for size in (SIZE, [480, 300]):
    scene.view.ViewSize = size
    check("Circle", size, lambda x, y, size: numpy.hypot(
        (x - 0.4) * size[0], (y - 0.5) * size[1]) <= 0.2 * size[1])
    check("Rectangle", size, lambda x, y, _: (abs(x - 0.4) <= 0.15) & (abs(y - 0.5) <= 0.2))

# A mask is an image: a triangle, in the corner of the picture.
mask_file = os.path.join(OUTPUT, sys.argv[1] + "-mask.png")
rows, columns = numpy.mgrid[0:64, 0:64]
triangle = rows + columns < 50  # rows from below
image = vtkImageData()
image.SetDimensions(64, 64, 1)
image.GetPointData().SetScalars(numpy_to_vtk((triangle * 255).astype(numpy.uint8).ravel(), True))
writer = vtkPNGWriter()
writer.SetFileName(mask_file)
writer.SetInputData(image)
writer.Write()
display.LensMask = mask_file
for size in (SIZE, [480, 300]):
    scene.view.ViewSize = size
    # A pixel has what its lower left corner is in.
    check("Mask", size, lambda x, y, size: triangle[tuple(
        numpy.floor(64 * (place - 0.5 / length) + 1e-6).astype(int)
        for place, length in ((y, size[1]), (x, size[0])))])

# Around the points of a class, this cloud's only one: wherever there is something.
display.LensShape, display.LensClass, display.LensClassRadius = "Around a class", 0, 5.0
colours = numpy.unique(picture("around").reshape(-1, 3), axis=0).tolist()
require(colours == [[0, 0, 0], [255, 0, 0]], "around a class: %s" % colours[:5])
display.LensClass = 6
display.LensShape = "Off"
without = picture("around-off")
display.LensShape = "Around a class"
# Ranks draw it in software and not in OpenGL, which rounds places to 1/256 of a pixel.
share = pictures.differing(picture("around-none"), without, 8)
require(share < 0.001, "a lens around a class that is not there: %.4f differ" % share)
display.LensStyles = ["", "", "#ff0000", ""]

# Another technique, and nothing at all.
display.LensShape = "Circle"
display.LensStyles = ["", "hidden", "", ""]
hidden = picture("hidden", [480, 300])
require(not hidden[150, 192].any(), "a lens that hides shows something")

# How fast detail grows does not change pictures of a view at rest.
display.LensShape = "Off"
before = picture("growing", [480, 300])
display.GrowthTime = 0
require((picture("grown", [480, 300]) == before).all(), "another picture at rest")
