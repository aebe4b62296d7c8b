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
sys.path.append(str(ROOT / "Testing/Support"))

from far_server import FarServer

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
assert "libvtk" not in maps, "VTK is loaded"
assert "libX11" not in maps and "libGL" not in maps, "X or GL is loaded"
"""

# The store of USE by its address, in Python and by the tool; nobody vouches for the second server.
FAR = """
import subprocess, sys
import pointfront

plain, secure = (f"{scheme}://127.0.0.1:{port}/a.pfront"
                 for scheme, port in zip(("http", "https"), sys.argv[1:]))
with pointfront.open("a.pfront") as cloud, pointfront.open(plain) as far:
    assert (far.points()["position"] == cloud.points()["position"]).all()
    assert (far.screenshot(size=(320, 200)).pixels
            == cloud.screenshot(size=(320, 200)).pixels).all()
subprocess.run(["pointfront", "info", plain], check=True, capture_output=True)
told = subprocess.run(["pointfront", "info", secure], capture_output=True, text=True)
assert told.returncode == 1 and "certificate" in told.stderr, told
"""

# PyVista on Kitware's VTK, and PointFront beside it: each as if it were alone.
BESIDE_PYVISTA = """
import sys
import numpy
import pyvista
import vtk
from vtkmodules.vtkFiltersSources import vtkSphereSource

import pointfront

assert isinstance(pyvista.Sphere(), vtk.vtkPolyData), "PyVista runs on another VTK than `vtk`"
source = vtkSphereSource()
source.Update()
assert pyvista.wrap(source.GetOutput()).n_points == source.GetOutput().GetNumberOfPoints()

pointfront.build(sys.argv[1], "a.pfront", overwrite=True)
with pointfront.open("a.pfront") as cloud:
    low, high = map(numpy.array, cloud.bounds)
    box = (low, (low + high) / 2)
    mesh = cloud.to_pyvista(box=box)
    assert isinstance(mesh, vtk.vtkPolyData) and mesh.n_points > 1000
    points = cloud.points(box=box)
    assert (mesh.points == points["position"]).all()
    assert (mesh["intensity"] == points["intensity"]).all()
    assert (mesh["point_id"] == points["id"]).all()
    assert mesh["rgb"].dtype == numpy.uint8 and mesh.active_scalars_name == "rgb"
    assert mesh.threshold((100, 200), scalars="intensity").n_points > 0
    picture = cloud.screenshot(size=(320, 200))
    image = pyvista.wrap(numpy.ascontiguousarray(picture.pixels[::-1].reshape(-1, 3)))
    assert image.n_points == 320 * 200
    try:
        cloud.add_to(None)
        raise SystemExit("a plotter of another VTK was taken")
    except pointfront.PointFrontError as error:
        assert "to_pyvista" in str(error) and "pointfront[vtk]" in str(error), error
maps = open("/proc/self/maps").read()
assert "cvista" not in maps, "another VTK was loaded"
"""

# A picture by PyVista's own way, where there is a display.
DRAWN = """
import numpy, pyvista, pointfront

mesh = pointfront.open("a.pfront").to_pyvista()
plotter = pyvista.Plotter(off_screen=True, window_size=(320, 200))
plotter.add_mesh(mesh, scalars="rgb", rgb=True, point_size=3)
assert plotter.screenshot(return_img=True).std() > 5
"""

# Two VTKs in one process, each with objects of its own.
BESIDE = """
import sys
import pointfront
import vtkmodules.all as kitware

pointfront.build(sys.argv[1], "a.pfront", overwrite=True)
with pointfront.open("a.pfront") as cloud:
    assert cloud.points()["position"].shape == (174151, 3)
    assert cloud.extract().GetNumberOfPoints() == 174151
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

    def said_of_classes(self):
        """Returns what an import of a VTK class says that cannot be had."""
        run = subprocess.run(["python", "-c", "from pointfront import vtkPointFrontReader"],
                             cwd=self._folder, env=self._variables, capture_output=True, text=True)
        assert run.returncode == 1, run
        return run.stderr.splitlines()[-1]

    def list(self):
        run = subprocess.run(["python", "-m", "pip", "list", "--format=freeze"], cwd=self._folder,
                             env=self._variables, capture_output=True, text=True, check=True)
        return {line.split("==")[0] for line in run.stdout.split()}


def check_use(wheel):
    with tempfile.TemporaryDirectory() as folder:
        environment = Environment(folder)
        environment.install(wheel.resolve())
        environment.run("pointfront", "--version")
        environment.run("python", "-m", "pointfront", "--version")
        environment.run("python", "-c", USE, CLOUD)
        own = pathlib.Path(folder) / "own.pem"
        subprocess.run(["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2",
                        "-subj", "/CN=localhost", "-keyout", own, "-out", own], check=True,
                       capture_output=True)
        with FarServer(folder) as plain, FarServer(folder, str(own)) as secure:
            environment.run("python", "-c", FAR, plain.port, secure.port)


def check_beside_pyvista(wheel):
    """In one environment with Kitware's `vtk` and PyVista, which keeps its VTK; then with the VTK
    of the classes beside them, in all its states.
    """
    with tempfile.TemporaryDirectory() as folder:
        environment = Environment(folder)
        environment.install("vtk", "pyvista", wheel.resolve())
        assert not any(name.startswith("cvista") for name in environment.list())
        environment.run("python", "-c", BESIDE_PYVISTA, CLOUD)
        if "DISPLAY" in os.environ:
            environment.run("env", f"DISPLAY={os.environ['DISPLAY']}", "LIBGL_ALWAYS_SOFTWARE=1",
                            "python", "-c", DRAWN)
        said = environment.said_of_classes()
        found = re.search(
            r"ImportError: .*'pointfront\[vtk\]', .* (cvista)\[all\]==([0-9.]+)", said)
        assert found, said
        name, version = found.groups()
        environment.install("--no-deps", f"{name}=={version}")  # a part of it
        said = environment.said_of_classes()
        assert f"there is no {name}.vtkRenderingOpenGL2" in said, said
        older = version[:-1] + str(int(version[-1]) - 1)
        environment.install(f"{name}[all]=={older}")
        said = environment.said_of_classes()
        assert f"built for {name} {version}, and {older} is installed" in said, said
        environment.install(f"{wheel.resolve()}[vtk]")
        environment.run("python", "-c", BESIDE, CLOUD)


wheel = pathlib.Path(sys.argv[1])
check_contents(wheel)
check_use(wheel)
check_beside_pyvista(wheel)
print("the wheel works")
