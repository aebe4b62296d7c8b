"""Where VTK is missing, stores, arrays, files and pictures work; all else says so."""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

CLOUD = pathlib.Path(__file__).resolve().parents[3] / "Testing/Data/autzen_stadium.laz"

# A Python that finds no VTK, of whichever package.
ALONE = """
import pathlib, sys


class NoVTK:
    def find_spec(self, name, *_):
        if name.split(".")[0] in ("vtk", "vtkmodules", "cvista"):
            raise ModuleNotFoundError(f"No module named '{name}'", name=name)


sys.meta_path.insert(0, NoVTK())
import numpy, pointfront, warnings

warnings.simplefilter("ignore")
folder = pathlib.Path(sys.argv[2])
"""

USED = """
import pickle

steps = []
report = pointfront.build(sys.argv[1], folder / "a.pfront", node_points=2000, preview=False,
                          progress=lambda phase, part: steps.append(part))
assert report.points_stored == 174151, report
assert steps[0] == 0.0 and steps[-1] == 1.0 and steps == sorted(steps), steps
with pointfront.open(folder / "a.pfront") as cloud:
    everything = cloud.points()
    xyz = everything["position"]
    low, high = cloud.bounds
    assert (xyz.min(axis=0) == low).all() and (xyz.max(axis=0) == high).all()
    assert set(everything) == {"position", "id", *cloud.attributes}
    middle = (numpy.array(low) + high) / 2
    inside = (xyz <= middle).all(axis=1)
    assert set(cloud.points(box=(low, middle))["id"]) == set(everything["id"][inside])
    assert sum(len(c["id"]) for c in cloud.chunks(50000)) == len(cloud)
    assert cloud.export(folder / "part.las", box=(low, middle)) == inside.sum()
    assert cloud.screenshot(size=(320, 200)).pixels.std() > 5
    assert len(pickle.loads(pickle.dumps(cloud))) == len(cloud)
    assert "174,151" in cloud._repr_html_()
pointfront.build(everything, folder / "own.pfront", preview=False)
own = pointfront.open(folder / "own.pfront").points(attributes=["intensity"])
assert sorted(own["intensity"]) == sorted(everything["intensity"])
side = pointfront.index(folder / "part.las")
assert len(pointfront.open(side)) == inside.sum()
maps = pathlib.Path("/proc/self/maps").read_text()
assert "libvtk" not in maps and "libX11" not in maps and "libGL" not in maps, "VTK, X or GL"
"""

SAID = """
pointfront.build(sys.argv[1], folder / "b.pfront", preview=False)
cloud = pointfront.open(folder / "b.pfront")
for refused in (cloud.extract, lambda: cloud.add_to(None), cloud.show):
    try:
        refused()
        raise SystemExit(f"{refused} was not refused")
    except pointfront.PointFrontError as error:
        assert "install" in str(error), error
try:
    pointfront.vtkPointFrontReader
    raise SystemExit("there is a class of VTK's")
except ImportError as error:
    assert f"no {pointfront.VTK_PACKAGE}." in str(error) and "install" in str(error), error
try:
    pointfront.nothing_of_that_name
    raise SystemExit("there is nothing of that name")
except AttributeError:
    pass
"""


class WithoutVTK(unittest.TestCase):
    def run_alone(self, code):
        folder = tempfile.mkdtemp(prefix="pointfront-alone-")
        self.addCleanup(shutil.rmtree, folder)
        run = subprocess.run([sys.executable, "-c", ALONE + code, str(CLOUD), folder],
                             capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)

    def test_stores_arrays_files_and_pictures(self):
        self.run_alone(USED)

    def test_what_is_vtks_says_what_to_install(self):
        self.run_alone(SAID)


if __name__ == "__main__":
    unittest.main(verbosity=2)
