"""`pointfront view`: a walk through the window by mouse and keyboard."""

import json
import math
import os
import pathlib
import shutil
import time
import unittest

import numpy
from pictures import read_png, write_png
from tool import ToolTest, write_las
from windows import CENTRE, PATIENCE, SIZE, Window, WindowTest, share_of_difference


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
        window.hands.drag((300, 240), (340, 240))
        window.hands.press("b")  # to what was saved last
        self.assertEqual(window.camera(), looked)
        window.hands.press("r")
        self.assertEqual(window.camera(), begin)
        window.hands.click(*CENTRE, "wheel up")
        near = window.camera()
        way = numpy.subtract(near["position"], eye)
        self.assertGreater(numpy.dot(way, numpy.subtract(begin["focal_point"], eye)), 0.0)
        self.assertEqual(window.end(), (0, ""))

    def test_held_keys_fly(self):
        window = self.open()
        begin = window.camera()
        sight = numpy.subtract(begin["focal_point"], begin["position"])
        forward = sight / numpy.linalg.norm(sight)
        right = numpy.cross(forward, begin["view_up"])
        right /= numpy.linalg.norm(right)
        up = numpy.cross(right, forward)
        for key, towards in (("w", forward), ("s", -forward), ("d", right), ("a", -right),
                             ("Prior", up), ("Next", -up)):
            along, end = 0.0, time.monotonic() + PATIENCE
            while along < 0.02 * numpy.linalg.norm(sight):
                self.assertLess(time.monotonic(), end, f"{key} flies {along} m")
                window.hands.hold(key, True)
                time.sleep(0.5)
                window.hands.hold(key, False)
                flown = window.camera()
                way = numpy.subtract(flown["position"], begin["position"])
                along = way.dot(towards)
            self.assertAlmostEqual(numpy.linalg.norm(way), abs(along), delta=1e-3)
            time.sleep(0.3)
            self.assertEqual(window.camera(), flown, "it flies on")
            window.hands.press("r")
        self.assertEqual(window.end(), (0, ""))

    def test_keys_look_from_all_sides(self):
        window = self.open()
        for key, view in (("2", "top"), ("3", "front"), ("4", "back"), ("5", "left"),
                          ("6", "right"), ("1", "iso")):
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

    def seen(self, window, act=lambda: None):
        """Returns what the screen shows at rest after that, the name of a saved picture too."""
        act()
        window.picture()
        last, end = None, time.monotonic() + PATIENCE
        while last is None or share_of_difference(last, window.hands.seen(*SIZE)) > 0.0:
            self.assertLess(time.monotonic(), end, "the window does not come to rest")
            last = window.hands.seen(*SIZE)
            time.sleep(0.3)
        return last

    def shown(self, window, act=lambda: None):
        """The same without the name of the saved picture, which is at the lower edge."""
        return self.seen(window, act)[:-40]

    def shown_once(self, window, key, holds, plain):
        """The same after a key, once its share of difference is as it must be; a screen that other
        work holds up is at rest before the key's picture is there."""
        end = time.monotonic() + PATIENCE
        last = self.shown(window, lambda: window.hands.press(key))
        while not holds(share_of_difference(last, plain)) and time.monotonic() < end:
            time.sleep(0.3)
            last = window.hands.seen(*SIZE)[:-40]
        return last

    def test_help_facts_and_classes_are_seen(self):
        """Texts of many characters over the picture, gone when their key comes again."""
        window = self.open()
        plain = self.shown(window)
        self.assertEqual(share_of_difference(plain, window.picture()[:-40]), 0.0)
        for key, least in (("question", 0.05), ("f", 0.003), ("k", 0.001)):
            text = self.shown_once(window, key, lambda share: share > least, plain)
            write_png(self.folder / f"{key}.png", text)
            if kept := os.environ.get("POINTFRONT_SCREENSHOTS"):
                shutil.copy(self.folder / f"{key}.png", kept)
            self.assertGreater(share_of_difference(text, plain), least, key)
            again = self.shown_once(window, key, lambda share: share == 0.0, plain)
            self.assertEqual(share_of_difference(again, plain), 0.0, key)
        self.shown(window, lambda: window.hands.press("question"))
        window.hands.press("f")
        window.hands.press("Escape")
        self.assertEqual(share_of_difference(self.shown(window), plain), 0.0)
        self.assertEqual(window.end(), (0, ""))

    def test_the_help_fits_into_the_window(self):
        """The edges of the picture stay as they are, beside the name of the saved picture."""
        window = self.open()
        right_of_name = 200
        plain = self.seen(window)[:, right_of_name:]
        helped = self.seen(window, lambda: window.hands.press("question"))[:, right_of_name:]
        self.assertGreater(share_of_difference(helped, plain), 0.05)
        self.assertEqual(share_of_difference(helped[-3:], plain[-3:]), 0.0)
        self.assertEqual(share_of_difference(helped[:, -3:], plain[:, -3:]), 0.0)
        self.assertEqual(window.end(), (0, ""))

    def test_a_window_at_rest_sleeps(self):
        window = self.open()
        window.hands.press("f")
        self.assertLessEqual(window.rest(), 0.01)  # a tick of the clock in two seconds
        self.assertEqual(window.end(), (0, ""))

    def test_it_begins_with_the_camera_of_a_file(self):
        camera = {"position": [636000.0, 848500.0, 3000.0],
                  "focal_point": [636800.0, 849200.0, 450.0],
                  "view_up": [0.0, 0.0, 1.0], "view_angle": 25.0}
        (self.folder / "c.json").write_text(json.dumps(camera))
        window = self.open("--camera", self.folder / "c.json")
        self.assertEqual(window.camera(), camera)
        self.assertEqual(window.end(), (0, ""))


