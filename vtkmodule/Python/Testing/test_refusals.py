"""Refusals of Python's functions, before anything is written."""

import pathlib
import shutil
import tempfile
import unittest
import warnings

import numpy
import pointfront


class Refusals(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="pointfront-refusals-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        xyz = numpy.arange(300.0).reshape(100, 3)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            pointfront.build({"position": xyz}, cls.folder / "a.pfront", preview=False)
        cls.cloud = pointfront.open(cls.folder / "a.pfront")

    def test_axes_that_are_no_vectors_are_refused(self):
        """The kernel read bytes of a grid as positions, three by three."""
        x, y = numpy.meshgrid(numpy.arange(100.0), numpy.arange(50.0))
        grid = {"x": x, "y": y, "z": 0 * x + 7}
        table = numpy.zeros((1, 40), [("x", "f8"), ("y", "f8"), ("z", "f8")])
        target = self.folder / "grid.pfront"
        for points, shape in ((grid, r"\(50, 100\)"), (table, r"\(1, 40\)"), (table.T, "40, 1"),
                              (table.reshape(20, 2), "20, 2"), ({**grid, "x": 1.0}, r"\(\)"),
                              ({"x": [1, 2], "y": [1, 2], "z": [1]}, r"\(2,\), \(1,\)")):
            with self.assertRaisesRegex(ValueError, f"{shape}.*ravel"):
                pointfront.build(points, target)
        self.assertFalse(target.exists())
        flat = {name: values.ravel() for name, values in grid.items()}
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            pointfront.build(flat, target, preview=False)
        with pointfront.open(target) as cloud:
            position = cloud.points()["position"]
        self.assertEqual(len(position), 5000)
        self.assertEqual(set(position[:, 2]), {7.0})

    def test_an_address_is_no_output(self):
        xyz = {"position": numpy.zeros((3, 3))}
        picture = self.cloud.screenshot(size=(16, 16))
        for place in ("s3://bucket/a", "http://localhost:9/a"):
            for write in (lambda: pointfront.build(xyz, f"{place}.pfront"),
                          lambda: pointfront.index("a.las", f"{place}.pfindex"),
                          lambda: self.cloud.export(f"{place}.las"),
                          lambda: self.cloud.screenshot(f"{place}.png", size=(16, 16)),
                          lambda: picture.save(f"{place}.png")):
                with self.assertRaisesRegex(pointfront.PointFrontError, "is an address.*upload"):
                    write()
        self.assertFalse(pathlib.Path("s3:").exists() or pathlib.Path("http:").exists())

    def test_an_option_that_would_do_nothing_is_refused(self):
        xyz = {"position": numpy.zeros((3, 3))}
        for options, says in (({"local_height_radius": 2.0}, "local_height=True"),
                              ({"ground_cell": 2.0, "height_above_ground": False}, "above_ground"),
                              ({"node_points": 255}, "node_points.*256")):
            with self.assertRaisesRegex(ValueError, says):
                pointfront.build(xyz, self.folder / "none.pfront", **options)
        with self.assertRaisesRegex(ValueError, "node_points.*256"):
            pointfront.index(self.folder / "none.las", node_points=16)

    def test_a_picture_without_a_folder_is_an_error_of_the_package(self):
        with self.assertRaisesRegex(pointfront.PointFrontError, "nodir/x.png' cannot be written"):
            self.cloud.screenshot(self.folder / "nodir/x.png", size=(16, 16))


if __name__ == "__main__":
    unittest.main(verbosity=2)
