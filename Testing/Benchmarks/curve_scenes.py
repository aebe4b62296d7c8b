"""Scenes of quality_curve.py: clouds, views, and the picture that each view should give.

The true picture of a made-up scene (town, knot) comes from its surface: `truth` casts rays at it.
That of a real cloud is drawn from all of its points by EWA splats in full accuracy, four times as
wide and high as the pictures that are judged, and averaged over four by four pixels.
"""

import json
import math
import pathlib
import sys

import numpy
from programs import call

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "Whole"))
import pictures  # noqa: E402 (found by the line above)

SIZE = (800, 600)
SUPERSAMPLES = 4
BACKGROUND = (39, 42, 47)
PAN_PX = 0.25  # between the two frames whose difference tells the flicker
TURN = 60  # frames of a motion that ends in a view
TURN_DEGREES = 20


def camera_at(centre, distance, azimuth, elevation, view_angle=30.0):
    """A camera as the tool reads it; angles in degrees, azimuth 0 looks north."""
    a, e = math.radians(azimuth), math.radians(elevation)
    arm = (math.cos(e) * math.sin(a), -math.cos(e) * math.cos(a), math.sin(e))
    return {"position": [c + distance * d for c, d in zip(centre, arm)],
            "focal_point": list(centre), "view_up": [0, 0, 1], "view_angle": view_angle}


