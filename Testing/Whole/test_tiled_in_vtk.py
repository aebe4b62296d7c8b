"""Lists and collections of tiles in Python and VTK, from files and by address.

Environment: POINTFRONT_PYTHON_PACKAGE the folder of the Python package; others as tool.py.
"""

import os
import pathlib
import subprocess
import sys
import unittest

import numpy
from tool import ToolTest
from virtual_clouds import write_tiles

SERVER = pathlib.Path(__file__).resolve().parents[1] / "Support/far_server.py"
sys.path.insert(0, os.environ["POINTFRONT_PYTHON_PACKAGE"])
os.environ["POINTFRONT_CACHE"] = "off"
os.environ["no_proxy"] = HERE = "127.0.0.1"

# pylint: disable=wrong-import-position
import pointfront
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer, vtkRenderWindow

SIDE = 3
NAMES = ("all.vpc", "all.pfronts", "all.pfcollection")


def sorted_rows(points):
    """The rows of an array in an order that depends on their values alone."""
    return points[numpy.lexsort(points.T)]


class Tiled(ToolTest):
    def setUp(self):
        super().setUp()
        self.succeed("generate", "--points", "3000", "-o", self.folder / "one.las")
        copc = self.folder / "one.copc.laz"
        self.succeed("export", self.build(self.folder / "one.las"), "-o", copc)
        tiles = write_tiles(copc, self.folder, SIDE, (150, 60))
        names = sorted(tile.name for tile in self.folder.glob("tile-*.copc.laz"))
        (self.folder / "all.pfronts").write_text("\n".join(names) + "\n")
        self.succeed("collection", "create", self.folder / "all.pfcollection",
                     *(self.folder / name for name in names))
        out = self.folder / "all.csv"
        self.succeed("export", tiles, "-o", out)
        table = numpy.genfromtxt(out, delimiter=",", names=True)
        self.expected = sorted_rows(numpy.column_stack([table[axis] for axis in "xyz"]))
        self.assertEqual(len(self.expected), SIDE * SIDE * 3000)

    def serve(self):
        """The address of a server of the folder. It is a process of its own, because a window of
        VTK keeps Python's lock while it waits for the points that it draws."""
        server = subprocess.Popen([sys.executable, "-B", SERVER, self.folder],
                                  stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.addCleanup(server.__exit__, None, None, None)
        return f"http://{HERE}:{server.stdout.readline().strip()}"

    def drawn(self, name):
        """How many points a window of VTK draws of a cloud of which it draws all."""
        reader = pointfront.vtkPointFrontReader()
        reader.SetFileName(str(name))
        mapper = pointfront.vtkPointFrontMapper()
        mapper.SetInputConnection(reader.GetOutputPort())
        mapper.SetTargetError(0.01)
        mapper.CompleteOn()
        actor = vtkActor()
        actor.SetMapper(mapper)
        renderer = vtkRenderer()
        renderer.AddActor(actor)
        window = vtkRenderWindow()
        window.SetOffScreenRendering(1)
        window.SetSize(400, 300)
        window.AddRenderer(renderer)
        renderer.ResetCamera()
        window.Render()
        self.assertTrue(mapper.GetLastComplete(), name)
        return mapper.GetLastPointsDrawn()

    def test_their_points_are_those_of_the_tiles(self):
        for place in (str(self.folder), self.serve()):
            for name in NAMES:
                with self.subTest(name=name, far=place.startswith("http")):
                    with pointfront.open(f"{place}/{name}") as cloud:
                        points = cloud.points()["position"]
                    numpy.testing.assert_allclose(
                        sorted_rows(numpy.asarray(points)), self.expected, atol=1e-6)
                    self.assertEqual(self.drawn(f"{place}/{name}"), len(self.expected))


if __name__ == "__main__":
    unittest.main()
