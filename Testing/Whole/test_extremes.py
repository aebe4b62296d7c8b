"""Coordinates at the edges of what a store and LAS hold: either exact, or rounded with a warning
that says by how much, or refused with what fits."""

import random
import struct
import unittest

from tool import ToolTest, write_las


class Rounding(ToolTest):
    """A build says what it does to coordinates."""

    def text(self, name, rows):
        path = self.folder / name
        path.write_text("x,y,z\n" + "".join("%s,%s,%s\n" % row for row in rows))
        return path

    def positions(self, store):
        out = self.folder / "out.csv"
        self.succeed("export", store, "-o", out, "--force")
        return [tuple(map(float, line.split(","))) for line in out.read_text().splitlines()[1:]]

    def test_two_clouds_far_apart_do_not_collapse(self):
        chance = random.Random(1)
        near = [tuple("%.3f" % (chance.random() * size) for size in (100, 100, 10))
                for _ in range(1000)]
        far = [("%.3f" % (500000 + float(x)), "%.3f" % (4800000 + float(y)), z) for x, y, z in near]
        source = self.text("half.csv", near + far)
        store = self.folder / "half.pfront"
        built = self.succeed("build", source, "-o", store)
        self.assertIn("rounded to steps of 0.01 units", built.err)
        stored = self.positions(store)
        self.assertEqual(len(stored), 2000)
        for axis in range(3):
            given = sorted(float(row[axis]) for row in near + far)
            for a, b in zip(given, sorted(position[axis] for position in stored)):
                self.assertLessEqual(abs(a - b), 0.005 + 1e-9)
        # The whole cloud goes on to LAS.
        self.succeed("export", store, "-o", self.folder / "half.las")

    def test_parts_too_far_apart_for_32_bits_are_refused(self):
        rows = [("%.3f" % (i * 0.01 + offset), "%.3f" % (i * 0.01), "0")
                for i in range(500) for offset in (0, 1e8)]
        source = self.text("apart.csv", rows)
        refused = self.refuse(
            1, "build", source, "-o", self.folder / "x.pfront", "--assume-crs", "EPSG:2154")
        self.assertIn("fits", refused.err)
        self.assertEqual(self.entries(), ["apart.csv"])

    def test_more_digits_than_a_double_has_are_told(self):
        source = self.text("ten.csv", [("10000000.000000001", "0", "0"), ("10000000.5", "1", "1"),
                                       ("10000001.25", "2", "2")])
        store = self.folder / "ten.pfront"
        built = self.succeed("build", source, "-o", store)
        self.assertIn("rounded to steps of", built.err)
        self.assertEqual(sorted(self.positions(store)),
                         [(10000000, 0, 0), (10000000.5, 1, 1), (10000001.25, 2, 2)])
        out = self.folder / "ten.las"
        self.succeed("export", store, "-o", out)
        self.assertEqual(self.succeed("info", out, "--json").json["points"], 3)

    def test_a_precision_that_no_double_has_is_refused(self):
        source = self.text("ten.csv", [("10000000.5", "0", "0"), ("10000001.25", "2", "2")])
        refused = self.refuse(
            1, "build", source, "-o", self.folder / "x.pfront", "--precision", "1e-9",
            "--assume-crs", "EPSG:2154")
        self.assertIn("1e-08 fits", refused.err)


class WholeRange(ToolTest):
    """LAS with integers from -2^31 to 2^31 - 1 goes into a store and out again."""

    def test_every_integer_comes_back(self):
        size = 4294967295 * 0.001
        points = [(0, 0, 0), (size, size, 1), (size / 2, 0, 0.5), (0, size, 0.25)]
        source = write_las(
            self.folder / "whole.las", [p + (0, 0, 0) for p in points], 0.001, centred=True)
        store = self.build(source)
        out = self.folder / "out.las"
        self.succeed("export", store, "-o", out)
        before = self.succeed("info", source, "--json").json
        after = self.succeed("info", out, "--json").json
        self.assertEqual(after["bounds"], before["bounds"])
        self.assertEqual(after["points"], 4)


class Counts(ToolTest):
    """Numbers of points that 31, 32 or 53 bits do not hold, of files with holes instead of
    points."""

    def las(self, name, claimed, there):
        """A LAS 1.4 of format 6; all its points are zeros."""
        header = bytearray(375)
        header[:4], header[24:26], header[104] = b"LASF", (1, 4), 6
        struct.pack_into("<HI", header, 94, 375, 375)
        struct.pack_into("<H", header, 105, 30)
        struct.pack_into("<3d", header, 131, 0.01, 0.01, 0.01)
        # Without a box, info would read them all.
        struct.pack_into("<6d", header, 179, *(1, 0) * 3)
        struct.pack_into("<Q", header, 247, claimed)
        path = self.folder / name
        with open(path, "wb") as file:
            file.write(header)
            file.truncate(375 + 30 * there)
        return path

    def test_counts_of_headers_are_told_to_the_last_point(self):
        for count in (2 ** 31, 2 ** 32 + 5, 2 ** 37 + 1):
            path = self.las("holes.las", count, count)
            told = self.succeed("info", path, "--json").json
            self.assertEqual((told["points"], told["bytes"]), (count, 375 + 30 * count))
            self.assertIn(f"{count} (from the header)", self.succeed("info", path).out)

    def test_a_folder_of_ten_billion_points(self):
        for number in range(10):
            self.las(f"{number}.las", 10 ** 9, 10 ** 9)
        told = self.succeed("info", self.folder, "--json").json
        self.assertEqual(sum(file["points"] for file in told["files"]), 10 ** 10)
        self.assertGreater(told["estimate"]["store_bytes"][0], 10 ** 10)
        self.assertIn("of 10000000000 points", self.succeed("info", self.folder, "--together").err)

    def test_missing_points_are_counted_to_the_last_one(self):
        path = self.las("lies.las", 2 ** 53 + 1, 1000)
        built = self.succeed("build", path, "-o", self.folder / "x.pfront", "--json")
        self.assertEqual(built.json["points_stored"], 1000)
        self.assertEqual(built.json["points_rejected"], {"missing": 2 ** 53 - 999})
        self.assertIn(f"{2 ** 53 - 999} of {2 ** 53 + 1} points are missing", built.err)


if __name__ == "__main__":
    unittest.main()
