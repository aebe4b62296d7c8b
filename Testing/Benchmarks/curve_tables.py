#!/usr/bin/python3
"""Prints tables of docs/tradeoffs/curve.csv as Markdown: it measures nothing.

    Testing/Benchmarks/curve_tables.py presets|errors|motion|stores|depths CSV [SCENE]
"""

import sys

import curve_rows as curve


def table(head, rows):
    print("| " + " | ".join(head) + " |")
    print("| --- |" + " ---: |" * (len(head) - 1))
    for row in rows:
        print("| " + " | ".join(row) + " |")


def truth_of(place):
    return [f"{place.mean('psnr'):.1f}", f"{place.mean('ssim'):.3f}",
            f"{100 * place.mean('off8'):.1f}", f"{100 * place.mean('holes'):.2g}",
            f"{100 * place.mean('bloat'):.2g}"]


TRUTH = ["PSNR, dB", "SSIM", "off by > 8, %", "holes, %", "bloat, %"]


def cost_of(place):
    return [f"{place.mean('points') / 1e6:.2f}", f"{place.mean('bytes_read') / 1e6:.1f}",
            f"{place.most('peak_rss_bytes') / 2 ** 20:.0f}", f"{place.mean('complete_ms'):.0f}",
            f"{place.orbit['frame_p50_ms']:.0f} / {place.orbit['frame_p95_ms']:.0f}"]


COST = ["points, M", "MB read", "peak, MiB", "complete, ms", "frame p50 / p95, ms"]


def presets(rows):
    """Each preset in each scene."""
    table(["scene, `--quality`", *COST, *TRUTH],
          [[f"{scene}, `{preset}`", *cost_of(place), *truth_of(place)]
           for scene in curve.scenes_of(rows) for preset in curve.PRESETS
           for place in curve.places(rows, scene, preset)])


def errors(rows, scene):
    """One scene: each technique at each error."""
    table([f"{scene}: technique, error in px", *COST, *TRUTH],
          [[f"{technique}, {place.error_px:g}", *cost_of(place), *truth_of(place)]
           for technique in curve.TECHNIQUES for place in curve.places(rows, scene, technique)])


def motion(rows):
    """The end of a turn that has 33 ms for a frame, against the complete picture of the view."""
    lines = []
    for scene in curve.scenes_of(rows):
        for technique in (*curve.TECHNIQUES, *curve.PRESETS):
            for place in curve.places(rows, scene, technique):
                still = next((r for r in place.pictures if r["view"] == "middle"), None)
                if place.motion and place.error_px == 1 or technique in curve.PRESETS:
                    moving = place.motion
                    lines.append([
                        f"{scene}, {technique}", f"{moving['frame_p50_ms']:.0f} / "
                        f"{moving['frame_p95_ms']:.0f}", f"{moving['points'] / 1e6:.2f}",
                        f"{moving['drawn_error_px']:.2f}",
                        f"{moving['psnr']:.1f} ({still['psnr']:.1f})",
                        f"{moving['ssim']:.3f} ({still['ssim']:.3f})"])
    table(["in motion at 1 px", "frame p50 / p95, ms", "points, M", "error at the end, px",
           "PSNR (at rest), dB", "SSIM (at rest)"], lines)


def stores(rows, scene):
    """Structure, refinement and precision of one scene's store."""
    kinds = list(dict.fromkeys((row["structure"], row["precision"]) for row in rows
                               if row["scene"] == scene))
    lines = []
    for kind in kinds:
        for technique in ("ellipses", "blended"):
            for place in curve.places(rows, scene, technique, kind):
                if place.error_px in (1, 4):
                    lines.append([f"{kind[0]}, step: {kind[1]}; {technique}, "
                                  f"{place.error_px:g} px", *cost_of(place), *truth_of(place)])
    table([f"{scene}: store, technique, error", *COST, *TRUTH], lines)


def depths(rows):
    """Distance to the true surface, where it is known."""
    lines = []
    for scene in curve.scenes_of(rows):
        for technique in (*curve.TECHNIQUES, *curve.PRESETS):
            for place in curve.places(rows, scene, technique):
                off, flicker = place.mean("depth_off_p50"), place.mean("flicker")
                if off is not None and place.error_px in (0.5, 1, 2, 4):
                    lines.append([f"{scene}, {technique}, {place.error_px:g} px",
                                  f"{1000 * off:.2g}", f"{1000 * place.mean('depth_off_p95'):.2g}",
                                  f"{flicker:.2f}"])
    table(["scene, technique, error", "depth off, median, mm", "95 %, mm", "flicker, grey levels"],
          lines)


def main():
    kind, path, *scene = sys.argv[1:]
    {"presets": presets, "errors": errors, "motion": motion, "stores": stores,
     "depths": depths}[kind](curve.read(path), *scene)


if __name__ == "__main__":
    main()
