"""Long runs that end early: by a signal, by a kill, by a disk that ends."""

import filecmp
import os
import resource
import shutil
import signal
import subprocess
import time
import unittest

from tool import DATA, SLOWNESS, TOOL, WORK, ToolTest, pointfront

LARGE = DATA / "large/autzen_10653336_rgb_intensity.laz"
STOPPED = 130
# A run may end before what the test does to it: then again. Runs yield to the test (os.nice).
TRIES = 40
# Seconds that end a test which hangs; nothing waits for them otherwise.
PATIENCE = 600 * SLOWNESS

SHARED = WORK / "shared"
MADE = SHARED / "made.las"
STORE = SHARED / "made.pfront"  # built without a preview
MADE_POINTS = 4000000


def setUpModule():
    """MADE and its STORE, for all tests that only read them."""
    shutil.rmtree(SHARED, ignore_errors=True)
    SHARED.mkdir(parents=True)
    unittest.addModuleCleanup(shutil.rmtree, SHARED)
    for arguments in (("generate", "--points", MADE_POINTS, "-o", MADE),
                      ("build", MADE, "-o", STORE, "--preview", "none")):
        made = pointfront(*arguments, limit=PATIENCE)
        if made.status != 0:
            raise AssertionError(f"{arguments}: {made}")


