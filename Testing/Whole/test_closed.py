"""Surfaces of real clouds are closed near the ground: what one sees through them is counted."""

import json
import unittest

import numpy

from scenes import SceneTest
from tool import DATA

BACKGROUND = (255, 0, 255)
MOST_OPEN = 0.02  # a share of the drawn pixels and the holes in them
CLOUDS = {
    "ahn3_261k.laz": ([131900, 549640, 60], [132150, 549800, 2]),
    "lidarhd_rgb_nir_698k.laz": ([484700, 6632650, 150], [484800, 6632800, 105]),
}


def enclosed(empty):
    """Returns the empty pixels that no way of empty ones leads to from the picture's edge."""
    outside = numpy.zeros_like(empty)
    outside[[0, -1]] = empty[[0, -1]]
    outside[:, [0, -1]] = empty[:, [0, -1]]
    while True:
        grown = outside.copy()
        for axis in (0, 1):
            for step in (1, -1):
                neighbour = numpy.roll(grown, step, axis)
                edge = 0 if step == 1 else -1
                (neighbour if axis == 0 else neighbour.T)[edge] = False
                grown |= neighbour & empty
        if (grown == outside).all():
            return empty & ~outside
        outside = grown


class Closed(SceneTest):
    def test_what_is_enclosed_is_told_from_what_is_outside(self):
        empty = numpy.ones((6, 7), bool)
        empty[1:5, 1:5] = False
        empty[2:4, 2:4] = True
        self.assertEqual(int(enclosed(empty).sum()), 4)
        empty[1, 2] = True  # a way out
        self.assertEqual(int(enclosed(empty).sum()), 0)

    def test_near_the_ground(self):
        for name, (eye, at) in CLOUDS.items():
            camera = self.folder / "camera.json"
            camera.write_text(json.dumps({"position": eye, "focal_point": at,
                                          "view_up": [0, 0, 1], "view_angle": 45}))
            for normals in ((), ("--normals", "pca")):
                store = self.folder / "store.pfront"
                self.succeed("build", DATA / "classified" / name, "-o", store, "--force", *normals)
                for technique in ("splats", "ewa"):
                    picture = self.picture(store, "--camera", camera, "--technique", technique,
                                           "--background", "1,0,1", size=(640, 360))
                    empty = (picture == BACKGROUND).all(axis=2)
                    holes, drawn = int(enclosed(empty).sum()), int((~empty).sum())
                    self.assertGreater(drawn, 20000)
                    self.assertLessEqual(holes / (holes + drawn), MOST_OPEN,
                                         (name, normals, technique))


if __name__ == "__main__":
    unittest.main(verbosity=2)
