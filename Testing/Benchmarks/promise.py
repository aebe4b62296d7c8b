#!/usr/bin/python3
"""Checks the promise of docs/promise.md: what a complete picture with --error E may differ by.

    Testing/Benchmarks/promise.py --build build/release --data FOLDER --work FOLDER [--views 500]

Random views (by a fixed seed) of six clouds that no table of docs/tradeoffs.md is of, with random
errors from 0.5 to 8 pixels. Each is drawn complete, and again with all points in sight; both by
points of one pixel and by opaque splats that are coloured by height. Prints a Markdown table: of
each cloud the worst of its views. Ends with 1 where a view breaks the promise.
"""

import argparse
import hashlib
import json
import math
import pathlib
import subprocess
import sys
import time

import numpy
from curve_scenes import camera_at
from programs import call

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "Whole"))
import pictures  # noqa: E402 (found by the line above)

SIZE = (400, 300)
BACKGROUND = (39, 42, 47)
ALL_POINTS_PX = 0.01
CLOUDS = ("classified/test_semis_2023_0292_6833_LA93_IGN69.laz", "copc/lone-star.copc.laz",
          "pcd/office1.pcd", "classified/ahn3_261k.laz",
          "classified/lidarprod_rgb_buildings_71k.laz", "copc/ellipsoid_200k.copc.laz")
# The promise, E being the error that was asked for.
FARTHEST_POINT = 2.0  # times E, and a pixel: from each point in sight to one that is drawn
FARTHEST_COVER = 4.0  # times E, and two pixels: how far splats reach beyond all points' splats
COVER = 0.001  # share of the silhouette that may be covered beyond it
WIDE_HOLES = 0.002  # share of the silhouette in holes wider than a pixel
FOREIGN = 0.02  # share of the silhouette whose height is none of those around the place
HEIGHT_STEPS = 3  # 255 are the heights of the cloud; colours are whole numbers


def dilated(mask, radius):
    """The pixels at most `radius` columns and rows from one of the mask."""
    for axis in (0, 1):
        total = numpy.cumsum(numpy.pad(mask, [(radius + 1, radius) if a == axis else (0, 0)
                                              for a in (0, 1)]), axis=axis)
        length = mask.shape[axis]
        high = total.take(range(2 * radius + 1, 2 * radius + 1 + length), axis=axis)
        mask = high - total.take(range(length), axis=axis) > 0
    return mask


def extreme(values, radius, choose):
    """The least or largest value at most `radius` columns and rows away."""
    for axis in (0, 1):
        best = numpy.pad(values, [(radius, radius) if a == axis else (0, 0) for a in (0, 1)],
                         mode="edge").swapaxes(0, axis)
        width = 1  # the window that `best` is of; two that overlap make a wider one
        while width < 2 * radius + 1:
            shift = min(width, 2 * radius + 1 - width)
            best = choose(best[:-shift], best[shift:])
            width += shift
        values = best.swapaxes(0, axis)
    return values


def wide(mask):
    """The part of it that lies in blocks of two by two pixels."""
    blocks = mask[:-1, :-1] & mask[1:, :-1] & mask[:-1, 1:] & mask[1:, 1:]
    found = numpy.zeros_like(mask)
    for row in (0, 1):
        for column in (0, 1):
            found[row:mask.shape[0] - 1 + row, column:mask.shape[1] - 1 + column] |= blocks
    return found


class Judge:
    """Draws views of a store and measures what the promise is about."""

    def __init__(self, tool, store, folder):
        self.tool, self.store, self.folder = tool, store, folder
        low, high = numpy.reshape(
            json.loads(call(tool, "info", store, "--json"))["bounds"], (2, 3))
        self.centre, self.size = (low + high) / 2, float(numpy.linalg.norm(high - low))
        self.style = folder / "heights.json"
        top = high[2] if high[2] > low[2] else low[2] + 1.0
        self.style.write_text(json.dumps({"default": {
            "technique": "splats", "color": {"attribute": "elevation", "map": "grey",
                                             "range": [low[2], top]}}}))

    def random_view(self, random):
        """From all sides, from beyond the cloud to among its points."""
        distance = self.size * math.exp(random.uniform(math.log(0.15), math.log(1.5)))
        aside = random.uniform(-0.25, 0.25, 3) * self.size
        return camera_at(self.centre + aside, distance, random.uniform(0, 360),
                         random.uniform(5, 89))

    def draw(self, camera, error_px, *words):
        picture, stats = self.folder / "drawn.png", self.folder / "drawn.json"
        file = self.folder / "camera.json"
        file.write_text(json.dumps(camera))
        call(self.tool, "render", self.store, "-o", picture, "--camera", file, "--size",
             f"{SIZE[0]}x{SIZE[1]}", "--background", ",".join(map(str, BACKGROUND)), "--error",
             error_px, "--memory", "2G", "--stats", stats, *words)
        pixels = pictures.read_png(picture)
        covered = (pixels != BACKGROUND).any(axis=2)
        return pixels[:, :, 0].astype(int), covered, json.loads(stats.read_text())

    def shows(self, camera):
        """Whether any point is in the picture: the tool refuses to draw nothing."""
        file = self.folder / "camera.json"
        file.write_text(json.dumps(camera))
        return subprocess.run(
            [self.tool, "render", self.store, "-o", self.folder / "seen.png", "--camera", file,
             "--size", "40x30", "--point-size", "1"], capture_output=True, check=False
        ).returncode == 0

    def judge(self, camera, error_px):
        """The measures of one view, in multiples of what is promised; None where it shows less
        than a thousand pixels."""
        if not self.shows(camera):
            return None
        _, all_points, _ = self.draw(camera, ALL_POINTS_PX, "--point-size", 1)
        heights, surface, _ = self.draw(camera, ALL_POINTS_PX, "--style", self.style)
        if surface.sum() < 1000:
            return None
        _, some_points, _ = self.draw(camera, error_px, "--point-size", 1)
        drawn, cover, told = self.draw(camera, error_px, "--style", self.style)
        if not told["complete"] or told["limited_by"]:
            raise SystemExit(f"{self.store}: not complete: {told}")
        near = 1 + math.ceil(FARTHEST_POINT * error_px)
        far = 2 + math.ceil(FARTHEST_COVER * error_px)
        # Between splats that reach to the silhouette alone nothing is promised.
        inner = ~dilated(~surface, far)
        low = extreme(numpy.where(surface, heights, 255), far, numpy.minimum) - HEIGHT_STEPS
        high = extreme(numpy.where(surface, heights, 0), far, numpy.maximum) + HEIGHT_STEPS
        foreign = cover & surface & ((drawn < low) | (drawn > high))
        return {
            "error": told["error_px"] / error_px,
            "points": (all_points & ~dilated(some_points, near)).sum() / all_points.sum(),
            "cover": (cover & ~dilated(surface, far)).sum() / surface.sum() / COVER,
            "holes": wide(inner & ~cover).sum() / surface.sum() / WIDE_HOLES,
            "foreign": foreign.sum() / surface.sum() / FOREIGN}


