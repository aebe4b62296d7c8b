"""Names that stand in fetched files: lists, virtual clouds and collections behind addresses."""

import os
import pathlib
import shutil
import sys
import unittest
import urllib.parse

from tool import ToolTest, pointfront
from virtual_clouds import Tile, item, write_list

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "Support"))

# pylint: disable=wrong-import-position
from far_server import FarServer
from signature_v4 import KEY, KEY_ID

HERE = "127.0.0.1"
NAMES = ("plain", "with blank", "ha#sh", "que?ry", "per%20cent", "100%", "\u00fcml\u00e4ut",
         "a+b&c=d'e,f;g", "brackets[1]", "quote\"<>\\^`{|}", "co:lon@at")
# Settings that nobody but the user may choose.
SETTINGS = ("cache={folder}", "offline=1", "timeout=1", "cache_size=1G")


class FarNames(ToolTest):
    def setUp(self):
        super().setUp()
        self.succeed("generate", "--points", "500", "-o", self.folder / "one.las")
        store = self.build(self.folder / "one.las")
        self.tiles = self.folder / "site" / "tiles"
        self.tiles.mkdir(parents=True)
        self.copc = self.tiles / "plain.copc.laz"
        self.succeed("export", store, "-o", self.copc)
        self.server = FarServer(self.folder)
        self.server.__enter__()
        self.addCleanup(self.server.__exit__)
        self.origin = f"http://{HERE}:{self.server.port}"
        self.site = f"{self.origin}/site"
        self.environment = {name: value for name, value in os.environ.items()
                            if "proxy" not in name.lower()}
        self.environment.update(POINTFRONT_CACHE="off")
        self.expected = self.points(self.copc)
        self.elsewhere = self.folder / "elsewhere"

    def points(self, cloud, **more):
        out = self.folder / "points.csv"
        self.succeed("export", cloud, "-o", out, "--force",
                     environment={**self.environment, **more})
        return sorted(out.read_text().splitlines())

    def test_words_for_requests_without_signature(self):
        """`cluster build` and the tool take the same ones."""
        keys = {"AWS_ACCESS_KEY_ID": KEY_ID, "AWS_SECRET_ACCESS_KEY": KEY,
                "AWS_REGION": "eu-central-1", "AWS_ENDPOINT_URL": self.origin}
        for words, status in ((("no", "false", "0", "False", "NO", ""), 0),
                              (("yes", "true", "1", "True", "YES"), 1)):
            for word in words:
                self.server.requests.clear()
                told = pointfront("info", "s3://~s3/site/tiles/plain.copc.laz", environment={
                    **self.environment, **keys, "AWS_NO_SIGN_REQUEST": word})
                self.assertEqual(told.status, status, (word, told))
                signed = [seen for seen in self.server.requests if seen["authorization"]]
                self.assertEqual(bool(signed), status == 0, word)

    def write(self, kind, name):
        """A list of that kind on the site that names one file. The list's name."""
        path = self.folder / "site" / f"list.{kind}"
        if kind == "pfronts":
            path.write_text(f"{name}\n")
        else:
            tile = Tile(self.copc)
            items = [item(name, [*tile.low, *tile.high], tile.points)]
            if kind == "json":  # its files are opened at once
                del items[0]["properties"]["pc:count"]
            write_list(path, items)
        return path.name

    def collect(self, name):
        """A collection of a file of that name in its folder, which goes to the site."""
        path = self.folder / "site" / "list.pfcollection"
        self.succeed("collection", "create", path, self.folder / "site" / name, "--force",
                     environment=self.environment)
        return path.name

    def test_every_name_of_a_file_can_be_asked_for(self):
        for name in NAMES:
            path = f"tiles/{name}.copc.laz"
            shutil.copyfile(self.copc, self.folder / "site" / path) if name != "plain" else None
            quoted = urllib.parse.quote(path)
            for made in (self.collect(path), self.write("pfronts", path),
                         self.write("pfronts", f"./tiles/../{path}"),
                         self.write("vpc", f"./{quoted}"), self.write("json", quoted)):
                with self.subTest(name, made=made):
                    self.assertEqual(self.points(self.folder / "site" / made), self.expected)
                    self.assertEqual(self.points(f"{self.site}/{made}"), self.expected)
                    self.assertEqual(self.points(f"{self.site}/{made}?sig=1"), self.expected)
        asked = {seen["path"].partition("?")[0] for seen in self.server.requests}
        self.assertIn("/site/tiles/with%20blank.copc.laz", asked)
        self.assertFalse([path for path in asked if ".." in path])

    def test_a_reference_is_one_of_a_browser(self):
        """An href with a blank or an umlaut as it is, and those from the root of the server."""
        shutil.copyfile(self.copc, self.tiles / "\u00fc and.copc.laz")
        for href in ("tiles/\u00fc and.copc.laz", "/site/tiles/%C3%BC%20and.copc.laz",
                     f"//{HERE}:{self.server.port}/site/tiles/plain.copc.laz",
                     "tiles/plain.copc.laz?version=2", "tiles/plain.copc.laz#part"):
            with self.subTest(href):
                self.assertEqual(self.points(f"{self.site}/{self.write('vpc', href)}"),
                                 self.expected)
        # On a disk the name as it is written comes first.
        shutil.copyfile(self.copc, self.tiles / "a%20b.copc.laz")
        (self.tiles / "a b.copc.laz").write_text("no cloud")
        made = self.folder / "site" / self.write("vpc", "tiles/a%20b.copc.laz")
        self.assertEqual(self.points(made), self.expected)
        gone = self.folder / "site" / self.write("vpc", "tiles/no%20ne.copc.laz")
        self.assertIn("no%20ne", self.refuse(1, "info", gone, "--together").err)

    def assert_refused(self, made, *words):
        out = self.folder / "none.csv"
        for address in (f"{self.site}/{made}", f"{self.site}/{made}?sig=VERY-SECRET"):
            said = self.refuse(1, "export", address, "-o", out,
                               environment={**self.environment, "POINTFRONT_CACHE":
                                            str(self.folder / "cache")}).err
            for word in words:
                self.assertIn(word, said)
            self.assertNotIn("VERY-SECRET", said)
            self.assertFalse(out.exists())

    def test_settings_are_those_of_the_user_alone(self):
        """A list behind an address could make folders on the reader's machine, and take them from
        other users."""
        self.elsewhere.mkdir(0o755)
        self.elsewhere.chmod(0o755)
        (self.elsewhere / "mine.txt").write_text("mine")
        for setting in SETTINGS:
            for folder in (self.elsewhere, self.folder / "new"):
                text = "#far:" + setting.format(folder=folder)
                for name in (f"tiles/plain.copc.laz{text}", f"{self.site}/{self.quoted()}{text}",
                             f"tiles/plain.copc.laz#epoch=1{text}",
                             f"//{HERE}:{self.server.port}/site/{self.quoted()}{text}",
                             f"/vsicurl/{self.site}/{self.quoted()}{text}"):
                    for kind in ("pfronts", "vpc", "json"):
                        if kind == "pfronts" and name.startswith("/"):
                            continue
                        with self.subTest(name, kind=kind):
                            self.assert_refused(self.write(kind, name), "settings", "list." + kind)
        self.assertEqual([file.name for file in self.elsewhere.iterdir()], ["mine.txt"])
        self.assertEqual(self.elsewhere.stat().st_mode & 0o777, 0o755)
        self.assertFalse((self.folder / "new").exists())

    @staticmethod
    def quoted():
        return "tiles/plain.copc.laz"

    def test_a_tile_named_like_settings_sets_nothing(self):
        quoted = urllib.parse.quote(str(self.folder / "new"), safe="")
        name = f"plain.copc.laz#far:cache={quoted}"
        shutil.copyfile(self.copc, self.folder / "site" / name)
        shutil.copyfile(self.copc, self.folder / "site" / "plain.copc.laz")
        made = self.collect(name)
        self.assertEqual(self.points(self.folder / "site" / made), self.expected)
        self.assert_refused(made, "settings")
        self.assertFalse((self.folder / "new").exists())

    def test_a_list_here_may_have_settings(self):
        """The user has made it, as the address on a command line."""
        cache = self.folder / "new"
        lines = self.folder / "here.pfronts"
        lines.write_text(f"{self.site}/{self.quoted()}#far:cache={cache}\n")
        self.assertEqual(self.points(lines), self.expected)
        self.assertTrue(any(cache.glob("segments/*/*")))

    def test_a_list_behind_an_address_names_addresses_alone(self):
        for kind, name in (("pfronts", str(self.copc)), ("pfronts", "/site/tiles/plain.copc.laz"),
                           ("pfronts", f"file://{self.copc}"), ("vpc", f"file://{self.copc}"),
                           ("json", f"file://{self.copc}")):
            with self.subTest(kind, name=name):
                self.assert_refused(self.write(kind, name), "addresses", name.split("//")[-1])

    def test_an_epoch_is_one_of_a_collection(self):
        """A file on a disk was refused, and one behind an address gave all its points."""
        for made in ("tiles/plain.copc.laz", self.write("pfronts", "tiles/plain.copc.laz"),
                     self.write("vpc", "tiles/plain.copc.laz")):
            for place in (self.site, self.folder / "site"):
                with self.subTest(made, place=place):
                    told = self.refuse(1, "export", f"{place}/{made}", "--epoch", "2024", "-o",
                                       self.folder / "none.csv", environment=self.environment)
                    self.assertIn("is no collection", told.err)

    def test_the_mode_of_a_folder_that_was_there_stays(self):
        """The cache may lie in a folder that others use; what it makes there is for its user."""
        shared = self.folder / "shared"
        shared.mkdir()
        shared.chmod(0o755)
        address = f"{self.site}/{self.quoted()}"
        for cloud, more in ((address, {"POINTFRONT_CACHE": str(shared)}),
                            (f"{address}#far:cache={shared}", {})):
            self.points(cloud, **more)
            self.assertEqual(shared.stat().st_mode & 0o777, 0o755)
            self.assertEqual(sorted(made.name for made in shared.iterdir()),
                             ["places", "segments"])
            for made in shared.iterdir():
                self.assertEqual(made.stat().st_mode & 0o777, 0o700)
                shutil.rmtree(made)
        fresh = self.folder / "below" / "fresh"
        self.points(address, POINTFRONT_CACHE=str(fresh))
        self.assertEqual(fresh.stat().st_mode & 0o777, 0o700)


if __name__ == "__main__":
    unittest.main()
