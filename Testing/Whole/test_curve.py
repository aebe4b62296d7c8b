"""docs/tradeoffs/curve.csv is of today's code, and what the page shows is of that file."""

import argparse
import csv
import hashlib
import pathlib
import re
import shlex
import subprocess
import sys
import unittest

from tool import TOOL, ToolTest

ROOT = pathlib.Path(__file__).resolve().parents[2]
CURVE = ROOT / "docs/tradeoffs/curve.csv"
sys.path.insert(0, str(ROOT / "Testing/Benchmarks"))
import quality_curve  # noqa: E402 (found by the line above)
from curve_scenes import scenes  # noqa: E402

TABLE = re.compile(r"<!-- table: (Testing/Benchmarks/curve_tables\.py .+?) -->\n"
                   r"(.*?)<!-- end of table -->", flags=re.S)


class Rows(ToolTest):
    """Some rows of the bundled cloud, measured again: everything but times and memory."""

    def test_the_curve_is_of_this_code(self):
        with open(CURVE, newline="", encoding="utf-8") as file:
            rows = [row for row in csv.DictReader(file)
                    if row["scene"] == "stadium" and row["structure"] == "octree"
                    and row["precision"] == "the file's"]
        build = pathlib.Path(TOOL).parent.parent
        curve = quality_curve.Curve(argparse.Namespace(build=build, errors=(1, 4)), None)
        curve.tool = TOOL
        [scene] = scenes(["stadium"], TOOL, None, None, self.folder)
        store = scene.store()
        view = next(view for view in scene.views(("far",)))
        for technique, error_px in (("points", 4), ("discs", 4), ("ellipses", 4), ("blended", 4),
                                    ("ewa full", 4), ("draft", 2), ("balanced", 1)):
            [row] = [row for row in rows if row["view"] == "far" and row["state"] == "complete"
                     and row["technique"] == technique and float(row["error_px"]) == error_px]
            case = {"technique": technique, "error_px": error_px}
            now = curve.complete(scene, store, view, case, False)
            with self.subTest(technique=technique, error_px=error_px):
                self.assertEqual(now["points"], int(row["points"]))
                self.assertEqual(now["bytes_read"], int(row["bytes_read"]))
                self.assertAlmostEqual(now["psnr"], float(row["psnr"]), delta=0.05)
                for column in ("ssim", "off8", "holes", "bloat"):
                    self.assertAlmostEqual(now[column], float(row[column]), delta=0.002)


class Page(unittest.TestCase):
    def test_tables_are_of_the_curve(self):
        tables = TABLE.findall((ROOT / "docs/tradeoffs.md").read_text(encoding="utf-8"))
        self.assertGreaterEqual(len(tables), 4)
        for command, shown in tables:
            with self.subTest(command=command):
                printed = subprocess.run(shlex.split(command), cwd=ROOT, text=True, check=True,
                                         stdout=subprocess.PIPE).stdout
                self.assertEqual(printed, shown)

    def test_plots_are_of_the_curve(self):
        made_of = hashlib.sha256(CURVE.read_bytes()).hexdigest()
        for name in ("time", "bytes", "memory"):
            self.assertIn(made_of, CURVE.with_name(f"{name}.svg").read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
