"""Controls over the page's picture, in a real browser: classes, legend, sizes, points,
measures, a bar while it loads, and a connection that comes back. Environment as for test_page.py.
"""

import os
import pathlib
import re
import socket
import subprocess
import sys
import threading
import time
import unittest

import numpy
import pointfront
from page_trial import CLOUD, LIMIT_MS, InBrowser, Server

TOLERANCE = 0.002  # for numbers that are shown with three digits
SEEN = (slice(None), slice(0, 600))  # pixels beside the switches


class Wire:
    """A TCP connection on another port to a server, that can be cut and mended."""

    def __init__(self, port):
        self._target = port
        self._mended = True
        self._pairs = []
        self._door = socket.create_server(("localhost", 0))
        self.port = self._door.getsockname()[1]
        threading.Thread(target=self._accept, daemon=True).start()

    def _accept(self):
        while True:
            try:
                near, _ = self._door.accept()
            except OSError:
                return
            if not self._mended:
                near.close()
                continue
            far = socket.create_connection(("localhost", self._target))
            self._pairs.append((near, far))
            for ends in ((near, far), (far, near)):
                threading.Thread(target=self._carry, args=ends, daemon=True).start()

    @staticmethod
    def _carry(source, target):
        try:
            while data := source.recv(65536):
                target.sendall(data)
        except OSError:
            pass
        for end in (source, target):
            try:
                end.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass

    def cut(self):
        self._mended = False
        for pair in self._pairs:
            for end in pair:
                try:
                    end.shutdown(socket.SHUT_RDWR)
                except OSError:
                    pass
        self._pairs = []

    def mend(self):
        self._mended = True

    def close(self):
        self.cut()
        self._door.close()


