#!/usr/bin/python3
"""Compares what builds of the tool make, bit by bit: stores, indices, exports, answers, pictures.

    Testing/Benchmarks/same_bits.py --work FOLDER TOOL TOOL... [--without PART...]
    Testing/Benchmarks/same_bits.py --work FOLDER TOOL --write docs/tradeoffs/results.txt

TOOL is a command line: a program; with variables before it (env NAME=VALUE PROGRAM); or one of
another processor by an emulator (qemu-aarch64-static -L FOLDER PROGRAM). All work on the bundled
cloud and a made-up one. Prints a line for each thing that the tools make, and ends with 1 where the
later tools make another than the first. PART leaves out what a tool cannot do: normals, scanlines.
The file of --write gets the lines of the first tool: tables whose numbers follow from stores and
pictures are of these (`Whole.SameBits`, `Style.OldTables`).
"""

import argparse
import hashlib
import json
import pathlib
import shlex
import shutil
import sys

from programs import call

ROOT = pathlib.Path(__file__).resolve().parents[2]
CLOUD = ROOT / "Testing/Data/autzen_stadium.laz"
MADE_UP = 60000  # points
SIZE = "320x200"

BUILDS = {
    "octree": (CLOUD,),
    "kd-tree": (CLOUD, "--structure", "kdtree"),
    "means": (CLOUD, "--refinement", "replace"),
    "means, kd-tree": (CLOUD, "--refinement", "replace", "--structure", "kdtree"),
    "classes": (CLOUD, "--layers", "class"),
    "coarser step": (CLOUD, "--precision", "0.037"),
    "normals": (CLOUD, "--normals", "pca", "--curvature"),
    "heights": (CLOUD, "--local-height", "--height-above-ground", "--splat-radius", "--normals",
                "pca"),
    "made up": ("made-up.las", "--layers", "class"),
    "scanlines": ("made-up.las", "--normals", "scanline"),
    "text": ("a.csv",),
    "ply": ("a.ply",)}
NEEDS = {"normals": ("normals", "heights"), "scanlines": ("scanlines",)}

SPLATS = {"technique": "splats"}
STYLES = {
    "points": {"technique": "points"},
    "splats": SPLATS,
    "blended": {**SPLATS, "blended": True},
    "ewa": {"technique": "ewa"},
    "ewa, full": {"technique": "ewa", "accuracy": "full"},
    "spheres": {"technique": "spheres"},
    "silhouettes": {"technique": "silhouettes"},
    "solid": {"technique": "solid"},
    "translucent": {**SPLATS, "opacity": 0.4},
    "by height": {**SPLATS, "color": {"attribute": "elevation", "map": "viridis"}}}
WITH_LENS = {"default": SPLATS, "lenses": [{
    "shape": "circle", "center_px": [160, 100], "radius_px": 60,
    "inside": {"default": {"technique": "spheres", "color": "intensity"}}}]}
# Options of a picture beside its style; each is tried with opaque and with blended splats.
LOOKS = {
    "eye-dome": ("--edl",), "lit": ("--lit",), "one level": ("--detail", "view"),
    "2.5 px": ("--error", "2.5"), "from above": ("--view", "top"),
    "some": ("--where", "intensity in [20, 90]"), "draft": ("--quality", "draft")}
CAMERAS = {
    "near, wide": {"position": [637200.0, 851500.0, 520.0],
                   "focal_point": [637400.0, 851800.0, 430.0],
                   "view_up": [0.0, 0.0, 1.0], "view_angle": 95.0},
    "parallel": {"position": [636500.0, 850500.0, 3000.0],
                 "focal_point": [637400.0, 851850.0, 450.0], "view_up": [0.0, 0.0, 1.0],
                 "parallel_scale": 300.0}}
EXPORTS = {
    "las": (), "laz": ("--box", "637100,851500,0,637400,851900,1000"), "csv": ("--spacing", "7"),
    "ply": ("--sphere", "637400,851850,430,170"), "pcd": ("--where", "intensity > 50")}
FACTS = ("points_drawn", "nodes_drawn", "error_px", "complete")


def undated(data):
    """A LAS file without the day of its creation; what is no LAS file as it is."""
    return data[:90] + bytes(4) + data[94:] if data[:4] == b"LASF" else data


