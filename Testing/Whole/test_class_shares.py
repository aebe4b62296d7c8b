"""Shares of the budgets for classes: --class-share and budget_share of a style."""

import json
import unittest

from scenes import BACKEND, TRIM, SceneTest


class ClassShares(SceneTest):
    def setUp(self):
        super().setUp()
        self.store = self.folder / "layers.pfront"
        self.succeed("build", TRIM, "-o", self.store, "--layers", "class")

    def test_a_class_has_its_share(self):
        def points(*arguments):
            _, statistics = self.statistics(
                self.store, "--view", "top", "--error", "0.01", *arguments)
            return {c["class"]: (c["points_drawn"], c["budget_share"])
                    for c in statistics["classes"]}

        self.assertEqual(points(), {1: (83893, 0), 2: (26107, 0)})
        budget = ("--point-budget", "20000")
        without = points(*budget)
        self.assertLess(without[2][0], 8000)
        style = self.folder / "share.json"
        style.write_text('{"classes": {"2": {"budget_share": 0.75}}}')
        for words in (("--class-share", "2=0.75"), ("--style", style)):
            shared = points(*budget, *words)
            self.assertEqual(shared[2][1], 0.75)
            self.assertGreater(shared[2][0], 11000)
            self.assertLessEqual(shared[1][0] + shared[2][0], 20000)
        plain = self.folder / "plain.pfront"
        self.succeed("build", TRIM, "-o", plain, "--layers", "none")
        outcome = self.refuse(1, "render", plain, "-o", self.folder / "x.png",
                              "--class-share", "2=0.75")
        self.assertIn("a tree for each class", outcome.err)
        _, statistics = self.statistics(plain)
        self.assertEqual(statistics["classes"], [])


@unittest.skipIf(BACKEND == "software", "takes no GPU memory")
class GPUMemory(SceneTest):
    """--gpu-memory for fewer nodes than there are classes."""

    def test_what_fits_is_drawn_and_the_limit_is_told(self):
        stores = {layers: self.folder / f"{layers}.pfront" for layers in ("class", "none")}
        for layers, store in stores.items():
            self.succeed("build", TRIM, "-o", store, "--layers", layers)
        path, stats = self.folder / "x.png", self.folder / "stats.json"
        drawn = {}
        for layers, store in stores.items():
            for memory in ("140K", "200K"):  # room for a node
                outcome = self.succeed("render", store, "-o", path, "--error", "0.1", "--stats",
                                       stats, "--gpu-memory", memory)
                statistics = json.loads(stats.read_text())
                self.assertEqual(statistics["limited_by"], ["gpu-memory"])
                self.assertIn("raise --gpu-memory\n", outcome.err)
                self.assertEqual(statistics["nodes_drawn"], 1)
                self.assertLessEqual(statistics["gpu_bytes"], 140 << 10)
                drawn[layers] = statistics["points_drawn"]
        self.assertGreater(drawn["class"], 0.5 * drawn["none"])
        path.unlink()
        for store in stores.values():
            outcome = self.refuse(1, "render", store, "-o", path, "--gpu-memory", "20K")
            self.assertIn("--gpu-memory", outcome.err)
            self.assertFalse(path.exists())


if __name__ == "__main__":
    unittest.main()
