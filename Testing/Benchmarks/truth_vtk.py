#!/usr/bin/python3
"""Draws the points of a folder that `truth` wrote with VTK's own mappers: the peers of a table.

    Testing/Benchmarks/truth_vtk.py FOLDER points|gaussian|discs SIZE OUT.png [CAMERA.json]

points    vtkPolyDataMapper, SIZE pixels wide
gaussian  vtkPointGaussianMapper as it comes, not emissive; sigma of SIZE spacings
discs     vtkPointGaussianMapper with opaque discs of a radius of SIZE spacings

The spacing is that of each point: in a graded view it grows with depth. Needs an X server
(xvfb-run).
"""

import json
import pathlib
import sys

import numpy
import vtk
from vtk.util import numpy_support

TYPES = {"double": "<f8", "float": "<f4", "uchar": "u1"}
OPAQUE_DISC = ("//VTK::Color::Impl\n"
               "if (dot(offsetVCVSOutput.xy, offsetVCVSOutput.xy) > 1.0) { discard; }\n")


def read_ply(path):
    """The vertices of a binary little endian PLY file of scalars, as a structured array."""
    data = path.read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    words = [line.split() for line in data[:end].decode().splitlines()]
    fields = [(line[2], TYPES[line[1]]) for line in words if line[0] == "property"]
    count = next(int(line[2]) for line in words if line[:2] == ["element", "vertex"])
    return numpy.frombuffer(data, numpy.dtype(fields), count, end)


def spacings(positions, camera, facts):
    """The spacing around each point: SpacingGrade.h in numbers."""
    if not facts["graded"]:
        return numpy.full(len(positions), facts["spacing"])
    eye = numpy.array(camera["position"])
    forward = numpy.array(camera["focal_point"]) - eye
    depth = (positions - eye) @ (forward / numpy.linalg.norm(forward))
    level = numpy.floor(numpy.log2(numpy.maximum(depth, 1e-9) / facts["median_depth"]) + 0.5)
    return facts["spacing"] * 2.0 ** level


def poly_data(vertices, radii):
    positions = numpy.stack([vertices[axis] for axis in "xyz"], axis=1)
    colours = numpy.stack([vertices[name] for name in ("red", "green", "blue")], axis=1)
    points = vtk.vtkPoints()
    points.SetData(numpy_support.numpy_to_vtk(positions, deep=True))
    cells = numpy.stack([numpy.ones(len(positions), numpy.int64),
                         numpy.arange(len(positions))], axis=1)
    verts = vtk.vtkCellArray()
    verts.ImportLegacyFormat(numpy_support.numpy_to_vtkIdTypeArray(cells.ravel(), deep=True))
    data = vtk.vtkPolyData()
    data.SetPoints(points)
    data.SetVerts(verts)
    data.GetPointData().SetScalars(
        numpy_support.numpy_to_vtk(numpy.ascontiguousarray(colours), deep=True))
    radius = numpy_support.numpy_to_vtk(radii.astype(numpy.float32), deep=True)
    radius.SetName("radius")
    data.GetPointData().AddArray(radius)
    return data


def make_mapper(technique):
    if technique == "points":
        return vtk.vtkPolyDataMapper()
    mapper = vtk.vtkPointGaussianMapper()
    mapper.EmissiveOff()
    mapper.SetScaleFactor(1.0)
    mapper.SetScaleArray("radius")
    if technique == "discs":
        mapper.SetSplatShaderCode(OPAQUE_DISC)
        mapper.SetTriangleScale(1.8)
    return mapper


def draw(folder, technique, size, out, seen_from=None):
    camera = json.loads((folder / "camera.json").read_text())
    facts = json.loads((folder / "truth.json").read_text())
    vertices = read_ply(folder / "points.ply")
    positions = numpy.stack([vertices[axis] for axis in "xyz"], axis=1)
    mapper = make_mapper(technique)
    mapper.SetInputData(poly_data(vertices, size * spacings(positions, camera, facts)))
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().LightingOff()
    actor.GetProperty().SetPointSize(size if technique == "points" else 1)
    renderer = vtk.vtkRenderer()
    renderer.SetBackground([channel / 255 for channel in facts["background"]])
    renderer.AddActor(actor)
    window = vtk.vtkRenderWindow()
    window.SetMultiSamples(0)
    window.OffScreenRenderingOn()
    window.SetSize(facts["width"], facts["height"])
    window.AddRenderer(renderer)
    camera = json.loads(seen_from.read_text()) if seen_from else camera
    view = renderer.GetActiveCamera()
    view.SetPosition(camera["position"])
    view.SetFocalPoint(camera["focal_point"])
    view.SetViewUp(camera["view_up"])
    view.SetViewAngle(camera["view_angle"])
    renderer.ResetCameraClippingRange()
    window.Render()
    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtk.vtkPNGWriter()
    writer.SetInputConnection(image.GetOutputPort())
    writer.SetFileName(str(out))
    writer.Write()


if __name__ == "__main__":
    draw(pathlib.Path(sys.argv[1]), sys.argv[2], float(sys.argv[3]), sys.argv[4],
         pathlib.Path(sys.argv[5]) if len(sys.argv) > 5 else None)
