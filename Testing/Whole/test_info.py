"""`info` of any readable file, and `--stats`: what Python computes from the bytes of a LAS file."""

import gzip
import json
import math
import os
import struct
import unittest

from tool import DATA, ToolTest, write_las

COLOURED = DATA / "las/real/1.2-with-color.las"
HOSTILE = DATA / "derived_hostile"
KEYS = {"points", "bounds", "precision", "crs", "structure", "refinement", "nodes", "levels",
        "bytes", "attributes", "layers", "version"}


def las_rows(path):
    """Points of a LAS 1.2 file of format 3: dictionaries of numbers in world units."""
    data = path.read_bytes()
    offset, = struct.unpack_from("<I", data, 96)
    size, count = struct.unpack_from("<HI", data, 105)
    scale, origin = struct.unpack_from("<3d", data, 131), struct.unpack_from("<3d", data, 155)
    rows = []
    for i in range(count):
        at = offset + i * size
        x, y, z, intensity, bits, kind, angle, user, place, time = struct.unpack_from(
            "<3iHBBbBHd", data, at)
        red, green, blue = struct.unpack_from("<3H", data, at + 28)
        steps = [x, y, z]
        world = [origin[k] + scale[k] * steps[k] for k in range(3)]
        rows.append({"x": world[0], "y": world[1], "z": world[2], "intensity": intensity,
                     "return_number": bits & 7, "return_count": bits >> 3 & 7,
                     "classification": kind & 31, "scan_angle": angle, "user_data": user,
                     "point_source_id": place, "gps_time": time,
                     "rgb[0]": red, "rgb[1]": green, "rgb[2]": blue})
    return rows


def box(rows):
    return ([min(r[axis] for r in rows) for axis in "xyz"] +
            [max(r[axis] for r in rows) for axis in "xyz"])


def named(entries):
    """The entries of `attributes` by name, with the component where there are several."""
    several = {e["name"] for e in entries if e["component"] > 0}
    return {f"{e['name']}[{e['component']}]" if e["name"] in several else e["name"]: e
            for e in entries}


