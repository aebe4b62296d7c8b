"""Clouds by their address: points, pictures and files are those of the local file."""

import json
import multiprocessing
import os
import pathlib
import pickle
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import urllib.request

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "Testing/Support"))
# pylint: disable=wrong-import-position
from far_setting import HERE, LIMIT_SECONDS, SECRET
import numpy
import pointfront
from far_server import FarServer
from far_weather import TOKEN
from pointfront._host import TOOL
from pointfront._stream import FrameStream


class Addresses(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="pointfront-addresses-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.store = self.folder / "a.pfront"
        pointfront.build(ROOT / "Testing/Data/autzen_stadium.laz", self.store, preview=False)
        server = FarServer(self.folder)
        server.__enter__()
        self.addCleanup(server.__exit__)
        self.origin = f"http://{HERE}:{server.port}"

    def test_all_answers_are_those_of_the_file(self):
        near = pointfront.open(self.store)
        for address in (f"{self.origin}/a.pfront", f"{self.origin}/a.pfront?{SECRET}"):
            far = pointfront.open(address)
            self.assertNotIn("VERY-SECRET", far.path + repr(far) + far._repr_html_())
            self.assertEqual(far.bounds, near.bounds)
            self.assertEqual(far.info["points"], len(near))
            expected, points = near.points(), far.points()
            self.assertEqual(points.keys(), expected.keys())
            for array in expected:
                numpy.testing.assert_array_equal(points[array], expected[array])
            pictures = [cloud.screenshot(size=(160, 120)).pixels for cloud in (near, far)]
            self.assertTrue((pictures[0] == pictures[1]).all())
            files = [self.folder / "near.las", self.folder / "far.las"]
            for cloud, file in zip((near, far), files):
                cloud.export(file, overwrite=True)
            self.assertEqual(files[0].read_bytes(), files[1].read_bytes())
            pickled = pickle.dumps(far)
            self.assertNotIn(b"VERY-SECRET", pickled)
            self.assertEqual(len(pickle.loads(pickled)), len(near))

    def test_tools_are_told_secrets_by_nothing_that_others_see(self):
        far = pointfront.open(f"{self.origin}/~bearer/a.pfront?{SECRET}", token=TOKEN)
        stream = FrameStream([far.path])
        self.addCleanup(stream.close)
        words = pathlib.Path(f"/proc/{stream._tool.pid}/cmdline").read_text()
        self.assertIn("/~bearer/a.pfront", words)
        for secret in ("VERY-SECRET", TOKEN):
            self.assertNotIn(secret, words)
        while not stream.frame(size=(64, 48), wait_ms=100).settled:
            pass
        self.assertEqual(far.info["points"], len(far))
        self.assertEqual(far.screenshot(size=(64, 48)).pixels.shape, (48, 64, 3))
        with urllib.request.urlopen(f"{self.origin}/~log") as log:
            asked = [one["path"] for one in json.load(log)["requests"]]
        self.assertTrue(asked and all(path.endswith(SECRET) for path in asked))

    def test_a_page_is_served_by_nothing_that_others_see(self):
        """By Python and by the tool, which starts it; with a trame that waits when it is loaded."""
        (self.folder / "trame").mkdir()
        (self.folder / "trame/__init__.py").write_text(
            "import time\nprint('loaded', flush=True)\ntime.sleep(60)\n")
        address = f"{self.origin}/~bearer/a.pfront?{SECRET}"
        there = {**os.environ, "POINTFRONT_PYTHON": sys.executable, "POINTFRONT_FAR":
                 f"[{self.origin}]\nAuthorization: Bearer {TOKEN}", "PYTHONPATH":
                 f"{self.folder}{os.pathsep}{os.environ.get('PYTHONPATH', '')}"}
        for command in ([sys.executable, "-m", "pointfront"], [TOOL]):
            page = subprocess.Popen([*command, "serve", "--port", "0", address],
                                    stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=there)
            self.addCleanup(page.wait)
            self.addCleanup(page.kill)
            with page.stdout, page.stderr:
                self.assertEqual(page.stdout.readline(), b"loaded\n", page.poll())
                words = pathlib.Path(f"/proc/{page.pid}/cmdline").read_text()
                told = pathlib.Path(f"/proc/{page.pid}/environ").read_text()
                page.kill()
            self.assertIn("/~bearer/a.pfront?~", words)
            self.assertIn("serve\0--port\x000\0", words)
            for secret in ("VERY-SECRET", TOKEN):
                self.assertNotIn(secret, words)
                self.assertIn(secret, told)
            # Others find it by the same words and environment, as the tool that draws does.
            variable = next(one for one in told.split("\0") if one.startswith("POINTFRONT_FAR="))
            given = next(word for word in words.split("\0") if "://" in word)
            info = subprocess.run(
                [sys.executable, "-c", "import pointfront, sys\nc = pointfront.open(sys.argv[1])\n"
                 "print(c.info['points'], len(c.points()['id']), c.screenshot(size=(9, 9)))",
                 given],
                stdout=subprocess.PIPE, check=True,
                env={**os.environ, "POINTFRONT_FAR": variable.split("=", 1)[1]})
            self.assertRegex(info.stdout, b"^174151 174151 <Picture 9x9")

    def test_a_spawned_child_opens_it_by_what_its_parent_knows(self):
        cloud = pointfront.open(f"{self.origin}/~bearer/a.pfront?{SECRET}", token=TOKEN)
        child = multiprocessing.get_context("spawn").Process(target=len, args=(cloud,))
        child.start()
        child.join(60)
        self.assertEqual(child.exitcode, 0)

    def test_headers_are_those_of_their_server(self):
        address = f"{self.origin}/~bearer/a.pfront"
        with self.assertRaisesRegex(pointfront.PointFrontError, "401"):
            pointfront.open(address + "?1", token="another")
        cloud = pointfront.open(address + "?2", headers={"Authorization": "Bearer " + TOKEN})
        self.assertEqual(len(cloud.points()["position"]), len(cloud))
        for wrong in ({"X": "a\nY: b"}, {"a b": "c"}):
            with self.assertRaises(pointfront.PointFrontError):
                pointfront.open(address, headers=wrong)
        with self.assertRaisesRegex(pointfront.PointFrontError, "addresses"):
            pointfront.open(self.store, token=TOKEN)

    def test_a_mark_that_nobody_knows(self):
        with self.assertRaisesRegex(pointfront.PointFrontError, "whole address"):
            pointfront.open(f"{self.origin}/a.pfront?~0123456789abcdef")

    def test_an_interrupt_ends_the_wait_for_a_silent_server(self):
        with socket.create_server((HERE, 0)) as silent:
            silent.settimeout(120)
            seconds = []

            def interrupt():
                with silent.accept()[0] as connection:
                    connection.recv(65536)
                    seconds.append(time.monotonic())
                    os.kill(os.getpid(), signal.SIGINT)
                    ended.wait(120)

            ended = threading.Event()
            thread = threading.Thread(target=interrupt)
            thread.start()
            with self.assertRaises(KeyboardInterrupt):
                pointfront.open(f"http://{HERE}:{silent.getsockname()[1]}/a.pfront")
            seconds.append(time.monotonic())
            ended.set()
            thread.join()
        self.assertLess(seconds[1] - seconds[0], LIMIT_SECONDS / 2)  # it does not wait for that

    def test_errors_are_raised_without_secrets(self):
        for weather, words in (("~forbidden/", "403"), ("none/", "404"), ("~gzipped/", "compress")):
            with self.assertRaisesRegex(pointfront.PointFrontError, words) as raised:
                pointfront.open(f"{self.origin}/{weather}a.pfront?{SECRET}")
            self.assertNotIn("VERY-SECRET", str(raised.exception))


if __name__ == "__main__":
    unittest.main()
