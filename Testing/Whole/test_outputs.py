"""Some outputs may be written over; others never are."""

import os
import pathlib
import shutil
import unittest

from tool import DATA, ToolTest, pointfront, write_las

SMALL = DATA / "las/real/1.2-with-color.las"
POINTS = 1065


class Outputs(ToolTest):
    def copy(self, name="a.las"):
        path = self.folder / name
        shutil.copyfile(SMALL, path)
        return path

    def kept(self, paths, *arguments):
        """The run is refused, also with --force, and no byte of these files is another."""
        before = [path.read_bytes() for path in paths]
        for force in ([], ["--force"]):
            if force and arguments[0] in ("render", "bench"):
                continue
            self.refuse(1, *arguments, *force)
            self.assertEqual([path.read_bytes() for path in paths], before, arguments)

    def aliases(self, path):
        """The path itself, by another spelling, a symbolic and a hard link."""
        folder = self.folder / "sub"
        folder.mkdir(exist_ok=True)
        soft, hard = folder / f"soft{path.suffix}", folder / f"hard{path.suffix}"
        soft.symlink_to(path)
        os.link(path, hard)
        return [path, folder / ".." / path.name, soft, hard]

    def test_an_export_keeps_the_file_behind_its_index(self):
        las = self.copy()
        self.succeed("index", las)
        side = self.folder / "a.las.pfindex"
        for target in self.aliases(las):
            self.kept([las, side], "export", side, "-o", target, "--classes", "2")
        self.assertEqual(self.succeed("info", side, "--json").json["points"], POINTS)

    def test_a_build_keeps_its_inputs(self):
        las = self.copy()
        for target in self.aliases(las):
            self.kept([las], "build", las, "-o", target)
        system = self.folder / "system.wkt"
        system.write_text("EPSG:25832")
        self.kept([las, system], "build", las, "-o", system, "--crs", system,
                  "--assume-crs", "EPSG:25832")

    def test_files_with_likely_temporary_names_are_kept(self):
        las = self.copy()
        store = self.build(las)
        mine = []

        def likely(path):
            for name in (f"{path}.tmp", f"{path}.next", f"{path}.part", f"{path}.0.tmp",
                         f"{path}.{0:016x}-{0:016x}.tmp"):
                mine.append(pathlib.Path(name))
                mine[-1].write_text("mine")
            return path
        self.succeed("build", las, "-o", likely(self.folder / "new.pfront"))
        self.succeed("index", las, "-o", likely(self.folder / "new.pfindex"))
        for kind in ("las", "laz", "xyz", "csv", "ply", "pcd"):
            self.succeed("export", store, "-o", likely(self.folder / f"out.{kind}"))
        self.succeed("render", store, "-o", likely(self.folder / "a.png"), "--size", "64x48",
                     "--stats", likely(self.folder / "a.json"))
        self.assertEqual({path.read_text() for path in mine}, {"mine"})

    def test_an_index_keeps_its_input(self):
        las = self.copy()
        for target in self.aliases(las):
            self.kept([las], "index", las, "-o", target)

    def test_a_target_of_another_kind_is_kept(self):
        las = self.copy()
        store = self.build(las)
        self.succeed("index", las)
        side = self.folder / "a.las.pfindex"
        text = self.folder / "notes.txt"
        text.write_text("my notes\n")
        camera = self.folder / "camera.json"
        camera.write_text('{"position": [0, 0, 0]}')
        other = self.copy("other.las")
        for target in (other, side, text, camera):
            self.kept([target], "build", las, "-o", target)
        for target in (other, store, text, camera):
            self.kept([target], "index", las, "-o", target)
        for kind in ("las", "laz", "xyz", "ply", "pcd"):
            for there in (store, side, camera):
                target = self.folder / f"there.{kind}"
                shutil.copyfile(there, target)
                self.kept([target], "export", store, "-o", target)
                self.kept([target], "generate", "--points", 10, "-o", target)
        wrong = self.folder / "las.xyz"
        shutil.copyfile(las, wrong)
        self.kept([wrong], "export", store, "-o", wrong)
        folder = self.folder / "folder.las"
        folder.mkdir()
        self.assertIn("folder", self.refuse(1, "export", store, "-o", folder, "--force").err)

    def test_a_name_says_what_a_file_is(self):
        las = self.copy()
        store = self.build(las)
        names = self.entries()
        for name in ("b.las", "b.laz", "b.ply", "b.csv", "b.pfindex"):
            said = self.refuse(1, "build", las, "-o", self.folder / name,
                               "--assume-crs", "EPSG:2154").err
            self.assertIn(".pfront", said)
        self.assertIn(".pfindex", self.refuse(1, "index", las, "-o", self.folder / "b.las").err)
        said = self.refuse(2, "export", store, "--copc", self.folder / "b.laz").err
        self.assertIn(".copc.laz", said)
        self.assertEqual(self.entries(), names)

    def test_an_option_that_would_do_nothing_is_refused(self):
        las = self.copy()
        store = self.build(las)
        for option, value in (("--columns", "x,y,z"), ("--decimal", "comma"),
                              ("--separator", "tab"), ("--skip", 3)):
            said = self.refuse(1, "build", las, "-o", self.folder / "x.pfront", option, value).err
            self.assertIn(f"{option}: is for text files", said)
        said = self.refuse(2, "bench", store, "--stats", self.folder / "s.json",
                           "--frame-ms", 10).err
        self.assertIn("--interactive", said)
        for file in (las, store):
            self.assertIn("is no collection", self.refuse(1, "info", file, "--epoch", "a").err)
        for kind in ("csv", "las", "ply"):
            out = self.folder / f"d.{kind}"
            self.assertIn("PCD", self.refuse(2, "export", store, "-o", out, "--double").err)
        self.assertIn("--stats", self.refuse(2, "info", store, "--memory", "10M").err)

    def test_light_that_nothing_can_have_is_told(self):
        store = self.build(self.copy())
        picture = ("-o", self.folder / "p.png", "--size", "40x40", "--lit")
        self.assertIn("no point has a normal", self.succeed("render", store, *picture).err)
        said = self.succeed("render", store, *picture, "--technique", "spheres").err
        self.assertNotIn("normal", said)

    def test_a_file_with_its_index_beside_it(self):
        las = self.copy()
        self.succeed("index", las)
        said = self.refuse(1, "render", las, "-o", self.folder / "x.png").err
        self.assertIn(f"'{las}.pfindex'", said)

    def test_a_made_up_survey_has_every_class(self):
        las = self.folder / "made.las"
        self.succeed("generate", "--points", 300000, "-o", las)
        found = self.succeed("info", las, "--stats", "--json").json["stats"]["classes"]
        self.assertEqual({entry["name"] for entry in found},
                         {"ground", "low vegetation", "high vegetation", "building", "water"})

    def test_force_replaces_what_is_of_the_same_kind(self):
        las = self.copy()
        store = self.build(las)
        self.assertIn("--force", self.refuse(1, "build", las, "-o", store).err)
        self.succeed("build", las, "-o", store, "--force")
        self.succeed("index", las)
        self.assertIn("--force", self.refuse(1, "index", las).err)
        self.succeed("index", las, "--force")
        for kind in ("las", "laz", "xyz", "ply", "pcd"):
            out = self.folder / f"out.{kind}"
            for command in (["export", store], ["generate", "--points", 10]):
                self.succeed(*command, "-o", out, "--force")
                before = out.read_bytes()
                self.assertIn("--force", self.refuse(1, *command, "-o", out).err)
                self.assertEqual(out.read_bytes(), before)
        reserved = self.folder / "reserved.las"  # as mktemp makes it
        reserved.touch()
        self.succeed("export", store, "-o", reserved, "--force")

    def test_pictures_and_statistics(self):
        las = self.copy()
        store = self.build(las)
        self.succeed("index", las)
        side = self.folder / "a.las.pfindex"
        png, stats = self.folder / "x.png", self.folder / "x.json"
        draw = ["render", side, "--size", "64x64"]
        for _ in range(2):  # the second time over the first
            self.succeed(*draw, "-o", png, "--stats", stats)
        camera = self.folder / "camera.json"
        camera.write_text('{"position":[0,0,9],"focal_point":[0,0,0],"view_up":[0,1,0],'
                          '"view_angle":30}')
        mine = [las, store, side, camera]
        for target in mine:
            picture = self.folder / f"{target.name}.png"  # pictures must be called so
            os.link(target, picture)
            self.kept(mine, *draw, "-o", png, "--stats", target)
            self.kept(mine, *draw, "-o", picture, "--stats", stats)
            self.kept(mine, "bench", side, "--frames", 2, "--stats", target)
            self.kept(mine, "bench", side, "--frames", 2, "--stats", stats, "--frames-csv", target)
            self.kept(mine, "bench", side, "--frames", 2, "--stats", stats, "--picture", picture)
        self.kept([png, stats], *draw, "-o", png, "--stats", png)
        both = self.folder / "y.png"
        self.refuse(1, *draw, "-o", both, "--stats", both)
        frames = self.folder / "frames.csv"
        for _ in range(2):
            self.succeed("bench", store, "--frames", 2, "--size", "64x64", "--stats", stats,
                         "--frames-csv", frames, "--picture", png)

    def test_pictures_without_points_and_strange_company(self):
        store = self.build(self.copy())
        png = self.folder / "x.png"
        away = self.folder / "away.json"
        away.write_text('{"position":[0,0,0],"focal_point":[0,0,9],"view_up":[0,1,0],'
                        '"view_angle":30}')
        draw = ("--size", "64x64", "-o", png)
        self.assertIn("no point", self.refuse(1, "render", store, "--camera", away, *draw).err)
        self.assertFalse(png.exists())
        near = self.folder / "near.json"  # closer than the points to each other: all are drawn
        near.write_text('{"position":[637000,851000,460],"focal_point":[637001,851100,430],'
                        '"view_up":[0,0,1],"view_angle":80}')
        outcome = self.succeed("render", store, "--camera", near, *draw)
        self.assertEqual(outcome.err, "")

        def placed(name, x, *options):
            las = write_las(self.folder / f"{name}.las", [
                (x + i, 5600000.0 + i % 7, 100.0, 0, 0, 0) for i in range(100)])
            self.succeed("build", las, "-o", self.folder / f"{name}.pfront", *options)
            return self.folder / f"{name}.pfront"

        here = placed("here", 500000.0, "--assume-crs", "EPSG:25832")
        far = placed("far", 600000.0, "--assume-crs", "EPSG:25832")
        other = placed("other", 500010.0, "--assume-crs", "EPSG:32633")
        beside = placed("beside", 500110.0, "--assume-crs", "EPSG:25832")
        # Too far to see anything: no picture, and the reason before.
        self.assertIn("far.pfront lies", pointfront("render", here, far, *draw).err)
        self.assertIn("other.pfront is in another", self.succeed("render", here, other, *draw).err)
        self.assertEqual(self.succeed("render", here, beside, *draw).err, "")


if __name__ == "__main__":
    unittest.main(verbosity=2)
