"""The type stubs of a wheel, as a type checker reads them: mypy."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

RIGHT = """
import pointfront

reader: pointfront.vtkPointFrontReader = pointfront.vtkPointFrontReader()
reader.SetFileName("a.pfront")
mapper = pointfront.vtkPointFrontMapper()
mapper.SetTargetError(2.0)
mapper.SetStyle(pointfront.vtkPointFrontStyle())
error: float = mapper.GetTargetError()
with pointfront.open("a.pfront") as cloud:
    names: list[str] = cloud.attributes
    cloud.points(classes=[2, 6], spacing=0.5)["position"].mean()
"""

WRONG = {  # a line, and what is wrong with it
    "pointfront.vtkPointFrontMapper().SetTargetError('fine')": "arg-type",
    "pointfront.vtkPointFrontReader().SetFileName(3)": "arg-type",
    "pointfront.vtkPointFrontMapper().SetStyle(3)": "arg-type",
    "text: str = pointfront.vtkPointFrontExtract().GetSpacing()": "assignment",
    "pointfront.open('a.pfront').points(box=3)": "arg-type",
    "pointfront.open('a.pfront').pionts()": "attr-defined",
}


class Stubs(unittest.TestCase):
    def check(self, text):
        with tempfile.TemporaryDirectory(prefix="pointfront-stubs-") as folder:
            file = pathlib.Path(folder) / "program.py"
            file.write_text(text)
            run = subprocess.run([sys.executable, "-m", "mypy", "--no-error-summary",
                                  "--cache-dir", folder, str(file)],
                                 capture_output=True, text=True, cwd=folder)
            return run.stdout + run.stderr

    def test_a_right_program_passes(self):
        self.assertEqual(self.check(RIGHT), "")

    def test_wrong_lines_are_found(self):
        said = self.check("import pointfront\n" + "\n".join(WRONG) + "\n")
        for number, (line, kind) in enumerate(WRONG.items(), 2):
            found = [text for text in said.splitlines() if f"program.py:{number}: error" in text]
            self.assertTrue(any(f"[{kind}]" in text for text in found), f"{line}: {said}")

    def test_each_class_has_a_stub(self):
        import pointfront

        folder = pathlib.Path(pointfront.__file__).parent
        text = "".join(file.read_text() for file in folder.glob("pointfront*.pyi"))
        names = [name for name in dir(pointfront) if name.startswith("vtk")]
        self.assertGreater(len(names), 9)
        for name in names:
            self.assertIn(f"class {name}(", text)


if __name__ == "__main__":
    unittest.main(verbosity=2)
