"""Random scenes drawn by the tool and by windows of VTK, which must give the same picture.

Environment: POINTFRONT_PYTHON_PACKAGE the folder of the Python package; the seeds: see
random_cases.py; docs/developer/random-tests.md says what was found. It needs a display.
usage: test_random_windows.py [RandomWindows.test_KIND]
"""

import importlib
import json
import os
import sys
import time
import unittest

import numpy

from pair_test import PairTest
from pictures import share_alike
from random_cases import chance
from random_forms import PLY_TYPES, Points, write_ply
from random_pairs import EVERYTHING, Alike, Refused, Threads
from random_scenes import random_camera
from sheets import styles_of, with_known_ranges, without_sums

sys.path.insert(0, os.environ["POINTFRONT_PYTHON_PACKAGE"])
pointfront = importlib.import_module("pointfront")
core = importlib.import_module("vtkmodules.vtkRenderingCore")
numpy_support = importlib.import_module("vtkmodules.util.numpy_support")

BACKENDS = ("Software", "OpenGL")
# As test_random_styles.py says.
EDGE = 6
USUAL_STRENGTH, STRONG_TOLERANCE = 0.4, 8
NEAREST = 0.3  # metres: VTK's nearest plane cuts off what the tool draws just before the eye
# Metres: a splat that near, below or beside the eye, reaches into the view; that plane may cut it
# off, too.
BESIDE_EYE = 1.5
LIMIT = 600  # seconds until a view must have settled


def same_camera(camera, way):
    camera.SetPosition(way["position"])
    camera.SetFocalPoint(way["focal_point"])
    camera.SetViewUp(way["view_up"])
    camera.SetParallelProjection("parallel_scale" in way)
    if "parallel_scale" in way:
        camera.SetParallelScale(way["parallel_scale"])
    else:
        camera.SetViewAngle(way["view_angle"])


def before_eye(points, camera):
    """Metres from the eye to the nearest point, and along the line of sight to those beside the
    eye; of a parallel view, whose eye is a plane, along it to those that it may show."""
    to = points - camera["position"]
    along = numpy.subtract(camera["focal_point"], camera["position"])
    along /= numpy.linalg.norm(along)
    depth = to @ along
    if "parallel_scale" not in camera:
        away = numpy.linalg.norm(to, axis=1)
        beside = numpy.where((depth > 0) & (away < BESIDE_EYE), depth, away)
        return min(away.min(), beside.min())
    beside = numpy.linalg.norm(to - numpy.outer(depth, along), axis=1)
    return numpy.abs(depth[beside < 2 * camera["parallel_scale"]]).min(initial=numpy.inf)


class Window:
    """A window, used for one case after the other."""

    def __init__(self, size):
        self.renderer = core.vtkRenderer()
        self.renderer.SetBackground(0.2, 0.1, 0.3)
        self.window = core.vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetMultiSamples(0)
        self.window.SetSize(*size)
        self.window.AddRenderer(self.renderer)

    def show(self, stores, case, backend):
        """The mappers of the stores, an actor each. VTK takes a style that the tool takes."""
        self.renderer.RemoveAllViewProps()
        self.style = pointfront.vtkPointFrontStyle()
        if not self.style.LoadJSON(json.dumps(case["style"])):
            raise AssertionError(f"VTK refuses a style that the tool draws: {json.dumps(case)}")
        mappers = [self.add(store, float(case["error"]), backend) for store in stores]
        self.look(case["camera"])
        return mappers

    def add(self, store, error, backend):
        reader = pointfront.vtkPointFrontReader()
        reader.SetFileName(str(store))
        mapper = pointfront.vtkPointFrontMapper()
        mapper.SetInputConnection(reader.GetOutputPort())
        mapper.SetStyle(self.style)
        mapper.SetTargetError(error)
        mapper.SetPointBudget(0)
        getattr(mapper, f"SetBackendTo{backend}")()
        actor = core.vtkActor()
        actor.SetMapper(mapper)
        self.renderer.AddActor(actor)
        return mapper

    def look(self, camera):
        same_camera(self.renderer.GetActiveCamera(), camera)
        self.renderer.ResetCameraClippingRange()

    def pixels(self, scale=1, again=True):
        """`again`: of one more frame."""
        grab = core.vtkWindowToImageFilter()
        grab.SetInput(self.window)
        grab.SetScale(scale)
        grab.SetShouldRerender(again)
        grab.ReadFrontBufferOff()
        grab.Update()
        image = grab.GetOutput()
        columns, rows, _ = image.GetDimensions()
        values = numpy_support.vtk_to_numpy(image.GetPointData().GetScalars())
        return values.reshape(rows, columns, 3)[::-1]


