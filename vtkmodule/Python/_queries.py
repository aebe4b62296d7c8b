"""Which points of a cloud are meant: arguments checked, and handed to the kernel."""

import ctypes
import math
import operator
import pathlib
import sys

from . import _kernel
from ._errors import PointFrontError, did_you_mean

_MOST = (1 << 63) - 1  # points
_SixNumbers = ctypes.c_double * 6  # types that are made anew would wait for the collector
_FourNumbers = ctypes.c_double * 4
_ARRAYS_OWN = ("position", "id")
_LIMITS = frozenset(("maximum_number_of_points", "memory_limit"))
# Options of Conditions.arrays; others of vtkPointFrontExtract take objects of VTK.
KERNEL_OPTIONS = _LIMITS | {"line_distance", "colors_as_stored"}


def box_of(box):
    """Six numbers, the lowest corner first."""
    numbers = [float(number) for corner in box
               for number in (corner if hasattr(corner, "__len__") else (corner,))]
    if len(numbers) != 6:
        raise ValueError(f"a box has six numbers, ((x0, y0, z0), (x1, y1, z1)), not {len(numbers)}")
    for axis, low, high in zip("xyz", numbers, numbers[3:]):
        if math.isnan(low) or math.isnan(high):
            raise ValueError(f"the box's end along {axis} is no number")
        if low > high:
            raise ValueError(f"the box goes down along {axis}, from {low} to {high}: it begins "
                             f"with its lowest corner, ((x0, y0, z0), (x1, y1, z1))")
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
    for number in numbers:
        if isinstance(number, (bool, str)):
            raise TypeError(f"a class has a number, and {number!r} is none")
    numbers = [operator.index(number) for number in numbers]
    for number in numbers:
        if not 0 <= number <= 255:
            raise ValueError(f"a class {number} is none of 0 to 255")
    return numbers


def _sphere_of(sphere):
    """Four numbers, the radius last."""
    try:
        (x, y, z), radius = sphere
    except (TypeError, ValueError):
        raise ValueError(f"a sphere is its centre and its radius, ((x, y, z), radius), not "
                         f"{sphere!r}") from None
    return [float(x), float(y), float(z), float(radius)]


def _spacing_of(spacing):
    """None: all points."""
    if spacing is None:
        return None
    if not float(spacing) >= 0.0:
        raise ValueError(f"a spacing is 0 or more, not {spacing}")
    return float(spacing) or None


def _text_of(name, text):
    if text is not None:
        if not isinstance(text, str):
            raise TypeError(f"{name} is a text, not of type {type(text).__name__}")
        _kernel.whole(text)
    return text


def _encoded(text):
    return None if text is None else _kernel.whole(text)


def whole_number(number, most=_MOST, least=0):
    """A number from `least` to `most`, as int."""
    number = operator.index(number)
    if not least <= number <= most:
        raise ValueError(f"{number} is none of {least} to {most}")
    return number


def option(name, plain, value):
    """The value of an option as `plain` makes it; a ValueError names the option."""
    try:
        return plain(value)
    except ValueError as problem:
        raise ValueError(f"{name}: {problem}") from None


def with_limits(options):
    """Options of a query whose limits are whole numbers, which count points and bytes."""
    return {name: option(name, whole_number, value) if name in _LIMITS else value
            for name, value in options.items()}


def finite(number):
    """The largest number in place of an infinite one."""
    return max(-sys.float_info.max, min(sys.float_info.max, number))


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
        self.area = _text_of("area", area)
        self.classes = class_numbers(classes)
        self.where = _text_of("where", where)
        self.spacing = _spacing_of(spacing)
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

    def options(self):
        """Those of `pointfront export`, which takes finite numbers only."""
        return {"box": None if self.box is None else [finite(end) for end in self.box],
                "sphere": self.sphere, "classes": self.classes or None, "where": self.where,
                "spacing": None if self.spacing is None else finite(self.spacing)}

    def area_options(self, folder, line_distance):
        """Those of `pointfront export` for the area, which it reads from a file in `folder`."""
        if self.area is None:
            if line_distance:
                raise ValueError("line_distance is of lines in `area`, and there is none")
            return {}
        file = pathlib.Path(folder) / "area"
        file.write_text(self.area)
        if "LINESTRING" not in self.area.upper():
            return {"polygon": file}
        if not line_distance > 0.0:
            raise ValueError("lines in `area` want a line_distance above 0")
        return {"corridor": file, "within": finite(float(line_distance))}

    def arrays(self, store, progress=None, *, line_distance=0.0, maximum_number_of_points=_MOST,
               memory_limit=0, colors_as_stored=True, piece=0, pieces=1):
        """NumPy arrays by name, of a share of the points."""
        query = _kernel.Query()
        if self.box is not None:
            query.box = _SixNumbers(*self.box)
        if self.sphere is not None:
            query.sphere = _FourNumbers(*self.sphere)
        query.area = _encoded(self.area)
        query.line_distance = line_distance
        query.classes = bytes(self.classes)
        query.class_count = len(self.classes)
        query.where = _encoded(self.where)
        query.spacing = self.spacing or 0.0
        names = self.attributes
        if names is None:
            computed = store.description["computed"]
            names = [name for name in store.description["attributes"] if name not in computed]
        query.attributes = b"".join(_kernel.whole(name.encode()) + b"\0" for name in names)
        query.attribute_count = len(names)
        query.memory_bytes = memory_limit
        query.most_points = maximum_number_of_points
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
