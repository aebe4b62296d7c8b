#!/usr/bin/python3
"""Prints docs/tradeoffs/curve.csv as the C++ table by which pictures say what they differ by.

    Testing/Benchmarks/curve_source.py docs/tradeoffs/curve.csv \\
      > vtkmodule/Core/pointfront/Quality/QualityCurvePlaces.cxx

A range is the least, the median and the most over the scenes of means over their views.
"""

import statistics
import sys

import curve_rows as curve

HEAD = """// Printed by Testing/Benchmarks/curve_source.py from docs/tradeoffs/curve.csv.

#include "pointfront/Quality/QualityCurve.h"

#include <iterator>

namespace pointfront
{
namespace
{

const CurvePlace places[] = {
"""
TAIL = """};

} // namespace

int curveScenes()
{
  return %d;
}

const std::vector<CurvePlace>& qualityCurve()
{
  static const std::vector<CurvePlace> curve(std::begin(places), std::end(places));
  return curve;
}

} // namespace pointfront"""


def spread(values, digits):
    return "{ " + ", ".join(f"{value:.{digits}f}" for value in
                            (min(values), statistics.median(values), max(values))) + " }"


def main():
    rows = curve.read(sys.argv[1])
    scenes = curve.scenes_of(rows)
    print(HEAD, end="")
    for technique in curve.TECHNIQUES:
        for places in zip(*(curve.places(rows, scene, technique) for scene in scenes)):
            def of(column):
                return [place.mean(column) for place in places]
            megabytes = [value / 1e6 for value in of("bytes_read")]
            peaks = [place.most("peak_rss_bytes") / 2 ** 20 for place in places]
            frames = [place.orbit["frame_p50_ms"] for place in places]
            print(f'  {{ "{technique}", {places[0].error_px:g}, {spread(of("psnr"), 1)}, '
                  f'{spread(of("ssim"), 3)}, {spread(of("off8"), 3)},\n'
                  f'    {spread(frames, 1)}, {spread(of("complete_ms"), 0)}, '
                  f'{spread(megabytes, 1)}, {spread(peaks, 0)} }},')
    print(TAIL % len(scenes))


if __name__ == "__main__":
    main()
