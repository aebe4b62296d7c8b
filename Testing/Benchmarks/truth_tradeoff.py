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
silhouette. Numbers are means over the views. --table says which Markdown tables are printed:

    quality   one a scene and sampling: PSNR, SSIM, holes and bloat of each technique and spacing
    flicker   each is drawn a second time, a quarter of a pixel to the right: the mean difference
              of the two pictures in grey levels, less that of the two true ones; a column a scene
    goals     what the study of the techniques asks for (GOALS), and what is there

The work folder keeps stores and pictures with a line about what they are made of (programs with
their libraries, options, styles); what is made of the same is not made again, so techniques can be
added one by one and tables share their pictures. VTK's rows and the OpenGL backend need an X
server (xvfb-run -a).
"""

import argparse
import collections
import concurrent.futures
import contextlib
import functools
import hashlib
import json
import pathlib
import re
import shlex
import subprocess
import sys
import threading

HERE = pathlib.Path(__file__).resolve().parent
PEERS = {"vtk-points": ("points", "1", "vtkPolyDataMapper, {} px"),
         "vtk-gaussian": ("gaussian", "0.5", "vtkPointGaussianMapper, sigma of {} spacings"),
         "vtk-discs": ("discs", "0.85", "vtkPointGaussianMapper, opaque discs of {} spacings")}
PAN_PX = 0.25  # between the two pictures of a flicker
LEAST_SHARE = 0.005  # %: holes and bloat below it count as 0
JOBS = 2  # views at once: sampling has one thread, and 5 GB at half a pixel
# An X server starts again when its last client leaves, and refuses who comes meanwhile.
SCREEN = threading.Lock()
LEAST_DRAWN = 0.85  # a share of the points: nodes beside the picture are not drawn

# A goal of the study (LAYERS) for the points of some cases, each a scene, a sampling and a spacing:
# the value, and how many dB below the oracle the study's own was.
Goal = collections.namedtuple("Goal", "row measure technique cases value below", defaults=["", ""])
DISCS, ELLIPSES, EWA = "paraboloid discs", "ellipses", "EWA"
TOWN, KNOT = "town blue 2, town scan 2", "knot blue 1, knot blue 2, knot blue 4, knot blue 8"
FLICKERS = "knot blue 1, town blue 1"
GOALS = [
    Goal("PSNR, town, 2 px, blue / scanner: discs", "psnr", DISCS, TOWN, "24.5 / 23"),
    Goal("... ellipses", "psnr", ELLIPSES, TOWN, "26 / 23.5"),
    Goal("... EWA", "psnr", EWA, TOWN, "28 / 25"),
    Goal("PSNR, town, blue, 1 / 4 px: EWA", "psnr", EWA, "town blue 1, town blue 4", "",
         "3.3 / 2.0"),
    Goal("PSNR, objects (knot), blue, 1 / 2 / 4 / 8 px: discs", "psnr", DISCS, KNOT,
         "35 / 33 / 29.5 / 26", "6.5 / 6.8 / 5.9 / 4.7"),
    Goal("... ellipses", "psnr", ELLIPSES, KNOT, "35.5 / 35.5 / 32 / 28", "6.2 / 4.5 / 3.5 / 2.9"),
    Goal("... EWA", "psnr", EWA, KNOT, "40.5 / 39 / 35 / 30.5", "1.1 / .9 / .4 / .4"),
    Goal("PSNR, objects (knot), scanner, 1 / 4 px: EWA", "psnr", EWA, "knot scan 1, knot scan 4",
         "36 / 32.5", "3.0 / 1.6"),
    Goal("holes of objects, 1 px, blue / scanner, %: EWA", "holes", EWA, "knot blue 1, knot scan 1",
         ".1 / .8 to 1"),
    Goal("bloat of objects, blue, 4 px, %: discs", "bloat", DISCS, "knot blue 4", "2.7"),
    Goal("... EWA", "bloat", EWA, "knot blue 4", ".2"),
    Goal("flicker, blue, 1 px, knot / town: discs", "flicker", DISCS, FLICKERS, ".5"),
    Goal("... ellipses", "flicker", ELLIPSES, FLICKERS, ".4"),
    Goal("... EWA", "flicker", EWA, FLICKERS, ".1"),
]


def run(*command):
    """Returns what the command prints; its complaints only if it fails."""
    finished = subprocess.run(list(map(str, command)), capture_output=True, check=False)
    if finished.returncode != 0:
        raise SystemExit(f"{shlex.join(map(str, command))}\n{finished.stderr.decode()}")
    return finished.stdout


def digest(*things):
    """One number for texts, and for files by what they hold."""
    known = hashlib.sha256()
    for thing in things:
        data = thing.read_bytes() if isinstance(thing, pathlib.Path) else str(thing).encode()
        known.update(hashlib.sha256(data).digest())
    return known.hexdigest()


@functools.cache
def program_digest(*programs):
    """One number for programs with all that they are linked with."""
    linked = {library for program in programs
              for library in re.findall(r"=> (/\S+)", run("ldd", program).decode())}
    return digest(*programs, *map(pathlib.Path, sorted(linked)))


def keep(path, made_of, make):
    """Makes a file, unless it is there and made of the same: a line beside it says of what."""
    note = path.with_name(path.name + ".of")
    if not (path.exists() and note.exists() and note.read_text() == made_of):
        note.unlink(missing_ok=True)
        make()
        note.write_text(made_of)


class Case:
    """One scene, sampling, view and spacing, and its folder."""

    def __init__(self, options, scene, sampling, view, spacing):
        self.options = options
        self.arguments = [scene, "--sampling", sampling, "--view", view, "--spacing-px",
                          f"{spacing:g}", "--width", str(options.size[0]), "--height",
                          str(options.size[1]), "--samples", str(options.samples), "--oracle"]
        size = "x".join(map(str, options.size))
        self.folder = options.work / size / f"{scene}-{sampling}-{view}-{spacing:g}"

        self.truth = digest(program_digest(options.truth), *self.arguments)
        keep(self.folder / "truth.json", self.truth,
             lambda: run(options.truth, *self.arguments, "-o", self.folder))
        self.facts = json.loads((self.folder / "truth.json").read_text())

    def panned(self):
        """The folder of the picture and the camera a quarter of a pixel to the right."""
        folder = self.folder / "panned"
        keep(folder / "truth.png", digest(self.truth, PAN_PX), lambda: run(
            self.options.truth, *self.arguments, "--pan-px", PAN_PX, "-o", folder))
        return folder

    def store(self):
        """Built with the words of --build-options, once for each of them."""
        words = shlex.split(self.options.build_options)
        store = self.folder / ("points" + "".join(words).replace("/", "_") + ".pfront")
        keep(store, digest(self.truth, self.options.drawn_by, *words), lambda: run(
            self.options.tool, "build", self.folder / "points.ply", "-o", store, "--force",
            "--progress", "none", *words))
        return store

    def draw_peer(self, script, peer, camera, out):
        with SCREEN:
            run(sys.executable, script, self.folder, *peer, out, camera)

    def draw(self, words, camera, out):
        statistics = out.with_suffix(".json")
        size = "x".join(str(self.facts[side]) for side in ("width", "height"))
        store = self.store()
        with SCREEN if "opengl" in words else contextlib.nullcontext():
            run(self.options.tool, "render", store, "-o", out, "--size", size, "--camera",
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
        picture = folder / f"drawn_{''.join(c if c.isalnum() else '_' for c in technique)}.png"
        camera = folder / "camera.json"
        peer = peer_of(technique)
        if peer:
            script = HERE / "truth_vtk.py"
            keep(picture, digest(self.truth, camera, script, vtk_version(), *peer),
                 lambda: self.draw_peer(script, peer, camera, picture))
        else:
            words = shlex.split(technique.partition("=")[2])
            styles = [pathlib.Path(word) for word in words if pathlib.Path(word).is_file()]
            keep(picture, digest(self.truth, camera, self.options.drawn_by,
                                 self.options.build_options, *words, *styles),
                 lambda: self.draw(words, camera, picture))
        return picture

    def compare(self, one, other):
        return json.loads(run(
            self.options.compare, "compare", one, other, "--mask", self.folder / "mask.png",
            "--background", self.background(), "--json"))

    def quality(self, technique):
        told = self.compare(self.picture_of(technique, self.folder), self.folder / "truth.png")
        if told["psnr"] is None:
            told["psnr"] = float("inf")
        return told

    def flicker(self, technique):
        panned = self.panned()
        drawn = self.compare(self.picture_of(technique, panned),
                             self.picture_of(technique, self.folder))
        true = self.compare(panned / "truth.png", self.folder / "truth.png")
        return drawn["mean_difference"] - true["mean_difference"]


@functools.cache
def vtk_version():
    return run(sys.executable, "-c", "import vtk; print(vtk.VTK_VERSION)").decode()


def peer_of(technique):
    """Kind and size of a mapper of VTK's."""
    name, _, argument = technique.partition(":")
    return (PEERS[name][0], argument or PEERS[name][1]) if name in PEERS else None


