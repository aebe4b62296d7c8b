"""The kernel in this process, by the C functions of Kernel/PlainInterface.h: no VTK."""

import _thread
import ctypes
import json
import os
import pathlib
import queue

import numpy

from ._errors import PointFrontError, warn
from ._progress import ends, receiving

_BYTES = ctypes.c_char_p
_DOUBLES = ctypes.POINTER(ctypes.c_double)
PROGRESS = ctypes.CFUNCTYPE(ctypes.c_int, _BYTES, ctypes.c_double)


class Query(ctypes.Structure):
    """PointFrontQuery."""

    _fields_ = [("box", _DOUBLES), ("sphere", _DOUBLES), ("area", _BYTES),
                ("line_distance", ctypes.c_double), ("classes", _BYTES),
                ("class_count", ctypes.c_size_t), ("where", _BYTES), ("spacing", ctypes.c_double),
                ("attributes", _BYTES), ("attribute_count", ctypes.c_size_t),
                ("memory_bytes", ctypes.c_uint64), ("most_points", ctypes.c_uint64),
                ("piece", ctypes.c_uint32), ("pieces", ctypes.c_uint32)]


class _Array(ctypes.Structure):
    """PointFrontArray."""

    _fields_ = [("name", _BYTES), ("data", ctypes.c_void_p), ("type", ctypes.c_uint8),
                ("components", ctypes.c_uint8)]


_TYPES = {"int8": 1, "uint8": 2, "int16": 3, "uint16": 4, "int32": 5, "uint32": 6, "int64": 7,
          "uint64": 8, "float32": 9, "float64": 10}  # pointfront::ScalarType


def _loaded():
    library = ctypes.CDLL(str(pathlib.Path(__file__).parent / "libpointfrontPython.so"))
    pointer = ctypes.c_void_p
    for name, arguments in (
            ("Open", [_BYTES, ctypes.POINTER(pointer), _DOUBLES, PROGRESS]),
            ("Credentials", [_BYTES]),
            ("PublicForm", [_BYTES]),
            ("Points", [pointer, ctypes.POINTER(Query), PROGRESS]),
            ("Build", [_BYTES, ctypes.POINTER(_Array), ctypes.c_size_t, ctypes.c_uint64, PROGRESS]),
            ("Index", [_BYTES, _BYTES, ctypes.c_int, ctypes.c_uint32, PROGRESS]),
            ("ClassNames", []), ("Traffic", []), ("Close", [pointer]), ("Free", [pointer])):
        function = getattr(library, f"pointfront{name}")
        function.argtypes = arguments
        function.restype = None if name in ("Close", "Free") else pointer
    return library


_library = _loaded()


def _answer(address):
    """The dictionary of an answer; raises PointFrontError for one that is an error."""
    if not address:
        raise PointFrontError("the system gave no more memory")
    try:
        answer = json.loads(ctypes.string_at(address))
    finally:
        _library.pointfrontFree(address)
    if isinstance(answer, dict) and "error" in answer:
        raise Stopped() if answer["cancelled"] else PointFrontError(answer["error"])
    return answer


class Stopped(PointFrontError):
    """The kernel ended because it was asked to."""


class _Call:
    """A call of the kernel in a thread of its own; the caller's hears of it, and Ctrl-C.

    The caller's thread waits in C alone, where an interrupt strikes before or after: inside of
    Thread.start() or Event.wait() it leaves their locks as they are, and the work runs on.
    """

    def __init__(self, function):
        self._function = function
        self._changed = queue.SimpleQueue()
        self._latest = None
        self._stopped = False
        self._began = False
        self._ended = False
        self._problem = None
        self._answer = None
        self.phase = ""

    def _take(self, phase, fraction):
        self._latest = phase.decode(errors="replace"), fraction
        self._changed.put(None)
        return 0 if self._stopped else 1

    def _work(self):
        self._began = True  # before it looks, as run() stops it before it looks
        function, self._function = self._function, None
        try:
            if not self._stopped:
                self._answer = function(PROGRESS(self._take))
        except BaseException as problem:
            self._problem = problem
        del function  # the caller goes on before this thread has ended
        self._ended = True
        self._changed.put(None)

    def run(self, receive):
        """Calls `receive` with (phase, fraction) from this thread, whose False ends the work."""
        raised = None
        ended = False
        try:
            _thread.start_new_thread(self._work, ())
            while not ended:
                try:
                    if not self._ended:
                        self._changed.get()
                    ended = self._ended
                    latest, self._latest = self._latest, None
                    if latest is not None and not self._stopped:
                        self.phase = latest[0]
                        self._stopped = ends(receive(*latest))
                except BaseException as problem:  # the receiver's, or Ctrl-C
                    raised = raised or problem
                    self._stopped = True
        finally:  # an interrupt that strikes between the lines above
            self._stopped = True
            while self._began and not self._ended:
                self._changed.get()
        if raised is not None:
            raise raised
        if self._problem is not None:
            raise self._problem
        answer, self._answer = self._answer, None
        return answer


