"""Pictures drawn by the tool: in software, without a display and without OpenGL."""

import json
import os
import pathlib
import re
import signal
import subprocess
import tempfile
import zlib

import numpy

from . import _far, _kernel
from ._errors import PointFrontError, warn
from ._host import TOOL

_LOOK_SECONDS = 0.02  # for an interrupt, while the tool runs
_TELL_SECONDS = 0.1  # between what a receiver of progress is told
_SIGNATURE = b"\x89PNG\r\n\x1a\n"


class Picture:
    """A picture as PNG. A notebook shows it.

    png  its bytes
    """

    def __init__(self, png):
        self.png = png

    def _repr_png_(self):
        return self.png

    def save(self, path):
        """Write the PNG file."""
        path = _png_name(path)
        try:
            pathlib.Path(path).write_bytes(self.png)
        except OSError as problem:
            raise PointFrontError(f"'{path}' cannot be written: {problem.strerror}") from problem

    @property
    def pixels(self):
        """Rows from the top: height by width by 3, uint8, red green blue."""
        width, height, channels, rows = _rows_of(self.png)
        raw = numpy.frombuffer(rows, numpy.uint8).reshape(height, 1 + width * channels)
        if raw[:, 0].any():
            raise PointFrontError("this PNG was not written by PointFront: its rows are filtered")
        return raw[:, 1:].reshape(height, width, channels)[:, :, :3]

    def __array__(self, dtype=None, copy=None):
        return numpy.array(self.pixels, dtype=dtype)

    def __repr__(self):
        width, height = _size_of(self.png)
        return f"<Picture {width}x{height}, {len(self.png)} bytes of PNG>"


def _png_name(path):
    """The path as text, if its name is a PNG file's: the rule of `pointfront render`."""
    path = _far.written(os.fsdecode(path))
    if not path.endswith((".png", ".PNG")):
        raise PointFrontError(f"'{path}' must end in .png: a picture is written as PNG")
    return path


def _size_of(png):
    return int.from_bytes(png[16:20], "big"), int.from_bytes(png[20:24], "big")


def _rows_of(png):
    if png[:8] != _SIGNATURE:
        raise PointFrontError("these bytes are no PNG")
    width, height = _size_of(png)
    depth, kind = png[24], png[25]
    if depth != 8 or kind not in (2, 6):
        raise PointFrontError(f"a PNG of depth {depth} and kind {kind} is none of PointFront's")
    at, data = 8, []
    while at < len(png):
        length = int.from_bytes(png[at:at + 4], "big")
        if png[at + 4:at + 8] == b"IDAT":
            data.append(png[at + 8:at + 8 + length])
        at += 12 + length
    return width, height, 3 if kind == 2 else 4, zlib.decompress(b"".join(data))


class _Said:
    """The lines that the tool says, which it writes into a file: `text` has those for people,
    `latest` is the last phase and fraction of `--progress json`.
    """

    def __init__(self, file):
        self._file = file
        self._rest = b""
        self.text = ""
        self.latest = "", 0.0

    def read(self, end=b""):
        *lines, self._rest = (self._rest + self._file.read() + end).split(b"\n")
        for line in lines:
            if line.startswith(b"{"):
                told = json.loads(line)
                self.latest = told["phase"], told["fraction"]
            elif line:
                self.text += line.decode(errors="replace") + "\n"


def _ended(arguments, report, look):
    """The tool when it has ended, what it printed and what it said. Once `report` answers 0, it is
    asked to end, and leaves nothing behind. `report` is asked each `look` seconds.
    """
    with tempfile.NamedTemporaryFile(prefix="pointfront-") as file, \
            open(file.name, "rb") as lines:
        said = _Said(lines)
        tool = subprocess.Popen([TOOL, *map(str, arguments)], stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=file,
                                env=_far.environment(arguments))
        asked = False
        while True:
            try:
                output, _ = tool.communicate(timeout=look)
                break
            except subprocess.TimeoutExpired:
                said.read()
                phase, fraction = said.latest
                if not asked and report(phase.encode(), fraction) == 0:
                    tool.send_signal(signal.SIGINT)
                    asked = True
        said.read(end=b"\n")
    if asked and tool.returncode != 0:
        raise _kernel.Stopped()
    return tool, output, said.text


