"""`pointfront view`: files that are dragged in, and point files that become stores meanwhile."""

import os
import pathlib
import shutil
import signal
import time
import unittest

import numpy
from pictures import read_png
from windows import PATIENCE, SIZE, Window, WindowTest, share_of_difference


class Files(WindowTest):
    """Stores that are dragged in, and point files that become stores meanwhile."""

    def temporary(self):
        return sorted(pathlib.Path(self.folder / "tmp").glob("pointfront-view-*"))

    def show(self, *arguments, **options):
        (self.folder / "tmp").mkdir(exist_ok=True)
        window = Window(self.folder, *arguments,
                        environment=dict(os.environ, TMPDIR=str(self.folder / "tmp")), **options)
        self.addCleanup(lambda: window.process.poll() is None and window.close())
        return window

    def complete(self, window, expected):
        """Waits until the window shows that picture."""
        end = time.monotonic() + PATIENCE
        while share_of_difference(window.picture(), expected) >= 0.001:
            self.assertLess(time.monotonic(), end, "the picture does not come")
            time.sleep(0.2)

    def expected(self, store):
        rendered = self.folder / "expected.png"
        self.succeed("render", store, "-o", rendered, "--size", f"{SIZE[0]}x{SIZE[1]}")
        return read_png(rendered)

    def test_a_store_that_is_dragged_in_is_shown(self):
        self.succeed("generate", "--points", "30000", "-o", self.folder / "survey.las")
        other = self.build(self.folder / "survey.las", name="the other one.pfront")
        window = self.show(self.store, "--color-by", "intensity")
        window.picture()
        window.hands.drop([other])
        rendered = self.folder / "expected.png"
        self.succeed("render", other, "-o", rendered, "--size", f"{SIZE[0]}x{SIZE[1]}",
                     "--color-by", "intensity")
        self.complete(window, read_png(rendered))
        (self.folder / "none.txt").write_text("nothing")
        window.hands.drop([self.folder / "none.txt"])
        self.complete(window, read_png(rendered))  # as before
        status, complaint = window.end()
        self.assertEqual(status, 0)
        self.assertEqual(len(complaint.splitlines()), 1, complaint)
        self.assertIn("none.txt", complaint)

    def test_a_missing_tile_leaves_the_window_to_the_others(self):
        """However soon it is met."""
        for name in "abc":
            shutil.copy(self.store, self.folder / f"{name}.pfront")
        city = self.folder / "city.pfcollection"
        self.succeed("collection", "create", city,
                     *(self.folder / f"{name}.pfront" for name in "abc"))
        (self.folder / "b.pfront").unlink()
        for _ in range(4):
            window = self.show(city)
            self.assertGreater(numpy.ptp(window.picture()), 0)
            status, complaint = window.end()
            self.assertEqual(status, 0, complaint)
            self.assertIn("b.pfront", complaint)

    def test_a_laz_file_is_shown_at_once_and_becomes_a_store(self):
        laz = self.folder / "trim.laz"
        self.succeed("export", self.store, "-o", laz)
        built = self.folder / "built.pfront"
        self.succeed("build", laz, "-o", built)
        window = self.show(laz)
        self.assertEqual(len(self.temporary()), 1)
        self.complete(window, self.expected(built))
        status, complaint = window.end()
        self.assertEqual(status, 0, complaint)
        self.assertEqual(complaint.count("A first look"), 1, complaint)
        self.assertEqual(self.temporary(), [])

    def test_point_files_of_other_families_are_shown_at_once_and_become_stores(self):
        for name in ("trim.ply", "trim.pcd", "trim.csv"):
            with self.subTest(name=name):
                file, built = self.folder / name, self.folder / f"{name}.pfront"
                self.succeed("export", self.store, "-o", file)
                self.succeed("build", file, "-o", built)
                window = self.show(file)
                self.complete(window, self.expected(built))
                status, complaint = window.end()
                self.assertEqual(status, 0, complaint)
                self.assertEqual(self.temporary(), [])

    def test_a_folder_of_laz_files_becomes_a_store(self):
        folder = self.folder / "tiles"
        folder.mkdir()
        for name, box in (("west", "0,0,0,637000,1e7,1e5"), ("east", "637000,0,0,1e7,1e7,1e5")):
            self.succeed("export", self.store, "-o", folder / f"{name}.laz", "--box", box)
        built = self.folder / "built.pfront"
        self.succeed("build", folder, "-o", built)
        window = self.show(self.store)
        window.picture()
        window.hands.drop([folder])
        self.complete(window, self.expected(built))
        self.assertEqual(window.end()[0], 0)
        self.assertEqual(self.temporary(), [])

    def test_the_store_is_kept_where_the_user_says(self):
        kept = self.folder / "kept.pfront"
        self.succeed("export", self.store, "-o", self.folder / "trim.laz")
        window = self.show(self.folder / "trim.laz", "--store", kept)
        end = time.monotonic() + PATIENCE
        while not kept.exists():
            self.assertLess(time.monotonic(), end)
            time.sleep(0.1)
        self.complete(window, self.expected(kept))
        self.assertEqual(window.end()[0], 0)
        self.assertEqual(self.temporary(), [])
        self.succeed("verify", kept)

    def test_a_signal_leaves_nothing_behind(self):
        self.succeed("generate", "--points", "5000000", "-o", self.folder / "large.laz")
        for wait, number in ((0.0, signal.SIGTERM), (2.0, signal.SIGTERM), (1.0, signal.SIGHUP)):
            window = self.show(self.folder / "large.laz")
            self.assertEqual(len(self.temporary()), 1)
            time.sleep(wait)
            window.process.send_signal(number)
            status = window.process.wait(PATIENCE)
            self.assertEqual(status, 130, window.process.stderr.read())
            self.assertEqual(self.temporary(), [])
            window.close()

    def test_a_closed_stdout_leaves_nothing_behind(self):
        self.succeed("export", self.store, "-o", self.folder / "trim.laz")
        reading, writing = os.pipe()
        window = self.show(self.folder / "trim.laz", stdout=writing)
        os.close(writing)
        self.assertEqual(len(self.temporary()), 1)
        os.close(reading)
        window.hands.press("v")
        self.assertEqual(window.process.wait(PATIENCE), 1)
        self.assertIn("standard output is closed", window.process.stderr.read().decode())
        self.assertEqual(self.temporary(), [])
        window.close()

    def test_a_build_that_fails_says_so_and_the_first_look_stays(self):
        laz = self.folder / "cut.laz"
        self.succeed("export", self.store, "-o", laz)
        window = self.show(laz, "--store", self.store)  # which is there
        first = window.picture()
        complaint = ""
        while "pointfront build: " not in complaint:  # the build has failed
            line = window.process.stderr.readline().decode()
            self.assertTrue(line, f"the window ended, and said only: {complaint}")
            complaint += line
        self.assertLess(share_of_difference(window.picture(), first), 0.001)
        status, more = window.end()
        complaint += more
        self.assertEqual(status, 0)
        self.assertIn("--force", complaint)


if __name__ == "__main__":
    unittest.main()
