"""Points of a stored cloud as VTK's data, by vtkPointFrontExtract."""

import re

from . import _host
from ._errors import PointFrontError, did_you_mean, warn
from ._progress import Watch
from .pointfrontFiltersExtract import vtkPointFrontExtract

vtkCommand = _host.vtk("vtkCommonCore").vtkCommand
vtk_to_numpy = _host.vtk("util.numpy_support").vtk_to_numpy


class _Messages:
    """Collects what a VTK object says as errors and warnings, instead of printing it."""

    def __init__(self, algorithm):
        self.errors = []
        self.warnings = []
        self._observe(algorithm, vtkCommand.ErrorEvent, self.errors)
        self._observe(algorithm, vtkCommand.WarningEvent, self.warnings)
        # The executive says once more that something failed.
        algorithm.GetExecutive().AddObserver(vtkCommand.ErrorEvent, lambda *_: None)

    @staticmethod
    def _observe(algorithm, event, texts):
        def take(_caller, _event, text):
            lines = [line.strip() for line in text.strip().splitlines()]
            said = " ".join(lines[1:]) if len(lines) > 1 else lines[0]  # the first names the source
            texts.append(said.split("): ", 1)[-1])

        take.CallDataType = "string0"
        algorithm.AddObserver(event, take)


def _set_options(algorithm, options):
    """Calls SetOption(value) for option=value, snake_case; an unknown one is a TypeError."""
    for name, value in options.items():
        setter = "Set" + "".join(word.capitalize() for word in name.split("_"))
        if not hasattr(algorithm, setter):
            known = [re.sub("(?<!^)([A-Z])", r"_\1", known[3:]).lower()
                     for known in dir(algorithm) if known.startswith("Set")]
            raise TypeError(f"there is no option '{name}', for there is no {setter}"
                            f"{did_you_mean(name, known)}")
        getattr(algorithm, setter)(value)


def arrays_of(path, conditions, progress, options, piece=0, pieces=1):
    """As Conditions.arrays, by options that vtkPointFrontExtract alone has: frustum, point_ids."""
    options = {"vertex_cells": False, "colors_as_stored": True, **options}
    output = extracted(path, conditions, progress, options, piece, pieces)
    data = output.GetPointData()
    arrays = {"position": vtk_to_numpy(output.GetPoints().GetData())}
    for i in range(data.GetNumberOfArrays()):
        array = data.GetArray(i)
        name = array.GetName()
        if name == "point_id":
            name = "id"
        elif name in ("position", "id"):
            name += "_"
        arrays[name] = vtk_to_numpy(array)
    return arrays


def extracted(path, conditions, progress, options, piece=0, pieces=1):
    """See Cloud.extract."""
    extract = vtkPointFrontExtract()
    messages = _Messages(extract)
    extract.SetFileName(path)
    if conditions.box is not None:
        x0, y0, z0, x1, y1, z1 = conditions.box
        extract.UseBoxOn()
        extract.SetBox(x0, x1, y0, y1, z0, z1)
    if conditions.sphere is not None:
        extract.UseSphereOn()
        extract.SetSphereCenter(conditions.sphere[:3])
        extract.SetSphereRadius(conditions.sphere[3])
    if conditions.area is not None:
        extract.SetWellKnownText(conditions.area)
    for number in conditions.classes:
        extract.AddObjectClass(number)
    if conditions.where is not None:
        extract.SetWhere(conditions.where)
    if conditions.spacing is not None:
        extract.SetSpacing(conditions.spacing)
    if conditions.attributes is not None:
        extract.UpdateInformation()
        for i in range(extract.GetNumberOfPointArrays()):
            name = extract.GetPointArrayName(i)
            extract.SetPointArrayStatus(name, int(name in conditions.attributes))
    _set_options(extract, options)
    with Watch(extract, vtkCommand.ProgressEvent, progress):
        extract.UpdatePiece(piece, pieces, 0)
    warn(messages.warnings)
    if messages.errors:
        raise PointFrontError("; ".join(messages.errors))
    if extract.GetAbortExecute():
        raise PointFrontError(f"{path}: the query was stopped")
    return extract.GetOutput()
