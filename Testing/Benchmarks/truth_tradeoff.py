#!/usr/bin/python3
"""Techniques against the true picture of a scene: the tables of docs/tradeoffs.md.

    Testing/Benchmarks/truth_tradeoff.py --build build/bench --work FOLDER TECHNIQUE...

A technique is one of

    oracle              the true place of each pixel with the colours of the points around it
    vtk-points[:PX]     vtkPolyDataMapper, points of PX pixels (1)
    vtk-gaussian[:H]    vtkPointGaussianMapper as it comes, sigma of H spacings (0.5)
    vtk-discs[:H]       vtkPointGaussianMapper, opaque discs of a radius of H spacings (0.85)
    LABEL=OPTIONS       pointfront render with these options:
                        "1-px points=--technique points --point-size 1"
                        "EWA=--backend software --technique ewa --style ewa.json"

For every scene, sampling, view and spacing the points are sampled (`truth`), built to a store and
drawn, all of them, by each technique; `pointfront compare` measures each picture over the true
silhouette. One Markdown table a scene and sampling: means over the views. What the work folder
holds already is not made again, so techniques can be added one by one; --force draws again. With
--flicker each is drawn a second time, a quarter of a pixel to the right: the mean difference of
the two frames in grey levels, less that of the two true pictures. VTK's
rows and the OpenGL backend need an X server (xvfb-run -a).
"""

import argparse
import json
import pathlib
import shlex
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
PEERS = {"vtk-points": ("points", "1"), "vtk-gaussian": ("gaussian", "0.5"),
         "vtk-discs": ("discs", "0.85")}
PAN_PX = 0.25  # for --flicker
LEAST_DRAWN = 0.85  # a share of the points: nodes beside the picture are not drawn


def run(*command):
    """Returns what the command prints; its complaints only if it fails."""
    finished = subprocess.run(list(map(str, command)), capture_output=True, check=False)
    if finished.returncode != 0:
        raise SystemExit(f"{shlex.join(map(str, command))}\n{finished.stderr.decode()}")
    return finished.stdout


class Case:
    """One scene, sampling, view and spacing, and its folder."""

    def __init__(self, options, scene, sampling, view, spacing):
        self.options = options
        self.arguments = [scene, "--sampling", sampling, "--view", view, "--spacing-px",
                          f"{spacing:g}", "--width", str(options.size[0]), "--height",
                          str(options.size[1]), "--samples", str(options.samples), "--oracle"]
        size = "x".join(map(str, options.size))
        self.folder = options.work / size / f"{scene}-{sampling}-{view}-{spacing:g}"

    def make(self):
        if not (self.folder / "truth.json").exists():  # written last
            run(self.options.truth, *self.arguments, "-o", self.folder)
        if self.options.flicker and not (self.folder / "panned/truth.png").exists():
            run(self.options.truth, *self.arguments, "--pan-px", PAN_PX, "-o",
                self.folder / "panned")
        self.facts = json.loads((self.folder / "truth.json").read_text())

    def store(self):
        """Built with the words of --build-options, once for each of them."""
        words = shlex.split(self.options.build_options)
        store = self.folder / ("points" + "".join(words).replace("/", "_") + ".pfront")
        if not store.exists():
            run(self.options.tool, "build", self.folder / "points.ply", "-o", store,
                "--progress", "none", *words)
        return store

    def draw(self, technique, camera, out):
        name, _, argument = technique.partition(":")
        if name in PEERS:
            kind, size = PEERS[name]
            run(sys.executable, HERE / "truth_vtk.py", self.folder, kind, argument or size, out,
                camera)
            return
        words = shlex.split(technique.partition("=")[2])
        statistics = out.with_suffix(".json")
        size = "x".join(str(self.facts[side]) for side in ("width", "height"))
        run(self.options.tool, "render", self.store(), "-o", out, "--size", size, "--camera",
            camera, "--background", self.background(), "--error", "0.01",
            "--stats", statistics, *words)
        drawn = json.loads(statistics.read_text())["points_drawn"]
        if drawn < LEAST_DRAWN * self.facts["points"]:
            raise SystemExit(f"{out}: {drawn} of {self.facts['points']} points were drawn")

    def background(self):
        return ",".join(map(str, self.facts["background"]))

    def picture_of(self, technique, folder):
        """Returns the technique's picture from the camera of that folder."""
        if technique == "oracle":
            return folder / "oracle.png"
        name = "".join(c if c.isalnum() else "_" for c in technique)
        picture = folder / f"drawn_{name}.png"
        if self.options.force or not picture.exists():
            self.draw(technique, folder / "camera.json", picture)
        return picture

    def compare(self, one, other):
        return json.loads(run(
            self.options.compare, "compare", one, other, "--mask", self.folder / "mask.png",
            "--background", self.background(), "--json"))

    def measure(self, technique):
        picture = self.picture_of(technique, self.folder)
        told = self.compare(picture, self.folder / "truth.png")
        if told["psnr"] is None:
            told["psnr"] = float("inf")
        if self.options.flicker and technique != "oracle":
            panned = self.folder / "panned"
            drawn = self.compare(self.picture_of(technique, panned), picture)
            true = self.compare(panned / "truth.png", self.folder / "truth.png")
            told["flicker"] = drawn["mean_difference"] - true["mean_difference"]
        return told


