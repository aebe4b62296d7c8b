"""Which points of a cloud are meant: arguments checked, and handed to the kernel."""

import ctypes
import operator

from . import _kernel
from ._errors import PointFrontError, did_you_mean

_MOST = (1 << 63) - 1  # points
_SixNumbers = ctypes.c_double * 6  # types that are made anew would wait for the collector
_FourNumbers = ctypes.c_double * 4
_ARRAYS_OWN = ("position", "id")
# Options of Conditions.arrays; others of vtkPointFrontExtract take objects of VTK.
KERNEL_OPTIONS = frozenset(
    ("line_distance", "maximum_number_of_points", "memory_limit", "colors_as_stored"))


def box_of(box):
    """Six numbers, the lowest corner first."""
    numbers = [float(number) for corner in box
               for number in (corner if hasattr(corner, "__len__") else (corner,))]
    if len(numbers) != 6:
        raise ValueError(f"a box has six numbers, ((x0, y0, z0), (x1, y1, z1)), not {len(numbers)}")
    if any(low > high for low, high in zip(numbers, numbers[3:])):
        raise ValueError(f"a box begins with its lowest corner, ((x0, y0, z0), (x1, y1, z1)): "
                         f"{numbers} has a lower one behind it")
    return numbers


def class_numbers(classes):
    """Numbers of object classes, as int; [] for None: all."""
    if classes is None:
        return []
    try:
        numbers = list(classes)
    except TypeError:
        numbers = [classes]
    if not numbers:
        raise ValueError("classes names no class: no point can be meant; None takes all")
    numbers = [operator.index(number) for number in numbers]
    for number in numbers:
        if not 0 <= number <= 255:
            raise ValueError(f"a class {number} is none of 0 to 255")
    return numbers


def _sphere_of(sphere):
    centre, radius = sphere
    numbers = [*map(float, centre), float(radius)]
    if len(numbers) != 4:
        raise ValueError(f"a sphere has three coordinates and a radius, not {len(numbers)} numbers")
    return numbers


def _text(text):
    return None if text is None else text.encode(errors="surrogateescape")


class Conditions:
    """Conditions of Cloud.points, chunks and extract: a point must meet all that are there.

    box, sphere  lists of 6 and 4 numbers, or None
    classes      numbers; []: all
    attributes   names; None: all that the cloud holds
    """

    def __init__(self, cloud, box, sphere, area, classes, where, spacing, attributes):
        known = cloud.attributes
        self.box = None if box is None else box_of(box)
        self.sphere = None if sphere is None else _sphere_of(sphere)
        self.area = area
        self.classes = class_numbers(classes)
        self.where = where
        self.spacing = spacing
        self.attributes = attributes
        if attributes is not None:
            self.attributes = [attributes] if isinstance(attributes, str) else list(attributes)
            for name in self.attributes:
                if name not in known:
                    raise PointFrontError(f"{cloud.path}: there is no attribute '{name}' among "
                                          f"{', '.join(known)}{did_you_mean(name, known)}")

    @classmethod
    def of_all(cls, *, spacing=None, attributes=None):
        """All points, or every one of some levels."""
        made = cls.__new__(cls)
        made.box = made.sphere = made.area = made.where = None
        made.classes, made.spacing, made.attributes = [], spacing, attributes
        return made

    def arrays(self, store, progress=None, *, line_distance=0.0, maximum_number_of_points=_MOST,
               memory_limit=0, colors_as_stored=True, piece=0, pieces=1):
        """NumPy arrays by name, of a share of the points."""
        query = _kernel.Query()
        if self.box is not None:
            query.box = _SixNumbers(*self.box)
        if self.sphere is not None:
            query.sphere = _FourNumbers(*self.sphere)
        query.area = _text(self.area)
        query.line_distance = line_distance
        query.classes = bytes(self.classes)
        query.class_count = len(self.classes)
        query.where = _text(self.where)
        query.spacing = self.spacing or 0.0
        names = self.attributes
        if names is None:
            computed = store.description["computed"]
            names = [name for name in store.description["attributes"] if name not in computed]
        query.attributes = b"".join(name.encode() + b"\0" for name in names)
        query.attribute_count = len(names)
        query.memory_bytes = operator.index(memory_limit)
        query.most_points = operator.index(maximum_number_of_points)
        query.piece, query.pieces = piece, pieces
        made = {}
        for number, (name, array) in enumerate(store.points(query, progress)):
            own = number < len(_ARRAYS_OWN)
            if not own and name == "rgb" and not colors_as_stored:
                array = _bytes_of(array, store.description["deep"])
            made[_ARRAYS_OWN[number] if own else
                 name + "_" if name in _ARRAYS_OWN else name] = array
        return made


def _bytes_of(colours, deep):
    """Colours of 16 bits as bytes: the upper ones, if any value is above 255."""
    if colours.dtype.itemsize == 1:
        return colours
    return (colours >> 8 if deep or (colours > 255).any() else colours).astype("u1")
