"""Random scenes that load node by node: each point is drawn about once, and the last frame is the
picture at one go, in both back ends.

Environment: POINTFRONT_LOADING_SCENES the program; the seeds: see random_cases.py;
docs/developer/random-tests.md says what was found. It needs a display.
usage: test_random_loading.py [RandomLoading.test_KIND]
"""

import unittest

from pair_test import PairTest
from random_loading import KINDS, Loading, LoadingClouds, LoadingMeans

USUAL = 4  # a scene has dozens of frames, of both back ends
OPACITIES = (("2", 0.8), ("5", 0.7), ("6", 0.6), ("9", 0.5))
# (kind, case): the smallest cases that once differed.
FOUND = ((Loading, {"cloud": 7, "style": {}, "camera": {
    "position": [400499.25, 5600214.90, 411.29], "focal_point": [400043.91, 5600006.65, 91.31],
    "view_up": [0, 0, 1], "view_angle": 45}, "error": "0.01", "growth": 0}),
    # Two points of a pixel at one depth.
    (Loading, {"cloud": 9, "style": {"default": {"technique": "splats"}}, "camera": {
        "position": [400071.1292686941, 5600018.623587355, 71.21919381167415],
        "focal_point": [400038.45385257935, 5600016.841604646, 68.81958381167347],
        "view_up": [0, 0, 1], "view_angle": 20}, "error": "3", "growth": 0.05}),
    # Two classes share about the least ground that counts.
    (LoadingClouds, {"cloud": 5, "style": {}, "camera": {
        "position": [399986.0240562979, 5600040.6376106655, 59.29799211512316],
        "focal_point": [400030.1834021716, 5600017.512486468, 56.89838211512247],
        "view_up": [0, 0, 1], "view_angle": 20}, "error": "3", "growth": 0}),
    # Three clouds are more than 16 pictures.
    (LoadingClouds, {"cloud": 5, "style": {
        "classes": {name: {"opacity": share} for name, share in OPACITIES}, "lenses": [{
            "shape": "circle", "center_px": [240, 160], "radius_px": 250,
            "inside": {name: {"opacity": 0.8 * share} for name, share in OPACITIES}}]},
        "camera": {
            "position": [400002.5240765792, 5599663.349002757, 381.9656177524917],
            "focal_point": [400048.47211211245, 5600015.878300028, 62.01761775240042],
            "view_up": [0, 0, 1], "view_angle": 20}, "error": "0.01", "growth": 0}),
    # The children of a node in the view lie beside it.
    (LoadingMeans, {"cloud": 36501, "style": {"default": {}}, "camera": {
        "position": [400043.6426056663, 5600037.154958342, 59.05258312074294],
        "focal_point": [400039.86028327316, 5600035.324916195, 52.65274312074123],
        "view_up": [0, 0, 1], "view_angle": 45}, "error": "1", "growth": 0}),
    # The mask of a lens has a size in metres.
    (LoadingMeans, {"cloud": 37002, "style": {"lenses": [
        {"around_class": 5, "radius": 1.0, "inside": {"default": {"color": "elevation"}}}]},
        "camera": {
            "position": [400023.1415385409, 5600018.244364642, 149.17278858599667],
            "focal_point": [400022.64370498573, 5600018.115764761, 53.185988585995005],
            "view_up": [0, 1, 0], "view_angle": 90}, "error": "0.01", "growth": 0}),
    # All that is opaque comes after what is translucent.
    (LoadingMeans, {"cloud": 37506, "style": {
        "default": {"opacity": 0.2}, "classes": {"5": {"opacity": 0.4}, "6": {"blended": True}}},
        "camera": {
            "position": [400067.55581124825, 5600005.692768945, 44.397338598372016],
            "focal_point": [400061.46169205406, 5600006.579471495, 37.99877859837056],
            "view_up": [0, 0, 1], "view_angle": 20}, "error": "0.01", "growth": 0.05}),
    # The trees of hidden classes are not loaded.
    (LoadingClouds, {"cloud": 5, "style": {"classes": {"2": {"visible": False}}}, "camera": {
        "position": [400037.03044364793, 5600028.989640989, 58.06921272895356],
        "focal_point": [400072.9995474673, 5600102.090273316, 58.06921272895356],
        "view_up": [0, 0, 1], "view_angle": 45}, "error": "1", "growth": 0}))


class RandomLoading(PairTest):
    def test_scenes_that_once_differed(self):
        self.check_found(FOUND)


for one in KINDS:
    setattr(RandomLoading, f"test_{one.__name__}", lambda self, kind=one: self.check(kind, USUAL))


if __name__ == "__main__":
    unittest.main()