class Windows(Threads):
    """The tool, and a window of each back end."""

    least_alike, tolerance = Alike.least_alike, Alike.tolerance

    def __init__(self, folder):
        super().__init__(folder)
        self.windows = {backend: Window(self.size) for backend in BACKENDS}

    def case(self, seed):
        """With an eye that is raised until no point is just before it."""
        case = super().case(seed)
        points = Points.read(self.folder / f"{self.cloud}.las").positions()
        camera = case["camera"]
        while before_eye(points, camera) < NEAREST:
            for end in ("position", "focal_point"):
                camera[end] = [*camera[end][:2], camera[end][2] + NEAREST]
        return case

    def whole(self, case, backend):
        for mapper in self.windows[backend].show([self.store], case, backend):
            mapper.CompleteOn()
        self.windows[backend].window.Render()
        return self.windows[backend].pixels()

    def ways(self, case):
        """Yields the windows that draw what the tool draws."""
        for backend in BACKENDS:
            yield f"window, {backend}", lambda backend=backend: self.whole(case, backend)

    def pictures(self, case):
        try:
            usual = self.drawn(self.store, case)
        except Refused:
            return
        yield "tool", lambda: usual
        yield from self.ways(case)

    def compared(self, usual, first, what, picture, case):
        strong = case["style"].get("shading", {}).get("strength", 0) > USUAL_STRENGTH
        tolerance = STRONG_TOLERANCE if strong else self.tolerance
        inner = slice(EDGE, -EDGE)
        alike = share_alike(first[inner, inner], picture[inner, inner], tolerance)
        if alike < self.least_alike:
            return f"{usual} and {what}: {alike:.5f} of the pixels are alike"
        return None


class NodeByNode(Windows):
    """The tool's picture, and frames while nodes load, after frames of another view."""

    def choose(self, rng):
        return {**super().choose(rng), "before": random_camera(rng, self.bounds)[1],
                "moving": chance(rng, 0.5)}

    def settled(self, case, backend):
        window = self.windows[backend]
        mapper, = window.show([self.store], case, backend)
        window.look(case["before"])
        window.window.SetDesiredUpdateRate(15.0 if case["moving"] else 0.0001)
        window.window.Render()
        window.window.SetDesiredUpdateRate(0.0001)
        window.look(case["camera"])
        window.window.Render()
        end = time.monotonic() + LIMIT
        while not mapper.GetLastComplete():
            if time.monotonic() > end:
                raise AssertionError(f"{backend}: not settled in a minute: {json.dumps(case)}")
            if mapper.NeedsRender():
                window.window.Render()
            else:
                time.sleep(0.001)
        return window.pixels()

    def ways(self, case):
        for backend in BACKENDS:
            yield f"node by node, {backend}", lambda backend=backend: self.settled(case, backend)


def scaled(sheet, by):
    """With what grows as a poster does: lenses, halos, the radius of eye-dome lighting."""
    sheet = json.loads(json.dumps(sheet))
    for lens in sheet.get("lenses", ()):
        for key in ("center_px", "size_px"):
            if key in lens:
                lens[key] = [by * edge for edge in lens[key]]
        if "radius_px" in lens:
            lens["radius_px"] *= by
    for highlight in sheet.get("highlight", ()):
        highlight["halo_px"] = by * highlight.get("halo_px", 2)
    if "edl" in sheet.get("shading", {}).get("mode", ()):
        sheet["shading"]["radius_px"] = by * sheet["shading"].get("radius_px", 1)
    return sheet


