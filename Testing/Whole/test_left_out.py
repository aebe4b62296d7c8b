"""Nothing is lost in silence: points and inputs that are left out are named and counted."""

import gzip
import math
import shutil
import struct
import unittest

from tool import DATA, ToolTest, pointfront

SMALL = DATA / "las/real/1.2-with-color.las"
OFFICE = DATA / "pcd/office1.pcd"  # 307,200 points of which 52,744 are NaN


def write_scaled_las(path, steps, scales, offsets=(0.0, 0.0, 0.0)):
    """LAS 1.2, format 0, with a scale for each axis; points are integers."""
    low = [min(p[a] for p in steps) * scales[a] + offsets[a] for a in range(3)]
    high = [max(p[a] for p in steps) * scales[a] + offsets[a] for a in range(3)]
    header = struct.pack(
        "<4sHH16sBB32s32sHHHIIBHI5I12d", b"LASF", 0, 0, bytes(16), 1, 2, b"test", b"tests", 1,
        2020, 227, 227, 0, 0, 20, len(steps), len(steps), 0, 0, 0, 0, *scales, *offsets,
        high[0], low[0], high[1], low[1], high[2], low[2])
    with open(path, "wb") as file:
        file.write(header)
        for p in steps:
            file.write(struct.pack("<3iHBBBBH", *p, 0, 9, 1, 0, 0, 0))
    return path


def las_steps(path):
    data = path.read_bytes()
    begin, = struct.unpack_from("<I", data, 96)
    size, count = struct.unpack_from("<HI", data, 105)
    return sorted(struct.unpack_from("<3i", data, begin + i * size) for i in range(count))


class LeftOutTest(ToolTest):
    def fail_after_warnings(self, *arguments):
        """The run fails with status 1; what it says last, behind any warnings."""
        outcome = pointfront(*arguments)
        self.assertEqual(outcome.status, 1, outcome)
        *warnings, last = outcome.err.splitlines()
        self.assertTrue(all(": warning: " in line for line in warnings), outcome)
        return last


