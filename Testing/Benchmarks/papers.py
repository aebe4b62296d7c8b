#!/usr/bin/python3
"""The figures of the five papers beside ours (docs/papers.md): each call prints one Markdown table.

    Testing/Benchmarks/papers.py build TOOL WORK CLOUD.las      FRONT section 4
    Testing/Benchmarks/papers.py levels TOOL WORK CLOUD.las     FRONT figure 8
    Testing/Benchmarks/papers.py techniques TOOL WORK STORE     LAYERS table 2
    Testing/Benchmarks/papers.py points TOOL WORK STORE         LAYERS figure 8
    Testing/Benchmarks/papers.py text TOOL WORK CLOUD.las       SMOOTH table 1
    Testing/Benchmarks/papers.py frames TOOL WORK STORE         SMOOTH section 4: frame rates
    Testing/Benchmarks/papers.py ewa TOOL WORK STORE            EWA table 2
    Testing/Benchmarks/papers.py images TOOL WORK CLOUD IMAGE   TEXTURE section 5

WORK is a folder for what the calls make. Our times are CPU times of all threads, because other work
on the machine changes the time of the clock by far more: "a core" divides by CPU seconds. A frame's
CPU time is the difference of two runs of so many frames. The papers give times of the clock.
"""

import json
import math
import pathlib
import resource
import sys

import programs

FEW, MANY = 10, 40  # frames of the two runs
MIB = 1 << 20


def call(*words):
    """Runs a command; its CPU seconds and what it printed."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    printed = programs.call(*words)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return cpu, printed


def head(*cells):
    print("| " + " | ".join(cells) + " |")
    print("| --- |" + " ---: |" * (len(cells) - 1), flush=True)


def row(*cells):
    print("| " + " | ".join(str(cell) for cell in cells) + " |", flush=True)


class Tool:
    def __init__(self, tool, work):
        self.tool, self.work = tool, pathlib.Path(work)
        self.work.mkdir(parents=True, exist_ok=True)

    def build(self, inputs, store, *options):
        """CPU seconds and the report of a build, whose time of the clock is told, too."""
        cpu, out = call(self.tool, "build", *inputs, "-o", self.work / store, "--force", "--json",
                        "--progress", "none", *options)
        return cpu, json.loads(out)

    def info(self, store):
        return json.loads(call(self.tool, "info", store, "--json")[1])

    def bench(self, store, frames, *options):
        """CPU seconds of a run of so many frames, and what it tells."""
        told = self.work / "bench.json"
        cpu, _ = call(self.tool, "bench", store, "--backend", "software", "--stats", told,
                      "--frames", frames, "--grow-ms", 0, *options)
        return cpu, json.loads(told.read_text())

    def frame(self, store, *options):
        """CPU milliseconds of a frame, and the points of the median one."""
        few, _ = self.bench(store, FEW, *options)
        many, told = self.bench(store, MANY, *options)
        return 1e3 * (many - few) / (MANY - FEW), told["points_drawn"]["p50"]

    def camera(self, store, share):
        """A file with a camera that looks down at the middle from a share of the cloud's size."""
        low, high = self.info(store)["bounds"][:3], self.info(store)["bounds"][3:]
        centre = [(a + b) / 2 for a, b in zip(low, high)]
        arm = share * math.dist(low, high)
        path = self.work / "camera.json"
        path.write_text(json.dumps({
            "position": [centre[0], centre[1] - 0.8 * arm, centre[2] + 0.6 * arm],
            "focal_point": centre, "view_up": [0, 0, 1], "view_angle": 30}))
        return path

    def points_at(self, store, camera, error_px):
        """Points of a complete picture."""
        told = self.work / "picture.json"
        call(self.tool, "render", store, "-o", self.work / "picture.png", "--backend", "software",
             "--camera", camera, "--error", error_px, "--stats", told)
        return json.loads(told.read_text())["points_drawn"]


def rates(points, seconds, cpu):
    return f"{points / seconds / 1e6:.2f}", f"{points / cpu / 1e6:.2f}"


def build(tool, cloud):
    head("an octree on disk", "points", "input, bytes a point", "M points/s, clock",
         "M points/s a core", "tree, bytes a point")
    row("FRONT: Berlin, 4 GB of memory, a disk of 5,400 rpm", "5,000,000,000", "14.6", "0.099", "",
        "15.6")
    size = pathlib.Path(cloud).stat().st_size
    for name, options in {
            "means (`--refinement replace`), colour": ("--refinement", "replace", "--attributes",
                                                       "rgb"),
            "subset (the default), colour": ("--attributes", "rgb"),
            "subset, all attributes": ()}.items():
        cpu, told = tool.build([cloud], "tree.pfront", "--layers", "none", "--memory", "64M",
                               *options)
        points = told["points_stored"]
        row(f"here: {name}", f"{points:,}", f"{size / points:.1f}",
            *rates(points, told["seconds"], cpu), f"{told['bytes_written'] / points:.2f}")


