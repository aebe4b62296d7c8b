"""The Python package: calls that raise, a free interpreter, interrupts, versions, stubs."""

import ast
import gc
import inspect
import os
import pathlib
import shutil
import signal
import struct
import subprocess
import sys
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

    @classmethod
    def large_store(cls):
        """A store of LARGE for tests that only read it; the first one builds it."""
        if not hasattr(cls, "_large"):
            folder = tempfile.TemporaryDirectory()
            cls.addClassCleanup(folder.cleanup)
            cls._large = pathlib.Path(folder.name) / "large.pfront"
            pointfront.build(LARGE, cls._large, preview=False)
        return cls._large

    def test_version_and_documentation(self):
        self.assertRegex(pointfront.__version__, r"^[0-9]+[.][0-9]+[.][0-9]+$")
        for name in ("build", "index", "open", "Cloud", "BuildReport", "Picture",
                     "PointFrontError"):
            self.assertTrue(getattr(pointfront, name).__doc__, name)

    def test_pyi_names_what_there_is(self):
        folder = pathlib.Path(pointfront.__file__).parent
        self.assertTrue((folder / "py.typed").exists())
        tree = ast.parse((folder / "__init__.pyi").read_text())
        kinds = (ast.FunctionDef, ast.ClassDef)
        names = [node.name for node in tree.body
                 if isinstance(node, kinds) and not node.name.startswith("_")]
        self.assertGreater(len(names), 4)
        for name in names:
            self.assertTrue(hasattr(pointfront, name), name)
        for node in tree.body:
            if isinstance(node, ast.ClassDef) and node.name == "Cloud":
                written_down = {member.name: member for member in node.body}
        for name, declared in written_down.items():
            function = getattr(pointfront.Cloud, name)
            if not isinstance(function, property) and name != "__exit__":
                given = inspect.signature(function).parameters
                written = {a.arg for a in declared.args.args + declared.args.kwonlyargs}
                named = {n for n, p in given.items() if p.kind is not p.VAR_KEYWORD}
                self.assertLessEqual(named, written, name)

    def test_build_open_query(self):
        phases = []
        report = pointfront.build(SMALL, self.folder / "a.pfront", structure="kdtree",
                                  node_points=256, progress=lambda p, f: phases.append((p, f)))
        self.assertEqual((report.points_read, report.points_stored), (1065, 1065))
        self.assertTrue(phases)
        cloud = pointfront.open(self.folder / "a.pfront")
        self.assertEqual(len(cloud), 1065)
        self.assertIn("intensity", cloud.attributes)
        arrays = cloud.points()
        self.assertEqual(arrays["position"].shape, (1065, 3))
        self.assertEqual(arrays["position"].dtype, numpy.float64)
        low, high = cloud.bounds
        numpy.testing.assert_allclose(arrays["position"].min(axis=0), low)
        numpy.testing.assert_allclose(arrays["position"].max(axis=0), high)
        bright = cloud.points(where="intensity > 100")
        self.assertEqual(len(bright["id"]), int((arrays["intensity"] > 100).sum()))
        again = pointfront.build(self.folder / "a.pfront", self.folder / "b.pfront")
        self.assertEqual(again.points_stored, 1065)

    def test_regions(self):
        pointfront.build(SMALL, self.folder / "a.pfront", node_points=256)
        with pointfront.open(self.folder / "a.pfront") as cloud:
            everything = cloud.points()
            xyz = everything["position"]
            low, high = numpy.percentile(xyz, [25, 75], axis=0)
            inside = ((xyz >= low) & (xyz <= high)).all(axis=1)
            self.assertTrue(0 < inside.sum() < len(xyz))
            for box in ((low, high), [*low, *high]):
                found = cloud.points(box=box)
                self.assertEqual(set(found["id"]), set(everything["id"][inside]))
            center = xyz.mean(axis=0)
            near = numpy.linalg.norm(xyz - center, axis=1) <= 100
            self.assertTrue(0 < near.sum() < len(xyz))
            self.assertEqual(len(cloud.points(sphere=(center, 100))["id"]), near.sum())
            thin = cloud.points(spacing=500, attributes="intensity")
            self.assertEqual(set(thin), {"position", "id", "intensity"})
            self.assertTrue(0 < len(thin["id"]) < len(xyz))
            none = cloud.points(where="intensity > 65000")
            self.assertEqual(none["position"].shape, (0, 3))
            with self.assertRaises(ValueError):
                cloud.points(box=(1, 2, 3))
            with self.assertRaisesRegex(ValueError, "lowest corner"):
                cloud.points(box=(high, low))
            with self.assertRaisesRegex(ValueError, "no class"):
                cloud.points(classes=[])
            with self.assertRaises(TypeError):
                cloud.points(classes=2.5)
            codes = everything["classification"]
            for classes in (2, [2], numpy.uint8(2), numpy.array([2]), {2}):
                self.assertEqual(len(cloud.points(classes=classes)["id"]), (codes == 2).sum())
            with self.assertRaisesRegex(pointfront.PointFrontError, "colour"):
                cloud.points(attributes=["colour"])
            with self.assertRaisesRegex(TypeError, "colour"):
                cloud.points(colour=1)
        self.assertEqual(len(everything["id"]), 1065)  # arrays outlive the cloud
        with self.assertRaisesRegex(pointfront.PointFrontError, "closed"):
            cloud.points()
        with self.assertRaisesRegex(pointfront.PointFrontError, "closed"):
            len(cloud)

    def test_information(self):
        pointfront.build(SMALL, self.folder / "a.pfront")
        told = pointfront.open(self.folder / "a.pfront").info
        self.assertEqual(told["points"], 1065)
        self.assertIn("intensity", [a["name"] for a in told["attributes"]])

    def test_a_picture_needs_no_display(self):
        pointfront.build(SMALL, self.folder / "a.pfront")
        cloud = pointfront.open(self.folder / "a.pfront")
        display = os.environ.pop("DISPLAY", None)
        try:
            picture = cloud.screenshot(self.folder / "a.png", size=(64, 48), point_size=3,
                                       background=(0, 0, 255), view="top")
            with self.assertRaisesRegex(pointfront.PointFrontError, "screenshot"):
                cloud.show()
        finally:
            if display is not None:
                os.environ["DISPLAY"] = display
        self.assertEqual((self.folder / "a.png").read_bytes(), picture._repr_png_())
        self.assertEqual(picture.pixels.shape, (48, 64, 3))
        blue = (picture.pixels == (0, 0, 255)).all(axis=2)
        self.assertTrue(0 < blue.sum() < blue.size)
        self.assertTrue((numpy.asarray(picture) == picture.pixels).all())
        with self.assertRaisesRegex(pointfront.PointFrontError, "sideways"):
            cloud.screenshot(view="sideways")

    def test_an_actor_made_first_can_be_drawn(self):
        code = ("import importlib, pointfront; "
                "core = importlib.import_module(pointfront.VTK_PACKAGE + '.vtkRenderingCore'); "
                "name = core.vtkActor().GetClassName(); assert name == 'vtkOpenGLActor', name")
        subprocess.run([sys.executable, "-c", code], check=True)

    def test_the_tool_is_a_module(self):
        run = subprocess.run([sys.executable, "-m", "pointfront", "--version"],
                             capture_output=True, text=True, check=True)
        self.assertIn(pointfront.__version__, run.stdout)
        run = subprocess.run([sys.executable, "-m", "pointfront", "info", "none.pfront"],
                             capture_output=True, text=True)
        self.assertNotEqual(run.returncode, 0)

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
            pointfront.open(self.folder / "a.pfront").points(where="nothing > 1")
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

    def assert_another_thread_runs(self, least, call):
        """Another thread gets so many turns for a second that the processors spend on call(), on a
        machine with any load; 100 if it runs alone."""
        ticks = []
        done = threading.Event()

        def tick():
            while not done.wait(0.01):
                ticks.append(True)

        thread = threading.Thread(target=tick)
        thread.start()
        begin = time.process_time()
        call()
        seconds = time.process_time() - begin
        done.set()
        thread.join()
        self.assertGreater(len(ticks), least * seconds)

    def test_another_thread_goes_on(self):
        self.assert_another_thread_runs(
            20, lambda: pointfront.build(LARGE, self.folder / "a.pfront", preview=False))

    def test_a_query_is_watched_and_stopped(self):
        with pointfront.open(self.large_store()) as cloud:
            fractions = []
            cloud.points(attributes=["intensity"], progress=lambda _, f: fractions.append(f))
            self.assertEqual(fractions, sorted(fractions))
            self.assertGreater(len(fractions), 3)
            with self.assertRaisesRegex(pointfront.PointFrontError, "stopped"):
                cloud.points(progress=lambda *_: False)
            self.assert_another_thread_runs(10, cloud.points)

    def test_a_false_of_numpy_stops_as_pythons_does(self):
        """None and other values do not: what print() or list.append() returns, for instance."""
        store = self.folder / "a.pfront"
        pointfront.build(SMALL, store, preview=False)
        with pointfront.open(store) as cloud:
            for false in (False, numpy.False_):
                for work in (cloud.points, cloud.extract,
                             lambda **options: pointfront.build(
                                 SMALL, self.folder / "b.pfront", **options)):
                    with self.assertRaisesRegex(pointfront.PointFrontError, "stopped"):
                        work(progress=lambda *_, answer=false: answer)
                self.assertFalse((self.folder / "b.pfront").exists())
            for other in (None, True, numpy.True_, 0, 0.0, ""):
                points = cloud.points(progress=lambda *_, answer=other: answer)
                self.assertEqual(len(points["id"]), 1065)

    def test_a_watched_query_leaves_nothing_behind(self):
        """No circle of references holds its arrays until Python looks for circles."""
        store = self.folder / "a.pfront"
        pointfront.build(SMALL, store, preview=False)
        with pointfront.open(store) as cloud:
            gc.collect()
            gc.disable()
            self.addCleanup(gc.enable)
            cloud.points(progress=lambda *_: None)
            self.assertEqual(gc.collect(), 0)

    def test_attributes_called_as_ours_are_not_lost(self):
        table = self.folder / "t.xyz"
        table.write_text("x y z id position\n" + "".join(f"{i} 0 {i} 7 9\n" for i in range(1000)))
        pointfront.build(table, self.folder / "a.pfront", preview=False)
        with pointfront.open(self.folder / "a.pfront") as cloud:
            points = cloud.points()
        self.assertEqual(points["position"].shape, (1000, 3))
        self.assertEqual(sorted(points["position"][:, 0]), list(range(1000)))
        self.assertEqual(sorted(points["id"]), list(range(1000)))
        self.assertEqual((set(points["id_"]), set(points["position_"])), ({7}, {9}))

    def interrupted(self, work, after=0.4):
        """Interrupts the work after so many seconds of the processors; how many it took them."""
        # A shell's job in the background would ignore it.
        signal.signal(signal.SIGINT, signal.default_int_handler)
        begin, done = time.process_time(), threading.Event()

        def interrupt():
            while time.process_time() - begin < after and not done.is_set():
                time.sleep(0.002)
            if not done.is_set():
                os.kill(os.getpid(), signal.SIGINT)

        thread = threading.Thread(target=interrupt)
        thread.start()
        try:
            with self.assertRaises(KeyboardInterrupt):
                work()
        finally:
            done.set()
            thread.join()
        return time.process_time() - begin

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
        self.assertLess(self.interrupted(lambda: pointfront.index(las)), 3.0)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["a.las"])

    def test_an_interrupt_stops_a_query(self):
        """One that nobody watches, too: it ends the query, which does not run to its end first."""
        with pointfront.open(self.large_store()) as cloud:
            begin = time.process_time()
            cloud.points()
            whole = time.process_time() - begin
            shares = []
            while not shares or (min(shares) > 0.7 and len(shares) < 5):  # a machine may be busy
                shares.append(self.interrupted(cloud.points, 0.3 * whole) / whole)
        self.assertLess(min(shares), 0.7)

    def test_an_interrupt_stops_a_build(self):
        self.assertLess(self.interrupted(
            lambda: pointfront.build(LARGE, self.folder / "a.pfront")), 3.0)
        self.assertEqual(list(self.folder.iterdir()), [])

        def write():
            builder = pointfront.vtkPointFrontBuilder()
            builder.AddFileName(str(LARGE))
            builder.SetOutputFileName(str(self.folder / "a.pfront"))
            builder.Write()

        self.assertLess(self.interrupted(write), 3.0)
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    unittest.main(verbosity=2)
