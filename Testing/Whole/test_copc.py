"""`export` to COPC: sound by the specification, and every point once, as it was."""

import os
import random
import re
import signal
import struct
import subprocess
import sys
import unittest

from copc_file import CopcFile
from tool import DATA, SLOWNESS, TOOL, ToolTest, run, write_las

CLOUDS = {  # a cloud and the point format that it needs
    "classified/lidarhd_rgb_nir_698k.laz": 8,
    "las/real/autzen_trim.las": 7,
    "las/real/test1_4.las": 6,
    "las/real/extrabytes.las": 7,
}
NAMES = ("intensity", "classification", "gps_time", "return_number", "return_count", "user_data",
         "point_source_id")


class Publish(ToolTest):
    def publish(self, cloud, *options, name="out.copc.laz"):
        """Its COPC, which is sound."""
        out = self.folder / name
        self.succeed("export", cloud, "-o", out, *options)
        file = CopcFile(out)
        self.assertEqual(file.faults, [])
        return out, file

    def expect_same(self, one, other, points, *names):
        compared = run(os.environ["POINTFRONT_COMPARE_POINTS"], one, other, *names)
        self.assertEqual(compared.status, 0, compared)
        self.assertEqual(int(compared.out), points)

    def test_every_point_of_every_format(self):
        for number, (cloud, form) in enumerate(CLOUDS.items()):
            store = self.build(DATA / cloud, name=f"{number}.pfront")
            out, file = self.publish(store, name=f"{number}.copc.laz")
            self.assertEqual(file.format, form, cloud)
            told = self.succeed("info", store, "--json").json
            names = [n for n in NAMES if n in [a["name"] for a in told["attributes"]]]
            names += ["rgb"] if form > 6 else []
            for some in (names[::2], names[1::2]):  # a record of the program has 20 bytes for them
                self.expect_same(DATA / cloud, out, told["points"], *some)
            self.assertEqual(
                self.succeed("verify", out, "--json").json["points_checked"], told["points"])
            for axis in range(3):
                self.assertAlmostEqual(file.low[axis], told["bounds"][axis], 6)
                self.assertAlmostEqual(file.high[axis], told["bounds"][axis + 3], 6)

    def test_of_every_kind_of_cloud(self):
        las = DATA / "las/real/autzen_trim.las"
        kinds = ("--structure", "kdtree"), ("--layers", "class"), ("--node-points", "700")
        # For a sanitizer the export of one tree is that of another.
        for number, options in enumerate(kinds if SLOWNESS == 1 else kinds[:1]):
            store = self.folder / f"{number}.pfront"
            self.succeed("build", las, "-o", store, *options)
            out, _ = self.publish(store, name=f"{number}.copc.laz")
            self.expect_same(las, out, 110000, "intensity", "classification", "rgb")
        copy = self.folder / "autzen.las"
        copy.write_bytes(las.read_bytes())
        self.succeed("index", copy)
        out, _ = self.publish(f"{copy}.pfindex", name="index.copc.laz")
        self.expect_same(las, out, 110000, "intensity", "classification", "rgb")
        trees = "ept/lone-star-laszip", "copc/lone-star.copc.laz"
        for number, cloud in enumerate(trees if SLOWNESS == 1 else trees[:1]):
            out, file = self.publish(DATA / cloud, name=f"again{number}.copc.laz")
            plain = self.folder / f"{number}.las"
            self.succeed("export", DATA / cloud, "-o", plain)
            self.expect_same(plain, out, 518862, "intensity", "gps_time")
            self.assertIn(("LASF_Projection", 2112), file.records)

    def test_colours_of_8_bits_are_built_as_those_of_a_las_file(self):
        clouds = {}
        for name, first, colour in (("dark", 0.0, (200, 0, 100)), ("wide", 50.0, (40000, 7, 300))):
            las = write_las(self.folder / f"{name}.las",
                            [(first + x, float(y), 0.0, *colour) for x in range(20)
                             for y in range(20)])
            store = self.folder / f"{name}.pfront"
            self.succeed("build", las, "-o", store, "--color-depth", "16")
            clouds[name] = las, self.publish(store, name=f"{name}.copc.laz")[0], store
        ends = {}
        listed = self.folder / "both.pfronts"
        listed.write_text("".join(f"{clouds[name][1]}\n" for name in clouds))
        both = self.folder / "both.pfront"
        for kind, number in (("las", 0), ("copc", 1), ("store", 2)):
            inputs = [files[number] for files in clouds.values()]
            self.succeed("build", *inputs, "-o", both, "--force")
            ends[kind] = self.colours(both)
            self.succeed("build", inputs[0], "-o", both, "--force")
            ends[f"dark {kind}"] = self.colours(both)
        self.succeed("build", listed, "-o", both, "--force")
        ends["list"] = self.colours(both)
        wide = {(200 * 257, 0, 100 * 257), (40000, 7, 300)}
        dark = {(200, 0, 100)}
        self.assertEqual(ends, {
            "las": wide, "dark las": dark, "copc": wide, "dark copc": dark, "list": wide,
            # Whoever built it said that it has 16 bits.
            "store": {(200, 0, 100), (40000, 7, 300)}, "dark store": dark})

    def colours(self, cloud):
        out = self.folder / "colours.csv"
        self.succeed("export", cloud, "-o", out, "--force")
        with open(out, encoding="ascii") as file:
            names = file.readline().strip().split(",")
            red = names.index("red")
            return {tuple(map(int, line.split(",")[red:red + 3])) for line in file}

    def test_memory_changes_no_byte(self):
        store = self.build(DATA / "copc/lone-star.copc.laz")
        dated = dict(os.environ, SOURCE_DATE_EPOCH="86400")
        one, two = self.folder / "one.copc.laz", self.folder / "two.copc.laz"
        self.succeed("export", store, "-o", one, environment=dated)
        self.succeed("export", store, "--copc", two, "--memory", "20M", "--temp", self.folder,
                     environment=dated)
        self.assertEqual(one.read_bytes(), two.read_bytes())
        self.assertEqual(self.entries(), ["cloud.pfront", "one.copc.laz", "two.copc.laz"])

    def peak(self, *arguments):
        """Bytes of memory that a run took, which worked."""
        # A child's peak is never below its parent's memory: a bare interpreter is a small parent.
        started = ("import os, sys; child = os.posix_spawn(sys.argv[1], sys.argv[1:], os.environ); "
                   "_, status, used = os.wait4(child, 0); print(status, used.ru_maxrss)")
        said = subprocess.run([sys.executable, "-I", "-S", "-c", started, TOOL,
                               *map(str, arguments)], capture_output=True, text=True, check=True)
        status, kibibytes = map(int, said.stdout.split()[-2:])
        self.assertEqual(status, 0)
        return kibibytes * 1024

    def test_memory_is_kept_or_refused(self):
        """A run takes what the program takes without points, and at most --memory."""
        las = self.folder / "made.las"  # twice as large as the larger memory below
        self.succeed("generate", "--points", 3000000 if SLOWNESS == 1 else 100000, "-o", las)
        store = self.build(las)
        las.unlink()
        out = self.folder / "out.copc.laz"
        said = self.refuse(1, "export", store, "--copc", out, "--memory", "1M").err
        least = int(re.search(r"at least (\d+) KiB", said)[1])
        self.refuse(1, "export", store, "--copc", out, "--memory", (least - 1) * 1024)
        self.assertEqual(self.entries(), ["cloud.pfront"])
        if SLOWNESS > 1:
            return  # a sanitizer keeps what the program frees
        empty = self.peak("export", store, "--copc", out, "--box", "0,0,0,1,1,1")
        for memory in (least * 1024, 48 << 20):
            taken = self.peak("export", store, "--copc", out, "--memory", memory, "--force")
            self.assertLess(taken, empty + memory)

    def test_a_part(self):
        store = self.build(DATA / "las/real/autzen_trim.las")
        x0, y0, z0, x1, y1, z1 = self.succeed("info", store, "--json").json["bounds"]
        box = f"{x0},{y0},{z0},{(x0 + x1) / 2},{(y0 + y1) / 2},{z1}"
        part = self.folder / "part.las"
        self.succeed("export", store, "-o", part, "--box", box, "--classes", "2")
        out, file = self.publish(store, "--box", box, "--classes", "2")
        self.expect_same(part, out, file.points, "intensity")
        self.assertLess(file.high[0], (x0 + x1) / 2 + 0.01)

    def test_no_point_and_one(self):
        one = write_las(self.folder / "one.las", [(5.0, 6.0, 7.0, 1, 2, 3)])
        store = self.build(one, name="one.pfront")
        out, file = self.publish(store, name="one.copc.laz")
        self.assertEqual([points for _, _, points in file.nodes.values()], [1])
        self.expect_same(one, out, 1, "rgb")
        out = self.folder / "none.copc.laz"
        self.succeed("export", store, "-o", out, "--box", "0,0,0,1,1,1")
        file = CopcFile(out)
        self.assertEqual(file.faults, [])
        self.assertEqual(list(file.nodes.values()), [(0, 0, 0)])

    def test_all_points_in_one_place_and_far_ones(self):
        same = [(1.0, 2.0, 3.0, i % 256, 0, 0) for i in range(70000)]
        las = write_las(self.folder / "same.las", same)
        out, file = self.publish(self.build(las, name="same.pfront"), name="same.copc.laz")
        self.expect_same(las, out, 70000, "rgb")
        draw = random.Random(30)
        far = [(draw.uniform(0, 1e7), draw.uniform(0, 1e7), draw.uniform(0, 100), 0, 0, 0)
               for _ in range(60000)]
        far += [(5e6 + draw.uniform(0, 50), 5e6 + draw.uniform(0, 50), 1.0, 0, 0, 9)
                for _ in range(60000)]
        las = write_las(self.folder / "far.las", far)
        out, file = self.publish(self.build(las, name="far.pfront"), name="far.copc.laz")
        self.expect_same(las, out, 120000, "rgb")
        self.assertGreater(len(file.levels()), 10)

    def test_names_and_options(self):
        store = self.build(DATA / "las/real/test1_4.las")
        self.refuse(2, "export", store, "--copc", self.folder / "x.laz")
        self.refuse(2, "export", store, "-o", self.folder / "x.las", "--memory", "1G")
        self.refuse(2, "export", store)
        self.refuse(2, "export", store, "-o", self.folder / "x.las", "--copc",
                    self.folder / "x.copc.laz")
        self.publish(store)
        self.refuse(1, "export", store, "-o", self.folder / "out.copc.laz")
        self.publish(store, "--force")

    def test_a_signal_and_a_full_disk_leave_nothing(self):
        store = self.build(DATA / "copc/lone-star.copc.laz")
        out = self.folder / "out.copc.laz"
        for signalled in (signal.SIGINT, signal.SIGTERM):
            with subprocess.Popen([TOOL, "export", store, "-o", out, "--progress", "json"],
                                  stderr=subprocess.PIPE, stdout=subprocess.PIPE) as running:
                running.stderr.readline()  # the first sign of progress: it has begun
                running.send_signal(signalled)
                running.communicate()
            self.assertIn(running.returncode, (130, 0))
            if running.returncode == 130:
                self.assertEqual(self.entries(), ["cloud.pfront"])
            out.unlink(missing_ok=True)
        for blocks in (0, 100, 2000):
            limited = run("/bin/sh", "-c",
                          f"ulimit -f {blocks}; trap '' XFSZ; '{TOOL}' export '{store}' -o '{out}'"
                          " --memory 20M")
            self.assertEqual(limited.status, 1, limited)
            self.assertEqual(self.entries(), ["cloud.pfront"])

    def test_nodes_have_a_size_to_fetch_and_levels_a_share(self):
        """Against the file that another program wrote of the same points."""
        out, file = self.publish(DATA / "copc/lone-star.copc.laz")
        self.assertLess(max(points for _, _, points in file.nodes.values()), 100000)
        root = file.nodes[(0, 0, 0, 0)][2]
        self.assertGreater(root, 5000)
        self.assertLess(root, 60000)
        self.assertLess(out.stat().st_size,
                        1.1 * (DATA / "copc/lone-star.copc.laz").stat().st_size)


if __name__ == "__main__":
    unittest.main(verbosity=2)
