"""`pointfront view`: a walk through the window by mouse and keyboard."""

import json
import os
import pathlib
import queue
import subprocess
import threading
import time
import unittest

import numpy
from hands import Hands
from pictures import read_png
from tool import DATA, SLOWNESS, TOOL, ToolTest

CLOUD = DATA / "las/real/autzen_trim.las"
SIZE = (640, 480)
CENTRE = (320, 240)
PATIENCE = 60 * SLOWNESS


class Window:
    """The tool's window, and a person before it."""

    def __init__(self, folder, *arguments):
        self.folder = folder
        self.process = subprocess.Popen(
            [TOOL, "view", *map(str, arguments), "--size", f"{SIZE[0]}x{SIZE[1]}"], cwd=folder,
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.lines = queue.Queue()
        self.reading = threading.Thread(target=self._read)
        self.reading.start()
        self.hands = Hands("PointFront: ", PATIENCE)
        self.hands.move(*CENTRE)  # without a window manager keys go where the mouse is

    def _read(self):
        for line in self.process.stdout:
            self.lines.put(line.decode().rstrip("\n"))

    def said(self):
        """The next line on stdout."""
        return self.lines.get(timeout=PATIENCE)

    def picture(self):
        """What the window shows, complete."""
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
            fields = stat.read_text().rsplit(")", 1)[1].split()
            return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

        time.sleep(1.0)
        before = taken()
        time.sleep(2.0)
        return taken() - before

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


class Walk(WindowTest):
    def test_a_picture_is_that_of_render_from_the_saved_camera(self):
        for backend in ("software", "opengl"):
            window = self.open("--backend", backend)
            first = window.camera()
            window.hands.drag((300, 240), (360, 200))
            moved = window.camera()
            self.assertNotEqual(moved["position"], first["position"])
            picture = window.picture()
            self.assertEqual(window.end(), (0, ""))
            again = self.rendered(moved, "--backend", backend)
            self.assertLess(share_of_difference(picture, again), 0.001, backend)

    def test_the_mouse_moves_the_camera(self):
        window = self.open()
        begin = window.camera()
        eye = numpy.array(begin["position"])
        window.hands.drag((300, 240), (400, 240))
        turned = window.camera()
        self.assertAlmostEqual(turned["position"][2], begin["position"][2], places=6)
        self.assertGreater(numpy.linalg.norm(turned["position"] - eye), 1.0)
        window.hands.drag((300, 240), (300, 300), "middle")
        panned = window.camera()
        for one, other in (("position", "focal_point"),):
            numpy.testing.assert_allclose(
                numpy.subtract(panned[one], turned[one]),
                numpy.subtract(panned[other], turned[other]), atol=1e-6)
        self.assertEqual(panned["view_up"], turned["view_up"])
        window.hands.drag((300, 240), (340, 240), "right")
        looked = window.camera()
        numpy.testing.assert_allclose(looked["position"], panned["position"], atol=1e-6)
        self.assertNotEqual(looked["focal_point"], panned["focal_point"])
        window.hands.press("b")  # saved last: the same
        self.assertEqual(window.camera(), looked)
        window.hands.press("r")
        self.assertEqual(window.camera(), begin)
        window.hands.click(*CENTRE, "wheel up")
        near = window.camera()
        way = numpy.subtract(near["position"], eye)
        self.assertGreater(numpy.dot(way, numpy.subtract(begin["focal_point"], eye)), 0.0)
        self.assertEqual(window.end(), (0, ""))

    def test_keys_look_from_all_sides(self):
        window = self.open()
        for key, view in (("2", "top"), ("3", "front"), ("6", "right"), ("1", "iso")):
            window.hands.press(key)
            picture = window.picture()
            rendered = self.folder / "view.png"
            self.succeed("render", self.store, "-o", rendered, "--view", view,
                         "--size", f"{SIZE[0]}x{SIZE[1]}")
            self.assertLess(share_of_difference(picture, read_png(rendered)), 0.001, view)
        window.hands.press("o")
        self.assertIn("parallel_scale", window.camera())
        window.hands.press("o")
        self.assertIn("view_angle", window.camera())
        self.assertEqual(window.end(), (0, ""))

    def test_files_are_never_replaced(self):
        (self.folder / "pointfront-1.png").write_text("mine")
        (self.folder / "pointfront-camera-1.json").symlink_to("nothing")
        window = self.open()
        window.hands.press("g")
        self.assertEqual(window.said(), "pointfront-2.png")
        window.hands.press("g")
        self.assertEqual(window.said(), "pointfront-3.png")
        window.hands.press("v")
        self.assertEqual(window.said(), "pointfront-camera-2.json")
        self.assertEqual((self.folder / "pointfront-1.png").read_text(), "mine")
        self.assertEqual(window.end(), (0, ""))

    def test_help_and_facts_lie_over_the_picture_and_not_in_files(self):
        window = self.open()
        plain = window.picture()
        window.hands.press("question")
        window.hands.press("f")
        self.assertEqual(share_of_difference(window.picture(), plain), 0.0)
        window.hands.press("Escape")
        self.assertEqual(window.end(), (0, ""))

    def test_a_window_at_rest_sleeps(self):
        window = self.open()
        window.hands.press("f")
        self.assertLess(window.rest(), 0.05)
        self.assertEqual(window.end(), (0, ""))

    def test_it_begins_with_the_camera_of_a_file(self):
        camera = {"position": [636000.0, 848500.0, 3000.0],
                  "focal_point": [636800.0, 849200.0, 450.0],
                  "view_up": [0.0, 0.0, 1.0], "view_angle": 25.0}
        (self.folder / "c.json").write_text(json.dumps(camera))
        window = self.open("--camera", self.folder / "c.json")
        self.assertEqual(window.camera(), camera)
        self.assertEqual(window.end(), (0, ""))


class Refusals(WindowTest):
    def test_what_is_wrong_is_said_in_a_line(self):
        bare = {k: v for k, v in os.environ.items() if k != "DISPLAY"}
        said = self.refuse(1, "view", self.store, environment=bare).err
        self.assertIn("needs an X server", said)
        said = self.refuse(1, "view", self.store, environment={**bare, "DISPLAY": ":9999"}).err
        self.assertIn(":9999", said)
        self.refuse(1, "view", self.folder / "none.pfront")
        self.refuse(1, "view", self.store, "--color-by", "nothing")
        self.refuse(1, "view", self.store, "--camera", self.folder / "none.json")
        self.refuse(2, "view")
        self.refuse(2, "view", self.store, "--view", "below")


if __name__ == "__main__":
    unittest.main()
