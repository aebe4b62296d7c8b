"""Pictures of render that do not fit into --memory: see scenes.py."""

import json
import re
import shutil
import signal
import subprocess
import time
import unittest

import numpy

from scenes import BACKEND, TRIM, SceneTest
from tool import SLOWNESS, TOOL, measures, pointfront


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

    def test_points_of_classes_add_up(self):
        self.store = self.folder / "layers.pfront"
        self.succeed("build", TRIM, "-o", self.store, "--layers", "class")
        for memory in ("1G", "24M"):
            _, statistics = self.drawn(memory, "1600x1200", "--view", "iso", "--error", "0.01")
            drawn = {c["class"]: c["points_drawn"] for c in statistics["classes"]}
            self.assertEqual(sum(drawn.values()), statistics["points_drawn"], memory)
            self.assertLessEqual(drawn[1], 83893)
            self.assertLessEqual(drawn[2], 26107)
            self.assertGreater(min(drawn.values()), 20000)

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


@measures
@unittest.skipUnless(BACKEND == "software", "OpenGL keeps nothing in --memory")
class FramesOfManyStores(SceneTest):
    """A frame keeps what was seen of each store, and of each part of its picture (a translucent
    class): 8 bytes a pixel, of up to 64 pictures, as far as 8 million pixels go."""

    SIZE = (320, 240)
    KEYS = 8 * SIZE[0] * SIZE[1]

    def setUp(self):
        super().setUp()
        cloud, first = self.folder / "cloud.las", self.folder / "0.pfront"
        self.succeed("generate", "--points", 20000, "--seed", 3, "-o", cloud)
        self.succeed("build", cloud, "-o", first)
        self.stores = [first]
        for number in range(1, 25):
            self.stores.append(self.folder / f"{number}.pfront")
            shutil.copy(first, self.stores[-1])

    def words(self, stores, memory):
        return ("bench", *self.stores[:stores], "--path", "orbit", "--frames", 2, "--size",
                "{}x{}".format(*self.SIZE), "--memory", memory, "--stats",
                self.folder / "stats.json", *self.style)

    def least(self, stores):
        """The least --memory for frames that the tool asks for, which is enough."""
        told = pointfront(*self.words(stores, "3M"))
        self.assertEqual(told.status, 1, told)
        least = int(re.search(r"a frame of .* takes --memory (\d+) at least", told.err)[1])
        self.succeed(*self.words(stores, least))
        self.refuse(1, *self.words(stores, least - 1))
        return least

    def test_each_of_twenty_stores_counts(self):
        self.style = ()
        four = (self.least(20) - self.least(16)) * 3 / 4
        self.assertAlmostEqual(four, 4 * self.KEYS, delta=8)

    def test_each_part_counts_up_to_64_pictures(self):
        style = self.folder / "style.json"
        self.style = ("--style", style)
        style.write_text("{}")
        plain = [self.least(stores) for stores in (10, 25)]
        style.write_text(json.dumps({"classes": {"2": {"opacity": 0.5}, "5": {"opacity": 0.6}}}))
        # Three pictures of each store, and three targets.
        more = [(self.least(stores) - before) * 3 / 4
                for stores, before in zip((10, 25), plain)]
        self.assertAlmostEqual(more[0] - more[1], (2 * 10 - (64 - 25)) * self.KEYS, delta=8)


if __name__ == "__main__":
    unittest.main(verbosity=2)
