"""A store in PyVista's own web viewer, beside other meshes: trame-vtk draws, by OpenGL.

    pyvista_page.py STORE

It takes trame-pyvista, trame-vtk and trame-vuetify, and an OpenGL; no X server. trame-vtk asks for
Kitware's `vtkmodules`, of which PyVista's objects are none where it runs on another build of VTK:
here that name is given to the VTK that PointFront and PyVista have.
"""

import importlib
import importlib.abc
import importlib.machinery
import sys

import pointfront


class OneVTK(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Whoever imports vtkmodules.X gets X of PointFront's VTK."""

    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] == "vtkmodules":
            return importlib.machinery.ModuleSpec(name, self)
        return None

    def create_module(self, spec):
        return importlib.import_module(spec.name.replace("vtkmodules", pointfront.VTK_PACKAGE, 1))

    def exec_module(self, module):
        pass


if pointfront.VTK_PACKAGE != "vtkmodules":
    sys.meta_path.insert(0, OneVTK())

import pyvista  # noqa: E402
from trame.app import get_server  # noqa: E402
from trame.ui.vuetify3 import VAppLayout  # noqa: E402
from trame.widgets import html  # noqa: E402
from trame_pyvista.ui import plotter_ui  # noqa: E402

pyvista.OFF_SCREEN = True
plotter = pyvista.Plotter()
actor = pointfront.open(sys.argv[1]).add_to(plotter)
plotter.add_mesh(pyvista.Sphere(center=actor.center, radius=actor.length / 20))

sys.argv = sys.argv[:1]  # trame reads it, too
server = get_server(client_type="vue3")
with VAppLayout(server):
    with html.Div(style="position:absolute; inset:0;"):
        plotter_ui(plotter, mode="server", default_server_rendering=True)
server.controller.on_server_ready.add(
    lambda **_: print(f"http://localhost:{server.port}/", flush=True))
server.start(port=0, open_browser=False, show_connection_info=False, timeout=0)