def label_of(technique):
    return technique.partition("=")[0] if "=" in technique else technique


def mean(values):
    return sum(values) / len(values)


def print_table(options, scene, sampling):
    """Rows as they are ready: a technique over all spacings."""
    print(f"\n{scene}, {sampling}; views {', '.join(options.views)}, "
          f"{options.size[0]}x{options.size[1]}\n")
    print("| spacing, px | " + " | ".join(f"{s:g}" for s in options.spacings) + " |")
    print("| --- |" + " --- |" * len(options.spacings))
    for technique in options.techniques:
        quality, faults, flicker = [], [], []
        for spacing in options.spacings:
            told = []
            for view in options.views:
                case = Case(options, scene, sampling, view, spacing)
                case.make()
                told.append(case.measure(technique))
            values = {key: mean([one[key] for one in told])
                      for key in ("psnr", "ssim", "holes", "bloat")}
            quality.append(f"{values['psnr']:.1f}, {values['ssim']:.3f}".replace(" 0.", " ."))
            faults.append(f"{values['holes']:.2g}, {values['bloat']:.2g}")
            if "flicker" in told[0]:
                flicker.append(f"{mean([one['flicker'] for one in told]):.2f}")
        print(f"| {label_of(technique)}: PSNR, SSIM | " + " | ".join(quality) + " |")
        print("| ... holes, bloat | " + " | ".join(faults) + " |", flush=True)
        if flicker:
            print("| ... flicker | " + " | ".join(flicker) + " |", flush=True)


def listed(kind=str):
    return lambda text: [kind(word) for word in text.split(",")]


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("techniques", nargs="+", metavar="TECHNIQUE")
    parser.add_argument("--build", type=pathlib.Path, default="build/bench",
                        help="where bin/pointfront and bin/truth are")
    parser.add_argument("--tool", type=pathlib.Path, help="another pointfront to draw with")
    parser.add_argument("--work", type=pathlib.Path, required=True)
    parser.add_argument("--scenes", type=listed(), default=["town", "knot"])
    parser.add_argument("--samplings", type=listed(), default=["blue", "scan"])
    parser.add_argument("--views", type=listed(), default=["far", "mid", "close", "graze"])
    parser.add_argument("--spacings", type=listed(float), default=[0.5, 1, 2, 4, 8])
    parser.add_argument("--size", type=lambda text: [int(n) for n in text.split("x")],
                        default=[800, 600])
    parser.add_argument("--samples", type=int, default=8, help="rays a pixel and axis")
    parser.add_argument("--build-options", default="", help='of the store: "--normals pca"')
    parser.add_argument("--flicker", action="store_true", help="of a camera that moves")
    parser.add_argument("--force", action="store_true", help="draw again what is there")
    options = parser.parse_args()
    options.truth = options.build / "bin/truth"
    options.compare = options.build / "bin/pointfront"
    options.tool = options.tool or options.compare
    for technique in options.techniques:
        if technique.partition(":")[0] not in PEERS and technique != "oracle" \
                and "=" not in technique:
            parser.error(f"'{technique}' is no technique: see --help")
    for scene in options.scenes:
        for sampling in options.samplings:
            print_table(options, scene, sampling)


if __name__ == "__main__":
    main()
