"""The command `pointfront` of a wheel. A module of its own, so that the tool starts without VTK."""

import os
import pathlib
import sys

TOOL = pathlib.Path(__file__).parent / "pointfront" / "pointfront"


def main():
    """Becomes the tool, with this process's arguments."""
    os.execv(TOOL, ["pointfront", *sys.argv[1:]])
