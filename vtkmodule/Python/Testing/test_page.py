"""The page of `pointfront serve` and the view of a notebook in a real browser: Chromium, headless.

Neither has a display. Environment: POINTFRONT_CHROMIUM the browser, /usr/bin/chromium unless given;
POINTFRONT_SHARED_DATA the public clouds, of which a large one is shown.
"""

import asyncio
import concurrent.futures
import io
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.error
import urllib.request

import aiohttp
import msgpack
import numpy
import pointfront
from PIL import Image
from playwright.sync_api import sync_playwright
from pointfront._remote import RemoteView
from wslink.chunking import UnChunker, generate_chunks

CLOUD = pathlib.Path(__file__).resolve().parents[3] / "Testing/Data/autzen_stadium.laz"
LARGE = (pathlib.Path(os.environ.get("POINTFRONT_SHARED_DATA", "none"))
         / "large/autzen_10653336_rgb_intensity.laz")
CHROMIUM = os.environ.get("POINTFRONT_CHROMIUM", "/usr/bin/chromium")
SETTLED = ".pointfront-status[data-settled=true]"
STRANGER = "elsewhere.example"
LIMIT_MS = 30000


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

    def end(self, with_signal=signal.SIGINT):
        self.process.send_signal(with_signal)
        status = self.process.wait(20)
        self.process.stdout.close()
        self.process.stderr.close()
        return status


def status_of(url):
    try:
        with urllib.request.urlopen(url) as answer:
            return answer.status
    except urllib.error.HTTPError as refused:
        return refused.code


def greet(address, secret):
    with concurrent.futures.ThreadPoolExecutor(1) as thread:  # playwright has this one's event loop
        return thread.submit(asyncio.run, _greet(address, secret)).result()


async def _greet(address, secret):
    """What a server's socket answers to a greeting, and to a question for the whole state."""
    said = []
    async with aiohttp.ClientSession() as session:
        async with session.ws_connect(f"{address}/ws") as socket:
            for call, method, arguments in (("system:c0:0", "wslink.hello", [{"secret": secret}]),
                                            ("rpc:c0:1", "trame.state.get", [])):
                message = msgpack.packb({"wslink": "1.0", "id": call, "method": method,
                                         "args": arguments, "kwargs": {}})
                for chunk in generate_chunks(message, 0):
                    await socket.send_bytes(chunk)
                parts, answer = UnChunker(), None
                parts.set_max_message_size(1 << 20)
                while answer is None:
                    answer = parts.process_chunk((await socket.receive(20)).data)
                said.append(answer)
    return said


class Frames(unittest.TestCase):
    def test_frames_in_motion_are_cheap_and_the_last_is_whole(self):
        folder = tempfile.TemporaryDirectory(prefix="pointfront-frames-")
        self.addCleanup(folder.cleanup)
        store = pathlib.Path(folder.name) / "a.pfront"
        pointfront.build(CLOUD, store)
        sent, told = [], []

        async def move():
            view = RemoteView([store], ["--frame-ms", "1"], told.append)
            view.set_push_callback(lambda data, meta: sent.append((meta["quality"], len(data))))
            view.process_resize_event(640, 360)
            view.schedule_render()
            await asyncio.sleep(1.0)
            view.process_interaction_event({"type": "LeftButtonPress", "x": 300, "y": 200})
            for x in range(300, 360, 4):
                view.process_interaction_event({"type": "MouseMove", "x": x, "y": 200})
                view.schedule_render()
                await asyncio.sleep(0.03)
            view.process_interaction_event({"type": "LeftButtonRelease", "x": 360, "y": 200})
            await asyncio.sleep(1.5)
            await view.close()

        asyncio.run(move())
        moving = [size for quality, size in sent if quality < 80]
        self.assertGreater(len(moving), 3)
        last_quality, last_size = sent[-1]
        self.assertGreater(last_quality, 80, "no frame at rest came last")
        self.assertLess(numpy.median(moving), 0.7 * last_size)
        self.assertTrue(told[-1]["settled"])
        points = [facts["points"] for facts in told if facts["moving"]]
        self.assertLess(points[-1], told[-1]["points"], "the view at rest is not refined")


    def test_an_error_is_told_and_the_next_event_begins_again(self):
        folder = tempfile.TemporaryDirectory(prefix="pointfront-frames-")
        self.addCleanup(folder.cleanup)
        store = pathlib.Path(folder.name) / "a.pfront"
        pointfront.build(CLOUD, store)
        told = []

        async def err():
            view = RemoteView([store], [], told.append)
            view.set_push_callback(lambda *_: None)
            view.process_resize_event(320, 180)
            view.draw_with(["--color-by", "nothing-of-that-name"])
            await asyncio.sleep(1.5)
            self.assertIn("nothing-of-that-name", told[-1]["problem"])
            view.draw_with([])
            await asyncio.sleep(1.5)
            self.assertTrue(told[-1]["settled"])
            for _ in range(600):  # as near as a wheel can bring it
                view.process_interaction_event(
                    {"type": "MouseWheel", "x": 160, "y": 90, "spinY": -1})
            view.schedule_render()
            await asyncio.sleep(1.5)
            self.assertNotIn("problem", told[-1])
            await view.close()

        asyncio.run(err())


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


