"""The page of `pointfront serve` and the view of a notebook in a real browser: Chromium, headless.

Neither has a display. Environment: POINTFRONT_CHROMIUM the browser, /usr/bin/chromium unless given;
POINTFRONT_SHARED_DATA the public clouds, of which a large one is shown.
"""

import asyncio
import io
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import numpy
import pointfront
from PIL import Image
from page_trial import CLOUD, LIMIT_MS, SETTLED, InBrowser, Server, without_display
from pointfront._remote import RemoteView

LARGE = (pathlib.Path(os.environ.get("POINTFRONT_SHARED_DATA", "none"))
         / "large/autzen_10653336_rgb_intensity.laz")


async def until(happened):
    """Waits for it, while the view goes on."""
    end = time.monotonic() + LIMIT_MS / 1000
    while not happened():
        if time.monotonic() > end:
            raise AssertionError("it does not happen")
        await asyncio.sleep(0.01)


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
            await until(lambda: told and told[-1].get("settled"))
            view.process_interaction_event({"type": "LeftButtonPress", "x": 300, "y": 200})
            for x in range(300, 360, 4):
                view.process_interaction_event({"type": "MouseMove", "x": x, "y": 200})
                view.schedule_render()
                pushed = len(sent)
                await until(lambda: len(sent) > pushed)
            view.process_interaction_event({"type": "LeftButtonRelease", "x": 360, "y": 200})
            await until(lambda: told[-1]["settled"] and not told[-1]["moving"])
            await until(lambda: sent[-1][0] > 80)
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
            await until(lambda: told and "nothing-of-that-name" in told[-1].get("problem", ""))
            view.draw_with([])
            await until(lambda: told[-1].get("settled"))
            before = len(told)
            for _ in range(600):  # as near as a wheel can bring it
                view.process_interaction_event(
                    {"type": "MouseWheel", "x": 160, "y": 90, "spinY": -1})
            view.schedule_render()
            await until(lambda: len(told) > before and told[-1].get("settled"))
            self.assertNotIn("problem", told[-1])
            await view.close()

        asyncio.run(err())


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

    def test_a_page_at_rest_sleeps(self):
        """Neither the server nor the tool does anything, and nothing is sent; for each page."""
        server = Server(self.store, "--port", "0")
        self.addCleanup(server.process.kill)
        page = self.open(server.url)
        self.settle(page, lambda: page.mouse.wheel(0, -300))
        self.assertGreater(len(self.messages), 5)
        time.sleep(1.0)  # the browser has taken all
        frames, messages = self.frames(page), len(self.messages)
        before = server.processor_seconds()
        page.wait_for_timeout(4000)  # in which its messages are counted, too
        self.assertLess(server.processor_seconds() - before, 0.02)
        self.assertEqual(self.frames(page), frames)
        self.assertEqual(self.messages[messages:], [])
        server.end()

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

    def test_clients_of_different_sizes_see_the_same_undistorted(self):
        server = Server(self.store, "--port", "0")
        self.addCleanup(server.process.kill)
        wide = self.open(server.url, 900, 400)
        errors = self.errors
        high = self.open(server.url, 400, 600)
        self.wait(wide)
        self.wait_for_size(high, [900, 400])
        self.assertEqual(self.size_of_picture(wide), [900, 400], "who came later takes the size")
        self.assertEqual(self.size_of_picture(high), [900, 400])
        picture = self.whole(high)
        self.assertLess(self.contrast(picture[50:200]), 3, "the picture is stretched")
        self.assertGreater(self.contrast(picture[250:350]), 10)
        before = self.whole(wide)
        self.settle(high, lambda: high.mouse.wheel(0, -300))  # who moves it has its size
        self.wait_for_size(high, [400, 600])
        self.assertGreater(self.contrast(self.whole(high)[100:180]), 10)
        self.wait_for_size(wide, [400, 600])
        after = self.whole(wide)
        self.assertLess(self.contrast(after[100:300, :250]), 3)
        self.assertGreater(numpy.abs(after - before).mean(), 5)
        high.close()
        self.wait_for_size(wide, [900, 400])
        self.assertEqual((errors, self.errors), ([], []))
        server.end()

    @staticmethod
    def contrast(pixels):
        return pixels.std(axis=(0, 1)).max()

    @staticmethod
    def size_of_picture(page):
        return page.evaluate("(([image]) => [image.naturalWidth, image.naturalHeight])"
                             "([...document.images].filter(i => i.naturalWidth > 1))")

    def wait_for_size(self, page, size):
        page.wait_for_function(
            f"[...document.images].some(i => i.naturalWidth == {size[0]} && "
            f"i.naturalHeight == {size[1]})", timeout=LIMIT_MS)
        self.wait(page)

    def whole(self, page):
        time.sleep(0.2)
        return numpy.asarray(Image.open(io.BytesIO(page.screenshot())).convert("RGB")).astype(int)

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

    def test_a_folder_of_stores_is_served(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("a.pfront", "b.pfront"):
                shutil.copyfile(self.store, pathlib.Path(folder) / name)
            server = Server(folder, "--port", "0")
            self.addCleanup(server.process.kill)
            page = self.open(server.url)
            grey = self.settle(page, lambda: page.select_option("select >> nth=0", "intensity"))
            self.assertGreater(grey.std(), 20)
            self.assertEqual(server.end(), 130)
            self.assertEqual(server.said, "")

    def test_a_first_look_is_told(self):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "a.laz").symlink_to(CLOUD)
            server = Server(folder, "--port", "0")
            self.addCleanup(server.process.kill)
            self.assertEqual(server.end(), 130)
            self.assertRegex(server.said, "warning: .*first look: 4 of 174151")

    def test_it_ends_when_it_is_told_twice(self):
        """As by `timeout`, which tells the process and its group; or by a user in a hurry."""
        random = numpy.random.default_rng(3)
        for _ in range(10):
            server = Server(self.store, "--port", "0")
            self.addCleanup(server.process.kill)
            tools = server.tools()
            time.sleep(random.uniform(0, 1))
            for number in random.choice([signal.SIGTERM, signal.SIGINT], 2):
                server.process.send_signal(number)
                time.sleep(random.uniform(0, 0.001))
            # The second may come when Python is as good as gone.
            ended = server.process.wait(LIMIT_MS / 1000)
            self.assertIn(ended, (130, -signal.SIGTERM, -signal.SIGINT))
            end = time.monotonic() + LIMIT_MS / 1000
            while any(pathlib.Path(f"/proc/{tool}").exists() for tool in tools):
                self.assertLess(time.monotonic(), end, "the tool is still there")
                time.sleep(0.01)
            server.process.stdout.close()
            server.process.stderr.close()

    def test_it_ends_with_its_terminal(self):
        server = Server(self.store, "--port", "0")
        self.addCleanup(server.process.kill)
        tools = server.tools()
        self.assertTrue(tools)
        self.assertEqual(server.end(signal.SIGHUP), 130)
        self.assertEqual(server.said, "")
        self.assertFalse([tool for tool in tools if pathlib.Path(f"/proc/{tool}").exists()])

    def test_it_outlives_its_terminal_under_nohup(self):
        before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
        self.addCleanup(signal.signal, signal.SIGHUP, before)
        server = Server(self.store, "--port", "0")
        self.addCleanup(server.process.kill)
        server.process.send_signal(signal.SIGHUP)
        with self.assertRaises(subprocess.TimeoutExpired):
            server.process.wait(1)
        self.assertEqual(server.end(), 130)

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
    """A user waits for ten million points. Limits leave room for a busy machine."""

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
        self.turn(page, 1.0)  # reads all that is read only once
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
        self.assertGreater(rate, 1.0, "pictures a second in motion")
        for seconds in (opened, rested, resized, closer):
            self.assertLess(seconds, 60.0)
        server.end()


if __name__ == "__main__":
    unittest.main(verbosity=2)
