"""Pictures do not read what they do not show: bytes and memory with and without it."""

import json
import sys
import unittest
from pathlib import Path

import numpy
from tool import DATA, ToolTest

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "Benchmarks"))
from unused_cost import write_ply  # noqa: E402 (found by the line above)

TILE = DATA / "classified/test_data_77050_627755_LA93_IGN69.laz"
POINTS = 400_000
FURTHER = 20
CAMERAS = 3  # low over the cloud: parts of it are left out


class Unseen(ToolTest):
    def store(self, name, source, *words):
        store = self.folder / f"{name}.pfront"
        self.succeed("build", source, "-o", store, *words)
        return store

    def style(self, name, content):
        path = self.folder / f"{name}.json"
        path.write_text(json.dumps(content))
        return path

    def cost(self, store, *words):
        """Bytes, points and the most memory of complete pictures along the cloud's diagonal."""
        low, high = numpy.reshape(self.succeed("info", store, "--json").json["bounds"], (2, 3))
        read = points = memory = 0
        for share in numpy.linspace(0.1, 0.7, CAMERAS):
            at = low + share * (high - low)
            at[2] = high[2] + 0.05 * (high[0] - low[0])
            ahead = low + (share + 0.2) * (high - low)
            camera = self.style("camera", {
                "position": at.tolist(), "focal_point": [*ahead[:2], low[2]],
                "view_up": [0, 0, 1], "view_angle": 45})
            self.succeed("render", store, "-o", self.folder / "a.png", "--camera", camera,
                         "--stats", self.folder / "a.json", *words)
            told = json.loads((self.folder / "a.json").read_text())
            read += told["bytes_read"]
            points += told["points_drawn"]
            memory = max(memory, told["resident_bytes"])
        return read, points, memory

    def expect_alike(self, shown, other, bound):
        """Bytes and memory of the first exceed those of the second by the bound at most."""
        read, points, memory = zip(shown, other)
        self.assertEqual(points[0], points[1])
        self.assertGreater(points[0], 10_000)
        self.assertLessEqual(read[0], (1 + bound) * read[1], f"bytes: {read}")
        self.assertLessEqual(memory[0], (1 + bound) * memory[1], f"memory: {memory}")

    def test_further_attributes(self):
        colour = ("--technique", "splats", "--color-by", "rgb")
        costs = []
        for further in (FURTHER, 0):
            source = self.folder / f"{further}.ply"
            write_ply(source, further, POINTS)
            costs.append(self.cost(self.store(further, source), *colour))
        self.expect_alike(*costs, 0.02)

    def test_a_hidden_class_and_an_empty_lens(self):
        store = self.store("layered", TILE, "--structure", "kdtree", "--layers", "class")
        layers = self.succeed("info", store, "--json").json["layers"]
        hidden = layers[-1]["class"]
        others = ",".join(str(layer["class"]) for layer in layers if layer["class"] != hidden)
        self.assertNotEqual(others, "")
        gone = {str(hidden): {"visible": False}}
        splats = {"technique": "splats"}
        plain = self.style("plain", {"default": splats})
        hides = self.style("hides", {"default": splats, "classes": gone})
        lens = self.style("lens", {"default": splats, "lenses": [
            {"shape": "circle", "center_px": [640, 360], "radius_px": 0, "inside": gone}]})
        self.expect_alike(self.cost(store, "--style", hides),
                          self.cost(store, "--style", plain, "--classes", others), 0.02)
        self.expect_alike(self.cost(store, "--style", lens), self.cost(store, "--style", plain),
                          0.02)

    def test_normals_of_a_technique_that_needs_none_and_classes(self):
        flat = self.style("flat", {"default": {
            "technique": "splats", "orientation": "view", "color": "rgb",
            "size": {"mode": "fixed", "metres": 0.4}}})
        costs = [self.cost(self.store(name, TILE, "--layers", "none", *words), "--style", flat)
                 for name, words in (("normals", ("--normals", "pca")), ("bare", ()))]
        self.expect_alike(*costs, 0.02)
        bare = self.folder / "bare.pfront"
        self.succeed("render", bare, "-o", self.folder / "b.png", "--style", flat, "--stats",
                     self.folder / "b.json")
        self.assertNotIn("classification",
                         json.loads((self.folder / "b.json").read_text())["attributes_read"])


if __name__ == "__main__":
    unittest.main()
