#!/usr/bin/python3
"""Measures what a coarser precision saves, and the largest error it makes.

    Testing/Benchmarks/precision_tradeoff.py TOOL [POINTS] [WORK_FOLDER]

Generates terrain, builds it at each precision, exports the store again and joins its points with
the input by (gps_time, return number), which are unique there. Prints a Markdown table.
"""

import json
import pathlib
import struct
import subprocess
import sys
import tempfile

import numpy

PRECISIONS = [None, 0.001, 0.01, 0.1, 1.0]


def run(*command):
    return subprocess.run([str(c) for c in command], check=True, stdout=subprocess.PIPE).stdout


def read_las(path):
    """Points of a LAS 1.4 file of format 6 to 8, sorted by (time, return): float64 xyz, key."""
    data = path.read_bytes()
    begin = struct.unpack_from("<I", data, 96)[0]
    form, size = struct.unpack_from("<BH", data, 104)
    count = struct.unpack_from("<Q", data, 247)[0]
    scale = numpy.array(struct.unpack_from("<3d", data, 131))
    offset = numpy.array(struct.unpack_from("<3d", data, 155))
    assert 6 <= form % 128 <= 10, form
    fields = numpy.dtype({"names": ["xyz", "returns", "time"], "offsets": [0, 14, 22],
                          "formats": ["3<i4", "u1", "<f8"], "itemsize": size})
    points = numpy.frombuffer(data, fields, count, begin)
    order = numpy.lexsort((points["returns"], points["time"]))
    points = points[order]
    key = numpy.stack([points["time"], points["returns"].astype(float)], axis=1)
    assert (numpy.abs(numpy.diff(key, axis=0)).sum(axis=1) > 0).all(), "keys are not unique"
    return points["xyz"] * scale + offset, key


def main():
    tool = sys.argv[1]
    points = int(sys.argv[2]) if len(sys.argv) > 2 else 2000000
    work = pathlib.Path(sys.argv[3] if len(sys.argv) > 3 else tempfile.mkdtemp())
    work.mkdir(parents=True, exist_ok=True)
    source, store, back = work / "terrain.las", work / "terrain.pfront", work / "back.las"
    run(tool, "generate", "--points", points, "-o", source, "--force")
    exact, key = read_las(source)
    print("| precision | all attributes, bytes a point | positions and intensity "
          "| largest error, mm |")
    print("| --- | ---: | ---: | ---: |")
    for precision in PRECISIONS:
        option = ["--precision", precision] if precision else []
        for attributes in ("all", "intensity"):
            run(tool, "build", source, "-o", store, "--force", "--attributes", attributes, *option)
            if attributes == "all":
                described = json.loads(run(tool, "info", store, "--json"))
                run(tool, "export", store, "-o", back, "--force")
                got, got_key = read_las(back)
                assert (got_key == key).all()
                error = numpy.abs(got - exact).max()
            else:
                lean = json.loads(run(tool, "info", store, "--json"))
        name = f"{precision:g} m" if precision else f"as the input ({described['precision']} m)"
        print(f"| {name} | {described['bytes'] / points:.2f} | {lean['bytes'] / points:.2f} "
              f"| {1000 * error:.3f} |", flush=True)


if __name__ == "__main__":
    main()
