"""A server of a page in a process of its own, and a browser for it: Chromium, headless.

POINTFRONT_CHROMIUM in the environment names the browser, /usr/bin/chromium unless given.
"""

import io
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import numpy
import pointfront
from PIL import Image
from playwright.sync_api import sync_playwright

CLOUD = pathlib.Path(__file__).resolve().parents[3] / "Testing/Data/autzen_stadium.laz"
CHROMIUM = os.environ.get("POINTFRONT_CHROMIUM", "/usr/bin/chromium")
SETTLED = ".pointfront-status[data-settled=true]"
LIMIT_MS = 120000  # only what hangs takes that


def without_display():
    return {name: value for name, value in os.environ.items() if name != "DISPLAY"}


class Server:
    """`pointfront serve` in a process of its own."""

    def __init__(self, *arguments):
        command = [sys.executable, "-m", "pointfront", "serve", *map(str, arguments)]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                        text=True, env=without_display())
        line = self.process.stdout.readline()
        found = re.search(r"http://\S+", line)
        if found is None:
            self.process.kill()
            raise AssertionError(line + self.process.stderr.read())
        self.url = found.group(0)

    def tools(self):
        """Processes that this server started."""
        threads = pathlib.Path(f"/proc/{self.process.pid}/task").iterdir()
        return [int(word) for thread in threads
                for word in (thread / "children").read_text().split()]

    def processor_seconds(self):
        """That this server and its tools have used so far, in all threads."""
        used = 0.0
        for pid in (self.process.pid, *self.tools()):
            for thread in pathlib.Path(f"/proc/{pid}/task").iterdir():
                used += int((thread / "schedstat").read_text().split()[0]) / 1e9
        return used

    def end(self, with_signal=signal.SIGINT):
        self.process.send_signal(with_signal)
        status = self.process.wait(LIMIT_MS / 1000)
        self.process.stdout.close()
        self.said = self.process.stderr.read()
        self.process.stderr.close()
        return status


class InBrowser(unittest.TestCase):
    """A store, and a browser for it."""

    cloud = CLOUD

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory(prefix="pointfront-page-")
        cls.addClassCleanup(cls.temporary.cleanup)
        cls.store = pathlib.Path(cls.temporary.name) / "a.pfront"
        pointfront.build(cls.cloud, cls.store, assumed_crs="EPSG:2994", preview=False)
        playwright = sync_playwright().start()
        cls.addClassCleanup(playwright.stop)
        cls.browser = playwright.chromium.launch(
            executable_path=CHROMIUM, args=["--no-sandbox", "--disable-gpu"])
        cls.addClassCleanup(cls.browser.close)

    def open(self, url, width=800, height=500):
        page = self.browser.new_page(viewport={"width": width, "height": height})
        self.addCleanup(page.close)
        self.errors = []
        self.messages = []  # between the page and its server
        page.on("websocket", lambda line: [
            line.on(way, lambda message, to=self.messages: to.append(message))
            for way in ("framesent", "framereceived")])
        page.on("console", lambda said: said.type == "error" and self.errors.append(said.text))
        page.on("pageerror", lambda error: self.errors.append(str(error)))
        page.goto(url)
        self.wait(page)
        return page

    @staticmethod
    def wait(page):
        page.wait_for_selector(SETTLED, state="attached", timeout=LIMIT_MS)

    @staticmethod
    def frames(page):
        return int(page.get_attribute(".pointfront-status", "data-frames"))

    def settle(self, page, act):
        """Does something, waits until the view has a new picture at rest, gives its pixels."""
        before = self.frames(page)
        act()
        page.wait_for_function(f"document.querySelector('.pointfront-status').dataset.frames > "
                               f"{before}", timeout=LIMIT_MS)
        self.wait(page)
        return self.pixels(page)

    @staticmethod
    def pixels(page):
        """Below the bar and above the status: height by width by 3."""
        time.sleep(0.2)  # the browser shows what it got
        picture = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
        return numpy.asarray(picture).astype(int)[40:-40]
