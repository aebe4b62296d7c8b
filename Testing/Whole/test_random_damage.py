"""Damaged files of every kind: a run of the tool works or ends with an error in one line, in
bounded time and memory, and leaves nothing behind. POINTFRONT_RANDOM_COUNT and
POINTFRONT_RANDOM_FIRST choose how many damages of each kind there are, and the first one's seed.
A damage that is not taken well is printed with its seed and kind; the file stays in the working
folder.
"""

import json
import os
import pathlib
import random
import resource
import shutil
import struct
import subprocess
import unittest

from tool import DATA, SLOWNESS, TOOL, ToolTest

COUNT = int(os.environ.get("POINTFRONT_RANDOM_COUNT", 6))
FIRST = int(os.environ.get("POINTFRONT_RANDOM_FIRST", 1))
TIMEOUT_S = 30 * SLOWNESS  # a run that takes longer hangs
MEMORY = 4 << 30  # address space: a lying count may not ask for so much
HEAD = 1200  # bytes in which headers lie
EXTREME = [struct.pack(*value) for value in (
    ("<d", float("nan")), ("<d", float("inf")), ("<d", -1e308), ("<d", 1e50), ("<d", 0.0),
    ("<d", 5e-324), ("<I", 0), ("<I", 0xffffffff), ("<I", 0x80000000), ("<I", 0x7fffffff),
    ("<Q", 1 << 63), ("<Q", (1 << 63) - 1), ("<Q", 1 << 32), ("<H", 0xffff), ("<B", 0xff))]
WORDS = (b"nan", b"-inf", b"1e999", b"-1", b"99999999999999999999", b"", b"\0", b"\xff\xfe", b"0.0")


def somewhere(chance, length):
    """In the head as often as in all that follows."""
    return chance.randrange(min(length, HEAD) if chance.random() < 0.5 else length)


def flip(chance, data):
    for _ in range(chance.choice((1, 1, 3, 20))):
        data[somewhere(chance, len(data))] ^= 1 << chance.randrange(8)


def run_of(chance, data):
    at, length = somewhere(chance, len(data)), chance.choice((4, 40, 400, 4000))
    data[at:at + length] = bytes([chance.choice((0, 0xff, 0x20))]) * len(data[at:at + length])


def cut(chance, data):
    del data[chance.randrange(len(data)):]


def take_out(chance, data):
    at = somewhere(chance, len(data))
    del data[at:at + chance.choice((1, 8, 100, 5000))]


def repeat(chance, data):
    at, to = somewhere(chance, len(data)), somewhere(chance, len(data))
    data[to:to] = data[at:at + chance.choice((1, 8, 100, 5000))]


def number(chance, data):
    value, at = chance.choice(EXTREME), somewhere(chance, len(data))
    data[at:at + len(value)] = value


def word(chance, data):
    """Another number in a line of text."""
    digits = [at for at in range(min(len(data), 4000)) if chr(data[at]) in "0123456789.-"]
    if digits:
        at = chance.choice(digits)
        data[at:at + chance.choice((1, 3, 9))] = chance.choice(WORDS)


DAMAGES = (flip, run_of, cut, take_out, repeat, number, word)


def damaged(chance, path):
    data = bytearray(path.read_bytes())
    for _ in range(chance.choice((1, 1, 2))):
        if data:
            chance.choice(DAMAGES)(chance, data)
    path.write_bytes(data)


def reading(chance, target, out):
    """A command that reads the damaged file."""
    return chance.choice((
        ["info", target], ["info", target, "--stats"], ["info", target, "--json"],
        ["info", target, "--stats", "--json"], ["verify", target], ["verify", target, "--json"],
        ["build", target, "-o", out / "new.pfront"],
        ["build", target, "-o", out / "new.pfront", "--on-error", "skip"],
        ["build", target, "-o", out / "new.pfront", "--memory", "64M", "--structure", "kdtree"],
        ["render", target, "-o", out / "new.png", "--size", "160x120"],
        ["export", target, "-o", out / "new.las"], ["export", target, "-o", out / "new.ply"]))


