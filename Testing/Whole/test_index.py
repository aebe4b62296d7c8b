"""A LAS file drawn in place: indexed, described, checked, brought out again, in bounded memory."""

import os
import shutil
import unittest

from tool import DATA, ToolTest, run

TRIM = DATA / "las/real/autzen_trim.las"
LAZ = DATA / "laz/extrabytes.laz"
MIB = 1 << 20
# The checker's own memory would hide what the tool takes under a sanitizer.
PLAIN = float(os.environ.get("POINTFRONT_SLOWNESS", "1")) == 1


class Index(ToolTest):
    def copy(self):
        las = self.folder / "points.las"
        shutil.copyfile(TRIM, las)
        return las

    def test_report_and_default_name(self):
        las = self.copy()
        report = self.succeed("index", las, "--json").json
        side = self.folder / "points.las.pfindex"
        self.assertEqual(self.entries(), ["points.las", "points.las.pfindex"])
        self.assertEqual(set(report), {
            "points_read", "points_indexed", "nodes", "runs", "seconds", "points_per_second",
            "peak_rss_bytes", "bytes_written", "spilled_bytes"})
        self.assertEqual(report["points_indexed"], 110000)
        self.assertEqual(report["bytes_written"], side.stat().st_size)
        self.assertLess(report["bytes_written"], 110000)
        self.assertEqual(las.read_bytes(), TRIM.read_bytes())

        info = self.succeed("info", side, "--json").json
        self.assertEqual(info["structure"], "inplace")
        self.assertEqual(info["refinement"], "add")
        self.assertEqual(info["points"], 110000)
        self.assertEqual(info["nodes"], report["nodes"])
        verified = self.succeed("verify", side, "--json").json
        self.assertTrue(verified["ok"])
        self.assertEqual(verified["points_checked"], 110000)

    def test_export_gives_every_point_and_takes_filters(self):
        las = self.copy()
        self.succeed("index", las)
        side = self.folder / "points.las.pfindex"
        out = self.folder / "out.las"
        self.succeed("export", side, "-o", out)
        compared = run(os.environ["POINTFRONT_COMPARE_POINTS"], las, out, "intensity",
                       "classification", "rgb", "gps_time")
        self.assertEqual(compared.status, 0, compared)
        self.assertEqual(int(compared.out), 110000)
        text = self.folder / "out.xyz"
        self.succeed("export", side, "-o", text, "--classes", "2")
        self.assertEqual(len(text.read_text().splitlines()), 26107 + 1)

    def test_an_index_is_replaced_and_nothing_else(self):
        las = self.copy()
        self.succeed("index", las)
        self.succeed("index", las, "--force")
        other = self.folder / "notes.txt"
        other.write_text("mine")
        self.refuse(1, "index", las, "-o", other)
        self.refuse(1, "index", las, "-o", las)
        self.assertEqual(other.read_text(), "mine")
        self.assertEqual(las.read_bytes(), TRIM.read_bytes())

    def test_refusals(self):
        self.refuse(2, "index")
        self.refuse(2, "index", TRIM, "--node-points", "1")
        self.assertIn("build", self.refuse(
            1, "index", LAZ, "-o", self.folder / "x.pfindex").err)
        las = self.copy()
        self.succeed("index", las)
        side = self.folder / "points.las.pfindex"
        with open(las, "ab") as file:
            file.write(b"more")
        self.assertIn("size in bytes", self.refuse(1, "info", side).err)
        las.unlink()
        self.assertIn("not there", self.refuse(1, "info", side).err)
        self.refuse(1, "verify", las)

    def test_memory_does_not_grow_with_the_file(self):
        las = self.folder / "large.las"
        self.succeed("generate", "--points", "4000000", "-o", las)
        self.assertGreater(las.stat().st_size, 100 * MIB)
        report = self.succeed(
            "index", las, "--memory", "8M", "--threads", "2", "--json").json
        self.assertEqual(report["points_indexed"], 4000000)
        if PLAIN:
            self.assertLess(report["peak_rss_bytes"], 64 * MIB)
        side = self.folder / "large.las.pfindex"
        self.assertEqual(self.succeed("verify", side, "--json").json["points_checked"], 4000000)


if __name__ == "__main__":
    unittest.main(verbosity=2)
