"""A camera that a mouse moves around a cloud whose z points up."""

import math

import numpy

_HIGHEST = math.pi / 2  # elevation
_LEAST_DISTANCE = 1e-9  # a share of the coordinates: the eye and its focal point stay apart


class OrbitCamera:
    """Looks at a focal point from a distance, an azimuth and an elevation; never upside down.

    Lengths on the screen are parts of the picture's height, from its centre, up and right.
    """

    def __init__(self, camera):
        """`camera`: {"position", "focal_point", "view_up", "view_angle"}, world units, degrees."""
        self.focal_point = numpy.array(camera["focal_point"], float)
        to_eye = numpy.array(camera["position"], float) - self.focal_point
        self.distance = float(numpy.linalg.norm(to_eye))
        self.view_angle = camera["view_angle"]
        x, y, z = to_eye / self.distance
        self.elevation = math.asin(max(-1.0, min(1.0, z)))
        if math.hypot(x, y) < 1e-6:  # straight down or up: what is up in the picture tells
            x, y = -math.copysign(1.0, z) * numpy.array(camera["view_up"][:2], float)
        self.azimuth = math.atan2(y, x)

    def axes(self):
        """Unit vectors: to the right, up, towards the eye."""
        a, e = self.azimuth, self.elevation
        to_eye = numpy.array([math.cos(e) * math.cos(a), math.cos(e) * math.sin(a), math.sin(e)])
        up = numpy.array([-math.sin(e) * math.cos(a), -math.sin(e) * math.sin(a), math.cos(e)])
        return numpy.cross(up, to_eye), up, to_eye

    def as_dictionary(self):
        _, up, to_eye = self.axes()
        return {"position": (self.focal_point + self.distance * to_eye).tolist(),
                "focal_point": self.focal_point.tolist(), "view_up": up.tolist(),
                "view_angle": self.view_angle}

    def rotate(self, right, up):
        """The cloud follows the mouse: half a turn for a way as long as the picture is high."""
        self.azimuth -= math.pi * right
        self.elevation = max(-_HIGHEST, min(_HIGHEST, self.elevation - math.pi * up))

    def _height(self):
        """World units of the picture's height at the focal point."""
        return 2.0 * self.distance * math.tan(math.radians(self.view_angle) / 2.0)

    def pan(self, right, up):
        """Points at the focal point's depth follow the mouse."""
        to_the_right, upwards, _ = self.axes()
        self.focal_point -= self._height() * (right * to_the_right + up * upwards)

    def zoom(self, factor, right=0.0, up=0.0):
        """Closer by that factor; what is at (right, up) stays there."""
        before = self._height()
        least = _LEAST_DISTANCE * max(1.0, float(numpy.abs(self.focal_point).max()))
        self.distance /= min(factor, max(1.0, self.distance / least))
        to_the_right, upwards, _ = self.axes()
        self.focal_point += (before - self._height()) * (right * to_the_right + up * upwards)


def projected(camera, place):
    """Where a place is in a picture by `camera`, {"position" ...}: (right, up) of its centre, parts
    of its height; None behind the eye.
    """
    eye = numpy.array(camera["position"], float)
    to_eye = eye - numpy.array(camera["focal_point"], float)
    to_eye /= numpy.linalg.norm(to_eye)
    right = numpy.cross(camera["view_up"], to_eye)
    right /= numpy.linalg.norm(right)
    off = numpy.array(place, float) - eye
    depth = -float(off @ to_eye)
    if depth <= 0.0:
        return None
    height = 2.0 * depth * math.tan(math.radians(camera["view_angle"]) / 2.0)
    return float(off @ right) / height, float(off @ numpy.cross(to_eye, right)) / height
