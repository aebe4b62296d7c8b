"""Building and indexing as Python calls: keyword arguments in, results out, errors raised."""

import math
import os

from . import _arrays, _kernel
from ._errors import PointFrontError, did_you_mean, warn
from ._far import written
from ._queries import box_of, finite, option, whole_number


class BuildReport:
    """The outcome of a build.

    path            the store that was written
    points_read     points of all inputs
    points_stored   those that are in the store
    points_rejected those that are no positions
    points_outside  points that were read besides, and lie outside of the box
    files_skipped   inputs that were left out (skip_faulty)
    nodes           of the store
    bytes_written   size of the store
    warnings        what was wrong and survived: full sentences
    """

    def __init__(self, path, answer):
        self.path = path
        self.points_read = answer["points_read"]
        self.points_stored = answer["points_stored"]
        self.points_rejected = self.points_read - self.points_stored
        self.points_outside = answer["points_outside"]
        self.files_skipped = len(answer["skipped"])
        self.nodes = answer["nodes"]
        self.bytes_written = answer["bytes_written"]
        self.warnings = answer["warnings"] + answer["skipped"]

    def __repr__(self):
        return f"<{self.path}: {self.points_stored} points in {self.nodes} nodes>"


def _paths(names):
    """Texts of one path, or of several: str, bytes (as os.fsencode gives them), os.PathLike."""
    if isinstance(names, (str, bytes, os.PathLike)):
        names = [names]
    return [os.fsdecode(name) for name in names]


def _texts(names):
    return [names] if isinstance(names, str) else [str(name) for name in names]


def _class_numbers(classes):
    return [whole_number(number, 255) for number in classes]


def _count_32(number):
    return whole_number(number, (1 << 32) - 1)


def _node_points(number):
    return whole_number(number, 1 << 20, least=256)


def _threads(number):
    return whole_number(number, 1024)


def _real(number):
    number = float(number)
    if not math.isfinite(number):
        raise ValueError(f"{number} is no finite number")
    return number


def _step(number):
    number = _real(number)
    if number <= 0.0:
        raise ValueError(f"{number} is not above 0")
    return number


def _depth(bits):
    if bits not in (0, 8, 16):
        raise ValueError(f"{bits} is none of 0, 8 and 16")
    return int(bits)


# Options that pointfront.build() takes besides its named arguments, and what makes a value plain.
_OPTIONS = {
    "overwrite": bool, "skip_faulty": bool, "skip_faulty_files": bool,
    "memory_limit": whole_number, "number_of_threads": _threads,
    "temporary_folder": os.fsdecode, "node_points": _node_points, "precision": _step,
    "color_depth": _depth, "crs": os.fsdecode, "assumed_crs": os.fsdecode,
    "normals_neighbors": _count_32, "normals_radius": _real, "normals_error": _real,
    "normals_classes": _class_numbers, "curvature": bool, "splat_radius": bool,
    "local_height": bool, "local_height_radius": _real, "height_above_ground": bool,
    "ground_cell": _real, "attribute_from": _paths, "preview": bool,
    "preview_points": whole_number}

_NEEDS = {"local_height_radius": "local_height", "ground_cell": "height_above_ground"}


def _plain(options):
    """Options for the kernel; an unknown one is a TypeError."""
    plain = {}
    for name, value in options.items():
        if name not in _OPTIONS:
            raise TypeError(f"there is no option '{name}' among {', '.join(sorted(_OPTIONS))}"
                            f"{did_you_mean(name, _OPTIONS)}")
        if value is not None:
            key = "skip_faulty" if name == "skip_faulty_files" else name
            plain[key] = option(name, _OPTIONS[name], value)
    for name, wanted in _NEEDS.items():
        if name in plain and not plain.get(wanted):
            raise ValueError(f"{name} says nothing without {wanted}=True")
    return plain


_CHOICES = {"structure": ("octree", "kdtree"), "refinement": ("add", "replace"),
            "layers": ("auto", "none", "class"), "normals": ("none", "pca", "scanline")}


def _chosen(what, name):
    if name not in _CHOICES[what]:
        raise ValueError(f"{what} '{name}' is none of {', '.join(_CHOICES[what])}"
                         f"{did_you_mean(name, _CHOICES[what])}")
    return name


def build(inputs, output, *, structure="octree", refinement="add", layers="auto", normals="none",
          attributes=None, color_from=(), box=None, progress=None, **options):
    """Build a store from point files and stores. A path is a str, bytes or an os.PathLike.

    inputs      a path, or several: LAS, LAZ, PLY, PCD, text, ept.json, .pfront, .pfindex, folders
                of them; or points: {"position": n by 3, "intensity": n, ...}, as Cloud.points()
                gives them, any mapping, .npz file or data frame of that, or an array with such
                fields; "x", "y", "z" may stand for "position". Types are kept; "id" is not an
                attribute
    output      path of the store (.pfront); overwrite=True replaces one that is there
    structure   "octree" or "kdtree"
    refinement  "add" (inner nodes hold a subset) or "replace" (mean points)
    layers      "auto", "none" or "class"
    normals     "none", "pca" or "scanline"
    attributes  names of those to store; None: all
    color_from  georeferenced images
    box         ((x0, y0, z0), (x1, y1, z1)), or six numbers in that order: only points inside or on
                it, in the inputs' coordinates. Of stores, COPC, EPT and collections, on a disk or
                by their address, no more is read than it needs
    progress    called with (phase, fraction) some ten times a second; False stops the build.
                True: a bar, by the package tqdm
    options     overwrite, skip_faulty, memory_limit (bytes), number_of_threads, node_points,
                precision, color_depth (8 or 16), crs, assumed_crs, temporary_folder;
                normals_neighbors, normals_radius, normals_error, normals_classes, curvature,
                splat_radius; local_height, local_height_radius, height_above_ground, ground_cell;
                attribute_from ("NAME=IMAGE"), preview, preview_points: with the meaning of
                `pointfront build`

    Returns a BuildReport. What was wrong and survived is a PointFrontWarning. Raises
    PointFrontError, also if no point lies in the box; ValueError and TypeError for arrays that are
    no points, and for a box that is none; KeyboardInterrupt at
    once when the user interrupts. Nothing is left behind then. Other threads run meanwhile.
    """
    path = written(os.fsdecode(output))
    request = {"output": path, "structure": _chosen("structure", structure),
               "refinement": _chosen("refinement", refinement),
               "layers": _chosen("layers", layers), "normals": _chosen("normals", normals),
               "color_from": _paths(color_from), **_plain(options)}
    if box is not None:
        request["box"] = [finite(end) for end in box_of(box)]
    if attributes is not None:
        request["attributes"] = _texts(attributes)
    columns = None
    table = _arrays.table_of(inputs)
    if table is not None:
        columns = _arrays.columns_of(table)
    else:
        request["files"] = _paths(inputs)
        if not request["files"]:
            raise PointFrontError("no file names: name the point files to read")
    report = BuildReport(path, _kernel.build(request, columns, progress))
    warn(report.warnings)
    return report


def index(las, side=None, *, overwrite=False, node_points=16384):
    """Index a LAS file in place; gives the path of the side file.

    las    the file, uncompressed; it is not changed
    side   the side file; None: beside it, with ".pfindex" behind its name

    Raises PointFrontError; KeyboardInterrupt at once. Other threads run meanwhile.
    """
    path = os.fsdecode(las)
    target = written(os.fsdecode(side) if side is not None else path + ".pfindex")
    points = option("node_points", _node_points, node_points)
    warn(f"{path}: {text}" for text in
         _kernel.index(path, target, overwrite, points)["warnings"])
    return target
