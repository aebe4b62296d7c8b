"""Attributes that are computed between the inputs and the tree: normals and heights."""

import unittest

from tool import DATA, ToolTest

STREET = DATA / "normals/street_thinned.las"
ALL = ("--normals", "pca", "--curvature", "--local-height", "--height-above-ground")


class Attributes(ToolTest):
    def attributes_of(self, store):
        report = self.succeed("info", store, "--json").json
        return {a["name"]: (a["type"], a["components"]) for a in report["attributes"]}

    def test_they_are_stored_and_the_store_is_whole(self):
        store = self.folder / "all.pfront"
        self.succeed("build", STREET, "-o", store, *ALL)
        attributes = self.attributes_of(store)
        self.assertEqual(attributes["normal"], ("int16", 3))
        self.assertEqual(attributes["curvature"], ("uint16", 1))
        self.assertEqual(attributes["local_height"], ("float32", 1))
        self.assertEqual(attributes["height_above_ground"], ("float32", 1))
        self.assertTrue(self.succeed("verify", store, "--json").json["ok"])
        self.assertEqual(self.entries(), ["all.pfront"])

    def test_memory_and_threads_do_not_change_a_byte(self):
        cloud = self.folder / "cloud.las"
        self.succeed("generate", "--points", "400000", "-o", cloud)
        stores = []
        for number, flags in enumerate((("--threads", "1"), ("--threads", "3"),
                                        ("--memory", "48M", "--threads", "2"))):
            stores.append(self.folder / f"{number}.pfront")
            self.succeed("build", cloud, "-o", stores[-1], *ALL, *flags)
        first = stores[0].read_bytes()
        for store in stores[1:]:
            self.assertEqual(store.read_bytes(), first)
        self.assertEqual(self.entries(), ["0.pfront", "1.pfront", "2.pfront", "cloud.las"])

    def test_scan_neighbours(self):
        store = self.folder / "scan.pfront"
        self.succeed("build", STREET, "-o", store, "--normals", "scanline")
        self.assertEqual(self.attributes_of(store)["normal"], ("int16", 3))

    def test_points_without_a_normal_are_said(self):
        bare = self.folder / "bare.las"
        self.succeed("generate", "--points", "2", "-o", bare)
        outcome = self.succeed("build", bare, "-o", self.folder / "two.pfront", "--normals", "pca")
        self.assertIn("2 points have no normal", outcome.err)


if __name__ == "__main__":
    unittest.main()
