"""`python3 -m pointfront cluster build`: the bytes of `build --tiles`, by workers that may die."""

import argparse
import contextlib
import hashlib
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import psutil

from pointfront import _cluster, _steps
from pointfront._host import TOOL

OPTIONS = ("--tile", "30", "--normals", "pca", "--height-above-ground", "--progress", "none")
HERE = "127.0.0.1"
COMMAND = (sys.executable, "-B", "-m", "pointfront", "cluster", "build")


def tree(folder):
    files = [*(folder / "tiles").iterdir(), *folder.glob("*.pfcollection")]
    return {file.suffix + file.name * (file.suffix == ".pfront"):
            hashlib.sha256(file.read_bytes()).hexdigest() for file in files}


def running(folder):
    """Processes of the tool that work for a folder."""
    found = []
    for process in psutil.process_iter():
        with contextlib.suppress(psutil.Error):
            words = process.cmdline()
            if str(folder) in words and "--only" in words and words[0] == str(TOOL):
                found.append(process)
    return found


def workers_of(process):
    """Workers that a command has begun and that still run. Its steps come and go meanwhile: one
    that ends while it is looked at hides no worker."""
    found = []
    with contextlib.suppress(psutil.Error):
        for child in psutil.Process(process.pid).children(recursive=True):
            with contextlib.suppress(psutil.Error):
                if "spawn_main" in " ".join(child.cmdline()):
                    found.append(child)
    return found


