"""The promise of docs/promise.md on a few random views; scripts/promise looks at 500."""

import json
import pathlib
import sys
import unittest

import numpy
from tool import TOOL, ToolTest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "Testing/Benchmarks"))
import promise  # noqa: E402 (found by the line above)

SEED = 7
VIEWS = 8


class Promise(ToolTest):
    def keep(self, source, *words):
        store = self.folder / "kept.pfront"
        self.succeed("build", source, "-o", store, *words)
        judge = promise.Judge(TOOL, store, self.folder)
        random = numpy.random.default_rng(SEED)
        for camera, error_px, measures in promise.views(judge, random, VIEWS):
            with self.subTest(camera=camera, error_px=error_px):
                self.assertEqual(promise.broken(measures), [], measures)

    def test_the_bundled_cloud(self):
        self.keep(ROOT / "Testing/Data/autzen_stadium.laz", "--normals", "pca")

    def test_a_landscape(self):
        las = self.folder / "landscape.las"
        self.succeed("generate", "--points", 300000, "--seed", 5, "-o", las)
        self.keep(las)

    def test_no_more_than_the_error_that_was_asked_is_kept_quiet(self):
        """A complete picture has the error, or says what kept it from it. Where the detail is one
        for the view 1.0057 px were told of as 1 px."""
        store = self.build(ROOT / "Testing/Data/autzen_stadium.laz", name="told.pfront")
        stats = self.folder / "stats.json"
        for detail in ("front", "view"):
            for error in ("0.7", "1", "3"):
                with self.subTest(detail=detail, error=error):
                    self.succeed("render", store, "-o", self.folder / "a.png", "--detail", detail,
                                 "--error", error, "--stats", stats)
                    told = json.loads(stats.read_text())
                    self.assertTrue(told["complete"])
                    coarser = told["error_px"] > float(error)
                    self.assertEqual(told["limited_by"], ["detail"] if coarser else [], told)
                    self.assertFalse(coarser and detail == "front")

    def test_broken_promises_are_seen(self):
        """Pictures of eight times the error do not keep it."""
        store = self.build(ROOT / "Testing/Data/autzen_stadium.laz", name="coarse.pfront")
        judge = promise.Judge(TOOL, store, self.folder)
        draw = judge.draw
        judge.draw = lambda camera, error_px, *words: draw(
            camera, error_px if error_px == promise.ALL_POINTS_PX else 8 * error_px, *words)
        random = numpy.random.default_rng(SEED)
        found = {name for _, _, measures in promise.views(judge, random, VIEWS)
                 for name in promise.broken(measures)}
        self.assertLessEqual({"error", "points"}, found)


if __name__ == "__main__":
    unittest.main()
