"""Exports come back as they were and as their readers expect them; messages say what is so."""

import datetime
import struct
import unittest

from test_left_out import las_steps
from tool import DATA, ToolTest, pointfront, write_las

SMALL = DATA / "las/real/1.2-with-color.las"
POINTS = 1065
KINDS = ("las", "laz", "xyz", "csv", "ply", "pcd")


class Exports(ToolTest):
    def export(self, store, name, *options):
        out = self.folder / name
        return out, self.succeed("export", store, "-o", out, "--force", *options)

    def test_every_pair_of_formats_keeps_the_integers(self):
        expected = las_steps(SMALL)
        first = self.build(SMALL)
        for one in KINDS:
            middle, _ = self.export(first, f"one.{one}")
            self.succeed("build", middle, "-o", self.folder / "two.pfront", "--force")
            for other in KINDS:
                last, _ = self.export(self.folder / "two.pfront", f"two.{other}")
                self.succeed("build", last, "-o", self.folder / "three.pfront", "--force")
                back, _ = self.export(self.folder / "three.pfront", "back.las")
                scale = struct.unpack_from("<3d", back.read_bytes(), 131)
                offset = struct.unpack_from("<3d", back.read_bytes(), 155)
                got = sorted(tuple(round((p[a] * scale[a] + offset[a]) * 100) for a in range(3))
                             for p in las_steps(back))
                self.assertEqual(got, expected, (one, other))

    def test_pcd_is_what_pcl_reads(self):
        store = self.build(SMALL)
        out, outcome = self.export(store, "x.pcd")
        header = out.read_bytes()[:600].decode("ascii", "replace")
        self.assertIn("FIELDS x y z intensity", header)
        self.assertIn("\nSIZE 4 4 4 4", header)
        self.assertIn("\nTYPE F F F F", header)
        origin = header.split("# ORIGIN ")[1].split("\n")[0]
        self.assertIn(origin, outcome.err)
        out, outcome = self.export(store, "x.pcd", "--double")
        self.assertIn("SIZE 8 8 8", out.read_bytes()[:600].decode("ascii", "replace"))
        self.assertEqual(outcome.err, "")

    def test_colours_have_the_bits_that_readers_expect(self):
        """16-bit colours in PLY and PCD: 8 bits unless asked, told where that rounds them."""
        colours = [(0x1200, 0x3400, 0x5600), (0x1234, 0, 0)]
        las = write_las(self.folder / "a.las",
                        [(0.0, 0.0, 0.0, *colours[0]), (1.0, 1.0, 1.0, *colours[1])])
        store = self.build(las)
        for kind in ("ply", "pcd"):
            for options, wanted in (((), [(0x12, 0x34, 0x56), (0x12, 0, 0)]),
                                    (("--color-depth", "16"), colours)):
                out, outcome = self.export(store, f"x.{kind}", *options)
                self.assertEqual("rounds those of 1 points" in outcome.err, not options)
                self.succeed("build", out, "-o", self.folder / "b.pfront", "--force")
                back, _ = self.export(self.folder / "b.pfront", "b.csv")
                lines = [line.split(",") for line in back.read_text().splitlines()]
                at = [lines[0].index(c) for c in ("red", "green", "blue")]
                rows = sorted(tuple(int(row[k]) for k in at) for row in lines[1:])
                self.assertEqual(rows, sorted(wanted), (kind, options))
        out, outcome = self.export(store, "x.csv", "--color-depth", "8")
        self.assertTrue(any(line.endswith(",18,52,86") for line in out.read_text().splitlines()))

    def test_names_dates_and_nothing(self):
        store = self.build(SMALL, name="a.pfront")
        self.succeed("build", SMALL, "-o", self.folder / "n.pfront", "--normals", "pca")
        for kind, separator in (("xyz", " "), ("csv", ",")):
            out, _ = self.export(self.folder / "n.pfront", f"n.{kind}")
            self.assertIn(separator.join(("nx", "ny", "nz")), out.read_text().splitlines()[0])
        out, _ = self.export(self.folder / "n.pfront", "n.ply")
        self.assertIn(b" nx\n", out.read_bytes()[:2000])
        out, _ = self.export(store, "x.las")
        day, year = struct.unpack_from("<2H", out.read_bytes(), 90)
        written = datetime.date(year, 1, 1) + datetime.timedelta(day - 1)
        today = datetime.datetime.now(datetime.timezone.utc).date()
        self.assertLess(abs((today - written).days), 2)
        out, outcome = self.export(store, "none.las", "--box", "0,0,0,1,1,1")
        self.assertIn("no point", outcome.err)
        self.assertIn("0 points", outcome.out)

    def test_names_that_change_are_told_and_right_ones_stay(self):
        """The first of "a b" and "a_b" took the name that the second one has."""
        rows = "x,y,z,a b,a_b,wärme\n" + "".join(f"{k},{k},0,{k},{k + 100},{k + 7}\n"
                                                for k in range(10))
        text = self.folder / "in.csv"
        text.write_text(rows, encoding="utf-8")
        store = self.build(text)
        for kind, warm in (("csv", "wärme"), ("xyz", "wärme"), ("ply", "w__rme"),
                           ("pcd", "w__rme")):
            out, outcome = self.export(store, f"n.{kind}")
            told = "The attribute 'a b' is written as 'a_b_2'."
            self.assertEqual(outcome.err.count(told), 1, outcome.err)
            self.assertEqual(outcome.err.count("is written as"), 1 + (warm != "wärme"))
            self.assertEqual(f"'wärme' is written as '{warm}'" in outcome.err, warm != "wärme")
            self.succeed("build", out, "-o", self.folder / "b.pfront", "--force")
            back, _ = self.export(self.folder / "b.pfront", "b.csv")
            lines = [line.split(",") for line in back.read_text(encoding="utf-8").splitlines()]
            at = [lines[0].index(c) for c in ("x", "a_b", "a_b_2", warm)]
            for row in lines[1:]:
                x, kept, other, heat = (int(float(row[k])) for k in at)
                self.assertEqual((kept, other, heat), (x + 100, x, x + 7), kind)

    def test_names_of_las_have_32_bytes(self):
        """Two names with the same beginning were one name in the file, without a word."""
        begin = "a_name_of_thirty_bytes_is_here"
        long, other, right = begin + "_one", begin + "_other", begin + "_2"
        text = self.folder / "in.csv"
        text.write_text(f"x,y,z,{long},{right},{other}\n" +
                        "".join(f"{k},{k},0,{k},{k + 100},{k + 7}\n" for k in range(10)))
        store = self.build(text)
        for kind in ("las", "laz", "copc.laz"):
            out, outcome = self.export(store, f"n.{kind}")
            for name, written in ((long, begin + "_o"), (other, begin + "_3")):
                told = f"The attribute '{name}' is written as '{written}': LAS has 32 bytes"
                self.assertEqual(outcome.err.count(told), 1, outcome.err)
            self.assertEqual(outcome.err.count("is written as"), 2)
            self.succeed("build", out, "-o", self.folder / "b.pfront", "--force")
            back, _ = self.export(self.folder / "b.pfront", "b.csv")
            lines = [line.split(",") for line in back.read_text().splitlines()]
            at = [lines[0].index(c) for c in ("x", begin + "_o", right, begin + "_3")]
            self.assertEqual(len(lines), 11)
            for row in lines[1:]:
                x, one, kept, last = (int(float(row[k])) for k in at)
                self.assertEqual((one, kept, last), (x, x + 100, x + 7), kind)

    def test_coordinates_are_transformed(self):
        las = write_las(self.folder / "a.las", [(500000.0, 5600000.0, 100.0, 0, 0, 0),
                                                (500010.0, 5600010.0, 110.0, 0, 0, 0)])
        store = self.folder / "a.pfront"
        self.succeed("build", las, "-o", store, "--assume-crs", "EPSG:25832")
        out, _ = self.export(store, "wgs.csv", "--crs", "EPSG:4326")
        rows = sorted(tuple(map(float, line.split(",")[:3]))
                      for line in out.read_text().splitlines()[1:])
        self.assertAlmostEqual(rows[0][0], 9.0, places=6)  # the middle of zone 32
        self.assertAlmostEqual(rows[0][1], 50.55, delta=0.05)
        self.assertEqual(rows[0][2], 100.0)
        bare = self.build(las, name="bare.pfront")
        self.assertIn("--assume-crs", self.refuse(
            1, "export", bare, "-o", self.folder / "b.las", "--crs", "EPSG:4326").err)
        self.refuse(1, "export", store, "-o", self.folder / "b.las", "--crs", "EPSG:nothing")

    def test_gps_times_of_two_kinds_go_into_no_las_file(self):
        content = bytearray(SMALL.read_bytes())
        content[6] |= 1  # standard GPS times
        standard = self.folder / "standard.las"
        standard.write_bytes(content)
        both = self.folder / "both.pfront"
        outcome = self.succeed("build", SMALL, standard, "-o", both)
        self.assertIn("are standard GPS times", outcome.err)
        tiles = self.folder / "tiles"
        tiles.mkdir()
        for name, path in (("week", SMALL), ("standard", standard)):
            outcome = self.succeed("build", path, "-o", tiles / f"{name}.pfront")
            self.assertNotIn("GPS", outcome.err)
        city = self.folder / "city.pfcollection"
        self.succeed("collection", "create", city, tiles)
        for cloud in (both, tiles, city):
            for name in ("two.las", "two.copc.laz"):
                outcome = pointfront("export", cloud, "-o", self.folder / name)
                self.assertEqual(outcome.status, 1)
                self.assertIn("GPS times of two kinds", outcome.err)
                self.assertFalse((self.folder / name).exists())
        self.succeed("build", both, "-o", self.folder / "none.pfront", "--attributes", "intensity")
        self.export(self.folder / "none.pfront", "none.las")
        alone = self.folder / "alone.pfcollection"
        self.succeed("collection", "create", alone, tiles / "standard.pfront")
        for cloud, bit in ((tiles / "week.pfront", 0), (tiles / "standard.pfront", 1), (alone, 1)):
            out, _ = self.export(cloud, "one.las")
            self.assertEqual(out.read_bytes()[6] & 1, bit, cloud)

    def test_inputs_without_points_choose_neither_grid_nor_attributes(self):
        """One that has colours made all points of the others black, in steps of its own."""
        empty = write_las(self.folder / "empty.las", [(1e6, 0.0, 0.0, 1, 2, 3)], scale=1e-5)
        data = bytearray(empty.read_bytes()[:227])
        struct.pack_into("<2I", data, 107, 0, 0)
        empty.write_bytes(data)
        rows = self.folder / "rows.xyz"
        rows.write_text("".join(f"{x / 8} {x % 5 / 8} 0.5\n" for x in range(50)))
        alone = self.build(rows, name="alone.pfront")
        for inputs in ((empty, rows), (rows, empty)):
            together = self.folder / "together.pfront"
            outcome = self.succeed("build", *inputs, "-o", together, "--force")
            self.assertNotIn("rgb", outcome.err)
            told, expected = (self.succeed("info", store, "--json").json
                              for store in (together, alone))
            for key in ("points", "precision", "attributes", "bounds"):
                self.assertEqual(told[key], expected[key], key)
        for more in ((), ("--tiles",)):
            said = self.refuse(1, "build", empty, rows, "-o", self.folder / "named.pfront",
                               "--attributes", "rgb", "--assume-crs", "EPSG:25832", *more).err
            self.assertIn("has an attribute 'rgb'" if more
                          else "only inputs without points have an attribute 'rgb'", said)
        self.build(empty, name="empty.pfront")
        stores = [self.folder / f"{name}.pfront" for name in ("empty", "alone")]
        self.succeed("build", *stores, "-o", together, "--force")
        listed = self.folder / "all.pfronts"
        listed.write_text("empty.pfront\nalone.pfront\n")
        self.succeed("build", listed, "-o", self.folder / "of-list.pfront")
        for cloud in (together, listed, self.folder / "of-list.pfront"):
            told = self.succeed("info", "--together", cloud, "--json").json
            for key in ("points", "precision", "attributes", "bounds"):
                self.assertEqual(told[key], expected[key], key)

    def test_inputs_without_points_do_not_choose_the_kind_of_gps_times(self):
        """Neither files that have none, nor those whose points all lie outside of the box."""
        week = bytearray(SMALL.read_bytes())
        self.assertEqual(week[6] & 1, 0)
        standard = self.folder / "standard.las"
        standard.write_bytes(week[:6] + bytes([week[6] | 1]) + week[7:])
        empty = self.folder / "aempty.las"  # its kind is that of the first input
        self.succeed("build", SMALL, "-o", self.folder / "week.pfront")
        self.export(self.folder / "week.pfront", "aempty.las", "--box", "0,0,0,1,1,1")
        self.succeed("build", empty, "-o", self.folder / "empty.pfront")
        away = bytearray(week)  # its header has the bounds of points that are elsewhere
        struct.pack_into("<d", away, 155, struct.unpack_from("<d", away, 155)[0] + 5000.0)
        (self.folder / "away.las").write_bytes(away)
        box = self.succeed("info", self.folder / "week.pfront", "--json").json["bounds"]
        self.assertEqual(len(box), 6)
        cases = [("one", (empty, standard), ()), ("two", (standard, empty), ()),
                 ("stores", (self.folder / "empty.pfront", standard), ()),
                 ("box", (self.folder / "away.las", standard),
                  ("--box", ",".join(map(repr, box))))]
        for name, inputs, options in cases:
            store = self.folder / f"{name}.pfront"
            outcome = self.succeed("build", *inputs, "-o", store, *options)
            self.assertNotIn("GPS", outcome.err, name)
            out, _ = self.export(store, f"{name}.las")
            self.assertEqual(out.read_bytes()[6] & 1, 1, name)
        folder = self.folder / "tiles"
        outcome = self.succeed("build", empty, standard, "-o", folder, "--tiles", "--tile", "1000")
        self.assertNotIn("GPS", outcome.err)
        city, = folder.glob("*.pfcollection")
        out, _ = self.export(city, "city.las")
        self.assertEqual(out.read_bytes()[6] & 1, 1)

    def test_an_epoch_has_its_own_gps_times_and_attributes(self):
        """And not those of the other epochs' tiles."""
        standard = bytearray(SMALL.read_bytes())
        standard[6] |= 1
        (self.folder / "standard.las").write_bytes(standard)
        self.succeed("build", SMALL, "-o", self.folder / "week.pfront")
        self.succeed("build", self.folder / "standard.las", "-o", self.folder / "standard.pfront",
                     "--attributes", "gps_time,intensity")
        city = self.folder / "city.pfcollection"
        self.succeed("collection", "create", city, self.folder / "week.pfront", "--epoch", "old")
        told = self.succeed("collection", "add", city, self.folder / "standard.pfront",
                            "--epoch", "new")
        self.assertIn("both kinds", told.err)
        self.assertIn("1 of 2 stores lack", told.err)
        refused = pointfront("export", city, "-o", self.folder / "a.las")
        self.assertEqual(refused.status, 1)
        self.assertIn("GPS times of two kinds", refused.err)
        for epoch, bit in (("old", 0), ("new", 1)):
            for name in ("a.las", "a.copc.laz"):
                out, outcome = self.export(city, name, "--epoch", epoch)
                self.assertEqual(out.read_bytes()[6] & 1, bit, (epoch, name))
                self.assertNotIn("GPS", outcome.err)
                self.assertNotIn("lack", outcome.err)
            self.assertEqual("No store of this epoch has" in outcome.err, epoch == "new")
            alone = "week" if epoch == "old" else "standard"
            texts = [self.export(*of)[0].read_text().splitlines() for of in (
                (city, "epoch.csv", "--epoch", epoch),
                (self.folder / f"{alone}.pfront", "alone.csv"))]
            self.assertEqual(*map(sorted, texts))
            self.assertEqual("red" in texts[0][0], epoch == "old")
            names = [[a["name"] for a in self.succeed("info", *of, "--json").json["attributes"]]
                     for of in ((city, "--epoch", epoch), (self.folder / f"{alone}.pfront",))]
            self.assertEqual(*names)

    def test_transformed_coordinates_get_steps_that_fit(self):
        """6.5 degrees in 32 bits: steps of 1e-8, 1.1 mm."""
        rows = [(292000.0, 6833000.0, 50.0), (770000.0, 6277000.0, 60.0)]
        text = self.folder / "wide.csv"
        for precision, status in (("0.01", 0), ("0.001", 0), ("0.0002", 1)):
            text.write_text("x,y,z\n" + "".join("%r,%r,%r\n" % row for row in rows))
            store = self.folder / "wide.pfront"
            self.succeed("build", text, "-o", store, "--assume-crs", "EPSG:2154", "--force",
                         "--precision", precision)
            out = self.folder / "wide.las"
            outcome = pointfront("export", store, "-o", out, "--crs", "EPSG:4326", "--force")
            self.assertEqual(outcome.status, status, outcome)
            if status == 0:
                steps = struct.unpack_from("<3d", out.read_bytes(), 131)
                self.assertEqual(steps[0], 1e-8)
                self.assertEqual("step of x is 1e-08" in outcome.err, precision == "0.001")
            else:
                self.assertIn("1e-08 is the finest step", outcome.err)
            exact, _ = self.export(store, "wide.xyz", "--crs", "EPSG:4326")
            if status == 0:
                self.succeed("build", out, "-o", self.folder / "back.pfront", "--force")
                back, _ = self.export(self.folder / "back.pfront", "back.xyz")
                places = [sorted(tuple(map(float, line.split()[:3]))
                                 for line in path.read_text().splitlines()
                                 if line[0] in "-0123456789")
                          for path in (exact, back)]
                self.assertEqual(len(places[1]), 2)
                for one, other in zip(*places):
                    for a, b in zip(one, other):
                        self.assertAlmostEqual(a, b, delta=0.51e-8)

    def test_angles_that_are_no_whole_degrees_get_a_format_of_fine_steps(self):
        text = self.folder / "a.csv"
        for angles, point_format, said in (
                ((-7, 12), 0, ""), ((-7.5, 12), 6, ""),
                ((-7.4, 12), 6, "1 scan angles are rounded"),
                ((-7, 100), 6, "2 scan angles are rounded")):
            text.write_text("x,y,z,scan_angle\n0,0,0,%g\n1,1,1,%g\n" % angles)
            self.succeed("build", text, "-o", self.folder / "a.pfront", "--force")
            out, outcome = self.export(self.folder / "a.pfront", "a.las")
            self.assertEqual(out.read_bytes()[104], point_format, angles)
            self.assertIn(said, outcome.err)
            self.assertEqual("rounded" in outcome.err, said != "")