class Statistics(ToolTest):
    def check_values(self, entry, values):
        """Minimum, maximum, mean and deviation, and every bin of the histogram."""
        self.assertEqual(entry["count"], len(values))
        self.assertEqual((entry["not_a_number"], entry["infinite"]), (0, 0))
        reach = max(abs(v) for v in values)
        mean = math.fsum(values) / len(values)
        deviation = math.sqrt(math.fsum((v - mean) ** 2 for v in values) / len(values))
        for key, expected in (("minimum", min(values)), ("maximum", max(values)),
                              ("mean", mean), ("standard_deviation", deviation)):
            self.assertAlmostEqual(entry[key], expected, delta=1e-12 * reach + 1e-12, msg=key)
        self.assertEqual(sum(entry["histogram"]["counts"]), len(values))

    def check_histogram(self, entry, values, bins):
        """Values near an edge of bins may fall on either side."""
        low, width = entry["histogram"]["low"], entry["histogram"]["width"]
        counts = entry["histogram"]["counts"]
        self.assertLessEqual(len(counts), bins)
        nearly = 1e-6
        for b, count in enumerate(counts):
            begin, end = low + b * width, low + (b + 1) * width
            last = b + 1 == len(counts)
            surely = sum(begin + nearly < v and (last or v < end - nearly) for v in values)
            perhaps = sum(begin - nearly <= v and (last or v <= end + nearly) for v in values)
            self.assertTrue(surely <= count <= perhaps, (entry["name"], b, surely, count, perhaps))

    def check(self, report, rows, names, bins=32):
        """`stats` of a report against rows."""
        stats = report["stats"]
        self.assertEqual((stats["points"], stats["points_rejected"]), (len(rows), {}))
        for got, expected in zip(stats["bounds"], box(rows)):
            self.assertAlmostEqual(got, expected, places=6)
        everything = named(stats["attributes"])
        for name in names:
            values = [row[name] for row in rows]
            self.check_values(everything[name], values)
            self.check_histogram(everything[name], values, bins)
        for group in stats["classes"]:
            members = [r for r in rows if r["classification"] == group["class"]]
            self.assertEqual(group["points"], len(members))
            for got, expected in zip(group["bounds"], box(members)):
                self.assertAlmostEqual(got, expected, places=6)
            own = named(group["attributes"])
            for name in names:
                self.check_values(own[name], [row[name] for row in members])
                self.assertEqual(own[name]["histogram"]["low"],
                                 everything[name]["histogram"]["low"])
        return stats

    def test_every_kind_of_file_tells_the_same(self):
        rows = las_rows(COLOURED)
        names = list(rows[0])
        stores = [self.build(COLOURED)]
        for number, options in enumerate((("--structure", "kdtree"), ("--layers", "none"),
                                          ("--refinement", "replace"))):
            stores.append(self.folder / f"{number}.pfront")
            self.succeed("build", COLOURED, "-o", stores[-1], *options)
        side = self.folder / "side.pfindex"
        self.succeed("index", COLOURED, "-o", side)
        told = []
        copc = DATA / "copc/1.2-with-color.copc.laz"
        for path in [COLOURED, copc, side, *stores]:
            report = self.succeed("info", path, "--stats", "--json").json
            self.assertLessEqual(KEYS, set(report))
            # LAS 1.4 has scan angles in steps of 0.006 degrees: other numbers.
            exact = [name for name in names if path != copc or name != "scan_angle"]
            stats = self.check(report, rows, exact)
            self.assertEqual({c["class"] for c in stats["classes"]}, {1, 2})
            told.append(json.dumps(stats, sort_keys=True))
        del told[1]  # the COPC has other columns
        self.assertEqual(len(set(told)), 1)  # to the last digit

        for name in ("x.laz", "x.ply", "x.pcd", "x.csv"):
            out = self.folder / name
            double = ["--double"] if name == "x.pcd" else []
            self.succeed("export", stores[0], "-o", out, *double)
            report = self.succeed("info", out, "--stats", "--json").json
            stats = self.check(report, rows, ["x", "y", "z", "intensity", "gps_time"])
            self.assertEqual({c["class"]: c["points"] for c in stats["classes"]},
                             {1: 789, 2: 276}, name)
            self.assertEqual(report["points"], 1065)

    def test_threads_change_nothing(self):
        store = self.build(DATA / "las/real/autzen_trim.las")
        for path in (DATA / "laz/autzen_trim.laz", store):
            told = {self.succeed("info", path, "--stats", "--json", "--memory", memory,
                                 environment={**os.environ, "POINTFRONT_THREADS": threads}).out
                    for threads, memory in (("1", "256M"), ("2", "256M"), ("5", "1M"))}
            self.assertEqual(len(told), 1)

    def test_bins_and_density(self):
        rows = las_rows(COLOURED)
        report = self.succeed("info", COLOURED, "--stats", "--bins", "7", "--json").json
        stats = self.check(report, rows, ["z", "intensity"], 7)
        self.assertEqual(len(named(stats["attributes"])["z"]["histogram"]["counts"]), 7)
        density = stats["density"]
        low, high = stats["bounds"][:2], stats["bounds"][3:5]
        side = math.sqrt(16 * (high[0] - low[0]) * (high[1] - low[1]) / len(rows))
        cells = {(int((r["x"] - low[0]) / side), int((r["y"] - low[1]) / side)) for r in rows}
        self.assertAlmostEqual(density["cell_size"], side, places=6)
        self.assertEqual(density["occupied_cells"], len(cells))
        self.assertAlmostEqual(density["points_per_square_unit"],
                               len(rows) / len(cells) / side ** 2, places=9)
        self.assertIn("cells", density["method"])
        text = self.succeed("info", COLOURED, "--stats").out
        for word in ("points per square unit", "class 2 (ground): 276 points", "intensity"):
            self.assertIn(word, text)
        self.refuse(2, "info", COLOURED, "--bins", "7")
        self.refuse(2, "info", COLOURED, "--stats", "--bins", "0")

    def test_values_that_are_none(self):
        path = self.folder / "odd.csv"
        path.write_text("x,y,z,intensity\n1,2,3,4\n2,3,4,6\nnan,1,1,1000\n3,1,inf,1000\n")
        outcome = self.succeed("info", path, "--stats", "--json")
        self.assertIn("1 infinite, 1 not a number", outcome.err)
        report = outcome.json
        self.assertEqual(report["points"], 4)
        self.assertEqual(report["points_rejected"], {"infinite": 1, "not a number": 1})
        self.assertEqual(report["stats"]["points"], 2)
        self.assertEqual(named(report["stats"]["attributes"])["intensity"]["maximum"], 6)
        self.assertEqual(report["stats"]["classes"], [])