class Points(LeftOutTest):
    def text(self, content, name="points.xyz"):
        path = self.folder / name
        path.write_text(content)
        return path

    def test_each_reason_is_told(self):
        path = self.text("1 2 3\nnan 2 3\n4 5 6\ninf 0 0\n1e300 0 0\nno point at all\n7 8 9\n"
                         "10 11 12\n")
        store = self.folder / "x.pfront"
        outcome = self.succeed("build", path, "-o", store)
        self.assertIn("4 of 8 points are left out", outcome.err)
        for reason in ("2 not a number", "1 infinite", "1 outside the grid's range"):
            self.assertIn(reason, outcome.err)
            self.assertIn(reason, outcome.out)
        report = self.succeed("build", path, "-o", store, "--force", "--json").json
        self.assertEqual(report["points_rejected"], {
            "not a number": 2, "infinite": 1, "outside the grid's range": 1})
        self.assertEqual(report["points_read"], 8)
        self.assertEqual(report["points_stored"], 4)
        outcome = self.succeed("build", OFFICE, "-o", store, "--force")
        self.assertIn("52744 of 307200 points are left out: 52744 not a number", outcome.err)

    def test_colours_that_are_no_numbers_are_counted(self):
        """NaN in PLY, PCD and text was black without a word."""
        rows = [(float(k), 2.0, 3.0, k / 10, 0.5, 1.0) for k in range(10)]
        rows[3] = (3.0, 2.0, 3.0, math.nan, 0.5, math.nan)
        body = "".join(" ".join(map(repr, row)) + "\n" for row in rows)
        names = ("x", "y", "z", "red", "green", "blue")
        ply = ("ply\nformat binary_little_endian 1.0\nelement vertex 10\n"
               + "".join(f"property float {name}\n" for name in names) + "end_header\n").encode()
        (self.folder / "a.ply").write_bytes(ply + b"".join(struct.pack("<6f", *r) for r in rows))
        pcd = (f"VERSION 0.7\nFIELDS {' '.join(names)}\nSIZE 4 4 4 4 4 4\nTYPE F F F F F F\n"
               "COUNT 1 1 1 1 1 1\nWIDTH 10\nHEIGHT 1\nPOINTS 10\nDATA ascii\n")
        self.text(pcd + body, "a.pcd")
        self.text(" ".join(names) + "\n" + body, "a.txt")
        store = self.folder / "x.pfront"
        for kind in ("ply", "pcd", "txt"):
            outcome = self.succeed("build", self.folder / f"a.{kind}", "-o", store, "--force")
            self.assertEqual(
                outcome.err.count("2 values of the colour 'red', 'green', 'blue' are NaN"), 1,
                (kind, outcome.err))

    def test_nothing_is_said_of_the_points_of_a_file_without_any(self):
        """It "lacks rgb; zeros are stored instead", and its coordinates "are rounded"."""
        path = write_scaled_las(self.folder / "other.las", [(1, 1, 1)], (0.033, 0.033, 0.033))
        one = path.read_bytes()
        empty = self.folder / "empty.las"
        empty.write_bytes(one[:107] + bytes(24) + one[131:227])  # no points, of no return
        for other, told in ((path, 1), (empty, 0)):
            outcome = self.succeed("build", SMALL, other, "-o", self.folder / "x.pfront",
                                   "--force")
            for words in ("zeros are stored instead", "are rounded, by at most"):
                self.assertEqual(outcome.err.count(words), told, (other, outcome.err))

    def test_an_input_of_which_nothing_is_left_is_an_error(self):
        for content in ("nan nan nan\nnan nan nan\n", "1e300 2 3\n", "inf 1 1\n"):
            path = self.text(content)
            said = self.fail_after_warnings("build", path, "-o", self.folder / "x.pfront")
            self.assertIn("points can be stored", said)
            self.assertIn("points.xyz", said)
        said = self.fail_after_warnings("build", path, SMALL, "-o", self.folder / "x.pfront")
        self.assertIn("points.xyz", said)
        self.assertEqual(self.entries(), ["points.xyz"])

    def test_a_step_for_each_axis_is_lossless(self):
        extent = (1000.0, 700.0, 90.0)
        scales = tuple(e / 2**31 for e in extent)
        count = 5000
        steps = [(i * 104729 % 2**31, i * 1299709 % 2**31, i * 15485863 % 2**31)
                 for i in range(1, count)] + [(0, 0, 0), (2**31 - 1, 2**31 - 1, 2**31 - 1)]
        las = write_scaled_las(self.folder / "a.las", steps, scales, (5e5, 4e6, 100.0))
        for structure in ("octree", "kdtree"):
            store = self.folder / "x.pfront"
            self.succeed("build", las, "-o", store, "--force", "--structure", structure)
            self.succeed("verify", store)
            out = self.folder / "out.las"
            self.succeed("export", store, "-o", out, "--force")
            self.assertEqual(las_steps(out), sorted(steps))

    def test_points_do_not_collapse_for_one_far_away(self):
        rows = [f"{i * 0.001:.3f} {i % 7 * 0.001:.3f} 0.5" for i in range(1000)]
        path = self.text("\n".join(rows + ["1e12 0 0"]) + "\n")
        store = self.folder / "x.pfront"
        said = self.fail_after_warnings("build", path, "-o", store)
        self.assertIn("precision", said)
        self.assertIn("1000 fits", said)
        self.succeed("build", path, "-o", store, "--precision", "1000")  # a chosen precision holds
        self.assertEqual(self.succeed("info", store, "--json").json["points"], 1001)

    def test_degrees_keep_their_digits_beside_heights(self):
        rows = [f"{7 + i * 1e-9:.9f},{50 + i * 3e-9:.9f},{i * 0.25:.2f}" for i in range(4000)]
        path = self.text("lon,lat,h\n" + "\n".join(rows) + "\n", "p.csv")
        store = self.build(path)
        out = self.folder / "out.xyz"
        self.succeed("export", store, "-o", out)
        got = sorted(tuple(map(float, line.split())) for line in
                     out.read_text().splitlines()[1:])
        want = sorted(tuple(map(float, row.split(","))) for row in rows)
        self.assertEqual(len(got), len(want))
        for one, other in zip(got, want):
            for a, b, tolerance in zip(one, other, (6e-10, 6e-10, 1e-9)):
                self.assertLess(abs(a - b), tolerance)


