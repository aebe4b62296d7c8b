"""`build --box`: the points that `export --box` gives, and no more fetched than they need."""

import json
import os
import pathlib
import sys
import unittest

from foreign_trees import write_ept
from tool import ToolTest, pointfront
from virtual_clouds import write_tiles

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "Support"))

# pylint: disable=wrong-import-position
from far_server import FarServer

HERE = "127.0.0.1"
POINTS = 200000
TILES = 4
FAR_AWAY = "0,0,0,1,1,1"


class BuildBox(ToolTest):
    def setUp(self):
        super().setUp()
        self.las = self.folder / "one.las"
        self.succeed("generate", "--points", POINTS, "-o", self.las)
        self.store = self.folder / "one.pfront"
        self.succeed("build", self.las, "-o", self.store, "--node-points", "1024")
        low, high = self.corners(self.store)
        # A twentieth of each side, somewhere in the middle.
        self.box = self.text([a + 0.40 * (b - a) for a, b in zip(low, high)][:2] + [low[2]],
                             [a + 0.45 * (b - a) for a, b in zip(low, high)][:2] + [high[2]])
        self.environment = {name: value for name, value in os.environ.items()
                            if "proxy" not in name.lower()}
        self.environment.update(POINTFRONT_CACHE="off")

    @staticmethod
    def text(low, high):
        return ",".join(map(str, (*low, *high)))

    def corners(self, cloud):
        bounds = self.succeed("info", cloud, "--json").json["bounds"]
        return bounds[:3], bounds[3:]

    def points(self, cloud, *options):
        out = self.folder / "points.csv"
        self.succeed("export", cloud, "-o", out, "--force", *options, environment=self.environment)
        return sorted(out.read_bytes().splitlines())

    def built(self, *inputs, box=None, options=()):
        """The report of a build of the box, and the points that it stored."""
        store = self.folder / "built.pfront"
        report = self.succeed("build", *inputs, "-o", store, "--force", "--json", "--box",
                              box or self.box, *options, environment=self.environment).json
        self.assertEqual(report["points_rejected"], {})
        self.assertEqual(report["points_read"], report["points_stored"])
        return report, self.points(store)

    def test_points_are_those_of_an_export(self):
        copc = self.folder / "one.copc.laz"
        self.succeed("export", self.store, "-o", copc)
        laz = self.folder / "one.laz"
        self.succeed("export", self.store, "-o", laz)
        side = self.folder / "one.pfindex"
        self.succeed("index", self.las, "-o", side)
        expected = self.points(self.store, "--box", self.box)
        self.assertGreater(len(expected), 100)
        for name, cloud in (("store", self.store), ("COPC", copc), ("index", side)):
            with self.subTest(name):
                report, points = self.built(cloud)
                self.assertEqual(points, self.points(cloud, "--box", self.box))
                self.assertEqual(points, expected)
                self.assertLess(report["points_outside"], POINTS / 2)
        for name, cloud in (("LAS", self.las), ("LAZ", laz)):
            with self.subTest(name):
                report, points = self.built(cloud)
                self.assertEqual(points, expected)
                self.assertEqual(report["points_outside"], POINTS - report["points_stored"])
        told = self.succeed("build", self.las, "-o", self.folder / "told.pfront", "--box", self.box)
        self.assertIn(f"outside of the box: {report['points_outside']}", told.out)

    def test_edges_belong_to_the_box(self):
        """Corners are points: as they stand in text, on the grid of the store."""
        columns = [line.split(b",")[:3] for line in self.points(self.store)[1:]]
        corner = [float(value) for value in columns[len(columns) // 2]]
        high = [value + 30 for value in corner]
        box = self.text(corner, high)
        expected = self.points(self.store, "--box", box)
        self.assertGreater(len(expected), 1)
        for cloud in (self.store, self.las):
            self.assertEqual(self.built(cloud, box=box)[1], expected)

    def test_values_of_neighbours_are_made_of_the_box(self):
        """As if the points of the box were all."""
        part = self.folder / "part.las"
        self.succeed("export", self.store, "-o", part, "--box", self.box)
        store = self.folder / "part.pfront"
        options = ("--local-height", "--height-above-ground")
        self.succeed("build", part, "-o", store, *options)
        for cloud in (self.las, self.store):
            self.assertEqual(self.built(cloud, options=options)[1], self.points(store))

    def fetched(self, server, work):
        """The bytes that were asked for while it works."""
        server.requests.clear()
        result = work()
        total = 0
        for seen in server.requests:
            if seen["range"]:
                begin, end = seen["range"].removeprefix("bytes=").split("-")
                total += int(end) + 1 - int(begin) if begin else int(end)  # the last ones
            else:
                total += (self.folder / seen["path"].lstrip("/")).stat().st_size
        return result, total

    def test_far_clouds_are_fetched_in_part(self):
        copc = self.folder / "one.copc.laz"
        self.succeed("export", self.store, "-o", copc)
        with FarServer(self.folder) as server:
            for cloud in (self.store, copc):
                with self.subTest(cloud.name):
                    address = f"http://{HERE}:{server.port}/{cloud.name}"
                    expected, needed = self.fetched(
                        server, lambda a=address: self.points(a, "--box", self.box))
                    (_, points), asked = self.fetched(server, lambda a=address: self.built(a))
                    self.assertEqual(points, expected)
                    # Gaps that are cheaper to load than to ask around count, too.
                    whole = cloud.stat().st_size
                    self.assertLess(needed, 0.6 * whole)
                    self.assertLess(asked, 0.8 * whole)

    def test_far_trees_open_the_files_in_the_box(self):
        ept = write_ept(self.folder / "ept", 6, 2)
        box = "96,96,0,160,160,9"
        with FarServer(self.folder) as server:
            address = f"http://{HERE}:{server.port}/ept/ept.json"
            expected = self.points(address, "--box", box)
            needed = {seen["path"] for seen in server.requests}
            self.assertEqual(expected, self.points(ept, "--box", box))
            server.requests.clear()
            self.assertEqual(self.built(address, box=box)[1], expected)
            self.assertEqual({seen["path"] for seen in server.requests}, needed)
        self.assertEqual(self.built(ept, box=box)[1], expected)

    def test_lists_open_the_tiles_in_the_box(self):
        small = self.folder / "small.las"
        self.succeed("generate", "--points", "2000", "-o", small)
        copc = self.folder / "tile.copc.laz"
        self.succeed("export", self.build(small, name="small.pfront"), "-o", copc)
        tiles = write_tiles(copc, self.folder, TILES)
        items = json.loads(tiles.read_text())["features"]
        low, high = (items[TILES]["properties"]["proj:bbox"][a:a + 3] for a in (0, 3))
        box = self.text(low, [a + 0.5 * (b - a) for a, b in zip(low, high)][:2] + [high[2]])
        expected = self.points(tiles, "--box", box)
        self.assertGreater(len(expected), 100)
        with FarServer(self.folder) as server:
            far = f"http://{HERE}:{server.port}/all.vpc"
            self.assertEqual(self.built(far, box=box)[1], expected)
            asked = {seen["path"] for seen in server.requests}
            self.assertIn("/tile-1-0.copc.laz", asked)
            self.assertLessEqual(len(asked), 6, asked)  # the list, four to know them by, and it
            for one in items:
                name = one["assets"]["data"]["href"].removeprefix("./")
                one["assets"]["data"]["href"] = f"http://{HERE}:{server.port}/{name}"
            near = self.folder / "near.vpc"
            near.write_text(json.dumps({"type": "FeatureCollection", "features": items}))
            server.requests.clear()
            self.assertEqual(self.built(near, box=box)[1], expected)
            self.assertEqual({seen["path"] for seen in server.requests}, {"/tile-1-0.copc.laz"})
            refused = self.refuse(1, "build", near, "-o", self.folder / "no.pfront", "--box",
                                  FAR_AWAY, environment=self.environment)
            self.assertIn("no point of the inputs lies in the box 0,0,0,1,1,1", refused.err)
        self.assertEqual(self.built(tiles, box=box)[1], expected)
        # Inputs that lie elsewhere are no fault.
        files = sorted(self.folder.glob("tile-*.copc.laz"))
        self.assertEqual(self.built(*files, box=box)[1], expected)

    def test_a_box_that_meets_nothing(self):
        for cloud in (self.store, self.las):
            with self.subTest(cloud.name):
                out = self.folder / "no.pfront"
                for more in ((), ("--local-height",)):
                    refused = pointfront("build", cloud, "-o", out, "--box", FAR_AWAY, *more)
                    self.assertEqual(refused.status, 1, refused)
                    self.assertIn("no point of the inputs lies in the box 0,0,0,1,1,1; the inputs "
                                  "lie in ", refused.err)
                    self.assertFalse(out.exists())

    def test_bad_boxes_are_those_of_export(self):
        out = self.folder / "no.pfront"
        for box in ("1,2,3", "5,0,0,1,1,1", "a,b,c,d,e,f", "0,0,0,1,1,nan", ""):
            told = [self.refuse(2, *words, "--box", box).err.split(": ", 1)[1]
                    for words in (("build", self.las, "-o", out),
                                  ("export", self.store, "-o", self.folder / "no.las"))]
            self.assertEqual(*told)
        refused = self.refuse(1, "build", self.las, "-o", self.folder / "tiles", "--tiles", "--box",
                              self.box)
        self.assertIn("--tiles with --box", refused.err)


if __name__ == "__main__":
    unittest.main()
