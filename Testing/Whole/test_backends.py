"""Real clouds by both back ends: the same pictures but for rounding, in both projections."""

import json
import shutil
import unittest

import numpy

from pictures import read_png
from scenes import SceneTest
from tool import DATA

TOLERANCE = 2  # of 255
LEAST_ALIKE = 0.995  # of the pixels
SIZE = "400x300"
# eye, focal point, half of the height of a parallel view
CLOUDS = {
    "classified/ahn3_261k.laz": ([131900, 549640, 60], [132050, 549740, 2], 60),
    "classified/lidarprod_rgb_buildings_71k.laz": (None, None, None),
    "las/real/autzen_trim.las": (None, None, None),
}
TECHNIQUES = {
    "splats": ("--technique", "splats"),
    "ewa": ("--technique", "ewa"),
    "spheres": ("--technique", "spheres"),
}


class Backends(SceneTest):
    def cameras(self, store, eye, at, half_height):
        """One in perspective and one parallel; of a cloud without an eye, around all of it."""
        if eye is None:
            facts = self.succeed("info", store, "--json").json
            low, high = (numpy.array(facts["bounds"][axes]) for axes in (slice(3), slice(3, 6)))
            at = ((low + high) / 2).tolist()
            size = float(numpy.linalg.norm(high - low))
            eye = (numpy.array(at) + numpy.array([-0.3, -0.4, 0.35]) * size).tolist()
            half_height = 0.25 * size
        camera = {"position": eye, "focal_point": at, "view_up": [0, 0, 1]}
        for name, more in (("perspective", {"view_angle": 45}),
                           ("parallel", {"parallel_scale": half_height})):
            path = self.folder / f"{name}.json"
            path.write_text(json.dumps({**camera, **more}))
            yield name, path

    def drawn(self, backend, *arguments):
        path = self.folder / f"{backend}.png"
        self.succeed("render", *arguments, "-o", path, "--size", SIZE, "--backend", backend,
                     "--background", "1,0,1")
        return read_png(path).astype(int)

    def test_real_clouds_look_alike(self):
        for name, view in CLOUDS.items():
            store = self.folder / "store.pfront"
            self.succeed("build", DATA / name, "-o", store, "--force", "--normals", "pca")
            for projection, camera in self.cameras(store, *view):
                for technique, words in TECHNIQUES.items():
                    what = f"{name}, {projection}, {technique}"
                    mine, other = (self.drawn(backend, store, "--camera", camera, *words)
                                   for backend in ("software", "opengl"))
                    self.assertGreater((mine != (255, 0, 255)).any(axis=2).mean(), 0.2, what)
                    alike = (abs(mine - other).max(axis=2) <= TOLERANCE).mean()
                    self.assertGreaterEqual(alike, LEAST_ALIKE, what)

    def test_a_las_file_in_place_has_lit_ellipses(self):
        """Normals that are computed while nodes load, and those that an index holds."""
        las = self.folder / "points.las"
        shutil.copyfile(DATA / "las/real/autzen_trim.las", las)
        side = self.folder / "points.las.pfindex"
        for normals in ("none", "scanline"):
            self.succeed("index", las, "--force", "--normals", normals)
            for projection, camera in self.cameras(side, None, None, None):
                words = ("--camera", camera, "--technique", "ewa", "--color-by", "intensity")
                flat = self.drawn("software", side, *words)
                mine, other = (self.drawn(backend, side, "--lit", *words)
                               for backend in ("software", "opengl"))
                what = f"{normals}, {projection}"
                seen = (mine != (255, 0, 255)).any(axis=2)
                self.assertGreater(seen.mean(), 0.2, what)
                shaded = (abs(mine - flat).max(axis=2) > TOLERANCE)[seen].mean()
                self.assertGreater(shaded, 0.5, what)
                alike = (abs(mine - other).max(axis=2) <= TOLERANCE).mean()
                self.assertGreaterEqual(alike, LEAST_ALIKE, what)


if __name__ == "__main__":
    unittest.main()
