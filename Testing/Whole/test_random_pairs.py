"""Random scenes drawn by the tool in several ways, which must give the same picture.

The environment names the seeds: see random_cases.py; docs/developer/random-tests.md says what was
found. usage: test_random_pairs.py [RandomPairs.test_KIND]
"""

import unittest

from pair_test import PairTest
from random_copies import Copies
from random_pairs import EVERYTHING, KINDS, Bands, Forms, NodeByNode, SeveralClouds

# (kind, case): the smallest cases that once differed.
FOUND = (
    # A splat that reaches behind the eye, beside holes that are filled, ended the tool.
    (Bands, {"cloud": 5007, "style": {"default": {"technique": "splats", "size": {
        "mode": "fixed", "metres": 0.45}}, "shading": {"fill_holes": True}},
             "camera": {"position": [400050.9952, 5600014.3733, 37.9989],
                        "focal_point": [400013.3892, 5600082.2450, 37.9989],
                        "view_up": [0, 0, 1], "view_angle": 90}, "error": "3", "memory": "12M"}),
    (SeveralClouds, {"cloud": 1, "style": {"default": {"technique": "silhouettes"}},
                     "camera": {"position": [400046.66, 5600009.52, 64.86],
                                "focal_point": [400117.03, 5600005.37, 64.86],
                                "view_up": [0, 0, 1], "view_angle": 90}, "error": EVERYTHING}),
    (SeveralClouds, {"cloud": 1, "style": {"default": {"technique": "splats"}},
                     "camera": {"position": [400009.98, 5599994.77, 113.53],
                                "focal_point": [400039.96, 5600005.28, 65.53],
                                "view_up": [0, 0, 1], "view_angle": 90}, "error": EVERYTHING}),
    # The view before kept the threshold, and "settled" came at 13 px.
    (NodeByNode, {"cloud": 1, "style": {}, "moving": False, "error": "3",
                  "camera": {"position": [400071.07, 5599917.28, 393.06],
                             "focal_point": [400018.28, 5600011.88, 73.06],
                             "view_up": [0, 0, 1], "view_angle": 20},
                  "before": {"position": [400064.176, 5599990.978, 69.742],
                             "focal_point": [400032.982, 5600008.424, 67.342],
                             "view_up": [0, 0, 1], "view_angle": 45}}),
    # A disc whose centre lies beside the view, in a node of an index that lies there whole.
    (Copies, {"cloud": 30017, "style": {}, "error": EVERYTHING, "coarser": "1", "of": "index",
              "camera": {"position": [400047.374, 5600001.890, 37.995],
                         "focal_point": [400031.139, 5600044.337, 37.995],
                         "view_up": [0, 0, 1], "view_angle": 45}}),
    # A class with a style of its own is a surface of its own, also in a store of one tree.
    (Forms, {"cloud": 2, "style": {"default": {"opacity": 0.5}, "classes": {"2": {}},
                                   "shading": {"fill_holes": True}},
             "camera": {"position": [637025.16, 851083.03, 6065.35],
                        "focal_point": [637066.08, 851073.87, 502.47],
                        "view_up": [0, 1, 0], "parallel_scale": 1854.29}, "error": EVERYTHING}),
)


class RandomPairs(PairTest):
    def test_pairs_that_once_differed(self):
        self.check_found(FOUND)


for one in (*KINDS, Copies):
    setattr(RandomPairs, f"test_{one.__name__}", lambda self, kind=one: self.check(kind))


if __name__ == "__main__":
    unittest.main()
