"""docs/user/limits.md: clouds at the edges of what the tool takes, up to their pictures."""

import json
import pathlib
import random
import re
import struct
import unittest
from decimal import Decimal

import numpy

from pictures import read_png
from tool import ToolTest, pointfront, write_las

BACKGROUND = "1,0,1"
# lowest coordinate, extent, step: text of so many decimals
CLOUDS = {
    "a nanometre": ("0", "1e-9", "1e-12"),
    "a micrometre": ("0", "1e-6", "1e-9"),
    "a millimetre at ten thousand kilometres": ("1e7", "1e-3", "1e-6"),
    "a metre at a million kilometres": ("1e9", "1", "1e-6"),
    "a thousand kilometres at 1e12": ("1e12", "1e6", "1"),
    "1e12 across": ("1e12", "1e12", "1e3"),
    "1e15 across": ("0", "1e15", "1e6"),
}


class LimitsTest(ToolTest):
    def cloud(self, low, extent, step, points=2000):
        """Text of points on whole steps, the same steps for all places, and its store."""
        low, step = Decimal(low), Decimal(step)
        most = int(Decimal(extent) / step)
        chance = random.Random(2)
        steps = [[chance.randint(0, most), chance.randint(0, most), chance.randint(0, most // 10)]
                 for _ in range(points)]
        path = self.folder / "cloud.xyz"
        path.write_text("".join(
            " ".join(str(low + step * n) for n in row) + "\n" for row in steps))
        store = self.folder / f"at_{low}.pfront"
        self.succeed("build", path, "-o", store, "--force", "--precision", step)
        return store, numpy.array(steps, dtype=float)

    def positions(self, store):
        out = self.folder / "out.csv"
        self.succeed("export", store, "-o", out, "--force")
        return [tuple(map(Decimal, line.split(",")[:3])) for line in
                out.read_text().splitlines()[1:]]

    def drawn(self, store, *options):
        out = self.folder / "picture.png"
        self.succeed("render", store, "-o", out, "--size", "200x150", "--point-size", 3,
                     "--backend", "software", "--background", BACKGROUND, *options)
        return read_png(out).astype(int)


class Steps(LimitsTest):
    def test_only_floating_point_input_gets_a_coarser_step(self):
        """Two files in steps of 0.01 that lie more than 2^32 of them apart, and their text."""
        ends = [(-2.1e7, -2.1e7, 0.0), (2.1e7, 2.1e7, 0.0), (2.2e7, 2.2e7, 0.0)]
        files = [write_las(self.folder / f"{name}.las", [(*p, 0, 0, 0) for p in points], 0.01, True)
                 for name, points in (("wide", ends[:2]), ("beside", ends[1:]))]
        store = self.folder / "a.pfront"
        to = ("-o", store, "--force", "--assume-crs", "EPSG:2154")
        self.succeed("build", files[0], *to)
        for precision in ((), ("--precision", "0.01")):
            refused = self.refuse(1, "build", *files, *to, *precision)
            self.assertIn("a precision of 0.1 fits", refused.err)
        self.succeed("build", *files, *to, "--precision", "0.1")
        text = self.folder / "a.xyz"
        text.write_text("".join(f"{x + 0.01:.2f} {y:.2f} {z:.2f}\n" for x, y, z in ends))
        self.assertIn("rounded to steps of", self.succeed("build", text, *to).err)


class Places(LimitsTest):
    def test_every_point_comes_back(self):
        for name, (low, extent, step) in CLOUDS.items():
            with self.subTest(name):
                store, steps = self.cloud(low, extent, step)
                told = numpy.array([[float((v - Decimal(low)) / Decimal(step)) for v in row]
                                    for row in self.positions(store)])
                # Doubles near 1e12 and beyond are a ten thousandth of a step off.
                self.assertLess(numpy.abs(numpy.sort(told, axis=0) -
                                          numpy.sort(steps, axis=0)).max(), 0.01)

    def test_the_picture_is_that_of_the_cloud_at_the_origin(self):
        for name, (low, extent, step) in CLOUDS.items():
            with self.subTest(name):
                here = self.drawn(self.cloud(low, extent, step)[0])
                unit = str(Decimal(extent) / Decimal(step) / 1000)  # a cloud of a kilometre
                there = self.drawn(self.cloud("0", str(Decimal(unit) * 1000), "1")[0])
                seen = (here != (255, 0, 255)).any(axis=2)
                self.assertGreater(seen.mean(), 0.1, "the view shows the whole cloud")
                unlike = (numpy.abs(here - there) > 8).any(axis=2)
                self.assertLess(unlike.mean(), 0.005)

    def test_one_point_is_seen_wherever_it_is(self):
        for place in ("0", "1e7", "1e12", "1e15"):
            with self.subTest(place):
                path = self.folder / "one.csv"
                path.write_text(f"x,y,z\n{place},{place},5\n")
                store = self.folder / "one.pfront"
                self.succeed("build", path, "-o", store, "--force", "--precision", 1)
                seen = (self.drawn(store) != (255, 0, 255)).any(axis=2)
                self.assertEqual(seen.sum(), 9)
                self.assertTrue(seen[75, 100], "in the middle")

    def test_a_point_beyond_1e15_is_left_out_and_told(self):
        path = self.folder / "far.csv"
        for far in ("1.1e15", "9e15", "1e16"):
            path.write_text(f"x,y,z\n0,0,0\n1,1,1\n-{far},1,1\n1,1,{far}\n")
            outcome = self.succeed("build", path, "-o", self.folder / "far.pfront", "--force")
            self.assertIn("2 outside the grid's range", outcome.err)

    def test_more_steps_than_32_bits_hold_are_refused(self):
        path = self.folder / "wide.csv"
        path.write_text("x,y,z\n0,0,0\n1000000.0001,1,1\n500000,2,2\n")
        told = self.succeed("build", path, "-o", self.folder / "wide.pfront")
        self.assertIn("they are rounded to steps of", told.err)
        refused = self.refuse(1, "build", path, "-o", self.folder / "no.pfront",
                              "--precision", "1e-4", "--assume-crs", "EPSG:2154")
        self.assertIn("0.001 fits", refused.err)


class Counts(LimitsTest):
    def test_a_header_of_2_to_the_53_points(self):
        """The points that are there are built, and the others are in the account."""
        header = bytearray(375)
        struct.pack_into("<4s20xBB", header, 0, b"LASF", 1, 4)
        struct.pack_into("<HIIBH", header, 94, 375, 375, 0, 0, 20)
        struct.pack_into("<3d3d6d", header, 131, *[0.01] * 3, *[0.0] * 3,
                         0.02, 0.0, 0.02, 0.0, 0.02, 0.0)
        struct.pack_into("<Q", header, 247, 2 ** 53)
        path = self.folder / "claim.las"
        path.write_bytes(bytes(header) + b"".join(
            struct.pack("<3iHBBBBH", i, i, i, 0, 9, 1, 0, 0, 0) for i in range(3)))
        store = self.folder / "claim.pfront"
        built = self.succeed("build", path, "-o", store, "--json", "--assume-crs", "EPSG:2154")
        self.assertEqual(built.json["points_stored"], 3)
        self.assertIn(str(2 ** 53), built.err)


    def test_a_thousand_columns(self):
        path = self.folder / "many.csv"
        for columns, status in ((1000, 0), (1001, 1)):
            names = ["x", "y", "z", *(f"a{i}" for i in range(columns - 3))]
            path.write_text(",".join(names) + "\n" + ",".join(["1"] * columns) + "\n")
            outcome = pointfront("build", path, "-o", self.folder / "many.pfront", "--force")
            self.assertEqual(outcome.status, status, outcome)
        self.assertIn("more than 1000 columns", outcome.err)

    def test_a_class_above_255(self):
        (self.folder / "c.csv").write_text("x,y,z,classification\n0,0,0,2\n1,1,1,300\n")
        store = self.folder / "c.pfront"
        build = ("build", self.folder / "c.csv", "-o", store, "--precision", "1", "--assume-crs",
                 "EPSG:25832")
        self.assertIn("one byte", self.refuse(1, *build, "--layers", "class").err)
        self.assertIn("'classification' is uint16", self.succeed(*build).err)
        refused = self.refuse(1, "export", store, "-o", self.folder / "c2.csv", "--classes", "2")
        self.assertIn("uint16", refused.err)
        for name in ("c.las", "c.copc.laz"):
            exported = self.succeed("export", store, "-o", self.folder / name)
            self.assertIn("1 values of 'classification' are beyond", exported.err)
            back = self.folder / "back.pfront"
            self.succeed("build", self.folder / name, "-o", back, "--force")
            text = self.folder / "back.csv"
            self.succeed("export", back, "-o", text, "--force")
            names, *rows = (line.split(",") for line in text.read_text().splitlines())
            columns = [names.index(n) for n in ("classification", "classification_exact")]
            self.assertEqual(sorted([row[c] for c in columns] for row in rows),
                             [["1", "300"], ["2", "2"]])
        out = self.folder / "c300.csv"
        self.succeed("export", store, "-o", out, "--where", "classification == 300")
        self.assertEqual(len(out.read_text().splitlines()), 2)

    def test_a_hundred_and_twenty_highlights(self):
        store, _ = self.cloud("0", "1", "1e-3")
        path = self.folder / "style.json"
        for count in (120, 121):
            path.write_text(json.dumps({"highlight": [
                {"class": n, "color": "#ff0000"} for n in range(count)]}))
            words = ("render", store, "-o", self.folder / "a.png", "--style", path)
            if count == 120:
                self.succeed(*words)
            else:
                self.assertIn("at most 120", self.refuse(2, *words).err)


class Records(ToolTest):
    """Variable length records of LAS files."""

    def records(self, path):
        """(owner, number) of each in a LAS file."""
        data = path.read_bytes()
        size, _, count = struct.unpack_from("<HII", data, 94)
        found, at = [], size
        for _ in range(count):
            owner, number, length = struct.unpack_from("<2x16sHH32x", data, at)
            found.append((owner.rstrip(b"\0").decode(), number))
            at += 54 + length
        return found

    def test_records_of_other_owners_are_left_out(self):
        given = [("acme", 7), ("LASF_Spec", 3)]
        path = write_las(self.folder / "a.las", [(0, 0, 0, 0, 0, 0), (1, 1, 1, 0, 0, 0)])
        data = path.read_bytes()
        own = b"".join(struct.pack("<2x16sHH32x", owner.encode(), number, 4) + b"text"
                       for owner, number in given)
        header = bytearray(data[:227])
        struct.pack_into("<II", header, 96, 227 + len(own), len(given))
        path.write_bytes(bytes(header) + own + data[227:])
        self.assertEqual(self.records(path), given)
        store = self.folder / "a.pfront"
        built = self.succeed("build", path, "-o", store, "--assume-crs", "EPSG:2154")
        self.assertEqual(built.err, "")
        self.succeed("export", store, "-o", self.folder / "b.las")
        owners = self.records(self.folder / "b.las")
        self.assertIn(given[1], owners)
        self.assertNotIn(given[0], owners)


class Views(LimitsTest):
    def camera(self, store, angle):
        low, high = numpy.split(
            numpy.array(self.succeed("info", store, "--json").json["bounds"]), 2)
        middle = (low + high) / 2
        away = numpy.linalg.norm(high - low) / 2 / numpy.tan(numpy.radians(angle / 2))
        path = self.folder / "camera.json"
        path.write_text(json.dumps({
            "position": (middle + away * numpy.array([1, -1, 1]) / 3 ** 0.5).tolist(),
            "focal_point": middle.tolist(), "view_up": [0, 0, 1], "view_angle": angle}))
        return path

    def test_angles_from_a_hundredth_to_170_degrees(self):
        """As far as they are alike: the narrower the view, the less perspective has it."""
        store, _ = self.cloud("1e7", "1", "1e-3")
        narrow = self.drawn(store, "--camera", self.camera(store, 0.1))
        narrower = self.drawn(store, "--camera", self.camera(store, 0.01))
        self.assertLess((numpy.abs(narrow - narrower) > 8).any(axis=2).mean(), 0.05)
        wide = self.drawn(store, "--camera", self.camera(store, 170))
        self.assertGreater((wide != (255, 0, 255)).any(axis=2).mean(), 0.01)

    def test_angles_that_are_none_are_refused(self):
        store, _ = self.cloud("0", "1", "1e-3")
        path = self.camera(store, 30)
        for angle in (0, -1, 180, 400):
            path.write_text(json.dumps({**json.loads(path.read_text()), "view_angle": angle}))
            self.refuse(1, "render", store, "-o", self.folder / "no.png", "--camera", path)

    def test_parallel_views(self):
        store, _ = self.cloud("0", "1", "1e-3")
        path = self.camera(store, 30)
        camera = json.loads(path.read_text())
        del camera["view_angle"]
        for scale in (0, -1, 1e16):
            path.write_text(json.dumps({**camera, "parallel_scale": scale}))
            self.refuse(1, "render", store, "-o", self.folder / "no.png", "--camera", path)

    def test_pictures_of_one_pixel_and_of_65535(self):
        store, _ = self.cloud("0", "1", "1e-3")
        for size in ("1x1", "65535x1", "1x65535"):
            out = self.folder / "picture.png"
            self.succeed("render", store, "-o", out, "--size", size)
            width, height = map(int, size.split("x"))
            self.assertEqual(struct.unpack(">II", out.read_bytes()[16:24]), (width, height))
        self.refuse(2, "render", store, "-o", out, "--size", "65536x1")


class Page(unittest.TestCase):
    def test_every_test_that_the_page_names_is_there(self):
        root = pathlib.Path(__file__).resolve().parents[2]
        rows = [line.split("|") for line in (root / "docs/user/limits.md").read_text().splitlines()
                if line.startswith("|")]
        named = {name for row in rows for name in re.findall("`([^`]+)`", row[-2])}
        self.assertGreater(len(named), 5)
        lists = (root / "Testing/Whole/CMakeLists.txt").read_text()
        whole = set(re.findall(r'(Whole\.\w+)(?:"| READS)', lists)) | {
            f"Whole.{name}" for names in re.findall(r"^ *whole_tests\(([\w ]+)\)", lists, re.M)
            for name in names.split()}
        kinds = {kind for path in root.glob("*/**/Testing/**/*.cxx")
                 if "build" not in path.relative_to(root).parts
                 for kind in re.findall(r"^TEST(?:_F)?\((\w+),", path.read_text(), re.M)}
        style = (root / "Testing/Style/CMakeLists.txt").read_text()
        for name in named:
            there = (root / name).is_file() if name.startswith("scripts/") else \
                name in style if name.startswith("Style.") else \
                name in whole or name in kinds or name.endswith("Benchmark")
            self.assertTrue(there, name)


if __name__ == "__main__":
    unittest.main()
