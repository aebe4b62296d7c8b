"""Long runs that end early: by a signal, by a kill, by a disk that ends."""

import os
import resource
import shutil
import signal
import subprocess
import time
import unittest

from tool import DATA, SLOWNESS, TOOL, ToolTest, pointfront

LARGE = DATA / "large/autzen_10653336_rgb_intensity.laz"
STOPPED = 130
TRIES = 8  # a run may end before the signal comes: then again


def start(*arguments):
    return subprocess.Popen(
        [TOOL, *map(str, arguments)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)


def after_first_progress(number, *arguments):
    """Starts the run, sends the signal at the first sign of progress; the exit status."""
    process = start(*arguments, "--progress", "json")
    process.stderr.readline()
    process.send_signal(number)
    process.communicate(timeout=120)
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
        self.stopped("build", LARGE, "-o", self.folder / "out.pfront")
        self.assertEqual(self.entries(), [])
        store = self.build(LARGE)
        whole = store.stat().st_size
        for name in ("out.las", "out.laz", "out.xyz"):
            self.stopped("export", store, "-o", self.folder / name)
            self.assertEqual(self.entries(), ["cloud.pfront"])
        self.stopped("verify", store)
        self.assertEqual(store.stat().st_size, whole)

    def test_index(self):
        las = self.folder / "large.las"
        self.succeed("generate", "--points", "4000000", "-o", las)
        self.stopped("index", las, "-o", self.folder / "out.pfindex")
        self.assertEqual(self.entries(), ["large.las"])

    def test_an_input_that_shrinks_is_an_error(self):
        """At any moment: the run ends with a whole store, or with an error and nothing."""
        las = self.folder / "a.las"
        self.succeed("generate", "--points", 1000000, "-o", las)
        store = self.build(las)
        for kind in ("las", "laz", "csv", "ply", "pcd"):
            whole, input_, out = (self.folder / name for name in
                                  (f"whole.{kind}", f"in.{kind}", "out.pfront"))
            self.succeed("export", store, "-o", whole)
            statuses = set()
            for wait in (0.01, 0.03, 0.06, 0.1, 0.2, 0.4):
                shutil.copyfile(whole, input_)
                out.unlink(missing_ok=True)
                process = start("build", input_, "-o", out)
                time.sleep(wait)
                os.truncate(input_, whole.stat().st_size // 3)
                _, told = process.communicate(timeout=120)
                statuses.add(process.returncode)
                # Who opens the file after the cut reads a shorter one: a text says nothing then.
                if process.returncode == 0 and kind != "csv" and b"missing" not in told:
                    self.assertEqual(self.succeed("info", out, "--json").json["points"], 1000000)
                elif process.returncode != 0:
                    self.assertEqual(process.returncode, 1, (kind, wait, told))
                    self.assertIn(b"in." + kind.encode(), told)
                    self.assertFalse(out.exists())
            self.assertIn(1, statuses, kind)
        self.assertEqual([name for name in self.entries() if ".tmp" in name], [])

    def test_an_export_that_is_stopped_keeps_what_was_there(self):
        store = self.build(LARGE)
        earlier = self.folder / "points.xyz"
        earlier.write_text("1 2 3\n")
        self.stopped("export", store, "-o", earlier, "--force")
        self.assertEqual(earlier.read_text(), "1 2 3\n")

    def test_render_and_bench(self):
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
                time.sleep(1.5)
                self.assertIsNone(process.poll(), "ended before the signal")
                process.send_signal(number)
                _, err = process.communicate(timeout=60)
                self.assertEqual(process.returncode, STOPPED, err)
                self.assertEqual(self.entries(), ["cloud.pfront"])


class Kills(ToolTest):
    def kill_while_building(self, store, *options):
        """SIGKILL in the last phase, when the output is half written."""
        process = start("build", LARGE, "-o", store, "--progress", "json", *options)
        for line in process.stderr:
            if b'"building"' in line and b'"done":0,' not in line:
                break
        process.kill()
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, -signal.SIGKILL)

    def test_nothing_that_opens_is_left_and_the_next_run_cleans_up(self):
        (self.folder / "spill").mkdir()
        store = self.folder / "x.pfront"
        self.kill_while_building(
            store, "--memory", "128M", "--temp", self.folder / "spill")
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
    def test_a_build_can_be_looked_at_while_it_runs(self):
        store, preview = self.folder / "x.pfront", self.folder / "x.preview.pfront"
        process = start("build", LARGE, "-o", store)
        began = time.monotonic()
        while not preview.exists() and process.poll() is None:
            time.sleep(0.005)
        waited = time.monotonic() - began
        looked = pointfront("info", preview, "--json")
        checked = pointfront("verify", preview)
        _, err = process.communicate(timeout=240)
        took = time.monotonic() - began
        self.assertEqual(process.returncode, 0, err)
        self.assertEqual(looked.status, 0, looked)
        self.assertEqual(checked.status, 0, checked)
        self.assertLess(waited, max(3.0, 0.3 * took))
        said = looked.json["preview"]
        self.assertEqual(said["of"], "x.pfront")
        self.assertEqual(said["points_expected"], 10653336)
        self.assertGreater(looked.json["points"], 10000)
        self.assertLess(looked.json["points"], 200000)
        finished = self.succeed("info", store, "--json").json
        self.assertNotIn("preview", finished)
        self.assertEqual(finished["points"], 10653336)
        for axis in range(2):  # the first look shows most of the extent
            whole = finished["bounds"][axis + 3] - finished["bounds"][axis]
            seen = looked.json["bounds"][axis + 3] - looked.json["bounds"][axis]
            self.assertGreater(seen, 0.5 * whole)
        self.assertEqual(self.entries(), ["x.pfront"])

    def test_it_shows_finished_parts(self):
        store, preview = self.folder / "x.pfront", self.folder / "x.preview.pfront"
        process = start("build", LARGE, "-o", store, "--node-points", 4096, "--threads", 1)
        seen = []
        while process.poll() is None:
            looked = pointfront("info", preview, "--json")
            if looked.status == 0 and "preview" in looked.json:
                seen.append((looked.json["preview"]["points_finished"], looked.json["points"]))
                if seen[-1][0] > 0:
                    checked = pointfront("verify", preview, "--json")
                    gone = process.poll() is not None or not preview.exists()
                    self.assertTrue(gone or checked.status == 0, checked)
        self.assertEqual(process.wait(), 0)
        self.assertGreater(max(finished for finished, _ in seen), 1000000, seen)
        for finished, points in seen:
            self.assertGreaterEqual(points, finished)
            self.assertLess(points - finished, 100000)
        self.assertEqual(self.entries(), ["x.pfront"])

    def test_the_store_is_the_same_without(self):
        with_one = self.folder / "with.pfront"
        without = self.folder / "without.pfront"
        self.succeed("build", LARGE, "-o", with_one)
        self.succeed("build", LARGE, "-o", without, "--preview", "none")
        self.assertEqual(with_one.read_bytes(), without.read_bytes())
        self.refuse(2, "build", LARGE, "-o", without, "--preview", "often")


@unittest.skipIf(SLOWNESS > 1, "a sanitizer needs more addresses than these limits leave")
class Memory(ToolTest):
    def test_a_picture_under_any_limit_is_drawn_or_refused(self):
        store = self.build(LARGE)
        picture = self.folder / "x.png"
        for mebibytes in (100, 200, 400, 4000):
            limit = mebibytes << 20
            done = subprocess.run(
                [TOOL, "render", store, "-o", picture, "--technique", "ewa", "--size", "3000x3000"],
                capture_output=True, timeout=120, check=False,
                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
            if done.returncode == 0:
                self.assertEqual(self.entries(), ["cloud.pfront", "x.png"])
                picture.unlink()
            else:
                self.assertEqual(done.returncode, 1, (mebibytes, done.stderr))
                self.assertIn(b"memory", done.stderr)
                self.assertEqual(self.entries(), ["cloud.pfront"])
        self.assertEqual(done.returncode, 0, done.stderr)


class Disks(ToolTest):
    def refuse_with_limit(self, bytes_allowed, *arguments):
        """As refuse(1, ...), where no file may grow beyond so many bytes."""
        soft = resource.getrlimit(resource.RLIMIT_FSIZE)
        finished = subprocess.run(
            [TOOL, *map(str, arguments)], capture_output=True, timeout=240, check=False,
            preexec_fn=lambda: resource.setrlimit(
                resource.RLIMIT_FSIZE, (bytes_allowed, soft[1])))
        lines = finished.stderr.decode().splitlines()
        lines = [line for line in lines if ": warning: " not in line]
        self.assertEqual(finished.returncode, 1, lines)
        self.assertEqual(len(lines), 1, lines)
        return lines[0]

    def test_a_store_that_cannot_grow(self):
        said = self.refuse_with_limit(
            1000000, "build", LARGE, "-o", self.folder / "x.pfront")
        self.assertRegex(said, r"the store needs at least \d+ MiB")
        self.assertEqual(self.entries(), [])

    def test_a_spill_that_cannot_grow(self):
        said = self.refuse_with_limit(
            1000000, "build", LARGE, "-o", self.folder / "x.pfront", "--memory", "128M")
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
