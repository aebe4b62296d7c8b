"""Points as NumPy arrays: what is given and stored, in each type; conditions; thinning; forks."""

import collections
import importlib
import multiprocessing
import os
import pathlib
import shutil
import struct
import tempfile
import time
import types
import unittest
import warnings

import numpy
import pointfront

ROOT = pathlib.Path(__file__).resolve().parents[3]
CLOUD = ROOT / "Testing/Data/autzen_stadium.laz"
LIMIT_SECONDS = 300.0  # ends a test that hangs


def colourful_las(path, colours):
    """A LAS file of points along a line, with these colours of 16 bits."""
    count = len(colours)
    header = bytearray(227)
    struct.pack_into("<4s20xBB68xHIIBHI", header, 0, b"LASF", 1, 2, 227, 227, 0, 2, 26, count)
    struct.pack_into("<6d", header, 131, 0.01, 0.01, 0.01, 0.0, 0.0, 0.0)
    struct.pack_into("<6d", header, 179, 0.01 * count, 0.0, 0.0, 0.0, 0.0, 0.0)
    rows = numpy.zeros(count, [("x", "<i4"), ("rest", "V16"), ("rgb", "<u2", 3)])
    rows["x"] = numpy.arange(count)
    rows["rgb"] = colours
    path.write_bytes(bytes(header) + rows.tobytes())


def query_in_child(path):
    return len(pointfront.open(path).points(attributes=[])["id"])