class Page(InBrowser):
    def test_a_view_is_opened_moved_and_refined(self):
        server = Server(self.store, "--port", "0")
        self.addCleanup(server.process.kill)
        page = self.open(server.url)
        first = self.pixels(page)
        self.assertGreater(first.std(axis=(0, 1)).min(), 20, "no cloud is in the picture")

        def drag():
            page.mouse.move(400, 250)
            page.mouse.down()
            for step in range(40):
                page.mouse.move(400 + 5 * step, 250 + step)
                time.sleep(0.02)
            page.mouse.up()

        before = self.frames(page)
        turned = self.settle(page, drag)
        self.assertGreater(self.frames(page) - before, 5, "no frames while it moved")
        self.assertGreater(numpy.abs(turned - first).mean(), 10, "the mouse rotates nothing")
        status = page.inner_text(".pointfront-status")
        self.assertRegex(status, r"^[0-9,]+ points, error [01]\.[0-9] px$")
        again = self.pixels(page)
        self.assertEqual(numpy.abs(again - turned).max(), 0, "a view at rest changes")

        near = self.settle(page, lambda: page.mouse.wheel(0, -600))
        empty = [(p.max(axis=2) < 40).mean() for p in (turned, near)]
        self.assertLess(empty[1], empty[0], "the wheel does not come closer")
        wide = self.settle(page, lambda: page.set_viewport_size({"width": 1000, "height": 640}))
        self.assertEqual(wide.shape, (560, 1000, 3))
        sizes = page.evaluate("[...document.images].map(i => [i.naturalWidth, i.naturalHeight])")
        self.assertIn([1000, 640], sizes, "the picture is not as large as the window")

        grey = self.settle(page, lambda: page.select_option("select >> nth=0", "intensity"))
        self.assertLess(numpy.ptp(grey, axis=2).mean(), 4, "another colour is not drawn")
        self.settle(page, lambda: page.click("text=top"))
        self.assertEqual(self.errors, [])

        maps = [pathlib.Path(f"/proc/{pid}/maps").read_text()
                for pid in (server.process.pid, *server.tools())]
        self.assertEqual(len(maps), 2)
        for text in maps:
            self.assertNotIn("libX11", text)
            self.assertNotIn("libGL", text)
        tool = server.tools()[0]
        self.assertEqual(server.end(), 130)
        self.assertFalse(pathlib.Path(f"/proc/{tool}").exists(), "the tool is still there")

    def test_a_notebook_has_the_view_in_its_cell(self):
        from pointfront._page import NotebookView

        view = NotebookView([str(self.store)], height=400)
        self.addCleanup(view.close)
        page = self.browser.new_page(viewport={"width": 800, "height": 500})
        self.addCleanup(page.close)
        with tempfile.NamedTemporaryFile("w", suffix=".html", dir=self.temporary.name) as cell:
            cell.write(f"<html><body>{view._repr_html_()}</body></html>")
            cell.flush()
            page.goto(f"file://{cell.name}")
            frame = page.frame_locator("iframe")
            frame.locator(SETTLED).wait_for(state="attached", timeout=LIMIT_MS)
            self.assertGreater(self.pixels(page).std(), 20)

    def test_pages_of_others_are_refused(self):
        server = Server(self.store, "--port", "0")
        self.addCleanup(server.process.kill)
        own = server.url.split("/?")[0]
        for origin, status in ((f"http://{STRANGER}", 403), (own, 200)):
            request = urllib.request.Request(server.url, headers={"Origin": origin})
            try:
                with urllib.request.urlopen(request) as answer:
                    self.assertEqual(answer.status, status)
            except urllib.error.HTTPError as refused:
                self.assertEqual(refused.code, status)
        server.end()

    def test_who_has_not_the_secret_is_refused(self):
        server = Server(self.store, "--port", "0")
        self.addCleanup(server.process.kill)
        own, secret = server.url.split("/?secret=")
        self.assertGreater(len(secret), 30)
        other = Server(self.store, "--port", "0")
        self.addCleanup(other.process.kill)
        theirs = other.url.split("/?secret=")[1]
        other.end()
        self.assertNotEqual(secret, theirs)
        for query, status in ((f"?secret={secret}", 200), ("", 403), ("?secret=", 403),
                              ("?secret=wslink-secret", 403), (f"?secret={theirs}", 403),
                              ("?secret=%C3%A4", 403)):
            for page in ("/", "/index.html"):
                self.assertEqual(status_of(own + page + query), status, page + query)
        asked = urllib.request.Request(f"{own}/paraview/", data=b"{}")
        with urllib.request.urlopen(asked) as answer:
            self.assertNotIn("secret", json.loads(answer.read()))
        said = greet(own, "wslink-secret")
        self.assertIn("Authentication failed", str(said[0]))
        self.assertTrue(all("error" in answer for answer in said), said)
        self.assertTrue(all("result" in answer for answer in greet(own, secret)))
        server.end()

    def test_a_page_that_is_loaded_anew_has_its_view(self):
        server = Server(self.store, "--port", "0")
        self.addCleanup(server.process.kill)
        page = self.open(server.url)
        self.assertNotIn("secret", page.url)  # nobody who looks at the screen sees it
        page.reload()
        self.wait(page)
        self.assertGreater(self.pixels(page).std(axis=(0, 1)).min(), 20)
        self.assertEqual(self.errors, [])
        stranger = self.browser.new_context().new_page()
        self.addCleanup(stranger.close)
        self.assertEqual(stranger.goto(page.url).status, 403)
        server.end()

    def test_what_cannot_be_served_is_said(self):
        for arguments, status, says in ((["none.pfront"], 1, "none.pfront"),
                                        ([self.store, "--technique", "dust"], 1, "dust"),
                                        ([], 2, "STORE"), ([self.store, "--dust"], 2, "--dust")):
            run = subprocess.run([sys.executable, "-m", "pointfront", "serve", "--port", "0",
                                  *map(str, arguments)], capture_output=True, text=True,
                                 timeout=60, env=without_display())
            self.assertEqual(run.returncode, status, run.stderr)
            self.assertIn(says, run.stderr)


