"""Points out of NumPy and back, in chunks and as files; clouds in notebooks and other processes."""

import multiprocessing
import os
import pathlib
import pickle
import shutil
import tempfile
import unittest
import warnings

import numpy
import pointfront

CLOUD = pathlib.Path(__file__).resolve().parents[3] / "Testing/Data/autzen_stadium.laz"
TYPES = ("i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f4", "f8")


def count_in_child(cloud):
    return len(cloud.points(attributes=[])["id"])


class Writing(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="pointfront-writing-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.store = cls.folder / "a.pfront"
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            pointfront.build(CLOUD, cls.store, preview=False, node_points=5000)
        cls.cloud = pointfront.open(cls.store)

    def test_arrays_come_back(self):
        random = numpy.random.default_rng(1)
        count = 5000
        points = {"position": random.integers(0, 10000, (count, 3)) / 8.0,
                  "rank": numpy.arange(count, dtype=numpy.int32),
                  "rgb": random.integers(0, 65536, (count, 3), numpy.uint16),
                  "flag": random.integers(0, 2, count).astype(bool),
                  "strided": numpy.arange(2 * count, dtype=numpy.float32)[::2],
                  "big": numpy.arange(count, dtype=">i4"),
                  "classification": random.integers(0, 10, count, numpy.uint8)}
        for name in TYPES:
            info = numpy.iinfo(name) if name[0] != "f" else numpy.finfo(name)
            points[name] = numpy.full(count, info.min, name)
            points[name][::2] = info.max
        fields = numpy.zeros(count, [("x", "f8"), ("y", "f8"), ("z", "f8"), ("rank", "i4")])
        for axis, name in enumerate("xyz"):
            fields[name] = points["position"][:, axis]
        fields["rank"] = points["rank"]
        for inputs in (points, fields):
            store = self.folder / "own.pfront"
            report = pointfront.build(inputs, store, overwrite=True, assumed_crs="EPSG:2994",
                                      precision=0.001)
            self.assertEqual(report.points_stored, count)
            with pointfront.open(store) as cloud:
                back = cloud.points()
                self.assertIn("2994", cloud.crs)
            order = back["rank"]
            self.assertEqual(sorted(order), list(range(count)))
            numpy.testing.assert_allclose(back["position"], points["position"][order], atol=1e-6)
            if inputs is points:
                self.assertEqual(set(back) - {"id"}, set(points))
                for name in set(points) - {"position"}:
                    numpy.testing.assert_array_equal(back[name], points[name][order], name)
                for name in (*TYPES, "rgb"):
                    self.assertEqual(back[name].dtype, points[name].dtype, name)
        again = pointfront.build(back, self.folder / "again.pfront", assumed_crs="EPSG:2994",
                                 precision=0.001)
        self.assertEqual(again.points_stored, count)

    def test_points_of_any_size_stay_apart(self):
        """The steps were 0.001, whatever the arrays held."""
        random = numpy.random.default_rng(2)
        store = self.folder / "sized.pfront"
        for size in (0.002, 1.0, 1e8):
            xyz = random.random((5000, 3)) * size
            with self.assertWarnsRegex(pointfront.PointFrontWarning, "rounded to steps"):
                pointfront.build({"position": xyz}, store, overwrite=True, preview=False)
            with pointfront.open(store) as cloud:
                back = cloud.points()["position"]
            self.assertEqual(len(numpy.unique(back, axis=0)), len(xyz), size)
            self.assertLess(abs(numpy.sort(back[:, 0]) - numpy.sort(xyz[:, 0])).max(), 1e-6 * size)

    def test_decimal_coordinates_are_not_rounded(self):
        steps = numpy.arange(3000).reshape(1000, 3)
        store = self.folder / "decimal.pfront"
        for kind in (numpy.float64, numpy.float32):
            with warnings.catch_warnings(record=True) as told:
                warnings.simplefilter("always")
                pointfront.build({"position": (steps * 1e-5).astype(kind)}, store, overwrite=True,
                                 preview=False)
            self.assertEqual(told, [])  # neither rounding nor a reference system
            with pointfront.open(store) as cloud:
                back = cloud.points()["position"]
            numpy.testing.assert_allclose(numpy.sort(back, axis=0), steps * 1e-5, 0, atol=1e-15)

    def test_warnings_name_the_options_of_python(self):
        text = self.folder / "plain.xyz"
        text.write_text("1 2 3\n4 5 6\n")
        with self.assertWarnsRegex(pointfront.PointFrontWarning, "Name it with assumed_crs if"):
            pointfront.build(text, self.folder / "plain.pfront", preview=False)

    def test_what_is_no_cloud_is_refused(self):
        xyz = numpy.zeros((3, 3))
        for points, problem, says in (
                ({"intensity": [1]}, ValueError, "position"),
                ({"position": [[1, 2]]}, ValueError, "n by 3"),
                ({"position": xyz, "a": [1, 2]}, ValueError, "'a'.*3 points"),
                ({"position": xyz, "a": ["x", "y", "z"]}, TypeError, "'a'"),
                ({"position": xyz, "a": [1j, 2, 3]}, TypeError, "'a'"),
                ({"position": xyz, "a": numpy.zeros((3, 17))}, ValueError, "17 components"),
                ({"position": xyz, 3: [1, 2, 3]}, TypeError, "name of an array.*3"),
                ({"position": xyz, b"a": [1, 2, 3]}, TypeError, "name of an array.*b'a'")):
            with self.assertRaisesRegex(problem, says):
                pointfront.build(points, self.folder / "none.pfront")
        self.assertFalse((self.folder / "none.pfront").exists())

    def test_masked_values_are_refused(self):
        """A hidden value is none; a mask that hides nothing is no matter."""
        xyz = numpy.arange(9.0).reshape(3, 3)
        fields = numpy.ma.zeros(3, [("x", "f8"), ("y", "f8"), ("z", "f8")])
        fields["y"][1] = numpy.ma.masked
        for points, says in (
                ({"position": numpy.ma.masked_equal(xyz, 4)}, "'position'.* 1 .*mask"),
                ({"position": xyz, "a": numpy.ma.masked_less([1, 2, 3], 3)}, "'a'.* 2 .*mask"),
                (fields, "'y'.* 1 .*mask")):
            with self.subTest(says=says), self.assertRaisesRegex(ValueError, says):
                pointfront.build(points, self.folder / "none.pfront")
        self.assertFalse((self.folder / "none.pfront").exists())
        whole = {"position": numpy.ma.masked_equal(xyz, 99), "a": numpy.ma.array([1, 2, 3])}
        pointfront.build(whole, self.folder / "whole.pfront", precision=1, preview=False)
        with pointfront.open(self.folder / "whole.pfront") as cloud:
            self.assertEqual(sorted(cloud.points()["a"]), [1, 2, 3])

    def test_numbers_that_cannot_be_meant_are_refused(self):
        xyz = {"position": numpy.arange(9.0).reshape(3, 3)}
        target = self.folder / "none.pfront"
        reals = ("precision", "normals_radius", "normals_error", "local_height_radius",
                 "ground_cell")
        for name, value in (
                ("precision", 0), ("precision", -1), ("precision", "fine"),
                *((name, value) for name in reals for value in (numpy.nan, numpy.inf)),
                *((name, value) for name in ("number_of_threads", "node_points", "memory_limit",
                                             "preview_points") for value in (-1, 2**64)),
                ("number_of_threads", 1025), ("node_points", 2**32), ("color_depth", 12),
                ("normals_classes", [256])):
            with self.subTest(name=name, value=value):
                with self.assertRaisesRegex(ValueError, name):
                    pointfront.build(xyz, target, preview=False, **{name: value})
                self.assertFalse(target.exists())
        for value in (-1, 2**32):
            with self.assertRaisesRegex(ValueError, "node_points"):
                pointfront.index(self.folder / "none.las", node_points=value)
        ways = (self.cloud.points, self.cloud.extract,
                lambda **query: next(self.cloud.chunks(**query)))
        for name in ("maximum_number_of_points", "memory_limit"):
            for value in (-1, 2**64):
                for ask in ways:
                    with self.subTest(name=name, value=value):
                        with self.assertRaisesRegex(ValueError, name):
                            ask(**{name: value})

    def test_no_text_ends_at_a_zero_byte(self):
        """Each is refused as Python's open() does: its beginning is not what was meant."""
        las = self.folder / "zero.las"
        self.cloud.export(las, classes=2, overwrite=True)
        target = self.folder / "zero.pfront"
        xyz = numpy.arange(9.0).reshape(3, 3)
        area = "POLYGON ((0 0, 1e7 0, 1e7 1e7, 0 0))"
        ways = [lambda: pointfront.open(f"{self.store}\0.bak"),
                lambda: pointfront.open(os.fsencode(self.store) + b"\0.bak"),
                lambda: pointfront.open(pathlib.Path(f"{self.store}\0.bak")),
                lambda: pointfront.open("s3://bucket/a.pfront", cache="a\0b"),
                lambda: pointfront.open("s3://bucket/a.pfront", cache_size="4G\0T"),
                lambda: pointfront.open("s3://bucket/a.pfront", timeout="5\0x"),
                lambda: pointfront.index(f"{las}\0x"),
                lambda: pointfront.index(las, f"{las}.pfindex\0x"),
                lambda: pointfront.build(f"{las}\0x", target),
                lambda: pointfront.build([las, f"{las}\0x"], target),
                lambda: pointfront.build(las, f"{target}\0x"),
                lambda: pointfront.build({"position": xyz, "a\0b": [1, 2, 3]}, target),
                lambda: self.cloud.export(f"{target}\0.las"),
                lambda: self.cloud.screenshot(where="intensity > 50\0 and z < 0")]
        for name, value in (("crs", "EPSG:2994\0x"), ("assumed_crs", "EPSG:2994\0x"),
                            ("temporary_folder", f"{self.folder}\0x"),
                            ("attributes", ["intensity\0x"]), ("color_from", ["a.tif\0x"]),
                            ("attribute_from", ["a=a.tif\0x"])):
            ways.append(lambda name=name, value=value: pointfront.build(
                las, target, **{name: value}))
        for query in ({"where": "intensity > 50\0 and z < 0"}, {"area": area + "\0"}):
            for ask in (self.cloud.points, self.cloud.chunks, self.cloud.extract):
                ways.append(lambda ask=ask, query=query: ask(**query))
        before = sorted(self.folder.iterdir())
        for number, way in enumerate(ways):
            with self.subTest(way=number), self.assertRaisesRegex(ValueError, "null byte"):
                way()
        self.assertEqual(sorted(self.folder.iterdir()), before)

    def test_chunks_are_the_points(self):
        whole = self.cloud.points(attributes=["intensity"])
        for size in (1, 1000, 70000, 10**7):
            if size == 1:
                box = (whole["position"][:5].min(axis=0), whole["position"][:5].max(axis=0))
                expected = self.cloud.points(box=box, attributes=["intensity"])
                chunks = list(self.cloud.chunks(100, box=box, attributes=["intensity"]))
                size = 100
            else:
                expected = whole
                chunks = list(self.cloud.chunks(size, attributes=["intensity"]))
            lengths = [len(chunk["id"]) for chunk in chunks]
            self.assertEqual(set(lengths[:-1]) | {size}, {size})
            self.assertLessEqual(lengths[-1], size)
            for name, array in expected.items():
                joined = numpy.concatenate([chunk[name] for chunk in chunks])
                self.assertEqual(joined.dtype, array.dtype)
                numpy.testing.assert_array_equal(joined, array)
        self.assertEqual(list(self.cloud.chunks(where="intensity > 65000")), [])
        with self.assertRaises(ValueError):
            self.cloud.chunks(0)
        with self.assertRaises(pointfront.PointFrontError):
            next(self.cloud.chunks(where="nothing > 1"))

    def test_points_are_exported(self):
        low, high = map(numpy.array, self.cloud.bounds)
        box = (low, (low + high) / 2)
        expected = self.cloud.points(box=box, classes=0, where="intensity > 50")
        self.assertGreater(len(expected["id"]), 1000)
        target = self.folder / "part.las"
        count = self.cloud.export(target, box=box, classes=0, where="intensity > 50")
        self.assertEqual(count, len(expected["id"]))
        with self.assertRaisesRegex(pointfront.PointFrontError, "part.las"):
            self.cloud.export(target)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            pointfront.build(target, self.folder / "part.pfront")
        back = pointfront.open(self.folder / "part.pfront").points()
        self.assertEqual(sorted(back["intensity"]), sorted(expected["intensity"]))
        center = (low + high) / 2
        near = self.cloud.points(sphere=(center, 300), attributes=[])
        count = self.cloud.export(target, sphere=(center, 300), overwrite=True)
        self.assertEqual(count, len(near["id"]))
        with self.assertWarnsRegex(pointfront.PointFrontWarning, "no point"):
            self.assertEqual(self.cloud.export(target, where="intensity > 65000", overwrite=True),
                             0)

    def test_what_cannot_be_meant_is_refused(self):
        """By points(), chunks() and export() in one way; nothing is written."""
        target = self.folder / "refused.las"
        ends = numpy.array(self.cloud.bounds)
        cases = [({"sphere": (1, 2, 3, 4)}, ValueError, "sphere.*radius"),
                 ({"sphere": ((1, 2), 3)}, ValueError, "sphere.*radius"),
                 ({"where": 3}, TypeError, "where.*int"),
                 ({"spacing": -1}, ValueError, "spacing.*-1"),
                 ({"spacing": numpy.nan}, ValueError, "spacing.*nan"),
                 ({"classes": []}, ValueError, "no class"),
                 ({"classes": [True]}, TypeError, "True"), ({"classes": "2"}, TypeError, "'2'")]
        for axis, name in enumerate("xyz"):
            swapped, unknown = ends.copy(), ends.copy()
            swapped[:, axis] = ends[::-1, axis]
            unknown[axis % 2, axis] = numpy.nan
            cases += [({"box": swapped}, ValueError, f"box.*along {name}.*lowest corner"),
                      ({"box": unknown}, ValueError, f"box.*along {name} is no number")]
        for query, problem, says in cases:
            for ask in (self.cloud.points, self.cloud.chunks,
                        lambda **query: self.cloud.export(target, **query)):
                with self.subTest(query=query), self.assertRaisesRegex(problem, says):
                    ask(**query)
            self.assertFalse(target.exists())
        for sphere in ((ends[0], -1), (ends[0], numpy.nan), ((numpy.inf, 0, 0), 1)):
            for ask in (self.cloud.points, lambda **query: self.cloud.export(target, **query)):
                with self.subTest(sphere=sphere), self.assertRaisesRegex(
                        pointfront.PointFrontError, "sphere.*radius"):
                    ask(sphere=sphere)
            self.assertFalse(target.exists())

    def test_what_has_no_end_is_the_same_in_files(self):
        target = self.folder / "endless.las"
        low, high = self.cloud.bounds
        middle = (numpy.array(low) + high) / 2
        for query in ({"box": ((-numpy.inf, *low[1:]), (*middle[:2], numpy.inf))},
                      {"spacing": numpy.inf}, {"spacing": 0}, {"spacing": numpy.float32(20)}):
            count = len(self.cloud.points(attributes=[], **query)["id"])
            self.assertGreater(count, 0)
            self.assertEqual(self.cloud.export(target, overwrite=True, **query), count, query)

    def test_warnings_are_pythons(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            report = pointfront.build(CLOUD, self.folder / "w.pfront", preview=False)
        self.assertEqual([str(w.message) for w in caught], report.warnings)
        self.assertTrue(caught)
        self.assertEqual({w.filename for w in caught}, {__file__})
        self.assertTrue(issubclass(caught[0].category, pointfront.PointFrontWarning))

    def test_a_folder_of_stores_is_one_cloud(self):
        folder = self.folder / "stores"
        folder.mkdir()
        for name in ("a.pfront", "b.pfront"):
            shutil.copyfile(self.store, folder / name)
        with pointfront.open(folder) as cloud:
            self.assertEqual(cloud.info["points"], 2 * len(self.cloud))
            self.assertEqual([a["name"] for a in cloud.info["attributes"]], cloud.attributes)
            self.assertEqual(cloud.crs, self.cloud.crs)
            self.assertIn(f"{2 * len(self.cloud):,}", cloud._repr_html_())

    def test_an_opened_cloud_says_what_it_lacks(self):
        """A folder of LAZ files gives a first look: four points, which are not those of the files.
        """
        folder = self.folder / "tiles"
        folder.mkdir()
        shutil.copyfile(CLOUD, folder / "a.laz")
        with self.assertWarnsRegex(pointfront.PointFrontWarning, "tiles: .*4 of 174151") as said:
            cloud = pointfront.open(folder)
        self.assertEqual(said.filename, __file__)
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # it is said once
            self.assertEqual(len(cloud.points()["id"]), 4)
            cloud.screenshot(size=(64, 48))
            with self.assertRaisesRegex(pointfront.PointFrontError, "would lack"):
                cloud.export(self.folder / "tiles.las")

    def test_a_picture_says_what_it_lacks(self):
        with self.assertWarnsRegex(pointfront.PointFrontWarning, "coarser.*point_budget") as said:
            self.cloud.screenshot(size=(64, 48), error=0.1, point_budget=1000)
        self.assertEqual(said.filename, __file__)

    def test_a_folder_of_files_is_an_input(self):
        folder = self.folder / "files"
        (folder / "deeper").mkdir(parents=True)
        for name in ("a.laz", "deeper/b.laz"):
            shutil.copyfile(CLOUD, folder / name)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            report = pointfront.build(folder, self.folder / "folder.pfront", preview=False)
        self.assertEqual(report.points_stored, 2 * len(self.cloud))

    def test_paths_are_texts_bytes_and_path_objects(self):
        """Wherever a path is taken; one that is no UTF-8 as well."""
        plain, odd = self.folder / "paths", self.folder / os.fsdecode(b"no \xff utf-8")
        for folder in (plain, odd):
            folder.mkdir()
            for kind in (str, pathlib.Path, os.fsencode):
                with self.subTest(folder=folder.name, kind=kind.__name__):
                    def at(name):
                        return kind(str(folder / name))

                    points, store = at("a.laz"), at("a.pfront")
                    shutil.copyfile(CLOUD, points)
                    with warnings.catch_warnings():
                        warnings.simplefilter("ignore")
                        for inputs in (points, [points]):
                            report = pointfront.build(
                                inputs, store, overwrite=True, preview=False,
                                temporary_folder=kind(str(folder)))
                            self.assertEqual(report.points_stored, len(self.cloud))
                        self.assertEqual(report.path, str(folder / "a.pfront"))
                        cloud = pointfront.open(store)
                        self.assertEqual(cloud.path, os.path.realpath(folder / "a.pfront"))
                        self.assertEqual(len(cloud.points(attributes=[])["id"]), len(self.cloud))
                        cloud.export(at("b.las"), overwrite=True)
                        side = pointfront.index(at("b.las"), at("b.pfindex"), overwrite=True)
                    self.assertEqual(len(pointfront.open(os.fsencode(side))), len(self.cloud))
                    (folder / "red.json").write_text('{"default": {"color": "#ff0000"}}')
                    picture = cloud.screenshot(at("a.png"), size=(64, 48), style=at("red.json"))
                    picture.save(at("b.png"))
                    self.assertEqual((folder / "a.png").read_bytes(), picture.png)
                    self.assertEqual((folder / "b.png").read_bytes(), picture.png)
        for wrong in (3, [b"a.laz", 3], None):
            with self.assertRaises(TypeError):
                pointfront.build(wrong, self.folder / "wrong.pfront")

    def test_numbers_may_be_numpys(self):
        """Integers, truths, floating numbers and arrays: the same as Python's."""
        kinds = [(int, bool, float, list)] + [
            (whole, numpy.bool_, numpy.float32, lambda numbers, whole=whole: numpy.array(
                numbers, whole)) for whole in (numpy.int64, numpy.uint8)]
        random = numpy.random.default_rng(1)
        points = {"position": random.uniform(0, 100, (2000, 3)),
                  "classification": numpy.zeros(2000, "u1")}
        outcomes = []
        for number, truth, real, array in kinds:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                report = pointfront.build(
                    points, self.folder / "numbers.pfront", overwrite=truth(True),
                    preview=truth(False), number_of_threads=number(2), color_depth=number(8),
                    normals="pca", normals_neighbors=number(9), precision=real(0.5),
                    normals_classes=array([0]))
                picture = self.cloud.screenshot(
                    size=(number(96), number(64)), point_size=number(3), edl=truth(True),
                    classes=array([0]), background=array([1, 2, 3]), point_budget=number(100),
                    error=real(2.0), style={
                        "default": {"size": {"mode": "fixed", "px": number(4)}},
                        "classes": {number(6): {"visible": truth(False)}}})
            sizes = [len(chunk["id"]) for chunk in self.cloud.chunks(
                number(100), classes=number(0), spacing=real(100.0))]
            self.assertEqual(set(sizes[:-1]), {100})
            all_of_class = self.cloud.points(
                classes=number(0), attributes=[], memory_limit=number(0),
                maximum_number_of_points=numpy.int64(10**7) if number is not int else 10**7)
            outcomes.append((vars(report), picture.png, sizes, len(all_of_class["id"])))
        for outcome in outcomes[1:]:
            self.assertEqual(outcome, outcomes[0])

    def test_dictionaries_are_styles_and_cameras(self):
        low, high = map(numpy.array, self.cloud.bounds)
        camera = {"position": (low + high) / 2 + [0, 0, 3000], "focal_point": (low + high) / 2,
                  "view_up": [0, 1, 0], "view_angle": numpy.float64(30)}
        style = {"default": {"color": "#ff0000"}}
        pixels = self.cloud.screenshot(size=(64, 48), camera=camera, style=style,
                                       background=(0, 0, 0)).pixels.astype(int)
        drawn = pixels.max(axis=2) > 30
        self.assertGreater(drawn.mean(), 0.1)
        self.assertTrue((pixels[drawn][:, 0] > 2 * pixels[drawn][:, 1]).all())

    def test_a_cloud_is_pickled_and_shown(self):
        again = pickle.loads(pickle.dumps(self.cloud))
        self.assertEqual(len(again), len(self.cloud))
        with multiprocessing.get_context("spawn").Pool(1) as pool:
            counts = pool.map(count_in_child, [self.cloud])
        self.assertEqual(counts, [len(self.cloud)])
        table = self.cloud._repr_html_()
        self.assertIn(f"{len(self.cloud):,}", table)
        self.assertIn("intensity", table)
        odd = self.folder / "<b>.pfront"
        shutil.copyfile(self.store, odd)
        with pointfront.open(odd) as cloud:
            self.assertNotIn("<b>", cloud._repr_html_())
        self.assertIn("closed", cloud._repr_html_())
        with self.assertRaisesRegex(pointfront.PointFrontError, "closed"):
            pickle.dumps(cloud)


if __name__ == "__main__":
    unittest.main(verbosity=2)
