"""A LAS file drawn in place: indexed, described, checked, brought out again, in bounded memory."""

import json
import os
import shutil
import subprocess
import unittest

from tool import DATA, TOOL, ToolTest, run

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

    def test_an_index_names_its_file_by_its_path_relative_to_itself(self):
        for number, arguments in enumerate((
                ("points.las",), ("./points.las",), ("points.las", "-o", "other.pfindex"),
                ("points.las", "-o", "sides/points.pfindex"))):
            folder = self.folder / f"before{number}"
            (folder / "sides").mkdir(parents=True)
            shutil.copyfile(TRIM, folder / "points.las")
            subprocess.run([TOOL, "index", *arguments], cwd=folder, check=True,
                           capture_output=True)
            moved = self.folder / f"after{number}"
            folder.rename(moved)
            side, = moved.rglob("*.pfindex")
            self.assertEqual(self.succeed("info", side, "--json").json["points"], 110000)

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

    def test_normals_are_stored_or_computed_and_info_says_which(self):
        las = self.copy()
        side = self.folder / "points.las.pfindex"
        stats = self.folder / "stats.json"
        pictures = {}
        for choice, source, of in (("none", "computed while nodes load", "16 nearest points"),
                                   ("scanline", "stored", "scan-line"),
                                   ("pca", "stored", "whole file")):
            self.succeed("index", las, "--force", "--normals", choice)
            normals = self.succeed("info", side, "--json").json["normals"]
            self.assertEqual(normals["source"], source)
            self.assertIn(of, normals["of"])
            self.assertIn(of, self.succeed("info", side).out)
            self.assertTrue(self.succeed("verify", side, "--json").json["ok"])
            pictures[choice] = self.folder / f"{choice}.png"
            self.succeed("render", side, "-o", pictures[choice], "--technique", "ewa", "--lit",
                         "--stats", stats, "--color-by", "intensity", "--backend", "software")
            read = json.loads(stats.read_text())["attributes_read"]
            self.assertEqual(sorted(read), ["intensity", "normal"])
        for choice in ("none", "scanline"):
            alike = self.succeed("compare", pictures[choice], pictures["pca"], "--json").json
            self.assertGreater(alike["psnr"], 15.0, choice)
        self.assertEqual(las.read_bytes(), TRIM.read_bytes())

    def test_normals_are_computed_only_where_they_are_needed(self):
        las = self.copy()
        self.succeed("index", las)
        side = self.folder / "points.las.pfindex"
        stats = self.folder / "stats.json"

        def read(*options):
            self.succeed("render", side, "-o", self.folder / "a.png", "--stats", stats,
                         "--color-by", "intensity", "--backend", "software", *options)
            return "normal" in json.loads(stats.read_text())["attributes_read"]

        for options, needed in (
                ((), False), (("--technique", "splats"), False), (("--technique", "ewa"), True),
                (("--technique", "spheres", "--lit"), False), (("--lit",), True),
                (("--technique", "splats", "--orientation", "normal"), True),
                (("--technique", "ewa", "--orientation", "view"), False),
                (("--where", "normal.z > 0.9"), True)):
            self.assertEqual(read(*options), needed, options)
        everything, level = self.folder / "all.csv", self.folder / "level.csv"
        self.succeed("export", side, "-o", everything)
        self.assertNotIn("normal", everything.read_text().splitlines()[0])
        self.succeed("export", side, "-o", level, "--where", "normal.z > 0.9")
        lines = [len(file.read_text().splitlines()) for file in (everything, level)]
        self.assertGreater(lines[0], lines[1])
        self.assertGreater(lines[1], lines[0] / 2)
        self.refuse(2, "index", las, "--force", "--normals-k", "8")
        self.refuse(2, "index", las, "--force", "--normals", "pcl")
        self.refuse(2, "render", side, "-o", self.folder / "a.png", "--orientation", "up")

    def test_memory_does_not_grow_with_the_file(self):
        las = self.folder / "large.las"
        self.succeed("generate", "--points", "4000000", "-o", las)
        self.assertGreater(las.stat().st_size, 100 * MIB)
        report = self.succeed(
            "index", las, "--memory", "8M", "--threads", "2", "--json").json
        self.assertEqual(report["points_indexed"], 4000000)
        if PLAIN:
            self.assertLess(report["peak_rss_bytes"], 64 * MIB)
        report = self.succeed("index", las, "--memory", "32M", "--threads", "2", "--force",
                              "--normals", "scanline", "--json").json
        if PLAIN:
            self.assertLess(report["peak_rss_bytes"], 96 * MIB)
        side = self.folder / "large.las.pfindex"
        self.assertEqual(self.succeed("verify", side, "--json").json["points_checked"], 4000000)


if __name__ == "__main__":
    unittest.main(verbosity=2)
