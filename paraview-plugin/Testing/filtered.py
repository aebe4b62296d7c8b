"""pvbatch: what a filter makes of the overview is not the store, and is not drawn as if it were.

Saves filtered-points.png: a filter's points as ParaView draws them.
"""

import os

from paraview import simple

simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())

from scene import POINTS, SIZE, Scene, require

scene = Scene()
scene.view.ViewSize = SIZE
scene.view.SMProxy.StillRender()
require(scene.frame()[0] == POINTS, "the store itself is drawn")
simple.Hide(scene.reader, scene.view)

transform = simple.Transform(Input=scene.reader)
transform.Transform.Translate = [50.0, 0.0, 0.0]
masked = simple.MaskPoints(Input=scene.reader, OnRatio=2, MaximumNumberofPoints=10 ** 6)
calculated = simple.Calculator(Input=scene.reader, ResultArrayName="intensity", Function="1")
# Filters that pass everything on count, too: nobody knows that they do.
for source in (transform, masked, calculated, simple.Transform(Input=calculated)):
    name = source.GetXMLLabel()
    display = scene.show(source)
    require(display.Representation != "Point Front", name + ": shown as Point Front by itself")
    display.SetRepresentationType("Point Front")
    scene.view.SMProxy.StillRender()
    points, _ = scene.frame(display)
    require(points == 0, "%s: %d points of the store are drawn for it" % (name, points))
    display.SetRepresentationType("Points")
    scene.view.SMProxy.StillRender()
    simple.Hide(source, scene.view)

simple.Show(transform, scene.view)
scene.save("filtered-points")
simple.Hide(transform, scene.view)

# The store is drawn again, moved by the representation's own transformation.
simple.Show(scene.reader, scene.view)
scene.move([50.0, 0.0, 0.0])
scene.save_complete("filtered")
