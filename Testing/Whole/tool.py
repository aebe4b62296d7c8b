"""The tool under test, and files for it.

Environment: POINTFRONT_TOOL the program, POINTFRONT_SHARED_DATA the folder of public clouds,
POINTFRONT_WORK a folder to write in, POINTFRONT_SLOWNESS how many times slower than a release
build this one may be (sanitizers).
"""

import json
import os
import pathlib
import resource
import shutil
import struct
import subprocess
import sys
import time
import unittest

TOOL = os.environ["POINTFRONT_TOOL"]
DATA = pathlib.Path(os.environ["POINTFRONT_SHARED_DATA"])
# One script may run twice at a time, with another back end.
WORK = (pathlib.Path(os.environ["POINTFRONT_WORK"]) /
        (pathlib.Path(sys.argv[0]).stem + os.environ.get("POINTFRONT_BACKEND", "")))
SLOWNESS = float(os.environ.get("POINTFRONT_SLOWNESS", "1"))
# For tests that measure bytes, shares or many pictures of code that other tests run, too: a
# sanitizer sees nothing else in them. (MEASURES of pointfront_discover_tests, for programs.)
measures = unittest.skipIf(SLOWNESS > 1, "a sanitizer sees nothing in what is measured")


class Outcome:
    """The end of one run of a program: its status and what it printed; the seconds that passed, and
    those of processors, which do not depend on what else the machine does (where the script runs
    one program at a time)."""

    def __init__(self, finished, seconds, processor_seconds):
        self.status = finished.returncode
        self.out = finished.stdout.decode()
        self.err = finished.stderr.decode()
        self.seconds = seconds
        self.processor_seconds = processor_seconds

    @property
    def json(self):
        return json.loads(self.out)

    def __repr__(self):
        return f"status {self.status}\nstdout: {self.out}\nstderr: {self.err}"


def spent_by_children():
    """Processor seconds of all programs that this one has waited for."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def run(program, *arguments, environment=None, limit=800):
    begin, before = time.monotonic(), spent_by_children()
    finished = subprocess.run(
        [str(program), *map(str, arguments)],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        env=environment,
        timeout=limit,
        check=False,
    )
    return Outcome(finished, time.monotonic() - begin, spent_by_children() - before)


def pointfront(*arguments, **options):
    return run(TOOL, *arguments, **options)


class ToolTest(unittest.TestCase):
    """A test with a fresh folder of its own."""

    def setUp(self):
        self.folder = WORK / self.id()
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def succeed(self, *arguments, **options):
        outcome = pointfront(*arguments, **options)
        self.assertEqual(outcome.status, 0, f"{arguments}: {outcome}")
        return outcome

    def refuse(self, status, *arguments, **options):
        """The run fails with that status and says why in one line that names the command."""
        outcome = pointfront(*arguments, **options)
        self.assertEqual(outcome.status, status, f"{arguments}: {outcome}")
        lines = outcome.err.splitlines()
        self.assertEqual(len(lines), 1, f"{arguments}: not one line on stderr: {outcome}")
        prefix = f"pointfront {arguments[0]}: " if arguments else "pointfront: "
        self.assertTrue(lines[0].startswith(prefix), outcome)
        self.assertGreater(len(lines[0]), len(prefix) + 10, outcome)
        return outcome

    def build(self, *inputs, name="cloud.pfront"):
        store = self.folder / name
        self.succeed("build", *inputs, "-o", store)
        return store

    def entries(self):
        return sorted(entry.name for entry in self.folder.iterdir())


class SharedStoreTest(ToolTest):
    """Tests of a class that only read one store, `store`: it is built once, in a folder of the
    class."""

    @classmethod
    def make_store(cls, folder):
        """The inputs and options of `build`; files in the folder stay while the class runs."""
        raise NotImplementedError

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        folder = WORK / f"of-{cls.__module__}.{cls.__name__}"
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        cls.addClassCleanup(shutil.rmtree, folder, ignore_errors=True)
        cls.store = folder / "cloud.pfront"
        made = pointfront("build", *cls.make_store(folder), "-o", cls.store)
        if made.status != 0:
            raise AssertionError(made)


def write_las(path, points, scale=0.01, centred=False):
    """A LAS 1.2 file of format 2; points are (x, y, z, red, green, blue), colours 0 to 65535.
    Integers count from the lowest coordinate, or from 2^31 steps above it."""
    low = [min(p[axis] for p in points) for axis in range(3)]
    high = [max(p[axis] for p in points) for axis in range(3)]
    header = struct.pack(
        "<4sHH16sBB32s32sHHHIIBHI5I12d",
        b"LASF", 0, 0, bytes(16), 1, 2, b"test", b"pointfront tests", 1, 2020, 227, 227, 0, 2, 26,
        len(points), len(points), 0, 0, 0, 0, scale, scale, scale,
        *((v + 2 ** 31 * scale for v in low) if centred else low),
        high[0], low[0], high[1], low[1], high[2], low[2],
    )
    with open(path, "wb") as file:
        file.write(header)
        for p in points:
            grid = [round((p[axis] - low[axis]) / scale) - (2 ** 31 if centred else 0)
                    for axis in range(3)]
            file.write(struct.pack("<3iHBBBBH3H", *grid, 0, 9, 1, 0, 0, 0, *p[3:6]))
    return path
