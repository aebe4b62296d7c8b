"""Every real file builds and verifies; every broken one is told from a sound one."""

import os
import pathlib
import re
import shutil
import unittest

from tool import DATA, SLOWNESS, ToolTest, pointfront

REAL_FOLDERS = ("las/real", "las/version_x_format", "laz", "copc", "classified", "normals",
                "ept/lone-star-laszip/ept-data", "ortho/autzen", "ply", "pcd", "text",
                "classified/isprs_ground_truth")
SUFFIXES = (".las", ".laz", ".ply", ".pcd", ".txt", ".pts", ".ptx", ".xyz")

# Points of real files that are no positions: what a scanner saw nothing in.
REJECTED = {"pcd/office1.pcd": 52744, "text/complex-transform.ptx": 8}

# Each broken file gives an error that says this, or a store with so many points and a
# warning that says this (None: no warning).
BROKEN = {
    "las/broken_real/1.2-with-color-clipped.las": (1064, "1 of 1065 points are missing"),
    "las/broken_real/1.2-no-points.las": "1065",
    "las/broken_real/bad_vlr_count.las": (10, "1 of these records were lost"),
    "las/broken_real/gps-time-nan.las": (1, None),
    "las/broken_real/bad-geotiff-keys.las": (10, None),
    "las/broken_real/no-points.las": (0, "empty"),
    "las/broken_real/spurious.las": (1065, None),
    "las/broken_real/1.2-empty-geotiff-vlrs.las": (43, None),
    "las/broken_real/no-points-1.3.las": (0, "empty"),
    "las/broken_real/broken_size.laz": "broken_size.laz",
    "las/broken_real/broken_type.laz": "broken_type.laz",
    "ply/no_vertex.ply": "no element 'vertex'",
    "ply/displaz_ply_points.ply": "no element 'vertex'",
    "text/badheader.txt": "'X' is named twice",
    "derived_hostile/ply_binary_truncated.ply": (2, "1 of 3 points are missing"),
    "derived_hostile/pcd_points_4e9.pcd": "4000000000",
    "derived_hostile/las_bbox_inverted.las": (100, "bounding box"),
    "derived_hostile/las_count_4294967295.las": (100, "4294967195 of 4294967295"),
    "derived_hostile/las_offset_to_points_past_eof.las": "offset",
    "derived_hostile/las_point_format_63.las": "63",
    "derived_hostile/las_record_length_0.las": "record",
    "derived_hostile/las_scale_zero.las": "scale",
    "derived_hostile/las_truncated_header_200_bytes.las": "header",
    "derived_hostile/las_truncated_mid_record.las": (57, "43 of 100"),
}


def point_files(folder):
    return sorted(p for p in pathlib.Path(folder).rglob("*") if p.suffix in SUFFIXES)


def name_of(path):
    return str(path.relative_to(DATA))