class Posters(Windows):
    """The tool's picture, and one put together of tiles of a window half as wide and high. Sizes by
    spacing follow the nodes in sight, of which a tile has fewer."""

    fixed_sizes = 0.3

    def __init__(self, folder):
        super().__init__(folder)
        self.windows = {backend: Window([edge // 2 for edge in self.size]) for backend in BACKENDS}

    def poster(self, case, backend):
        small = {**case, "style": scaled(case["style"], 0.5)}
        self.windows[backend].show([self.store], small, backend)[0].CompleteOn()
        self.windows[backend].window.Render()
        return self.windows[backend].pixels(2)

    def styled(self, sheet):
        """Returns the sheet with sizes in pixels that can be halved."""
        sheet = super().styled(sheet)
        for highlight in sheet.get("highlight", ()):
            highlight["halo_px"] = 2 * (highlight.get("halo_px", 2) // 2)
        if "edl" in sheet.get("shading", {}).get("mode", ()):
            sheet["shading"]["radius_px"] = 2
        return sheet

    def ways(self, case):
        for backend in BACKENDS:
            yield f"poster, {backend}", lambda backend=backend: self.poster(case, backend)


def cloud_by_cloud(sheet):
    """Without what looks at the pixels of all clouds: the tool has one picture of them, a window
    one of each."""
    sheet = without_sums(sheet)
    for style in styles_of(sheet):
        style.pop("opacity", None)
    sheet.pop("highlight", None)
    sheet["lenses"] = [lens for lens in sheet.get("lenses", ()) if "around_class" not in lens]
    shading = sheet.pop("shading", {})
    if "lit" in shading.get("mode", ()):
        sheet["shading"] = {key: shading[key] for key in ("ambient", "diffuse") if key in shading}
        sheet["shading"]["mode"] = "lit"
    return sheet


class Actors(Windows):
    """The tool's picture of three clouds, and windows with an actor for each, in either order."""

    fixed_sizes = 0.3

    def make(self, number, rng):
        columns = self.town(number).columns()
        self.stores = []
        for part in range(3):
            file = write_ply(self.folder / f"{part}.ply", {
                name: column[part::3] for name, column in columns.items()}, list(PLY_TYPES))
            self.stores.append(self.build(
                f"{part}.pfront", file, "--normals", "pca", "--node-points", 500, "--structure",
                rng.choice(("octree", "kdtree")), "--layers", rng.choice(("none", "class"))))
        self.store = self.stores
        return self.stores[0]

    def choose(self, rng):
        return {"error": EVERYTHING}

    def styled(self, sheet):
        return cloud_by_cloud(with_known_ranges(super().styled(sheet), self.bounds))

    def several(self, stores, case, backend):
        for mapper in self.windows[backend].show(stores, case, backend):
            mapper.CompleteOn()
        self.windows[backend].window.Render()
        return self.windows[backend].pixels()

    def ways(self, case):
        for backend in BACKENDS:
            for order, stores in (("", self.stores), (" in another order", self.stores[::-1])):
                yield f"actors{order}, {backend}", lambda backend=backend, stores=stores: (
                    self.several(stores, case, backend))


KINDS = (Windows, NodeByNode, Posters, Actors)
# (kind, case): the smallest cases that once differed.
FOUND = (*((Actors, {"cloud": 1, "style": {"default": {"technique": technique}}, "camera": {
    "position": [400081.734, 5599986.876, 73.175], "focal_point": [400060.267, 5600006.421, 70.775],
    "view_up": [0, 0, 1], "view_angle": 90}, "error": EVERYTHING})
           for technique in ("silhouettes", "splats")),
         *((kind, {"cloud": 3503, "style": {"lenses": [{
             "shape": "rectangle", "center_px": [196, 230], "size_px": [184, 134],
             "inside": {"default": {"technique": "splats", "size": {
                 "mode": "fixed", "metres": 0.3}}}}]}, "camera": {
                     "position": [400022.966, 5600007.208, 38.312],
                     "focal_point": [400039.194, 5600026.001, 38.312], "view_up": [0, 0, 1],
                     "view_angle": 90}, "error": EVERYTHING}) for kind in (Windows, Actors)),
         (Windows, {"cloud": 30046, "style": {"default": {"color": "elevation"}}, "camera": {
             "position": [400016.023, 5600013.748, 133.992],
             "focal_point": [400016.815, 5600013.974, 37.997], "view_up": [0, 1, 0],
             "view_angle": 20}, "error": "1"}))


class RandomWindows(PairTest):
    def test_pairs_that_once_differed(self):
        for number, (kind, case) in enumerate(FOUND):
            folder = self.folder / str(number)
            folder.mkdir()
            with self.subTest(kind=kind.__name__, case=json.dumps(case)):
                self.assertIsNone(kind(folder).difference(case))


for one in KINDS:
    setattr(RandomWindows, f"test_{one.__name__}", lambda self, kind=one: self.check(kind))


if __name__ == "__main__":
    unittest.main()
