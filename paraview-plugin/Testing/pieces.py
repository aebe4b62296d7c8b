"""pvbatch on several processes: each draws its piece of the store, together they draw every point.

usage: pvbatch pieces.py NAME
NAME.png: the complete picture.
"""

import os
import sys

from paraview import simple

simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())

from scene import SIZE, Scene

scene = Scene()
scene.view.ViewSize = SIZE
scene.color_by(scene.display, "rgb")
scene.save_complete(sys.argv[1])
