"""Names, exit codes and JSON keys that scripts rely on."""

import json
import pathlib
import signal
import subprocess
import unittest

from tool import DATA, SLOWNESS, TOOL, ToolTest, pointfront

SMALL = DATA / "las/version_x_format/las1.2_pf3_10pts.las"
LARGE = DATA / "large/autzen_10653336_rgb_intensity.laz"


class Usage(ToolTest):
    def test_no_command(self):
        self.refuse(2)

    def test_help_and_version_go_to_stdout(self):
        for word in ("--help", "--version"):
            outcome = self.succeed(word)
            self.assertIn("pointfront", outcome.out)
            self.assertEqual(outcome.err, "")
        for command in ("build", "info", "verify", "export"):
            self.assertIn("Usage", self.succeed(command, "--help").out)

    def test_what_is_left_out_is_named_and_refused(self):
        """--version and the error of an option agree, whatever this build leaves out."""
        version = self.succeed("--version").out
        self.assertTrue(version.startswith("pointfront "), version)
        points = self.folder / "p.xyz"
        points.write_text("".join(f"{i % 5} {i // 5} {i % 3}\n" for i in range(50)))
        image = self.folder / "no.tif"
        for option, arguments in {
            "POINTFRONT_NORMALS": ("--normals", "pca"),
            "POINTFRONT_PCL": ("--normals", "pcl"),
            "POINTFRONT_PROJECTION": ("--assume-crs", "EPSG:25832"),
        }.items():
            built = pointfront("build", points, "-o", self.folder / "x.pfront", "--force",
                               *arguments)
            if option in version:
                self.assertEqual(built.status, 1, built)
                self.assertIn("POINTFRONT_", built.err.splitlines()[-1])
                self.assertFalse((self.folder / "x.pfront").exists())
            else:
                self.assertEqual(built.status, 0, built)
                (self.folder / "x.pfront").unlink()
        image.write_bytes(b"")
        said = self.refuse(
            1, "build", points, "-o", self.folder / "x.pfront", "--color-from", image).err
        self.assertEqual("POINTFRONT_IMAGE_COLOR" in said, "POINTFRONT_IMAGE_COLOR" in version)

    def test_unknown_words(self):
        outcome = pointfront("frobnicate")
        self.assertEqual(outcome.status, 2)
        self.assertIn("build", outcome.err)
        self.refuse(2, "build", SMALL, "-o", self.folder / "x.pfront", "--bogus")
        self.refuse(2, "info")
        self.refuse(2, "build", SMALL)

    def refusal(self, *arguments):
        outcome = pointfront(*arguments)
        self.assertIn(outcome.status, (1, 2), outcome)
        self.assertEqual(len(outcome.err.splitlines()), 1, outcome)
        return outcome.err.rstrip()

    def test_misspelt_names_get_the_nearest_one(self):
        store, picture = self.folder / "a.pfront", self.folder / "a.png"
        self.succeed("build", SMALL, "-o", store)
        render = ("render", store, "-o", picture)
        export = ("export", store, "-o", self.folder / "a.csv")
        for meant, arguments in (
                ("render", ("rendr", store)), ("--technique", (*render, "--technque", "splats")),
                ("splats", (*render, "--technique", "slpats")),
                ("balanced", (*render, "--quality", "balnced")),
                ("top", (*render, "--view", "tpo")),
                ("software", (*render, "--backend", "sofware")),
                ("orbit", ("bench", store, "--stats", self.folder / "s", "--path", "orbti")),
                ("octree", ("build", SMALL, "-o", self.folder / "b", "--structure", "octre")),
                ("intensity", (*render, "--color-by", "intensty")),
                ("elevation", (*render, "--color-by", "elevatoin")),
                ("gps_time", (*render, "--where", "gps-tmie > 3")),
                ("gps_time", (*export, "--where", "gps_tme > 3")),
                ("intensity", ("build", SMALL, "-o", self.folder / "b", "--attributes",
                               "intensty"))):
            with self.subTest(arguments=arguments):
                self.assertTrue(self.refusal(*arguments).endswith(f"; did you mean '{meant}'?"),
                                self.refusal(*arguments))
        self.assertNotIn("did you mean", self.refusal(*render, "--technique", "dots"))

    def test_counts_may_be_written_with_an_exponent(self):
        las, store, picture = (self.folder / name for name in ("a.las", "a.pfront", "a.png"))
        self.succeed("generate", "--points", "2e3", "-o", las)
        report = self.succeed("build", las, "-o", store, "--node-points", "1e3", "--json").json
        self.assertEqual(report["points_stored"], 2000)
        self.succeed("index", las, "--node-points", "1e3")
        self.succeed("render", store, "-o", picture, "--point-budget", "1e6", "--frames", "1e1")
        stats = self.folder / "s.json"
        self.succeed("bench", store, "--frames", "1e1", "--stats", stats, "--point-budget", "1e6")
        self.assertEqual(json.loads(stats.read_text())["frames"], 10)
        for arguments in (("generate", "-o", self.folder / "b.las", "--points"),
                          ("render", store, "-o", picture, "--point-budget")):
            self.assertIn("write 2e6", self.refuse(2, *arguments, "2M").err)

    def test_faults_in_json_have_file_line_and_reason(self):
        store = self.folder / "a.pfront"
        self.succeed("build", SMALL, "-o", store)
        area, camera = '{"type":"Polygon",\n"coordinates":', '{"position":[0,0,1],\n"focal_pont":3}'
        for text, arguments, said in (
                ('{\n "default": {"technique": "splats",\n}\n}', ("render", "--style"),
                 "not JSON: line 3, column 1: syntax error"),
                ('{\n "classes": {"6": {\n  "opacity": 2}}\n}', ("render", "--style"),
                 "line 3: classes.6.opacity: expected a number from 0.0 to 1.0, not 2"),
                ('{\n "clases": {}\n}', ("render", "--style"),
                 "line 2: clases: there is no such key"),
                (camera, ("render", "--camera"), "line 2: there is no key 'focal_pont'"),
                (f"[{camera}]", ("bench", "--stats", self.folder / "s.json", "--path"),
                 "camera 0: line 2: there is no key 'focal_pont'"),
                (area + '[[[0,0],[1,"a"],[1,1],[0,0]]]}', ("export", "--polygon"),
                 "line 2: coordinates[0][1] is no position"),
                (area + "[[[0,0}", ("export", "--polygon"), "not JSON: line 2, column ")):
            with self.subTest(text=text):
                file = self.folder / "fault.json"
                file.write_text(text)
                output = {"render": ("-o", self.folder / "a.png"), "bench": (),
                          "export": ("-o", self.folder / "a.csv")}[arguments[0]]
                error = self.refusal(arguments[0], store, *output, *arguments[1:], file)
                self.assertIn(f"{file}: ", error)
                self.assertIn(said, error)

    def test_help_names_values_as_words(self):
        text = self.succeed("build", "--help").out
        self.assertNotIn("\t", text)
        self.assertNotIn(" :{", text)
        self.assertIn("{comma, semicolon, tab, blank}", text)

    def test_wrong_values_are_wrong_usage(self):
        wrong = [
            ("--structure", "rtree"), ("--memory", "12Q"), ("--memory", "0"), ("--threads", "0"),
            ("--threads", "many"), ("--precision", "-1"), ("--node-points", "1"),
            ("--progress", "loud"),
        ]
        for flag in wrong:
            self.refuse(2, "build", SMALL, "-o", self.folder / "x.pfront", *flag)
        for flag in [("--box", "1,2,3"), ("--box", "5,0,0,1,1,1"), ("--classes", "300"),
                     ("--spacing", "0")]:
            self.refuse(2, "export", "store.pfront", "-o", self.folder / "x.las", *flag)
        for name in ("x.e57", "x.foo", "x"):
            self.refuse(2, "export", "store.pfront", "-o", self.folder / name)
        self.assertEqual(self.entries(), [])

    def test_an_option_is_no_value_of_another(self):
        """"--stats --edl" wrote a file that was called --edl, and drew without."""
        store = self.build(SMALL)
        for words in (("render", store, "-o", self.folder / "a.png", "--stats", "--edl"),
                      ("render", store, "--stats", "-o", self.folder / "a.png"),
                      ("export", store, "-o", "--force"),
                      ("collection", "list", "--json", "--epoch", "--json", store)):
            told = self.refuse(2, *words)
            self.assertIn("lacks its value", told.err, words)
        self.assertFalse(pathlib.Path("--edl").exists())

    def test_an_address_is_no_output(self):
        """A folder "s3:" was made, and what was written there seemed to be in a bucket."""
        store = self.build(SMALL)
        before = self.entries()
        for place in ("s3://bucket/a", "http://localhost:9/a", "https://localhost:9/a"):
            for words in (("build", SMALL, "-o", f"{place}.pfront"), ("index", SMALL, "-o", place),
                          ("generate", "--points", "9", "-o", f"{place}.las"),
                          ("export", store, "-o", f"{place}.las"),
                          ("export", store, "-o", self.folder / "a.las", "--stats", place),
                          ("render", store, "-o", f"{place}.png"),
                          ("bench", store, "--stats", f"{place}.json"),
                          ("bench", store, "--stats", "a.json", "--frames-csv", f"{place}.csv"),
                          ("bench", store, "--stats", "a.json", "--picture", f"{place}.png"),
                          ("view", SMALL, "--store", f"{place}.pfront")):
                told = self.refuse(2, *words)
                self.assertIn("is an address", told.err, words)
            told = self.refuse(2, "build", SMALL, "-o", place, "--tiles")
            self.assertIn("python3 -m pointfront cluster build", told.err)
        self.assertEqual(self.entries(), before)
        self.assertFalse(pathlib.Path("s3:").exists() or pathlib.Path("http:").exists())

    def test_an_empty_choice_is_neither_everything_nor_nothing(self):
        store = self.build(SMALL)
        export = ("export", store, "-o", self.folder / "x.las")
        render = ("render", store, "-o", self.folder / "x.png")
        for words, says in (((*export, "--where", ""), "--where: the condition is empty"),
                            ((*export, "--where", "  "), "--where: the condition is empty"),
                            ((*render, "--where", ""), "--where: the condition is empty"),
                            (("build", SMALL, "-o", self.folder / "x.pfront", "--attributes", ""),
                             "--attributes: '' names nothing"),
                            (("build", SMALL, "-o", self.folder / "x.pfront", "--attributes", ","),
                             "--attributes: ',' names nothing"),
                            ((*export, "--classes", ""), "--classes")):
            self.assertIn(says, self.refuse(2, *words).err)
        self.assertEqual(self.entries(), ["cloud.pfront"])

    def test_render_flags(self):
        wrong = [
            ("--size", "big"), ("--view", "below"), ("--error", "0"), ("--point-size", "0"),
            ("--background", "red"), ("--frames", "0"), ("--frames", "3", "--complete"),
            ("--view", "top", "--camera", "c.json"), ("--point-budget", "0"), ("--detail", "both"),
            ("--classes", "300"), ("--classes", "ground"), ("--backend", "vulkan"),
            ("--size", "65536x10"), ("--technique", "dots"), ("--style", "no/such.json"),
            ("--where", "z = 3"),
        ]
        for flag in wrong:
            self.refuse(2, "render", "s.pfront", "-o", self.folder / "x.png", *flag)
        self.refuse(2, "render", "s.pfront", "-o", self.folder / "x.jpg")
        self.refuse(2, "bench", "s.pfront", "--path", "orbit")


