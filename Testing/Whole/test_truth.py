"""The program `truth`: its files fit together, and the tool builds stores of its points."""

import array
import json
import math
import os
import unittest

from tool import ToolTest, run

TRUTH = os.environ["POINTFRONT_TRUTH"]
FILES = ["camera.json", "depth.f32", "mask.png", "oracle.png", "points.ply", "truth.json",
         "truth.png"]


class Truth(ToolTest):
    def make(self, name, *arguments):
        folder = self.folder / name
        outcome = run(TRUTH, *arguments, "--width", 120, "--height", 90, "--samples", 2,
                      "--oracle", "-o", folder)
        self.assertEqual(outcome.status, 0, outcome)
        return folder, json.loads((folder / "truth.json").read_text())

    def test_the_files_fit_together(self):
        folder, facts = self.make("a", "knot", "--view", "mid", "--spacing-px", 2)
        self.assertEqual(sorted(entry.name for entry in folder.iterdir()), FILES)
        camera = json.loads((folder / "camera.json").read_text())
        self.assertEqual(set(camera), {"position", "focal_point", "view_up", "view_angle"})
        self.assertAlmostEqual(facts["spacing_px"], 2)
        self.assertAlmostEqual(
            facts["spacing"], 2 * facts["median_depth"] / facts["focal_px"])
        depths = array.array("f", (folder / "depth.f32").read_bytes())
        self.assertEqual(len(depths), facts["width"] * facts["height"])
        seen = [depth for depth in depths if math.isfinite(depth)]
        self.assertLess(min(seen), facts["median_depth"])
        self.assertGreater(max(seen), facts["median_depth"])

        store = self.build(folder / "points.ply")
        self.assertEqual(self.succeed("info", store, "--json").json["points"], facts["points"])
        told = self.succeed("compare", folder / "oracle.png", folder / "truth.png", "--mask",
                            folder / "mask.png", "--json").json
        self.assertEqual(told["background"], facts["background"])
        self.assertLess(told["holes"], 0.2)
        self.assertEqual(told["bloat"], 0)
        self.assertGreater(told["psnr"], 20)
        self.assertGreater(told["pixels"], 0.2 * facts["width"] * facts["height"])

    def test_the_same_words_give_the_same_bytes(self):
        words = ("town", "--view", "far", "--spacing-px", 4, "--sampling", "scan")
        one, _ = self.make("a", *words)
        other, _ = self.make("b", *words)
        for name in FILES:
            self.assertEqual((one / name).read_bytes(), (other / name).read_bytes(), name)

    def test_wrong_words(self):
        for words in (("village",), ("town", "--view", "above"), ("town", "--spacing-px", 0)):
            outcome = run(TRUTH, *words, "-o", self.folder / "x")
            self.assertNotEqual(outcome.status, 0, words)
        self.assertEqual(self.entries(), [])


if __name__ == "__main__":
    unittest.main()
