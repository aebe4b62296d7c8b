#!/usr/bin/python3
"""Time, bytes and memory against truth, with the rendering front: the rows of one table.

    xvfb-run -a Testing/Benchmarks/quality_curve.py --build build/bench --data FOLDER
      --work FOLDER -o docs/tradeoffs/curve.csv [--scenes town,knot,autzen] [--prepare]

Every scene (curve_scenes.py) is drawn by every technique at every error, complete and at the end
of a motion with 33 ms a frame, and compared with the picture that it should give. A row of the CSV
file is one picture:

    scene, view, structure, precision   what is drawn, from where, of which store
    technique, error_px                 as asked for; presets of --quality stand as techniques,
                                        with the rows of the places that they are
    state                               complete; motion: the last frame of a turn
    drawn_error_px, points, bytes_read  what --stats says of it
    peak_rss_bytes                      of the process that made it
    complete_ms                         from the start to the complete picture, the disk cache warm
    frame_p50_ms, frame_p95_ms          frames of an orbit of complete pictures; of the motion
    psnr, ssim                          against the true picture, over its silhouette
    off8, holes, bloat                  shares of the silhouette: pixels off by more than 8 of 255,
                                        background inside, points outside
    flicker                             mean difference of two frames a quarter of a pixel apart,
                                        less that of the true pictures, in grey levels
    depth_off_p50, depth_off_p95        distance to the true surface, units of the coordinates

An empty cell was not measured: depths are known of made-up scenes alone, frame times are of the
view "orbit". Times are as good as the machine was quiet; everything else repeats to the last digit.
"""

import argparse
import csv
import json
import os
import pathlib
import subprocess
import sys
import time

from curve_scenes import BACKGROUND, SIZE, TrueScene, scenes
from programs import call

COLUMNS = ("scene view structure precision technique error_px state drawn_error_px points "
           "bytes_read peak_rss_bytes complete_ms frame_p50_ms frame_p95_ms psnr ssim off8 holes "
           "bloat flicker depth_off_p50 depth_off_p95").split()
STYLES = {
    "points": {"technique": "points", "size": {"mode": "fixed", "px": 2}},
    "flat discs": {"technique": "points"},  # drawn without a style
    "discs": {"technique": "splats", "orientation": "view"},
    "ellipses": {"technique": "splats"},
    "blended": {"technique": "splats", "blended": True},
    "ewa": {"technique": "ewa"},
    "ewa full": {"technique": "ewa", "accuracy": "full"},
}
PRESETS = ("draft", "balanced", "exact")
# Where each preset lies: its rows are those of this technique and error, not drawn again.
PRESET_PLACES = {"draft": ("ellipses", 2), "balanced": ("blended", 1), "exact": ("ewa", 0.5)}
ERRORS_PX = (0.25, 0.5, 1, 2, 4, 8, 16)
FRAME_MS = 33
ORBIT_FRAMES = 40
# Structure and refinement of a tree, and the step of its coordinates, of one scene.
STORES = {
    ("octree with replacement", "the file's"): ["--refinement", "replace"],
    ("kd-tree", "the file's"): ["--structure", "kdtree"],
    ("octree", "0.1"): ["--precision", "0.1"],
    ("octree", "1"): ["--precision", "1"],
}
STORES_OF, STORE_TECHNIQUES, STORE_ERRORS = ("autzen", "stadium"), ("ellipses", "blended"), (1, 4)


