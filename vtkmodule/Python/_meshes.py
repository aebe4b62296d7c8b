"""Points as PyVista's meshes, of whichever VTK PyVista runs on."""

from ._errors import PointFrontError

try:
    import pyvista
except ImportError as missing:
    raise PointFrontError(f"a mesh needs Python's package pyvista: pip install pyvista ({missing})"
                          ) from None


def mesh_of(arrays):
    """pyvista.PolyData of Cloud.points()'s arrays, which it keeps and does not copy."""
    arrays = dict(arrays)
    mesh = pyvista.PolyData(arrays.pop("position"))
    if "point_id" in arrays:
        arrays["point_id_"] = arrays.pop("point_id")
    arrays["point_id"] = arrays.pop("id")
    for name, values in arrays.items():
        mesh.point_data.set_array(values, name[:-1] if name in ("position_", "id_") else name)
    if "rgb" in arrays:
        mesh.set_active_scalars("rgb")
    return mesh
