"""A Python client of a pvserver with several ranks: each draws its piece, together the cloud.

usage: python3 client.py PORT NAME RANKS     saves NAME.png
"""

import sys
import time

from paraview import servermanager, simple

port, name, ranks = int(sys.argv[1]), sys.argv[2], int(sys.argv[3])
simple.Connect("127.0.0.1", port)

from scene import PLUGIN, POINTS, SIZE, Scene, require

require(servermanager.ActiveConnection.GetNumberOfDataPartitions() == ranks, "ranks of the server")
simple.LoadPlugin(PLUGIN, remote=True, ns=globals())
simple.LoadPlugin(PLUGIN, remote=False, ns=globals())

scene = Scene()
scene.view.ViewSize = SIZE
scene.color_by(scene.display, "rgb")



def refine(display):
    """At rest: the client asks for further frames until nothing is missing."""
    frames = []
    tag = scene.view.SMProxy.AddObserver("EndEvent", lambda *_: frames.append(scene.frame(display)))
    scene.view.SMProxy.StillRender()
    deadline = time.time() + 60.0
    while not frames[-1][1] and time.time() < deadline:
        scene.view.SMProxy.GetInteractor().ProcessEvents()
        time.sleep(0.005)
    scene.view.SMProxy.RemoveObserver(tag)
    print("frames at rest:", frames)
    return frames


frames = refine(scene.display)
require(frames[-1] == (POINTS, True), "the last frame is %s of %d points" % (frames[-1], POINTS))

scene.save_complete(name)

# The first frame of a cloud that takes longer than a frame may does not wait for it.
scene.display.Visibility = 0
large = scene.show_large()
frames = refine(large)
require(len(frames) > 1 and frames[0][0] < frames[-1][0] and frames[-1][1],
        "the first frame waited for all points: %s" % frames)
large.Visibility = 0
scene.display.Visibility = 1
scene.look()

# Classes and settings are those of the server's processes.
require(list(scene.display.Classes.Available) == ["all"],
        "classes of the server's store: %s" % scene.display.Classes.Available)
simple.GetSettingsProxy("PointFrontSettings").HostMemoryBudgetMiB = 400
require(scene.budget() == 400, "set to 400 MiB, the server has %d" % scene.budget())

# Complete Still Renders overrules what a window does by itself.
patient = Scene()
patient.display.CompleteStillRenders = "Always"
patient.view.SMProxy.StillRender()
require(patient.frame() == (POINTS, True), "a patient render draws %s" % (patient.frame(),))
simple.Disconnect()
