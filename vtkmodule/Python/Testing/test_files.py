"""Exports and pictures as files: which points, how far they are, and what messages name."""

import os
import pathlib
import re
import shutil
import tempfile
import unittest
import warnings

import numpy
import pointfront

CLOUD = pathlib.Path(__file__).resolve().parents[3] / "Testing/Data/autzen_stadium.laz"


class Files(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="pointfront-files-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            pointfront.build(CLOUD, cls.folder / "a.pfront", preview=False, node_points=5000)
        cls.cloud = pointfront.open(cls.folder / "a.pfront")

    def test_files_have_the_points_of_an_area(self):
        target = self.folder / "area.las"
        low, high = map(numpy.array, self.cloud.bounds)
        (x0, y0), (x1, y1) = low[:2], (low + high)[:2] / 2
        area = f"POLYGON (({x0} {y0}, {x1} {y0}, {x1} {y1}, {x0} {y0}))"
        line = f"LineString ({x0} {y0}, {x1} {y1})"
        for query in ({"area": area}, {"area": area, "where": "intensity > 50"},
                      {"area": line, "line_distance": 20},
                      {"area": line, "line_distance": numpy.float32(20), "where": "z > 430"}):
            ids = self.cloud.points(attributes=[], **query)["id"]
            self.assertTrue(0 < len(ids) < len(self.cloud), query)
            self.assertEqual(self.cloud.export(target, overwrite=True, **query), len(ids), query)
        target.unlink()
        for query, problem, says in (
                ({"area": line}, ValueError, "line_distance"),
                ({"line_distance": 3}, ValueError, "line_distance"),
                ({"area": 3}, TypeError, "area"),
                ({"area": area, "polygon": "a.geojson"}, TypeError, "`area` or `polygon`"),
                ({"area": "POLYGON"}, pointfront.PointFrontError, "^pointfront export: area:"),
                ({"attributes": ["intensity"]}, TypeError, "attributes.*build"),
                ({"color_depht": 8}, pointfront.PointFrontError, "'color_depht'"),
                ({"stats": True}, TypeError, "stats=True")):
            with self.subTest(query=query), self.assertRaisesRegex(problem, says):
                self.cloud.export(target, **query)
            self.assertFalse(target.exists())

    def test_files_tell_how_far_they_are(self):
        target = self.folder / "told.copc.laz"
        told = []
        count = self.cloud.export(target, progress=lambda *step: told.append(step))
        self.assertEqual(count, len(self.cloud))
        self.assertEqual(told[-1][1], 1.0)
        self.assertTrue(all(0.0 <= part <= 1.0 for _, part in told), told)
        target.unlink()
        for stop in (False, numpy.False_):
            with self.assertRaisesRegex(pointfront.PointFrontError, "told.copc.laz.*stopped"):
                self.cloud.export(target, progress=lambda *_, stop=stop: stop)
        before = sorted(self.folder.iterdir())

        class Problem(Exception):
            pass

        def fail(_phase, _fraction):
            raise Problem

        with self.assertRaises(Problem):
            self.cloud.export(target, progress=fail)
        self.assertEqual(sorted(self.folder.iterdir()), before)
        self.cloud.export(target, progress=False)
        for progress in (print, True):
            with self.assertRaisesRegex(TypeError, "progress"):
                self.cloud.screenshot(progress=progress)

    def test_a_long_file_stops_on_its_way(self):
        """The tool tells phases while it works, and is stopped by the answer to one of them."""
        rows = {"position": numpy.random.default_rng(3).random((2_000_000, 3)) * 1000}
        pointfront.build(rows, self.folder / "long.pfront", precision=0.001, preview=False)
        target = self.folder / "long.copc.laz"
        told = []

        def watch(phase, fraction):
            told.append((phase, fraction))
            return not 0.0 < fraction < 1.0

        with pointfront.open(self.folder / "long.pfront") as cloud:
            with self.assertRaisesRegex(pointfront.PointFrontError, "stopped"):
                cloud.export(target, progress=watch)
        self.assertTrue(told[-1][0])
        self.assertTrue(0.0 < told[-1][1] < 1.0, told)
        self.assertFalse(target.exists())

    def test_messages_name_the_arguments_of_python(self):
        target = self.folder / "there.las"
        self.cloud.export(target)
        for ask, says in ((lambda: self.cloud.export(target), "overwrite=True"),
                          (lambda: self.cloud.screenshot(stats=True), "stats=True"),
                          (lambda: self.cloud.screenshot(colour_by="z"), "colour_by"),
                          (lambda: self.cloud.screenshot(view="up"), "view")):
            with self.subTest(says=says), self.assertRaisesRegex(
                    (pointfront.PointFrontError, TypeError), says) as raised:
                ask()
            self.assertNotIn("--", str(raised.exception))

    def test_options_without_a_value_are_those_of_the_tool(self):
        from pointfront import _pictures

        for command, known in _pictures.FLAGS.items():
            help_text = _pictures.run_tool([command, "--help"]).decode()
            flags = set(re.findall(r"^  (?:-., *)?--([a-z-]+)(?: (?:Ex|Needs).*)?  ", help_text,
                                   re.MULTILINE)) - {"help"}
            flags |= set(re.findall(r"^  --([a-z-]+)(?: Excludes: .*)?$", help_text, re.MULTILINE))
            self.assertEqual(flags, known, command)

    def test_a_picture_is_a_png_file(self):
        picture = self.cloud.screenshot(size=(64, 48))
        for name in ("s.jpg", "s", "s.png.jpeg", b"s.tif"):
            for write in (picture.save, self.cloud.screenshot):
                with self.assertRaisesRegex(pointfront.PointFrontError, "must end in .png"):
                    write(self.folder / os.fsdecode(name))
        self.assertEqual(list(self.folder.glob("s.*")), [])
        picture.save(self.folder / "s.PNG")
        self.assertEqual((self.folder / "s.PNG").read_bytes(), picture.png)

    def test_pictures_of_opengl_have_pixels(self):
        """The test has an X server."""
        pixels = [self.cloud.screenshot(size=(160, 120), backend=backend).pixels.astype(int)
                  for backend in ("software", "opengl")]
        self.assertEqual(pixels[1].shape, (120, 160, 3))
        self.assertLess(abs(pixels[0] - pixels[1]).mean(), 3)


if __name__ == "__main__":
    unittest.main(verbosity=2)
