"""The tool's window, and a person before it."""

import json
import os
import pathlib
import queue
import subprocess
import threading
import time

import numpy
from hands import Hands
from pictures import read_png
from tool import DATA, SLOWNESS, TOOL, ToolTest

CLOUD = DATA / "las/real/autzen_trim.las"
SIZE = (640, 480)
CENTRE = (320, 240)
PATIENCE = 300 * SLOWNESS  # seconds until a test that hangs is ended


class Window:
    """The tool's window, and a person before it."""

    def __init__(self, folder, *arguments, environment=None, stdout=subprocess.PIPE):
        self.folder = folder
        self.process = subprocess.Popen(
            [TOOL, "view", *map(str, arguments), "--size", f"{SIZE[0]}x{SIZE[1]}"], cwd=folder,
            stdin=subprocess.DEVNULL, stdout=stdout, stderr=subprocess.PIPE,
            env=environment)
        self.lines = queue.Queue()
        self.reading = threading.Thread(target=self._read)
        self.reading.start()
        self.hands = Hands("PointFront: ", PATIENCE)
        self.hands.move(*CENTRE)  # without a window manager keys go where the mouse is

    def _read(self):
        for line in self.process.stdout or ():
            self.lines.put(line.decode().rstrip("\n"))

    def said(self):
        """The next line on stdout."""
        return self.lines.get(timeout=PATIENCE)

    def picture(self):
        """Returns the picture that the window shows, complete."""
        self.hands.press("g")
        return read_png(self.folder / self.said())

    def camera(self):
        self.hands.press("v")
        return json.loads((self.folder / self.said()).read_text())

    def rest(self):
        """Waits until the program sleeps; seconds of CPU that it takes in two of a clock's."""
        self.picture()
        stat = pathlib.Path(f"/proc/{self.process.pid}/stat")

        def taken():
            # Ticks, as whole numbers: the difference of two times is a rounding more than a tick.
            fields = stat.read_text().rsplit(")", 1)[1].split()
            return int(fields[11]) + int(fields[12])

        time.sleep(1.0)
        before = taken()
        time.sleep(2.0)
        return (taken() - before) / os.sysconf("SC_CLK_TCK")

    def end(self):
        """Its status and what it complained of."""
        self.hands.press("q")
        status = self.process.wait(PATIENCE)
        self.reading.join()
        complaint = self.process.stderr.read().decode()
        self.close()
        return status, complaint

    def close(self):
        self.process.kill()
        self.process.wait()
        self.reading.join()
        self.hands.close()
        if self.process.stdout is not None:
            self.process.stdout.close()
        self.process.stderr.close()


def share_of_difference(a, b):
    return numpy.any(a != b, axis=2).mean()


class WindowTest(ToolTest):
    def setUp(self):
        super().setUp()
        self.store = self.build(CLOUD)

    def open(self, *arguments):
        window = Window(self.folder, self.store, *arguments)
        self.addCleanup(lambda: window.process.poll() is None and window.close())
        return window

    def rendered(self, camera, *arguments):
        """By `render`, from a camera."""
        (self.folder / "camera.json").write_text(json.dumps(camera))
        picture = self.folder / "rendered.png"
        self.succeed("render", self.store, "-o", picture, "--camera", self.folder / "camera.json",
                     "--size", f"{SIZE[0]}x{SIZE[1]}", *arguments)
        return read_png(picture)
