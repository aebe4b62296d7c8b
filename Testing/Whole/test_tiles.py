"""Builds of many tiles have the values of one store, cut, killed or changed as they may be."""

import hashlib
import json
import os
import pathlib
import random
import shutil
import signal
import struct
import subprocess
import time
import unittest
import zlib

from tool import SLOWNESS, TOOL, WORK, ToolTest, pointfront, write_las

POINTS = 60000 if SLOWNESS == 1 else 15000
EDGE = "40"  # metres; the land is some 80 m wide
FEWER, SMALL_EDGE = 20000, "24"  # as many tiles of fewer points, where no value is looked at
SURVEYS = WORK / "surveys"
VALUES = ("--normals", "pca", "--curvature", "--local-height", "--height-above-ground")


def setUpModule():  # pylint: disable=invalid-name
    shutil.rmtree(SURVEYS, ignore_errors=True)
    unittest.addModuleCleanup(shutil.rmtree, SURVEYS, ignore_errors=True)


def survey(test, points=POINTS):
    """A copy of the files that make_survey() makes once for all tests."""
    made = SURVEYS / str(points)
    if not made.exists():
        made.mkdir(parents=True)
        make_survey(test, points, made)
    return pathlib.Path(shutil.copytree(made, test.folder / "inputs"))