def lines_of(sums):
    return "".join(f"{digest} {name}\n" for name, digest in sums.items())


class Maker:
    """One tool in a folder of its own: a name and a checksum of each thing that it makes."""

    def __init__(self, words, folder, without=()):
        self.words, self.folder = words, folder
        self.left_out = {name for part in without for name in NEEDS[part]}
        self.sums = {}
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)

    def tool(self, *words):
        return call(*self.words, *words)

    def keep(self, name, data):
        self.sums[name] = hashlib.sha256(undated(data)).hexdigest()[:16]

    def path(self, name):
        return self.folder / name

    def make_inputs(self):
        cloud = self.path("made-up.las")
        self.tool("generate", "--points", MADE_UP, "-o", cloud)
        cloud.write_bytes(undated(cloud.read_bytes()))
        self.keep("made-up cloud", cloud.read_bytes())
        self.tool("build", CLOUD, "-o", self.path("first.pfront"))
        for ending in ("csv", "ply"):
            self.tool("export", self.path("first.pfront"), "-o", self.path(f"a.{ending}"))

    def make_stores(self):
        for name, (source, *words) in BUILDS.items():
            if name not in self.left_out:
                path = self.path(f"{name}.pfront")
                self.tool("build", self.folder / source, "-o", path, "--progress", "none", *words)
                self.keep(f"store: {name}", path.read_bytes())
        self.tool("index", self.path("made-up.las"))
        side = [path for path in self.folder.glob("made-up.las.*") if path.is_file()]
        for path in side:
            self.keep("index", path.read_bytes())

    def make_exports(self):
        for ending, words in EXPORTS.items():
            path = self.path(f"exported.{ending}")
            self.tool("export", self.path("octree.pfront"), "-o", path, *words)
            self.keep(f"export: {ending}", path.read_bytes())

    def draw(self, name, store, *words):
        picture, stats = self.path("a.png"), self.path("a.json")
        self.tool("render", self.path(f"{store}.pfront"), "-o", picture, "--size", SIZE, "--stats",
                  stats, *words)
        told = json.loads(stats.read_text())
        self.keep(f"picture: {name}", picture.read_bytes())
        self.keep(f"told: {name}", json.dumps([told[fact] for fact in FACTS]).encode())

    def write(self, name, value):
        path = self.path(name)
        path.write_text(json.dumps(value))
        return path

    def make_pictures(self):
        stores = [name for name in ("octree", "heights", "means") if name not in self.left_out]
        for style, default in STYLES.items():
            sheet = self.write("style.json", {"default": default})
            for store in stores if style != "solid" else stores[1:-1]:  # which has heights
                self.draw(f"{style} of {store}", store, "--style", sheet)
        self.draw("a lens", stores[-2], "--style", self.write("style.json", WITH_LENS))
        for name in ("splats", "blended"):
            sheet = self.write("style.json", {"default": STYLES[name]})
            for look, words in LOOKS.items():
                words = (*words, "--style", sheet) if "--quality" not in words else words
                self.draw(f"{name}, {look}", "octree", *words)
            for camera, value in CAMERAS.items():
                self.draw(f"{name}, {camera}", "octree", "--style", sheet, "--camera",
                          self.write("camera.json", value))

    def make(self):
        for step in (self.make_inputs, self.make_stores, self.make_exports, self.make_pictures):
            step()
        shutil.rmtree(self.folder)
        return self.sums


def differing(first, other):
    """Names of what two tools do not make alike."""
    return sorted(name for name in {**first, **other} if first.get(name) != other.get(name))


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    parser.add_argument("--without", nargs="*", default=[], choices=sorted(NEEDS))
    parser.add_argument("--write", type=pathlib.Path, metavar="FILE")
    parser.add_argument("tools", nargs="+", metavar="TOOL")
    options = parser.parse_args()
    made = [Maker(shlex.split(tool), options.work / str(number), options.without).make()
            for number, tool in enumerate(options.tools)]
    wrong = sorted({name for other in made[1:] for name in differing(made[0], other)})
    for name, digest in made[0].items():
        print(digest, "differs:" if name in wrong else "", name)
    print(f"{len(made[0])} things, {len(wrong)} differ")
    if options.write:
        options.write.write_text(lines_of(made[0]))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
