"""Programs of Debian read our exports: LASzip, PCL and, where it is there, VTK.

Environment, beside that of tool.py: POINTFRONT_LASZIP the library, POINTFRONT_PCL_POINTS the
program that reads PCD files with PCL.
"""

import collections
import ctypes
import os
import struct
import unittest

from test_left_out import las_steps
from tool import DATA, ToolTest, run

SMALL = DATA / "las/real/1.2-with-color.las"
try:
    import vtkmodules.vtkIOInfovis
    import vtkmodules.vtkIOPLY
    from vtkmodules.util.numpy_support import vtk_to_numpy
    WITH_VTK = True
except ImportError:
    WITH_VTK = False


def steps_of(points):
    """Centimetres of world coordinates, sorted."""
    return sorted(tuple(round(c * 100) for c in point) for point in points)


def laszip_points(path):
    """World coordinates of all points, by LASzip's own reader."""
    library = ctypes.CDLL(os.environ["POINTFRONT_LASZIP"])
    reader = ctypes.c_void_p()

    def call(name, *arguments):
        status = getattr(library, name)(*arguments)
        if status:
            raise AssertionError(f"{name}: {status}")

    call("laszip_create", ctypes.byref(reader))
    compressed = ctypes.c_int()
    call("laszip_open_reader", reader, str(path).encode(), ctypes.byref(compressed))
    points = []
    place = (ctypes.c_double * 3)()
    for _ in range(struct.unpack_from("<I", path.read_bytes(), 107)[0]):
        call("laszip_read_point", reader)
        call("laszip_get_coordinates", reader, place)
        points.append(tuple(place))
    call("laszip_close_reader", reader)
    call("laszip_destroy", reader)
    return bool(compressed.value), points


def las_colours(path):
    """How often each colour occurs in a LAS file of format 2 or 3."""
    data = path.read_bytes()
    first, = struct.unpack_from("<I", data, 96)
    kind, size, count = struct.unpack_from("<BHI", data, 104)
    at = {2: 20, 3: 28}[kind]
    return collections.Counter(
        struct.unpack_from("<3H", data, first + i * size + at)
        for i in range(count))


class Neighbours(ToolTest):
    def setUp(self):
        super().setUp()
        self.store = self.build(SMALL)
        self.expected = las_steps(SMALL)
        self.assertEqual(len(self.expected), 1065)

    def export(self, name, *options):
        out = self.folder / name
        self.succeed("export", self.store, "-o", out, *options)
        return out

    def test_laszip(self):
        for kind in ("las", "laz"):
            compressed, points = laszip_points(self.export(f"x.{kind}"))
            self.assertEqual(compressed, kind == "laz")
            self.assertEqual(steps_of(points), self.expected)

    def test_pcl_typed_points(self):
        out = self.export("x.pcd")
        origin = [float(c) for c in
                  out.read_bytes()[:600].split(b"# ORIGIN ")[1].split(b"\n")[0].split()]
        read = run(os.environ["POINTFRONT_PCL_POINTS"], out)
        self.assertEqual((read.status, read.err), (0, ""))  # PCL warns of fields it cannot match
        rows = [[float(c) for c in line.split()] for line in read.out.splitlines()]
        self.assertEqual(steps_of([p + o for p, o in zip(row[:3], origin)] for row in rows),
                         self.expected)
        self.assertGreater(max(row[3] for row in rows), 0.0)  # intensity
        self.assertEqual(collections.Counter(tuple(map(int, row[4:])) for row in rows),
                         las_colours(SMALL))

    @unittest.skipUnless(WITH_VTK, "VTK's Python package is not there")
    def test_vtk_readers(self):
        ply = vtkmodules.vtkIOPLY.vtkPLYReader()
        ply.SetFileName(str(self.export("x.ply")))
        ply.Update()
        points = vtk_to_numpy(ply.GetOutput().GetPoints().GetData())
        self.assertEqual(len(points), 1065)
        # It keeps float32: as many digits as that has.
        got = sorted(map(tuple, points.tolist()))
        for axis in range(3):
            values = sorted(p[axis] for p in got)
            wanted = sorted(s[axis] / 100 for s in self.expected)
            self.assertLess(max(abs(a - b) for a, b in zip(values, wanted)), 0.5)
        colours = vtk_to_numpy(ply.GetOutput().GetPointData().GetArray("RGB"))
        self.assertEqual(collections.Counter(map(tuple, colours.tolist())), las_colours(SMALL))
        table = vtkmodules.vtkIOInfovis.vtkDelimitedTextReader()
        table.SetFileName(str(self.export("x.csv")))
        table.SetHaveHeaders(True)
        table.DetectNumericColumnsOn()
        table.Update()
        columns = [vtk_to_numpy(table.GetOutput().GetColumnByName(a)) for a in "xyz"]
        self.assertEqual(steps_of(zip(*columns)), self.expected)


if __name__ == "__main__":
    unittest.main()
