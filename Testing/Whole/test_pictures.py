"""Both back ends draw what VTK's own mapper draws of all points, and what each needs."""

import json
import os
import unittest

from pictures import read_png, share_alike
from scenes import SIZE, TRIM, SceneTest
from tool import DATA, run

REFERENCE = os.environ["POINTFRONT_REFERENCE_PICTURE"]


class AgainstAllPoints(SceneTest):
    def compare(self, cloud, point_size):
        store = self.build(cloud)
        bounds = self.succeed("info", store, "--json").json["bounds"]
        low, high = bounds[:3], bounds[3:]
        centre = [(a + b) / 2 for a, b in zip(low, high)]
        extent = max(b - a for a, b in zip(low, high))
        cameras = {
            "above": ([0.2, 0.3, 1.9], [0, 1, 0]), # straight down, equal heights tie in depth
            "oblique": ([1.0, -1.0, 0.9], [0, 0, 1]),
            "near": ([-0.25, 0.2, 0.15], [0, 0, 1]),
        }
        for name, (offset, up) in cameras.items():
            with self.subTest(view=name):
                camera = self.folder / "camera.json"
                position = [c + extent * o for c, o in zip(centre, offset)]
                camera.write_text(json.dumps({
                    "position": position, "focal_point": centre, "view_up": up,
                    "view_angle": 30}))
                reference = self.folder / "reference.png"
                drawn = run(REFERENCE, cloud, camera, *SIZE, point_size, reference)
                self.assertEqual(drawn.status, 0, drawn)
                theirs = read_png(reference)
                covered = float((theirs.max(axis=2) > 0).mean())
                self.assertGreater(covered, 0.15, "the view shows too little to compare")
                for backend in ("software", "opengl"):
                    ours, statistics = self.statistics(
                        store, "--camera", camera, "--complete", "--error", "0.01", "--color-by",
                        "rgb", "--point-size", point_size, "--background", "0,0,0", "--backend",
                        backend)
                    self.assertTrue(statistics["complete"])
                    self.assertEqual(statistics["backend"], backend)
                    self.assertGreaterEqual(share_alike(ours, theirs), 0.995, backend)

    def test_eight_bit_colours(self):
        self.compare(TRIM, 2)

    def test_a_city_with_sixteen_bit_colours(self):
        self.compare(DATA / "classified/lidarhd_rgb_nir_698k.laz", 1)


class BackEnds(SceneTest):
    """One picture, whoever draws it."""

    def test_colours_and_views(self):
        store = self.folder / "shapes.pfront"
        self.succeed("build", TRIM, "-o", store, "--normals", "pca", "--local-height",
                     "--layers", "class")
        camera = self.folder / "camera.json"
        bounds = self.succeed("info", store, "--json").json["bounds"]
        middle = [(a + b) / 2 for a, b in zip(bounds[:3], bounds[3:])]
        camera.write_text(json.dumps({
            "position": [middle[0] - 300, middle[1] - 200, middle[2] + 400],
            "focal_point": middle, "view_up": [0, 0, 1], "parallel_scale": 150}))
        size = ("--point-size", 2) # "auto" is each back end's own
        kinds = [("--color-by", name, *size) for name in
                 ("rgb", "classification", "intensity", "elevation", "normal", "horizontality",
                  "global-height", "local-height", "return_number")]
        kinds += [(*kind, *size) for kind in
                  (("--view", "left"), ("--camera", camera), ("--classes", "2"),
                   ("--error", "6"), ("--detail", "view"))]
        kinds += [("--view", "top", "--point-size", "1")]
        for kind in kinds:
            software, counts = self.statistics(store, *kind, "--backend", "software")
            opengl, other = self.statistics(store, *kind, "--backend", "opengl")
            # Equal depths may be drawn in another order.
            self.assertGreater(share_alike(software, opengl), 0.985, kind)
            self.assertEqual(counts["points_drawn"], other["points_drawn"], kind)


class Machine(SceneTest):
    def test_without_an_x_server(self):
        store = self.build(TRIM)
        bare = {k: v for k, v in os.environ.items() if k != "DISPLAY"}
        for environment in (bare, {**bare, "DISPLAY": ":4711"}):
            outcome = self.refuse(1, "render", store, "-o", self.folder / "x.png", "--backend",
                                  "opengl", environment=environment)
            self.assertIn("xvfb-run", outcome.err)
        self.assertEqual(self.entries(), ["cloud.pfront"])

    def test_opengl_has_a_largest_picture(self):
        outcome = self.refuse(1, "render", self.build(TRIM), "-o", self.folder / "x.png", "--size",
                              "20000x10", "--backend", "opengl")
        self.assertIn("--backend software", outcome.err)
        self.assertEqual(self.entries(), ["cloud.pfront"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
