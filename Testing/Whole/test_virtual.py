"""Virtual point clouds (VPC) and STAC lists: one cloud of tiles that open when they are needed."""

import json
import os
import pathlib
import struct
import sys
import unittest

from pictures import read_png
from tool import ToolTest
from virtual_clouds import Tile, item, write_list, write_tiles

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "Support"))

# pylint: disable=wrong-import-position
from far_server import FarServer

HERE = "127.0.0.1"
SIDE = 8
# From tile to tile, units: so far that no sphere around a tile reaches into the margin that a view
# of another tile loads (an eighth of the picture, if the picture has time for it).
STEP = (150, 100)


class VirtualClouds(ToolTest):
    def setUp(self):
        super().setUp()
        self.succeed("generate", "--points", "2000", "-o", self.folder / "one.las")
        store = self.build(self.folder / "one.las")
        self.copc = self.folder / "one.copc.laz"
        self.succeed("export", store, "-o", self.copc)
        self.tile = Tile(self.copc)
        self.list = write_tiles(self.copc, self.folder, SIDE, STEP)
        self.environment = {name: value for name, value in os.environ.items()
                            if "proxy" not in name.lower()}
        self.environment.update(POINTFRONT_CACHE="off")

    def points(self, cloud, *options):
        out = self.folder / "points.csv"
        self.succeed("export", cloud, "-o", out, "--force", *options, environment=self.environment)
        return out.read_bytes()

    def draw(self, cloud, *options):
        picture = self.folder / "picture.png"
        self.succeed("render", cloud, "-o", picture, "--size", "320x240", "--backend", "software",
                     *options, environment=self.environment)
        return read_png(picture)

    def items(self):
        return json.loads(self.list.read_text())["features"]

    def box(self, column, row):
        low = [self.tile.low[axis] + STEP[axis] * (column, row)[axis] for axis in range(2)]
        high = [self.tile.high[axis] + STEP[axis] * (column, row)[axis] for axis in range(2)]
        return ",".join(map(str, (*low, -1000, *high, 1000)))

    def test_it_is_the_cloud_of_its_tiles(self):
        plain = self.folder / "all.pfronts"
        plain.write_text("".join(f"{one['assets']['data']['href']}\n" for one in self.items()))
        self.assertEqual(self.points(self.list), self.points(plain))
        self.assertEqual(self.points(self.list, "--box", self.box(3, 2)),
                         self.points(plain, "--box", self.box(3, 2)))
        # Every point is drawn: how many are enough for a pixel depends on what is above a node.
        self.assertTrue((self.draw(self.list, "--error", "0.05") ==
                         self.draw(plain, "--error", "0.05")).all())
        told = self.succeed("info", self.list, "--together", "--json").json
        self.assertEqual(told["points"], SIDE * SIDE * self.tile.points)
        self.assertIsNone(told["nodes"])
        self.assertEqual(self.succeed("verify", self.list, "--json").json["points_checked"],
                         SIDE * SIDE * self.tile.points)

    def built(self, cloud):
        store = self.folder / "built.pfront"
        self.succeed("build", cloud, "-o", store, "--force", environment=self.environment)
        return sorted(self.points(store).splitlines())

    def test_a_store_is_built_of_the_files_that_a_list_names(self):
        """Here and behind addresses, COPC and plain LAS."""
        expected = sorted(self.points(self.list).splitlines())
        self.assertEqual(self.built(self.list), expected)
        with FarServer(self.folder) as server:
            items = self.items()
            self.succeed("export", self.folder / "tile-0-0.copc.laz", "-o",
                         self.folder / "plain.las")
            items[0]["assets"]["data"]["href"] = "./plain.las"
            for one in items[1::2]:
                name = one["assets"]["data"]["href"]
                one["assets"]["data"]["href"] = f"http://{HERE}:{server.port}/{name}"
            del items[3]["properties"]["pc:count"]
            mixed = write_list(self.folder / "mixed.json", items)
            self.assertEqual(self.built(mixed), expected)
            names = self.folder / "mixed.pfronts"
            names.write_text("".join(f"{one['assets']['data']['href']}\n" for one in items))
            self.assertEqual(self.built(names), expected)
            self.assertEqual(self.built(f"http://{HERE}:{server.port}/all.vpc"), expected)
        (self.folder / "none.vpc").write_text("points\n")
        refused = self.refuse(1, "build", self.folder / "none.vpc", "-o", self.folder / "no.pfront")
        self.assertIn("ItemCollection", refused.err)

    def test_a_file_counts_once(self):
        """Whatever names of the list lead to it, with facts and without."""
        here = self.folder.name
        (self.folder / "hard.copc.laz").hardlink_to(self.copc)
        (self.folder / "soft.copc.laz").symlink_to(self.copc)
        (self.folder / "linked").symlink_to(self.folder)
        names = ["one.copc.laz", "./one.copc.laz", f"../{here}/one.copc.laz", "hard.copc.laz",
                 "soft.copc.laz", "linked/one.copc.laz", str(self.copc)]
        right = self.points(self.copc)
        for facts in (True, False):
            items = [item(name, [*self.tile.low, *self.tile.high], self.tile.points)
                     for name in names]
            for one in items if not facts else ():
                del one["properties"]["pc:count"]
            twice = write_list(self.folder / "twice.vpc", items)
            told = self.succeed("info", twice, "--together", "--json").json
            self.assertEqual(told["points"], self.tile.points)
            self.assertEqual(self.points(twice), right)
            store = self.folder / "of_list.pfront"
            made = self.succeed("build", twice, "-o", store, "--force", "--json").json
            self.assertEqual(made["points_stored"], self.tile.points)

    def test_settings_of_a_list_are_those_of_its_tiles(self):
        cache = self.folder / "a cache"
        with FarServer(self.folder) as server:
            items = self.items()
            for one in items[1::2]:
                name = one["assets"]["data"]["href"][2:]
                one["assets"]["data"]["href"] = f"http://{HERE}:{server.port}/{name}"
            write_list(self.folder / "far.vpc", items)
            address = f"http://{HERE}:{server.port}/far.vpc"
            kept = f"#far:cache={str(cache).replace(' ', '%20')}"
            expected = self.points(self.list)
            self.assertEqual(self.points(address + kept), expected)
            server.requests.clear()
            self.assertEqual(self.points(f"{address}{kept}&offline=1"), expected)
            self.assertEqual(server.requests, [])
            told = self.refuse(1, "info", f"{address}#far:offlin=1", environment=self.environment)
            self.assertIn("'offlin=1' is no setting", told.err)

    def test_a_box_opens_its_tiles_only(self):
        with FarServer(self.folder) as server:
            address = f"http://{HERE}:{server.port}/all.vpc"
            expected = self.points(self.list, "--box", self.box(3, 2))
            server.requests.clear()
            self.assertEqual(self.points(address, "--box", self.box(3, 2)), expected)
            asked = {seen["path"] for seen in server.requests}
            self.assertIn("/tile-3-2.copc.laz", asked)
            self.assertLessEqual(len(asked), 6, asked)  # the list, four to know them by, and it

    def test_a_picture_of_all_tiles_fetches_little_more_than_they_are(self):
        facts = self.folder / "facts.json"
        with FarServer(self.folder) as server:
            self.draw(f"http://{HERE}:{server.port}/all.vpc", "--stats", facts)
        fetched = json.loads(facts.read_text())["bytes_fetched"]
        tiles = SIDE * SIDE * self.copc.stat().st_size
        self.assertLessEqual(fetched, 1.3 * (tiles + self.list.stat().st_size)) # 2.3 before

    def test_a_view_opens_the_tiles_in_sight_only(self):
        centre = [(self.tile.low[axis] + self.tile.high[axis]) / 2 + (3, 2)[axis] * STEP[axis]
                  for axis in range(2)]
        camera = self.folder / "near.json"
        camera.write_text(json.dumps({
            "position": [*centre, self.tile.high[2] + 60], "view_up": [0, 1, 0], "view_angle": 30,
            "focal_point": [*centre, self.tile.low[2]]}))
        near = self.draw(self.list, "--camera", camera)
        with FarServer(self.folder) as server:
            address = f"http://{HERE}:{server.port}/all.vpc"
            self.assertTrue((self.draw(address, "--camera", camera) == near).all())
            asked = {seen["path"] for seen in server.requests}
            self.assertIn("/tile-3-2.copc.laz", asked)
            self.assertLessEqual(len(asked), 6, asked)
            # A server's list names absolute addresses, and its search has no file name.
            items = self.items()
            for one in items:
                name = one["assets"]["data"]["href"]
                one["assets"]["data"]["href"] = f"http://{HERE}:{server.port}/{name}"
            write_list(self.folder / "search", items)
            far = self.draw(f"http://{HERE}:{server.port}/search", "--camera", camera)
            self.assertTrue((far == near).all())

    def test_a_list_that_tells_too_little_opens_all(self):
        items = self.items()
        for one in items:
            del one["properties"]["pc:count"]
        short = write_list(self.folder / "short.json", items)
        self.assertEqual(self.points(short), self.points(self.list))

    def test_a_list_that_lies_is_told_where_it_matters(self):
        """Tiles that are not looked into do not matter."""
        place = 3 * SIDE + 2
        def lying(name, change):
            items = self.items()
            change(items[place])
            return write_list(self.folder / f"{name}.vpc", items)
        def count(one):
            one["properties"]["pc:count"] += 1
        def bounds(one):
            one["properties"]["proj:bbox"][0] += 10
        def missing(one):
            one["assets"]["data"]["href"] = "./none.copc.laz"
        def other(one):
            one["assets"]["data"]["href"] = "./one.las"
        right = self.points(self.list, "--box", self.box(5, 5))
        for name, change, word in (("count", count, "points, not"), ("bounds", bounds, "lie in"),
                                   ("missing", missing, "none.copc.laz"),
                                   ("other", other, "one.las")):
            with self.subTest(name):
                cloud = lying(name, change)
                out = self.folder / "no.csv"
                refused = self.refuse(1, "export", cloud, "-o", out, "--box", self.box(3, 2))
                self.assertIn(word, refused.err)
                self.assertFalse(out.exists())
                self.assertEqual(self.points(cloud, "--box", self.box(5, 5)), right)
                refused = self.refuse(1, "render", cloud, "-o", self.folder / "no.png",
                                      "--backend", "software", "--size", "320x240")
                self.assertIn(word, refused.err)

    def classified(self, name, classes):
        """The item of a store whose points have these classes in turn, and a tree for each."""
        points = bytearray((self.folder / "one.las").read_bytes())
        begin, _, form, size = struct.unpack_from("<IIBH", points, 96)
        for number in range(2000):
            place = begin + number * size + (16 if form > 5 else 15)
            points[place] = classes[number % len(classes)]
        (self.folder / "classes.las").write_bytes(points)
        store = self.folder / f"{name}.pfront"
        self.succeed("build", self.folder / "classes.las", "-o", store, "--layers", "class",
                     "--force")
        told = self.succeed("info", store, "--json").json
        self.assertEqual([layer["class"] for layer in told["layers"]], classes)
        return item(f"./{store.name}", told["bounds"], told["points"])

    def test_stores_of_a_list_may_have_other_classes_than_the_first_ones(self):
        for others in ([2, 6], [6]):
            items = [self.classified(f"tile{i}", others if i == 4 else [2]) for i in range(6)]
            cloud = write_list(self.folder / "classes.vpc", items)
            self.assertEqual(self.succeed("verify", cloud, "--json").json["points_checked"], 12000)
            told = self.succeed("info", cloud, "--together", "--json").json
            self.assertEqual([layer["class"] for layer in told["layers"]], [2, 6])
            self.assertEqual(len(self.points(cloud, "--classes", "6").splitlines()),
                             1 + 2000 // len(others))

    def test_a_list_of_stores_with_class_trees_that_lies_is_told(self):
        """Such stores are all opened with the list, and each is compared with it."""
        items = [self.classified(name, [2, 6]) for name in ("west", "east")]
        told = self.succeed("info", self.folder / "east.pfront", "--json").json
        right = write_list(self.folder / "right.vpc", items)
        self.succeed("verify", right)
        for key, lie, word in (
                ("pc:count", items[1]["properties"]["pc:count"] + 7, "points, not"),
                ("proj:bbox", [value + 5000 for value in told["bounds"]], "lie in")):
            items[1]["properties"], kept = {**items[1]["properties"], key: lie}, \
                items[1]["properties"]
            refused = self.refuse(1, "verify", write_list(self.folder / "lie.vpc", items))
            self.assertIn(word, refused.err)
            self.assertIn("east.pfront", refused.err)
            items[1]["properties"] = kept

    def test_other_systems_and_lists_that_are_none(self):
        items = self.items()
        for number, one in enumerate(items):
            one["properties"]["proj:epsg"] = 25832 if number == 0 else 25833
        mixed = write_list(self.folder / "mixed.vpc", items)
        told = self.succeed("info", mixed, "--together", "--json").json
        self.assertIn("63 of 64 files", " ".join(told["warnings"]))
        (self.folder / "none.vpc").write_text("points\n")
        self.assertIn("ItemCollection",
                      self.refuse(1, "info", self.folder / "none.vpc", "--together").err)
        write_list(self.folder / "gone.vpc", [item("gone.copc.laz", [0, 0, 0, 1, 1, 1], 5)])
        self.assertIn("gone.copc.laz",
                      self.refuse(1, "info", self.folder / "gone.vpc", "--together").err)


if __name__ == "__main__":
    unittest.main()
