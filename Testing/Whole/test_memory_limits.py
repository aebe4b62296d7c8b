"""Random runs of the tool, each under a random limit of address space: a run either works or ends
with an error, and leaves nothing behind. POINTFRONT_RANDOM_COUNT and POINTFRONT_RANDOM_FIRST choose
how many runs there are, and the first one's seed."""

import os
import random
import resource
import subprocess
import unittest

from tool import DATA, TOOL, ToolTest

COUNT = int(os.environ.get("POINTFRONT_RANDOM_COUNT", 24))
FIRST = int(os.environ.get("POINTFRONT_RANDOM_FIRST", 1))
MIB = 1 << 20
CLOUD = DATA / "classified/lidarhd_rgb_nir_698k.laz"
LARGE_POINTS = 3000000  # their records alone take 110 MiB
TIMEOUT_S = 600  # a run that takes longer hangs


def build(chance, source, out):
    run = ["build", source, "-o", out / "new.pfront"]
    run += chance.choice(([], ["--structure", "kdtree"], ["--refinement", "replace"]))
    run += chance.choice(([], ["--layers", "class"]))
    run += chance.choice(([], ["--memory", "64M"], ["--memory", "256M"]))
    run += chance.choice(([], [], ["--normals", "pca"]))
    return run


def render(chance, source, out):
    edges = chance.choice(("640x480", "2000x2000", "6000x4000"))
    run = ["render", source, "-o", out / "new.png", "--size", edges]
    run += ["--technique", chance.choice(("points", "splats", "spheres", "silhouettes", "ewa"))]
    run += chance.choice(([], ["--memory", "64M"], ["--edl"], ["--frames", "3"]))
    return run


def export(chance, source, out):
    kind = chance.choice(("las", "laz", "ply", "pcd", "csv"))
    return ["export", source, "-o", out / f"new.{kind}"]


def other(chance, source, out):
    return chance.choice((["info", source, "--stats"], ["verify", source],
                          ["index", source.parent / "cloud.las", "-o", out / "new.pfindex"],
                          ["generate", "--points", 3000000, "-o", out / "new.laz"],
                          ["compare", source, source]))


class MemoryLimits(ToolTest):
    def run_limited(self, limit, run):
        """Its status and what it complained of."""
        process = subprocess.Popen(
            [TOOL, *map(str, run)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
        try:
            said = process.communicate(timeout=TIMEOUT_S)[1].decode()
        except subprocess.TimeoutExpired:
            process.terminate()
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()
                self.fail("it hangs, and ignores SIGTERM")
            self.fail("it hangs")
        return process.returncode, said

    def test_a_run_works_or_ends_with_an_error(self):
        store = self.build(CLOUD)
        laz, large = self.folder / "large.laz", self.folder / "large.pfront"
        self.succeed("generate", "--points", LARGE_POINTS, "-o", laz)
        self.succeed("build", laz, "-o", large)
        self.succeed("export", store, "-o", self.folder / "cloud.las")
        out = self.folder / "out"
        out.mkdir()
        worked = 0
        for seed in range(FIRST, FIRST + COUNT):
            chance = random.Random(seed)
            made = chance.choice((build, build, render, render, export, other))
            sources = (CLOUD, laz, store, large) if made is build else (store, large)
            run = made(chance, chance.choice(sources), out)
            limit = chance.randint(50, 500) * MIB
            with self.subTest(seed=seed, limit=limit // MIB, run=" ".join(map(str, run))):
                status, said = self.run_limited(limit, run)
                left = sorted(entry.name for entry in out.iterdir())
                for entry in out.iterdir():
                    entry.unlink()
                if status == 127:  # the loader of libraries had no memory
                    self.assertIn("error while loading shared libraries", said)
                elif status != 0:
                    self.assertEqual(status, 1, said)
                    self.assertRegex(said, "(?i)memory")
                if status != 0:
                    self.assertEqual(left, [])
                worked += status == 0
        print(f"{worked} of {COUNT} runs worked, the others ended with an error")


if __name__ == "__main__":
    unittest.main()
