"""A cloud by its address, and a list of addresses opened as a file: those of the store here.

usage: python3 far.py PORT ADDRESS LIST      a client of a server
ADDRESS: of the store, with something secret in it. LIST: a file that names it. Saves far.png and
far-list.png. What the server says is about an address that names nothing.
"""

import sys

from paraview import simple

simple.Connect("127.0.0.1", int(sys.argv[1]))
address, listed = sys.argv[2:]

import scene

simple.LoadPlugin(scene.PLUGIN, remote=True, ns=globals())
simple.LoadPlugin(scene.PLUGIN, remote=False, ns=globals())
require = scene.require

here = scene.Scene()
here.view.ViewSize = scene.SIZE
here.display.Visibility = 0


def shown(source, picture):
    source.OverviewPoints = 5000
    display = here.show(source)
    require(display.Representation == "Point Front", "shown as " + str(display.Representation))
    display.TargetError, display.PointBudget = 0.01, 0
    here.color_by(display, "rgb")
    here.save(picture)
    require(here.frame(display) == (scene.POINTS, True), "drawn: %s" % (here.frame(display),))
    ours, theirs = (one.GetDataInformation() for one in (source, here.reader))
    require(ours.GetNumberOfPoints() == theirs.GetNumberOfPoints(), "another overview")
    require(ours.GetBounds() == theirs.GetBounds(), "other bounds: %s" % (ours.GetBounds(),))
    facts = source.SMProxy
    facts.UpdatePropertyInformation()
    told = facts.GetProperty("StoreFacts").GetElement(0)
    require(told.startswith("{:,} points".format(scene.POINTS)), "Store says " + told)
    require("SECRET" not in told, "Store tells what is secret")
    display.Visibility = 0


far = PointFrontRemoteCloud(URL=address)
shown(far, "far")
extract = PointFrontExtract(Input=far, UseRegion=0, Where="intensity > 100")
wanted = PointFrontExtract(Input=here.reader, UseRegion=0, Where="intensity > 100")
counts = []
for one in (extract, wanted):
    one.UpdatePipeline()
    counts.append(one.GetDataInformation().GetNumberOfPoints())
require(counts[0] == counts[1] > 100, "extracted %s" % counts)

shown(simple.OpenDataFile(listed), "far-list")

nowhere = PointFrontRemoteCloud(URL=address.replace("cloud.pfront", "none.pfront"))
nowhere.UpdatePipeline()
require(nowhere.GetDataInformation().GetNumberOfPoints() == 0, "points from nowhere")
far.URL = address  # and what is there goes on
far.UpdatePipeline()
require(far.GetDataInformation().GetNumberOfPoints() > 1000, "no points any more")
simple.Disconnect()