class Questions(ToolTest):
    """Points whose places in the picture are known: a grid, seen from above, 4 px a unit."""

    def setUp(self):
        super().setUp()
        self.points = [(x, y, 0.25 * x, 256 * x, 256 * y, 7)
                       for y in range(100) for x in range(100)]
        write_las(self.folder / "grid.las", self.points)
        self.store = self.build(self.folder / "grid.las")
        camera = {"position": [50, 50, 500], "focal_point": [50, 50, 0], "view_up": [0, 1, 0],
                  "parallel_scale": 60}
        (self.folder / "above.json").write_text(json.dumps(camera))

    @staticmethod
    def pixel(x, y):
        return 320 + 4 * (x - 50), 240 - 4 * (y - 50)

    def open(self, *arguments):
        window = Window(self.folder, self.store, "--camera", self.folder / "above.json",
                        "--point-size", "1", *arguments)
        self.addCleanup(lambda: window.process.poll() is None and window.close())
        window.picture()  # complete
        return window

    def test_a_click_names_the_point_that_is_drawn_there(self):
        for backend in ("software", "opengl"):
            window = self.open("--backend", backend)
            for x, y in ((10, 20), (77, 3), (99, 99), (0, 50)):
                window.hands.click(*self.pixel(x, y))
                point = json.loads(window.said())
                self.assertEqual((point["x"], point["y"], point["z"]), (x, y, 0.25 * x))
                self.assertEqual(point["rgb"], [256 * x, 256 * y, 7])
                self.assertEqual(point["intensity"], 0)
                self.assertEqual(pathlib.Path(point["store"]).name, "cloud.pfront")
            window.hands.move(*self.pixel(33, 44))
            window.hands.press("p")
            self.assertEqual(json.loads(window.said())["y"], 44)
            window.hands.click(5, 5)  # background: no answer
            window.hands.click(*self.pixel(1, 2))
            self.assertEqual(json.loads(window.said())["y"], 2)
            self.assertEqual(window.end(), (0, ""))

    def test_two_points_have_a_distance_and_a_height(self):
        window = self.open()
        window.hands.move(*self.pixel(10, 20))
        window.hands.press("m")
        window.hands.move(*self.pixel(50, 50))
        window.hands.press("m")
        self.assertEqual(json.loads(window.said()), {
            "distance": math.sqrt(50.0 ** 2 + 10.0 ** 2), "horizontal": 50.0, "height": 10.0,
            "from": [10.0, 20.0, 2.5], "to": [50.0, 50.0, 12.5]})
        window.hands.move(*self.pixel(60, 20))
        window.hands.press("m")  # begins anew
        window.hands.click(*self.pixel(20, 20))  # a click ends it
        measured = json.loads(window.said())
        self.assertEqual((measured["horizontal"], measured["height"]), (40.0, -10.0))
        window.hands.move(*self.pixel(60, 20))
        window.hands.press("m")
        window.hands.press("Escape")
        window.hands.click(*self.pixel(20, 20))
        self.assertIn("rgb", json.loads(window.said()))  # a click asks again
        self.assertEqual(window.end(), (0, ""))

    def test_marks_are_drawn_where_the_points_are(self):
        window = self.open("--background", "0,0,0")
        plain = window.picture()
        window.hands.move(*self.pixel(10, 30))
        window.hands.press("m")
        window.hands.click(*self.pixel(90, 30))
        window.said()
        marked = window.picture()
        rows, columns = numpy.nonzero(numpy.any(marked != plain, axis=2))
        self.assertLessEqual(abs(columns.min() - self.pixel(10, 30)[0]), 6)
        self.assertLessEqual(abs(columns.max() - self.pixel(90, 30)[0]), 6)
        self.assertLess(max(abs(rows - self.pixel(10, 30)[1])), 7)
        window.hands.press("Escape")
        self.assertEqual(share_of_difference(window.picture(), plain), 0.0)
        self.assertEqual(window.end(), (0, ""))


