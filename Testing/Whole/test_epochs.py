"""Epochs of a collection in one picture: a lens that shows another epoch (swipe), and conditions on
the epoch."""

import json
import os
import shutil
import unittest

from pictures import read_png
from scenes import SceneTest
from tool import SLOWNESS, WORK, pointfront

SIZE = (320, 200)
POINTS = 40000 if SLOWNESS == 1 else 8000
BORDER = 24  # pixels beside the lens' edge that light and splats of the other half may reach
YEARS = ("2019", "2024-07")
RGB = {"technique": "points", "color": "rgb", "size": {"mode": "fixed", "px": 2}}
SPLATS = {"technique": "splats",
          "color": {"attribute": "elevation", "map": "viridis", "range": [0, 60]}}
STYLES = (({"default": RGB}, "one"),
          ({"default": SPLATS, "shading": {"mode": "edl"}}, "one"),
          ({"default": SPLATS, "classes": {"2": {"color": "#806040"}, "5": {"visible": False}}},
           "class"))


class Epochs(SceneTest):
    @classmethod
    def setUpClass(cls):
        """Two made-up towns at one place, of two tiles each: with one tree and with trees of
        classes."""
        super().setUpClass()
        cls.places = WORK / "towns-of-epochs"
        cls.places.mkdir(parents=True, exist_ok=True)
        for seed, year in enumerate(YEARS, 3):
            las = cls.places / f"{year}.las"
            cls.run_tool("generate", "--points", POINTS, "--seed", seed, "-o", las, "--force")
            for layers in ("one", "class"):
                store = cls.places / f"{layers}-{year}.pfront"
                cls.run_tool("build", las, "-o", store, "--force", "--layers",
                             "none" if layers == "one" else "class", "--normals", "pca")
                city = cls.places / f"{layers}.pfcollection"
                verb = ("create", "--force") if year == YEARS[0] else ("add",)
                cls.run_tool("collection", verb[0], city, store, "--epoch", year, *verb[1:])

    @staticmethod
    def run_tool(*arguments):
        done = pointfront(*arguments)
        if done.status != 0:
            raise AssertionError((arguments, done))

    def drawn(self, cloud, sheet, *options, size=SIZE):
        style = self.folder / "style.json"
        style.write_text(json.dumps(sheet))
        path = self.folder / "picture.png"
        self.succeed("render", cloud, "-o", path, "--style", style, "--size",
                     f"{size[0]}x{size[1]}", *options)
        return read_png(path)

    def camera(self, away):
        """Above the middle, a share of the city's width away."""
        bounds = self.succeed("info", self.places / "one.pfcollection", "--json").json["bounds"]
        low, high = bounds[:3], bounds[3:]
        middle = [(a + b) / 2 for a, b in zip(low, high)]
        by = away * (high[1] - low[1])
        path = self.folder / "camera.json"
        path.write_text(json.dumps({
            "position": [middle[0], middle[1] - 0.5 * by, high[2] + by], "focal_point": middle,
            "view_up": [0, 1, 0], "view_angle": 45}))
        return path

    @staticmethod
    def swipe(sheet, left=YEARS[0], right=YEARS[1], size=SIZE):
        """The sheet with one epoch in the left half of the picture, another in the right."""
        return {**sheet, "default": {**sheet["default"], "epoch": right}, "lenses": [{
            "shape": "rectangle", "center_px": [size[0] / 4, size[1] / 2],
            "size_px": [size[0] / 2, size[1]], "inside": {"default": {"epoch": left}}}]}

    def expect_halves(self, swiped, left, right):
        middle = swiped.shape[1] // 2
        border = min(BORDER, middle // 4)
        for half, whole, other in ((slice(0, middle - border), left, right),
                                   (slice(middle + border, None), right, left)):
            self.assertEqual((swiped[:, half] != whole[:, half]).any(axis=2).sum(), 0)
            self.assertGreater((swiped[:, half] != other[:, half]).any(axis=2).mean(), 0.02)

    def test_a_lens_shows_another_epoch(self):
        """Each half is the picture of its epoch, pixel for pixel."""
        for number, (sheet, layers) in enumerate(STYLES):
            city = self.places / f"{layers}.pfcollection"
            for away in (0.3, 1.2):
                with self.subTest(style=number, away=away):
                    camera = ("--camera", self.camera(away))
                    alone = [self.drawn(city, sheet, "--epoch", year, *camera) for year in YEARS]
                    self.expect_halves(self.drawn(city, self.swipe(sheet), *camera), *alone)

    def test_far_views_of_both_read_no_tile(self):
        city = self.places / "one.pfcollection"
        small = (48, 32)
        camera = ("--camera", self.camera(2.5))
        stores = [self.places / f"one-{year}.pfront" for year in YEARS]
        for store in stores:
            os.rename(store, store.with_suffix(".away"))
        try:
            # Not by --epoch: how many points of a node suffice depends on the bounds of the cloud.
            alone = [self.drawn(city, {"default": {**RGB, "epoch": year}}, *camera, size=small)
                     for year in YEARS]
            self.expect_halves(
                self.drawn(city, self.swipe(STYLES[0][0], size=small), *camera, size=small),
                *alone)
        finally:
            for store in stores:
                os.rename(store.with_suffix(".away"), store)

    def test_conditions_and_colours_know_the_epoch(self):
        """The epoch is an attribute that nobody gets who does not name it."""
        city = self.places / "one.pfcollection"
        camera = ("--camera", self.camera(1.2))
        for year, condition in zip(YEARS, ("epoch == 2019", "epoch > 2019")):
            alone, named = (self.drawn(city, STYLES[0][0], *camera, *words)
                            for words in (("--epoch", year), ("--where", condition)))
            self.assertTrue((named == alone).all())
            for name, words in (("where", ("--where", condition)), ("epoch", ("--epoch", year))):
                self.succeed("export", city, "-o", self.folder / f"{name}.xyz", "--force", *words)
            texts = [sorted((self.folder / f"{name}.xyz").read_text().splitlines())
                     for name in ("where", "epoch")]
            self.assertEqual(*texts)
        coloured = self.drawn(city, {"default": {**RGB, "color": {
            "attribute": "epoch", "map": ["#ff0000", "#0000ff"], "range": [2019, 2024.5]}}},
                              *camera)
        shown = {tuple(pixel) for pixel in coloured.reshape(-1, 3).tolist()}
        self.assertLessEqual({(255, 0, 0), (0, 0, 255)}, shown)

    def test_a_store_is_built_of_one_epoch(self):
        """The same one twice is read once."""
        city = self.places / "one.pfcollection"
        roundabout = self.places / ".." / self.places.name / city.name
        for epoch in YEARS:
            store = self.folder / "built.pfront"
            told = self.succeed("build", f"{city}#epoch={epoch}", f"{roundabout}#epoch={epoch}",
                                "-o", store, "--force")
            self.assertIn("read once", told.err)
            self.assertEqual(self.succeed("info", store, "--json").json["points"], POINTS)
        for words, why in ((f"{city}#epoch=1999", "it has: 2019, 2024-07"),
                           (f"{store}#epoch=2019", "is no collection"),
                           (f"{city}s#epoch=2019", "no such file or folder"),
                           (f"{self.places}#epoch=2019", "no such file or folder")):
            self.assertIn(why, self.refuse(1, "build", words, "-o", self.folder / "no.pfront").err)
        self.assertFalse((self.folder / "no.pfront").exists())

    def test_lists_and_checks_are_of_the_epoch(self):
        city = self.folder / "city.pfcollection"
        for verb, year in (("create", YEARS[0]), ("add", YEARS[1])):
            shutil.copy(self.places / f"one-{year}.pfront", self.folder)
            store = self.folder / f"one-{year}.pfront"
            self.succeed("collection", verb, city, store, "--epoch", year)
        named = f"{city}#epoch={YEARS[1]}"
        listed = self.succeed("collection", "list", named, "--json").json
        self.assertEqual([tile["epoch"] for tile in listed["tiles"]], [YEARS[1]])
        self.assertEqual(listed["points"], POINTS)
        self.assertTrue(self.succeed("verify", named).out.endswith("all sound\n"))
        self.assertIn(f" {POINTS} points checked", self.succeed("verify", named).out)
        (self.folder / f"one-{YEARS[0]}.pfront").unlink()
        for command in (("verify",), ("collection", "verify")):
            self.succeed(*command, named)
            self.refuse(1, *command, city)
        said = self.refuse(1, "collection", "add", city, store, "--epoch", f"{YEARS[1]} ")
        self.assertIn("begins or ends with a blank", said.err)

    def test_an_epoch_is_named_once(self):
        city = self.places / "one.pfcollection"
        named = f"{city}#epoch={YEARS[0]}"
        for words in (("render", named, "--epoch", YEARS[1], "-o", self.folder / "a.png"),
                      ("export", named, "--epoch", YEARS[1], "-o", self.folder / "a.las"),
                      ("info", named, "--epoch", YEARS[0])):
            self.assertIn(f"{city}': its epoch is named twice, '{YEARS[0]}' and '",
                          self.refuse(1, *words).err)
        self.assertEqual(self.entries(), [])

    def test_names_of_files_may_look_like_epochs(self):
        """A file that is there goes by its whole name."""
        folder = self.folder / "a#epoch=2"
        folder.mkdir()
        for name in (folder / "e.pfcollection", self.folder / "h#epoch=1.pfcollection"):
            stores = [self.places / f"one-{year}.pfront" for year in YEARS]
            self.succeed("collection", "create", name, stores[0], "--epoch", YEARS[0])
            self.succeed("collection", "add", name, stores[1], "--epoch", YEARS[1])
            for words, points in (((name,), 2 * POINTS), ((name, "--epoch", YEARS[0]), POINTS),
                                  ((f"{name}#epoch={YEARS[0]}",), POINTS)):
                self.assertEqual(self.succeed("info", *words, "--json").json["points"], points)
                self.succeed("render", *words, "-o", self.folder / "a.png", "--size", "32x24")
            self.assertIn("it has: 2019, 2024-07", self.refuse(1, "info", name, "--epoch", "1").err)
            self.succeed("build", name, "-o", self.folder / "b.pfront", "--force")
        self.succeed("build", folder / "e.pfcollection", "-o", folder / "b.pfront")
        self.assertEqual(self.succeed("info", folder / "b.pfront", "--json").json["points"],
                         2 * POINTS)

    def test_epochs_that_are_not_there_are_refused(self):
        style = self.folder / "style.json"
        style.write_text(json.dumps(self.swipe(STYLES[0][0], left="2024-7")))
        city = self.places / "one.pfcollection"
        into = ("-o", self.folder / "none.png", "--style", style)
        told = self.refuse(1, "render", city, *into).err
        self.assertIn("lenses[0].inside: default.epoch: ", told)
        self.assertIn("has no epoch '2024-7'; it has: 2019, 2024-07; did you mean '2024-07'?", told)
        told = self.refuse(1, "render", self.places / "one-2019.pfront", *into).err
        self.assertIn("default.epoch: ", told)
        self.assertIn("has no epochs", told)
        style.write_text(json.dumps(self.swipe(STYLES[0][0])))
        told = self.refuse(1, "render", city, "--epoch", YEARS[1], *into).err
        self.assertIn("shows one epoch alone: leave that out to see '2019', too", told)
        self.assertEqual(self.entries(), ["style.json"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