def broken(measures):
    """The promises that a view breaks."""
    bounds = {"error": 1.0, "points": 0.0, "cover": 1.0, "holes": 1.0, "foreign": 1.0}
    return [name for name, bound in bounds.items() if measures[name] > bound]


def source_of(tool, seed, number):
    """All that judged views depend on: seed and number of the cloud, the judge, the tool."""
    digest = hashlib.sha256(pathlib.Path(__file__).read_bytes())
    for file in [tool, *sorted(tool.parent.parent.glob("lib*/*pointfront*.so"))]:
        digest.update(file.read_bytes())
    return {"seed": seed, "cloud": number, "judge_and_tool": digest.hexdigest()[:12]}


class JudgedViews:
    """Views that were judged: a line each of a file, after one that says what they depend on."""

    def __init__(self, path, source):
        self.path, self.lines = path, []
        if path.exists():
            # A line that was being written when the run ended has no end.
            text = path.read_text()
            lines = [json.loads(line) for line in text[:text.rfind("\n") + 1].splitlines()]
            if lines and lines[0] == source:
                self.lines = lines[1:]
        path.write_text("".join(json.dumps(line) + "\n" for line in [source, *self.lines]))
        self.next = 0

    def judged(self, judge, camera, error_px):
        """The measures of that view, from the file if it has them."""
        view = json.loads(json.dumps({"camera": camera, "error_px": error_px}))
        if self.next < len(self.lines):
            line = self.lines[self.next]
            if {key: line[key] for key in view} != view:
                raise SystemExit(f"{self.path}: other views than those of this seed: remove it")
        else:
            begun = time.monotonic()
            line = {**view, "measures": judge.judge(camera, error_px),
                    "seconds": round(time.monotonic() - begun, 2)}
            with self.path.open("a") as file:
                file.write(json.dumps(line, default=float) + "\n")
        self.next += 1
        return line["measures"]


def views(judged, random_view, random, count):
    """(camera, error, measures) of that many views that show something; `judged` judges one."""
    while count > 0:
        camera = random_view(random)
        error_px = round(math.exp(random.uniform(math.log(0.5), math.log(8))), 2)
        measures = judged(camera, error_px)
        if measures is not None:
            count -= 1
            yield camera, error_px, measures


def worst_views(options, number, name):
    """The worst of each measure, and how many views of a cloud break the promise."""
    tool = options.build / "bin/pointfront"
    folder = options.work / pathlib.Path(name).name.split(".")[0]
    folder.mkdir(parents=True, exist_ok=True)
    store = folder / "cloud.pfront"
    if not store.exists():
        call(tool, "build", options.data / name, "-o", store, "--progress", "none", "--normals",
             "pca")
    count = options.views * (number + 1) // len(CLOUDS) - options.views * number // len(CLOUDS)
    judge = Judge(tool, store, folder)
    kept = JudgedViews(folder / "views.jsonl", source_of(tool, options.seed, number))
    worst, bad = {}, 0
    random = numpy.random.default_rng([options.seed, number])
    found = views(lambda camera, error_px: kept.judged(judge, camera, error_px),
                  judge.random_view, random, count)
    for done, (camera, error_px, measures) in enumerate(found, 1):
        worst = {key: max(worst.get(key, 0.0), value) for key, value in measures.items()}
        print(f"{name}: {done} of {count} views", file=sys.stderr)
        if broken(measures):
            bad += 1
            print(f"{name}: {error_px} px: {broken(measures)}: {measures}: "
                  f"{json.dumps(camera)}", file=sys.stderr, flush=True)
    return count, worst, bad


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--data", type=pathlib.Path, required=True)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    parser.add_argument("--views", type=int, default=500)
    parser.add_argument("--seed", type=int, default=33)
    options = parser.parse_args()
    failed = 0
    print("| cloud | views | error, of E | points farther than promised, % | covered beyond, % | "
          "in wide holes, % | of other heights, % | broken |")
    print("| --- |" + " ---: |" * 7)
    for number, name in enumerate(CLOUDS):
        count, worst, bad = worst_views(options, number, name)
        failed += bad
        print(f"| {pathlib.Path(name).name} | {count} | {worst['error']:.3f} "
              f"| {100 * worst['points']:.2g} | {100 * COVER * worst['cover']:.2g} "
              f"| {100 * WIDE_HOLES * worst['holes']:.2g} "
              f"| {100 * FOREIGN * worst['foreign']:.2g} | {bad} |", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
