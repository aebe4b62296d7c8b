"""pvbatch: what colours a store opens with, and that each array on offer shows something.

POINTFRONT_STORE has colours that are black everywhere, and an intensity. Saves colours-opened.png,
colours-elevation.png and colours-point_id.png.
"""

import os

import numpy
from paraview import simple

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


def colours(name):
    """Different colours of a picture, beside the background's."""
    display.SetScalarBarVisibility(view, False)
    simple.SaveScreenshot(os.path.join(OUTPUT, name + ".png"), view, ImageResolution=SIZE)
    picture = pictures.load(os.path.join(OUTPUT, name + ".png")).reshape(-1, 3)
    require(picture.any(), name + ": black")
    return len(numpy.unique(picture[picture.any(axis=1)], axis=0))


# As it opens: not black.
require(display.ColorArrayName[1] == "intensity", "opens coloured by %s" % display.ColorArrayName)
require(colours("colours-opened") > 20, "it opens in %d colours" % colours("colours-opened"))

# Height is on offer, and its range is the cloud's.
simple.ColorBy(display, ("POINTS", "elevation"))
require(colours("colours-elevation") > 20, "elevation: %d colours" % colours("colours-elevation"))

# Names of points are no colours: said once, not drawn as white without a word.
simple.ColorBy(display, ("POINTS", "point_id"))
colours("colours-point_id")
colours("colours-point_id")
