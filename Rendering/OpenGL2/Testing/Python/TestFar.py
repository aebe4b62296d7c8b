"""Reads and draws a store by its address: the points and the picture of the file, or an error.

usage: TestFar.py STORE SUPPORT_FOLDER
"""
import contextlib
import pathlib
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, sys.argv[2])

# pylint: disable=wrong-import-position
from far_setting import HERE, SECRET
import numpy
import pointfront
from vtkmodules.util.numpy_support import vtk_to_numpy

from shown import Shown

@contextlib.contextmanager
def served(folder):
    """The origin of a server in a process of its own: VTK keeps Python's threads waiting."""
    script = pathlib.Path(sys.argv[2]) / "far_server.py"
    with subprocess.Popen([sys.executable, "-B", script, folder], stdin=subprocess.PIPE,
                          stdout=subprocess.PIPE, text=True) as server:
        yield f"http://{HERE}:{server.stdout.readline().strip()}"
        server.stdin.close()


def check(condition, message):
    if not condition:
        sys.exit("TestFar.py: " + message)


def reader_of(name):
    reader = pointfront.vtkPointFrontReader()
    reader.SetFileName(str(name))
    reader.heard = []

    def hear(_, __, text):
        reader.heard.append(text)
    hear.CallDataType = "string0"
    reader.AddObserver("ErrorEvent", hear)
    return reader


def points(reader):
    reader.Update()
    data = reader.GetOutput()
    attributes = data.GetPointData()
    arrays = [attributes.GetArray(i) for i in range(attributes.GetNumberOfArrays())]
    return {"": vtk_to_numpy(data.GetPoints().GetData()),
            **{array.GetName(): vtk_to_numpy(array) for array in arrays}}


def drawn(reader):
    shown = Shown(reader)
    shown.mapper.CompleteOn()
    shown.renderer.ResetCamera()
    shown.window.Render()
    return shown.pixels()


store = pathlib.Path(sys.argv[1])
with served(store.parent) as origin, tempfile.TemporaryDirectory() as folder:
    address = f"{origin}/{store.name}?{SECRET}"
    near, far = reader_of(store), reader_of(address)
    check(pointfront.vtkPointFrontReader.CanReadFile(address) == 1, "CanReadFile says no")
    for missing in (f"{origin}/none.pfront", f"{origin}/~forbidden/{store.name}"):
        check(pointfront.vtkPointFrontReader.CanReadFile(missing) == 0, "CanReadFile: " + missing)
    here, there = points(near), points(far)
    check(not far.heard, f"errors: {far.heard}")
    check(here.keys() == there.keys() and len(here[""]) > 100000, "other arrays")
    check(all(numpy.array_equal(here[name], there[name]) for name in here), "other points")
    check(near.GetStore() != far.GetStore(), "one store for two places")
    check(far.GetFileName() == address, "another file name")
    told = str(far) + far.GetStore().GetFileName() + str(far.GetStore()) + str(far.GetOutput())
    check("VERY-SECRET" not in told, "the secret is told")
    check((drawn(near) == drawn(far)).all(), "another picture")
    check((drawn(far).max(axis=1) > 0).mean() > 0.2, "most of the picture is empty")
    # Errors say what, where and what to try, once.
    for weather, words in (("~forbidden/", "403"), ("none/", "404"), ("~storms/", "503"),
                           ("~gzipped/", "compressed")):
        bad = reader_of(f"{origin}/{weather}{store.name}?{SECRET}")
        bad.Update()
        check(len(bad.heard) >= 1 and words in bad.heard[0], f"{weather}: {bad.heard}")
        check("VERY-SECRET" not in "".join(bad.heard), "the error tells the secret")
        check(bad.GetErrorCode() != 0, f"{weather}: no error code")
        check(bad.GetOutput().GetNumberOfPoints() == 0, f"{weather}: there are points")
    unknown = reader_of("gopher://host/cloud.pfront")
    unknown.Update()
    check("https" in unknown.heard[0], f"{unknown.heard}")
    # The pipeline stops it: an empty output, and no error.
    stopped = reader_of(f"{origin}/./{store.name}")
    stopped.AddObserver("ProgressEvent", lambda *_: stopped.AbortExecuteOn())
    stopped.Update()
    check(stopped.GetOutput().GetNumberOfPoints() == 0 and not stopped.heard, f"{stopped.heard}")
    # A file that is replaced is an error, never a mixture; opened again, it is the new one.
    pointfront.build(store, pathlib.Path(folder) / "a.pfront", node_points=2000, preview=False)
    with served(folder) as other:
        name = pathlib.Path(folder) / "a.pfront"
        changing = reader_of(f"{other}/a.pfront")
        changing.UpdateInformation()
        half = numpy.array(points(reader_of(name))[""][::2])
        pointfront.build({"position": half}, name, preview=False, overwrite=True)
        changing.Update()
        check("changed on its server" in "".join(changing.heard), f"{changing.heard}")
        deadline = time.monotonic() + 300
        while changing.GetOutput().GetNumberOfPoints() != len(half):
            check(time.monotonic() < deadline, "not the new file")
            time.sleep(0.5)  # the error is remembered for a moment
            changing.Modified()
            changing.Update()
