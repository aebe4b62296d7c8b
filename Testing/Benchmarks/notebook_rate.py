#!/usr/bin/python3
"""Frames a second, and bytes a frame, that a browser gets while the mouse turns a cloud; no GPU.

    notebook_rate.py STORE [--peer PYTHON] [--seconds S] [--peer-seconds S] [--json FILE]

`pointfront serve` against PyVista's own trame back end (rendering on the server), which shows the
same points as one PolyData: a pixel each, in their colours, without anti-aliasing. Both draw 1280
by 720 pixels on this machine; Chromium, headless, is on it, too, and the same mouse path is taken
in both. "all points": `serve` draws every point in every frame, at full size, as the peer does.
Prints a row of a Markdown table for each. Then, without a browser, the same rotation frame by
frame: how alike the pictures are, and what processor time a frame takes.

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
BACKGROUND = (23, 25, 31)
POINTS = ["--technique", "points", "--point-size", "1"]
ALL = [*POINTS, "--error", "0.01", "--point-budget", "1000000000", "--frame-ms", "10000"]
FRAMES = 12  # in the rotation without a browser
FRAME_OF_JPEG = re.compile(rb"\xff[\xc0\xc2]\x00.\x08(..)(..)", re.DOTALL)  # height, width

PEER = f"BACKGROUND = {BACKGROUND}" + """
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
plotter.disable_anti_aliasing()
plotter.background_color = BACKGROUND
plotter.add_mesh(cloud, scalars="rgb", rgb=True, style="points", point_size=1, lighting=False)
plotter.view_isometric()
if len(sys.argv) > 2:
    import json, os, time
    for number, camera in enumerate(json.loads(sys.argv[2])):
        place = [numpy.subtract(camera[key], data["centre"]) for key in ("position", "focal_point")]
        plotter.camera.position, plotter.camera.focal_point = map(tuple, place)
        plotter.camera.up = camera["view_up"]
        plotter.camera.view_angle = camera["view_angle"]
        plotter.renderer.ResetCameraClippingRange()
        begin, used = time.perf_counter(), os.times()
        plotter.render_window.Render()
        picture = plotter.screenshot(sys.argv[3] if number == 0 else None, return_img=True)
        now = os.times()
        print(1e3 * (time.perf_counter() - begin), 1e3 * (now[0] + now[1] - used[0] - used[1]))
    sys.exit()
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
    """Starts a server that prints its address: frames a second; median bytes, width and height."""
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
        turn(page, 2.0)  # loads all that is needed only once
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

    points = pointfront.open(store).points(attributes=["rgb"], colors_as_stored=False)
    centred = points["position"] - points["position"].mean(axis=0)
    numpy.savez(file, position=centred.astype(numpy.float32), rgb=points["rgb"],
                centre=points["position"].mean(axis=0))


def processor_ms(process):
    """That a process has used so far, all threads."""
    words = pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return 1e3 * (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")


def rotate_here(store, picture):
    """All points in every frame: cameras; milliseconds of the frames, those of the processors."""
    from pointfront._orbit import OrbitCamera
    from pointfront._pictures import run_tool
    from pointfront._stream import FrameStream

    colour = ",".join(map(str, BACKGROUND))
    stream = FrameStream([store], [*ALL, "--background", colour])
    frame = stream.frame(size=(SIZE["width"], SIZE["height"]), view="iso")
    while not frame.settled:
        frame = stream.frame(wait_ms=50)
    orbit = OrbitCamera(frame.camera)
    cameras, milliseconds = [], []
    before = processor_ms(stream._tool.pid)
    for _ in range(FRAMES):
        orbit.rotate(0.02, 0.0)
        cameras.append(orbit.as_dictionary())
        begin = time.perf_counter()
        frame = stream.frame(camera=cameras[-1])
        milliseconds.append(1e3 * (time.perf_counter() - begin))
    used = (processor_ms(stream._tool.pid) - before) / FRAMES
    stream.close()
    camera = picture.with_suffix(".json")
    camera.write_text(json.dumps(cameras[0]))
    run_tool(["render", store, *ALL[:-2], "--background", colour, "--camera", camera,
              "-o", picture])
    return cameras, statistics.median(milliseconds), used, frame.facts["points"]


def compare_frames(store, peer, points, pictures):
    """Prints how the two draw the same views, every point in every frame."""
    from pointfront._host import TOOL

    ours, theirs = pictures / "all-points.png", pictures / "peer-points.png"
    cameras, milliseconds, used, drawn = rotate_here(store, ours)
    said = subprocess.run([peer, "-c", PEER, points, json.dumps(cameras), theirs], check=True,
                          stdout=subprocess.PIPE, text=True).stdout
    rows = [tuple(map(float, line.split())) for line in said.splitlines()][1:]  # the first uploads
    their_milliseconds, their_used = (statistics.median(column) for column in zip(*rows))
    print(f"\n| {drawn} points | ms a frame | processor ms a frame |\n|---|---:|---:|")
    print(f"| pointfront stream | {milliseconds:.0f} | {used:.0f} |")
    print(f"| PyVista | {their_milliseconds:.0f} | {their_used:.0f} |\n")
    subprocess.run([TOOL, "compare", ours, theirs], check=False)  # they do differ


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
        for name, more in (("points of 1 pixel", POINTS), ("splats", []), ("all points", ALL)):
            rows[f"pointfront serve, {name}"] = measure(
                browser, serve + more, chosen.seconds, without_display,
                pictures / f"{name.split()[0]}.png")
        if chosen.peer:
            file = pathlib.Path(folder) / "points.npz"
            write_points(chosen.store, file)
            rows["PyVista's trame back end, points of 1 pixel"] = measure(
                browser, [chosen.peer, "-c", PEER, str(file)], chosen.peer_seconds, os.environ,
                pictures / "peer.png")
            compare_frames(chosen.store, chosen.peer, file, pictures)
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
