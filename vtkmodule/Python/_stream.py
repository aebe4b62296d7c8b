"""Frames of stored clouds, drawn by the tool in a process of its own: no display, no OpenGL."""

import json
import subprocess
import tempfile

import numpy

from . import _far
from ._errors import PointFrontError
from ._host import TOOL

END_SECONDS = 2.0  # for a tool whose input has ended

class Frame:
    """One answer of the tool.

    pixels     height by width by 4, uint8: red, green, blue, 255; rows from the top. None: a frame
               would show what the last one did
    settled    at rest, and nothing more will come
    camera     {"position", "focal_point", "view_up", "view_angle"} that it was drawn with
    bounds     of all stores, six numbers; None: they have no points
    facts      the whole answer: "points", "error_px", "milliseconds" ...
    """

    def __init__(self, facts, data):
        self.facts = facts
        self.settled = facts["settled"]
        self.camera = facts["camera"]
        self.bounds = facts["bounds"]
        self.pixels = None
        if data:
            shape = facts["height"], facts["width"], 4
            self.pixels = numpy.frombuffer(data, numpy.uint8).reshape(shape)


class FrameStream:
    """`pointfront stream`, asked for a frame at a time.

    paths      stores
    arguments  of the command line, as `pointfront render` takes them

    One thread at a time. Raises PointFrontError with what the tool says.
    """

    def __init__(self, paths, arguments=()):
        self._said = tempfile.TemporaryFile()
        try:
            self._tool = subprocess.Popen(
                [TOOL, "stream", *map(str, paths), *map(str, arguments)],
                stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self._said,
                env=_far.environment(paths),
                start_new_session=True)  # Ctrl-C is for this process, which ends the tool then
        except OSError as problem:
            raise PointFrontError(f"the tool cannot be run: {problem}") from None

    def frame(self, **request):
        """The next Frame.

        size     (width, height), pixels; from now on
        camera   as Frame.camera; or view="iso", "top", "front" ...; neither: as before
        moving   True: as much detail as the time of a frame allows
        wait_ms  waits that long at most for something that the last frame did not have
        """
        line = json.dumps(request).encode() + b"\n"
        try:
            self._tool.stdin.write(line)
            self._tool.stdin.flush()
            facts = json.loads(self._tool.stdout.readline() or b"null")
            data = self._tool.stdout.read(facts["bytes"]) if facts else b""
        except (OSError, ValueError) as problem:
            try:
                self._tool.stdin.close()  # it ends, if it has not
            except OSError:  # the rest is written again here, and not taken either
                pass
            raise PointFrontError(self._complaint() or str(problem)) from None
        if facts is None or len(data) < facts["bytes"]:
            raise PointFrontError(self._complaint() or "the drawing ended")
        return Frame(facts, data)

    def _complaint(self):
        try:
            self._tool.wait(END_SECONDS)
        except subprocess.TimeoutExpired:
            self._tool.kill()
            self._tool.wait()
        self._said.seek(0)
        return self._said.read().decode(errors="replace").strip()

    def close(self):
        """End the tool."""
        self._tool.kill()
        self._tool.wait()
        for file in (self._tool.stdin, self._tool.stdout, self._said):
            try:
                file.close()
            except OSError:  # the unsent rest is of no interest any more
                pass
