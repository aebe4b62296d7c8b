#!/usr/bin/python3
"""Pictures of clouds behind nginx and a line, once more from the cache, and flights.

    Testing/Benchmarks/nginx_line.py TOOL CLOUD... [--round-trip MS] [--megabits N] [--runs N]
                                     [--flight SECONDS] [--laspy PYTHON]

nginx (Debian: nginx-light) serves the folder of each cloud on the loopback, and
Testing/Support/slow_line.py is the line before it. A cloud is a file or an EPT's ept.json. Each run
is a process of its own, with an empty cache; "again" is one more with what that run has kept.
Prints a Markdown table of medians: seconds, requests and bytes of the whole run, as
`render --stats` tells. Seconds count from the start of the program; "local" is the cloud as a file.

--flight draws 30 frames a second along `bench --path flight`, and rests then: a second table has
the times of frames, the error on the way, and the seconds from rest to the complete picture.
--laspy reads all points of a COPC file with laspy over HTTP, by a Python that has laspy and lazrs
(scripts/copc-readers fetches them); each run is a process of its own.
"""

import argparse
import csv
import json
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "Support"))

# pylint: disable=wrong-import-position
from slow_line import SlowLine

HERE = "127.0.0.1"
CONFIGURATION = """
daemon off; pid {work}/pid; error_log {work}/error.log; worker_processes 1;
events {{ worker_connections 512; }}
http {{
  access_log {work}/access.log; client_body_temp_path {work}/body; proxy_temp_path {work}/proxy;
  fastcgi_temp_path {work}/fastcgi; uwsgi_temp_path {work}/uwsgi; scgi_temp_path {work}/scgi;
  server {{
    listen {here}:{port};
    location / {{ root {root}; types {{ }} default_type application/octet-stream; gzip off; }}
  }}
}}
"""


LASPY = """
import sys, laspy
with laspy.CopcReader.open(sys.argv[1]) as reader:
    print(len(reader.query()))
"""


def draw(tool, cloud, environment, work, frames=()):
    report = work / "stats.json"
    begin = time.monotonic()
    subprocess.run([tool, "render", cloud, "-o", work / "a.png", "--size", "1280x720", "--error",
                    "1", "--backend", "software", "--stats", report, *frames],
                   check=True, stdout=subprocess.DEVNULL, env=environment)
    return {**json.loads(report.read_text()), "seconds": time.monotonic() - begin}


def median(runs, key, unit=1.0):
    return statistics.median(run.get(key, 0) for run in runs) * unit


def rows(tool, cloud, address, runs, work):
    """Prints the rows of a cloud."""
    cache = work / "cache"
    kept = {**os.environ, "POINTFRONT_CACHE": str(cache)}
    kept = {name: value for name, value in kept.items() if "proxy" not in name.lower()}
    pictures = {"first": [], "complete": [], "again": [], "local": []}
    for _ in range(runs):
        shutil.rmtree(cache, ignore_errors=True)
        pictures["first"].append(draw(tool, address, kept, work, ("--frames", "1")))
        shutil.rmtree(cache, ignore_errors=True)
        pictures["complete"].append(draw(tool, address, kept, work))
        pictures["again"].append(draw(tool, address, kept, work))
        pictures["local"].append(draw(tool, cloud, kept, work))
    for name, runs_of in pictures.items():
        when = "time_to_first_image_ms" if name == "first" else "time_to_complete_ms"
        print(f"| {cloud.name} | {name} | {median(runs_of, when, 1e-3):.2f} s "
              f"| {median(runs_of, 'requests'):.0f} | {median(runs_of, 'bytes_fetched', 1e-6):.2f} "
              f"| {median(runs_of, 'nodes_drawn'):.0f} "
              f"| {median(runs_of, 'bytes_read', 1e-6):.2f} |", flush=True)


def by_laspy(python, cloud, address, runs):
    """Prints a row: all points of a COPC file."""
    seconds = []
    for _ in range(runs):
        begin = time.monotonic()
        subprocess.run([python, "-c", LASPY, address], check=True, stdout=subprocess.DEVNULL)
        seconds.append(time.monotonic() - begin)
    print(f"| {cloud.name} | all by laspy | {statistics.median(seconds):.2f} s | | "
          f"{cloud.stat().st_size * 1e-6:.2f} | | |", flush=True)


