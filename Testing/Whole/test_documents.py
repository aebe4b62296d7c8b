"""Every command and every style of the documentation runs, as it is printed, on data that is
there."""

import json
import os
import pathlib
import re
import subprocess
import sys
import unittest

from documents import Workplace, blocks, shown_points
from tool import TOOL, ToolTest

ROOT = pathlib.Path(__file__).resolve().parents[2]
USER = ROOT / "docs/user"
sys.path.insert(0, str(ROOT / "Testing/Support"))

from bucket_server import BucketServer  # pylint: disable=wrong-import-position

# Commands that other tests run: what a new machine sets up, servers, installed packages.
ELSEWHERE = ("scripts/", "cmake ", "python3 -m ", "apt-get ", "env/bin/", "pip ", "PYTHONPATH=",
             "xvfb-run ", "p.build(", "pointfront serve", "pointfront view", "curl ")


def commands(path):
    """Blocks of the shell, with their lines' numbers."""
    return [(begin, text) for language, begin, text in blocks(path) if language == "sh"]


class PublishedFolder(BucketServer):
    """The bucket of the documentation holds the collection that an earlier command has made."""

    BUCKET = "my-bucket"

    def __init__(self, folder):
        super().__init__()
        self.objects = {str(file.relative_to(folder)): file.read_bytes()
                        for file in folder.glob("country/**/*.pf*")}


class Commands(ToolTest):
    def run_block(self, where, text):
        lines = [line.strip() for line in text.splitlines()]
        own = [line for line in lines if not line.startswith(ELSEWHERE)]
        if not own:
            return
        # Targets that an earlier block has made are made again.
        script = "\n".join(
            re.sub(r"^(pointfront (?:build|export|index|generate) )", r"\1--force ", line)
            for line in own)
        environment = dict(os.environ, PATH=f"{pathlib.Path(TOOL).parent}:{os.environ['PATH']}")
        with PublishedFolder(self.workplace.folder) as bucket:
            if f"s3://{bucket.BUCKET}/" in script:
                environment |= {**bucket.environment(), "POINTFRONT_CACHE": "off"}
            done = subprocess.run(["bash", "-euc", script], cwd=self.workplace.folder, check=False,
                                  capture_output=True, text=True, env=environment, timeout=900)
        self.assertEqual(done.returncode, 0, f"{where}: {script}\n{done.stderr}")
        self.assertNotIn("no point of the store is selected", done.stderr, where)
        self.assertNotIn(0, shown_points(done.stdout), where)

    def run_file(self, path):
        self.workplace = Workplace(self.folder)
        found = commands(path)
        self.assertTrue(found, path)
        for begin, text in found:
            with self.subTest(block=f"{path.name}:{begin}"):
                self.run_block(f"{path.name}:{begin}", text)

    def test_readme(self):
        self.run_file(ROOT / "README.md")

    def test_command_line(self):
        self.run_file(USER / "command-line.md")

    def test_other_pages(self):
        for name in ("README.md", "paraview.md", "python.md", "cmake.md", "cluster.md",
                     "publishing.md"):
            self.workplace = getattr(self, "workplace", None) or Workplace(self.folder)
            for begin, text in commands(USER / name):
                with self.subTest(block=f"{name}:{begin}"):
                    self.run_block(f"{name}:{begin}", text)

    def test_the_viewer_of_the_page_is_the_example_that_is_built(self):
        shown = [text for language, _, text in blocks(USER / "cmake.md") if language == "cpp"]
        built = (ROOT / "Examples/Cxx/ViewStore/main.cxx").read_text()
        self.assertTrue(any(text in built and "int main" in text for text in shown))

    def test_commands_stand_in_blocks_that_are_run(self):
        for path in (ROOT / "README.md", *sorted(USER.glob("*.md"))):
            for language, begin, text in blocks(path):
                if language != "sh" and text.startswith("pointfront "):
                    self.assertIn("[--", text, f"{path.name}:{begin} is no synopsis")


class Styles(ToolTest):
    """Pages about styles: each JSON block becomes the file that the commands behind it name."""

    def test_styles(self):
        page = USER / "styles.md"
        environment = dict(os.environ, PATH=f"{pathlib.Path(TOOL).parent}:{os.environ['PATH']}")
        styles = 0
        for language, begin, text in blocks(page):
            with self.subTest(block=f"{page.name}:{begin}"):
                if language == "json":
                    (self.folder / "town.json").write_text(text)
                    self.draw("town.json")
                    styles += 1
                elif language == "sh":
                    done = subprocess.run(
                        ["bash", "-euc", text], cwd=self.folder, check=False, capture_output=True,
                        text=True, env=environment, timeout=300)
                    self.assertEqual(done.returncode, 0, f"{text}\n{done.stderr}")
                    self.assertNotIn(0, shown_points(done.stdout), text)
        self.assertGreaterEqual(styles, 2)

    def draw(self, style):
        store = self.folder / "town.pfront"
        if not store.exists():
            self.fail("a page builds the store before it draws it")
        drawn = self.succeed("render", store, "-o", self.folder / "style.png", "--size", "160x90",
                             "--style", self.folder / style)
        self.assertNotIn(0, shown_points(drawn.out))

    def test_gallery(self):
        page = USER / "gallery.md"
        self.succeed("generate", "--points", 100000, "--seed", 3, "-o", self.folder / "town.las")
        self.succeed("build", self.folder / "town.las", "-o", self.folder / "town.pfront",
                     "--layers", "class", "--normals", "pca", "--local-height",
                     "--height-above-ground")
        lines = [line for language, _, text in blocks(page) if language == ""
                 for line in text.splitlines()]
        self.assertGreater(len(lines), 20)
        for line in lines:
            name, style = line.split(":", 1)
            with self.subTest(style=name):
                json.loads(style)
                (self.folder / "one.json").write_text(style)
                self.draw("one.json")


if __name__ == "__main__":
    unittest.main()