class RealFiles(ToolTest):
    def test_each_builds_and_verifies(self):
        files = [path for folder in REAL_FOLDERS for path in point_files(DATA / folder)
                 if name_of(path) not in BROKEN]
        self.assertGreater(len(files), 130)
        for path in files:
            with self.subTest(file=name_of(path)):
                store = self.folder / "x.pfront"
                report = self.succeed("build", path, "-o", store, "--force", "--json").json
                self.assertGreater(report["points_stored"], 0)
                rejected = sum(report["points_rejected"].values())
                self.assertEqual(report["points_read"], report["points_stored"] + rejected)
                self.assertEqual(rejected, REJECTED.get(name_of(path), 0))
                if SLOWNESS == 1:  # stores of the readers' points are alike for a sanitizer
                    verified = self.succeed("verify", store, "--json").json
                    self.assertEqual(verified["points_checked"], report["points_stored"])

    def test_same_points_give_the_same_store(self):
        las = self.build(DATA / "las/real/autzen_trim.las", name="a.pfront")
        laz = self.build(DATA / "laz/autzen_trim.laz", name="b.pfront")
        one, other = (self.succeed("info", s, "--json").json for s in (las, laz))
        for key in ("points", "bounds", "nodes", "levels", "attributes"):
            self.assertEqual(one[key], other[key], key)


    def test_same_points_in_every_encoding_of_ply(self):
        names = ("platonic_shelf.ply", "platonic_shelf_ascii.ply", "platonic_shelf_big_endian.ply")
        infos = [self.succeed("info", self.build(DATA / "ply" / name, name=name + ".pfront"),
                              "--json").json for name in names]
        for info in infos:
            self.assertEqual(info["points"], 50)
            for one, other in zip(info["bounds"], infos[0]["bounds"]):
                self.assertAlmostEqual(one, other, delta=2e-5)

    def test_formats_mix_in_one_store(self):
        las = DATA / "las/real/1.2-with-color.las"
        store = self.build(las, name="las.pfront")
        written = []
        for kind in ("ply", "pcd", "xyz"):
            written.append(self.folder / f"copy.{kind}")
            self.succeed("export", store, "-o", written[-1])
        report = self.succeed("build", las, *written, "-o", self.folder / "mixed.pfront",
                              "--json").json
        self.assertEqual(report["points_stored"], 4 * 1065)
        one, mixed = (self.succeed("info", self.folder / name, "--json").json
                      for name in ("las.pfront", "mixed.pfront"))
        self.assertEqual(one["bounds"], mixed["bounds"])
        self.assertEqual(one["precision"], mixed["precision"])
        self.assertEqual(one["attributes"], mixed["attributes"])

    def test_columns_of_text_are_named_by_the_user(self):
        path = self.folder / "points.csv"
        path.write_text("9;1,5;2,5;3,5\n8;4,5;5,5;6,5\n")
        store = self.folder / "x.pfront"
        self.succeed("build", path, "-o", store, "--columns", "-,x,y,z")
        info = self.succeed("info", store, "--json").json
        self.assertEqual(info["bounds"], [1.5, 2.5, 3.5, 4.5, 5.5, 6.5])
        self.assertEqual(info["attributes"], [])
        self.refuse(1, "build", path, "-o", store, "--force", "--columns", "a,b")
        self.refuse(2, "build", path, "-o", store, "--force", "--columns", "x")

    def test_folder_leaves_notes_out(self):
        (self.folder / "in").mkdir()
        (self.folder / "in/points.txt").write_text("1 2 3\n4 5 6\n")
        (self.folder / "in/readme.txt").write_text("These points were made by hand.\n")
        store = self.build(self.folder / "in")
        self.assertEqual(self.succeed("info", store, "--json").json["points"], 2)

    def test_pcd_and_ply_without_their_headers_are_no_text(self):
        for name, reason in (("x.pcd", "no keyword of a PCD header"), ("x.ply", "not a PLY file"),
                             ("x.las", "x.las")):
            path = self.folder / name
            path.write_text("1 2 3\n4 5 6\n")
            outcome = self.refuse(1, "build", path, "-o", self.folder / "x.pfront")
            self.assertIn(reason, outcome.err)

    def test_kinds_that_are_not_read_say_what_to_do(self):
        outcome = self.refuse(
            1, "build", DATA / "e57/bunnyInt32.e57", "-o", self.folder / "x.pfront")
        self.assertIn("convert it", outcome.err)

    def test_a_tree_by_its_description_its_folder_and_its_files(self):
        tree = DATA / "ept/lone-star-laszip"
        stores = [self.build(given, name=f"{number}.pfront") for number, given in
                  enumerate((tree / "ept.json", tree, tree / "ept-data"))]
        infos = [self.succeed("info", store, "--json").json for store in stores]
        for info in infos:
            self.assertEqual(info["points"], 518862)
            self.assertEqual(info["bounds"], infos[2]["bounds"])
            self.assertEqual(info["attributes"], infos[2]["attributes"])


