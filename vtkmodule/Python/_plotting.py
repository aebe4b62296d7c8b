"""Stored clouds in PyVista: a mapper that a Plotter knows how to treat."""

import json

import pyvista
from pyvista.plotting.mapper import _BaseMapper

from . import _host
from ._errors import PointFrontError, did_you_mean
from .pointfrontCommon import vtkPointFrontStyle
from .pointfrontIOStore import vtkPointFrontReader
from .pointfrontRenderingCore import vtkPointFrontMapper
from .pointfrontRenderingOpenGL2 import vtkOpenGLPointFrontMapper

vtkPolyData = _host.vtk("vtkCommonDataModel").vtkPolyData


def _same_vtk():
    """PyVista can run on several builds of VTK; objects of two of them do not go together."""
    if not issubclass(pyvista.PolyData, vtkPolyData):
        raise PointFrontError(
            f"PyVista runs on another VTK than PointFront, which was built for "
            f"'{_host.VTK_PACKAGE}': set PYVISTA_VTK_BACKEND={_host.VTK_PACKAGE} before PyVista is "
            f"imported; or take plotter.add_mesh(cloud.to_pyvista(...)), or cloud.screenshot()")


class CloudMapper(_BaseMapper, vtkPointFrontMapper):
    """A vtkPointFrontMapper with what PyVista's mappers have."""

    def __init__(self, path, theme=None):
        super().__init__(theme=theme)
        reader = vtkPointFrontReader()
        reader.SetFileName(path)
        self.SetInputConnection(reader.GetOutputPort())
        reader.Update()

    @property
    def dataset(self):
        """The overview, as pyvista.PolyData: at most 100,000 points of the cloud."""
        return pyvista.wrap(self.GetInput())


def _colour(mapper, plotter, scalars, cmap, clim):
    """True if a scalar bar makes sense."""
    overview = mapper.dataset
    active = overview.active_scalars_name
    name = scalars or active
    if name is None or (name == "rgb" and cmap is None):
        if scalars == "rgb" and "rgb" not in overview.point_data:
            raise PointFrontError("the cloud has no attribute 'rgb'")
        return False
    # The overview has no array of what the mapper computes itself.
    computed = {"horizontality": (0.0, 1.0), "global_height": (0.0, 1.0)}
    if name in overview.point_data:
        values = overview.point_data[name]
        if values.ndim > 1:
            raise PointFrontError(f"'{name}' has {values.shape[1]} components: no map for them")
        default = (float(values.min()), float(values.max()))
    elif name in computed:
        default = computed[name]
    else:
        raise PointFrontError(f"the cloud has no attribute '{name}' among "
                              f"{', '.join(sorted(overview.point_data.keys()))}"
                              f"{did_you_mean(name, [*overview.point_data.keys(), *computed])}")
    mapper.lookup_table.cmap = cmap or plotter.theme.cmap
    mapper.ScalarVisibilityOn()
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray(name)
    mapper.SetColorModeToMapScalars()
    mapper.scalar_range = tuple(clim) if clim is not None else default
    mapper.lookup_table.scalar_range = mapper.scalar_range
    return True


def add_cloud(path, plotter, *, scalars=None, cmap=None, clim=None, show_scalar_bar=None,
              scalar_bar_args=None, point_size=None, error=1.0, complete=True, style=None,
              name=None, opacity=1.0, pickable=True, reset_camera=None, render=True):
    """See Cloud.add_to."""
    _same_vtk()
    mapper = CloudMapper(path, theme=plotter.theme)
    mapper.SetTargetError(error)
    mapper.SetComplete(complete)
    if point_size is not None:
        mapper.SetPointSize(point_size)
    mapped = _colour(mapper, plotter, scalars, cmap, clim)
    if style is not None:
        if isinstance(style, (str, dict)):
            text = style if isinstance(style, str) else json.dumps(style)
            style = vtkPointFrontStyle()
            if not style.LoadJSON(text):
                raise PointFrontError("the style is no JSON of styles; see LoadJSON")
        mapper.SetStyle(style)
    actor, _ = plotter.add_actor(pyvista.Actor(mapper=mapper), name=name, pickable=pickable,
                                 reset_camera=reset_camera, render=False)
    actor.prop.opacity = opacity
    if point_size is None:
        # Neighbours meet, as they are at most `error` apart. The theme's 5 px hide each other.
        actor.prop.point_size = 1.0 + error
    if mapped and style is None and show_scalar_bar is not False:
        arguments = {"title": scalars or mapper.GetArrayName(), **(scalar_bar_args or {})}
        plotter.add_scalar_bar(mapper=mapper, **arguments)
    interactor = getattr(plotter, "iren", None)
    if not complete and interactor is not None:
        mapper.RenderWhenDataArrives(interactor.interactor)
    if render:
        plotter.render()
    return actor
