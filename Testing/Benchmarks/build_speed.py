#!/usr/bin/python3
"""How fast `pointfront build` is, and where its CPU time goes.

usage: Testing/Benchmarks/build_speed.py --tool TOOL --work DIR [--runs N] INPUT... [-- OPTIONS]

Builds INPUT (all of them into one store) N times, each over the one before, with OPTIONS, and
prints the run of median time: rate, CPU ns a point of the process and of each phase, twice the wall
time a point (on two cores: what is more than the CPU time was waited for), page faults, peak
memory. docs/adr/0006-build-speed.md explains them. Inputs come from the page cache from the second
run on.
"""

import argparse
import json
import pathlib
import resource
import subprocess
import sys


def measure(tool, inputs, store, options):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    finished = subprocess.run(
        [tool, "build", *inputs, "-o", store, "--force", "--json", "--progress", "none", *options],
        capture_output=True, text=True, check=False)
    if finished.returncode != 0:
        sys.exit(finished.stderr)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    report = json.loads(finished.stdout)
    report["system_seconds"] = after.ru_stime - before.ru_stime
    report["page_faults"] = after.ru_minflt - before.ru_minflt
    return report


def describe(report):
    points = report["points_stored"]
    phases = {phase: round(seconds / points * 1e9)
              for phase, seconds in report["cpu_seconds"].items()}
    yield "points", f"{points}"
    yield "rate", f"{points / report['seconds'] / 1e6:.2f} M points/s, {report['seconds']:.2f} s"
    yield "CPU", f"{phases.pop('total')} ns a point, of which system " \
        f"{report['system_seconds'] / points * 1e9:.0f}; twice the time: " \
        f"{2 * report['seconds'] / points * 1e9:.0f}"
    yield "phases", ", ".join(f"{phase} {ns}" for phase, ns in phases.items())
    yield "memory", f"{report['peak_rss_bytes'] / 2**20:.0f} MiB, " \
        f"{1000 * report['page_faults'] / points:.0f} page faults for 1000 points, " \
        f"{report['spilled_bytes'] / 1e6:.0f} MB spilled"
    yield "store", f"{report['bytes_written'] / points:.2f} bytes a point"


def main():
    words = sys.argv[1:]
    options = words[words.index("--") + 1:] if "--" in words else []
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tool", required=True)
    parser.add_argument("--work", required=True, type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("inputs", nargs="+")
    args = parser.parse_args(words[:len(words) - len(options) - 1] if options else words)
    store = args.work / "build_speed.pfront"
    runs = [measure(args.tool, args.inputs, store, options) for _ in range(args.runs)]
    store.unlink()
    for name, text in describe(sorted(runs, key=lambda r: r["seconds"])[len(runs) // 2]):
        print(f"{name:8}{text}")


if __name__ == "__main__":
    main()
