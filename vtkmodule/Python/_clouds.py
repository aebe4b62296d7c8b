"""Stores as Python objects: what they hold, and points of them as NumPy arrays."""

import os

from vtkmodules.util.numpy_support import vtk_to_numpy

from ._calls import _Messages
from .pointfrontFiltersExtract import vtkPointFrontExtract
from .pointfrontIOStore import vtkPointFrontReader


class Cloud:
    """A stored cloud: a store, an index, a COPC file, an EPT tree, a list (.pfronts) or a folder.

    path        as it was found
    points      how many
    bounds      ((x0, y0, z0), (x1, y1, z1)), tight
    attributes  names
    classes     {number: name} of object classes with a tree of their own
    """

    def __init__(self, path):
        reader = vtkPointFrontReader()
        messages = _Messages(reader)
        reader.SetFileName(os.fspath(path))
        reader.UpdateInformation()
        self._store = reader.GetStore()
        if self._store is None:
            raise messages.error(f"{path}: cannot be opened")

    @property
    def path(self):
        return self._store.GetFileName()

    @property
    def points(self):
        return self._store.GetNumberOfPoints()

    def __len__(self):
        return self.points

    @property
    def bounds(self):
        b = [0.0] * 6
        self._store.GetBounds(b)
        return (b[0], b[2], b[4]), (b[1], b[3], b[5])

    @property
    def attributes(self):
        store = self._store
        return [store.GetAttributeName(i) for i in range(store.GetNumberOfAttributes())]

    @property
    def classes(self):
        store = self._store
        return {store.GetObjectClassNumber(i): store.GetObjectClassName(i)
                for i in range(store.GetNumberOfObjectClasses())
                if store.GetObjectClassNumber(i) >= 0}

    def __repr__(self):
        return f"<{self.path}: {self.points} points>"

    def query(self, *, area=None, where=None, **options):
        """Points as NumPy arrays by name: "position" (n by 3, float64), "id", each attribute.

        area     polygons or lines as well-known text
        where    a condition: "classification in {2, 6} and z > 20"
        options  other properties of vtkPointFrontExtract in snake case

        Raises PointFrontError.
        """
        extract = vtkPointFrontExtract()
        messages = _Messages(extract)
        extract.SetFileName(self.path)
        if area is not None:
            extract.SetWellKnownText(area)
        if where is not None:
            extract.SetWhere(where)
        for name, value in options.items():
            setter = "Set" + "".join(word.capitalize() for word in name.split("_"))
            if not hasattr(extract, setter):
                raise TypeError(f"there is no option '{name}'")
            getattr(extract, setter)(value)
        extract.Update()
        if messages.errors:
            raise messages.error("the query failed")
        output = extract.GetOutput()
        data = output.GetPointData()
        points = output.GetPoints()
        arrays = {"position": vtk_to_numpy(points.GetData()).copy() if points else None}
        for i in range(data.GetNumberOfArrays()):
            array = data.GetArray(i)
            name = "id" if array.GetName() == "point_id" else array.GetName()
            arrays[name] = vtk_to_numpy(array).copy()
        return arrays


def open(path):  # as in gzip.open: the module's name says what
    """Open a stored cloud; see Cloud. Raises PointFrontError."""
    return Cloud(path)
