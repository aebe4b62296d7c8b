#!/usr/bin/python3
"""Pixels that splats of coarser levels leave open, against the picture of all points.

    Testing/Benchmarks/level_holes.py TOOL STORE... [--work FOLDER]

Draws each store from its iso view, 1280x720, in software, as splats coloured by what the tool
chooses, with errors of 0.1 (all points), 0.5, 1, 2 and 4 px on a background that no cloud has.
Prints a Markdown table: pixels that all points cover and the level does not (open), the reverse
(beyond), as shares of the former, and the PSNR of what both cover.
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "Whole"))
import pictures  # noqa: E402 (found by the line above)

BACKGROUND = (255, 0, 255)
ALL_PX = 0.1
ERRORS_PX = (0.5, 1, 2, 4)


def render(tool, store, picture, error_px):
    subprocess.run(
        [tool, "render", store, "-o", picture, "--size", "1280x720", "--backend", "software",
         "--technique", "splats", "--error", str(error_px), "--background",
         ",".join(map(str, BACKGROUND))], check=True, capture_output=True)
    pixels = pictures.read_png(picture).astype(int)
    return pixels, (pixels != BACKGROUND).any(axis=2)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tool")
    parser.add_argument("stores", nargs="+", type=pathlib.Path, metavar="STORE")
    parser.add_argument("--work", type=pathlib.Path)
    options = parser.parse_args()
    work = options.work or pathlib.Path(tempfile.mkdtemp())
    work.mkdir(parents=True, exist_ok=True)
    print("| store | error, px | open, % | beyond, % | PSNR, dB |")
    print("| --- | ---: | ---: | ---: | ---: |")
    for store in options.stores:
        wanted, inside = render(options.tool, store, work / f"{store.stem}_all.png", ALL_PX)
        for error in ERRORS_PX:
            drawn, covered = render(options.tool, store, work / f"{store.stem}_{error}.png", error)
            both = inside & covered
            square = numpy.square(drawn[both] - wanted[both]).mean()
            psnr = 10 * numpy.log10(255 ** 2 / square) if square > 0 else numpy.inf
            shares = [100 * part.sum() / inside.sum()
                      for part in (inside & ~covered, covered & ~inside)]
            print(f"| {store.stem} | {error} | {shares[0]:.3f} | {shares[1]:.2f} | {psnr:.2f} |",
                  flush=True)


if __name__ == "__main__":
    main()