def run_tool(arguments, heard=None, progress=None, stopped="the tool was stopped"):
    """Returns what the tool prints. Raises PointFrontError with what it says; Ctrl-C ends it, too.

    heard     called with what it says while it succeeds
    progress  as of all calls, for a tool that is told `--progress json`
    stopped   what a PointFrontError says if `progress` ends it
    """
    look = _LOOK_SECONDS if progress in (None, False) else _TELL_SECONDS
    try:
        # An interrupt strikes this thread, and finds no other in the middle of starting a process.
        tool, output, said = _kernel.call(
            lambda report: _ended(arguments, report, look), progress, stopped)
    except OSError as problem:
        raise PointFrontError(f"the tool cannot be run: {problem}") from None
    if tool.returncode != 0:
        raise PointFrontError(_in_python(said.strip())
                              or f"the tool ended with status {tool.returncode}")
    if heard is not None:
        heard(said)
    return output


# Words of Python for options of the tool; others are the same in snake case.
_ARGUMENTS = {"force": "overwrite=True", "output": "path", "assume-crs": "assumed_crs"}
_AREA_FILE = re.compile(r"[^\s']*/pointfront-[a-z0-9_]{8}/area\b")  # that `area` was written into


def _in_python(text):
    """The words of the tool with Python's arguments in place of its options, save for what it says
    to type ("pointfront index --force").
    """
    text = _AREA_FILE.sub("area", text)
    return re.sub(r"(pointfront \w+ )?(?<![^\s('])--([a-z][a-z-]*)", lambda found: found[0]
                  if found[1] else _ARGUMENTS.get(found[2], found[2].replace("-", "_")), text)


def described(path):
    """Returns the tool's description of a cloud, a dictionary; a folder or a list is one cloud."""
    told = json.loads(run_tool(["info", "--json", path]))
    if "files" in told or os.path.isdir(path):
        told = json.loads(run_tool(["info", "--json", "--together", path]))
    return told


def _warn_of(said, known):
    """Raises what the tool warned of, unless it is among the `known`."""
    texts = [line.split("warning: ", 1)[-1] for line in said[0].splitlines() if line]
    warn(_in_python(text) for text in texts if text not in known)


def export(path, output, options, known=(), progress=None):
    """Writes points of a stored cloud to a file; how many. See Cloud.export."""
    _far.written(output)
    said = []
    shown = "none" if progress in (None, False) else "json"
    printed = run_tool(["export", path, "-o", output, "--progress", shown,
                        *_flags("export", options)], said.append, progress,
                       f"{output}: the export was stopped")
    _warn_of(said, known)
    return int(re.findall(r": ([0-9]+) points", printed.decode(errors="replace"))[-1])


# Options of the tool that have no value: they are there, or are not.
FLAGS = {"export": {"double", "force", "offline"},
         "render": {"edl", "lit", "unlit", "complete", "offline"}}


def _flags(command, options, folder=None):
    """Returns the words of the command line; a dictionary becomes a JSON file in `folder`."""
    words = []
    for name, value in options.items():
        if isinstance(value, (numpy.ndarray, numpy.generic)):
            value = value.tolist()
        if value is None or value is False:
            continue
        flag = "--" + name.replace("_", "-")
        if value is True:
            if name not in FLAGS[command]:
                raise TypeError(f"{name}=True says nothing: {name} has a value")
            words.append(flag)
        elif isinstance(value, dict) and folder is not None:
            file = pathlib.Path(folder) / f"{name}.json"
            file.write_text(json.dumps(_plain(value)))
            words += [flag, file]
        elif isinstance(value, (tuple, list)):
            words += [flag, ",".join(map(_word, value))]
        else:
            words += [flag, _word(value)]
    return words


def _plain(value):
    """For JSON: numbers and arrays of NumPy, as keys, too, and paths become Python's."""
    if isinstance(value, dict):
        return {_plain(key): _plain(held) for key, held in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(held) for held in value]
    if isinstance(value, (numpy.ndarray, numpy.generic)):
        return value.tolist()
    return os.fsdecode(value) if isinstance(value, (bytes, os.PathLike)) else value


def _word(value):
    """A path as a text; a floating number with all its digits, NumPy's, too."""
    if isinstance(value, (bytes, os.PathLike)):
        return os.fsdecode(value)
    return repr(float(value)) if isinstance(value, (float, numpy.floating)) else str(value)


def draw(path, output, size, options, known=()):
    """A Picture of a stored cloud; also written to `output` unless that is None."""
    if output is not None:
        output = _png_name(output)
    said = []
    width, height = size
    arguments = ["render", path, "--size", f"{int(width)}x{int(height)}"]
    with tempfile.TemporaryDirectory(prefix="pointfront-") as folder:
        file = pathlib.Path(folder) / "picture.png"
        run_tool([*arguments, "-o", file, *_flags("render", options, folder)], said.append)
        picture = Picture(file.read_bytes())
    if output is not None:
        picture.save(output)
    _warn_of(said, known)
    return picture
