"""Stores as inputs of a build, and many stores as one cloud."""

import os
import shutil
import unittest

from tool import DATA, ToolTest, run

COLOURED = DATA / "las/real/1.2-with-color.las"  # 1,065 points
TRIM = DATA / "las/real/autzen_trim.las"
NAMES = ("intensity", "classification", "rgb", "gps_time")


def same_points(one, other, *names):
    return run(os.environ["POINTFRONT_COMPARE_POINTS"], one, other, *names)


class StoresFromStores(ToolTest):
    def expect_same(self, one, other, points, names=NAMES):
        compared = same_points(one, other, *names)
        self.assertEqual(compared.status, 0, compared)
        self.assertEqual(int(compared.out), points)

    def again(self, *inputs, name, options=()):
        store = self.folder / name
        self.succeed("build", *inputs, "-o", store, *options)
        return store

    def exported(self, store):
        out = store.with_suffix(".las")
        self.succeed("export", store, "-o", out, "--force")
        return out

    def test_1065_points_through_every_structure(self):
        octree = self.build(COLOURED, name="octree.pfront")
        mean = self.again(octree, name="mean.pfront", options=("--refinement", "replace"))
        kdtree = self.again(mean, name="kd.pfront", options=("--structure", "kdtree"))
        flat = self.again(kdtree, name="flat.pfront", options=("--layers", "none"))
        for store in (octree, mean, kdtree, flat):
            self.expect_same(COLOURED, self.exported(store), 1065)
            self.assertTrue(self.succeed("verify", store, "--json").json["ok"])
        first, last = (self.succeed("info", s, "--json").json for s in (octree, flat))
        for key in ("points", "bounds", "precision", "crs", "attributes", "grid"):
            self.assertEqual(first.get(key), last.get(key), key)

    def test_an_index_stands_for_its_file(self):
        las = self.folder / "a.las"
        shutil.copyfile(COLOURED, las)
        self.succeed("index", las)
        side = self.folder / "a.las.pfindex"
        store = self.again(side, name="x.pfront")
        self.assertEqual(store.read_bytes(), self.again(las, name="y.pfront").read_bytes())
        error = self.refuse(1, "build", las, side, "-o", self.folder / "z.pfront").err
        self.assertIn("stored twice", error)
        self.refuse(1, "build", las, side, "-o", self.folder / "z.pfront", "--on-error", "skip")
        with open(las, "ab") as file:
            file.write(b"more")
        self.assertIn("size", self.refuse(1, "build", side, "-o", self.folder / "z.pfront").err)

    def test_two_halves_are_the_whole(self):
        whole = self.build(TRIM, name="whole.pfront")
        info = self.succeed("info", whole, "--json").json
        x0, y0, z0, x1, y1, z1 = info["bounds"]
        middle = round((x0 + x1) / 2, 2) + 0.005  # between two steps of the grid
        halves = []
        for name, low, high in (("west", x0, middle), ("east", middle, x1)):
            las = self.folder / f"{name}.laz"
            box = ",".join(map(str, (low, y0, z0, high, y1, z1)))
            self.succeed("export", whole, "-o", las, "--box", box)
            halves.append(self.build(las, name=f"{name}.pfront"))
        merged = self.again(*halves, name="merged.pfront")
        self.expect_same(TRIM, self.exported(merged), 110000)
        self.assertEqual(merged.read_bytes(),
                         self.again(self.folder / "west.laz", halves[1],
                                    name="mixed.pfront").read_bytes(), "a store or its file")

    def test_attributes_are_added(self):
        store = self.build(TRIM, name="plain.pfront")
        richer = self.again(store, name="rich.pfront", options=("--normals", "pca"))
        self.expect_same(TRIM, self.exported(richer), 110000)
        names = [a["name"] for a in self.succeed("info", richer, "--json").json["attributes"]]
        self.assertIn("normal", names)
        self.assertIn("splat_radius", names)
        direct = self.again(TRIM, name="direct.pfront", options=("--normals", "pca"))
        self.expect_same(self.exported(direct), self.exported(richer), 110000, ("normal",))

    def test_what_is_refused(self):
        store = self.build(COLOURED, name="a.pfront")
        before = store.read_bytes()
        self.assertIn("is read", self.refuse(1, "build", store, "-o", store, "--force").err)
        link = self.folder / "link.pfront"
        os.link(store, link)
        self.assertIn("is read", self.refuse(1, "build", store, "-o", link, "--force").err)
        self.assertEqual(store.read_bytes(), before)
        error = self.refuse(
            1, "build", store, "-o", self.folder / "b.pfront", "--normals", "scanline").err
        self.assertIn("order of the scan", error)
        damaged = self.folder / "damaged.pfront"
        damaged.write_bytes(before[:-100])
        self.refuse(1, "build", damaged, "-o", self.folder / "b.pfront")
        self.assertFalse((self.folder / "b.pfront").exists())

    def test_what_is_lacking_is_told(self):
        full = self.build(COLOURED, name="full.pfront")
        poor = self.again(TRIM, name="poor.pfront", options=("--attributes", "intensity"))
        out = self.succeed("build", full, poor, "-o", self.folder / "both.pfront")
        self.assertIn("poor.pfront' lacks", out.err)

    def test_stores_in_a_folder_of_point_files(self):
        folder = self.folder / "survey"
        folder.mkdir()
        shutil.copyfile(COLOURED, folder / "a.las")
        self.succeed("index", folder / "a.las")
        self.succeed("build", folder / "a.las", "-o", folder / "b.pfront")
        out = self.succeed("build", folder, "-o", self.folder / "all.pfront", "--json")
        self.assertEqual(out.json["points_stored"], 1065)
        self.assertIn("2 stores or indices in it are not read", out.err)
        (folder / "a.las").rename(self.folder / "a.las")
        (folder / "a.las.pfindex").unlink()
        out = self.succeed("build", folder, "-o", self.folder / "one.pfront", "--json")
        self.assertEqual(out.json["points_stored"], 1065)
        self.assertNotIn("not read", out.err)


if __name__ == "__main__":
    unittest.main(verbosity=2)