class Controls(InBrowser):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.unlayered = pathlib.Path(cls.temporary.name) / "one.pfront"
        pointfront.build(CLOUD, cls.unlayered, layers="none", assumed_crs="EPSG:2994",
                         preview=False)
        with pointfront.open(cls.unlayered) as cloud:
            cls.points = cloud.points()
        terrain = pathlib.Path(cls.temporary.name) / "terrain.las"
        subprocess.run([sys.executable, "-m", "pointfront", "generate", "--points", "200000", "-o",
                        terrain], check=True, stdout=subprocess.DEVNULL)
        cls.terrains = [pathlib.Path(cls.temporary.name) / f"{layers}.pfront"
                        for layers in ("class", "none")]
        for store, layers in zip(cls.terrains, ("class", "none")):
            pointfront.build(terrain, store, layers=layers, preview=False)
        with pointfront.open(cls.terrains[0]) as cloud:
            cls.codes = sorted(set(cloud.points()["classification"].tolist()))

    def serve(self, store, *arguments):
        server = Server(store, "--port", "0", *arguments)
        self.addCleanup(server.process.kill)
        return server, self.open(server.url)

    def change(self, page, act):
        """Does something, waits until the picture is another one and at rest, gives its pixels."""
        before, last = self.pixels(page)[SEEN], None
        act()
        end = time.monotonic() + LIMIT_MS / 1000
        while time.monotonic() < end:
            self.wait(page)
            now = self.pixels(page)
            if last is not None and (now[SEEN] != before).any() and (now == last).all():
                return now
            last = now
        raise AssertionError("the picture does not change, or does not come to rest")

    def number_of_points(self, page):
        return int(page.inner_text(".pointfront-status").split()[0].replace(",", ""))

    def rows(self, page):
        text = page.inner_text(".pointfront-point table")
        return dict(line.split("\t", 1) for line in text.splitlines() if "\t" in line)

    def click(self, page, x, y):
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.up()

    def test_classes_are_switched(self):
        codes = self.codes
        self.assertGreater(len(codes), 3)
        for store in self.terrains:
            server, page = self.serve(store, "--color-by", "classification", "--error", "0.5")
            boxes = page.locator(".pointfront-classes input")
            self.assertEqual([boxes.nth(i).get_attribute("name") for i in range(boxes.count())],
                             [f"class {code}" for code in codes])
            self.assertIn("ground", page.inner_text(".pointfront-classes"))
            swatch = page.locator(".pointfront-classes span").nth(codes.index(2))
            self.assertIn("rgb(165, 120, 75)", swatch.get_attribute("style"))
            if shots := os.environ.get("POINTFRONT_SCREENSHOTS"):
                page.screenshot(path=f"{shots}/classes.png")
            whole, before = self.number_of_points(page), self.pixels(page)
            after = self.change(page, lambda: page.uncheck("input[name='class 2']"))
            if store == self.terrains[0]:  # else points are read and left out
                self.assertLess(self.number_of_points(page), whole)
            ground = numpy.abs(before - [165, 120, 75]).max(axis=2) < 6
            self.assertGreater(ground.mean(), 0.02)
            left = numpy.abs(after - [165, 120, 75]).max(axis=2) < 6
            self.assertLess(left.mean(), 0.1 * ground.mean())
            for code in codes[:-1]:
                if code != 2:
                    self.change(page, lambda: page.uncheck(f"input[name='class {code}']"))
            self.assertTrue(page.is_disabled(f"input[name='class {codes[-1]}']"))
            for code in codes[:-1]:
                self.change(page, lambda: page.check(f"input[name='class {code}']"))
            self.assertEqual(numpy.abs(self.pixels(page) - before)[SEEN].max(), 0)
            self.assertEqual(self.errors, [])
            page.close()
            server.end()

    def test_a_legend_says_what_colours_mean(self):
        server, page = self.serve(self.store)
        self.assertEqual(page.locator(".pointfront-legend").count(), 0, "rgb needs none")
        self.change(page, lambda: page.select_option("select >> nth=0", "intensity"))
        name, *ends = page.inner_text(".pointfront-legend").split()
        self.assertEqual(name, "intensity")
        low, high = map(float, ends)
        within = numpy.percentile(self.points["intensity"], [0, 50, 100])
        self.assertTrue(within[0] <= low < within[1] < high <= within[2], ends)
        ramp = page.locator(".pointfront-legend div").nth(1).get_attribute("style")
        self.assertIn("linear-gradient", ramp)
        self.change(page, lambda: page.select_option("select >> nth=0", "rgb"))
        self.assertEqual(page.locator(".pointfront-legend").count(), 0)
        self.change(page, lambda: page.select_option("select >> nth=0", "classification"))
        self.assertIn("0 never classified", page.inner_text(".pointfront-legend"))  # all points
        self.assertEqual(page.locator(".pointfront-classes").count(), 0)
        self.assertEqual(self.errors, [])
        server.end()

    def test_points_have_the_size_that_is_chosen(self):
        server, page = self.serve(self.store, "--technique", "points", "--error", "4")
        covered = []
        for size in ("1", "3", "8"):
            picture = self.change(page, lambda: page.select_option("select >> nth=2", size))
            covered.append((numpy.abs(picture - [23, 25, 31]).max(axis=2) > 40).mean())
        self.assertLess(covered[0], 0.8 * covered[1])
        self.assertLess(covered[1], covered[2])
        server.end()

    def picked(self, page, x, y):
        """Clicks there; returns what the page tells of the point, and its position."""
        self.click(page, x, y)
        page.wait_for_selector(".pointfront-marks circle", timeout=LIMIT_MS)
        time.sleep(0.5)
        told = self.rows(page)
        return told, numpy.array([float(told[axis]) for axis in "xyz"])

    def test_a_click_shows_the_point(self):
        server, page = self.serve(self.store)
        self.click(page, 400, 250)
        time.sleep(0.5)
        self.assertEqual(page.locator(".pointfront-point").count(), 0, "no tool was taken")
        page.click("text=pick")
        for x, y in ((400, 250), (330, 280)):
            told, place = self.picked(page, x, y)
            found = numpy.abs(self.points["position"] - place).max(axis=1) < TOLERANCE
            self.assertTrue(found.any(), told)
            self.assertIn(int(told["intensity"]), self.points["intensity"][found].tolist())
            self.assertIn(int(told["classification"]),
                          self.points["classification"][found].tolist())
            self.assertEqual(told["store"], "a.pfront")
            box = page.locator(".pointfront-marks circle").bounding_box()
            self.assertLess(abs(box["x"] + box["width"] / 2 - x), 9)
            self.assertLess(abs(box["y"] + box["height"] / 2 - y), 9)
        self.change(page, lambda: page.click("text=top"))  # the mark goes with its point
        moved = page.locator(".pointfront-marks circle").bounding_box()
        self.assertGreater(abs(moved["x"] - box["x"]) + abs(moved["y"] - box["y"]), 3)
        self.click(page, 30, 250)  # beside the cloud
        page.wait_for_function("document.querySelector('.pointfront-point').innerText"
                               ".includes('no point')", timeout=LIMIT_MS)
        page.click("text=clear")
        page.wait_for_selector(".pointfront-point", state="detached", timeout=LIMIT_MS)
        self.assertEqual(self.errors, [])
        server.end()

    def test_two_clicks_measure(self):
        server, page = self.serve(self.store)
        page.click("text=pick")
        places = [self.picked(page, x, y)[1] for x, y in ((350, 260), (460, 240))]
        page.click("text=measure")
        self.click(page, 350, 260)
        page.wait_for_function("document.querySelector('.pointfront-point')?.innerText"
                               ".includes('second')", timeout=LIMIT_MS)
        self.click(page, 460, 240)
        page.wait_for_selector(".pointfront-marks line", state="attached", timeout=LIMIT_MS)
        time.sleep(0.3)
        told = self.rows(page)
        way = places[1] - places[0]
        for name, length in (("distance", numpy.linalg.norm(way)),
                             ("horizontal", numpy.linalg.norm(way[:2])), ("height", way[2])):
            self.assertLess(abs(float(told[name]) - length), 2 * TOLERANCE, (name, told, places))
        if shots := os.environ.get("POINTFRONT_SCREENSHOTS"):
            page.screenshot(path=f"{shots}/measure.png")
        self.assertEqual(self.errors, [])
        server.end()

    def test_a_bar_shows_that_it_loads(self):
        server, page = self.serve(self.store, "--error", "0.3")
        self.assertEqual(page.locator(".pointfront-loading").count(), 0, "it is at rest")
        page.evaluate("""() => {
          window.widths = [];
          new MutationObserver(() => {
            const bar = document.querySelector(".pointfront-loading div");
            if (bar) window.widths.push(parseFloat(bar.style.width));
          }).observe(document.body, {subtree: true, childList: true, attributes: true});
        }""")
        self.change(page, lambda: page.select_option("select >> nth=0", "intensity"))
        widths = page.evaluate("window.widths")
        self.assertTrue(widths, "no bar while it was loading")
        self.assertTrue(all(0 <= width <= 100 for width in widths), widths)
        self.assertEqual(page.locator(".pointfront-loading").count(), 0, "the bar stays")
        server.end()

    def test_a_connection_that_is_cut_comes_back(self):
        server = Server(self.store, "--port", "0")
        self.addCleanup(server.process.kill)
        port = int(re.search(":([0-9]+)/", server.url).group(1))
        wire = Wire(port)
        self.addCleanup(wire.close)
        page = self.open(server.url.replace(f":{port}/", f":{wire.port}/"))
        self.change(page, lambda: page.select_option("select >> nth=0", "intensity"))
        before = self.pixels(page)
        wire.cut()
        page.wait_for_selector(".pointfront-notice", timeout=LIMIT_MS)
        self.assertIn("lost", page.inner_text(".pointfront-notice"))
        time.sleep(1.5)
        wire.mend()
        page.wait_for_selector(".pointfront-notice", state="detached", timeout=LIMIT_MS)
        self.wait(page)
        self.assertEqual(numpy.abs(self.pixels(page) - before).max(), 0, "it is another view")
        moved = self.change(page, lambda: page.mouse.wheel(0, -300))
        self.assertGreater(numpy.abs(moved - before).mean(), 1)
        wire.cut()
        page.wait_for_selector(".pointfront-notice", timeout=LIMIT_MS)
        server.end()
        other = Server(self.store, "--port", str(port))  # with another secret
        self.addCleanup(other.process.kill)
        wire.mend()
        page.wait_for_function("document.querySelector('.pointfront-notice')?.innerText"
                               ".includes('ended')", timeout=LIMIT_MS)
        other.end()


if __name__ == "__main__":
    unittest.main(verbosity=2)