def call(function, progress, stopped):
    """Returns what function(report) gives, while `progress` is told how far it is.

    stopped  what a PointFrontError says if `progress` ends it
    """
    with receiving(progress) as receive:
        try:
            if ends(receive("", 0.0)):
                raise Stopped()
            work = _Call(function)
            answer = work.run(receive)
        except Stopped:
            raise PointFrontError(stopped) from None
        receive(work.phase, 1.0)
    return answer


class _Memory:
    """Returns the kernel's memory as an array without a copy; freed with its last view."""

    def __init__(self, address, shape, dtype):
        self._address = address
        self.__array_interface__ = {"data": (address, False), "shape": shape,
                                    "typestr": dtype.str, "version": 3}

    def __del__(self):
        _library.pointfrontFree(self._address)


def _arrays(answer):
    """(name, array) of each column, and the warnings; in the thread that got it, which no interrupt
    ends.
    """
    points = answer["points"]
    made = []
    for column in answer["columns"]:
        count = column["components"]
        shape = (points,) if count == 1 else (points, count)
        memory = _Memory(column["address"], shape, numpy.dtype(column["type"]))
        made.append((column["name"], numpy.asarray(memory)))
    return made, answer["warnings"]


def whole(text):
    """The bytes of a path or a text that C is given. It would take a zero byte as their end, and
    drop the rest: a ValueError, as of Python's own open().
    """
    data = text.encode(errors="surrogateescape") if isinstance(text, str) else text
    if b"\0" in data:
        raise ValueError("embedded null byte")
    return data


def path_of(path):
    """The bytes of a path for C."""
    return whole(os.fsencode(path))


def learn_credentials(text):
    """The text of POINTFRONT_FAR, for this process."""
    _answer(_library.pointfrontCredentials(whole(text)))


def public_form(address):
    """The address without what is secret, under which this process knows it from now on."""
    return _answer(_library.pointfrontPublicForm(path_of(address)))


def traffic():
    """The traffic of this process with servers."""
    return _answer(_library.pointfrontTraffic())


class StoredCloud:
    """An opened cloud.

    bounds       six numbers: lowest corner, highest corner
    description  what pointfrontOpen() answers

    A forked child opens its own: it has none of its parent's threads.
    """

    def __init__(self, path):
        self._path = path_of(path)
        self._open()

    def _open(self):
        self._process = os.getpid()
        self._handle = ctypes.c_void_p()
        bounds = (ctypes.c_double * 6)()
        self.description = call(
            lambda report: _answer(_library.pointfrontOpen(
                self._path, ctypes.byref(self._handle), bounds, report)),
            None, "stopped while it was opened")
        self.bounds = tuple(bounds)

    def points(self, query, progress):
        """(name, array) of each column: the places, called "", the ids, the attributes. What the
        query cannot have is a PointFrontWarning.
        """
        if os.getpid() != self._process:
            self._open()
        arrays, warnings = call(
            lambda report: _arrays(_answer(
                _library.pointfrontPoints(self._handle, ctypes.byref(query), report))),
            progress, f"{os.fsdecode(self._path)}: the query was stopped")
        warn(f"{self.description['path']}: {text}" for text in warnings)
        return arrays

    def __del__(self):
        if getattr(self, "_handle", None) and os.getpid() == self._process:
            _library.pointfrontClose(self._handle)


def _as_bytes(value):
    """A request whose texts have a character for each byte, as paths need not be UTF-8."""
    if isinstance(value, dict):
        return {name: _as_bytes(held) for name, held in value.items()}
    if isinstance(value, list):
        return [_as_bytes(held) for held in value]
    return whole(value).decode("latin-1") if isinstance(value, str) else value


def build(request, arrays, progress):
    """The answer of pointfrontBuild(); `arrays` None, or (places, {name: column})."""
    given, points = [], 0
    if arrays is not None:
        places, columns = arrays
        points = len(places)
        given.append(_Array(None, places.ctypes.data, _TYPES["float64"], 3))
        given += [_Array(whole(name.encode()), column.ctypes.data, _TYPES[column.dtype.name],
                         1 if column.ndim == 1 else column.shape[1])
                  for name, column in columns.items()]
    text = json.dumps(_as_bytes(request), allow_nan=False, ensure_ascii=False).encode()
    return call(
        lambda report: _answer(_library.pointfrontBuild(
            text, (_Array * len(given))(*given), len(given), points, report)),
        progress, f"{request['output']}: the build was stopped")


def class_names():
    """Returns the names of the classes 0 to 255."""
    return _answer(_library.pointfrontClassNames())


def index(las, side, overwrite, node_points, progress=None):
    las, target = path_of(las), path_of(side)
    return call(
        lambda report: _answer(_library.pointfrontIndex(
            las, target, int(overwrite), node_points, report)),
        progress, f"{side}: the indexing was stopped")
