"""pvbatch on any number of processes: every point, by each back end.

usage: pvbatch backends.py NAME      saves NAME-opengl.png and NAME-software.png
"""

import os
import sys

from paraview import simple

simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())

from scene import SIZE, Scene

name = sys.argv[1]
scene = Scene()
scene.view.ViewSize = SIZE
scene.color_by(scene.display, "rgb")
for backend in ("OpenGL", "Software"):
    scene.display.Backend = backend
    scene.save_complete("%s-%s" % (name, backend.lower()))