class Messages(ToolTest):
    def usage(self, *arguments):
        return self.refuse(2, *arguments).err

    def test_mistyped_words_are_answered_with_what_was_meant(self):
        out = ("-o", self.folder / "x.pfront")
        self.assertIn("--structure", self.usage("build", SMALL, *out, "--structur", "octree"))
        self.assertIn("--threads", self.usage("build", SMALL, *out, "--treads", "2"))
        outcome = pointfront("biuld", SMALL)
        self.assertEqual(outcome.status, 2)
        self.assertIn("'build'", outcome.err)

    def test_numbers_out_of_range_are_short(self):
        out = ("-o", self.folder / "x.pfront")
        for option, value in (("--memory", "99999999999999G"), ("--memory", "0"),
                              ("--memory", "1e300"), ("--precision", "1e300"),
                              ("--precision", "1e309"),
                              ("--precision", "nan"), ("--skip", "-1"), ("--skip", "1e99"),
                              ("--local-height-radius", "1e300")):
            outcome = pointfront("build", SMALL, *out, "--local-height", option, value)
            self.assertIn(outcome.status, (1, 2))
            last = outcome.err.splitlines()[-1]
            self.assertLess(len(last), 300, last)
            self.assertNotIn("is not a size", last)
            self.assertFalse((self.folder / "x.pfront").exists())

    def test_files_that_are_nothing(self):
        for name in ("x.las", "x.laz", "x.ply", "x.pcd", "x.xyz"):
            path = self.folder / name
            path.touch()
            self.assertIn("empty", self.refuse(
                1, "build", path, "-o", self.folder / "x.pfront").err)
        self.assertIn("empty", self.refuse(1, "index", self.folder / "x.las").err)

    def test_options_with_many_names_leave_the_inputs_alone(self):
        ortho = DATA / "ortho/autzen/autzen.jpg"
        outcome = self.succeed("build", "-o", self.folder / "x.pfront", "--color-from", ortho,
                               DATA / "las/real/autzen_trim.las")
        self.assertIn("110000 points", outcome.out)
        self.refuse(2, "build", "-o", self.folder / "y.pfront", "--color-from", ortho)

    def test_a_scanned_turtle_is_not_on_the_globe(self):
        path = self.folder / "turtle.xyz"
        path.write_text("".join(f"{10 + i * 1e-6:.6f} {20 + i % 997 * 3e-3:.6f} {i % 13:.6f}\n"
                                for i in range(3000)))
        outcome = self.succeed("build", path, "-o", self.folder / "x.pfront")
        self.assertNotIn("longitude", outcome.err)


if __name__ == "__main__":
    unittest.main(verbosity=2)
