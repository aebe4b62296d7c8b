"""The command `pointfront` of a wheel. A module of its own, so that the tool starts without VTK."""

import os
import pathlib
import sys

TOOL = pathlib.Path(__file__).parent / "pointfront" / "pointfront"


def main():
    """Serves, builds on a cluster, or becomes the tool with this process's arguments."""
    if sys.argv[1:2] == ["serve"]:
        from pointfront._serve import main as serve

        sys.exit(serve(sys.argv[2:]))
    if sys.argv[1:2] == ["cluster"]:
        from pointfront._cluster import main as cluster

        sys.exit(cluster(sys.argv[2:]))
    os.execv(TOOL, ["pointfront", *sys.argv[1:]])