class Reports(ToolTest):
    def test_build(self):
        outcome = self.succeed("build", SMALL, "-o", self.folder / "x.pfront", "--json")
        report = outcome.json
        self.assertEqual(set(report), {
            "points_read", "points_stored", "points_rejected", "seconds", "points_per_second",
            "peak_rss_bytes", "bytes_written", "spilled_bytes", "cpu_seconds"})
        self.assertGreater(report["cpu_seconds"]["total"], 0.0)
        self.assertEqual(report["points_read"], 10)
        self.assertEqual(report["points_stored"], 10)
        self.assertEqual(report["points_rejected"], {})
        self.assertEqual(report["spilled_bytes"], 0)
        self.assertEqual(report["bytes_written"], (self.folder / "x.pfront").stat().st_size)
        self.assertGreater(report["peak_rss_bytes"], 1 << 20)
        for key in ("points_per_second", "peak_rss_bytes", "bytes_written"):
            self.assertIsInstance(report[key], int)

    def test_peak_memory_is_the_tools_not_its_parents(self):
        """A program that starts another hands its own peak on to it, by getrusage's count."""
        held = b"x" * (768 << 20)
        report = self.succeed("build", SMALL, "-o", self.folder / "x.pfront", "--json").json
        self.assertLess(report["peak_rss_bytes"], len(held) / 2)

    def test_info(self):
        store = self.build(DATA / "las/real/1.2-with-color.las")
        report = self.succeed("info", store, "--json").json
        keys = {"points", "bounds", "precision", "crs", "structure", "refinement", "nodes",
                "levels", "bytes", "attributes", "layers", "version", "splat_radius"}
        self.assertLessEqual(keys, set(report))
        self.assertEqual(report["points"], 1065)
        self.assertEqual(len(report["bounds"]), 6)
        for axis in range(3):
            self.assertLess(report["bounds"][axis], report["bounds"][axis + 3])
        self.assertEqual(report["splat_radius"], "per node")
        self.assertEqual(report["precision"], 0.01)
        self.assertEqual((report["structure"], report["refinement"]), ("octree", "add"))
        self.assertEqual(report["bytes"], store.stat().st_size)
        attributes = {a["name"]: (a["type"], a["components"]) for a in report["attributes"]}
        self.assertEqual(attributes["intensity"], ("uint16", 1))
        self.assertEqual(attributes["rgb"][1], 3)
        self.assertEqual(sum(layer["points"] for layer in report["layers"]), 1065)
        for layer in report["layers"]:
            self.assertEqual(set(layer), {"class", "name", "points", "nodes"})
        self.assertIn("1065", self.succeed("info", store).out)

    def test_structures_refinements_and_layers(self):
        kinds = [
            (("--structure", "kdtree"), "kdtree", "add"),
            (("--refinement", "replace"), "octree", "replace"),
            (("--layers", "none"), "octree", "add"),
            (("--layers", "class", "--structure", "kdtree"), "kdtree", "add"),
            (("--structure", "kdtree", "--refinement", "replace"), "kdtree", "replace"),
        ]
        for flags, structure, refinement in kinds:
            store = self.build(DATA / "las/real/1.2-with-color.las", *flags, "--force")
            report = json.loads(self.succeed("info", "--json", store).out)
            self.assertEqual((report["structure"], report["refinement"]), (structure, refinement))
            self.assertEqual(report["points"], 1065)
            layers = report["layers"]
            self.assertEqual(sum(layer["points"] for layer in layers), 1065)
            self.assertEqual(sum(layer["nodes"] for layer in layers), report["nodes"])
            if flags[1] == "none":
                self.assertEqual([layer["name"] for layer in layers], ["all"])
            verified = json.loads(self.succeed("verify", "--json", store).out)
            self.assertEqual((verified["ok"], verified["points_checked"]), (True, 1065))

    def test_verify(self):
        store = self.build(SMALL)
        report = self.succeed("verify", store, "--json").json
        self.assertEqual(set(report), {"ok", "nodes_checked", "points_checked", "first_error"})
        self.assertIs(report["ok"], True)
        self.assertEqual(report["points_checked"], 10)
        self.assertIsNone(report["first_error"])

    def test_progress_is_on_stderr(self):
        outcome = self.succeed(
            "build", DATA / "las/real/autzen_trim.las", "-o", self.folder / "x.pfront",
            "--json", "--progress", "json")
        self.assertEqual(outcome.json["points_stored"], 110000)
        reports = [json.loads(line) for line in outcome.err.splitlines()]
        self.assertGreater(len(reports), 0)
        fractions = [report["fraction"] for report in reports]
        self.assertEqual(fractions, sorted(fractions))
        for report in reports:
            self.assertLessEqual({"phase", "done", "total", "fraction", "points_per_second",
                                  "seconds", "seconds_remaining"}, set(report))


    def test_generated_surveys_repeat(self):
        one, two, other = (self.folder / name for name in ("1.las", "2.las", "3.las"))
        self.succeed("generate", "--points", 50000, "-o", one)
        self.succeed("generate", "--points", 50000, "--seed", 24, "-o", two)
        self.succeed("generate", "--points", 50000, "--seed", 2, "-o", other)
        self.assertEqual(one.read_bytes(), two.read_bytes())
        self.assertNotEqual(one.read_bytes(), other.read_bytes())
        report = self.succeed("build", one, "-o", self.folder / "x.pfront", "--json").json
        self.assertEqual(report["points_stored"], 50000)
        self.refuse(2, "generate", "-o", one)
        self.refuse(2, "generate", "--points", 5, "-o", self.folder / "x.foo")
        for seed in ("99999999999999999999", "-1", "2.5"):
            said = self.refuse(2, "generate", "--points", 5, "-o", self.folder / "x.las",
                               f"--seed={seed}").err
            self.assertIn("from 0 to 18446744073709551615", said)
        self.succeed("generate", "--points", 5, "--seed", 2 ** 64 - 1, "-o", self.folder / "x.las")