class Styles(WindowTest):
    """A key changes what an option of `render` asks for."""

    def setUp(self):
        ToolTest.setUp(self)
        self.succeed("generate", "--points", "30000", "-o", self.folder / "survey.las")
        self.store = self.build(self.folder / "survey.las")

    def expect(self, window, *arguments):
        picture = window.picture()
        rendered = self.folder / "expected.png"
        self.succeed("render", self.store, "-o", rendered,
                     "--size", f"{SIZE[0]}x{SIZE[1]}", *arguments)
        self.assertLess(share_of_difference(picture, read_png(rendered)), 0.001, arguments)

    def test_colours(self):
        window = self.open()
        for key, name in (("c", "classification"), ("c", "intensity"), ("c", "elevation"),
                          ("C", "intensity"), ("C", "classification"), ("C", "rgb")):
            window.hands.press(key)
            self.expect(window, "--color-by", name)
        self.assertEqual(window.end(), (0, ""))

    def test_techniques(self):
        window = self.open()
        for key, name in (("t", "splats"), ("t", "spheres"), ("T", "splats"), ("T", "points")):
            window.hands.press(key)
            self.expect(window, "--technique", name)
        window.hands.press("T")
        self.expect(window, "--technique", "ewa")
        self.assertEqual(window.end(), (0, ""))

    def test_presets_sizes_and_light(self):
        window = self.open()
        for name in ("draft", "balanced", "exact", "draft"):
            window.hands.press("x")
            self.expect(window, "--quality", name)
        window.hands.press("l")
        self.expect(window, "--quality", "draft", "--edl")
        self.assertEqual(window.end(), (0, ""))
        window = self.open("--point-size", "4")
        window.hands.press("plus")
        self.expect(window, "--point-size", "5")
        window.hands.press("minus")
        self.expect(window, "--point-size", "4")
        self.assertEqual(window.end(), (0, ""))

    def test_classes(self):
        classes = [layer["class"] for layer in
                   self.succeed("info", self.store, "--json").json["layers"]]
        self.assertGreater(len(classes), 2)
        for layers in ("class", "none"):
            self.succeed("build", self.folder / "survey.las", "-o", self.store, "--force",
                         "--layers", layers)
            window = self.open()
            window.hands.press("k")
            window.hands.press("Return")
            self.expect(window, "--classes", ",".join(map(str, classes[1:])))
            window.hands.press("Up")  # to the last one
            window.hands.press("Return")
            self.expect(window, "--classes", ",".join(map(str, classes[1:-1])))
            window.hands.press("Return")
            window.hands.press("Down")
            window.hands.press("Return")
            self.expect(window)
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