def make_survey(test, points, folder):
    """Files of one land of 16 bit colours, cut across the tiles; beside it a file of 8 bit colours,
    one without classes, and a point so far from all others that its neighbours are in other tiles.
    """
    whole, store = test.folder / "whole.las", test.folder / "whole.pfront"
    test.succeed("generate", "--points", points, "-o", whole, "--seed", 3, "--progress", "none")
    test.succeed("build", whole, "-o", store, "--progress", "none")
    west, south, _, east, north, _ = test.succeed("info", store, "--json").json["bounds"]
    cuts = [west, west + 0.27 * (east - west), west + 0.61 * (east - west), east]
    for number in range(3):
        # A box includes its faces, and steps are of a millimetre.
        low = cuts[number] + (0.0005 if number else -1)
        test.succeed("export", store, "-o", folder / f"part_{number}.las", "--box",
                     f"{low},{south - 1},-1000,{cuts[number + 1] + 0.0005},{north + 1},1000")
    draw = random.Random(5)
    write_las(folder / "small.las",
              [(east + 25 * draw.random(), south + 60 * draw.random(), 60 + draw.random(),
                *(draw.randrange(256) for _ in range(3))) for _ in range(points // 20)])
    rows = [f"{west + 30 * draw.random():.3f} {north + 20 * draw.random():.3f} "
            f"{61 + draw.random():.3f}" for _ in range(points // 20)]
    rows.append(f"{west + 1:.3f} {north + 140:.3f} 64.000")
    (folder / "bare.xyz").write_text("\n".join(rows))


def write_image(path, bits, west, north, side=50):
    """A PNG of one grey, a metre a pixel, and its world file."""
    def chunk(kind, data):
        checked = kind + data
        return struct.pack(">I", len(data)) + checked + struct.pack(">I", zlib.crc32(checked))
    grey = struct.pack(">H", 40000) if bits == 16 else b"\xc8"
    row = b"\0" + side * 3 * grey
    path.write_bytes(b"\x89PNG\r\n\x1a\n" +
                     chunk(b"IHDR", struct.pack(">2I5B", side, side, bits, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(side * row)) + chunk(b"IEND", b""))
    path.with_suffix(".pgw").write_text(f"1\n0\n0\n-1\n{west + 0.5}\n{north - 0.5}\n")
    return path


def rows_of(test, cloud):
    """The points of a cloud as sorted rows of all values, and the names of these."""
    text = test.folder / "points.csv"
    test.succeed("export", cloud, "-o", text, "--force", "--progress", "none")
    names, *rows = text.read_text().splitlines()
    return names.split(","), sorted(rows)


def with_radii_from_zero(names, rows):
    """Codes of radii count from a base that each cloud chooses: here from the smallest. 0 says that
    there is no radius."""
    if "splat_radius" not in names:
        return rows
    at = names.index("splat_radius")
    split = [row.split(",") for row in rows]
    least = min(int(row[at]) for row in split if int(row[at]) > 0)
    for row in split:
        row[at] = str(int(row[at]) - least if int(row[at]) > 0 else "none")
    return sorted(",".join(row) for row in split)


def tree(folder):
    """The files that a reader of a collection reads: names below the folder, and hashes."""
    files = [*(folder / "tiles").iterdir(), *folder.glob("*.pfcollection")]
    return {file.suffix + file.name * (file.suffix == ".pfront"):
            hashlib.sha256(file.read_bytes()).hexdigest() for file in files}


class Tiles(ToolTest):
    def tiles(self, folder, *inputs, name="land", edge=EDGE):
        done = self.succeed("build", *inputs, "-o", self.folder / name, "--tiles", "--tile", edge,
                            "--progress", "none", "--json", *folder)
        return done.json

    def same_values(self, inputs, *options):
        one = self.folder / "one.pfront"
        told = self.succeed("build", inputs, "-o", one, "--force", "--progress", "none", "--json",
                            *options).json
        made = self.tiles(options, inputs)
        self.assertEqual(made["points_stored"], told["points_stored"])
        self.assertEqual(made["points_rejected"], told["points_rejected"])
        self.assertGreater(made["tiles"], 3)
        collection = self.folder / "land/land.pfcollection"
        self.assertTrue(self.succeed("collection", "verify", collection, "--json").json["ok"])
        names, expected = rows_of(self, one)
        others, found = rows_of(self, collection)
        self.assertEqual(names, others)
        self.assertEqual(len(expected), told["points_stored"])
        expected, found = (with_radii_from_zero(names, rows) for rows in (expected, found))
        differ = [pair for pair in zip(expected, found) if pair[0] != pair[1]]
        self.assertEqual(len(expected), len(found))
        self.assertFalse(differ[:3], f"{len(differ)} points differ: {names}")
        return names

    def same_colours(self, bits):
        """An image over files of 16 bits and one of 8: parts of each keep their own colours."""
        land = survey(self, FEWER)
        west, south, *_ = self.succeed("info", land / "small.las", "--json").json["bounds"]
        image = write_image(self.folder / "image.png", bits, west - 20, south + 40)
        self.same_values(land, "--color-from", image)
        names, rows = rows_of(self, self.folder / "one.pfront")
        found = [int(row.split(",")[names.index("red")]) for row in rows]
        self.assertGreater(found.count(40000 if bits == 16 else 51400), 100)

    def test_have_the_colours_of_one_store_with_images_of_8_bits(self):
        self.same_colours(8)

    def test_have_the_colours_of_one_store_with_images_of_16_bits(self):
        self.same_colours(16)

    def test_have_the_values_of_one_store(self):
        names = self.same_values(survey(self), *VALUES)
        for name in ("red", "nx", "curvature", "splat_radius", "local_height",
                     "height_above_ground", "gps_time"):
            self.assertIn(name, names)

    def test_have_the_heights_above_lowest_points_of_one_store(self):
        folder = survey(self)
        store = self.folder / "bare.pfront"
        self.succeed("build", *sorted(folder.glob("part_*.las")), "-o", store, "--progress", "none")
        self.succeed("export", store, "-o", self.folder / "roofs.las", "--classes", "1,3,4,5,6,7")
        self.same_values(self.folder / "roofs.las", "--height-above-ground", "--ground-cell", "7")

    def test_have_normals_of_scan_lines_and_of_a_radius(self):
        folder = survey(self)
        self.same_values(folder, "--normals", "scanline", "--layers", "none")
        self.folder.joinpath("land").rename(self.folder / "before")
        self.same_values(folder, "--normals", "pca", "--normals-radius", "1.5",
                         "--precision", "0.01", "--structure", "kdtree")

    def test_have_nothing_of_an_input_without_points(self):
        inputs = self.folder / "inputs"
        inputs.mkdir()
        empty = write_las(inputs / "empty.las", [(1e6, 0.0, 0.0, 1, 2, 3)], scale=1e-5)
        data = bytearray(empty.read_bytes()[:227])
        struct.pack_into("<2I", data, 107, 0, 0)  # its colours and steps are nobody's
        empty.write_bytes(data)
        rows = "".join(f"{x % 97}.5 {x // 97}.5 1.0\n" for x in range(8000))
        (inputs / "rows.xyz").write_text(rows)
        self.assertNotIn("red", self.same_values(inputs))
        precisions = [self.succeed("info", self.folder / cloud, "--json").json["precision"]
                      for cloud in ("one.pfront", "land/land.pfcollection")]
        self.assertEqual(precisions[0], precisions[1])

    def test_count_what_they_leave_out(self):
        rows = [f"{x % 97}.5 {x // 97}.5 1.0" for x in range(5000)]
        rows[7], rows[4000] = "nan 4 5", "3 inf 5"
        (self.folder / "broken.xyz").write_text("\n".join(rows))
        (self.folder / "no.las").write_text("this is no LAS file")
        inputs = self.folder / "broken.xyz", self.folder / "no.las"
        made = self.tiles(("--on-error", "skip"), *inputs)
        self.assertEqual((made["points_read"], made["points_stored"]), (5000, 4998))
        self.assertEqual(made["points_rejected"], {"not a number": 1, "infinite": 1})
        self.assertIn("no.las", made["inputs_skipped"][0]["path"])
        said = self.refuse(1, "build", *inputs, "-o", self.folder / "other", "--tiles")
        self.assertIn("no.las", said.err)

    def test_tell_once_what_they_find_of_inputs(self):
        """And of points, for the tiles that have them."""
        folder = survey(self, FEWER)
        done = self.succeed("build", *sorted(folder.glob("part_*.las")), "-o", self.folder / "land",
                            "--tiles", "--tile", SMALL_EDGE, "--progress", "none")
        said = [line.partition(": warning: ")[2] for line in done.err.splitlines()]
        self.assertEqual([line[:20] for line in said], ["No input says which "], done.err)
        rows = ["0 0 0", "50 0 0", "100 0 0"]
        (self.folder / "line.xyz").write_text("\n".join(rows))
        done = self.succeed("build", self.folder / "line.xyz", "-o", self.folder / "line",
                            "--tiles", "--tile", "40", "--normals", "pca", "--progress", "none")
        said = [line.partition(": warning: ")[2] for line in done.err.splitlines()]
        self.assertEqual(sum(line.startswith("No input") for line in said), 1, done.err)
        self.assertEqual(sum("1 point has no normal: it has" in line for line in said), 1, done.err)

    def test_refuse_what_would_have_seams_or_mix_two_builds(self):
        folder = survey(self, 5000)
        for options, why in ((("--normals", "pca", "--normals-eps", "1"), "seams"),
                             (("--refinement", "replace"), "means")):
            said = self.refuse(1, "build", folder, "-o", self.folder / "x", "--tiles", *options)
            self.assertIn(why, said.err)
        self.refuse(2, "build", folder, "-o", self.folder / "x", "--tile", "5")
        for edge in ("1e-9", "0.009"):
            refused = pointfront("build", folder, "-o", self.folder / "x", "--tiles", "--tile",
                                 edge, "--only", "plan")
            self.assertEqual(refused.status, 1, refused)
            self.assertIn("(--tile 0.01) are the smallest", refused.err.splitlines()[-1])
        self.refuse(2, "build", folder, "-o", self.folder / "x", "--tiles", "--only", "survey:x")
        self.refuse(1, "build", folder, "-o", self.folder / "x", "--tiles", "--only", "settle")
        self.tiles((), folder)
        said = self.refuse(1, "build", folder, "-o", self.folder / "land", "--tiles", "--tile", "9")
        self.assertIn("other options", said.err)
        said = self.refuse(1, "build", folder, "-o", self.folder, "--tiles")
        self.assertIn("empty folder", said.err)

    def test_leave_the_files_of_others(self):
        """Those that were in the folder before, inputs among them, and those that came later."""
        folder, land = survey(self, 5000), self.folder / "land"
        for place in ("tiles", "work"):
            kept = land / place / "q0.las"
            kept.parent.mkdir(parents=True)
            shutil.copy(folder / "part_0.las", kept)
            said = self.refuse(1, "build", kept, "-o", land, "--tiles", "--tile", SMALL_EDGE)
            self.assertIn(f"{place}/q0.las", said.err)
            self.tiles(("--force",), kept, edge=SMALL_EDGE)
            self.assertTrue(kept.exists())
            shutil.rmtree(land)
        (self.folder / "elsewhere").mkdir()
        land.mkdir()
        (land / "tiles").symlink_to(self.folder / "elsewhere")
        said = self.refuse(1, "build", folder, "-o", land, "--tiles")
        self.assertIn("'tiles'", said.err)
        (land / "tiles").unlink()
        for name in ("tiles", "work"):  # a kill before the plan leaves these
            (land / name).mkdir()
        self.tiles((), folder, edge=SMALL_EDGE)
        theirs = [land / name for name in (
            "tiles/mine.pfront", "tiles/0_0.pfront", "tiles/0_0-notes.pfront",
            "tiles/0_0-1234567.las",
            "tiles/1_2.backup", "work/tile-notes.txt", "work/points-of-control.csv",
            "work/tile-0_0.json.backup.txt")]
        for path in theirs:
            path.write_text("mine")
        (land / "tiles/empty").mkdir()
        ours = [land / name for name in (
            "tiles/-7_12-0123abcd.pfront", "tiles/0_0.host-17.part.pfront",
            f"tiles/0_0.host-17.part.pfront.{17:016x}-{4:016x}.tmp", "work/tile--7_12.json",
            "work/points-99.kept")]
        for path in ours:
            path.write_text("left over")
        (folder / "bare.xyz").unlink()
        before = set((land / "tiles").glob("*_*-*.pfront"))
        self.tiles((), folder, edge=SMALL_EDGE)
        self.assertTrue(before - set((land / "tiles").iterdir()), "all tiles are as they were")
        self.assertEqual([path for path in theirs if not path.exists()], [])
        self.assertTrue((land / "tiles/empty").is_dir())
        self.assertEqual([path for path in ours if path.exists()], [])


class Restart(ToolTest):
    def arguments(self, name, *options):
        return ["build", self.inputs, "-o", self.folder / name, "--tiles", "--tile", SMALL_EDGE,
                "--json", *VALUES, *options]

    def setUp(self):
        super().setUp()
        self.inputs = survey(self, FEWER)

    def test_a_killed_build_goes_on_to_the_same_bytes(self):
        begin = time.monotonic()
        made = self.succeed(*self.arguments("whole")).json
        usual = time.monotonic() - begin
        self.assertEqual(made["tiles_built"], made["tiles"])
        draw = random.Random(7)
        kills = 0
        for _ in range(8):
            process = subprocess.Popen([TOOL, *map(str, self.arguments("killed"))],
                                       stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
            try:
                process.wait(usual * draw.uniform(0.1, 0.7))
                break
            except subprocess.TimeoutExpired:
                process.send_signal(draw.choice((signal.SIGKILL, signal.SIGTERM)))
                process.wait()
                kills += 1
            finally:
                process.stdout.close()
        self.assertGreater(kills, 0)
        done = self.succeed(*self.arguments("killed")).json
        self.assertEqual(done["points_stored"], made["points_stored"])
        self.assertEqual(tree(self.folder / "killed"), tree(self.folder / "whole"))
        self.assertEqual(self.succeed(*self.arguments("killed")).json["tiles_built"], 0)

    def test_a_signal_ends_it_and_what_is_done_stays(self):
        process = subprocess.Popen(
            [TOOL, *map(str, self.arguments("land")), "--progress", "json"],
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        for line in process.stderr:
            if line.startswith("{") and json.loads(line)["phase"].startswith("tile 3"):
                process.send_signal(signal.SIGINT)
                break
        rest = process.stderr.read()
        self.assertEqual(process.wait(), 130, rest)
        process.stderr.close()
        self.assertNotIn("nothing was written", rest)
        self.assertIn("the same command goes on", rest)
        self.assertFalse(list((self.folder / "land/tiles").glob("*.part*")))
        done = self.succeed(*self.arguments("land")).json
        self.assertLessEqual(done["tiles_built"], done["tiles"] - 2)

    def test_changed_inputs_build_their_tiles_again(self):
        made = self.succeed(*self.arguments("land")).json
        os.utime(self.inputs / "part_1.las", (1, 1))
        self.assertEqual(self.succeed(*self.arguments("land")).json["tiles_built"], 0)
        small = self.inputs / "small.las"
        before = tree(self.folder / "land")
        data = bytearray(small.read_bytes())
        data[227 + 26 * 5 + 20] ^= 1  # a colour, far from the ends of a larger file
        small.write_bytes(data)
        done = self.succeed(*self.arguments("land")).json
        self.assertGreater(done["tiles_built"], 0)
        self.assertLess(done["tiles_built"], made["tiles"] - 1)
        self.succeed(*self.arguments("fresh"))
        self.assertEqual(tree(self.folder / "land"), tree(self.folder / "fresh"))
        self.assertNotEqual(tree(self.folder / "land"), before)
        small.unlink()
        fewer = self.succeed(*self.arguments("land")).json
        self.assertLess(fewer["points_stored"], made["points_stored"])

    def surveyed(self, name, *options):
        """Does the steps before the tiles; gives the names of these."""
        step = lambda only: self.succeed(*self.arguments(name, *options, "--only", only))
        step("plan")
        plan = json.loads((self.folder / name / "work/plan.json").read_text())
        for number in range(len(plan["inputs"])):
            step(f"survey:{number}")
        step("settle")
        tiles = json.loads((self.folder / name / "work/tiles.json").read_text())["tiles"]
        return [f"tile:{x}_{y}" for x, y, _ in tiles]

    def test_a_tile_that_failed_is_built_when_its_input_is_mended(self):
        tiles = self.surveyed("land")
        part = self.inputs / "part_1.las"
        whole = part.read_bytes()
        part.write_bytes(whole[:len(whole) // 2] + bytes(len(whole) - len(whole) // 2))
        ends = [pointfront(*self.arguments("land", "--only", tile)) for tile in tiles]
        failed = [end for end in ends if end.status != 0]
        self.assertTrue(failed, "points that were not surveyed are in a tile")
        for end in failed:
            self.assertIn("part_1.las", end.err)
            self.assertIn("has changed since it was surveyed", end.err)
        part.write_bytes(whole)
        done = self.succeed(*self.arguments("land")).json
        self.assertEqual(done["tiles_built"], len(failed))
        self.succeed(*self.arguments("fresh"))
        self.assertEqual(tree(self.folder / "land"), tree(self.folder / "fresh"))

    def test_points_that_are_kept_give_the_same_bytes(self):
        self.succeed(*self.arguments("twice", "--decode", "twice"))
        told = self.succeed(*self.arguments("once", "--decode", "once")).json
        self.assertGreater(told["spilled_bytes"], 12 * told["points_stored"])
        self.assertEqual(tree(self.folder / "once"), tree(self.folder / "twice"))
        self.assertFalse(list((self.folder / "once/work").glob("points-*")))
        # Tiles find them in another process, and do without those that are damaged or cut short.
        tiles = self.surveyed("steps", "--decode", "once")
        kept = sorted((self.folder / "steps/work").glob("points-*.kept"))
        self.assertGreater(len(kept), 3)
        damaged = bytearray(kept[0].read_bytes())
        damaged[len(damaged) // 3] ^= 1
        kept[0].write_bytes(damaged)
        kept[1].write_bytes(kept[1].read_bytes()[:-9])
        for tile in tiles:
            self.succeed(*self.arguments("steps", "--decode", "once", "--only", tile))
        self.succeed(*self.arguments("steps", "--decode", "once", "--only", "collect"))
        self.assertEqual(tree(self.folder / "steps"), tree(self.folder / "twice"))

    def test_steps_of_several_processes_give_the_same_bytes(self):
        self.succeed(*self.arguments("whole"))
        step = lambda name: [TOOL, *map(str, self.arguments("steps", "--only", name))]

        def together(names):
            # Each step twice at once: a worker that is taken for lost may still be at work.
            running = [subprocess.Popen(step(name), stdout=subprocess.PIPE)
                       for name in names for _ in range(2)]
            for process in running:
                process.communicate()
                self.assertEqual(process.returncode, 0)

        together(["plan"])
        plan = json.loads((self.folder / "steps/work/plan.json").read_text())
        together([f"survey:{number}" for number in range(len(plan["inputs"]))])
        together(["settle"])
        tiles = json.loads((self.folder / "steps/work/tiles.json").read_text())["tiles"]
        together([f"tile:{x}_{y}" for x, y, _ in tiles])
        self.succeed(*self.arguments("steps", "--only", "collect"))
        self.assertEqual(tree(self.folder / "steps"), tree(self.folder / "whole"))


if __name__ == "__main__":
    unittest.main()
