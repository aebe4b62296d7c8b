"""The Python package: calls that raise, a free interpreter, interrupts, versions, stubs."""

import ast
import os
import pathlib
import shutil
import signal
import struct
import tempfile
import threading
import time
import unittest

import numpy
import pointfront

DATA = pathlib.Path(os.environ["POINTFRONT_SHARED_DATA"])
SMALL = DATA / "las/real/1.2-with-color.las"  # 1,065 points
LARGE = DATA / "large/autzen_10653336_rgb_intensity.laz"  # seconds of work


class Package(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="pointfront-python-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def test_version_and_documentation(self):
        self.assertRegex(pointfront.__version__, r"^[0-9]+[.][0-9]+[.][0-9]+$")
        for name in ("build", "index", "open", "Cloud", "BuildReport", "PointFrontError"):
            self.assertTrue(getattr(pointfront, name).__doc__, name)

    def test_stubs_name_what_there_is(self):
        folder = pathlib.Path(pointfront.__file__).parent
        self.assertTrue((folder / "py.typed").exists())
        tree = ast.parse((folder / "__init__.pyi").read_text())
        kinds = (ast.FunctionDef, ast.ClassDef)
        names = [node.name for node in tree.body
                 if isinstance(node, kinds) and node.name != "__getattr__"]
        self.assertGreater(len(names), 4)
        for name in names:
            self.assertTrue(hasattr(pointfront, name), name)
        for node in tree.body:
            if isinstance(node, ast.ClassDef) and node.name == "Cloud":
                for member in node.body:
                    self.assertTrue(hasattr(pointfront.Cloud, member.name), member.name)

    def test_build_open_query(self):
        phases = []
        report = pointfront.build(SMALL, self.folder / "a.pfront", structure="kdtree",
                                  node_points=256, progress=lambda p, f: phases.append((p, f)))
        self.assertEqual((report.points_read, report.points_stored), (1065, 1065))
        self.assertTrue(phases)
        cloud = pointfront.open(self.folder / "a.pfront")
        self.assertEqual(len(cloud), 1065)
        self.assertIn("intensity", cloud.attributes)
        arrays = cloud.query()
        self.assertEqual(arrays["position"].shape, (1065, 3))
        self.assertEqual(arrays["position"].dtype, numpy.float64)
        low, high = cloud.bounds
        numpy.testing.assert_allclose(arrays["position"].min(axis=0), low)
        numpy.testing.assert_allclose(arrays["position"].max(axis=0), high)
        bright = cloud.query(where="intensity > 100")
        self.assertEqual(len(bright["id"]), int((arrays["intensity"] > 100).sum()))
        again = pointfront.build(self.folder / "a.pfront", self.folder / "b.pfront")
        self.assertEqual(again.points_stored, 1065)

    def test_lists_folders_and_trees_open(self):
        pointfront.build(SMALL, self.folder / "a.pfront")
        (self.folder / "all.pfronts").write_text("a.pfront\n")
        for path in (self.folder, self.folder / "all.pfronts"):
            self.assertEqual(len(pointfront.open(path)), 1065)
        self.assertEqual(len(pointfront.open(DATA / "copc/1.2-with-color.copc.laz")), 1065)
        self.assertEqual(len(pointfront.open(DATA / "ept/lone-star-laszip/ept.json")), 518862)

    def test_index(self):
        las = self.folder / "a.las"
        shutil.copyfile(SMALL, las)
        side = pointfront.index(las)
        self.assertEqual(len(pointfront.open(side)), 1065)
        with self.assertRaisesRegex(pointfront.PointFrontError, "pfindex"):
            pointfront.index(las)

    def test_what_goes_wrong_is_raised(self):
        with self.assertRaisesRegex(pointfront.PointFrontError, "none.las"):
            pointfront.build(self.folder / "none.las", self.folder / "a.pfront")
        pointfront.build(SMALL, self.folder / "a.pfront")
        with self.assertRaisesRegex(pointfront.PointFrontError, "exists"):
            pointfront.build(SMALL, self.folder / "a.pfront")
        with self.assertRaises(pointfront.PointFrontError):
            pointfront.open(self.folder / "none.pfront")
        with self.assertRaises(pointfront.PointFrontError):
            pointfront.open(self.folder / "a.pfront").query(where="nothing > 1")
        with self.assertRaisesRegex(TypeError, "colour"):
            pointfront.build(SMALL, self.folder / "b.pfront", colour=1)
        with self.assertRaisesRegex(ValueError, "tree"):
            pointfront.build(SMALL, self.folder / "b.pfront", structure="tree")
        self.assertFalse((self.folder / "b.pfront").exists())

    def test_what_an_observer_raises_comes_out(self):
        def report(_phase, _fraction):
            raise KeyError("mine")

        with self.assertRaisesRegex(KeyError, "mine"):
            pointfront.build(LARGE, self.folder / "a.pfront", progress=report)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_another_thread_goes_on(self):
        ticks = []
        done = threading.Event()

        def tick():
            while not done.wait(0.01):
                ticks.append(time.monotonic())

        thread = threading.Thread(target=tick)
        thread.start()
        begin = time.monotonic()
        pointfront.build(LARGE, self.folder / "a.pfront", preview=False)
        seconds = time.monotonic() - begin
        done.set()
        thread.join()
        self.assertGreater(len(ticks), 20 * seconds)  # 100 a second where nothing else runs

    def interrupted(self, work):
        timer = threading.Timer(0.4, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        begin = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            work()
        self.assertLess(time.monotonic() - begin, 2.5)
        timer.join()

    def test_an_interrupt_stops_an_indexing(self):
        las = self.folder / "a.las"
        header = bytearray(227)
        count = 12_000_000  # some seconds of work
        struct.pack_into("<4s20xBB68xHIIBHI", header, 0, b"LASF", 1, 2, 227, 227, 0, 0, 20, count)
        struct.pack_into("<6d", header, 131, 0.01, 0.01, 0.01, 0.0, 0.0, 0.0)
        struct.pack_into("<6d", header, 179, 10000.0, 0.0, 10000.0, 0.0, 10000.0, 0.0)
        rows = numpy.zeros((count, 5), numpy.uint32)
        rows[:, :3] = numpy.random.default_rng(1).integers(0, 1_000_000, (count, 3))
        with las.open("wb") as file:
            file.write(header)
            rows.tofile(file)
        del rows
        self.interrupted(lambda: pointfront.index(las))
        self.assertEqual([path.name for path in self.folder.iterdir()], ["a.las"])

    def test_an_interrupt_stops_a_build(self):
        self.interrupted(lambda: pointfront.build(LARGE, self.folder / "a.pfront"))
        self.assertEqual(list(self.folder.iterdir()), [])

        def write():
            builder = pointfront.vtkPointFrontBuilder()
            builder.AddFileName(str(LARGE))
            builder.SetOutputFileName(str(self.folder / "a.pfront"))
            builder.Write()

        self.interrupted(write)
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    unittest.main(verbosity=2)
