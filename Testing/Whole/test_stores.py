"""Stores as inputs of a build, and many stores as one cloud."""

import os
import shutil
import struct
import unittest

from tool import DATA, SLOWNESS, ToolTest, run

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


def moved(laz, path, x, y):
    """A copy of a LAZ file whose points lie x and y farther: its header's offsets and box do."""
    data = bytearray(laz)
    offsets = struct.unpack_from("<2d", data, 155)
    struct.pack_into("<2d", data, 155, offsets[0] + x, offsets[1] + y)
    box = struct.unpack_from("<4d", data, 179)
    struct.pack_into("<4d", data, 179, box[0] + x, box[1] + x, box[2] + y, box[3] + y)
    path.write_bytes(data)


class Tiles(ToolTest):
    """Many stores as one cloud."""

    def tiles(self, count, points=3000):
        folder = self.folder / "laz"
        folder.mkdir()
        seed = self.folder / "seed.laz"
        self.succeed("generate", "--points", points, "-o", seed)
        laz = seed.read_bytes()
        side = 1 + round(self.succeed("info", seed, "--json").json["bounds"][3]
                         - self.succeed("info", seed, "--json").json["bounds"][0])
        for i in range(count):
            moved(laz, folder / f"t{i:04d}.laz", side * (i % 32), side * (i // 32))
        return folder

    def stores(self, count):
        folder = self.folder / "stores"
        folder.mkdir()
        for laz in sorted(self.tiles(count).iterdir()):
            self.succeed("build", laz, "-o", folder / (laz.stem + ".pfront"))
        return folder

    def test_a_folder_and_a_list_are_one_cloud(self):
        folder = self.stores(6)
        listed = self.folder / "all.pfronts"
        listed.write_text("# the survey\nstores/*.pfront\n")
        merged = self.folder / "merged.pfront"
        self.succeed("build", folder, "-o", merged)
        whole = self.folder / "merged.las"
        self.succeed("export", merged, "-o", whole)
        for name, cloud in (("a", folder), ("b", listed)):
            info = self.succeed("info", cloud, "--together", "--json").json
            self.assertEqual((info["points"], info["structure"]), (6 * 3000, "tiles"))
            self.assertEqual(info["warnings"], [])
            out = self.folder / f"{name}.las"
            self.succeed("export", cloud, "-o", out)
            compared = same_points(whole, out, *NAMES)
            self.assertEqual((compared.status, compared.out.strip()), (0, str(6 * 3000)), compared)
            self.assertTrue(self.succeed("verify", cloud, "--json").json["ok"])
            stats = self.folder / f"{name}.json"
            self.succeed("render", cloud, "-o", self.folder / f"{name}.png", "--stats", stats)
            self.succeed("bench", cloud, "--frames", 3, "--stats", self.folder / "bench.json")
        one, other = ((self.folder / f"{n}.png").read_bytes() for n in "ab")
        self.assertEqual(one, other)
        part = self.folder / "part.xyz"
        self.succeed("export", listed, "-o", part, "--where", "intensity > 100000")
        self.assertEqual(len(part.read_text().splitlines()), 1)
        self.assertEqual(len(self.succeed("info", folder, "--json").json["files"]), 6)

    def test_what_differs_is_told(self):
        folder = self.stores(2)
        self.succeed("build", TRIM, "-o", folder / "far.pfront", "--attributes", "intensity")
        out = self.succeed("render", folder, "-o", self.folder / "a.png")
        self.assertIn("1 of 3 stores lack return_number", out.err)
        self.assertIn("1 of 3 stores", self.succeed(
            "export", folder, "-o", self.folder / "a.xyz").err)

    def test_wrong_lists_and_folders(self):
        listed = self.folder / "all.pfronts"
        for text, says in (("", "names no store"), ("none.pfront\n", "none.pfront"),
                           ("*.pfront\n", "nothing matches")):
            listed.write_text(text)
            self.assertIn(says, self.refuse(1, "info", listed).err)
            self.refuse(1, "render", listed, "-o", self.folder / "a.png")
        (self.folder / "empty").mkdir()
        self.refuse(1, "render", self.folder / "empty", "-o", self.folder / "a.png")

    def test_outputs_do_not_replace_what_a_list_names(self):
        folder = self.stores(1)
        store = next(folder.iterdir())
        before = store.read_bytes()
        copy = self.folder / "copy.las"
        os.link(store, copy)
        self.refuse(1, "export", folder, "-o", copy, "--force")
        self.assertEqual(store.read_bytes(), before)

    def test_a_thousand_laz_files_at_a_glance(self):
        folder = self.tiles(1000)
        stats = self.folder / "s.json"
        out = self.succeed("render", folder, "-o", self.folder / "a.png", "--stats", stats)
        self.assertLess(out.processor_seconds, 5 * SLOWNESS)
        self.assertIn("1000 of 3000000 points", out.err)
        self.assertEqual(self.succeed("info", folder, "--together", "--json").json["points"], 1000)

    def test_a_folder_says_what_a_collection_leaves_out(self):
        """As it does where it is opened itself."""
        (self.folder / "tiles").mkdir()
        self.succeed("build", TRIM, "-o", self.folder / "tiles/trim.pfront")
        self.succeed("generate", "--points", 500, "-o", self.folder / "tiles/more.copc.laz")
        city = self.folder / "city.pfcollection"
        for verb in (("create",), ("replace",), ("create", "--force")):
            said = self.succeed("collection", verb[0], city, self.folder / "tiles", *verb[1:])
            self.assertIn("tiles: 1 indices and COPC files are left out beside 1 stores", said.err)
        self.assertTrue(self.succeed("collection", "list", city).out.startswith("trim  "))


if __name__ == "__main__":
    unittest.main(verbosity=2)
