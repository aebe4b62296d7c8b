"""Runs ParaView in one of its ways on a store and compares its pictures with those of the tool.

usage: drive.py WAY      under a display of its own; one of the ways at the end of this file
Told by the environment: POINTFRONT_TOOL, POINTFRONT_PLUGIN, POINTFRONT_CLOUD (what to build the
store from), POINTFRONT_CAMERA, POINTFRONT_PVPYTHONPATH, POINTFRONT_{PVBATCH,PVSERVER,PARAVIEW,
MPIEXEC}. Writes under the current folder only.
"""

import json
import os
import signal
import sys

import drive_data
import drive_drawing
import drive_files
import drive_random
from programs import Programs, tool


def main(way):
    # Ended from outside: through the exits, so that no program stays behind.
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    os.environ["POINTFRONT_OUTPUT"] = os.getcwd()
    store = os.environ["POINTFRONT_STORE"] = os.path.abspath("cloud.pfront")
    tool("build", os.environ["POINTFRONT_CLOUD"], "-o", store, "--force")
    os.environ["POINTFRONT_POINTS"] = str(json.loads(tool("info", store, "--json"))["points"])
    tool("render", store, "-o", "tool.png", "--size", "640x360",
         "--camera", os.environ["POINTFRONT_CAMERA"], "--color-by", "rgb", "--point-size", "2",
         "--error", "0.01", "--background", "0,0,0")
    ways = {name.replace("_", "-"): function
            for module in (drive_data, drive_drawing, drive_files, drive_random)
            for name, function in vars(module).items()
            if getattr(function, "__module__", "") == module.__name__}
    with Programs() as programs:
        ways[way](programs)


if __name__ == "__main__":
    main(sys.argv[1])