class AnyFile(ToolTest):
    def info(self, path, *options):
        return self.succeed("info", path, "--json", *options).json

    def test_headers_and_counts_are_told_apart(self):
        for name, fmt, header in (
                ("las/real/1.2-with-color.las", "LAS 1.2 format 3", ["points", "bounds"]),
                ("laz/simple.laz", "LAZ 1.2 format 3", ["points", "bounds"]),
                ("copc/1.2-with-color.copc.laz", "LAZ 1.4 format 7", ["points", "bounds"]),
                ("ept/lone-star-laszip/ept.json", "EPT of LAZ 1.2 format 1", ["points", "bounds"]),
                ("ply/ripple_bin.ply", None, []), ("pcd/bunny.pcd", None, []),
                ("text/utm17_1.txt", "text", []), ("text/1.2-with-color.ptx", "PTX", [])):
            report = self.info(DATA / name)
            self.assertLessEqual(KEYS, set(report), name)
            self.assertEqual(report["from_header"], header, name)
            if fmt:
                self.assertEqual(report["format"], fmt)
            self.assertEqual(report["bytes"], (DATA / name).stat().st_size)
            for axis in range(3):
                self.assertLessEqual(report["bounds"][axis], report["bounds"][axis + 3])
            text = self.succeed("info", DATA / name).out
            self.assertEqual(text.count("(from the header)"), len(header))
            self.assertEqual(text.count("(counted)"), 2 - len(header))
        self.assertEqual(self.info(DATA / "pcd/bunny.pcd")["header"],
                         {"points": 397, "bounds": None})
        self.assertIsNone(self.info(DATA / "text/utm17_1.txt")["header"]["points"])

    def test_packed_text(self):
        path = self.folder / "a.xyz.gz"
        path.write_bytes(gzip.compress(b"1 2 3\n4 5 6\n7 8 10\n"))
        report = self.info(path)
        self.assertEqual((report["points"], report["bounds"]), (3, [1, 2, 3, 7, 8, 10]))

    def test_a_lying_header_is_told(self):
        for name, points, claimed in (("las_count_4294967295.las", 100, 4294967295),
                                      ("las_truncated_mid_record.las", 57, 100),
                                      ("ply_binary_truncated.ply", 2, 3)):
            outcome = self.succeed("info", HOSTILE / name, "--json")
            self.assertEqual(outcome.json["points"], points)
            self.assertEqual(outcome.json["header"]["points"], claimed)
            self.assertNotIn("points", outcome.json["from_header"])
            self.assertIn("missing", outcome.err)
            self.assertEqual(len(outcome.json["warnings"]), len(outcome.err.splitlines()))
            self.assertIn(f"the header claims {claimed}",
                          self.succeed("info", HOSTILE / name).out)
        inverted = self.succeed("info", HOSTILE / "las_bbox_inverted.las", "--json")
        self.assertIn("bounding box", inverted.err)
        self.assertEqual(inverted.json["from_header"], [])  # so it was counted
        self.assertEqual(inverted.json["bounds"][0], 635717.85)
        for name in ("las_scale_zero.las", "las_point_format_63.las", "pcd_points_4e9.pcd"):
            self.refuse(1, "info", HOSTILE / name)

    def test_points_outside_of_the_header(self):
        las = write_las(self.folder / "a.las", [(x, 2.0 * x, 5.0, 0, 0, 0) for x in range(10)])
        data = bytearray(las.read_bytes())
        struct.pack_into("<d", data, 179, 7.0)  # the largest x; it is 9
        las.write_bytes(data)
        headed = self.succeed("info", las, "--json")
        self.assertEqual((headed.err, headed.json["bounds"][3]), ("", 7.0))
        counted = self.succeed("info", las, "--stats", "--json")
        self.assertIn("outside of the header's bounds", counted.err)
        self.assertEqual((counted.json["bounds"][3], counted.json["header"]["bounds"][3]), (9, 7))

    def test_several_files(self):
        other = DATA / "text/utm17_1.txt"
        store = self.build(other)
        files = self.info(store, COLOURED, other)["files"]
        self.assertEqual([f["points"] for f in files], [10, 1065, 10])
        self.assertEqual([f["path"] for f in files], [str(store), str(COLOURED), str(other)])
        wrong = self.folder / "wrong.las"
        wrong.write_bytes(b"LASF")
        outcome = self.refuse(1, "info", wrong, COLOURED, "no/such.las", "--json")
        self.assertIn("2 of 3 inputs", outcome.err)
        self.assertIn("no/such.las", outcome.err)
        self.assertEqual([f["points"] for f in outcome.json["files"]], [1065])  # the rest is told

    def test_what_is_neither(self):
        picture = self.folder / "x.png"
        picture.write_bytes(b"\x89PNG\r\n\x1a\n" + bytes(100))
        empty = self.folder / "e.las"
        empty.write_bytes(b"")
        false = self.folder / "x.pfront"
        false.write_bytes(COLOURED.read_bytes()[:50])
        for path, word in ((picture, "not a point file"), (empty, "0 bytes"), (false, "store")):
            self.assertIn(word, self.refuse(1, "info", path).err)

    def test_words_that_people_use(self):
        """A system by its code, a count with an exponent, and what a folder was looked through for.
        """
        cloud = self.folder / "a.las"
        self.succeed("generate", "--points", "1e3", "-o", cloud)
        self.succeed("build", cloud, "-o", self.folder / "a.pfront", "--assume-crs", "EPSG:2154",
                     "--force")
        told = self.succeed("info", self.folder / "a.pfront")
        self.assertRegex(told.out, r"crs +EPSG:2154 \(RGF93[^\n]*Lambert-93\)\n")
        self.assertIn("points      1000\n", told.out)
        told = self.succeed("info", self.folder / "a.pfront", "--json").json
        self.assertIn("2154", told["crs"])
        self.assertGreater(len(told["crs"]), 100)
        empty = self.folder / "empty"
        empty.mkdir()
        refused = self.refuse(1, "build", empty, "-o", self.folder / "b.pfront")
        for word in (str(empty), ".las", ".ply"):
            self.assertIn(word, refused.err)


if __name__ == "__main__":
    unittest.main(verbosity=2)
