#!/usr/bin/env python3
"""Frames a second, and bytes a frame, that a browser gets while the mouse turns a cloud; no GPU.

    notebook_rate.py STORE [--peer PYTHON] [--seconds S] [--peer-seconds S] [--json FILE]

`pointfront serve` against PyVista's own trame back end (rendering on the server), which shows the
same points as one PolyData: a pixel each, in their colours. Both draw 1280 by 720 pixels on this
machine; Chromium, headless, is on it, too, and the same mouse path is taken in both. Prints a row
of a Markdown table for each.

Run it by a Python that has the wheel, trame, trame-rca and playwright (scripts/wheel environment).
PYTHON has pyvista, trame-pyvista, trame-vtk and trame-vuetify, and finds a GL (xvfb-run, Mesa).
"""

import argparse
import json
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
import time

CHROMIUM = os.environ.get("POINTFRONT_CHROMIUM", "/usr/bin/chromium")
SIZE = {"width": 1280, "height": 720}
FIRST_SECONDS = 300.0  # most, for the first picture
JPEG = re.compile(rb"\xff\xd8\xff")
FRAME_OF_JPEG = re.compile(rb"\xff[\xc0\xc2]\x00.\x08(..)(..)", re.DOTALL)  # height, width

PEER = """
import sys, numpy, pyvista
from trame.app import get_server
from trame.ui.vuetify3 import VAppLayout
from trame.widgets import html
from trame_pyvista.ui import plotter_ui

pyvista.OFF_SCREEN = True
data = numpy.load(sys.argv[1])
cloud = pyvista.PolyData(data["position"])
cloud["rgb"] = data["rgb"]
plotter = pyvista.Plotter(window_size=(1280, 720))
plotter.add_mesh(cloud, scalars="rgb", rgb=True, style="points", point_size=1, lighting=False)
plotter.view_isometric()
server = get_server(client_type="vue3")
with VAppLayout(server):
    with html.Div(style="position:absolute; inset:0;"):
        plotter_ui(plotter, mode="server", default_server_rendering=True, add_menu=False)
server.controller.on_server_ready.add(
    lambda **_: print(f"http://localhost:{server.port}/", flush=True))
sys.argv = sys.argv[:1]
server.start(port=0, open_browser=False, show_connection_info=False, timeout=0)
"""


def turn(page, seconds):
    """Drags to and fro for that long."""
    x, y, step = 300.0, 360.0, 4.0
    page.mouse.move(x, y)
    page.mouse.down()
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        x += step
        step = -step if not 250 < x < 1050 else step
        page.mouse.move(x, y)
        time.sleep(0.015)
    page.mouse.up()


def measure(browser, command, seconds, environment, picture):
    """Of a server that prints its address: frames a second; median bytes, width and height."""
    server = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment)
    try:
        address = None
        while address is None:
            line = server.stdout.readline()
            if not line:
                sys.exit(f"{command} ended")
            address = re.search(r"http://\S+", line)
        page = browser.new_page(viewport=SIZE)
        frames = []

        def note(data):
            start = JPEG.search(data, 0, 4000) if isinstance(data, bytes) else None
            frame = FRAME_OF_JPEG.search(data, start.start()) if start else None
            if frame:
                height, width = (int.from_bytes(edge, "big") for edge in frame.groups())
                frames.append((len(data), width, height))

        page.on("websocket", lambda socket: socket.on("framereceived", note))
        page.goto(address.group(0))
        end = time.monotonic() + FIRST_SECONDS
        while not frames and time.monotonic() < end:
            page.wait_for_timeout(200)
        if not frames:
            sys.exit(f"{command[0]}: no picture within {FIRST_SECONDS:.0f} s")
        page.wait_for_timeout(4000)
        turn(page, 2.0)  # what is needed only once
        page.wait_for_timeout(3000)
        frames.clear()
        turn(page, seconds)
        moving = list(frames)
        page.wait_for_timeout(4000)
        page.screenshot(path=picture)
        page.close()
        middle = [statistics.median(column) for column in zip(*moving)] if moving else [0, 0, 0]
        return (len(moving) / seconds, *middle)
    finally:
        server.terminate()
        server.wait()


def write_points(store, file):
    """For the peer, which has no PointFront: float32 around the centre, as VTK's GL takes them."""
    import numpy
    import pointfront

    points = pointfront.open(store).points(attributes=["rgb"])
    centred = points["position"] - points["position"].mean(axis=0)
    numpy.savez(file, position=centred.astype(numpy.float32), rgb=points["rgb"])
    return len(points["rgb"])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("store")
    parser.add_argument("--peer")
    parser.add_argument("--seconds", type=float, default=10.0)
    parser.add_argument("--peer-seconds", type=float, default=60.0)
    parser.add_argument("--pictures", default=".", help="folder for the last pictures")
    parser.add_argument("--json")
    chosen = parser.parse_args()
    from playwright.sync_api import sync_playwright

    without_display = {k: v for k, v in os.environ.items() if k != "DISPLAY"}
    pictures = pathlib.Path(chosen.pictures)
    serve = [sys.executable, "-m", "pointfront", "serve", chosen.store, "--port", "0"]
    rows = {}
    with sync_playwright() as playwright, tempfile.TemporaryDirectory() as folder:
        browser = playwright.chromium.launch(
            executable_path=CHROMIUM, args=["--no-sandbox", "--disable-gpu"])
        for name, more in (("points of 1 pixel", ["--technique", "points", "--point-size", "1"]),
                           ("splats", [])):
            rows[f"pointfront serve, {name}"] = measure(
                browser, serve + more, chosen.seconds, without_display,
                pictures / f"{name.split()[0]}.png")
        if chosen.peer:
            file = pathlib.Path(folder) / "points.npz"
            write_points(chosen.store, file)
            rows["PyVista's trame back end, points of 1 pixel"] = measure(
                browser, [chosen.peer, "-c", PEER, str(file)], chosen.peer_seconds, os.environ,
                pictures / "peer.png")
        browser.close()
    print("| view | frames a second | kB a frame | pixels |\n|---|---:|---:|---:|")
    for name, (rate, size, width, height) in rows.items():
        print(f"| {name} | {rate:.2f} | {size / 1e3:.0f} | {width:.0f}x{height:.0f} |")
    if chosen.json:
        keys = ("frames_per_second", "bytes", "width", "height")
        result = {name: dict(zip(keys, row)) for name, row in rows.items()}
        pathlib.Path(chosen.json).write_text(json.dumps(result, indent=2))


if __name__ == "__main__":
    main()
