"""Coordinate reference systems and georeferenced images, through the tool."""

import csv
import unittest

from tool import DATA, ToolTest, pointfront

ORTHO = DATA / "ortho"
CLOUD = ORTHO / "autzen/autzen-point-format-3.las"


class Georeference(ToolTest):
    def built(self, *arguments):
        store = self.folder / "a.pfront"
        outcome = pointfront("build", *arguments, "-o", store, "--force", "--progress", "none")
        self.assertEqual(outcome.status, 0, outcome)
        return store, outcome

    def rows(self, store):
        """The points of a store, as dictionaries of numbers."""
        out = self.folder / "a.xyz"
        outcome = pointfront("export", store, "-o", out, "--force")
        self.assertEqual(outcome.status, 0, outcome)
        with open(out, encoding="ascii") as file:
            names = file.readline().lstrip("# ").split()
            return [dict(zip(names, map(float, line.split()))) for line in file]

    def test_colours_are_those_published(self):
        store, outcome = self.built(CLOUD, "--color-from", ORTHO / "autzen/autzen.jpg")
        self.assertIn("1 of 106 points", outcome.err)
        with open(ORTHO / "autzen/expected_nearest_rgb.csv", encoding="ascii") as file:
            expected = sorted(
                (int(row["r"]), int(row["g"]), int(row["b"])) if row["inside"] == "1" else (0,) * 3
                for row in csv.DictReader(file)
            )
        found = sorted((r["red"], r["green"], r["blue"]) for r in self.rows(store))
        self.assertEqual(found, expected)

    def test_several_images_and_values(self):
        tiles = ORTHO / "mosaic_2x2"
        store, outcome = self.built(
            CLOUD, "--color-from", ORTHO / "autzen", "--attribute-from", f"map={tiles}/rgb?.tif")
        self.assertIn("106 of 106 points lie where no image has data for map", outcome.err)
        attributes = {a["name"]: a for a in pointfront("info", store, "--json").json["attributes"]}
        self.assertEqual(attributes["map"]["components"], 3)
        self.assertEqual(attributes["rgb"]["type"], "uint8", "the colours have 8 bits")

    def test_what_is_no_image_fails_and_leaves_nothing(self):
        for option in (
            ("--color-from", CLOUD), ("--color-from", self.folder / "none.tif"),
            ("--attribute-from", ORTHO / "autzen/autzen.jpg"),
            ("--attribute-from", f"rgb={ORTHO / 'autzen/autzen.jpg'}"),
        ):
            self.refuse(1, "build", CLOUD, "-o", self.folder / "b.pfront", *option)
        self.assertEqual(self.entries(), [])

    def test_an_image_behind_an_address_is_refused_without_its_secrets(self):
        host = "http:" + "//me:SECRET@example.org"
        address = f"{host}/a.tif?sig=SECRET"
        out = self.folder / "b.pfront"
        for option in (
            ("--color-from", address), ("--attribute-from", f"h={address}"),
            ("--attribute-from", address), ("--attribute-from", f"={address}"),
            ("--attribute-from", f"h={host}"),
            ("--attribute-from", f"h={ORTHO / 'autzen/autzen.jpg'}", address),
        ):
            for more in ((), ("--tiles", "--tile", "400")):
                said = self.refuse(1, "build", CLOUD, "-o", out, *option, *more).err
                self.assertIn("images are read from files only", said)
                self.assertNotIn("SECRET", said)
        self.assertEqual(self.entries(), [])

    def test_one_system_for_all_inputs(self):
        degrees = DATA / "las/real/autzen-dd.las"
        metres = DATA / "las/real/autzen-utm.las"
        store, _ = self.built(degrees, metres, "--crs", "EPSG:26910")
        info = pointfront("info", store, "--json").json
        self.assertIn("UTM zone 10N", info["crs"])
        self.assertEqual(info["points"], 2130)
        self.assertGreater(info["bounds"][0], 493000)
        self.assertLess(info["bounds"][3], 496000)

    def test_keys_of_a_las_file_are_shown_as_wkt(self):
        store, outcome = self.built(DATA / "las/real/epsg_4326.las")
        self.assertTrue(pointfront("info", store, "--json").json["crs"].startswith("GEOGCS"))
        self.assertIn("--crs utm", outcome.err)

    def test_a_system_that_is_not_known_is_not_guessed(self):
        bare = DATA / "las/real/extrabytes.las"
        outcome = self.refuse(
            1, "build", bare, "-o", self.folder / "b.pfront", "--crs", "EPSG:26910")
        self.assertIn("--assume-crs", outcome.err)
        store, _ = self.built(bare, "--assume-crs", "EPSG:2994", "--crs", "EPSG:26910")
        self.assertGreater(pointfront("info", store, "--json").json["bounds"][0], 490000)


if __name__ == "__main__":
    unittest.main(verbosity=2)
