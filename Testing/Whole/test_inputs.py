"""Every real file builds and verifies; every broken one is told from a sound one."""

import pathlib
import unittest

from tool import DATA, SLOWNESS, ToolTest, pointfront

REAL_FOLDERS = ("las/real", "las/version_x_format", "laz", "copc", "classified", "normals",
                "ept/lone-star-laszip/ept-data", "ortho/autzen")

# What becomes of each broken file: an error that says this, or a store with so many points and a
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
    "derived_hostile/las_bbox_inverted.las": (100, "bounding box"),
    "derived_hostile/las_count_4294967295.las": (100, "4294967195 of 4294967295"),
    "derived_hostile/las_offset_to_points_past_eof.las": "offset",
    "derived_hostile/las_point_format_63.las": "63",
    "derived_hostile/las_record_length_0.las": "record",
    "derived_hostile/las_scale_zero.las": "scale",
    "derived_hostile/las_truncated_header_200_bytes.las": "header",
    "derived_hostile/las_truncated_mid_record.las": (57, "43 of 100"),
}


def las_files(folder):
    return sorted(p for p in pathlib.Path(folder).rglob("*") if p.suffix in (".las", ".laz"))


class RealFiles(ToolTest):
    def test_each_builds_and_verifies(self):
        files = [path for folder in REAL_FOLDERS for path in las_files(DATA / folder)]
        self.assertGreater(len(files), 70)
        for path in files:
            with self.subTest(file=str(path.relative_to(DATA))):
                store = self.folder / "x.pfront"
                report = self.succeed("build", path, "-o", store, "--force", "--json").json
                self.assertGreater(report["points_stored"], 0)
                self.assertEqual(report["points_read"], report["points_stored"])
                self.assertEqual(report["points_rejected"], {})
                verified = self.succeed("verify", store, "--json").json
                self.assertEqual(verified["points_checked"], report["points_stored"])

    def test_same_points_give_the_same_store(self):
        las = self.build(DATA / "las/real/autzen_trim.las", name="a.pfront")
        laz = self.build(DATA / "laz/autzen_trim.laz", name="b.pfront")
        one, other = (self.succeed("info", s, "--json").json for s in (las, laz))
        for key in ("points", "bounds", "nodes", "levels", "attributes"):
            self.assertEqual(one[key], other[key], key)


class BrokenFiles(ToolTest):
    def test_list_is_complete(self):
        found = [path for folder in ("las/broken_real", "derived_hostile")
                 for path in las_files(DATA / folder)]
        self.assertEqual({str(path.relative_to(DATA)) for path in found}, set(BROKEN))

    def test_each_is_told(self):
        for name, expected in BROKEN.items():
            with self.subTest(file=name):
                store = self.folder / "x.pfront"
                store.unlink(missing_ok=True)
                if isinstance(expected, str):
                    outcome = self.refuse(1, "build", DATA / name, "-o", store)
                    self.assertLess(outcome.seconds, 2.0 * SLOWNESS)
                    self.assertIn(expected, outcome.err)
                    self.assertIn(pathlib.Path(name).name, outcome.err)
                    self.assertEqual(self.entries(), [])
                else:
                    self.read_with_warning(name, store, *expected)

    def read_with_warning(self, name, store, points, lost):
        outcome = pointfront("build", DATA / name, "-o", store, "--json")
        self.assertLess(outcome.seconds, 2.0 * SLOWNESS)
        self.assertEqual(outcome.status, 0, outcome)
        self.assertEqual(outcome.json["points_stored"], points, outcome)
        warnings = outcome.err.splitlines()
        if lost is None:
            self.assertEqual(warnings, [])
        else:
            self.assertGreater(len(warnings), 0, "no warning")
            self.assertIn("warning", warnings[0])
            self.assertIn(lost, outcome.err)
            if points > 0:
                self.assertIn(pathlib.Path(name).name, warnings[0])
        self.succeed("verify", store)


if __name__ == "__main__":
    unittest.main(verbosity=2)