def levels(tool, cloud):
    stores = []
    for kind in ("replace", "add"):
        tool.build([cloud], f"{kind}.pfront", "--layers", "none", "--attributes", "rgb",
                   "--refinement", kind)
        stores.append(tool.work / f"{kind}.pfront")
    head("error, px", "means, far", "means, near", "subset, far", "subset, near")
    for error_px in (1, 2, 4, 8, 16):
        counts = [tool.points_at(store, tool.camera(store, share), error_px)
                  for store in stores for share in (1.3, 0.1)]
        row(error_px, *(f"{points:,}" for points in counts))


def combination(vegetation, buildings, terrain):
    def of(technique, attribute):
        return {"technique": technique, "color": attribute}
    return {"default": {"technique": "splats"},
            "classes": {**{code: of(*vegetation) for code in "345"}, "6": of(*buildings),
                        "2": of(*terrain)}}


# LAYERS, table 2: frames a second of data set 1, far (2.32 M points) and close (0.50 M).
TECHNIQUES = {
    "`GL_POINTS`; here points of 3 px": (86.39, 378.07, {
        "default": {"technique": "points", "size": {"mode": "fixed", "px": 3}}}),
    "splats": (51.84, 214.32, {"default": {"technique": "splats"}}),
    "spheres": (49.57, 203.81, {"default": {"technique": "spheres"}}),
    "silhouettes": (46.07, 195.65, {"default": {"technique": "silhouettes"}}),
    "solid": (27.32, 100.13, {"default": {"technique": "solid"}}),
    "combination 1": (40.51, 200.97, combination(
        ("spheres", "local_height"), ("silhouettes", "horizontality"),
        ("splats", "classification"))),
    "combination 2": (33.28, 126.31, combination(
        ("silhouettes", "local_height"), ("solid", "horizontality"),
        ("silhouettes", "global_height"))),
}


# LAYERS, figure 8: frames a second over the number of points, a chart without numbers. Table 2 has
# numbers for so many million points, far, of its three data sets.
MILLIONS = (2.32, 3.42, 4.85)
FAR_RATES = {"points of 3 px": (86.39, 60.02, 40.24), "splats": (51.84, 32.27, 23.01),
             "spheres": (49.57, 28.31, 22.35), "silhouettes": (46.07, 26.66, 22.18),
             "solid": (27.32, 20.22, 18.74)}
ALL_MILLIONS = (0.5, 1.0, *MILLIONS, 6.0)


def over_points(tool, store):
    head("ms a frame, LAYERS; CPU ms a frame, here; points", *(f"{m:.2f} M" for m in ALL_MILLIONS),
         "ns a point more, LAYERS", "here")
    for name, rates_there in FAR_RATES.items():
        there = [1e3 / rate for rate in rates_there]
        beside = ["" if m not in MILLIONS else f"{there[MILLIONS.index(m)]:.0f}"
                  for m in ALL_MILLIONS]
        slope = (there[-1] - there[0]) / (MILLIONS[-1] - MILLIONS[0])
        row(f"{name}, LAYERS", *beside, f"{slope:.1f}", "")
        style = dict(TECHNIQUES.get(name, TECHNIQUES["`GL_POINTS`; here points of 3 px"])[2])
        sheet = tool.work / "style.json"
        sheet.write_text(json.dumps(style))
        here = [tool.frame(store, "--style", sheet, "--error", 0.01, "--path", "orbit",
                           "--point-budget", round(1e6 * m)) for m in ALL_MILLIONS]
        slope = (here[-1][0] - here[0][0]) / (here[-1][1] - here[0][1]) * 1e6
        row(f"{name}, here", *(f"{ms:.0f}" for ms, _ in here), "", f"{slope:.1f}")


def techniques(tool, store):
    head("frames a second, or CPU ms a frame (speed against the first row)", "LAYERS, far, 2.32 M",
         "here, far", "LAYERS, close, 0.50 M", "here, close", "M points here")
    first = None
    for name, (far_fps, close_fps, style) in TECHNIQUES.items():
        sheet = tool.work / "style.json"
        sheet.write_text(json.dumps(style))
        (far_ms, far), (close_ms, close) = [
            tool.frame(store, "--style", sheet, "--error", 0.01, "--point-budget", budget,
                       "--path", path)
            for path, budget in (("orbit", 2_320_000), ("flight", 500_000))]
        first = first or (far_fps, far_ms, close_fps, close_ms)
        row(name, f"{far_fps:.0f} fps ({far_fps / first[0]:.2f})",
            f"{far_ms:.0f} ms ({first[1] / far_ms:.2f})",
            f"{close_fps:.0f} fps ({close_fps / first[2]:.2f})",
            f"{close_ms:.0f} ms ({first[3] / close_ms:.2f})", f"{far / 1e6:.2f}, {close / 1e6:.2f}")