class Curve:
    """Writes the rows of scenes as they are measured."""

    def __init__(self, options, rows):
        self.tool, self.build, self.rows = options.build / "bin/pointfront", options.build, rows
        self.errors = options.errors
        self.written = []

    def write(self, scene, view, case, state, values):
        structure, precision = case.get("store", ("octree", "the file's"))
        row = {"scene": scene.name, "view": view, "structure": structure, "precision": precision,
               "technique": case["technique"], "error_px": f"{case['error_px']:g}", "state": state,
               **{key: shown(value) for key, value in values.items()}}
        self.rows.writerow(row)
        if "store" not in case:
            self.written.append(row)

    def write_presets(self, scene):
        for preset, (technique, error_px) in PRESET_PLACES.items():
            for row in self.written:
                if (row["scene"], row["technique"], row["error_px"]) \
                        == (scene.name, technique, f"{error_px:g}"):
                    self.rows.writerow({**row, "technique": preset})

    def words(self, scene, case):
        """The tool's options for a technique and an error."""
        if case["technique"] in PRESETS:
            return ["--quality", case["technique"]]
        style = scene.work / f"{case['technique'].replace(' ', '_')}.json"
        style.write_text(json.dumps({"default": STYLES[case["technique"]]}))
        return ["--style", style, "--error", case["error_px"]]

    def cases(self):
        for technique in STYLES:
            for error_px in self.errors:
                yield {"technique": technique, "error_px": error_px}

    def compare(self, picture, truth, mask=None):
        words = ["--mask", mask] if mask else []
        return json.loads(call(self.tool, "compare", picture, truth, "--background",
                               ",".join(map(str, BACKGROUND)), "--json", *words))

    def judged(self, picture, view):
        told = self.compare(picture, view.truth, view.mask)
        return {"psnr": told["psnr"], "ssim": told["ssim"], "off8": told["share_over_8"],
                "holes": told["holes"] / 100, "bloat": told["bloat"] / 100}

    def complete(self, scene, store, view, case, flicker):
        picture = scene.work / "drawn.png"
        words = self.words(scene, case)
        stats = scene.draw(store, view.camera_file, picture, *words)
        values = {"drawn_error_px": stats["error_px"], "points": stats["points_drawn"],
                  "bytes_read": stats["bytes_read"], "peak_rss_bytes": stats["peak_rss_bytes"],
                  "complete_ms": stats["time_to_complete_ms"], **self.judged(picture, view)}
        if flicker:
            true_panned, beside = scene.flicker_truth(view), scene.work / "panned.png"
            scene.draw(store, view.folder / "panned.json", beside, *words)
            values["flicker"] = self.compare(beside, picture)["mean_difference"] \
                - self.compare(true_panned, view.truth)["mean_difference"]
        return values

    def bench(self, scene, store, case, *words):
        stats = scene.work / "bench.json"
        call(self.tool, "bench", store, "--size", f"{SIZE[0]}x{SIZE[1]}", "--background",
             ",".join(map(str, BACKGROUND)), "--stats", stats, *self.words(scene, case), *words)
        told = json.loads(stats.read_text())
        return {"points": told["points_drawn"]["p50"], "bytes_read": told["bytes_read"],
                "peak_rss_bytes": told["peak_rss_bytes"],
                "frame_p50_ms": told["frame_ms"]["p50"], "frame_p95_ms": told["frame_ms"]["p95"]}

    def orbit(self, scene, store, case):
        return self.bench(scene, store, case, "--path", "orbit", "--frames", ORBIT_FRAMES)

    def motion(self, scene, store, view, case):
        picture, frames = scene.work / "drawn.png", scene.work / "frames.csv"
        values = self.bench(scene, store, case, "--path", view.motion_file(), "--interactive",
                            "--frame-ms", FRAME_MS, "--picture", picture, "--frames-csv", frames)
        with open(frames, newline="", encoding="utf-8") as rows:
            last = list(csv.DictReader(rows))[-1]
        return {**values, "points": int(last["points"]), "drawn_error_px": float(last["error_px"]),
                **self.judged(picture, view)}

    def depths(self, scene, store, view, cases):
        """How far the depths of all cases are off; one VTK window draws them."""
        module = self.build / "lib/python3/dist-packages"
        lines = [json.dumps({"style": {"default": STYLES[case["technique"]]},
                             "error_px": case["error_px"]}) for case in cases]
        done = subprocess.run(
            [sys.executable, pathlib.Path(__file__).with_name("window_depth.py"), store,
             view.folder], input="\n".join(lines), text=True, stdout=subprocess.PIPE, check=True,
            env={**os.environ, "PYTHONPATH": str(module)})
        return [json.loads(line) for line in done.stdout.splitlines()]

    def measure(self, scene):
        store, views, cases = scene.store(), scene.views(), list(self.cases())
        off = self.depths(scene, store, views[0], cases) if isinstance(scene, TrueScene) \
            else [{}] * len(cases)
        for case, depth in zip(cases, off):
            self.write(scene, "orbit", case, "complete", self.orbit(scene, store, case))
            for view in views:
                values = self.complete(scene, store, view, case, view.name == "middle")
                self.write(scene, view.name, case, "complete", {**values, **depth})
                if view.name == "middle":
                    self.write(scene, view.name, case, "motion",
                               self.motion(scene, store, view, case))
        self.write_presets(scene)
        if scene.name in STORES_OF:
            self.measure_stores(scene, views)

    def prepare(self, scene):
        """Makes stores and true pictures, which need no quiet machine."""
        scene.store()
        for view in scene.views():
            if view.name == "middle":
                scene.flicker_truth(view)
        if scene.name in STORES_OF:
            for number, words in enumerate(STORES.values()):
                scene.store(f"store{number}", words)

    def measure_stores(self, scene, views):
        for number, (kind, words) in enumerate(STORES.items()):
            store = scene.store(f"store{number}", words)
            for technique in STORE_TECHNIQUES:
                for error_px in STORE_ERRORS:
                    case = {"technique": technique, "error_px": error_px, "store": kind}
                    self.write(scene, "orbit", case, "complete", self.orbit(scene, store, case))
                    for view in views:
                        self.write(scene, view.name, case, "complete",
                                   self.complete(scene, store, view, case, False))


def shown(value):
    """Six digits are more than any of these numbers is worth."""
    if value is None:
        return ""
    return value if isinstance(value, int) else f"{value:.6g}"


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--data", type=pathlib.Path, help="where the public clouds are")
    parser.add_argument("--work", type=pathlib.Path, required=True)
    parser.add_argument("--scenes", default="stadium,autzen,lidarhd,pond,town,knot",
                        type=lambda text: text.split(","))
    parser.add_argument("--errors", default=ERRORS_PX,
                        type=lambda text: [float(word) for word in text.split(",")])
    parser.add_argument("--prepare", action="store_true",
                        help="only make what the work folder lacks: stores and true pictures")
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    options = parser.parse_args()
    if options.data is None and set(options.scenes) - {"town", "knot", "stadium"}:
        parser.error("--data: say where the public clouds are")
    options.build = options.build.resolve()
    options.output.parent.mkdir(parents=True, exist_ok=True)
    with open(options.output, "w", newline="", encoding="utf-8") as file:
        rows = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        rows.writeheader()
        for scene in scenes(options.scenes, options.build / "bin/pointfront",
                            options.build / "bin/truth", options.data, options.work):
            begin = time.monotonic()
            curve = Curve(options, rows)
            curve.prepare(scene)
            if not options.prepare:
                curve.measure(scene)
            file.flush()
            print(f"{scene.name}: {time.monotonic() - begin:.0f} s", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
