#!/usr/bin/python3
"""Draws docs/tradeoffs/curve.csv: truth against time, bytes and memory. It measures nothing.

    Testing/Benchmarks/curve_plots.py CSV OUT_FOLDER

Writes time.svg, bytes.svg and memory.svg. Each has a chart a scene: 1 - SSIM (mean over the views)
against the cost, a line a technique with a dot an error, the presets of --quality as diamonds, and
in grey the Pareto front: what no other place beats in both. Each file says the hash of its rows.
Needs python3-matplotlib.
"""

import hashlib
import pathlib
import sys

import curve_rows as curve
import matplotlib

matplotlib.use("svg")
from matplotlib import pyplot, ticker  # noqa: E402 (the line above decides what it draws with)

matplotlib.rcParams["svg.hashsalt"] = "pointfront"  # the same file for the same rows
COLOURS = dict(zip(curve.TECHNIQUES,
                   ("#999999", "#cc79a7", "#56b4e9", "#0072b2", "#009e73", "#e69f00", "#d55e00")))
COSTS = {
    "time": ("a frame of a complete orbit, median, ms", lambda place: place.orbit["frame_p50_ms"]),
    "bytes": ("read for a complete picture, MB", lambda place: place.mean("bytes_read") / 1e6),
    "memory": ("most memory of the program, MiB",
               lambda place: place.most("peak_rss_bytes") / 2 ** 20),
}


def pareto(points):
    """Those of (cost, difference) that no other beats, by rising cost."""
    front = []
    for cost, difference in sorted(points):
        if not front or difference < front[-1][1]:
            front.append((cost, difference))
    return front


def draw(rows, scenes, name, folder, made_of):
    label, cost_of = COSTS[name]
    columns = 2
    figure, charts = pyplot.subplots(-(-len(scenes) // columns), columns, squeeze=False,
                                     figsize=(10, 3.6 * -(-len(scenes) // columns)))
    for chart in charts.flat[len(scenes):]:
        chart.remove()
    for chart, scene in zip(charts.flat, scenes):
        everything = []
        for technique in curve.TECHNIQUES:
            places = curve.places(rows, scene, technique)
            points = [(cost_of(place), 1 - place.mean("ssim")) for place in places]
            everything += points
            chart.plot(*zip(*points), "o-", color=COLOURS[technique], markersize=3.5,
                       linewidth=1.2, label=technique)
            if technique == "blended":
                for place, point in zip(places, points):
                    chart.annotate(f"{place.error_px:g}", point, fontsize=6.5, xytext=(2, -8),
                                   textcoords="offset points", color=COLOURS[technique])
        chart.plot(*zip(*pareto(everything)), color="#dddddd", linewidth=6, zorder=0,
                   label="nothing beats")
        for preset in curve.PRESETS:
            for place in curve.places(rows, scene, preset):
                point = cost_of(place), 1 - place.mean("ssim")
                chart.plot(*point, "D", color="black", markersize=5)
                chart.annotate(preset, point, fontsize=8, xytext=(6, 2),
                               textcoords="offset points")
        chart.set_xscale("log")
        chart.set_yscale("log")
        chart.invert_yaxis()
        for axis in (chart.xaxis, chart.yaxis):
            axis.set_major_formatter(ticker.FormatStrFormatter("%g"))
            axis.set_minor_locator(ticker.LogLocator(subs=(2, 3, 5)))
            axis.set_minor_formatter(ticker.FuncFormatter(lambda value, _: f"{value:g}"))
        chart.set_title(scene, fontsize=10)
        chart.set_xlabel(label, fontsize=8)
        chart.set_ylabel("1 - SSIM against the truth (higher is better)", fontsize=8)
        chart.tick_params(labelsize=8, which="both")
        chart.grid(alpha=0.3, which="both")
    charts.flat[0].legend(fontsize=7, loc="lower right")
    figure.tight_layout()
    figure.savefig(folder / f"{name}.svg", metadata={"Date": None, "Description": made_of})


def main():
    path, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    rows = curve.read(path)
    scenes = [scene for scene in curve.scenes_of(rows) if scene != "stadium"] \
        or curve.scenes_of(rows)
    made_of = "rows " + hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest()
    for name in COSTS:
        draw(rows, scenes, name, folder, made_of)
        print(folder / f"{name}.svg")


if __name__ == "__main__":
    main()
