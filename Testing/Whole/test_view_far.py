"""`pointfront view` of clouds by their addresses, from a server on this machine."""

import os
import pathlib
import sys
import unittest

from pictures import read_png
from tool import DATA
from windows import SIZE, Window, WindowTest, share_of_difference

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "Support"))
# pylint: disable-next=wrong-import-position
from far_server import FarServer

HERE = "127.0.0.1"


class Far(WindowTest):
    def serve(self, folder):
        server = FarServer(folder)
        server.__enter__()
        self.addCleanup(server.__exit__)
        return f"http://{HERE}:{server.port}"

    def assert_shown(self, address, file):
        """The window shows the picture that `render` makes of the file."""
        window = Window(self.folder, address, environment=dict(
            os.environ, POINTFRONT_CACHE="off", no_proxy=HERE))
        self.addCleanup(lambda: window.process.poll() is None and window.close())
        picture = window.picture()
        self.assertEqual(window.end(), (0, ""))
        rendered = self.folder / "rendered.png"
        self.succeed("render", file, "-o", rendered, "--size", f"{SIZE[0]}x{SIZE[1]}")
        self.assertLess(share_of_difference(picture, read_png(rendered)), 0.001, address)

    def test_a_store_and_a_copc_file_are_shown_as_those_of_the_disk(self):
        self.assert_shown(f"{self.serve(self.folder)}/{self.store.name}", self.store)
        file = DATA / "copc/lone-star.copc.laz"
        self.assert_shown(f"{self.serve(file.parent)}/{file.name}", file)


if __name__ == "__main__":
    unittest.main()
