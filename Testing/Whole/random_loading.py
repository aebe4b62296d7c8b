"""Scenes that load node by node, drawn by both back ends frame by frame (SMOOTH-5)."""

import json
import os
import subprocess

from random_cases import chance
from random_forms import PLY_TYPES, write_ply
from random_pairs import EVERYTHING, Pair
from sheets import styles_of

# Times that a point is drawn, over all frames: docs/adr/0043-splats-of-a-refining-view.md.
ONCE, TWICE = 1.1, 2.15
# A point that is blended is drawn once for its depth, and twice for its share of the sums.
ON_OPENGL = (ONCE + TWICE) / 2
FEW = 200  # points: of a picture of a dozen points the shares say nothing
SECONDS_A_FRAME = 0.05  # where points grow


class Loading(Pair):
    """The last frame of a view that loads has the bits of the picture at one go, and all frames
    together draw each point about once."""

    size = (480, 320)  # SlowView's
    several = False

    def __init__(self, folder):
        super().__init__(folder)
        self.program = None

    def make(self, number, rng):
        town = self.town(number, rng.choice((5000, 20000, 40000)))
        words = ["--node-points", rng.choice((256, 400, 1000)), "--normals", "pca",
                 "--layers", rng.choice(("none", "class")), *self.tree(rng)]
        if not self.several:
            source = self.folder / "town.las"
            town.write(source)
            self.stores = [self.build("town.pfront", source, *words)]
            return self.stores[0]
        columns = town.columns()
        self.stores = []
        for part in range(3):
            file = write_ply(self.folder / f"{part}.ply", {
                name: column[part::3] for name, column in columns.items()}, list(PLY_TYPES))
            self.stores.append(self.build(f"{part}.pfront", file, *words))
        return self.stores[0]

    def tree(self, rng):
        """Options of the build that say what tree it makes."""
        del rng
        return ()

    def is_bounded(self, case):
        """Whether so few points may be drawn again: those that grow are drawn in each frame."""
        return case["growth"] == 0

    def choose(self, rng):
        return {"error": rng.choice((EVERYTHING, "1", "3")),
                "growth": SECONDS_A_FRAME if chance(rng, 0.25) else 0}

    def answer(self, case):
        """The program's answer to a scene, or None where it refuses it."""
        if self.program is None or self.program.poll() is not None:
            self.program = subprocess.Popen(
                [os.environ["POINTFRONT_LOADING_SCENES"]], stdin=subprocess.PIPE,
                stdout=subprocess.PIPE, text=True)
        style, camera = self.folder / "style.json", case["camera"]
        style.write_text(json.dumps(case["style"]))
        words = [style, case["error"], case["growth"], *camera["position"],
                 *camera["focal_point"], *camera["view_up"], camera.get("view_angle", 0),
                 camera.get("parallel_scale", 0), *self.stores]
        self.program.stdin.write(" ".join(map(str, words)) + "\n")
        self.program.stdin.flush()
        line = self.program.stdout.readline()
        if not line:
            raise AssertionError(f"{json.dumps(case)}: ended with {self.program.wait()}")
        if line.startswith("refused: "):
            return None
        return {name: float(value) for name, value in
                (word.split("=") for word in line.split())}

    def difference(self, case):
        self.take(case["cloud"])
        said = self.answer({**case, "style": self.styled(case["style"])})
        if said is None or said["points"] == 0:
            self.refused += 1
            return None
        blends = said["blended_once"] > 0
        limits = () if not self.is_bounded(case) else (
            ("drawn", "once", ONCE), ("blended", "blended_once", TWICE),
            ("gl", "gl_once", ON_OPENGL if blends else ONCE))
        wrong = [f"{sum_} {said[sum_]:.0f} of {said[once]:.0f} at one go"
                 for sum_, once, most in limits if said[sum_] > most * said[once] + FEW]
        wrong += [f"{said[name]:.0f} pixels of the last frame differ ({name})"
                  for name in ("differs", "gl_differs") if said[name] > 0]
        wrong += [] if said["complete"] else ["never complete"]
        return f"{', '.join(wrong)} in {said['frames']:.0f} frames" if wrong else None

    def close(self):
        """Ends the program."""
        if self.program is not None:
            self.program.stdin.close()
            self.program.wait()
            self.program.stdout.close()


class LoadingClouds(Loading):
    """Three clouds whose points lie among each other, an actor each on OpenGL."""

    several = True


class LoadingMeans(Loading):
    """Children take the places of their parents, which no complete picture shows."""

    def tree(self, rng):
        return "--refinement", "replace", "--structure", rng.choice(("octree", "kdtree"))

    def is_bounded(self, case):
        """With sizes of another kind than spacings each frame begins anew."""
        sizes = [style.get("size", {}) for style in styles_of(case["style"])]
        return super().is_bounded(case) and all(
            size.get("mode", "spacing") == "spacing" for size in sizes)


KINDS = (Loading, LoadingClouds, LoadingMeans)
