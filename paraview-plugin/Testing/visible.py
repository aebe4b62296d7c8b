"""Which point each pixel shows, computed in double precision from what "two pixels wide" means.

A point covers the pixels whose centres lie in the square of two pixels around its place; of the
points of a pixel the nearest is shown.
"""

import numpy


def winners(places, depths, size):
    """Rows of the points that are shown, as an array of the picture's rows and columns; -1: none.

    places: pixels from the lower left corner; depths: any measure that grows away from the eye.
    """
    width, height = size
    first = numpy.ceil(places - 1.5).astype(int)
    covered, points = [], []
    for right in (0, 1):
        for up in (0, 1):
            column, row = first[:, 0] + right, first[:, 1] + up
            seen = (column >= 0) & (column < width) & (row >= 0) & (row < height)
            covered.append((row * width + column)[seen])
            points.append(numpy.nonzero(seen)[0])
    covered, points = numpy.concatenate(covered), numpy.concatenate(points)
    order = numpy.lexsort((points, depths[points], covered))
    covered, points = covered[order], points[order]
    nearest = numpy.r_[True, covered[1:] != covered[:-1]][:len(covered)]
    picture = numpy.full(width * height, -1)
    picture[covered[nearest]] = points[nearest]
    return picture.reshape(height, width)


def inside_polygon(places, corners):
    """Which places lie in a polygon: by the crossings of a ray."""
    inside = numpy.zeros(len(places), bool)
    x, y = places[:, 0], places[:, 1]
    for (ax, ay), (bx, by) in zip(corners, corners[1:] + corners[:1]):
        if ay != by:
            crosses = (ay > y) != (by > y)
            inside ^= crosses & (x < (bx - ax) * (y - ay) / (by - ay) + ax)
    return inside
