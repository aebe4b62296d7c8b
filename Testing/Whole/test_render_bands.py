"""Pictures of render that do not fit into --memory: see scenes.py."""

import json
import signal
import subprocess
import time
import unittest

import numpy

from scenes import BACKEND, TRIM, SceneTest
from tool import SLOWNESS, TOOL


@unittest.skipUnless(BACKEND == "software", "OpenGL has no bands")
class Bands(SceneTest):
    """A picture that takes more than half of --memory is drawn a band of rows at a time."""

    def setUp(self):
        super().setUp()
        self.store = self.build(TRIM)

    def drawn(self, memory, size, *arguments):
        path, stats = self.folder / f"{memory}.png", self.folder / "stats.json"
        self.succeed("render", self.store, "-o", path, "--size", size, "--memory", memory,
                     "--stats", stats, *arguments)
        return path.read_bytes(), json.loads(stats.read_text())

    def test_bands_are_the_picture(self):
        views = (("--view", "top", "--edl", "--point-size", "6"),
                 ("--view", "iso", "--point-size", "3"),
                 ("--view", "iso", "--point-size", "31"),
                 ("--error", "4", "--point-size", "9"))
        # Bands of every view run the same code: a sanitizer sees it in the first.
        for view in views if SLOWNESS == 1 else views[:1]:
            whole, statistics = self.drawn("1G", "1600x1200", *view)
            banded, of_bands = self.drawn("24M", "1600x1200", *view)
            self.assertLessEqual(of_bands["picture_bytes"], 12 << 20)
            self.assertGreater(statistics["picture_bytes"], 40 << 20)
            self.assertTrue(banded == whole, view)
            self.assertTrue(of_bands["complete"])
            self.assertEqual(of_bands["error_px"], statistics["error_px"])
            # A band may draw nodes that the whole picture has just out of sight.
            self.assertGreaterEqual(of_bands["points_drawn"], statistics["points_drawn"])
            self.assertLessEqual(of_bands["points_drawn"], 110000)

    def test_memory_holds_the_picture(self):
        limit = 48 << 20
        size = "6000x5000" if SLOWNESS == 1 else "3000x2000"
        _, statistics = self.drawn("48M", size)
        _, small = self.drawn("48M", "64x64")
        self.assertTrue(statistics["complete"])
        self.assertLessEqual(statistics["picture_bytes"] + statistics["resident_bytes"], limit)
        if SLOWNESS == 1:
            program = small["peak_rss_bytes"] # with the decoded points
            self.assertLess(statistics["peak_rss_bytes"], program + limit)

    def test_long_edges(self):
        for size in ((65535, 7), (7, 65535)):
            picture = self.picture(self.store, "--view", "top", "--memory", "256M", size=size)
            self.assertEqual(picture.shape, (size[1], size[0], 3))
            self.assertGreater(len(numpy.unique(picture)), 3)
        self.refuse(2, "render", self.store, "-o", self.folder / "x.png", "--size", "65536x7")

    def test_too_little_memory_for_a_row(self):
        outcome = self.refuse(1, "render", self.store, "-o", self.folder / "x.png", "--size",
                              "65535x7", "--memory", "1M")
        self.assertIn("--memory", outcome.err)
        self.assertEqual(self.entries(), ["cloud.pfront"])

    def test_a_signal_leaves_nothing(self):
        process = subprocess.Popen(
            [TOOL, "render", self.store, "-o", self.folder / "x.png", "--size", "20000x20000",
             "--memory", "64M"], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        while len(self.entries()) == 1: # the picture has no name yet
            self.assertIsNone(process.poll())
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=600 * SLOWNESS)
        self.assertEqual(process.returncode, 130, err)
        self.assertEqual(self.entries(), ["cloud.pfront"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