def share(values, part):
    return sorted(values)[min(len(values) - 1, int(part * len(values)))]


def fly(tool, cloud, address, seconds, work):
    """Prints two rows of the second table: a flight from afar with an empty cache, and a local
    one."""
    cache, report, frames = work / "cache", work / "flight.json", work / "flight.csv"
    shutil.rmtree(cache, ignore_errors=True)
    environment = {name: value for name, value in os.environ.items() if "proxy" not in name.lower()}
    environment["POINTFRONT_CACHE"] = str(cache)
    for name, place in (("far", address), ("local", cloud)):
        subprocess.run([tool, "bench", place, "--path", "flight", "--frames", str(30 * seconds),
                        "--seconds", str(seconds), "--interactive", "--frame-ms", "33", "--settle",
                        "--size", "1280x720", "--error", "1", "--backend", "software",
                        "--stats", report, "--frames-csv", frames],
                       check=True, stdout=subprocess.DEVNULL, env=environment)
        with open(frames, encoding="utf-8") as table:
            rows_of = list(csv.DictReader(table))[1:30 * seconds]  # the first one opens
        times = [float(row["ms"]) for row in rows_of]
        errors = [float(row["error_px"]) for row in rows_of]
        told = json.loads(report.read_text())
        print(f"| {cloud.name} | {name} | {share(times, .5):.1f} | {share(times, .95):.1f} "
              f"| {share(errors, .5):.2f} | {share(errors, .95):.2f} "
              f"| {told['frames_that_read_files']} | {told['settle']['ms'] / 1000:.2f} s "
              f"| {told.get('requests', 0)} | {told.get('bytes_fetched', 0) * 1e-6:.1f} |",
              flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tool", type=pathlib.Path)
    parser.add_argument("clouds", nargs="+", type=pathlib.Path)
    parser.add_argument("--round-trip", type=float, default=50.0)
    parser.add_argument("--megabits", type=float, default=100.0)
    parser.add_argument("--port", type=int, default=18080)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--flight", type=int, default=0, metavar="SECONDS")
    parser.add_argument("--laspy", metavar="PYTHON")
    given = parser.parse_args()
    work = pathlib.Path(tempfile.mkdtemp(prefix="pointfront-nginx-"))
    clouds = [cloud.absolute() for cloud in given.clouds]
    root = pathlib.Path(os.path.commonpath([cloud.parent for cloud in clouds]))
    (work / "nginx.conf").write_text(
        CONFIGURATION.format(work=work, here=HERE, port=given.port, root=root))
    os.chmod(work, 0o755)
    with subprocess.Popen(["nginx", "-c", work / "nginx.conf", "-g", "user root;",
                           "-e", work / "error.log"]) as nginx:
        try:
            until = time.monotonic() + 10
            while True:
                try:
                    urllib.request.urlopen(f"http://{HERE}:{given.port}/none").close()
                except urllib.error.HTTPError:
                    break  # it answers
                except OSError:
                    if time.monotonic() > until:
                        raise
                    time.sleep(0.1)
            print("| cloud | picture | time | requests | MB fetched | nodes drawn | MB read |\n"
                  "|---|---|---|---|---|---|---|")
            with SlowLine(given.port, given.round_trip / 1000, given.megabits * 1e6) as line:
                tool = given.tool.absolute()
                places = {cloud: f"http://{HERE}:{line.port}/{cloud.relative_to(root)}"
                          for cloud in clouds}
                for cloud, address in places.items():
                    rows(tool, cloud, address, given.runs, work)
                    if given.laspy and cloud.name.endswith(".copc.laz"):
                        by_laspy(given.laspy, cloud, address, given.runs)
                if given.flight > 0:
                    print("\n| cloud | flight | frame, 50 % (ms) | 95 % | error, 50 % (px) | 95 % "
                          "| frames that read files | complete after rest | requests "
                          "| MB fetched |\n|---|---|---|---|---|---|---|---|---|---|")
                    for cloud, address in places.items():
                        fly(tool, cloud, address, given.flight, work)
        finally:
            nginx.terminate()
    shutil.rmtree(work, ignore_errors=True)


if __name__ == "__main__":
    main()
