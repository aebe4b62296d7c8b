"""Tests compare with these: pictures, points that the tool exports, made-up clouds."""

import json
import os

import numpy
import pictures
from programs import tool

# Two pictures of the same points with the same shader differ where two points meet in a pixel at
# nearly the same depth and the order of drawing decides: nodes come in another order, ranks are
# composited, and the depth buffer's 24 bits lie over another clipping range. Found: 9 pixels at
# most, 0.004 %.
CHANNEL = 8
SHARE = 0.001
# Against ParaView's own points, which Mesa draws: it rounds places to 1/256 of a pixel, the
# software back end does not, so points near a pixel's edge go to the one or the other side. Found:
# 0.13 % of colours, 0.33 % of intensities.
STOCK_SHARE = 0.005


def compare(one, other, share=SHARE, channel=CHANNEL, least=0.1):
    """`least`: share of the pixels that show something, for an empty picture agrees with an empty
    one."""
    first, second = pictures.load(one + ".png"), pictures.load(other + ".png")
    covered = pictures.covered(first)
    found = pictures.differing(first, second, channel)
    print("%s, %s: %.3f %% of pixels differ by more than %d (limit %.3f %%), %.1f %% covered"
          % (one, other, 100 * found, channel, 100 * share, 100 * covered))
    if covered < least:
        raise AssertionError(one + " shows next to nothing")
    if found > share:
        raise AssertionError(one + " and " + other + " differ")


def exported(name, *conditions, store=None):
    """Returns what the tool exports of a store: rows of x, y, z and intensity, in order."""
    path = os.path.abspath(name + ".csv")
    tool("export", store or os.environ["POINTFRONT_STORE"], "-o", path, "--force", *conditions)
    table = numpy.genfromtxt(path, delimiter=",", names=True)
    print(name, table.dtype.names, len(table))
    rows = numpy.stack([table[column] for column in ("x", "y", "z", "intensity")], axis=1)
    return rows[numpy.lexsort(rows.T[::-1])]


def surveys():
    """Three made-up surveys; the second has other attributes. Pairs of a store and its points."""
    steps = []
    for time, points in enumerate((20000, 50000, 30000)):
        store = os.path.abspath("survey_%d.pfront" % time)
        tool("generate", "--points", str(points), "--seed", str(time + 1), "-o", "survey.las",
             "--force")
        tool("build", "survey.las", "-o", store, "--force",
             *(["--attributes", "rgb"] if time == 1 else []))
        steps.append((store, json.loads(tool("info", store, "--json"))["points"]))
    return steps


def classified():
    """A made-up town in three steps with other classes.

    Pairs of a store and a mapping: points of each class.
    """
    tool("generate", "--points", "60000", "--seed", "3", "-o", "town.las", "--force")
    tool("build", "town.las", "-o", "town.pfront", "--layers", "class", "--force")
    steps = []
    for classes in ("2,6", "2,5", "5"):
        store = os.path.abspath("step_%d.pfront" % len(steps))
        tool("export", "town.pfront", "-o", "step.las", "--classes", classes, "--force")
        tool("build", "step.las", "-o", store, "--layers", "class", "--force")
        layers = json.loads(tool("info", store, "--json"))["layers"]
        steps.append((store, {layer["name"]: layer["points"] for layer in layers}))
    return steps