class BrokenFiles(ToolTest):
    def test_list_is_complete(self):
        folders = ("las/broken_real", "derived_hostile")
        found = {name_of(path) for folder in folders for path in point_files(DATA / folder)}
        self.assertEqual(found, {name for name in BROKEN if name.startswith(folders)})

    def test_each_is_told(self):
        for name, expected in BROKEN.items():
            with self.subTest(file=name):
                store = self.folder / "x.pfront"
                store.unlink(missing_ok=True)
                if isinstance(expected, str):
                    outcome = self.refuse(1, "build", DATA / name, "-o", store)
                    self.assertLess(outcome.processor_seconds, 2.0 * SLOWNESS)
                    self.assertIn(expected, outcome.err)
                    self.assertIn(pathlib.Path(name).name, outcome.err)
                    self.assertEqual(self.entries(), [])
                else:
                    self.read_with_warning(name, store, *expected)

    def read_with_warning(self, name, store, points, lost):
        outcome = pointfront("build", DATA / name, "-o", store, "--json")
        self.assertLess(outcome.processor_seconds, 2.0 * SLOWNESS)
        self.assertEqual(outcome.status, 0, outcome)
        self.assertEqual(outcome.json["points_stored"], points, outcome)
        cut = re.match(r"(\d+) (of|points)", lost or "") if "missing" in outcome.err else None
        self.assertEqual(outcome.json["points_rejected"].get("missing", 0),
                         int(cut.group(1)) if cut else 0, outcome)
        if cut:  # who asks for whole inputs gets an error
            refused = pointfront(
                "build", DATA / name, "-o", store, "--force", "--on-error", "stop")
            self.assertEqual(refused.status, 1, refused)
            self.assertIn("get a whole copy", refused.err)
        # Warnings of its coordinate system have tests of their own.
        warnings = [line for line in outcome.err.splitlines()
                    if "coordinate reference system" not in line and "longitudes" not in line]
        if lost is None:
            self.assertEqual(warnings, [])
        else:
            self.assertGreater(len(warnings), 0, "no warning")
            self.assertIn("warning", warnings[0])
            self.assertIn(lost, outcome.err)
            if points > 0:
                self.assertIn(pathlib.Path(name).name, warnings[0])
        self.succeed("verify", store)


class HostileTrees(ToolTest):
    """Files of an Entwine tree that are no files, or cannot be what they say."""

    def setUp(self):
        super().setUp()
        self.tree = self.folder / "tree"
        shutil.copytree(DATA / "ept/bcbf", self.tree)

    def replaced(self, path):
        """The name is a folder, a pipe that nobody writes, a device, a sparse file of 20 GB."""
        kept = path.read_bytes()
        makers = (path.mkdir, lambda: os.mkfifo(path), lambda: path.symlink_to("/dev/zero"),
                  lambda: (path.touch(), os.truncate(path, 20 << 30)))
        for make in makers:
            path.unlink()
            make()
            yield
            shutil.rmtree(path) if path.is_dir() else path.unlink()
            path.write_bytes(kept)

    def test_each_is_told_at_once(self):
        node = next((self.tree / "ept-data").iterdir())
        for path in (self.tree / "ept-hierarchy/0-0-0-0.json", node):
            for _ in self.replaced(path):
                for command in (["build", self.tree, "-o", self.folder / "x.pfront"],
                                ["render", self.tree, "-o", self.folder / "x.png"],
                                ["verify", self.tree]):
                    outcome = pointfront(*command)
                    self.assertEqual(outcome.status, 1, outcome)
                    self.assertIn(path.name, outcome.err)
                    self.assertLess(outcome.processor_seconds, 10 * SLOWNESS)

    def test_no_input_is_a_pipe(self):
        pipe = self.folder / "pipe.las"
        os.mkfifo(pipe)
        for command in (["build", pipe, "-o", self.folder / "x.pfront"], ["info", pipe],
                        ["index", pipe], ["verify", pipe]):
            self.refuse(1, *command)


if __name__ == "__main__":
    unittest.main(verbosity=2)