def label_of(technique):
    peer = peer_of(technique)
    if peer:
        return PEERS[technique.partition(":")[0]][2].format(peer[1].removeprefix("0"))
    return technique.partition("=")[0]


def mean(values):
    return sum(values) / len(values)


class Means:
    """Means over the views, each measured once."""

    def __init__(self, options):
        self.options = options
        self.techniques = {label_of(technique): technique for technique in options.techniques}
        self.jobs = concurrent.futures.ThreadPoolExecutor(JOBS)

    def over_views(self, measure, label, scene, sampling, spacing):
        return list(self.jobs.map(lambda view: measure(
            Case(self.options, scene, sampling, view, spacing), self.techniques[label]),
            self.options.views))

    @functools.cache
    def quality(self, label, *points):
        told = self.over_views(Case.quality, label, *points)
        return {key: mean([one[key] for one in told]) for key in ("psnr", "ssim", "holes", "bloat")}

    @functools.cache
    def flicker(self, label, *points):
        return mean(self.over_views(Case.flicker, label, *points))

    def cell(self, measure, label, *points):
        if measure == "flicker":
            return short(f"{self.flicker(label, *points):.2f}")
        value = self.quality(label, *points)[measure]
        return share(value) if measure in ("holes", "bloat") else f"{value:.1f}"


