"""Collections are whole or as they were, whatever happens to them and to those who write."""

import os
import pathlib
import random
import resource
import signal
import subprocess
import time
import unittest

from collection_test import CollectionTest
from tool import SLOWNESS, TOOL, spent_by_children

KILLS = int(os.environ.get("POINTFRONT_KILLS", "60" if SLOWNESS == 1 else "10"))


def spent_by(process):
    """Processor seconds of the first thread of a process so far; infinite once it has ended."""
    try:
        nanoseconds = pathlib.Path(f"/proc/{process.pid}/schedstat").read_text().split()[0]
    except (OSError, IndexError):
        return float("inf")
    return 1e-9 * int(nanoseconds)


class CollectionSafety(CollectionTest):
    def test_a_damaged_collection_is_told_what_mends_it(self):
        store = self.tile(0)
        self.collection("create", self.city, store)
        sound = self.city.read_bytes()
        for at, commands, mends in (
                (len(sound) // 2, (("collection", "verify"),), ("compact", self.city)),
                (len(sound) - 100, (("collection", "verify"), ("info",), ("verify",)),
                 ("create", self.city, store, "--force"))):
            damaged = bytearray(sound)
            damaged[at] ^= 0xff
            self.city.write_bytes(damaged)
            for words in commands:
                said = self.refuse(1, *words, self.city)
                self.assertIn("is damaged", said.err)
                self.assertIn("pointfront collection compact, or create", said.err)
                self.assertNotIn("build the store again", said.err)
            self.collection(*mends)
            self.assertTrue(self.collection("verify", self.city)["ok"])

    def test_a_full_disk_leaves_the_state_before(self):
        tiles = [self.tile(number) for number in range(4)]
        self.collection("create", self.city, *tiles[:3])
        before = self.city.read_bytes()
        soft = resource.getrlimit(resource.RLIMIT_FSIZE)
        for allowed in (0, 100, 4096, 20000, len(before) // 2, len(before) - 1):
            for words in (("add", self.city, tiles[3]), ("remove", self.city, "tile_0"),
                          ("compact", self.city)):
                done = subprocess.run(
                    [TOOL, "collection", *map(str, words), "--progress", "none"],
                    capture_output=True, timeout=240, check=False,
                    preexec_fn=lambda limit=allowed: resource.setrlimit(
                        resource.RLIMIT_FSIZE, (limit, soft[1])))
                if done.returncode == 0:  # fewer tiles take fewer bytes
                    self.assertEqual(words[0], "remove")
                    self.city.write_bytes(before)
                    continue
                self.assertEqual(done.returncode, 1, (words, done.stderr))
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
                self.assertEqual(self.city.read_bytes(), before)
                self.assertEqual(self.entries(), ["city.pfcollection", "tiles"])

    def test_kills_at_random_moments(self):
        tiles = [self.tile(number, points=1000) for number in range(6)]
        self.collection("create", self.city, *tiles[:5])
        before = spent_by_children()
        self.collection("add", self.city, tiles[5])
        whole = spent_by_children() - before
        seed = random.randrange(1 << 30)
        draw = random.Random(seed)
        killed = 0
        for number in range(KILLS):
            state = self.collection("list", self.city)
            there = {tile["name"] for tile in state["tiles"]}
            add = "tile_5" not in there
            words = ("add", self.city, tiles[5]) if add else ("remove", self.city, "tile_5")
            process = subprocess.Popen([TOOL, "collection", *map(str, words)],
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            moment = draw.uniform(0.0, 1.2 * whole)
            while process.poll() is None and spent_by(process) < moment:
                time.sleep(0.0005)
            process.send_signal(signal.SIGKILL)
            killed += process.wait() == -signal.SIGKILL
            now = self.collection("list", self.city)
            changed = {tile["name"] for tile in now["tiles"]} ^ there
            with self.subTest(seed=seed, number=number):
                self.assertEqual(now["state"] - state["state"], 1 if changed else 0)
                self.assertLessEqual(changed, {"tile_5"})
                if number % 20 == 0:
                    self.assertTrue(self.succeed("verify", self.city, "--json").json["ok"])
        self.assertGreater(killed, KILLS // 10)
        self.assertTrue(self.succeed("verify", self.city, "--json").json["ok"])
        self.collection("remove" if "tile_5" in self.names() else "add", self.city,
                        "tile_5" if "tile_5" in self.names() else tiles[5])
        self.assertEqual(self.entries(), ["city.pfcollection", "tiles"])  # no left-overs

    def test_two_writers_do_not_lose_a_change(self):
        tiles = [self.tile(number, points=500) for number in range(9)]
        self.collection("create", self.city, tiles[0])
        writers = [subprocess.Popen([TOOL, "collection", "add", str(self.city), str(tile)],
                                    stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
                   for tile in tiles[1:]]
        done = 0
        for writer in writers:
            _, said = writer.communicate()
            done += writer.returncode == 0
            if writer.returncode != 0:
                self.assertEqual(writer.returncode, 1)
                self.assertIn(b"another process is writing", said)
        self.assertEqual(len(self.names()), 1 + done)
        self.assertEqual(self.collection("list", self.city)["state"], 1 + done)
        self.assertGreaterEqual(done, 1)


if __name__ == "__main__":
    unittest.main(verbosity=2)
