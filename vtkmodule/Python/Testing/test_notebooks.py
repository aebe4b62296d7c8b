"""The notebooks of Examples/Notebooks run without a display and give what is stored in them; a view
in a cell is served by the kernel.
"""

import os
import pathlib
import tempfile
import unittest

import nbclient
import nbformat

FOLDER = pathlib.Path(__file__).resolve().parents[3] / "Examples/Notebooks"
LARGEST = 1_000_000  # bytes of a notebook
LIMIT_SECONDS = 120

VIEW = """
import urllib.request
import pointfront

pointfront.build({cloud!r}, {store!r})
view = pointfront.open({store!r}).show(size=(640, 360))
view
"""
ASK = """
print(urllib.request.urlopen(view.url).status, 'height: 360px' in view._repr_html_())
view.close()
"""

AGAIN = """
views = [pointfront.open(view.paths[0]).show(size=(320, 180)) for _ in range(2)]
"""
COUNT = """
import pathlib
import threading

children = [child for task in pathlib.Path("/proc/self/task").iterdir()
            for child in (task / "children").read_text().split()]
tools = [child for child in children
         if b"stream" in pathlib.Path(f"/proc/{child}/cmdline").read_bytes().split(bytes(1))]
servers = [thread for thread in threading.enumerate() if thread.name == "pointfront-view"]
print(len(tools), len(servers))
"""


def execute(notebook, folder):
    client = nbclient.NotebookClient(
        notebook, timeout=LIMIT_SECONDS, kernel_name="python3", record_timing=False,
        resources={"metadata": {"path": str(folder)}})
    client.execute()


def outputs(notebook):
    """Returns what cells gave: texts, and pictures as text."""
    found = []
    for number, cell in enumerate(notebook.cells):
        for output in cell.get("outputs", []):
            data = output.get("data", {})
            found.append((number, output.get("text"), data.get("text/plain"),
                          data.get("image/png", "").strip()))
    return found


class Notebooks(unittest.TestCase):
    def setUp(self):
        display = os.environ.pop("DISPLAY", None)
        if display is not None:
            self.addCleanup(os.environ.__setitem__, "DISPLAY", display)

    def test_notebooks_give_what_they_show(self):
        files = sorted(FOLDER.glob("*.ipynb"))
        self.assertEqual(len(files), 2)
        for file in files:
            self.assertLess(file.stat().st_size, LARGEST)
            stored = nbformat.read(file, as_version=4)
            nbformat.validate(stored)
            shown = outputs(stored)
            pictures = [picture for *_, picture in shown if picture]
            self.assertGreaterEqual(len(pictures), 2, file)
            again = nbformat.read(file, as_version=4)
            for cell in again.cells:
                if cell.cell_type == "code":
                    cell.outputs = []
            execute(again, FOLDER)
            self.assertEqual(outputs(again), shown, file)

    def test_a_view_is_in_its_cell(self):
        with tempfile.TemporaryDirectory(prefix="pointfront-notebook-") as folder:
            cloud = FOLDER.parents[1] / "Testing/Data/autzen_stadium.laz"
            view = VIEW.format(cloud=str(cloud), store=os.path.join(folder, "a.pfront"))
            notebook = nbformat.v4.new_notebook(cells=[
                nbformat.v4.new_code_cell(view), nbformat.v4.new_code_cell(ASK)])
            execute(notebook, folder)
            shown, said = (cell.outputs for cell in notebook.cells)
            self.assertIn("<iframe", shown[-1].data["text/html"])
            self.assertEqual(said[-1].text.strip(), "200 True")

    def test_a_cell_that_is_run_again_leaves_no_server(self):
        with tempfile.TemporaryDirectory(prefix="pointfront-notebook-") as folder:
            cloud = FOLDER.parents[1] / "Testing/Data/autzen_stadium.laz"
            build = VIEW.format(cloud=str(cloud), store=os.path.join(folder, "a.pfront"))
            notebook = nbformat.v4.new_notebook(cells=[
                nbformat.v4.new_code_cell(source) for source in (build, AGAIN, COUNT)])
            client = nbclient.NotebookClient(notebook, timeout=LIMIT_SECONDS, kernel_name="python3",
                                             resources={"metadata": {"path": folder}})
            with client.setup_kernel():
                for number in (0, 1, 1, 1, 2):
                    client.execute_cell(notebook.cells[number], number)
            # The first cell has one view, the second two, whichever runs went before.
            self.assertEqual(notebook.cells[2].outputs[-1].text.split(), ["3", "3"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
