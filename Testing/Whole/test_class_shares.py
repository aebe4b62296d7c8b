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

    def setUp(self):
        super().setUp()
        self.stores = {}
        for refinement in ("add", "replace"):
            for layers in ("class", "none"):
                store = self.folder / f"{layers}-{refinement}.pfront"
                self.succeed("build", TRIM, "-o", store, "--layers", layers,
                             "--refinement", refinement)
                self.stores[refinement, layers] = store

    def test_what_fits_is_drawn_and_the_limit_is_told(self):
        path, stats = self.folder / "x.png", self.folder / "stats.json"
        for detail in ("front", "view"):
            for refinement in ("add", "replace"):
                for memory in ("70K", "120K"):  # room for a node
                    with self.subTest(detail=detail, refinement=refinement, memory=memory):
                        drawn = {}
                        for layers in ("class", "none"):
                            store = self.stores[refinement, layers]
                            outcome = self.succeed(
                                "render", store, "-o", path, "--error", "0.1", "--stats", stats,
                                "--gpu-memory", memory, "--detail", detail)
                            statistics = json.loads(stats.read_text())
                            self.assertEqual(statistics["limited_by"], ["gpu-memory"] +
                                             (["detail"] if detail == "view" else []))
                            self.assertIn("raise --gpu-memory\n", outcome.err)
                            self.assertEqual(statistics["nodes_drawn"], 1)
                            self.assertLessEqual(statistics["gpu_bytes"], 70 << 10)
                            drawn[layers] = statistics["points_drawn"]
                            lacks = ["class 1", "class 2"] if layers == "class" else []
                            shown = {f"class {c['class']}" for c in statistics["classes"]
                                     if c["points_drawn"] > 0}
                            left_out = [name for name in lacks if name not in shown]
                            self.assertEqual(statistics["left_out"], left_out)
                            self.assertEqual("and lacks class" in outcome.err, layers == "class")
                        self.assertGreater(drawn["class"], 0.5 * drawn["none"])

    def test_room_for_two_nodes_is_used(self):
        stats = self.folder / "stats.json"
        for refinement in ("add", "replace"):
            self.succeed("render", self.stores[refinement, "class"], "-o", self.folder / "x.png",
                         "--error", "0.1", "--stats", stats, "--gpu-memory", "130K")
            statistics = json.loads(stats.read_text())
            self.assertEqual(statistics["nodes_drawn"], 2)
            self.assertEqual(statistics["left_out"], [])
            self.assertEqual(statistics["limited_by"], ["gpu-memory"])
            self.assertLessEqual(statistics["gpu_bytes"], 130 << 10)

    def test_no_picture_without_room_for_a_node(self):
        path = self.folder / "x.png"
        for store in self.stores.values():
            for detail in ("front", "view"):
                outcome = self.refuse(1, "render", store, "-o", path, "--gpu-memory", "20K",
                                      "--detail", detail)
                self.assertIn("--gpu-memory", outcome.err)
                self.assertFalse(path.exists())

    def test_clouds_without_a_nodes_room_are_named(self):
        cloud, stats = self.stores["add", "none"], self.folder / "stats.json"
        other = self.folder / "other.pfront"
        self.succeed("build", TRIM, "-o", other, "--layers", "none")
        outcome = self.succeed("render", cloud, other, "-o", self.folder / "x.png",
                               "--gpu-memory", "140K", "--stats", stats)
        left_out = json.loads(stats.read_text())["left_out"]
        self.assertEqual(len(left_out), 1)
        self.assertIn(left_out[0], {str(cloud), str(other)})
        self.assertIn("lacks " + left_out[0], outcome.err)


if __name__ == "__main__":
    unittest.main()
