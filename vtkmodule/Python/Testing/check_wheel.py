"""Installs a wheel into a fresh environment and uses it as somebody would who has nothing else.

    check_wheel.py WHEEL
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[3]
CLOUD = ROOT / "Testing/Data/autzen_stadium.laz"
LARGEST = 25 * 1000 * 1000  # bytes


def without_display(folder):
    keep = {name: os.environ[name] for name in ("HOME", "LANG", "PIP_CERT", "PIP_FIND_LINKS")
            if name in os.environ}
    return {**keep, "PATH": f"{folder}/bin:/usr/bin:/bin"}


def check_contents(wheel):
    size = wheel.stat().st_size
    assert size < LARGEST, f"{wheel.name} has {size} bytes"
    names = zipfile.ZipFile(wheel).namelist()
    for name in ("pointfront/py.typed", "pointfront/__init__.pyi", "pointfront/pointfront",
                 "pointfront/pointfrontRenderingCore.pyi",
                 "pointfront/proj/proj.db"):
        assert name in names, name
    assert any(name.endswith("licenses/LICENSE") for name in names)
    assert any("licenses/third-party/libproj" in name for name in names)
    strangers = [name for name in names if "libvtk" in name]
    assert not strangers, strangers  # a second VTK in the process
    print(f"{wheel.name}: {size / 1e6:.1f} MB, {len(names)} files")


USE = """
import pathlib, sys
import pointfront

report = pointfront.build(sys.argv[1], "a.pfront", normals="pca", assumed_crs="EPSG:2994")
with pointfront.open("a.pfront") as cloud:
    assert len(cloud) == report.points_stored == 174151, report
    assert "2994" in cloud.info["crs"], cloud.info["crs"]
    assert cloud.points(where="classification == 2")["position"].shape[1] == 3
    pixels = cloud.screenshot("a.png", size=(320, 200)).pixels
    assert pixels.shape == (200, 320, 3) and pixels.std() > 5
try:
    pointfront.build(sys.argv[1], "b.pfront", color_from="a.png")
    raise SystemExit("images were read")
except pointfront.PointFrontError as error:
    assert "POINTFRONT_IMAGE_COLOR" in str(error), error
maps = pathlib.Path("/proc/self/maps").read_text()
vtks = {line.split("/")[-1] for line in maps.splitlines() if "libvtkCommon" in line}
assert len(vtks) == 1, vtks
assert "libX11" not in maps and "libGL" not in maps, "X or GL is loaded"
"""


# Two VTKs in one process, each with objects of its own.
BESIDE = """
import sys
import pointfront
import vtkmodules.all as kitware

pointfront.build(sys.argv[1], "a.pfront")
with pointfront.open("a.pfront") as cloud:
    assert cloud.points()["position"].shape == (174151, 3)
    assert cloud.screenshot(size=(320, 200)).pixels.std() > 5
assert pointfront.VTK_PACKAGE != kitware.__name__.split(".")[0]
try:
    kitware.vtkActor().SetMapper(pointfront.vtkPointFrontMapper())
    raise SystemExit("an actor of one VTK took a mapper of another")
except TypeError:
    pass
"""


class Environment:
    """A fresh virtual environment in a folder."""

    def __init__(self, folder):
        self._folder = pathlib.Path(folder)
        place = self._folder / "environment"
        subprocess.run([sys.executable, "-m", "venv", place], check=True)
        self._variables = without_display(place)

    def run(self, *command):
        subprocess.run(list(map(str, command)), check=True, cwd=self._folder, env=self._variables)

    def install(self, *what):
        self.run("python", "-m", "pip", "install", "-q", "--disable-pip-version-check", *what)

    def import_error(self):
        run = subprocess.run(["python", "-c", "import pointfront"], cwd=self._folder,
                             env=self._variables, capture_output=True, text=True)
        assert run.returncode == 1, run
        return run.stderr.splitlines()[-1]


def check_use(wheel):
    with tempfile.TemporaryDirectory() as folder:
        environment = Environment(folder)
        environment.install(wheel.resolve())
        environment.run("pointfront", "--version")
        environment.run("python", "-m", "pointfront", "--version")
        environment.run("python", "-c", USE, CLOUD)


def check_other_vtks(wheel):
    """With Kitware's `vtk` alone an import says what to do; with both, both work."""
    with tempfile.TemporaryDirectory() as folder:
        environment = Environment(folder)
        environment.install("vtk", "numpy")
        environment.install("--no-deps", wheel.resolve())
        said = environment.import_error()
        found = re.search(r"ImportError: .* pip install '(cvista\[all\])==([0-9.]+)'", said)
        assert found, said
        name, version = found.groups()
        environment.install("--no-deps", f"cvista=={version}")  # a part of it
        said = environment.import_error()
        assert "there is no cvista.vtkRenderingOpenGL2" in said, said
        older = version[:-1] + str(int(version[-1]) - 1)
        environment.install(f"{name}=={older}")
        said = environment.import_error()
        assert f"built for cvista {version}, and {older} is installed" in said, said
        environment.install(f"{name}=={version}")
        environment.run("python", "-c", BESIDE, CLOUD)


wheel = pathlib.Path(sys.argv[1])
check_contents(wheel)
check_use(wheel)
check_other_vtks(wheel)
print("the wheel works")