def short(text):
    """A number without the 0 before its point, and without the sign of nothing."""
    text = re.sub(r"^(-?)0\.", r"\1.", text)
    return "0" if re.fullmatch(r"-?\.0+", text) else text


def share(value):
    if value < LEAST_SHARE:
        return "0"
    return short(f"{value:.2g}") if value < 10 else f"{value:.0f}"


def print_head(*heads):
    print("| " + " | ".join(heads) + " |")
    print("| --- |" + " --- |" * (len(heads) - 1))


def print_row(*cells):
    print("| " + " | ".join(cells) + " |", flush=True)


def print_quality(options, means):
    """Rows as they are ready: a technique over all spacings."""
    for scene in options.scenes:
        for sampling in options.samplings:
            print(f"\n{scene}, {sampling}; views {', '.join(options.views)}, "
                  f"{options.size[0]}x{options.size[1]}\n")
            print_head("spacing, px", *(f"{spacing:g}" for spacing in options.spacings))
            for label in means.techniques:
                told = [means.quality(label, scene, sampling, s) for s in options.spacings]
                print_row(f"{label}: PSNR, SSIM", *(
                    f"{one['psnr']:.1f}, {short(format(one['ssim'], '.3f'))}" for one in told))
                if label != "oracle":
                    print_row("... holes, bloat", *(
                        f"{share(one['holes'])}, {share(one['bloat'])}" for one in told))


def print_flicker(options, means):
    for sampling in options.samplings:
        for spacing in options.spacings:
            print(f"\n{sampling}, {spacing:g} px\n")
            print_head("flicker", *options.scenes)
            for label in means.techniques:
                if label != "oracle":
                    print_row(label, *(means.cell("flicker", label, scene, sampling, spacing)
                                       for scene in options.scenes))


def print_goals(_, means):
    print_head("", "goal", "here", "below the oracle, study, dB", "here")
    for goal in GOALS:
        cases = [case.split() for case in goal.cases.split(", ")]
        points = [(scene, sampling, float(spacing)) for scene, sampling, spacing in cases]
        here = [means.cell(goal.measure, goal.technique, *one) for one in points]
        below = []
        if goal.measure == "psnr":
            below = [short(format(means.quality("oracle", *one)["psnr"]
                                  - means.quality(goal.technique, *one)["psnr"], ".1f"))
                     for one in points]
        print_row(goal.row, goal.value, " / ".join(here), goal.below, " / ".join(below))


TABLES = {"quality": print_quality, "flicker": print_flicker, "goals": print_goals}


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
    parser.add_argument("--table", choices=TABLES, default="quality")
    options = parser.parse_args()
    options.truth = options.build / "bin/truth"
    options.compare = options.build / "bin/pointfront"
    options.tool = options.tool or options.compare
    options.drawn_by = program_digest(options.tool, *(
        (options.tool.parent.parent / "lib").rglob("libpointfrontOpenGLScene.so")))
    for technique in options.techniques:
        if not peer_of(technique) and technique != "oracle" and "=" not in technique:
            parser.error(f"'{technique}' is no technique: see --help")
    means = Means(options)
    lacking = {"oracle", DISCS, ELLIPSES, EWA} - means.techniques.keys()
    if options.table == "goals" and lacking:
        parser.error(f"the goals also need {', '.join(sorted(lacking))}")
    TABLES[options.table](options, means)


if __name__ == "__main__":
    main()
