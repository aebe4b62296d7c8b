"""A view in JupyterLab: a notebook is opened in Chromium, headless, run, and turned by the mouse.

Neither the server nor its kernel has a display. Environment: POINTFRONT_CHROMIUM the browser,
/usr/bin/chromium unless given; POINTFRONT_PICTURES a folder for pictures of the browser.
"""

import io
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time
import unittest

import nbformat
import numpy
from PIL import Image
from playwright.sync_api import sync_playwright

CLOUD = pathlib.Path(__file__).resolve().parents[3] / "Testing/Data/autzen_stadium.laz"
CHROMIUM = os.environ.get("POINTFRONT_CHROMIUM", "/usr/bin/chromium")
STATUS = ".pointfront-status"
SETTLED = f"{STATUS}[data-settled=true]"
LIMIT_MS = 60000
CODE = """import pointfront

pointfront.build({cloud!r}, "a.pfront", overwrite=True)
pointfront.open("a.pfront").show(size=(900, 400))"""


class Lab:
    """A server of notebooks in a folder, which has one, for the interpreter of this process."""

    def __init__(self, folder):
        folder = pathlib.Path(folder)
        notebook = nbformat.v4.new_notebook(
            cells=[nbformat.v4.new_code_cell(CODE.format(cloud=str(CLOUD)))],
            metadata={"kernelspec": {"name": "python3", "display_name": "Python 3"}})
        nbformat.write(notebook, folder / "view.ipynb")
        variables = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
        variables |= {"JUPYTER_RUNTIME_DIR": str(folder / "runtime"),
                      "JUPYTER_CONFIG_DIR": str(folder / "config"),
                      "JUPYTERLAB_SETTINGS_DIR": str(folder / "settings"),
                      "JUPYTERLAB_WORKSPACES_DIR": str(folder / "workspaces")}
        self._log = open(folder / "log", "w+")
        self._process = subprocess.Popen(
            [sys.executable, "-m", "jupyterlab", "--no-browser", "--allow-root", "--port=0",
             "--ServerApp.port_retries=0", f"--ServerApp.root_dir={folder}"],
            stdout=self._log, stderr=subprocess.STDOUT, env=variables, cwd=folder)
        end = time.monotonic() + LIMIT_MS / 1000
        while not (facts := list((folder / "runtime").glob("jpserver-*.json"))):
            if self._process.poll() is not None or time.monotonic() > end:
                raise AssertionError(f"JupyterLab does not start:\n{self.said()}")
            time.sleep(0.2)
        server = json.loads(facts[0].read_text())
        self.url = f"{server['url']}lab/tree/view.ipynb?token={server['token']}"

    def said(self):
        self._log.seek(0)
        return self._log.read()

    def close(self):
        self._process.terminate()
        self._process.wait(30)
        self._log.close()


class InJupyterLab(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory(prefix="pointfront-jupyter-")
        cls.addClassCleanup(temporary.cleanup)
        cls.lab = Lab(temporary.name)
        cls.addClassCleanup(cls.lab.close)
        playwright = sync_playwright().start()
        cls.addClassCleanup(playwright.stop)
        cls.browser = playwright.chromium.launch(
            executable_path=CHROMIUM, args=["--no-sandbox", "--disable-gpu"])
        cls.addClassCleanup(cls.browser.close)

    def keep(self, page, name):
        folder = os.environ.get("POINTFRONT_PICTURES")
        if folder:
            page.screenshot(path=pathlib.Path(folder) / f"jupyterlab-{name}.png")

    @staticmethod
    def pixels(page, box):
        time.sleep(0.3)  # the browser shows what it got
        picture = Image.open(io.BytesIO(page.screenshot(clip=box))).convert("RGB")
        return numpy.asarray(picture).astype(int)[40:-40]  # without the bar and the status

    def test_a_view_in_a_cell_turns_and_refines(self):
        page = self.browser.new_page(viewport={"width": 1280, "height": 800})
        errors = []
        page.on("console", lambda said: said.type == "error" and errors.append(said.text))
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.goto(self.lab.url)
        page.locator(".jp-Notebook .jp-CodeCell .cm-content").first.click(timeout=LIMIT_MS)
        page.wait_for_selector("[data-status=idle]", state="attached", timeout=LIMIT_MS)
        page.keyboard.press("Shift+Enter")
        element = page.wait_for_selector(".jp-OutputArea iframe", timeout=LIMIT_MS)
        inside = element.content_frame()
        inside.wait_for_selector(SETTLED, state="attached", timeout=LIMIT_MS)
        element.scroll_into_view_if_needed()
        box = element.bounding_box()
        self.assertGreater(box["width"], 800)
        first = self.pixels(page, box)
        self.keep(page, "first")
        self.assertGreater(first.std(axis=(0, 1)).min(), 20, "no cloud is in the cell")

        def frames():
            return int(inside.get_attribute(STATUS, "data-frames"))

        before = frames()
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        page.mouse.move(x, y)
        page.mouse.down()
        for step in range(40):
            page.mouse.move(x + 5 * step, y + step)
            time.sleep(0.02)
        page.mouse.up()
        self.assertGreater(frames() - before, 5, "no frames while it moved")
        inside.wait_for_selector(SETTLED, state="attached", timeout=LIMIT_MS)
        turned = self.pixels(page, box)
        self.keep(page, "turned")
        self.assertGreater(numpy.abs(turned - first).mean(), 10, "the mouse rotates nothing")
        self.assertRegex(inside.inner_text(STATUS), r"^[0-9,]+ points, error [01]\.[0-9] px$")
        self.assertEqual(numpy.abs(self.pixels(page, box) - turned).max(), 0)
        self.assertEqual(errors, [], self.lab.said())


if __name__ == "__main__":
    unittest.main(verbosity=2)