class Points(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="pointfront-points-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.stores = {}
        for refinement in ("add", "replace"):
            cls.stores[refinement] = cls.folder / f"{refinement}.pfront"
            pointfront.build(CLOUD, cls.stores[refinement], preview=False, node_points=1000,
                             refinement=refinement)

    def test_anything_with_names_is_points(self):
        """Mappings, .npz files and what is like a data frame: as the dictionary of their items."""
        class Frame:
            def __init__(self, columns):
                self._columns = columns

            def keys(self):
                return iter(self._columns)

            def __getitem__(self, name):
                return self._columns[name]

        plain = {"x": numpy.arange(5.0), "y": numpy.arange(5.0) * 2, "z": numpy.zeros(5),
                 "rank": numpy.arange(5, dtype="i4")}
        numpy.savez(self.folder / "points.npz", **plain)
        with numpy.load(self.folder / "points.npz") as file:
            for points in (types.MappingProxyType(plain), collections.UserDict(plain), file,
                           Frame(plain)):
                with self.subTest(kind=type(points).__name__):
                    store = self.folder / "named.pfront"
                    pointfront.build(points, store, overwrite=True, precision=1, preview=False)
                    with pointfront.open(store) as cloud:
                        back = cloud.points()
                    self.assertEqual(sorted(back["rank"]), [0, 1, 2, 3, 4])
                    self.assertEqual(list(back["position"][:, 1]), list(back["rank"] * 2.0))
        for array in (numpy.zeros((3, 3)), numpy.zeros((3, 3), "i4")):
            with self.assertRaisesRegex(TypeError, r"\(3, 3\).*{'position': array}"):
                pointfront.build(array, self.folder / "none.pfront")
        names = numpy.array([str(CLOUD)])
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            report = pointfront.build(names, self.folder / "names.pfront", preview=False)
        self.assertEqual(report.points_stored, 174151)

    def test_classes_of_any_integers_are_classes(self):
        xyz = numpy.arange(12.0).reshape(4, 3)
        target = self.folder / "classes.pfront"
        pointfront.build({"position": xyz, "classification": numpy.array([2, 6, 2, 255])}, target,
                         preview=False, precision=1)
        with pointfront.open(target) as cloud:
            self.assertEqual(len(cloud.points(classes=2)["id"]), 2)
        pointfront.build({"position": xyz, "classification": numpy.array([2, 6, 2, 256])}, target,
                         preview=False, precision=1, overwrite=True)
        with pointfront.open(target) as cloud:
            with self.assertRaisesRegex(pointfront.PointFrontError, "int64.*one byte"):
                cloud.points(classes=2)
            self.assertEqual(len(cloud.points(where="classification == 256")["id"]), 1)

    def test_an_array_without_a_name_is_refused(self):
        target = self.folder / "nameless.pfront"
        arrays = {"position": numpy.arange(9.0).reshape(3, 3), "": numpy.arange(3)}
        with self.assertRaisesRegex(ValueError, "empty name"):
            pointfront.build(arrays, target, preview=False)
        self.assertFalse(target.exists())

    def test_colours_are_what_is_stored(self):
        random = numpy.random.default_rng(1)
        wide = random.integers(0, 65536, (1000, 3), numpy.uint16)
        dark = random.integers(0, 256, (1000, 3), numpy.uint16)
        for name, colours, kind in (("wide", wide, numpy.uint16), ("dark", dark, numpy.uint8)):
            colourful_las(self.folder / f"{name}.las", colours)
            store = self.folder / f"{name}.pfront"
            pointfront.build(self.folder / f"{name}.las", store, preview=False)
            with pointfront.open(store) as cloud:
                told = {a["name"]: a["type"] for a in cloud.info["attributes"]}
                self.assertEqual(told["rgb"], numpy.dtype(kind).name)
                points = cloud.points(attributes=["rgb"])
                self.assertEqual(points["rgb"].dtype, kind)
                order = numpy.rint(points["position"][:, 0] / 0.01).astype(int)
                numpy.testing.assert_array_equal(points["rgb"], colours[order])
                bytes_of = cloud.points(attributes=["rgb"], colors_as_stored=False)["rgb"]
                self.assertEqual(bytes_of.dtype, numpy.uint8)
                shift = 8 if name == "wide" else 0
                numpy.testing.assert_array_equal(bytes_of, points["rgb"] >> shift)

    def test_misspelt_names_get_the_nearest_one(self):
        cloud = pointfront.open(self.stores["add"])
        for problem, meant, ask in (
                (pointfront.PointFrontError, "intensity",
                 lambda: cloud.points(attributes=["intensty"])),
                (pointfront.PointFrontError, "intensity",
                 lambda: cloud.points(where="intenity > 3")),
                (TypeError, "overwrite",
                 lambda: pointfront.build(CLOUD, self.folder / "a.pfront", overwrit=True)),
                (ValueError, "octree",
                 lambda: pointfront.build(CLOUD, self.folder / "a.pfront", structure="octre")),
                (pointfront.PointFrontError, "splats",
                 lambda: cloud.screenshot(self.folder / "a.png", technique="slpats")),
                (AttributeError, "build", lambda: pointfront.biuld)):
            with self.subTest(meant=meant):
                with self.assertRaisesRegex(problem, f"did you mean '{meant}'"):
                    ask()

    def test_integers_of_64_bits_are_compared_exactly(self):
        core = importlib.import_module(pointfront.VTK_PACKAGE + ".vtkCommonCore")
        model = importlib.import_module(pointfront.VTK_PACKAGE + ".vtkCommonDataModel")
        convert = importlib.import_module(pointfront.VTK_PACKAGE + ".util.numpy_support")
        keys = numpy.concatenate([numpy.int64(2) ** 62 + numpy.arange(-600, 600),
                                  numpy.int64(2) ** 53 + numpy.arange(-600, 600)])
        data, places = model.vtkPolyData(), core.vtkPoints()
        xyz = numpy.zeros((len(keys), 3))
        xyz[:, 0] = numpy.arange(len(keys))
        places.SetData(convert.numpy_to_vtk(xyz))
        data.SetPoints(places)
        array = convert.numpy_to_vtk(keys, array_type=core.vtkTypeInt64Array().GetDataType())
        array.SetName("k")
        data.GetPointData().AddArray(array)
        builder = pointfront.vtkPointFrontBuilder()
        builder.SetPoints(data)
        builder.SetOutputFileName(str(self.folder / "keys.pfront"))
        self.assertTrue(builder.Write())
        compare = {"==": numpy.equal, "!=": numpy.not_equal, "<": numpy.less,
                   "<=": numpy.less_equal, ">": numpy.greater, ">=": numpy.greater_equal}
        with pointfront.open(self.folder / "keys.pfront") as cloud:
            self.assertEqual(cloud.points()["k"].dtype, numpy.int64)
            for bound in (2**62, 2**62 + 1, 2**62 - 3, 2**53 + 1, 2**53):
                for sign, truth in compare.items():
                    found = cloud.points(where=f"k {sign} {bound}")["k"]
                    expected = keys[truth(keys, numpy.int64(bound))]
                    numpy.testing.assert_array_equal(numpy.sort(found), numpy.sort(expected),
                                                     f"k {sign} {bound}")
            found = cloud.points(where=f"k in {{{2**62 + 1}, {2**62 + 2}}}")["k"]
            self.assertEqual(sorted(found), [2**62 + 1, 2**62 + 2])

    def test_arrays_are_what_vtk_extracts(self):
        """Random queries by the kernel alone and by vtkPointFrontExtract: the same points."""
        convert = importlib.import_module(pointfront.VTK_PACKAGE + ".util.numpy_support")
        random = numpy.random.default_rng(7)
        for store in self.stores.values():
            with pointfront.open(store) as cloud:
                low, high = map(numpy.array, cloud.bounds)
                for _ in range(15):
                    ends = numpy.sort(random.uniform(low, high, (2, 3)), axis=0)
                    x0, y0, x1, y1 = ends[0, 0], ends[0, 1], ends[1, 0], ends[1, 1]
                    possible = {
                        "box": ((*ends[0, :2], low[2]), (*ends[1, :2], high[2])),
                        "sphere": (ends[0], random.uniform(100, 1000)),
                        "area": f"POLYGON (({x0} {y0}, {x1} {y0}, {x1} {y1}, {x0} {y0}))",
                        "classes": random.integers(0, 10, 3), "where": "intensity > 60",
                        "spacing": random.uniform(5, 200), "attributes": ["rgb", "intensity"]}
                    names = random.choice(list(possible), random.integers(1, 4), replace=False)
                    query = {name: possible[name] for name in names}
                    arrays = cloud.points(**query)
                    data = cloud.extract(colors_as_stored=True, **query)
                    columns = data.GetPointData()
                    numpy.testing.assert_array_equal(
                        arrays["position"],
                        convert.vtk_to_numpy(data.GetPoints().GetData()), str(query))
                    self.assertEqual(columns.GetNumberOfArrays(), len(arrays) - 1)
                    for name, array in arrays.items():
                        if name != "position":
                            other = convert.vtk_to_numpy(
                                columns.GetArray("point_id" if name == "id" else name))
                            self.assertEqual(array.dtype, other.dtype, name)
                            numpy.testing.assert_array_equal(array, other, f"{name} {query}")

    def test_arrays_are_the_callers_own(self):
        with pointfront.open(self.stores["add"]) as cloud:
            points = cloud.points(attributes=["intensity"])
            before = points["intensity"].copy()
            points["position"] += 1.0
            points["intensity"][:] = 0
            numpy.testing.assert_array_equal(cloud.points()["intensity"], before)
            view = points["position"][5:, 1]
            kept = view.copy()
            del points
            cloud.points()
            numpy.testing.assert_array_equal(view, kept)

    def test_thinning_is_as_help_says(self):
        """At most a 20th of the places is farther from a chosen point than was asked; the levels
        are nested, and between two of them nothing changes.
        """
        random = numpy.random.default_rng(1)
        for refinement, store in self.stores.items():
            with pointfront.open(store) as cloud:
                everything = cloud.points(attributes=[])
                some = everything["position"][random.integers(0, len(everything["id"]), 300)]
                before = set()
                for spacing in (100, 50, 40, 20, 10):
                    chosen = cloud.points(spacing=spacing, attributes=[])
                    far = [numpy.linalg.norm(chosen["position"] - place, axis=1).min() > spacing
                           for place in some]
                    self.assertLess(numpy.mean(far), 0.05, (refinement, spacing))
                    if refinement == "add":
                        self.assertLessEqual(before, set(chosen["id"]))
                    before = set(chosen["id"])
                self.assertLess(len(before), 0.9 * len(everything["id"]))

    def test_a_region_beside_the_cloud_is_told(self):
        """Each shape is, once, also where points come in chunks; and none that meets the cloud."""
        model = importlib.import_module(pointfront.VTK_PACKAGE + ".vtkCommonDataModel")
        core = importlib.import_module(pointfront.VTK_PACKAGE + ".vtkCommonCore")

        def column(x, y, edge):
            """A square column on its edge, as planes whose normals point outwards."""
            planes, places, normals = model.vtkPlanes(), core.vtkPoints(), core.vtkDoubleArray()
            normals.SetNumberOfComponents(3)
            for i in range(4):
                normal = numpy.array([(-1) ** (i % 2), (-1) ** (i // 2), 0]) * 0.5 ** 0.5
                places.InsertNextPoint(*([x, y, 0] + edge / 2 * normal))
                normals.InsertNextTuple3(*normal)
            planes.SetPoints(places)
            planes.SetNormals(normals)
            return planes

        def box(x, y, edge):
            return (x - edge, y - edge, z0, x + edge, y + edge, z1)

        with pointfront.open(self.stores["add"]) as cloud:
            (x0, y0, z0), (x1, y1, z1) = cloud.bounds
            middle, edge = (y0 + y1) / 2, 100.0
            shapes = {"box": box, "frustum": column,
                      "sphere": lambda x, y, edge: ((x, y, z0), edge),
                      "area": lambda x, y, edge: "POLYGON ((%s %s, %s %s, %s %s, %s %s))" % (
                          x - edge, y, x, y - edge, x + edge, y, x - edge, y)}
            for name, shape in shapes.items():
                ways = [lambda **query: len(cloud.points(**query)["id"]),
                        lambda **query: sum(len(c["id"]) for c in cloud.chunks(20000, **query)),
                        lambda **query: cloud.extract(**query).GetNumberOfPoints()]
                for number, count in enumerate(ways):
                    with self.subTest(shape=name, way=number):
                        with warnings.catch_warnings(record=True) as told:
                            warnings.simplefilter("always")
                            found = count(**{name: shape(x1 + 2 * edge, middle, edge)})
                        self.assertEqual((found, len(told)), (0, 1), told)
                        self.assertIn("lies beside the cloud", str(told[0].message))
                        self.assertIs(told[0].category, pointfront.PointFrontWarning)
                        self.assertEqual(told[0].filename, __file__)
                        with warnings.catch_warnings(record=True) as told:
                            warnings.simplefilter("always")
                            found = count(**{name: shape(x1 - edge, middle, 2 * edge)})
                        self.assertEqual([str(one.message) for one in told], [])
                        self.assertGreater(found, 0)

    def test_a_forked_child_asks_as_its_parent_did(self):
        with pointfront.open(self.stores["add"]) as cloud:
            count = len(cloud.points(attributes=[])["id"])
            for of_parent in (True, False):
                child = os.fork()
                if child == 0:
                    own = cloud if of_parent else pointfront.open(self.stores["add"])
                    same = len(own.points(attributes=[])["id"]) == count
                    own.close()
                    os._exit(0 if same else 1)
                self.assertEqual(self.end_of(child), 0, "it hangs, or has other points")
            self.assertEqual(len(cloud.points(attributes=[])["id"]), count)

    def end_of(self, child):
        end = time.monotonic() + LIMIT_SECONDS
        while time.monotonic() < end:
            pid, status = os.waitpid(child, os.WNOHANG)
            if pid:
                return status
            time.sleep(0.02)
        os.kill(child, 9)
        os.waitpid(child, 0)
        return None

    def test_a_pool_of_forked_processes_asks(self):
        with pointfront.open(self.stores["add"]) as cloud:
            count = len(cloud.points(attributes=[])["id"])
        with multiprocessing.get_context("fork").Pool(2) as pool:
            counts = pool.map_async(query_in_child, [self.stores["add"]] * 4).get(LIMIT_SECONDS)
        self.assertEqual(counts, [count] * 4)


if __name__ == "__main__":
    unittest.main(verbosity=2)