@unittest.skipUnless(LARGE.exists(), f"there is no {LARGE}")
class LargePage(InBrowser):
    """Of ten million points: what a user waits for. Limits leave room for a busy machine."""

    cloud = LARGE

    def turn(self, page, seconds):
        """Drags for that long; pictures a second."""
        before, begin = self.frames(page), time.monotonic()
        page.mouse.move(640, 360)
        page.mouse.down()
        step = 0
        while time.monotonic() - begin < seconds:
            step += 1
            page.mouse.move(640 + 4 * min(step % 200, 200 - step % 200), 360)
            time.sleep(0.015)
        rate = (self.frames(page) - before) / (time.monotonic() - begin)
        page.mouse.up()
        return rate

    def test_it_is_turned_and_refined_and_resized(self):
        server = Server(self.store, "--port", "0")
        self.addCleanup(server.process.kill)
        begin = time.monotonic()
        page = self.open(server.url, 1280, 720)
        opened = time.monotonic() - begin
        first = self.pixels(page)
        self.turn(page, 1.0)  # what is read only once
        rate = self.turn(page, 4.0)
        begin = time.monotonic()
        page.wait_for_function(f"document.querySelector('{SETTLED}') !== null", timeout=LIMIT_MS)
        rested = time.monotonic() - begin
        status = page.inner_text(".pointfront-status")
        self.assertRegex(status, r"^[0-9,]+ points, error [01]\.[0-9] px$")
        turned = self.pixels(page)
        self.assertGreater(numpy.abs(turned - first).mean(), 5, "the mouse rotates nothing")
        begin = time.monotonic()
        wide = self.settle(page, lambda: page.set_viewport_size({"width": 1600, "height": 900}))
        resized = time.monotonic() - begin
        self.assertEqual(wide.shape, (820, 1600, 3))
        begin = time.monotonic()
        page.mouse.wheel(0, -1200)
        near = wide  # frames of the resize may come late
        while numpy.abs(near - wide).mean() < 5 and time.monotonic() - begin < LIMIT_MS / 1000:
            self.wait(page)
            near = self.pixels(page)
        closer = time.monotonic() - begin
        self.assertGreater(numpy.abs(near - wide).mean(), 5, "the wheel does not come closer")
        self.assertEqual(self.errors, [])
        print(f"opened in {opened:.1f} s; {rate:.0f} pictures a second in motion; at rest, "
              f"{status}, after {rested:.1f} s; resized in {resized:.1f} s; "
              f"closer in {closer:.1f} s")
        self.assertGreater(rate, 3.0, "pictures a second in motion")
        for seconds in (opened, rested, resized, closer):
            self.assertLess(seconds, 15.0)
        server.end()


if __name__ == "__main__":
    unittest.main(verbosity=2)
