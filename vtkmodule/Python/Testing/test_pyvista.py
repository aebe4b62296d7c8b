"""Stored clouds in PyVista: a store in a Plotter is an actor like another. Needs a display."""

import importlib
import pathlib
import shutil
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "Testing/Support"))
# pylint: disable=wrong-import-position
from far_setting import HERE
import numpy
import pointfront
import pyvista
from far_server import FarServer

core = importlib.import_module(pointfront.VTK_PACKAGE + ".vtkRenderingCore")
CLOUD = ROOT / "Testing/Data/autzen_stadium.laz"
SIZE = (320, 240)


class PyVista(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="pointfront-pyvista-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        pointfront.build(CLOUD, cls.folder / "a.pfront")
        cls.cloud = pointfront.open(cls.folder / "a.pfront")

    def plotter(self, **options):
        plotter = pyvista.Plotter(off_screen=True, window_size=SIZE, **options)
        plotter.set_background("black")
        self.addCleanup(plotter.close)
        return plotter

    def picture(self, **options):
        plotter = self.plotter()
        actor = self.cloud.add_to(plotter, **options)
        return plotter, actor, plotter.screenshot(return_img=True)

    def test_one_line_adds_a_store(self):
        plotter, actor, picture = self.picture()
        self.assertIsInstance(actor, pyvista.Actor)
        self.assertIn(actor, plotter.actors.values())
        low, high = self.cloud.bounds
        numpy.testing.assert_allclose(actor.bounds, [v for pair in zip(low, high) for v in pair])
        self.assertGreater((picture.max(axis=2) > 0).mean(), 0.2)
        self.assertTrue(actor.mapper.GetLastComplete())
        self.assertGreater(actor.mapper.GetLastPointsDrawn(), 10000)
        self.assertEqual(len(plotter.scalar_bars), 0)  # its own colours
        self.assertEqual(actor.prop.point_size, 2.0)  # not the theme's five
        plotter.remove_actor(actor)
        self.assertEqual(int(plotter.screenshot(return_img=True).max()), 0)

    def test_colours_and_the_scalar_bar(self):
        pictures = {}
        for cmap in ("gray", "viridis"):
            plotter, actor, pictures[cmap] = self.picture(
                scalars="elevation", cmap=cmap, clim=(410, 500),
                scalar_bar_args={"title": "height"})
            self.assertEqual(list(plotter.scalar_bars.keys()), ["height"])
            self.assertEqual(tuple(plotter.scalar_bars["height"].GetLookupTable().GetRange()),
                             (410, 500))
            self.assertEqual(tuple(actor.mapper.scalar_range), (410, 500))
        gray = pictures["gray"]
        self.assertLess(int((gray.max(axis=2) - gray.min(axis=2)).max()), 2)
        colour = pictures["viridis"]
        self.assertGreater(int((colour.max(axis=2) - colour.min(axis=2)).max()), 60)
        plotter, _, _ = self.picture(scalars="intensity", show_scalar_bar=False)
        self.assertEqual(len(plotter.scalar_bars), 0)
        with self.assertRaisesRegex(pointfront.PointFrontError, "colour"):
            self.cloud.add_to(self.plotter(), scalars="colour")

    def test_it_is_drawn_as_a_mesh_of_the_same_points(self):
        """The same points, 3 pixels each, by PyVista's own mapper and from the store."""
        mesh = self.cloud.to_pyvista(attributes=[])
        mesh["elevation"] = mesh.points[:, 2]
        pictures = []
        for add in (lambda p: p.add_points(mesh, scalars="elevation", cmap="gray", point_size=3,
                                           clim=(410, 500), show_scalar_bar=False, lighting=False),
                    lambda p: self.cloud.add_to(p, scalars="elevation", cmap="gray", point_size=3,
                                                clim=(410, 500), show_scalar_bar=False,
                                                error=0.01)):
            plotter = self.plotter()
            add(plotter)
            plotter.view_xy()
            pictures.append(plotter.screenshot(return_img=True).astype(int))
        close = (numpy.abs(pictures[0] - pictures[1]).max(axis=2) <= 3).mean()
        self.assertGreater(close, 0.95)  # centres of points fall on edges of pixels
        covered = [(picture.max(axis=2) > 0).mean() for picture in pictures]
        self.assertLess(abs(covered[0] - covered[1]), 0.005)
        self.assertGreater(pictures[0].std(), 10)

    def test_names_replace_and_other_actors_stand_beside(self):
        plotter = self.plotter()
        self.cloud.add_to(plotter, name="cloud")
        actor = self.cloud.add_to(plotter, name="cloud", point_size=2)
        plotter.add_mesh(pyvista.Sphere(radius=200, center=actor.center), color="red")
        self.assertEqual(len(plotter.actors), 2)
        self.assertIs(plotter.actors["cloud"], actor)
        picture = plotter.screenshot(return_img=True).astype(int)
        self.assertGreater(((picture[..., 0] - picture[..., 1]) > 60).mean(), 0.02)

    def test_picking_gives_stored_points(self):
        plotter, actor, _ = self.picture(point_size=5)
        plotter.view_xy()
        plotter.render()
        selector = core.vtkHardwareSelector()
        selector.SetFieldAssociation(0)
        selector.SetRenderer(plotter.renderer)
        selector.SetArea(140, 100, 180, 140)
        selection = selector.Select()
        ids = []
        for i in range(selection.GetNumberOfNodes()):
            node = selection.GetNode(i)
            if node.GetSelectionList() is not None:
                ids.append(pyvista.convert_array(node.GetSelectionList()))
        ids = numpy.concatenate(ids)
        self.assertGreater(len(ids), 100)
        everything = self.cloud.points(attributes=[])
        chosen = everything["position"][numpy.isin(everything["id"], ids)]
        self.assertEqual(len(chosen), len(set(ids.tolist())))
        middle = numpy.mean(self.cloud.bounds, axis=0)
        self.assertLess(numpy.abs(chosen - middle)[:, :2].max(), 200)

        picker = core.vtkPropPicker()
        self.assertTrue(picker.PickProp(160, 120, plotter.renderer))
        self.assertIs(picker.GetActor(), actor)

    def test_views_are_linked(self):
        plotter = self.plotter(shape=(1, 2))
        for column in range(2):
            plotter.subplot(0, column)
            self.cloud.add_to(plotter, point_size=2)
        plotter.link_views()
        plotter.subplot(0, 0)
        plotter.camera_position = "xy"
        plotter.camera.zoom(2)
        picture = plotter.screenshot(return_img=True).astype(int)
        left, right = picture[:, 2:158], picture[:, 162:318]  # without the border
        self.assertGreater((left.max(axis=2) > 0).mean(), 0.5)
        close = (numpy.abs(left - right).max(axis=2) <= 3).mean()
        self.assertGreater(close, 0.97)

    def test_a_region_comes_back_as_polydata(self):
        low, high = map(numpy.array, self.cloud.bounds)
        box = (low, (low + high) / 2)
        mesh = self.cloud.to_pyvista(box=box, attributes=["intensity", "classification"])
        self.assertIsInstance(mesh, pyvista.PolyData)
        arrays = self.cloud.points(box=box)
        self.assertGreater(mesh.n_points, 1000)
        self.assertEqual(mesh.n_points, len(arrays["id"]))
        numpy.testing.assert_array_equal(mesh.points, arrays["position"])
        numpy.testing.assert_array_equal(mesh["intensity"], arrays["intensity"])
        self.assertNotIn("rgb", mesh.point_data)
        numpy.testing.assert_array_equal(mesh["point_id"], arrays["id"])

    def test_attributes_called_as_the_arrays_of_points_are(self):
        count = 1000
        random = numpy.random.default_rng(5)
        arrays = {"position": random.uniform(0, 10, (count, 3)),
                  **{name: random.integers(0, 1 << 15, count, "uint16")
                     for name in ("point_id", "id_")}}  # "id" is no attribute
        store = self.folder / "names.pfront"
        pointfront.build(arrays, store)
        cloud = pointfront.open(store)
        points, mesh = cloud.points(), cloud.to_pyvista()
        numpy.testing.assert_array_equal(mesh.points, points["position"])
        numpy.testing.assert_array_equal(mesh["point_id"], points["id"])
        for array, given in (("point_id_", "point_id"), ("id", "id_")):
            numpy.testing.assert_array_equal(mesh[array], points[given], array)
            self.assertEqual(sorted(mesh[array]), sorted(arrays[given]), array)

    def test_a_cloud_of_a_server_is_drawn_as_its_file(self):
        with FarServer(self.folder) as server:
            far = pointfront.open(f"http://{HERE}:{server.port}/a.pfront")
            plotter = self.plotter()
            far.add_to(plotter, complete=True)
            picture = plotter.screenshot(return_img=True)
            mesh = far.to_pyvista(spacing=20)
        numpy.testing.assert_array_equal(picture, self.picture(complete=True)[2])
        self.assertGreater(picture.std(), 10)
        numpy.testing.assert_array_equal(mesh.points, self.cloud.to_pyvista(spacing=20).points)


if __name__ == "__main__":
    unittest.main(verbosity=2)