def text(tool, cloud):
    """The points of a LAS file as lines of x, y, z and colour, as one file and as eight."""
    everything = tool.work / "everything.pfront"
    tool.build([cloud], everything.name, "--layers", "none", "--attributes", "rgb")
    x0, y0, z0, x1, y1, z1 = tool.info(everything)["bounds"]
    files = []
    for part in range(9):  # the first is all of it
        low, high = ((part - 1) / 8, part / 8) if part else (0, 1)
        files.append(tool.work / f"part{part}.xyz")
        box = (x0 + (x1 - x0) * low, y0, z0, x0 + (x1 - x0) * high, y1, z1)
        call(tool.tool, "export", everything, "-o", files[-1], "--force", "--color-depth", 8,
             "--box", ",".join(map(str, box)))
    size = files[0].stat().st_size
    head("kd-tree of lines of text", "points", "bytes a point", "M points/s, clock",
         "M points/s a core")
    for name, points, bytes_a_point, seconds in (
            ("SMOOTH, data set 1: index and tree", 65e6, 40.0, 7.96 + 23.69),
            ("SMOOTH, data set 2", 233e6, 42.5, 29.91 + 260.90),
            ("SMOOTH, data set 3", 1e9, 42.2, 126.72 + 1691.31),
            ("SMOOTH, data set 1 as 8 files", 64e6, 40.0, 7.90 + 18.77),
            ("SMOOTH, data set 2 as 8 files", 232e6, 42.5, 32.07 + 78.19)):
        row(name, f"{points:,.0f}", f"{bytes_a_point:.1f}", f"{points / seconds / 1e6:.2f}", "")
    options = ("--structure", "kdtree", "--layers", "none")
    cpu, told = tool.build(files[:1], "text.pfront", *options)
    points = told["points_stored"]
    row("here: one file", f"{points:,}", f"{size / points:.1f}",
        *rates(points, told["seconds"], cpu))
    parts = [tool.build([file], f"text{number}.pfront", *options)
             for number, file in enumerate(files[1:])]
    points = sum(told["points_stored"] for _, told in parts)
    row("here: 8 files, a store each", f"{points:,}", f"{size / points:.1f}",
        *rates(points, sum(told["seconds"] for _, told in parts), sum(cpu for cpu, _ in parts)))


def frames(tool, store):
    """Frames of a moving and of a resting camera, with all that SMOOTH's draws in each."""
    camera = json.loads(tool.camera(store, 1.0).read_text())
    still = tool.work / "still.json"
    still.write_text(json.dumps([camera]))
    head("camera", "SMOOTH, 1920x1080, GeForce GTX 760: fps",
         "SMOOTH, 1366x768, Intel HD 5500: fps", "here, 1920x1080, a core: fps", "M points")
    moving, points = tool.frame(store, "--size", "1920x1080", "--detail", "view", "--path", "orbit")
    row("moves", "150 at least", "35 at least", f"{1e3 / moving:.0f}", f"{points / 1e6:.2f}")
    rest, points = tool.frame(store, "--size", "1920x1080", "--detail", "view", "--path", still)
    row("rests, complete", "4,000 at most", "", f"{1e3 / rest:.0f}", f"{points / 1e6:.2f}")


def ewa(tool, store):
    sheet = tool.work / "ewa.json"
    sheet.write_text(json.dumps({"default": {"technique": "ewa", "accuracy": "affine"}}))
    head("points", "EWA, 800x600: fps", "here, a core", "M points", "EWA, 1280x1024: fps",
         "here, a core", "M points")
    for points, small, large in ((500_000, "25", "25"), (1_000_000, "25", "19.6"),
                                 (2_000_000, "14.1", "10.9"), (2_500_000, "11.3", "8.6")):
        cells = []
        for size, fps in (("800x600", small), ("1280x1024", large)):
            ms, drawn = tool.frame(store, "--style", sheet, "--error", 0.01, "--size", size,
                                   "--point-budget", points, "--path", "orbit")
            cells += [fps, f"{1e3 / ms:.1f}", f"{drawn / 1e6:.2f}"]
        row(f"{points / 1e6:g} M", *cells)


def images(tool, cloud, image):
    head("colours from images", "points", "images", "colours: M points/s, clock", "a core",
         "tree: M points/s, clock", "a core", "tree, bytes a point")
    row("TEXTURE: Frankfurt", "7,500,000,000", "161 GB, 2,280 tiles", "0.46", "", "0.104", "",
        "15.5")
    plain = ("--layers", "none", "--attributes", "rgb")
    cpu, told = tool.build([cloud], "plain.pfront", *plain)
    cpu_coloured, coloured = tool.build([cloud], "coloured.pfront", "--color-from", image, *plain)
    points = told["points_stored"]
    size = pathlib.Path(image).stat().st_size / 1e6
    row("here", f"{points:,}", f"{size:.1f} MB, 1 JPEG",
        *rates(points, max(coloured["seconds"] - told["seconds"], 1e-3), cpu_coloured - cpu),
        *rates(points, told["seconds"], cpu), f"{coloured['bytes_written'] / points:.2f}")


TABLES = {"build": build, "levels": levels, "techniques": techniques, "points": over_points,
          "text": text, "frames": frames, "ewa": ewa, "images": images}


def main():
    if len(sys.argv) < 5 or sys.argv[1] not in TABLES:
        sys.exit(__doc__)
    TABLES[sys.argv[1]](Tool(sys.argv[2], sys.argv[3]), *sys.argv[4:])


if __name__ == "__main__":
    main()
