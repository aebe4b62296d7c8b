"""A cloud by its address, and a list of addresses opened as a file: those of the store here.

usage: python3 far.py PORT ADDRESS LIST VPC      a client of a server
ADDRESS: of the store, with something secret in it. LIST: a file that names it. VPC: a file that
names COPC tiles of the same points by their addresses. Saves far.png, far-list.png and far-vpc.png.
What the server says is about an address that names nothing, and about one that is not in a cache.
"""

import os
import re
import sys

from paraview import simple

simple.Connect("127.0.0.1", int(sys.argv[1]))
address, listed, tiles = sys.argv[2:]

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
    return traffic(display.SMProxy)


def traffic(proxy):
    """Requests and megabytes that the panel tells, and whether the cache is among them."""
    proxy.UpdatePropertyInformation()
    told = proxy.GetProperty("Traffic").GetElement(0)
    match = re.fullmatch(r"([\d,]+) requests, ([\d.]+) MB(; [\d.]+ MB from the cache)?", told)
    require(match, "Traffic says " + told)
    return int(match[1].replace(",", "")), float(match[2]), bool(match[3])


own = here.display.SMProxy
own.UpdatePropertyInformation()
require(own.GetProperty("Traffic").GetElement(0) in ("", "none"), "traffic before any address")
far = PointFrontRemoteCloud(URL=address)
requests, megabytes, cached = shown(far, "far")
require(requests >= 3 and 0.1 < megabytes and not cached, "told: %s" % ((requests, megabytes),))
require(0 < traffic(far.SMProxy)[0] <= requests, "the source tells other traffic")
extract = PointFrontExtract(Input=far, UseRegion=0, Where="intensity > 100")
wanted = PointFrontExtract(Input=here.reader, UseRegion=0, Where="intensity > 100")
counts = []
for one in (extract, wanted):
    one.UpdatePipeline()
    counts.append(one.GetDataInformation().GetNumberOfPoints())
require(counts[0] == counts[1] > 100, "extracted %s" % counts)

shown(simple.OpenDataFile(listed), "far-list")

# COPC tiles: another one lies beside, into which no view looks.
listing = simple.OpenDataFile(tiles)
display = here.show(listing)
require(display.Representation == "Point Front", "shown as " + str(display.Representation))
display.TargetError, display.PointBudget = 0.01, 0
here.color_by(display, "rgb")
here.save("far-vpc")
require(here.frame(display) == (scene.POINTS, True), "tiles: %s" % (here.frame(display),))
display.Visibility = 0

# A cache of its own; then no server is asked.
folder = os.path.abspath("a cache")
kept = PointFrontRemoteCloud(URL=address, CacheFolder=folder, CacheSize=1 << 30)
shown(kept, "far-kept")
require(os.listdir(folder), "nothing is kept")
before = traffic(kept.SMProxy)
offline = PointFrontRemoteCloud(URL=address, CacheFolder=folder, Offline="Cache only")
shown(offline, "far-offline")
after = traffic(offline.SMProxy)
require(after[0] == before[0], "a server was asked: %s, %s" % (before, after))
require(after[2], "nothing came from the cache")
absent = PointFrontRemoteCloud(URL=address, CacheFolder=folder + "2", Offline="Cache only")
absent.UpdatePipeline()
require(absent.GetDataInformation().GetNumberOfPoints() == 0, "points out of an empty cache")

nowhere = PointFrontRemoteCloud(URL=address.replace("cloud.pfront", "none.pfront"))
nowhere.UpdatePipeline()
require(nowhere.GetDataInformation().GetNumberOfPoints() == 0, "points from nowhere")
far.URL = address  # and what is there goes on
far.UpdatePipeline()
require(far.GetDataInformation().GetNumberOfPoints() > 1000, "no points any more")
simple.Disconnect()