def turned(camera, degrees):
    """The camera, turned about the vertical through its focal point."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    focal = camera["focal_point"]
    x, y, z = (p - f for p, f in zip(camera["position"], focal))
    return {**camera, "position": [focal[0] + c * x - s * y, focal[1] + s * x + c * y,
                                   focal[2] + z]}


def panned(camera):
    """The camera, moved to the right by a quarter of a pixel at the depth of its focal point."""
    eye, focal = (numpy.array(camera[key], float) for key in ("position", "focal_point"))
    forward = focal - eye
    depth = numpy.linalg.norm(forward)
    right = numpy.cross(forward / depth, camera["view_up"])
    right /= numpy.linalg.norm(right)
    pixel = 2 * depth * math.tan(math.radians(camera["view_angle"] / 2)) / SIZE[1]
    return {**camera, "position": list(eye + PAN_PX * pixel * right),
            "focal_point": list(focal + PAN_PX * pixel * right)}


class View:
    """A camera, and in `folder` the picture it should give with the mask of what is surface."""

    def __init__(self, name, camera, folder):
        self.name, self.camera, self.folder = name, camera, folder
        folder.mkdir(parents=True, exist_ok=True)
        self.truth, self.mask = folder / "truth.png", folder / "mask.png"
        self.camera_file = self.write("camera.json", camera)

    def write(self, name, value):
        path = self.folder / name
        path.write_text(json.dumps(value))
        return path

    def motion_file(self):
        """Cameras that turn about the cloud and end in this view, a frame each."""
        return self.write("motion.json", [
            dict(turned(self.camera, TURN_DEGREES * (k + 1 - TURN) / TURN), frames=1)
            for k in range(TURN)])


class Scene:
    """A cloud as a point file, its stores and its views."""

    def __init__(self, name, source, work, tool):
        self.name, self.source, self.work, self.tool = name, source, work / name, tool
        self.work.mkdir(parents=True, exist_ok=True)

    def store(self, label="octree", words=()):
        """Built once, with normals unless the words say otherwise."""
        store = self.work / f"{label}.pfront"
        if not store.exists():
            call(self.tool, "build", self.source, "-o", store, "--progress", "none",
                 "--normals", "pca", *words)
        return store

    def draw(self, store, camera_file, out, *words, size=SIZE):
        """Draws a complete picture; what --stats says of it."""
        statistics = out.with_suffix(".json")
        call(self.tool, "render", store, "-o", out, "--camera", camera_file, "--size",
             f"{size[0]}x{size[1]}", "--background", ",".join(map(str, BACKGROUND)), "--stats",
             statistics, *words)
        return json.loads(statistics.read_text())


class RealScene(Scene):
    """A cloud that someone measured: far, middle, near and from above."""

    def views(self, names=("far", "middle", "near", "top")):
        """The views of these names, with true pictures, which are made if they are not there."""
        bounds = json.loads(call(self.tool, "info", self.store(), "--json"))["bounds"]
        low, high = bounds[:3], bounds[3:]
        centre = [(a + b) / 2 for a, b in zip(low, high)]
        far = 1.1 * math.dist(low, high)
        cameras = {"far": camera_at(centre, far, 45, 35),
                   "middle": camera_at(centre, far / 3, 110, 30),
                   "near": camera_at(centre, far / 9, 200, 25),
                   "top": camera_at(centre, far, 0, 89)}
        views = [View(name, camera, self.work / name) for name, camera in cameras.items()
                 if name in names]
        for view in views:
            self.make_truth(view.camera_file, view.truth, view.mask)
        return views

    def flicker_truth(self, view):
        """The true picture from a quarter of a pixel to the right."""
        picture = view.folder / "truth_panned.png"
        self.make_truth(view.write("panned.json", panned(view.camera)), picture, None)
        return picture

    def make_truth(self, camera_file, picture, mask):
        if picture.exists():
            return
        large = picture.with_name("large.png")
        style = picture.with_name("full.json")
        style.write_text('{"default": {"technique": "ewa", "accuracy": "full"}}')
        self.draw(self.store(), camera_file, large, "--style", style, "--error", "0.01", "--memory",
                  "3G", size=[SUPERSAMPLES * side for side in SIZE])
        fine = pictures.read_png(large)
        cells = fine.reshape(SIZE[1], SUPERSAMPLES, SIZE[0], SUPERSAMPLES, 3)
        if mask:
            empty = (cells == BACKGROUND).all(axis=4).mean(axis=(1, 3))
            covered = numpy.where(empty < 0.5, 255, 0).astype(numpy.uint8)
            pictures.write_png(mask, numpy.repeat(covered[:, :, None], 3, axis=2))
        pictures.write_png(picture, numpy.rint(cells.mean(axis=(1, 3))).astype(numpy.uint8))
        large.unlink()


class TrueScene(Scene):
    """A made-up scene, seen as `truth` sees it; its points are half a pixel apart there."""

    def __init__(self, name, work, tool, truth):
        folder = work / name / "truth"
        super().__init__(name, folder / "points.ply", work, tool)
        if not (folder / "truth.json").exists():  # written last
            call(truth, *self.words(), "-o", folder)
        if not (folder / "panned/truth.png").exists():
            call(truth, *self.words(), "--pan-px", PAN_PX, "-o", folder / "panned")
        self.folder = folder

    def words(self):
        return [self.name, "--view", "mid", "--sampling", "blue", "--spacing-px", "0.5", "--width",
                SIZE[0], "--height", SIZE[1], "--samples", "8"]

    def views(self):
        facts = json.loads((self.folder / "truth.json").read_text())
        if tuple(facts["background"]) != BACKGROUND:
            raise SystemExit(f"{self.folder}: another background than {BACKGROUND}")
        return [View("middle", json.loads((self.folder / "camera.json").read_text()), self.folder)]

    def flicker_truth(self, view):
        view.write("panned.json",
                   json.loads((self.folder / "panned/camera.json").read_text()))
        return self.folder / "panned/truth.png"


def scenes(names, tool, truth, data, work):
    """The scenes of these names, in their order."""
    data = data or pathlib.Path()
    files = {"autzen": data / "large/autzen_10653336_rgb_intensity.laz",
             "lidarhd": data / "classified/lidarhd_rgb_nir_698k.laz",
             "pond": data / "normals/pond_pmvs_rgb_normals_70k.ply",
             "stadium": pathlib.Path(__file__).parents[1] / "Data/autzen_stadium.laz"}
    for name in names:
        if name in files:
            yield RealScene(name, files[name], work, tool)
        elif name in ("town", "knot"):
            yield TrueScene(name, work, tool, truth)
        else:
            raise SystemExit(f"no scene '{name}': town, knot, {', '.join(files)}")
