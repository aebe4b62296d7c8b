#!/usr/bin/python3
"""Measures that unseen attributes cost nothing: bytes and frame times with and without them.

    Testing/Benchmarks/unused_cost.py --build build/release --work FOLDER CLOUD.laz...

CLOUD.laz is classified. Prints one Markdown table. Each row draws the same points twice, with and
without what is not shown:

    a class that a style hides          against the same classes chosen by --classes
    a lens with a radius of 0           against the style without it
    a store with normals                against the same store without, drawn without normals
    20 further attributes in the store  against the store with positions and rgb, coloured by rgb

Bytes are what complete pictures of six cameras over the cloud read from the store. Times are
medians over the frames of a flight. The two sides take turns, and each side's smallest of seven
runs counts. No display is needed.
"""

import argparse
import json
import pathlib
import sys

import numpy

from programs import call

ROUNDS = 7
POINTS = 1_000_000  # in the made-up cloud with further attributes
FURTHER = 20


class Runs:
    def __init__(self, options):
        self.options = options
        self.tool = options.build / "bin/pointfront"

    def store(self, name, *words):
        store = self.options.work / f"{name}.pfront"
        if not store.exists():
            call(self.tool, "build", *words, "-o", store, "--progress", "none")
        return store

    def style(self, name, content):
        path = self.options.work / f"{name}.json"
        path.write_text(json.dumps(content))
        return path

    def cameras(self, store):
        """Six along the cloud's longer diagonal, low over it, looking ahead and down."""
        low, high = numpy.reshape(
            json.loads(call(self.tool, "info", store, "--json"))["bounds"], (2, 3))
        for share in numpy.linspace(0.1, 0.7, 6):
            at = low + share * (high - low)
            at[2] = high[2] + 0.05 * (high[0] - low[0])
            ahead = low + (share + 0.2) * (high - low)
            yield {"position": at.tolist(), "focal_point": [*ahead[:2], low[2]],
                   "view_up": [0, 0, 1], "view_angle": 45}

    def bytes_read(self, store, words):
        picture, out = (self.options.work / name for name in ("picture.png", "render.json"))
        camera = self.options.work / "camera.json"
        read, points = 0, 0
        for place in self.cameras(store):
            camera.write_text(json.dumps(place))
            call(self.tool, "render", store, "-o", picture, "--backend", "software", "--camera",
                 camera, "--stats", out, *words)
            told = json.loads(out.read_text())
            read += told["bytes_read"]
            points += told["points_drawn"]
        return read, points

    def frame_ms(self, store, words):
        out = self.options.work / "bench.json"
        call(self.tool, "bench", store, "--backend", "software", "--path", "flight", "--frames",
             self.options.frames, "--stats", out, *words)
        return json.loads(out.read_text())["frame_ms"]["p50"]

    def row(self, label, shown, other):
        """`shown`, `other`: (store, words) with and without what is not shown."""
        sides = (shown, other)
        told = [self.bytes_read(*side) for side in sides]
        if told[0][1] != told[1][1]:
            sys.exit(f"{label}: {told[0][1]} and {told[1][1]} points were drawn")
        times = [[], []]
        for _ in range(ROUNDS):
            for number, side in enumerate(sides):
                times[number].append(self.frame_ms(*side))
        size = [side[0] / 1e6 for side in told]
        time = [min(side) for side in times]
        print(f"| {label} | {size[0]:.2f} / {size[1]:.2f} | {100 * (size[0] / size[1] - 1):+.1f} % "
              f"| {time[0]:.1f} / {time[1]:.1f} | {100 * (time[0] / time[1] - 1):+.1f} % |",
              flush=True)


def write_ply(path, further, points=POINTS):
    """Hills of so many points with rgb, and `further` attributes of floats."""
    random = numpy.random.default_rng(1)
    fields = [("x", "<f8"), ("y", "<f8"), ("z", "<f8"),
              ("red", "u1"), ("green", "u1"), ("blue", "u1")]
    fields += [(f"extra_{i}", "<f4") for i in range(further)]
    rows = numpy.zeros(points, fields)
    rows["x"] = numpy.round(random.uniform(0.0, 1000.0, points), 3)
    rows["y"] = numpy.round(random.uniform(0.0, 1000.0, points), 3)
    hills = 20.0 * numpy.sin(rows["x"] / 90.0) * numpy.cos(rows["y"] / 70.0)
    rows["z"] = numpy.round(hills, 3)
    for name in ("red", "green", "blue"):
        rows[name] = random.integers(0, 256, points)
    values = numpy.random.default_rng(2)
    for i in range(further):
        rows[f"extra_{i}"] = values.normal(size=points)
    names = {"<f8": "double", "u1": "uchar", "<f4": "float"}
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {points}"]
    header += [f"property {names[kind]} {name}" for name, kind in fields] + ["end_header", ""]
    path.write_bytes("\n".join(header).encode() + rows.tobytes())


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("clouds", nargs="+", metavar="CLOUD.laz")
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    parser.add_argument("--hidden", type=int, default=5, help="class that is hidden")
    parser.add_argument("--frames", type=int, default=60)
    options = parser.parse_args()
    options.work.mkdir(parents=True, exist_ok=True)
    runs = Runs(options)

    layered = runs.store("layered", *options.clouds, "--structure", "kdtree", "--layers", "class")
    told = json.loads(call(runs.tool, "info", layered, "--json"))
    classes = [str(entry["class"]) for entry in told["layers"] if entry["class"] != options.hidden]
    splats = {"technique": "splats"}
    plain = runs.style("plain", {"default": splats})
    hides = runs.style("hides", {"default": splats,
                                 "classes": {str(options.hidden): {"visible": False}}})
    lens = runs.style("lens", {"default": splats, "lenses": [
        {"shape": "circle", "center_px": [640, 360], "radius_px": 0,
         "inside": {str(options.hidden): {"visible": False}}}]})
    turned = runs.style("turned", {"default": {  # neither normals nor measured radii
        "technique": "splats", "orientation": "view", "size": {"mode": "fixed", "metres": 0.4}}})

    print("| not shown | MB read with / without | | ms a frame with / without | |")
    print("| --- | ---: | ---: | ---: | ---: |")
    runs.row(f"class {options.hidden}, hidden by a style", (layered, ["--style", hides]),
             (layered, ["--style", plain, "--classes", ",".join(classes)]))
    runs.row("a lens with a radius of 0", (layered, ["--style", lens]),
             (layered, ["--style", plain]))
    runs.row("normals, in a style that needs none",
             (runs.store("normals", *options.clouds, "--normals", "pca"), ["--style", turned]),
             (runs.store("octree", *options.clouds), ["--style", turned]))
    for name, further in (("further", FURTHER), ("rgb", 0)):
        path = options.work / f"{name}.ply"
        if not path.exists():
            write_ply(path, further)
    colour = ["--technique", "splats", "--color-by", "rgb"]
    runs.row(f"{FURTHER} further attributes",
             (runs.store("further", options.work / "further.ply"), colour),
             (runs.store("rgb", options.work / "rgb.ply"), colour))


if __name__ == "__main__":
    main()