class RandomDamage(ToolTest):
    def kinds(self):
        """A folder for each kind: the file to open, and the files to damage."""
        whole = self.folder / "whole"
        whole.mkdir()
        small = DATA / "classified/test_semis_2023_0292_6833_LA93_IGN69.laz"
        survey = whole / "survey.las"
        self.succeed("generate", "--points", 3000, "-o", survey)
        made = {"las": survey}
        for kind in ("laz", "ply", "pcd", "csv"):
            store = whole / "of.pfront"
            self.succeed("build", survey, "-o", store, "--force")
            made[kind] = whole / f"survey.{kind}"
            self.succeed("export", store, "-o", made[kind])
        for name, options in (("octree", []), ("replace", ["--refinement", "replace"]),
                              ("kdtree", ["--structure", "kdtree", "--layers", "class"])):
            made[f"store_{name}"] = whole / f"{name}.pfront"
            store = made[f"store_{name}"]
            self.succeed("build", survey, "-o", store, "--node-points", 256, *options)
        made["laz_1.4"] = small
        made["copc"] = DATA / "copc/lone-star.copc.laz"
        folders = {kind: self.kind(kind, path) for kind, path in made.items()}
        index = self.folder / "index"
        index.mkdir()
        shutil.copy(survey, index)
        self.succeed("index", index / "survey.las")
        side = next(path for path in index.iterdir() if path.suffix == ".pfindex")
        folders["index"] = (index, side, [side])
        folders["indexed"] = (index, side, [index / "survey.las"])
        tree = self.folder / "ept"
        shutil.copytree(DATA / "ept/lone-star-laszip", tree)
        parts = [path for path in tree.rglob("*") if path.is_file()]
        heads = [path for path in parts if path.suffix == ".json"]
        folders["ept"] = (tree, tree / "ept.json", heads)
        folders["ept_data"] = (tree, tree / "ept.json", [p for p in parts if p.suffix == ".laz"])
        return folders

    def kind(self, name, path):
        folder = self.folder / f"kind_{name}"
        folder.mkdir()
        copy = folder / path.name
        shutil.copyfile(path, copy)
        return folder, copy, [copy]

    def limited(self, run):
        def limit():
            if SLOWNESS == 1:  # AddressSanitizer's shadow is larger than any limit
                resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        return subprocess.run([TOOL, *map(str, run)], stdin=subprocess.DEVNULL, check=False,
                              capture_output=True, timeout=TIMEOUT_S, preexec_fn=limit)

    def taken_well(self, run, out):
        try:
            ended = self.limited(run)
        except subprocess.TimeoutExpired:
            self.fail("it hangs")
        said = ended.stderr.decode(errors="replace")
        self.assertIn(ended.returncode, (0, 1, 2), said)
        if "--json" in run and ended.stdout:
            json.loads(ended.stdout)
        left = sorted(entry.name for entry in out.iterdir())
        if ended.returncode != 0:
            self.assertEqual(left, [])
            if run[0] != "verify" or said:  # which prints the first fault as its result
                self.assertIn(f"pointfront {run[0]}: ", (said.splitlines() or [""])[-1])
        else:
            self.assertLessEqual(set(left), {pathlib.Path(str(part)).name for part in run})
            if "new.pfront" in left:
                self.succeed("verify", out / "new.pfront")

    def test_a_damaged_file_is_read_or_refused(self):
        out = self.folder / "out"
        out.mkdir()
        for kind, (folder, target, parts) in self.kinds().items():
            sound = self.folder / f"sound_{kind}"
            shutil.copytree(folder, sound)
            for seed in range(FIRST, FIRST + COUNT):
                chance = random.Random(f"{kind} {seed}")
                part = chance.choice(parts)
                damaged(chance, part)
                run = reading(chance, target, out)
                with self.subTest(kind=kind, seed=seed, run=" ".join(map(str, run))):
                    self.taken_well(run, out)
                shutil.copyfile(sound / part.relative_to(folder), part)
                for entry in out.iterdir():
                    entry.unlink()


if __name__ == "__main__":
    unittest.main()
