"""pvbatch: what colours a store opens with, and that each array on offer shows something.

POINTFRONT_STORE has colours that are black everywhere, and an intensity; POINTFRONT_COLOURED has
colours. Saves colours-opened.png, colours-elevation.png, colours-amplitude.png,
colours-point_id.png, and with a legend colours-bar-elevation.png, colours-bar-point_id.png and
colours-bar-rgb.png.
"""

import os

import numpy
from paraview import simple
from paraview.modules.vtkRemotingServerManager import vtkSMPropertyHelper

simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())

import pictures
from scene import OUTPUT, SIZE, STORE, require

view = simple.CreateView("RenderView")
view.ViewSize = SIZE
view.UseColorPaletteForBackground = 0
view.BackgroundColorMode = "Single Color"
view.Background = [0, 0, 0]
view.OrientationAxesVisibility = 0
view.UseFXAA = 0
reader = simple.OpenDataFile(STORE)
display = simple.Show(reader, view)
display.PointSize = 5
simple.ResetCamera(view)


def saved(name, bar=False):
    """A picture, and whether it has a legend, which was asked for or not."""
    display.SetScalarBarVisibility(view, bar)
    simple.SaveScreenshot(os.path.join(OUTPUT, name + ".png"), view, ImageResolution=SIZE)
    picture = pictures.load(os.path.join(OUTPUT, name + ".png"))
    require(picture.any(), name + ": black")
    legend = display.LookupTable.SMProxy.FindScalarBarRepresentation(view.SMProxy)
    return picture, bool(legend and vtkSMPropertyHelper(legend, "Visibility").GetAsInt())


def colours(name):
    """Different colours of a picture, beside the background's."""
    picture = saved(name)[0].reshape(-1, 3)
    return len(numpy.unique(picture[picture.any(axis=1)], axis=0))


# As it opens: not black.
require(display.ColorArrayName[1] == "intensity", "opens coloured by %s" % display.ColorArrayName)
require(colours("colours-opened") > 20, "it opens in %d colours" % colours("colours-opened"))

# Height is on offer, and its range is the cloud's.
simple.ColorBy(display, ("POINTS", "elevation"))
require(colours("colours-elevation") > 20, "elevation: %d colours" % colours("colours-elevation"))

# One infinite value ends neither the program nor the range of the others.
simple.ColorBy(display, ("POINTS", "amplitude"))
ends = list(display.LookupTable.RGBPoints)[::4]
require(0 <= ends[0] and ends[-1] <= 398, "amplitude has the range %s" % ends)
require(colours("colours-amplitude") > 20, "amplitude: %d colours" % colours("colours-amplitude"))

# A legend is that of the colours in the picture.
require(saved("colours-bar-elevation", True)[1], "elevation has no legend")
display.SetScalarBarVisibility(view, False)

# Names of points are no colours: said once, and shown is the height, in greys.
simple.ColorBy(display, ("POINTS", "point_id"))
for name, bar in (("colours-point_id", False), ("colours-bar-point_id", True)):
    picture, shown = saved(name, bar)
    require(not shown, "point_id has a legend, and no colours")
    found = numpy.unique(picture.reshape(-1, 3), axis=0)
    require(len(found) > 20 and not numpy.ptp(found, axis=1).any(), "no greys: %s" % found)
simple.Hide(reader, view)

# Colours that are drawn as they are have no legend: none is offered, unless something else in the
# view is drawn through the same map.
reader = simple.OpenDataFile(os.environ["POINTFRONT_COLOURED"])
display = simple.Show(reader, view)
simple.ResetCamera(view)
require(display.ColorArrayName[1] == "rgb", "opens coloured by %s" % display.ColorArrayName)
picture, shown = saved("colours-bar-rgb", True)
require(not shown, "a legend of colours that are drawn as they are")
bare, _ = saved("colours-rgb")
require(pictures.differing(picture, bare, 0) == 0, "something is drawn in the place of a legend")
display.DirectColors = 0
require(saved("colours-bar-mapped", True)[1], "rgb through the map has no legend")
display.DirectColors = 1
other = simple.Show(simple.Transform(Input=reader), view)
other.SetRepresentationType("Points")
simple.ColorBy(other, ("POINTS", "rgb"))
require(saved("colours-bar-shared", True)[1], "the legend of another source is gone")
