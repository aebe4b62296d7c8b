"""NumPy arrays on their way into a store, and points of a store in chunks."""

import collections.abc

import numpy

_OWN = ("position", "id")  # Cloud.points adds them: they are no attributes
_MOST_COMPONENTS = 16


def table_of(inputs):
    """{name: array} of points: a mapping of that, anything with keys() and items by key as an
    opened .npz file and a data frame are, or an array with fields. None: names of files.
    """
    names = None
    if isinstance(inputs, numpy.ndarray):
        names = inputs.dtype.names
        if names is None and inputs.dtype.kind in "iufcb":
            raise TypeError(
                f"an array of the shape {inputs.shape} is no points: give it a name, as in "
                f"{{'position': array}} of n by 3, with other attributes beside it")
    elif isinstance(inputs, collections.abc.Mapping) or (
            hasattr(inputs, "keys") and hasattr(inputs, "__getitem__")):
        names = inputs.keys()
    return None if names is None else {name: inputs[name] for name in names}


def _plain(name, values, kind=None):
    """An array without a mask, which a store could not keep."""
    if numpy.ma.is_masked(values):
        raise ValueError(
            f"'{name}' has {numpy.ma.count_masked(values)} masked values, and a store has no mask: "
            f"leave these points out of all arrays, or fill the values in with filled()")
    return numpy.asarray(values, kind)


def _places(arrays):
    if "position" in arrays:
        places = _plain("position", arrays["position"], numpy.float64)
        if places.ndim != 2 or places.shape[1] != 3:
            raise ValueError(f"'position' is n by 3, not {places.shape}")
        return numpy.ascontiguousarray(places)
    if not {"x", "y", "z"} <= set(arrays):
        raise ValueError("points have 'position', n by 3, or 'x', 'y' and 'z'")
    axes = [_plain(axis, arrays[axis], numpy.float64) for axis in "xyz"]
    shapes = [axis.shape for axis in axes]
    if len(shapes[0]) != 1 or len(set(shapes)) != 1:
        raise ValueError(f"'x', 'y' and 'z' have one dimension and one length, not the shapes "
                         f"{', '.join(map(str, shapes))}; flatten grids with .ravel(), the other "
                         f"attributes, too")
    return numpy.stack(axes, axis=1)


def _column(name, values, count):
    column = _plain(name, values)
    if column.ndim not in (1, 2) or len(column) != count:
        raise ValueError(f"'{name}' has the shape {column.shape}, and there are {count} points")
    if column.ndim == 2 and not 1 <= column.shape[1] <= _MOST_COMPONENTS:
        raise ValueError(f"'{name}' has {column.shape[1]} components, at most {_MOST_COMPONENTS}")
    if column.dtype.kind == "b":
        column = column.view(numpy.uint8) if column.flags.c_contiguous else column.astype("u1")
    elif column.dtype == numpy.float16:
        column = column.astype(numpy.float32)
    elif column.dtype.kind not in "iuf" or column.dtype.itemsize > 8:
        raise TypeError(f"'{name}' has the type {column.dtype}: a store holds integers and "
                        f"floating numbers of at most 64 bits")
    if name == "classification" and column.dtype.kind in "iu" and column.ndim == 1 and \
            column.size and 0 <= column.min() and column.max() <= 255:
        column = column.astype(numpy.uint8)  # a class is one byte, NumPy's integers have eight
    return numpy.ascontiguousarray(column, column.dtype.newbyteorder("="))


def columns_of(arrays):
    """(places, {name: column}) of {name: array}: contiguous, in the machine's byte order."""
    for name in arrays:
        if not isinstance(name, str):
            raise TypeError(f"the name of an array is a text, not {name!r}")
        if not name:
            raise ValueError("an array has an empty name; name each attribute")
    places = _places(arrays)
    by_axis = "position" not in arrays
    columns = {}
    for name, values in arrays.items():
        if name in _OWN or (by_axis and name in ("x", "y", "z")):
            continue
        # As Cloud.points names attributes that are called as its own arrays.
        own = name[:-1] if name in ("position_", "id_") else name
        columns[own] = _column(name, values, len(places))
    return places, columns


def joined(parts, size):
    """Dictionaries of arrays, of `size` points each, out of smaller ones; the last has fewer."""
    waiting, count = [], 0
    for part in parts:
        waiting.append(part)
        count += len(part["id"])
        while count >= size:
            whole = _concatenated(waiting)
            yield {name: array[:size] for name, array in whole.items()}
            waiting = [{name: array[size:] for name, array in whole.items()}]
            count -= size
    if count:
        yield _concatenated(waiting)


def _concatenated(parts):
    if len(parts) == 1:
        return parts[0]
    return {name: numpy.concatenate([part[name] for part in parts]) for name in parts[0]}
