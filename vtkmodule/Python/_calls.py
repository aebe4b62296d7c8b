"""Building and indexing as Python calls: keyword arguments in, results out, errors raised."""

import os

from . import _arrays, _host
from ._errors import PointFrontError, warn
from ._progress import Watch
from .pointfrontFiltersBuild import vtkPointFrontBuilder
from .pointfrontIOLASIndex import vtkPointFrontLASIndexer

vtkCommand = _host.vtk("vtkCommonCore").vtkCommand


class BuildReport:
    """What a build did.

    path            the store that was written
    points_read     points of all inputs
    points_stored   those that are in the store
    points_rejected those that are no positions
    files_skipped   inputs that were left out (skip_faulty)
    nodes           of the store
    bytes_written   size of the store
    warnings        what was wrong and survived: full sentences
    """

    def __init__(self, path, builder, warnings):
        self.path = path
        self.points_read = builder.GetNumberOfPointsRead()
        self.points_stored = builder.GetNumberOfPointsStored()
        self.points_rejected = builder.GetNumberOfPointsRejected()
        self.files_skipped = builder.GetNumberOfFilesSkipped()
        self.nodes = builder.GetNumberOfNodes()
        self.bytes_written = builder.GetBytesWritten()
        self.warnings = warnings

    def __repr__(self):
        return f"<{self.path}: {self.points_stored} points in {self.nodes} nodes>"


def _paths(names):
    if isinstance(names, (str, os.PathLike)):
        names = [names]
    return [os.fspath(name) for name in names]


class _Messages:
    """Collects what a VTK object says as errors and warnings, instead of printing it."""

    def __init__(self, algorithm):
        self.errors = []
        self.warnings = []
        self._observe(algorithm, vtkCommand.ErrorEvent, self.errors)
        self._observe(algorithm, vtkCommand.WarningEvent, self.warnings)
        if hasattr(algorithm, "GetExecutive"):  # which says once more that something failed
            algorithm.GetExecutive().AddObserver(vtkCommand.ErrorEvent, lambda *_: None)

    @staticmethod
    def _observe(algorithm, event, texts):
        def take(_caller, _event, text):
            lines = [line.strip() for line in text.strip().splitlines()]
            said = " ".join(lines[1:]) if len(lines) > 1 else lines[0]  # the first names the source
            texts.append(said.split("): ", 1)[-1])

        take.CallDataType = "string0"
        algorithm.AddObserver(event, take)

    def error(self, otherwise):
        return PointFrontError("; ".join(self.errors) or otherwise)


def _set(algorithm, options):
    """Calls SetOption(value) for option=value, snake_case; an unknown one is a TypeError."""
    for name, value in options.items():
        setter = "Set" + "".join(word.capitalize() for word in name.split("_"))
        if not hasattr(algorithm, setter):
            raise TypeError(f"there is no option '{name}', for there is no {setter}")
        getattr(algorithm, setter)(value)


_STRUCTURES = {"octree": "SetStructureToOctree", "kdtree": "SetStructureToKdTree"}
_REFINEMENTS = {"add": "SetRefinementToAdd", "replace": "SetRefinementToReplace"}
_LAYERS = {"auto": "SetLayersToAutomatic", "none": "SetLayersToNone", "class": "SetLayersToClass"}
_NORMALS = {"none": "SetNormalsToNone", "pca": "SetNormalsToPCA",
            "scanline": "SetNormalsToScanLine"}


def _choose(algorithm, choices, what, name):
    if name not in choices:
        raise ValueError(f"{what} '{name}' is none of {', '.join(choices)}")
    getattr(algorithm, choices[name])()


def build(inputs, output, *, structure="octree", refinement="add", layers="auto", normals="none",
          attributes=None, color_from=(), progress=None, **options):
    """Build a store from point files and stores.

    inputs      a path, or several: LAS, LAZ, PLY, PCD, text, ept.json, .pfront, .pfindex, folders
                of them; or points: {"position": n by 3, "intensity": n, ...}, as Cloud.points()
                gives them, an array with such fields, or "x", "y", "z" for "position". Types are
                kept; "id" is not an attribute
    output      path of the store (.pfront); overwrite=True replaces one that is there
    structure   "octree" or "kdtree"
    refinement  "add" (inner nodes hold a subset) or "replace" (mean points)
    layers      "auto", "none" or "class"
    normals     "none", "pca" or "scanline"
    attributes  names of those to store; None: all
    color_from  georeferenced images
    progress    called with (phase, fraction) some ten times a second; False stops the build.
                True: a bar, by the package tqdm
    options     other properties of vtkPointFrontBuilder in snake case: memory_limit,
                number_of_threads, precision, crs ... (CRS is written crs)

    Returns a BuildReport. What was wrong and survived is a PointFrontWarning. Raises
    PointFrontError; ValueError and TypeError for arrays that are no points; KeyboardInterrupt at
    once when the user interrupts. Nothing is left behind then. Other threads run meanwhile.
    """
    builder = vtkPointFrontBuilder()
    messages = _Messages(builder)
    if _arrays.is_table(inputs):
        points = _arrays.as_dictionary(inputs)
        data = _arrays.point_set(points)
        builder.SetPoints(data)
    else:
        for path in _paths(inputs):
            builder.AddFileName(path)
    path = os.fspath(output)
    builder.SetOutputFileName(path)
    _choose(builder, _STRUCTURES, "structure", structure)
    _choose(builder, _REFINEMENTS, "refinement", refinement)
    _choose(builder, _LAYERS, "layers", layers)
    _choose(builder, _NORMALS, "normals", normals)
    for name in attributes or ():
        builder.AddAttribute(name)
    for image in _paths(color_from):
        builder.AddColorImage(image)
    if "skip_faulty" in options:
        builder.SetSkipFaultyFiles(options.pop("skip_faulty"))
    if "crs" in options:
        builder.SetCRS(options.pop("crs"))
    if "assumed_crs" in options:
        builder.SetAssumedCRS(options.pop("assumed_crs"))
    _set(builder, options)
    with Watch(builder, vtkCommand.ProgressEvent, progress):
        written = builder.Write()
    if not written:
        raise messages.error(f"{path}: the build was stopped")
    warn(messages.warnings)
    return BuildReport(path, builder, messages.warnings)


def index(las, side=None, *, overwrite=False, node_points=16384):
    """Index a LAS file in place; gives the path of the side file.

    las    the file, uncompressed; it is not changed
    side   the side file; None: beside it, with ".pfindex" behind its name

    Raises PointFrontError; KeyboardInterrupt at once. Other threads run meanwhile.
    """
    indexer = vtkPointFrontLASIndexer()
    messages = _Messages(indexer)
    path = os.fspath(las)
    indexer.SetFileName(path)
    target = os.fspath(side) if side is not None else path + ".pfindex"
    indexer.SetIndexFileName(target)
    indexer.SetOverwrite(overwrite)
    indexer.SetNodePoints(node_points)
    if not indexer.Index():
        raise messages.error(f"{target}: the indexing was stopped")
    return target