class Cluster(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = tempfile.TemporaryDirectory()
        cls.root = pathlib.Path(cls.place.name).resolve()
        cls.inputs = cls.root / "inputs"
        cls.inputs.mkdir()
        whole, store = cls.root / "whole.las", cls.root / "whole.pfront"
        cls.tool("generate", "--points", "60000", "-o", whole, "--seed", "3")
        cls.tool("build", whole, "-o", store, "--progress", "none")
        west, south, _, east, north, _ = json.loads(cls.tool("info", store, "--json"))["bounds"]
        middle = 0.4 * west + 0.6 * east
        for name, low, high in (("west", west - 1, middle), ("east", middle + 0.0005, east + 1)):
            cls.tool("export", store, "-o", cls.inputs / f"{name}.las", "--box",
                     f"{low},{south - 1},-1000,{high},{north + 1},1000")
        cls.report = json.loads(cls.tool("build", cls.inputs, "-o", cls.root / "usual/land",
                                         "--tiles", *OPTIONS, "--json"))
        cls.expected = tree(cls.root / "usual/land")

    @classmethod
    def tearDownClass(cls):
        cls.place.cleanup()

    @staticmethod
    def tool(*arguments):
        return subprocess.run([str(TOOL), *map(str, arguments)], check=True, capture_output=True,
                              text=True).stdout

    def setUp(self):
        self.land = self.root / self.id().rsplit(".", maxsplit=1)[-1] / "land"

    def words(self, *more):
        return [*COMMAND, str(self.inputs), "-o", str(self.land), *OPTIONS, *more]

    def build(self, *more, status=0):
        done = subprocess.run(self.words(*more), capture_output=True, text=True, check=False,
                              timeout=240)
        self.assertEqual(done.returncode, status, done.stderr)
        return done

    def begun(self, *more, tiles=2):
        """A build that is under way: some tiles are done."""
        process = subprocess.Popen(self.words(*more), stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True)
        end = time.monotonic() + 120
        while len(list((self.land / "work").glob("tile-*.json"))) < tiles:
            self.assertIsNone(process.poll(), process.returncode)
            self.assertLess(time.monotonic(), end)
            time.sleep(0.02)
        return process

    def test_two_workers_give_the_bytes_of_one_process(self):
        told = json.loads(self.build("--local", "2", "--json").stdout)
        self.assertEqual(tree(self.land), self.expected)
        for key in ("points_read", "points_stored", "points_rejected", "tiles"):
            self.assertEqual(told[key], self.report[key])
        logs = list((self.land / "work/logs").iterdir())
        self.assertEqual(len(logs), 2 + told["tiles"])
        self.assertIn("status 0", logs[0].read_text())
        self.assertIn("points in", self.build("--local", "1").stdout)  # all is done
        again = json.loads(self.tool("build", self.inputs, "-o", self.land, "--tiles", *OPTIONS,
                                     "--json"))
        self.assertEqual(again["tiles_built"], 0)

    def test_workers_of_a_scheduler(self):
        processes, address = self.scheduler()
        self.build("--scheduler", address, "--threads", "1")
        self.assertEqual(tree(self.land), self.expected)
        self.end(processes)
        gone = self.patched("_cluster.CONNECT = 2", address)
        self.assertEqual(gone.wait(60), 1)
        said = gone.stderr.read()
        self.assertTrue(said.startswith("pointfront cluster build: "), said)
        self.assertIn(address, said)
        gone.stderr.close()

    def scheduler(self, port=0, workers=2, bare=()):
        """A scheduler and workers, each a process of its own, as a cluster has them: the processes
        and the scheduler's address. Those named in `bare` do not find PointFront."""
        place = self.root / f"scheduler-{time.monotonic_ns()}.json"
        run = (sys.executable, "-B", "-m")
        without = {name: text for name, text in os.environ.items() if name != "PYTHONPATH"}
        processes = [subprocess.Popen(
            [*run, "distributed.cli.dask_scheduler", "--host", HERE, "--port", str(port),
             "--no-dashboard", "--no-show", "--scheduler-file", str(place)],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            env=without if "scheduler" in bare else None)]
        self.addCleanup(self.end, processes)
        end = time.monotonic() + 60
        while not place.exists() or not place.stat().st_size:  # it is made, and then written
            self.assertIsNone(processes[0].poll())
            self.assertLess(time.monotonic(), end)
            time.sleep(0.05)
        address = json.loads(place.read_text())["address"]
        for _ in range(workers):
            processes.append(self.worker(address, without if "workers" in bare else None))
        return processes, address

    def worker(self, address, environment=None):
        return subprocess.Popen(
            [sys.executable, "-B", "-m", "distributed.cli.dask_worker", address, "--host", HERE,
             "--no-dashboard", "--nthreads", "1", "--memory-limit", "0", "--death-timeout", "60",
             "--local-directory", str(self.root)],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=environment,
            cwd=self.root)

    @staticmethod
    def end(processes):
        for process in processes:
            with contextlib.suppress(psutil.Error):
                for child in psutil.Process(process.pid).children(recursive=True):
                    with contextlib.suppress(psutil.Error):
                        child.kill()
            process.kill()
            process.wait()

    def test_workers_without_this_package_are_told(self):
        """The scheduler needs none."""
        _, address = self.scheduler(workers=1, bare=("scheduler", "workers"))
        said = self.build("--scheduler", address, "--threads", "1", status=1).stderr
        self.assertIn("cannot import PointFront (No module named 'pointfront'): each worker needs",
                      said)
        self.assertEqual(len(said.splitlines()), 1, said)
        _, address = self.scheduler(workers=1, bare=("scheduler",))
        self.build("--scheduler", address, "--threads", "1")
        self.assertEqual(tree(self.land), self.expected)

    def test_workers_of_another_version_are_told(self):
        _, address = self.scheduler(workers=1)
        said = self.patched("_cluster.__version__ = '9.9.9'", address)
        self.assertEqual(said.wait(120), 1)
        self.assertIn("and this is 9.9.9: each worker needs this PointFront", said.stderr.read())
        said.stderr.close()

    def patched(self, change, address, options=OPTIONS):
        """A build by a scheduler's workers, with something of the command changed."""
        begin = f"from pointfront import _cluster; {change}; import sys; "
        return subprocess.Popen(
            [sys.executable, "-B", "-c", begin + "sys.exit(_cluster.main(sys.argv[1:]))", "build",
             str(self.inputs), "-o", str(self.land), *options, "--threads", "1", "--scheduler",
             address], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def test_a_scheduler_without_workers_is_told(self):
        processes, address = self.scheduler(workers=0)
        process = self.patched("_cluster._Lookout.AFTER = 0.5", address)
        said = process.stderr.readline()
        self.assertEqual(said, f"pointfront cluster build: {address} has no worker: waits for one. "
                         "Are its jobs queued, or has their time ended?\n")
        processes.append(self.worker(address))
        self.assertIn("has workers again: goes on", process.stderr.readline())
        self.assertEqual(process.wait(120), 0)
        process.stderr.close()
        self.assertEqual(tree(self.land), self.expected)

    def test_a_step_whose_workers_die_again_and_again(self):
        """More often than a scheduler that was started elsewhere puts up with: three times."""
        options = ("--tile", "1000", *OPTIONS[2:])  # one tile
        usual = self.root / "one/land"
        self.tool("build", self.inputs, "-o", usual, "--tiles", *options)
        _, address = self.scheduler(workers=1)
        process = self.patched("pass", address, options)
        killed = 0
        while process.poll() is None and killed < 5:
            for step in running(self.land):
                with contextlib.suppress(psutil.Error):
                    if any(word.startswith("tile:") for word in step.cmdline()):
                        step.parent().kill()
                        killed += 1
                        # Dead, if not yet reaped: the next try may be over when somebody does it.
                        while step.status() != psutil.STATUS_ZOMBIE:
                            time.sleep(0.005)
            time.sleep(0.005)
        self.assertEqual(process.wait(180), 0, process.stderr.read())
        process.stderr.close()
        self.assertEqual(killed, 5)
        self.assertEqual(tree(self.land), tree(usual))

    def done(self):
        """The tiles that are done, by what they are: nobody writes them again without a trace."""
        found = {}
        for record in (self.land / "work").glob("tile-*.json"):
            store = self.land / "tiles" / json.loads(record.read_text())["file"]
            for file in (record, store):
                status = file.stat()
                found[file.name] = (status.st_ino, status.st_mtime_ns)
        return found

    def test_a_killed_scheduler_and_the_same_command(self):
        """On a scheduler that was started again at the same address."""
        processes, address = self.scheduler()
        process = self.begun("--scheduler", address, "--threads", "1", tiles=1)
        processes[0].kill()
        said = process.communicate(timeout=180)[1]
        self.assertEqual(process.returncode, 1, said)
        self.assertEqual(said, f"pointfront cluster build: the scheduler {address} went away. What "
                         "is done stays: start it and its workers again, and the same command goes "
                         "on\n")
        self.end(processes)
        before = self.done()
        self.assertGreaterEqual(len(before), 2)
        self.assertLess(len(before), 2 * self.report["tiles"])
        _, address = self.scheduler(port=int(address.rpartition(":")[2]))
        self.build("--scheduler", address, "--threads", "1")
        self.assertEqual(tree(self.land), self.expected)
        after = self.done()
        self.assertEqual(len(after), 2 * self.report["tiles"])
        self.assertEqual({name: after.get(name) for name in before}, before)

    def test_killed_workers_change_nothing(self):
        process = self.begun("--local", "2", tiles=1)
        draw = random.Random(2)
        killed = 0
        while process.poll() is None and killed < 4:
            workers = workers_of(process)
            if workers:
                with contextlib.suppress(psutil.Error):
                    draw.choice(workers).kill()
                    killed += 1
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(2 if workers else 0.02)
        process.wait(180)
        said = process.stderr.read()
        process.stderr.close()
        self.assertGreater(killed, 0)
        if process.returncode != 0:  # so many deaths that it gave up: the same command goes on
            self.assertIn("the same command goes on", said)
            self.build("--local", "2")
        self.assertEqual(tree(self.land), self.expected)

    def test_a_killed_client_and_a_signal(self):
        process = self.begun("--local", "2")
        process.kill()
        process.communicate()
        process = self.begun("--local", "2", tiles=4)
        process.send_signal(signal.SIGINT)
        said = process.communicate(timeout=60)[1]
        self.assertEqual(process.returncode, 130, said)
        self.assertIn("the same command goes on", said)
        end = time.monotonic() + 20
        while running(self.land) and time.monotonic() < end:
            time.sleep(0.1)
        self.assertEqual(running(self.land), [])
        self.build("--local", "2")
        self.assertEqual(tree(self.land), self.expected)

    def test_a_signal_at_the_end_changes_nothing(self):
        """The collection is there: what comes then does not make a failure of the build."""
        for delay in (0.05, 0.2):
            process = self.begun("--local", "1", tiles=1)
            collection = self.land / (self.land.name + ".pfcollection")
            while not collection.exists() and process.poll() is None:
                time.sleep(0.01)
            time.sleep(delay)
            process.send_signal(signal.SIGTERM)
            said = process.communicate(timeout=60)[1]
            self.assertIn(process.returncode, (0, 130), said)
            self.assertNotIn("Traceback", said)
            self.assertEqual(tree(self.land), self.expected)
            shutil.rmtree(self.land)

    def test_signals_wait_while_dask_starts(self):
        started = False
        with self.assertRaises(KeyboardInterrupt):
            with _cluster.signals_held_back():
                os.kill(os.getpid(), signal.SIGTERM)
                started = True
        self.assertTrue(started)
        self.assertEqual(signal.getsignal(signal.SIGTERM), signal.SIG_DFL)

    def test_workers_of_this_machine_are_not_watched_for_a_dashboard(self):
        import dask
        import distributed  # noqa: F401 (brings its settings)

        known = dask.config.merge(*dask.config.defaults)
        for name in _cluster.QUIET:
            self.assertIsNotNone(dask.config.get(name, config=known), name)
        client, cluster = _cluster._client(argparse.Namespace(scheduler=None, local=1))
        with cluster, client:
            quiet = _cluster.QUIET  # travels with the function, which finds no module of tests
            seen, = client.run(lambda: {name: dask.config.get(name) for name in quiet}).values()
        self.assertEqual(seen, _cluster.QUIET)

    def test_a_step_that_fails_is_told_and_logged(self):
        self.tool("build", self.inputs, "-o", self.land, "--tiles", *OPTIONS)
        said = _steps.run_step("tile:99_99", ["build", str(self.inputs), "-o", str(self.land),
                                              "--tiles", *OPTIONS[:-2]],
                               str(self.land), os.getcwd(), str(self.land / "stop"))
        self.assertIn("there is no such tile", said)
        log = (self.land / "work/logs/tile-99_99.log").read_text()
        self.assertIn("there is no such tile", log)
        self.assertIn("status 1", log)
        said = self.build("--local", "1", "--normals-k", "20", status=1).stderr
        self.assertIn("other options", said)
        usage = subprocess.run(COMMAND[:-1], capture_output=True, text=True, check=False)
        self.assertEqual(usage.returncode, 2)
        self.assertIn("usage", usage.stderr)


if __name__ == "__main__":
    unittest.main()