class Failures(ToolTest):
    def test_missing_inputs(self):
        for words in (("build", "no/such.las", "-o", self.folder / "x.pfront"),
                      ("build", self.folder / "*.las", "-o", self.folder / "x.pfront"),
                      ("build", self.folder, "-o", self.folder / "x.pfront"),
                      ("info", "no/such.pfront"), ("verify", "no/such.pfront"),
                      ("export", "no/such.pfront", "-o", self.folder / "x.las")):
            outcome = self.refuse(1, *words)
            self.assertIn(str(words[1]), outcome.err)
        self.assertEqual(self.entries(), [])

    def test_an_empty_folder_says_what_was_looked_for(self):
        (self.folder / "none").mkdir()
        (self.folder / "none/notes.md").write_text("no points")
        folder, output = self.folder / "none", self.folder / "a.las"
        for command, *rest in (("build", "-o", self.folder / "a.pfront"), ("info",), ("verify",),
                               ("index",), ("export", "-o", output),
                               ("render", "-o", self.folder / "a.png"), ("stream",),
                               ("bench", "--stats", self.folder / "s.json")):
            said = self.refuse(1, command, folder, *rest).err
            self.assertIn(str(folder), said)
            self.assertRegex(said, "names were looked for that end in [.]")
        self.assertEqual(self.entries(), ["none"])

    def test_output_that_cannot_be_written(self):
        store = self.build(SMALL)
        self.refuse(1, "build", SMALL, "-o", "/proc/x.pfront")
        self.refuse(1, "build", SMALL, "-o", self.folder / "none" / "x.pfront")
        self.refuse(1, "export", store, "-o", "/proc/x.las")
        self.refuse(1, "export", store, "-o", self.folder / "none" / "x.xyz")

    def test_a_full_disk_behind_stdout_is_an_error(self):
        store = self.build(SMALL)
        for arguments in (["info", store, "--json"], ["verify", store, "--json"]):
            with open("/dev/full", "w") as full:
                done = subprocess.run([TOOL, *map(str, arguments)], stdout=full,
                                      stderr=subprocess.PIPE, text=True)
            self.assertEqual(done.returncode, 1, arguments)
            self.assertIn("standard output", done.stderr)

    def test_existing_output_is_kept_unless_forced(self):
        store = self.build(SMALL)
        before = store.read_bytes()
        outcome = self.refuse(1, "build", DATA / "las/real/1.2-with-color.las", "-o", store)
        self.assertIn("--force", outcome.err)
        self.assertEqual(store.read_bytes(), before)
        self.succeed("build", DATA / "las/real/1.2-with-color.las", "-o", store, "--force")
        self.assertEqual(self.succeed("info", store, "--json").json["points"], 1065)
        self.assertEqual(self.entries(), ["cloud.pfront"])

    def test_an_input_is_never_the_output(self):
        copy = self.folder / "cloud.las"
        copy.write_bytes(SMALL.read_bytes())
        self.refuse(1, "build", copy, "-o", copy, "--force")
        self.assertEqual(copy.read_bytes(), SMALL.read_bytes())

    def test_what_is_no_store(self):
        self.refuse(1, "verify", SMALL)
        report = pointfront("verify", SMALL, "--json").json
        self.assertIs(report["ok"], False)

    def test_broken_store(self):
        store = self.build(DATA / "las/real/autzen_trim.las")
        whole = store.read_bytes()
        store.write_bytes(whole[: len(whole) // 2])
        self.refuse(1, "info", store)
        self.refuse(1, "verify", store)
        broken = bytearray(whole)
        broken[len(whole) // 2] ^= 0x10
        store.write_bytes(broken)
        outcome = pointfront("verify", store, "--json")
        self.assertEqual(outcome.status, 1)
        self.assertIs(outcome.json["ok"], False)
        self.assertIn("node", outcome.json["first_error"])
        self.refuse(1, "verify", store)
        self.refuse(1, "export", store, "-o", self.folder / "x.las")
        self.assertEqual(self.entries(), ["cloud.pfront"])

    def test_a_folder_is_one_cloud(self):
        (self.folder / "tiles/deeper").mkdir(parents=True)
        (self.folder / "tiles/a.LAS").write_bytes(SMALL.read_bytes())
        (self.folder / "tiles/deeper/b.las").write_bytes(SMALL.read_bytes())
        (self.folder / "tiles/notes.txt").write_text("not a point file")
        report = self.succeed(
            "build", self.folder / "tiles", "-o", self.folder / "x.pfront", "--json").json
        self.assertEqual(report["points_stored"], 20)


class Interruption(ToolTest):
    def interrupt(self, number, *arguments):
        """Sends the signal after the first sign of progress."""
        process = subprocess.Popen(
            [TOOL, *map(str, arguments), "--progress", "json"],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.assertTrue(process.stderr.readline(), "no progress before the end")
        process.send_signal(number)
        _, err = process.communicate(timeout=600 * SLOWNESS)
        self.assertEqual(process.returncode, 130, err)

    def test_build_leaves_nothing(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            (self.folder / "spill").mkdir(exist_ok=True)
            self.interrupt(number, "build", LARGE, "-o", self.folder / "x.pfront",
                           "--memory", "128M", "--temp", self.folder / "spill")
            self.assertEqual(self.entries(), ["spill"])
            self.assertEqual(list((self.folder / "spill").iterdir()), [])

    def test_build_keeps_what_was_there(self):
        store = self.build(SMALL)
        before = store.read_bytes()
        self.interrupt(signal.SIGINT, "build", LARGE, "-o", store, "--force")
        self.assertEqual(store.read_bytes(), before)
        self.assertEqual(self.entries(), ["cloud.pfront"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
