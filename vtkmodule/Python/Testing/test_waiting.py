"""A user waits: for a window until it is closed, with a bar, with Ctrl-C; memory of arrays."""

import os
import pathlib
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy
import pointfront

DATA = pathlib.Path(os.environ["POINTFRONT_SHARED_DATA"])
LARGE = DATA / "large/autzen_10653336_rgb_intensity.laz"  # seconds of work
LIMIT_SECONDS = 300.0  # ends a test that hangs


class VirtualDisplay:
    """An X server of the test's own, whose pixels are in a file."""

    def __init__(self, folder):
        self._file = pathlib.Path(folder) / "Xvfb_screen0"
        read, write = os.pipe()
        self._server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", "640x480x24", "-fbdir", folder,
             "-nolisten", "tcp", "-noreset"], pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as number:
            self.name = ":" + number.readline().strip()

    def pixels(self):
        """480 by 640 by 3. The file is an X window dump."""
        data = self._file.read_bytes()
        header, width, height, line, colours = (
            struct.unpack_from(">I", data, 4 * i)[0] for i in (0, 4, 5, 12, 19))
        rows = numpy.frombuffer(data, numpy.uint8, line * height, header + 12 * colours)
        return rows.reshape(height, line)[:, :4 * width].reshape(height, width, 4)[:, :, :3]

    def close(self):
        self._server.terminate()
        self._server.wait()


class Waiting(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="pointfront-waiting-")
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.store = os.path.join(cls.folder, "a.pfront")
        pointfront.build(LARGE, cls.store, preview=False)

    @unittest.skipUnless(shutil.which("Xvfb"), "there is no Xvfb")
    def test_a_window_shows_the_cloud_until_it_is_interrupted(self):
        display = VirtualDisplay(self.folder)
        self.addCleanup(display.close)
        code = ("import sys, pointfront\n"
                "try:\n"
                "    pointfront.open(sys.argv[1]).show(size=(400, 300))\n"
                "except KeyboardInterrupt:\n"
                "    sys.exit(17)\n")
        user = subprocess.Popen([sys.executable, "-c", code, self.store], stderr=subprocess.PIPE,
                                env={**os.environ, "DISPLAY": display.name,
                                     "LIBGL_ALWAYS_SOFTWARE": "1"})
        self.addCleanup(user.stderr.close)
        self.addCleanup(user.kill)
        end = time.monotonic() + LIMIT_SECONDS
        shown = 0.0
        while shown < 0.05 and time.monotonic() < end and user.poll() is None:
            time.sleep(0.2)
            shown = (display.pixels().max(axis=2) > 60).mean()
        self.assertIsNone(user.poll(), user.stderr.read() if user.poll() is not None else "")
        self.assertGreater(shown, 0.05, "no cloud is in the window")
        user.send_signal(signal.SIGINT)
        self.assertEqual(user.wait(10), 17)

    def test_a_bar_is_drawn(self):
        code = ("import sys, pointfront\n"
                "pointfront.open(sys.argv[1]).points(attributes=['rgb'], progress=True)\n")
        run = subprocess.run([sys.executable, "-c", code, self.store], capture_output=True,
                             text=True, timeout=LIMIT_SECONDS)
        try:
            import tqdm
        except ImportError:
            self.assertIn("pip install tqdm", run.stderr)
            return
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("100%", run.stderr)
        self.assertIn("reading", run.stderr)

    def test_a_callable_sees_a_query_grow(self):
        seen = []
        with pointfront.open(self.store) as cloud:
            cloud.points(attributes=["rgb"], progress=lambda phase, part: seen.append(part))
        self.assertEqual(seen, sorted(seen))
        self.assertEqual(seen[-1], 1.0)
        self.assertGreater(len(set(seen)), 3)

    def test_an_interrupt_stops_a_query(self):
        began = threading.Event()

        def interrupt():
            began.wait(LIMIT_SECONDS)
            time.sleep(0.02)
            os.kill(os.getpid(), signal.SIGINT)

        with pointfront.open(self.store) as cloud:
            seen = []
            thread = threading.Thread(target=interrupt)
            thread.start()

            def watch(_phase, part):
                seen.append(part)
                began.set()

            with self.assertRaises(KeyboardInterrupt):
                cloud.points(progress=watch)
            thread.join()
            # VTK reports the end of an update that was stopped, too.
            self.assertLess(max(part for part in seen if part < 1.0), 0.75)
            self.assertEqual(len(cloud.points(classes=2, attributes=[])["id"]),
                             len(cloud.points(where="classification == 2", attributes=[])["id"]))

    def interrupted(self, work, after):
        """Interrupts this process alone after so many seconds; how many the work went on then."""
        signal.signal(signal.SIGINT, signal.default_int_handler)
        began, sent = [], []

        def interrupt():
            while not began:  # an Event would be a lock that the interrupt may strike
                time.sleep(0.0005)
            time.sleep(after)
            sent.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)

        thread = threading.Thread(target=interrupt)
        thread.start()
        try:
            with self.assertRaises(KeyboardInterrupt):
                began.append(True)
                work()
        finally:
            ended = time.monotonic()
            thread.join()
        return ended - sent[0]

    def assert_nothing_is_left(self, folder):
        self.assertEqual(list(folder.iterdir()), [])
        with self.assertRaises(ChildProcessError, msg="a tool runs on"):
            os.waitpid(-1, os.WNOHANG)

    def test_an_interrupt_stops_a_file_and_a_picture(self):
        """At once, wherever it strikes: no file and no process stays behind."""
        made = pathlib.Path(self.folder) / "made"
        made.mkdir()
        with pointfront.open(self.store) as cloud:
            for work in (lambda: cloud.export(made / "a.laz"),
                         lambda: cloud.screenshot(made / "a.png", error=0.1)):
                seconds = []
                for after in (*numpy.linspace(0.0, 0.004, 20), 0.01, 0.03, 0.1):
                    seconds.append(self.interrupted(work, after))
                    self.assert_nothing_is_left(made)
                self.assertLess(min(seconds), 0.2)  # a machine may be busy

    def test_points_are_in_memory_once(self):
        code = ("import resource, sys, pointfront\n"
                "cloud = pointfront.open(sys.argv[1])\n"
                "cloud.points(where='intensity > 65000')\n"
                "before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss\n"
                "arrays = cloud.points(attributes=['rgb', 'intensity', 'classification'])\n"
                "more = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before\n"
                "print(1024 * more, sum(array.nbytes for array in arrays.values()))\n")
        run = subprocess.run([sys.executable, "-c", code, self.store], capture_output=True,
                             text=True, check=True, timeout=LIMIT_SECONDS)
        more, arrays = map(int, run.stdout.split())
        self.assertGreater(arrays, 400e6)
        self.assertLess(more, 1.25 * arrays)


if __name__ == "__main__":
    unittest.main(verbosity=2)
