"""Measures what COPC costs beside LAZ: seconds, points a second, peak memory of `export`.

usage: copc_rate.py TOOL STORE     each kind three times in turn; the least time and its memory
Prints a table of Markdown. Files go to a temporary folder beside STORE and away.
"""

import os
import pathlib
import subprocess
import sys
import tempfile
import time

KINDS = (("LAZ", "out.laz", ()), ("COPC", "out.copc.laz", ()),
         ("COPC, `--memory 64M`", "out.copc.laz", ("--memory", "64M")))


def export(tool, store, out, options):
    """Points, seconds and peak bytes of one run."""
    begin = time.monotonic()
    with subprocess.Popen([tool, "export", store, "-o", str(out), "--force", *options],
                          stdout=subprocess.PIPE) as running:
        said = running.stdout.read().decode()
        _, status, used = os.wait4(running.pid, 0)
        running.returncode = os.waitstatus_to_exitcode(status)
    if running.returncode != 0:
        raise SystemExit(f"copc_rate.py: {tool} export {store} failed")
    return int(said.rsplit(":", 1)[1].split()[0]), time.monotonic() - begin, used.ru_maxrss * 1024


def main(tool, store):
    best = {}
    with tempfile.TemporaryDirectory(dir=pathlib.Path(store).resolve().parent) as folder:
        for _ in range(3):
            for kind, name, options in KINDS:
                out = pathlib.Path(folder) / name
                points, seconds, memory = export(tool, store, out, options)
                best[kind] = min(best.get(kind, (seconds + 1,)),
                                 (seconds, points, memory, out.stat().st_size))
    print("| written | s | points/s | peak MiB | MiB |\n|---|---|---|---|---|")
    for kind, (seconds, points, memory, size) in best.items():
        print(f"| {kind} | {seconds:.1f} | {points / seconds:,.0f} | {memory / 2**20:.0f} | "
              f"{size / 2**20:.1f} |")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
