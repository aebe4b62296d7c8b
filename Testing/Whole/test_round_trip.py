"""10,653,336 points into a store and out again: the same multiset, integer for integer; in 256 MiB
as well, to the same bytes."""

import filecmp
import os
import unittest

from tool import DATA, ToolTest, run

AUTZEN = DATA / "large/autzen_10653336_rgb_intensity.laz"
POINTS = 10653336
MIB = 1 << 20


class Autzen(ToolTest):
    def test_nothing_is_lost_in_memory_or_spilled(self):
        store = self.folder / "autzen.pfront"
        report = self.succeed("build", AUTZEN, "-o", store, "--json").json
        self.assertEqual(report["points_read"], POINTS)
        self.assertEqual(report["points_stored"], POINTS)
        self.assertEqual(report["points_rejected"], {})
        self.assertEqual(report["spilled_bytes"], 0)

        verified = self.succeed("verify", store, "--json").json
        self.assertEqual(verified["points_checked"], POINTS)

        out = self.folder / "out.las"
        self.succeed("export", store, "-o", out)
        compared = run(os.environ["POINTFRONT_COMPARE_POINTS"], AUTZEN, out, "intensity", "rgb")
        self.assertEqual(compared.status, 0, compared)
        self.assertEqual(int(compared.out), POINTS)
        out.unlink()

        small = self.folder / "small.pfront"
        report = self.succeed(
            "build", AUTZEN, "-o", small, "--memory", "128M", "--threads", "2", "--json").json
        self.assertLess(report["peak_rss_bytes"], (128 + 128) * MIB)
        self.assertGreater(report["spilled_bytes"], 0)
        self.assertTrue(filecmp.cmp(store, small, shallow=False), "the stores differ")
        self.assertEqual(self.entries(), ["autzen.pfront", "small.pfront"])

        # A store's points, in the order of its tree: they touch many of a kd-tree's small cells.
        report = self.succeed("build", store, "-o", self.folder / "kd.pfront", "--structure",
                              "kdtree", "--memory", "64M", "--threads", "2", "--json").json
        self.assertLess(report["peak_rss_bytes"], (64 + 64) * MIB)
        self.assertEqual(report["points_stored"], POINTS)


class Exports(ToolTest):
    def compare(self, a, b, *attributes):
        compared = run(os.environ["POINTFRONT_COMPARE_POINTS"], a, b, *attributes)
        self.assertEqual(compared.status, 0, compared)
        return int(compared.out)

    def test_las_and_laz_keep_every_field(self):
        for name, attributes in (
            ("las/real/autzen_trim.las", ("intensity", "classification", "rgb", "gps_time")),
            ("classified/lidarhd_rgb_nir_698k.laz",
             ("intensity", "classification", "rgb", "nir", "gps_time")),
            ("laz/extrabytes.laz", ("intensity", "rgb", "gps_time")),
            ("las/version_x_format/las1.4_pf10_1024pts_random.las",
             ("intensity", "classification", "rgb", "nir", "gps_time")),
        ):
            with self.subTest(file=name):
                store = self.folder / "x.pfront"
                points = self.succeed(
                    "build", DATA / name, "-o", store, "--force", "--json").json["points_stored"]
                for kind in ("las", "laz"):
                    out = self.folder / f"out.{kind}"
                    self.succeed("export", store, "-o", out, "--force")
                    self.assertEqual(self.compare(DATA / name, out, *attributes), points)

    def test_text_has_every_point(self):
        store = self.build(DATA / "las/real/1.2-with-color.las")
        out = self.folder / "out.xyz"
        self.succeed("export", store, "-o", out)
        lines = out.read_text().splitlines()
        self.assertTrue(lines[0].startswith("# x y z"), lines[0])
        self.assertEqual(len(lines), 1066)

    def test_filters(self):
        store = self.build(DATA / "las/real/autzen_trim.las")
        info = self.succeed("info", store, "--json").json
        low, high = info["bounds"][:3], info["bounds"][3:]
        middle = (low[0] + high[0]) / 2

        def count(*filters):
            out = self.folder / "out.xyz"
            self.succeed("export", store, "-o", out, "--force", *filters)
            rows = [line.split() for line in out.read_text().splitlines()[1:]]
            return len(rows), rows

        def box(x0, x1):
            return ",".join(map(repr, (x0, low[1], low[2], x1, high[1], high[2])))

        west, rows = count("--box", box(low[0], middle))
        self.assertTrue(all(float(row[0]) <= middle for row in rows))
        east, _ = count("--box", box(middle + 0.005, high[0]))
        self.assertEqual(west + east, 110000)
        self.assertEqual(count("--classes", "1")[0], 83893)
        self.assertEqual(count("--classes", "2")[0], 26107)
        thin, _ = count("--spacing", "4") # feet
        thinner, _ = count("--spacing", "12")
        self.assertTrue(0 < thinner < thin < 110000, (thinner, thin))


if __name__ == "__main__":
    unittest.main(verbosity=2)