class Inputs(LeftOutTest):
    def setUp(self):
        super().setUp()
        self.good = self.folder / "good.las"
        shutil.copyfile(SMALL, self.good)
        self.broken = self.folder / "broken.las"
        self.broken.write_bytes(SMALL.read_bytes()[:100])
        self.damaged = self.folder / "damaged.laz"  # opens, and cannot be read to its end
        whole = bytearray((DATA / "laz/autzen_trim.laz").read_bytes())
        whole[20000:400000] = bytes(380000)
        self.damaged.write_bytes(whole)
        self.empty = self.folder / "nothing.xyz"
        self.empty.write_text("nan nan nan\nnan nan nan\n")
        self.absent = self.folder / "absent.las"
        self.store = self.folder / "x.pfront"

    def test_stop_names_all_that_are_wrong(self):
        said = self.refuse(
            1, "build", self.broken, self.good, self.absent, self.folder / "none*.ply",
            "-o", self.store).err
        for name in ("broken.las", "absent.las", "none*.ply", "3 of 4"):
            self.assertIn(name, said)
        self.assertFalse(self.store.exists())
        self.refuse(1, "build", self.good, self.damaged, "-o", self.store)
        self.refuse(2, "build", self.good, "-o", self.store, "--on-error", "maybe")

    def test_skip_names_and_counts_each(self):
        wrong = [self.broken, self.damaged, self.empty, self.absent]
        outcome = self.succeed(
            "build", *wrong, self.good, "-o", self.store, "--on-error", "skip")
        self.assertIn("skipped 4 inputs", outcome.out)
        for path in wrong:
            self.assertIn(path.name, outcome.out)
        report = self.succeed("build", *wrong, self.good, "-o", self.store, "--force",
                              "--on-error", "skip", "--json").json
        self.assertEqual(report["points_stored"], 1065)
        self.assertEqual(sorted(skipped["path"] for skipped in report["inputs_skipped"]),
                         sorted(map(str, wrong)))
        for skipped in report["inputs_skipped"]:
            self.assertGreater(len(skipped["why"]), 5)
        self.succeed("verify", self.store)
        self.fail_after_warnings(
            "build", *wrong, "-o", self.folder / "y.pfront", "--on-error", "skip")
        sound = self.succeed("build", self.good, "-o", self.store, "--force", "--on-error",
                             "skip", "--json").json
        self.assertEqual(sound["inputs_skipped"], [])

    def test_index(self):
        said = self.refuse(1, "index", self.broken, self.good, self.absent, self.damaged).err
        for name in ("broken.las", "absent.las", "damaged.laz", "3 of 4"):
            self.assertIn(name, said)
        self.assertFalse((self.folder / "good.las.pfindex").exists())
        outcome = self.succeed(
            "index", self.broken, self.good, self.absent, self.damaged, "--on-error", "skip")
        self.assertIn("skipped 3 inputs", outcome.out)
        report = self.succeed("index", self.broken, self.good, "--on-error", "skip", "--force",
                              "--json").json
        self.assertEqual(report["points_indexed"], 1065)
        self.assertEqual(len(report["inputs_skipped"]), 1)


class Text(ToolTest):
    POINTS = [(3512345.25, 5412345.5, 123.75), (3512346.5, 5412346.0, 124.125)]

    def check(self, content, *options, name="points.txt", encoding="utf-8"):
        path = self.folder / name
        data = content.encode(encoding)
        path.write_bytes(gzip.compress(data) if name.endswith(".gz") else data)
        store = self.folder / "x.pfront"
        report = self.succeed(
            "build", path, "-o", store, "--force", "--json", *options).json
        self.assertEqual(report["points_stored"], 2)
        bounds = self.succeed("info", store, "--json").json["bounds"]
        for axis in range(3):
            values = sorted(p[axis] for p in self.POINTS)
            self.assertTrue(math.isclose(bounds[axis], values[0], abs_tol=1e-6), bounds)
            self.assertTrue(math.isclose(bounds[axis + 3], values[1], abs_tol=1e-6), bounds)

    def rows(self, separator, decimal="."):
        return "".join(separator.join(str(v).replace(".", decimal) for v in p) + "\n"
                       for p in self.POINTS)

    def test_as_people_have_it(self):
        for separator in (" ", "\t", ";"):
            for encoding in ("utf-8", "utf-8-sig", "utf-16", "utf-16-le", "latin-1"):
                for name in ("points.txt", "points.csv.gz"):
                    head = separator.join(("E", "N", "H")) + "\n"
                    self.check(head + self.rows(separator, ","), name=name, encoding=encoding)
        self.check("POINT_X,POINT_Y,POINT_Z\n" + self.rows(","))
        self.check("Points:0,Points:1,Points:2\n" + self.rows(","))
        self.check("X (m);Y (m);Z (m)\n" + self.rows(";"))
        self.check("a title, 3 4 5\n2 of them\n" + self.rows(" "), "--skip", "2")
        self.check(self.rows(";", ","), "--decimal", "comma", "--separator", "semicolon")

    def test_what_would_be_wrong_is_refused(self):
        path = self.folder / "p.csv"
        path.write_text("x,y,depth\n1,2,3\n4,5,6\n")
        self.assertIn("depth", self.refuse(1, "build", path, "-o", self.folder / "x.pfront").err)
        path.write_text("1 2 3\n" + "hello\n" * 5)
        self.assertIn("--separator",
                      self.refuse(1, "build", path, "-o", self.folder / "x.pfront").err)
        self.assertEqual(pointfront("build", path, "-o", "x", "--decimal", "dot").status, 2)


if __name__ == "__main__":
    unittest.main(verbosity=2)
