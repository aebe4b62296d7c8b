"""Clouds by their address: points, pictures and files are those of the local file."""

import _thread
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
import unittest.mock
import urllib.request

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "Testing/Support"))
# pylint: disable=wrong-import-position
from far_setting import HERE, SECRET

# Longer than a machine that does other things stands still.
LIMIT_SECONDS = 120
os.environ["POINTFRONT_REMOTE_TIMEOUT"] = str(LIMIT_SECONDS)
import numpy
import pointfront
from far_server import FarServer
from far_weather import TOKEN
from pointfront import _kernel
from pointfront._host import TOOL
from pointfront._stream import FrameStream


def command_line(process):
    """Its words, each with a 0 behind it. A program that has just begun has none for a moment."""
    while not (words := pathlib.Path(f"/proc/{process}/cmdline").read_text()):
        time.sleep(0.01)
    return words


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

    def test_a_part_is_built(self):
        part = self.folder / "part.pfront"
        low, high = pointfront.open(self.store).bounds
        box = (low, [low[0] + 0.2 * (high[0] - low[0]), *high[1:]])
        expected = pointfront.open(self.store).points(box=box)
        reports = []
        for cloud, options in ((self.store, {}), (f"{self.origin}/a.pfront", {}),
                               (pointfront.open(self.store).points(), {"precision": 0.01})):
            report = pointfront.build(cloud, part, box=box, overwrite=True, preview=False,
                                      **options)
            reports.append(report)
            points = pointfront.open(part).points()
            self.assertEqual(report.points_stored, len(expected["position"]))
            self.assertEqual(report.points_rejected, 0)
            for name in ("position", "intensity"):
                numpy.testing.assert_allclose(numpy.sort(points[name], axis=0),
                                              numpy.sort(expected[name], axis=0), rtol=0,
                                              atol=1e-9 if options else 0)  # another grid
        self.assertEqual(reports[0].points_outside, reports[1].points_outside)
        self.assertEqual(reports[2].points_outside,
                         len(pointfront.open(self.store)) - reports[2].points_stored)
        with self.assertRaisesRegex(pointfront.PointFrontError, "no point of the inputs lies in"):
            pointfront.build(self.store, part, box=(0, 0, 0, 1, 1, 1), overwrite=True)
        with self.assertRaisesRegex(ValueError, "six numbers"):
            pointfront.build(self.store, part, box=(1, 2), overwrite=True)

    def test_what_came_from_servers_is_told(self):
        before = pointfront.traffic()
        self.assertEqual(set(before), {"requests", "bytes_fetched", "retries", "cache_hits",
                                       "cache_bytes"})
        pointfront.open(self.store).points()
        self.assertEqual(pointfront.traffic(), before)
        far = pointfront.open(f"{self.origin}/a.pfront")
        opened = pointfront.traffic()
        self.assertGreater(opened["requests"], before["requests"])
        far.points()
        self.assertGreater(pointfront.traffic()["bytes_fetched"],
                           opened["bytes_fetched"] + self.store.stat().st_size / 4)

    def asked(self):
        with urllib.request.urlopen(f"{self.origin}/~log") as log:
            return len(json.load(log)["requests"])

    def test_an_opening_has_settings_of_its_own(self):
        cache = self.folder / "a cache"
        address = f"{self.origin}/a.pfront"
        with self.assertRaisesRegex(pointfront.PointFrontError, "not in the cache"):
            pointfront.open(address, cache=cache, offline=True)
        far = pointfront.open(address, cache=cache, cache_size="1G", timeout=100)
        points = far.points()
        asked = self.asked()
        away = pointfront.open(address, cache=cache, offline=True)
        numpy.testing.assert_array_equal(away.points()["position"], points["position"])
        self.assertEqual(away.screenshot(size=(64, 48)).pixels.shape, (48, 64, 3))
        self.assertEqual(away.info["points"], len(far))
        again = pickle.loads(pickle.dumps(away))
        self.assertEqual(len(again), len(far))
        self.assertEqual(self.asked(), asked)
        shutil.rmtree(cache)
        pointfront.open(address, cache=False).points()
        self.assertFalse(cache.exists())
        self.assertGreater(self.asked(), asked)

    def test_settings_that_cannot_be_had_say_so(self):
        address = f"{self.origin}/a.pfront"
        for settings, words in (({"timeout": 0}, "seconds above 0"),
                                ({"timeout": "soon"}, "seconds above 0"),
                                ({"cache_size": "much"}, "no size of a cache"),
                                ({"cache": self.store}, "no folder"),
                                ({"cache": False, "offline": True}, "cache is off")):
            with self.assertRaisesRegex(pointfront.PointFrontError, words):
                pointfront.open(address, **settings)
        with self.assertRaisesRegex(pointfront.PointFrontError, "are for addresses"):
            pointfront.open(self.store, offline=True)
        with socket.create_server((HERE, 0)) as silent:
            begin = time.monotonic()
            with self.assertRaisesRegex(pointfront.PointFrontError, "cannot be read"):
                pointfront.open(f"http://{HERE}:{silent.getsockname()[1]}/a.pfront", timeout=0.3)
            self.assertLess(time.monotonic() - begin, LIMIT_SECONDS)

    def test_tools_are_told_secrets_by_nothing_that_others_see(self):
        far = pointfront.open(f"{self.origin}/~bearer/a.pfront?{SECRET}", token=TOKEN)
        stream = FrameStream([far.path])
        self.addCleanup(stream.close)
        words = command_line(stream._tool.pid)
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
            f"import time\nprint('loaded', flush=True)\ntime.sleep({LIMIT_SECONDS})\n")
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
                words = command_line(page.pid)
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

    def collection(self):
        """A collection of two epochs; how many points the second has."""
        city, half = self.folder / "e.pfcollection", self.folder / "half.pfront"
        low, high = pointfront.open(self.store).bounds
        pointfront.build(self.store, half, preview=False,
                         box=(low, [(low[0] + high[0]) / 2, *high[1:]]))
        for verb, tile, epoch in (("create", self.store, "2019"), ("add", half, "2021")):
            subprocess.run([TOOL, "collection", verb, city, tile, "--epoch", epoch], check=True,
                           stdout=subprocess.DEVNULL)
        return city, len(pointfront.open(half))

    def test_a_collection_is_opened_at_an_epoch(self):
        """By its path, which may be relative, and by its address with settings and secrets."""
        city, points = self.collection()
        here = os.getcwd()
        self.addCleanup(os.chdir, here)
        os.chdir(self.folder)
        far = f"{self.origin}/e.pfcollection"
        picture = None
        for name, settings in ((f"{city}#epoch=2021", {}), ("e.pfcollection#epoch=2021", {}),
                               (city.with_name(city.name + "#epoch=2021"), {}),
                               (f"{far}#epoch=2021", {}), (f"{far}#epoch=2021", {"timeout": 99}),
                               (f"{far}#epoch=2021", {"cache": False}),
                               (f"{far}?{SECRET}#epoch=2021", {}),
                               (f"{far}?{SECRET}#epoch=2021", {"cache_size": "1M"})):
            with self.subTest(name=name, **settings):
                cloud = pointfront.open(name, **settings)
                self.assertTrue(cloud.path.endswith("#epoch=2021"), cloud.path)
                self.assertEqual(len(cloud.points(attributes=[])["id"]), points)
                self.assertEqual(cloud.info["points"], points)
                pixels = cloud.screenshot(size=(64, 48)).pixels
                picture = pixels if picture is None else picture
                self.assertTrue((pixels == picture).all())
                cloud.export("half.las", overwrite=True)
                self.assertEqual(len(pickle.loads(pickle.dumps(cloud))), points)
        for name in (f"{city}#epoch=2020", f"{far}#epoch=2020"):
            with self.assertRaisesRegex(pointfront.PointFrontError, "2020.*it has: 2019, 2021"):
                pointfront.open(name)
        with self.assertRaisesRegex(pointfront.PointFrontError, "is no collection"):
            pointfront.open(f"{self.store}#epoch=2021")
        self.assertEqual(pointfront.build(f"{city}#epoch=2021", "b.pfront", preview=False
                                          ).points_stored, points)

    def test_a_spawned_child_opens_it_by_what_its_parent_knows(self):
        cloud = pointfront.open(f"{self.origin}/~bearer/a.pfront?{SECRET}", token=TOKEN)
        child = multiprocessing.get_context("spawn").Process(target=len, args=(cloud,))
        child.start()
        child.join(LIMIT_SECONDS)
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
            silent.settimeout(2 * LIMIT_SECONDS)
            seconds = []

            def interrupt():
                with silent.accept()[0] as connection:
                    connection.recv(65536)
                    seconds.append(time.monotonic())
                    os.kill(os.getpid(), signal.SIGINT)
                    ended.wait(2 * LIMIT_SECONDS)

            ended = threading.Event()
            thread = threading.Thread(target=interrupt)
            thread.start()
            with self.assertRaises(KeyboardInterrupt):
                pointfront.open(f"http://{HERE}:{silent.getsockname()[1]}/a.pfront")
            seconds.append(time.monotonic())
            ended.set()
            thread.join()
        self.assertLess(seconds[1] - seconds[0], LIMIT_SECONDS / 2)  # it does not wait for that

    def test_an_interrupt_while_a_thread_starts_ends_its_work(self):
        """Signals come anywhere: here the work has begun, and its starter does not know it yet."""
        begun, over = threading.Event(), threading.Event()
        start = _thread.start_new_thread

        def work(report):
            begun.set()
            while report(b"", 0.0):
                time.sleep(0.01)
            over.set()

        def interrupted(function, arguments):
            start(function, arguments)
            begun.wait()
            raise KeyboardInterrupt

        with unittest.mock.patch("_thread.start_new_thread", interrupted):
            with self.assertRaises(KeyboardInterrupt):
                _kernel.call(work, None, "stopped")
        self.assertTrue(over.wait(LIMIT_SECONDS))

    def test_an_interrupt_before_a_thread_starts_keeps_it_from_its_work(self):
        """Its thread gets its turn when nobody waits for it any more."""
        over = threading.Event()
        start = _thread.start_new_thread
        work = unittest.mock.Mock()

        def late(function, arguments):
            def run():
                time.sleep(0.1)
                function(*arguments)
                over.set()

            start(run, ())
            raise KeyboardInterrupt

        with unittest.mock.patch("_thread.start_new_thread", late):
            with self.assertRaises(KeyboardInterrupt):
                _kernel.call(work, None, "stopped")
        self.assertTrue(over.wait(LIMIT_SECONDS))
        work.assert_not_called()

    def test_errors_are_raised_without_secrets(self):
        for weather, words in (("~forbidden/", "403"), ("none/", "404"), ("~gzipped/", "compress")):
            with self.assertRaisesRegex(pointfront.PointFrontError, words) as raised:
                pointfront.open(f"{self.origin}/{weather}a.pfront?{SECRET}")
            self.assertNotIn("VERY-SECRET", str(raised.exception))


if __name__ == "__main__":
    unittest.main()
