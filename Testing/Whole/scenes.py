"""Pictures of stores, drawn by the back end that the environment names.

Environment: POINTFRONT_BACKEND software or opengl; the latter needs an X server.
"""

import json
import os

from pictures import read_png
from tool import DATA, SharedStoreTest, ToolTest

BACKEND = os.environ.get("POINTFRONT_BACKEND", "software")
TRIM = DATA / "las/real/autzen_trim.las"
SIZE = (640, 480)


class SceneTest(ToolTest):
    """Where --backend is not given it is the environment's; the tool's default is software."""

    def succeed(self, *arguments, **options):
        return super().succeed(*with_backend(arguments), **options)

    def refuse(self, status, *arguments, **options):
        """A test that means its X server to be missing says so by `environment`."""
        outcome = super().refuse(status, *with_backend(arguments), **options)
        if "environment" not in options:
            self.assertNotIn("no X server answers", outcome.err)
        return outcome

    def picture(self, *arguments, size=SIZE):
        path = self.folder / "picture.png"
        self.succeed("render", *arguments, "-o", path, "--size", f"{size[0]}x{size[1]}")
        return read_png(path)

    def statistics(self, *arguments, **options):
        path = self.folder / "stats.json"
        picture = self.picture(*arguments, "--stats", path, **options)
        return picture, json.loads(path.read_text())


class SharedSceneTest(SceneTest, SharedStoreTest):
    """The same, of one store."""


def with_backend(arguments):
    if arguments[0] not in ("render", "bench") or "--backend" in arguments or BACKEND == "software":
        return arguments
    return (*arguments, "--backend", BACKEND)
