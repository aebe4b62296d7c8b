"""Collections: thousands of tiles as one file, changed tile by tile."""

import json
import os
import random
import unittest

from collection_test import CollectionTest
from tool import write_las


class Collections(CollectionTest):
    def test_is_one_cloud_for_every_command(self):
        stores = [self.tile(number) for number in range(8)]
        made = self.collection("create", self.city, self.folder / "tiles")
        self.assertEqual((made["tiles"], made["points"], made["state"]), (8, 24000, 1))
        told = self.succeed("info", self.city, "--json").json
        self.assertEqual((told["points"], told["structure"]), (24000, "collection"))
        verified = self.succeed("verify", self.city, "--json").json
        self.assertEqual((verified["ok"], verified["points_checked"]), (True, 24000))
        self.assertTrue(self.collection("verify", self.city)["ok"])
        for source in (self.city, self.folder / "tiles"):
            self.succeed("export", source, "-o", self.folder / f"{source.name}.xyz",
                         "--box", "50,50,-10,250,150,10")
        one, other = (sorted((self.folder / f"{name}.xyz").read_text().split("\n"))
                      for name in (self.city.name, "tiles"))
        self.assertEqual(one, other)
        self.assertGreater(len(one), 3000)
        view = ("--view", "top", "--size", "300x200", "--technique", "points", "--point-size", "2")
        self.succeed("render", self.city, "-o", self.folder / "a.png", *view)
        self.succeed("render", self.folder / "tiles", "-o", self.folder / "b.png", *view)
        alike = self.succeed("compare", self.folder / "a.png", self.folder / "b.png", "--json").json
        self.assertGreater(alike["psnr"], 40, alike)
        bench = self.folder / "bench.json"
        self.succeed("bench", self.city, "--path", "zoom", "--frames", "20", "--stats", bench)
        self.assertGreater(json.loads(bench.read_text())["points_drawn"]["max"], 1000)
        self.assertEqual(len(stores), 8)

    def reds(self, cloud):
        """The reds of all points, by their places."""
        text = self.folder / "colours.csv"
        self.succeed("export", cloud, "-o", text, "--force", "--progress", "none")
        names, *rows = (line.split(",") for line in text.read_text().splitlines())
        at = names.index("red")
        return sorted((row[0], row[1], row[at]) for row in rows)

    def test_has_the_colours_that_a_build_of_its_files_has(self):
        """LAS files do not say how deep their colours are. Those of 8 bits beside those of 16 are
        widened in a build; so they are where indices draw the files in place."""
        draw = random.Random(7)
        made = []
        for number, top in enumerate((255, 65535)):
            points = [(100 * number + 100 * draw.random(), 100 * draw.random(), draw.random(),
                       *(draw.randrange(top + 1) for _ in range(3))) for _ in range(3000)]
            made.append(write_las(self.folder / f"of_{top}.las", points))
            self.succeed("index", made[-1], "--progress", "none")
        narrow, wide = (f"{las}.pfindex" for las in made)
        self.succeed("build", *made, "-o", self.folder / "both.pfront", "--progress", "none")
        expected = self.reds(self.folder / "both.pfront")
        self.assertTrue(all(int(red) % 257 == 0 for x, _, red in expected if float(x) < 99))
        listed = self.folder / "both.pfronts"
        listed.write_text(f"{narrow}\n{wide}\n")
        self.assertEqual(self.reds(listed), expected)
        self.collection("create", self.city, narrow, wide)
        self.assertEqual(self.reds(self.city), expected)
        self.assertTrue(self.collection("verify", self.city)["ok"])
        alone = self.folder / "grown.pfcollection"  # its heads have 8 bits until the second comes
        self.collection("create", alone, narrow)
        self.assertLess(max(int(row[2]) for row in self.reds(alone)), 256)
        self.collection("add", alone, wide)
        self.assertEqual(self.reds(alone), expected)

    def test_epochs_are_drawn_and_exported_alone(self):
        """Each epoch's picture is that of its stores alone, and so are its points."""
        view = ("--view", "top", "--size", "300x200", "--technique", "points", "--point-size", "2")
        for year, lift in (("2019", 0.0), ("2024", 40.0)):
            for number in range(3):
                self.tile(number + (5 if year == "2024" else 0), folder=year, lift=lift)
        self.collection("create", self.city, self.folder / "2019", "--epoch", "2019")
        self.collection("add", self.city, self.folder / "2024", "--epoch", "2024")
        self.assertEqual(self.succeed("info", self.city, "--json").json["epochs"], ["2019", "2024"])
        pictures = []
        for year in ("2019", "2024"):
            told = self.succeed("info", self.city, "--epoch", year, "--json").json
            self.assertEqual((told["points"], told["epochs"]), (9000, [year]))
            for name, source in (("epoch", (self.city, "--epoch", year)),
                                 ("address", (f"{self.city}#epoch={year}",)),
                                 ("stores", (self.folder / year,))):
                self.succeed("render", *source, "-o", self.folder / f"{name}.png", *view)
                self.succeed("export", *source, "-o", self.folder / f"{name}.xyz", "--force")
            for name in ("address", "stores"):
                alike = self.succeed("compare", self.folder / "epoch.png",
                                     self.folder / f"{name}.png", "--json").json
                self.assertGreater(alike["psnr"] or 99, 40, (year, name, alike))  # null: equal
            texts = [sorted((self.folder / f"{name}.xyz").read_text().split("\n"))
                     for name in ("epoch", "address", "stores")]
            self.assertEqual(texts[0], texts[1])
            self.assertEqual(texts[0], texts[2])
            pictures.append((self.folder / "epoch.png").read_bytes())
        self.assertNotEqual(*pictures)
        told = self.refuse(1, "render", self.city, "--epoch", "1999", "-o",
                           self.folder / "none.png")
        self.assertIn("it has: 2019, 2024", told.err)
        told = self.refuse(1, "render", self.folder / "2019" / "tile_0.pfront", "--epoch", "2019",
                           "-o", self.folder / "none.png")
        self.assertIn("is no collection", told.err)

    def test_a_far_view_reads_no_tile(self):
        for number in range(12):
            self.tile(number)
        self.collection("create", self.city, self.folder / "tiles")
        os.rename(self.folder / "tiles", self.folder / "elsewhere")
        picture = self.folder / "far.png"
        self.succeed("render", self.city, "-o", picture, "--view", "top", "--size", "32x24")
        near = self.refuse(1, "render", self.city, "-o", self.folder / "near.png", "--view", "top",
                           "--size", "1200x900", "--technique", "points")
        self.assertIn("tile_", near.err)
        self.assertFalse((self.folder / "near.png").exists())

    def test_a_replaced_tile_is_one_error_until_it_is_taken_in(self):
        for number in range(3):
            self.tile(number)
        self.collection("create", self.city, self.folder / "tiles")
        corrected = self.tile(1, 3500, lift=5.0)
        said = self.refuse(1, "export", self.city, "-o", self.folder / "x.xyz")
        self.assertIn("tile_1.pfront", said.err)
        self.assertIn("has been replaced", said.err)
        self.refuse(1, "collection", "verify", self.city)
        self.assertEqual(self.collection("replace", self.city, corrected)["points"], 9500)
        self.assertTrue(self.collection("verify", self.city)["ok"])
        self.refuse(1, "collection", "undo", self.city)  # that file is gone
        self.assertEqual(self.names(), ["tile_0", "tile_1", "tile_2"])

    def test_changes_and_their_history(self):
        tiles = [self.tile(number) for number in range(5)]
        self.collection("create", self.city, *tiles[:3], "--epoch", "2019")
        self.collection("add", self.city, tiles[3])
        named = self.tile(9, folder="new")
        self.collection("replace", self.city, named, "--name", "tile_0")
        self.collection("remove", self.city, "tile_1", self.folder / "tiles/tile_2.pfront")
        listed = self.collection("list", self.city)
        self.assertEqual(self.names(), ["tile_0", "tile_3"])
        self.assertEqual(listed["history"], ["add 1 tile", "replace 1 tile", "remove 2 tiles"])
        first = next(tile for tile in listed["tiles"] if tile["name"] == "tile_0")
        self.assertEqual((first["address"], first["epoch"]), ("new/tile_9.pfront", "2019"))
        for expected in (["tile_0", "tile_1", "tile_2", "tile_3"],) * 2 + (
                ["tile_0", "tile_1", "tile_2"],):
            self.collection("undo", self.city)
            self.assertEqual(self.names(), expected)
        self.refuse(1, "collection", "undo", self.city)
        self.collection("add", self.city, tiles[4])
        self.collection("compact", self.city)
        self.assertEqual(self.collection("list", self.city)["history"], [])
        self.assertEqual(len(self.names()), 4)
        self.assertTrue(self.succeed("verify", self.city, "--json").json["ok"])

    def test_a_link_is_followed(self):
        """From another folder, too; and it stays a link."""
        tiles = [self.tile(number) for number in range(4)]
        self.collection("create", self.city, *tiles[:2])
        away = self.folder / "away"
        away.mkdir()
        for link in (self.folder / "now.pfcollection", away / "now.pfcollection"):
            link.symlink_to(self.city)
        (away / "again.pfcollection").symlink_to("now.pfcollection")
        self.collection("add", self.folder / "now.pfcollection", tiles[2])
        self.collection("add", away / "again.pfcollection", tiles[3])
        self.collection("remove", away / "now.pfcollection", tiles[0])
        self.collection("replace", away / "now.pfcollection", self.tile(1, 3500))
        self.collection("compact", away / "now.pfcollection")
        for name in ("now.pfcollection", "away/now.pfcollection", "away/again.pfcollection"):
            self.assertTrue((self.folder / name).is_symlink(), name)
            self.assertTrue(self.collection("verify", self.folder / name)["ok"])
            self.succeed("export", self.folder / name, "-o", self.folder / "x.xyz", "--force")
        self.assertEqual([tile["address"] for tile in self.collection("list", self.city)["tiles"]],
                         [f"tiles/tile_{number}.pfront" for number in (2, 3, 1)])
        self.assertEqual(self.entries(), ["away", "city.pfcollection", "now.pfcollection", "tiles",
                                          "x.xyz"])

    def test_lie_in_a_linked_folder(self):
        (self.folder / "one/two").mkdir(parents=True)
        (self.folder / "short").symlink_to("one/two")
        city = self.folder / "short/city.pfcollection"
        self.collection("create", city, self.tile(0))
        self.collection("add", city, self.tile(1, folder="short"))
        self.assertTrue(self.collection("verify", city)["ok"])
        self.collection("remove", city, self.folder / "tiles/tile_0.pfront")
        self.assertEqual([tile["address"] for tile in self.collection("list", city)["tiles"]],
                         ["tile_1.pfront"])

    def test_a_name_is_the_one_that_was_chosen_or_none(self):
        tiles = [self.tile(number) for number in range(4)]
        self.collection("create", self.city, *tiles[:3])
        before = self.city.read_bytes()
        said = self.refuse(1, "collection", "add", self.city, tiles[3], "--name", "tile_1")
        self.assertIn("has a tile of the name 'tile_1'", said.err)
        said = self.refuse(1, "collection", "replace", self.city, tiles[2], "--name", "tile_1")
        self.assertIn("is the tile 'tile_2', which cannot replace the tile 'tile_1'", said.err)
        said = self.refuse(1, "collection", "replace", self.city, tiles[2], "--name", "other")
        self.assertIn("has no tile 'other'", said.err)
        for option in ("--name", "--epoch"):
            self.refuse(2, "collection", "add", self.city, tiles[3], option, "")
            for text in ("a\nb", "\x1b[31mred", "a\x7f"):
                said = self.refuse(1, "collection", "add", self.city, tiles[3], option, text)
                self.assertIn("control characters", said.err)
                self.refuse(1, "collection", "replace", self.city, tiles[2], option, text)
        self.refuse(1, "collection", "create", self.folder / "no.pfcollection", tiles[3],
                    "--epoch", "a\tb")
        lines = self.folder / "tiles/two\nlines.pfront"
        lines.symlink_to(tiles[3])
        said = self.refuse(1, "collection", "add", self.city, lines)
        self.assertIn("control characters", said.err)
        self.assertIn("rename its file", said.err)
        self.assertEqual(self.city.read_bytes(), before)
        self.assertEqual(self.entries(), ["city.pfcollection", "tiles"])
        self.collection("replace", self.city, tiles[2], "--name", "tile_2")
        self.collection("replace", self.city, tiles[3], "--name", "tile_1")
        self.collection("add", self.city, tiles[1], "--name", "Straße")
        self.assertEqual(self.names(), ["Straße", "tile_0", "tile_1", "tile_2"])

    def test_a_tile_is_one_line_of_the_list_wherever_it_lies(self):
        self.collection("create", self.city, self.tile(0, folder="two\nlines"))
        listed = self.succeed("collection", "list", self.city).out.splitlines()
        self.assertEqual(listed[0], "tile_0  3000 points  two lines/tile_0.pfront")
        self.assertTrue(listed[1].startswith("1 tiles, state 1"), listed)

    def test_a_path_counts_once_and_a_link_as_often_as_it_is_named(self):
        tiles = [self.tile(number) for number in range(3)]
        (self.folder / "linked").symlink_to("tiles")
        (self.folder / "more").mkdir()
        (self.folder / "more/hard.pfront").hardlink_to(tiles[0])
        (self.folder / "more/soft.pfront").symlink_to(tiles[0])
        others = [self.folder / name for name in (
            "linked/tile_0.pfront", "more/hard.pfront", "more/soft.pfront")]
        same = self.folder / "more" / ".." / "tiles" / "tile_0.pfront"
        said = self.refuse(1, "collection", "create", self.city, tiles[0], f"{same}")
        self.assertIn("are one file; name it once", said.err)
        self.assertFalse(self.city.exists())
        said = self.succeed("collection", "create", self.city, tiles[0], *others)
        self.assertIn("are one file by a link (and 2 more such names)", said.err)
        self.assertEqual(len(self.names()), 4)
        self.city.unlink()
        self.collection("create", self.city, *tiles[:2])
        before = self.city.read_bytes()
        said = self.refuse(1, "collection", "add", self.city, same, "--name", "new")
        self.assertIn("already, as the tile 'tile_0'", said.err)
        self.assertEqual(self.city.read_bytes(), before)
        for other in others:
            said = self.succeed("collection", "add", self.city, other, "--name", "new")
            self.assertIn("are one file by a link", said.err)
            self.collection("undo", self.city)
        self.collection("replace", self.city, others[1], "--name", "tile_0")
        self.assertTrue(self.collection("verify", self.city)["ok"])
        self.collection("undo", self.city)
        self.assertEqual(self.collection("list", self.city)["tiles"][-1]["address"],
                         "tiles/tile_0.pfront")

    def test_tiles_without_points_are_left_out(self):
        """As a build takes nothing of inputs without points."""
        one = self.tile(0)
        empty = []
        for number in range(5):
            empty.append(self.folder / "tiles" / f"empty_{number}.las")
            self.succeed("export", one, "-o", self.folder / "empty.las", "--force",
                         "--box", "-9,-9,-9,-8,-8,-8")
            empty[-1] = empty[-1].with_suffix(".pfront")
            self.succeed("build", self.folder / "empty.las", "-o", empty[-1])
        told = self.succeed("collection", "create", self.city, one, empty[0])
        self.assertIn(f"1 of 2 tiles has no points and is left out: '{empty[0]}'.", told.err)
        told = self.succeed("collection", "create", self.city, self.folder / "tiles", "--force")
        self.assertIn("5 of 6 tiles have no points and are left out: ", told.err)
        self.assertIn("empty_0.pfront", told.err)
        self.assertIn("and others.", told.err)
        self.assertEqual(self.names(), ["tile_0"])
        two = self.tile(1)
        told = self.succeed("collection", "add", self.city, empty[1], two)
        self.assertIn("1 of 2 tiles has no points", told.err)
        listed = self.succeed("collection", "list", self.city).out
        self.assertIn("can be undone: add 1 tile\n", listed)
        self.succeed("collection", "undo", self.city)
        self.assertEqual(self.names(), ["tile_0"])
        before = self.city.read_bytes()
        for verb in (("add", self.city, empty[0]),
                     ("replace", self.city, empty[0], "--name", "tile_0"),
                     ("create", self.folder / "none.pfcollection", *empty)):
            self.assertIn("no points", self.refuse(1, "collection", *verb).err)
        self.assertEqual(self.city.read_bytes(), before)
        self.assertFalse((self.folder / "none.pfcollection").exists())

    def test_words_that_cannot_be_meant(self):
        store = self.tile(0)
        for arguments in (("create", self.city), ("list", self.city, store), ("mend", self.city),
                          ("add", self.city, store, "--force"),
                          ("create", self.city, store, "--name", "a"),
                          ("remove", self.city, "tile_0", "--epoch", "2020")):
            self.refuse(2, "collection", *arguments)
        for verb in (("create", store), ("add", store), ("replace", store), ("remove", "tile_0"),
                     ("undo",), ("compact",)):
            said = self.refuse(2, "collection", verb[0], "s3://bucket/a.pfcollection", *verb[1:])
            self.assertIn("is an address", said.err)
        self.refuse(1, "collection", "create", self.folder / "city.pfront", store)
        self.refuse(1, "collection", "add", store, store)
        self.refuse(1, "collection", "list", self.folder / "none.pfcollection")
        self.collection("create", self.city, store)
        self.refuse(1, "collection", "create", self.city, store)
        self.collection("create", self.city, store, "--force")
        self.refuse(1, "build", self.folder / "tiles", "-o", self.city, "--force")

    def test_other_systems_are_refused(self):
        here = self.folder / "here.pfront"
        self.succeed("generate", "--points", 2000, "-o", self.folder / "a.las")
        for name, code in (("here", 25832), ("there", 25833)):
            self.succeed("build", self.folder / "a.las", "-o", self.folder / f"{name}.pfront",
                         "--assume-crs", f"EPSG:{code}")
        said = self.refuse(1, "collection", "create", self.city, here,
                           self.folder / "there.pfront")
        self.assertIn("another coordinate reference system", said.err)
        self.assertFalse(self.city.exists())
        # A tile that goes has no say.
        self.succeed("build", self.folder / "a.las", "-o", self.folder / "silent.pfront")
        self.collection("create", self.city, here, self.folder / "silent.pfront")
        self.refuse(1, "collection", "add", self.city, self.folder / "there.pfront")
        self.collection("replace", self.city, self.folder / "there.pfront", "--name", "here")
        self.refuse(1, "collection", "add", self.city, here)
        self.collection("undo", self.city)


if __name__ == "__main__":
    unittest.main(verbosity=2)
