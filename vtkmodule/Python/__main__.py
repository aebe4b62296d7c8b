"""The command line tool: `pointfront` and `python -m pointfront`."""

import os
import sys

from ._host import TOOL


def main():
    """Serves, builds on a cluster, or becomes the tool with this process's arguments."""
    if sys.argv[1:2] == ["serve"]:
        from ._serve import main as serve

        sys.exit(serve(sys.argv[2:]))
    if sys.argv[1:2] == ["cluster"]:
        from ._cluster import main as cluster

        sys.exit(cluster(sys.argv[2:]))
    if not TOOL.exists():
        sys.exit(f"pointfront: the tool is not installed: there is no {TOOL}")
    os.execv(TOOL, ["pointfront", *sys.argv[1:]])


if __name__ == "__main__":
    main()