def start(*arguments):
    return subprocess.Popen(
        [TOOL, *map(str, arguments)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
        preexec_fn=lambda: os.nice(15))


def ended(process):
    """The complaints of a process, at its end."""
    try:
        return process.communicate(timeout=PATIENCE)[1]
    except subprocess.TimeoutExpired:
        process.kill()
        process.communicate()
        raise


def wait_until(process, happened):
    """Waits for an event; False if the process ends before it."""
    end = time.monotonic() + PATIENCE
    while not happened():
        if process.poll() is not None:
            return False
        if time.monotonic() > end:
            process.kill()
            process.communicate()
            raise AssertionError("the event does not come")
        time.sleep(0.001)
    return True


def told_of(process):
    """The fields of a process that Linux tells of, from its state on; none once it is gone."""
    try:
        with open(f"/proc/{process.pid}/stat", encoding="ascii") as file:
            return file.read().rpartition(")")[2].split()
    except OSError:
        return []


def work_of(process):
    """Seconds of processor time: they pass with its work, on a machine of any speed and load."""
    return sum(map(int, told_of(process)[11:13])) / os.sysconf("SC_CLK_TCK")


def has_open(process, path):
    folder = f"/proc/{process.pid}/fd"
    try:
        return str(path) in (os.readlink(f"{folder}/{name}") for name in os.listdir(folder))
    except OSError:  # closed meanwhile
        return False


def after_first_progress(number, *arguments):
    """Starts the run, sends the signal at the first sign of progress; the exit status."""
    process = start(*arguments, "--progress", "json")
    process.stderr.readline()
    process.send_signal(number)
    ended(process)
    return process.returncode


class Signals(ToolTest):
    def stopped(self, *arguments):
        for number in (signal.SIGINT, signal.SIGTERM):
            status = [after_first_progress(number, *arguments)]
            while status[-1] == 0 and len(status) < TRIES:
                for path in self.folder.glob("out*"):
                    path.unlink()
                status.append(after_first_progress(number, *arguments))
            self.assertEqual(status[-1], STOPPED, f"{arguments}: {status}")

    def test_generate(self):
        for name in ("out.las", "out.laz", "out.xyz"):
            self.stopped("generate", "--points", 200000000, "-o", self.folder / name)
            self.assertEqual(self.entries(), [])

    def test_build_export_verify(self):
        for cloud in (LARGE, MADE):
            self.stopped("build", cloud, "-o", self.folder / "out.pfront")
            self.assertEqual(self.entries(), [])
        whole = STORE.stat()
        for name in ("out.las", "out.laz", "out.xyz"):
            self.stopped("export", STORE, "-o", self.folder / name)
            self.assertEqual(self.entries(), [])
        self.stopped("verify", STORE)
        self.assertEqual((STORE.stat().st_size, STORE.stat().st_mtime_ns),
                         (whole.st_size, whole.st_mtime_ns))

    def test_index(self):
        self.stopped("index", MADE, "-o", self.folder / "out.pfindex")
        self.assertEqual(self.entries(), [])

    def cut_at(self, moment, whole, cut, out):
        """Builds from a copy that loses two thirds at a moment; status and complaint. 0 is when the
        run has opened the file, n its n-th sign of progress."""
        shutil.copyfile(whole, cut)
        out.unlink(missing_ok=True)
        process = start("build", cut, "-o", out, "--progress", "json")
        said = b""
        if moment == 0:
            wait_until(process, lambda: has_open(process, cut))
        for _ in range(moment):
            said += process.stderr.readline()
        os.truncate(cut, whole.stat().st_size // 3)
        said += ended(process)
        return process.returncode, said

    def test_an_input_that_shrinks_is_an_error(self):
        """At any moment: the run ends with a whole store, or with an error and nothing."""
        points = 400000
        las = self.folder / "a.las"
        self.succeed("generate", "--points", points, "-o", las)
        store = self.build(las)
        for kind in ("las", "laz", "csv", "ply", "pcd"):
            whole, cut, out = (self.folder / name for name in
                               (f"whole.{kind}", f"in.{kind}", "out.pfront"))
            self.succeed("export", store, "-o", whole)
            statuses, moments = [], [4, 2, 1]
            # A run that has read all before the cut says nothing of it: then once more.
            while moments or (1 not in statuses and len(statuses) < TRIES):
                moment = moments.pop() if moments else 0
                status, told = self.cut_at(moment, whole, cut, out)
                statuses.append(status)
                # Who opens the file after the cut reads a shorter one: a text says nothing then.
                if status == 0 and kind != "csv" and b"missing" not in told:
                    self.assertEqual(self.succeed("info", out, "--json").json["points"], points)
                elif status != 0:
                    self.assertEqual(status, 1, (kind, moment, told))
                    self.assertIn(b"in." + kind.encode(), told)
                    self.assertFalse(out.exists())
            self.assertIn(1, statuses, kind)
        self.assertEqual([name for name in self.entries() if ".tmp" in name], [])

    def test_an_export_that_is_stopped_keeps_what_was_there(self):
        earlier = self.folder / "points.xyz"
        earlier.write_text("1 2 3\n")
        self.stopped("export", STORE, "-o", earlier, "--force")
        self.assertEqual(earlier.read_text(), "1 2 3\n")

    def test_render_and_bench(self):
        """They would take minutes; the signal comes when they have worked for a while."""
        store = self.build(DATA / "las/real/autzen_trim.las")
        runs = (
            ("render", store, "-o", self.folder / "out.png", "--size", "3000x2000", "--frames",
             100000),
            ("bench", store, "--path", "orbit", "--frames", 100000, "--stats",
             self.folder / "out.json"),
        )
        for arguments in runs:
            for number in (signal.SIGINT, signal.SIGTERM):
                process = start(*arguments)
                self.assertTrue(wait_until(process, lambda: work_of(process) > 0.5),
                                "ended before the signal")
                process.send_signal(number)
                err = ended(process)
                self.assertEqual(process.returncode, STOPPED, err)
                self.assertEqual(self.entries(), ["cloud.pfront"])


class Kills(ToolTest):
    def kill_while_building(self, store, *options):
        """SIGKILL in the last phase, when the output is half written."""
        statuses = []
        while -signal.SIGKILL not in statuses and len(statuses) < TRIES:
            before = store.read_bytes() if store.exists() else None
            process = start("build", MADE, "-o", store, "--progress", "json", *options)
            for line in process.stderr:
                if b'"building"' in line and b'"done":0,' not in line:
                    break
            process.kill()
            ended(process)
            statuses.append(process.returncode)
            if process.returncode == 0:  # it was faster: all is as before, and once more
                store.unlink()
                if before is not None:
                    store.write_bytes(before)
        self.assertEqual(statuses[-1], -signal.SIGKILL, statuses)

    def test_nothing_that_opens_is_left_and_the_next_run_cleans_up(self):
        (self.folder / "spill").mkdir()
        store = self.folder / "x.pfront"
        self.kill_while_building(
            store, "--memory", "64M", "--temp", self.folder / "spill")
        self.assertEqual(list((self.folder / "spill").iterdir()), [])
        self.assertFalse(store.exists())
        for path in self.folder.iterdir():
            if path.is_file():
                self.assertEqual(pointfront("info", path).status, 1, f"{path} opens")
        report = self.succeed(
            "build", DATA / "las/real/1.2-with-color.las", "-o", store, "--json").json
        self.assertEqual(report["points_stored"], 1065)
        self.assertEqual(self.entries(), ["spill", "x.pfront"])

    def test_an_earlier_store_survives(self):
        store = self.build(DATA / "las/real/1.2-with-color.las")
        before = store.read_bytes()
        self.kill_while_building(store, "--force")
        self.assertEqual(store.read_bytes(), before)
        self.succeed("verify", store)


class Previews(ToolTest):
    def start_pausing(self, *arguments):
        """A run whose progress goes to a file: nobody reads a pipe while it is paused."""
        self.progress = self.folder / "progress.txt"
        with open(self.progress, "wb") as file:
            return subprocess.Popen([TOOL, *map(str, arguments), "--progress", "json"],
                                    stdout=subprocess.DEVNULL, stderr=file,
                                    preexec_fn=lambda: os.nice(15))

    def pause(self, process):
        """Stops the run where it is, so that it waits while somebody looks at its files."""
        process.send_signal(signal.SIGSTOP)
        wait_until(process, lambda: told_of(process)[:1] == ["T"])

    def paused_while_it_reads(self, source, store, preview):
        """A build that has a preview and has not read all points yet."""
        for _ in range(TRIES):
            process = self.start_pausing("build", source, "-o", store)
            if wait_until(process, preview.exists):
                self.pause(process)
                said = self.progress.read_text()
                if preview.exists() and '"sorting"' not in said and '"building"' not in said:
                    return process
            process.kill()  # it went on before it could be paused
            process.wait()
            store.unlink(missing_ok=True)
            preview.unlink(missing_ok=True)
        raise AssertionError("no preview while points are read")

    def test_a_build_can_be_looked_at_while_it_runs(self):
        store, preview = self.folder / "x.pfront", self.folder / "x.preview.pfront"
        process = self.paused_while_it_reads(LARGE, store, preview)
        looked = pointfront("info", preview, "--json")
        checked = pointfront("verify", preview)
        process.send_signal(signal.SIGTERM)
        process.send_signal(signal.SIGCONT)
        self.assertEqual(process.wait(PATIENCE), STOPPED, self.progress.read_text())
        self.assertEqual(self.entries(), ["progress.txt"])
        self.assertEqual(looked.status, 0, looked)
        self.assertEqual(checked.status, 0, checked)
        told = self.succeed("info", LARGE, "--json").json
        said = looked.json["preview"]
        self.assertEqual(said["of"], "x.pfront")
        self.assertEqual(said["points_expected"], told["points"])
        self.assertGreater(looked.json["points"], 10000)
        self.assertLess(looked.json["points"], 200000)
        for axis in range(2):  # the first look shows most of the extent
            whole = told["bounds"][axis + 3] - told["bounds"][axis]
            seen = looked.json["bounds"][axis + 3] - looked.json["bounds"][axis]
            self.assertGreater(seen, 0.5 * whole)

    def test_the_store_is_the_same_without(self):
        """STORE was built without."""
        store = self.folder / "x.pfront"
        self.succeed("build", MADE, "-o", store, limit=PATIENCE)
        self.assertNotIn("preview", self.succeed("info", store, "--json").json)
        self.assertEqual(self.entries(), ["x.pfront"])
        self.assertTrue(filecmp.cmp(store, STORE, shallow=False), "a preview changes the store")
        self.refuse(2, "build", MADE, "-o", store, "--preview", "often")

    def test_it_shows_finished_parts(self):
        store, preview = self.folder / "x.pfront", self.folder / "x.preview.pfront"
        process = self.start_pausing(
            "build", MADE, "-o", store, "--node-points", 4096, "--threads", 1)
        seen = []
        while process.poll() is None:
            self.pause(process)
            looked = pointfront("info", preview, "--json")
            if looked.status == 0 and "preview" in looked.json:
                seen.append((looked.json["preview"]["points_finished"], looked.json["points"]))
                if seen[-1][0] > 0:
                    checked = pointfront("verify", preview, "--json")
                    self.assertEqual(checked.status, 0, checked)
            process.send_signal(signal.SIGCONT)
            enough = work_of(process) + 0.04
            wait_until(process, lambda enough=enough: work_of(process) > enough)
        self.assertEqual(process.returncode, 0, self.progress.read_text())
        self.assertGreater(max(finished for finished, _ in seen), MADE_POINTS // 10, seen)
        for finished, points in seen:
            self.assertGreaterEqual(points, finished)
            self.assertLess(points - finished, 100000)
        self.assertEqual(self.entries(), ["progress.txt", "x.pfront"])


@unittest.skipIf(SLOWNESS > 1, "a sanitizer needs more addresses than these limits leave")
class Memory(ToolTest):
    def test_a_picture_under_any_limit_is_drawn_or_refused(self):
        picture = self.folder / "x.png"
        for mebibytes in (100, 200, 400, 4000):
            limit = mebibytes << 20
            done = subprocess.run(
                [TOOL, "render", STORE, "-o", picture, "--technique", "ewa", "--size", "3000x3000"],
                capture_output=True, timeout=PATIENCE, check=False,
                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
            if done.returncode == 0:
                self.assertEqual(self.entries(), ["x.png"])
                picture.unlink()
            else:
                self.assertEqual(done.returncode, 1, (mebibytes, done.stderr))
                self.assertIn(b"memory", done.stderr)
                self.assertEqual(self.entries(), [])
        self.assertEqual(done.returncode, 0, done.stderr)


class Disks(ToolTest):
    def refuse_with_limit(self, bytes_allowed, *arguments):
        """As refuse(1, ...), where no file may grow beyond so many bytes."""
        soft = resource.getrlimit(resource.RLIMIT_FSIZE)
        finished = subprocess.run(
            [TOOL, *map(str, arguments)], capture_output=True, timeout=PATIENCE, check=False,
            preexec_fn=lambda: resource.setrlimit(
                resource.RLIMIT_FSIZE, (bytes_allowed, soft[1])))
        lines = finished.stderr.decode().splitlines()
        lines = [line for line in lines if ": warning: " not in line]
        self.assertEqual(finished.returncode, 1, lines)
        self.assertEqual(len(lines), 1, lines)
        return lines[0]

    def test_a_store_that_cannot_grow(self):
        said = self.refuse_with_limit(
            1000000, "build", MADE, "-o", self.folder / "x.pfront")
        self.assertRegex(said, r"the store needs at least \d+ MiB")
        self.assertEqual(self.entries(), [])

    def test_a_spill_that_cannot_grow(self):
        said = self.refuse_with_limit(
            1000000, "build", MADE, "-o", self.folder / "x.pfront", "--memory", "64M")
        self.assertRegex(said, r"needs \d+ MiB")
        self.assertIn("--temp", said)
        self.assertEqual(self.entries(), [])

    def test_exports_and_surveys_that_cannot_grow(self):
        store = self.build(DATA / "las/real/autzen_trim.las")
        for name in ("out.las", "out.laz", "out.xyz"):
            said = self.refuse_with_limit(
                100000, "export", store, "-o", self.folder / name)
            self.assertIn(name, said)
            said = self.refuse_with_limit(
                100000, "generate", "--points", 1000000, "-o", self.folder / name)
            self.assertIn(name, said)
            self.assertEqual(self.entries(), ["cloud.pfront"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
