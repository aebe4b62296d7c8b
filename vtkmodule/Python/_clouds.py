"""Stores as Python objects: what they hold, points of them as NumPy arrays, and pictures."""

import html
import operator
import os
import tempfile

from . import _arrays, _far, _host, _kernel, _pictures
from ._errors import PointFrontError, warn
from ._queries import KERNEL_OPTIONS, Conditions, class_numbers, with_limits


class Cloud:
    """A stored cloud: a store, an index, a COPC file, an EPT tree, a list (.pfronts, .vpc),
    a collection (.pfcollection) or a folder.
    Stores, COPC, EPT and lists may lie behind an address of http, https or s3.

    path        as it was found; an address without user, password and query
    bounds      ((x0, y0, z0), (x1, y1, z1)) in the units of the coordinate system: tight for stores
                and indices; of COPC and EPT the box that the file names, which may be larger
    attributes  names
    classes     {number: name} of object classes with a tree of their own
    info        what `pointfront info --json` tells, as a dictionary; of a folder as of one cloud
    crs         coordinate reference system as well-known text; None: the cloud names none
    len(cloud)  how many points

    Opening reads no points. What a cloud lacks (a folder of LAZ files gives a first look, one point
    of each chunk) is a PointFrontWarning. A cloud is a context manager: leaving it lets go of the
    file. Pickled, it is its absolute path, and is opened again where it is unpickled; of an
    address, what is not secret. A notebook shows a table.
    """

    def __init__(self, path):
        self._store = None
        given = os.fsdecode(path)
        self._path = given
        self._store = _kernel.StoredCloud(given)
        # As JSON tells it, it has lost what is no UTF-8; it is another for a preview that is gone.
        self._path = (os.path.realpath(given) if os.path.exists(given)
                      else self._store.description["path"])
        if _far.is_address(given):
            self._path = _far.named(given, self._path)
        self._warnings = [f"{self._path}: {text}" for text in self._store.description["warnings"]]
        warn(self._warnings)

    def close(self):
        """Let go of the file. Arrays and pictures stay."""
        self._store = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def _opened(self):
        if self._store is None:
            raise PointFrontError(f"{self._path}: this cloud was closed; open it again")
        return self._store

    @property
    def path(self):
        return self._path

    def __len__(self):
        return self._opened().description["points"]

    @property
    def bounds(self):
        x0, y0, z0, x1, y1, z1 = self._opened().bounds
        return (x0, y0, z0), (x1, y1, z1)

    @property
    def attributes(self):
        return list(self._opened().description["attributes"])

    @property
    def classes(self):
        return {number: name for number, name in self._opened().description["classes"]}

    @property
    def info(self):
        self._opened()
        return _pictures.described(self._path)

    @property
    def crs(self):
        return self.info.get("crs") or None

    def __reduce__(self):
        self._opened()
        path = self._path
        told = _far.told_to_child(path if _far.is_address(path) else os.path.abspath(path))
        return _reopened, told

    def _repr_html_(self):
        if self._store is None:
            return html.escape(repr(self))
        low, high = self.bounds
        crs = self.crs
        rows = {"points": f"{len(self):,}",
                "bounds": " – ".join(str(tuple(round(v, 3) for v in end)) for end in (low, high)),
                "crs": "none" if crs is None else crs.split('"')[1] if '"' in crs else crs,
                "attributes": ", ".join(self.attributes)}
        if self.classes:
            rows["classes"] = ", ".join(f"{n} {name}" for n, name in self.classes.items())
        cells = "".join(f"<tr><th>{name}</th><td>{html.escape(text)}</td></tr>"
                        for name, text in rows.items())
        return f"<table><caption>{html.escape(self.path)}</caption>{cells}</table>"

    def __repr__(self):
        if self._store is None:
            return f"<{self._path}: closed>"
        return f"<{self._path}: {len(self)} points>"

    def extract(self, *, box=None, sphere=None, area=None, classes=None, where=None, spacing=None,
                attributes=None, progress=None, **options):
        """The exact points of a region as vtkPolyData: all that meet every condition.

        box         ((x0, y0, z0), (x1, y1, z1)), or six numbers in that order; its lowest corner
                    first
        sphere      ((x, y, z), radius)
        area        polygons or lines as well-known text, for all heights
        classes     a number of an object class, or several; None: all
        where       a condition: "classification in {2, 6} and intensity > 20"
        spacing     how far apart points may be, in units of the coordinates, for a coarser subset:
                    the fewest whole levels of the tree whose own spacing is at most that. Each
                    level halves the spacing, so neighbours are between that far apart and half of
                    it, some closer still: no least distance is kept. None: all points
        attributes  names of those to read; None: all
        progress    called with (phase, fraction); False ends it. True: a bar, by tqdm
        options     other properties of vtkPointFrontExtract in snake case: line_distance,
                    maximum_number_of_points, memory_limit ...

        Point data: the attributes, and "point_id", the number in the store. Raises PointFrontError;
        ValueError for an argument that cannot be meant (a box of other than six numbers or with its
        corners swapped, no class); KeyboardInterrupt at once. Other threads run meanwhile.
        """
        self._opened()
        _host.require_vtk("extract() gives VTK's data; points() gives NumPy arrays")
        from . import _extracts

        conditions = Conditions(self, box, sphere, area, classes, where, spacing, attributes)
        return _extracts.extracted(self.path, conditions, progress, with_limits(options))

    def points(self, *, box=None, sphere=None, area=None, classes=None, where=None, spacing=None,
               attributes=None, progress=None, **options):
        """Points as NumPy arrays by name; which, and `progress`, as for extract().

        options  line_distance (of lines in `area`), maximum_number_of_points, memory_limit (bytes
                 of what is being read), colors_as_stored; those of extract() that are objects of
                 VTK, frustum and point_ids among them, where a VTK is installed

        "position" n by 3, float64, in the store's coordinates; "id" n, int64: the number in the
        store; each attribute n, or n by its components, in its type, or float64 if it has a scale.
        "rgb" is as it is stored, too, of 16 bits where the store has 16; colors_as_stored=False
        gives bytes, as extract() and to_pyvista() do: the upper ones if any value has 16 bits.
        The cloud's own attributes "position" and "id" are "position_" and "id_"; `where` and
        `attributes` take their own names.
        Nothing is copied: an array is the memory that the kernel read the points into.
        A region that lies beside the cloud is a PointFrontWarning.
        """
        conditions = Conditions(self, box, sphere, area, classes, where, spacing, attributes)
        return self._arrays(conditions, progress, with_limits(options))

    def _arrays(self, conditions, progress, options, piece=0, pieces=1):
        """By the kernel, or by VTK where an option is one of VTK's objects."""
        store = self._opened()
        if KERNEL_OPTIONS.issuperset(options):
            return conditions.arrays(store, progress, piece=piece, pieces=pieces, **options)
        _host.require_vtk(f"{', '.join(sorted(set(options) - KERNEL_OPTIONS))}: VTK's objects")
        from . import _extracts

        return _extracts.arrays_of(self.path, conditions, progress, options, piece, pieces)

    def chunks(self, size=1_000_000, *, box=None, sphere=None, area=None, classes=None, where=None,
               spacing=None, attributes=None, progress=None, **options):
        """The same points as points(), as an iterator of such dictionaries with `size` points
        each, the last with fewer: for more than memory holds. A chunk is read when it is asked
        for. `progress` is of each chunk.
        """
        size = operator.index(size)
        if size < 1:
            raise ValueError("a chunk has at least one point")
        conditions = Conditions(self, box, sphere, area, classes, where, spacing, attributes)
        self._opened()
        options = with_limits(options)
        pieces = max(1, -(-len(self) // size))

        def parts():
            for piece in range(pieces):
                yield self._arrays(conditions, progress, options, piece, pieces)

        return _arrays.joined(parts(), size)

    def export(self, path, *, box=None, sphere=None, area=None, classes=None, where=None,
               spacing=None, crs=None, overwrite=False, progress=None, line_distance=0.0,
               **options):
        """Write points to a LAS, LAZ, PLY, PCD, XYZ or CSV file; its name says which.

        box, sphere, area, classes, where, spacing, progress   as for extract()
        line_distance   of lines in `area`
        crs        to transform into: "EPSG:25832", or a file of well-known text
        overwrite  replace a file that is there
        options    others of `pointfront export` in snake case: color_depth=16, polygon="a.geojson".
                   Not `attributes`: the file has all that the cloud stores

        Returns how many points were written. What was wrong and survived is a PointFrontWarning.
        Raises PointFrontError, and ValueError and TypeError as points() does; KeyboardInterrupt,
        with nothing left behind unless the file was complete by then.
        """
        self._opened()
        if "attributes" in options:
            raise TypeError("export() takes no `attributes`: a file has all that the cloud stores; "
                            "points(attributes=...) reads some, build(attributes=...) stores some")
        conditions = Conditions(self, box, sphere, area, classes, where, spacing, None)
        chosen = {**conditions.options(), "crs": crs, "force": overwrite, **options}
        with tempfile.TemporaryDirectory(prefix="pointfront-") as folder:
            for name, value in conditions.area_options(folder, line_distance).items():
                if name in options:
                    raise TypeError(f"export() takes `area` or `{name}`, not both")
                chosen[name] = value
            return _pictures.export(self._path, os.fsdecode(path), chosen, self._warnings, progress)

    def to_pyvista(self, **query):
        """Points of a region as pyvista.PolyData, of whichever VTK PyVista runs on; `query` as for
        points(). Numbers are called "point_id", colours are bytes.
        """
        from ._meshes import mesh_of

        return mesh_of(self.points(**{"colors_as_stored": False, **query}))

    def add_to(self, plotter, **options):
        """Add the cloud to a pyvista.Plotter: drawn from the store, however large it is.

        scalars     an attribute, "rgb", "elevation", "horizontality", "global_height"; None: the
                    first of rgb, classification, intensity and elevation that says something
        cmap        PyVista's or Matplotlib's name of a colour map
        clim        (low, high) of the map; None: the attribute's range in the overview
        show_scalar_bar, scalar_bar_args   as in add_mesh; a bar unless the colours are rgb
        point_size  pixels; None: `error` and one more, so that neighbours meet
        error       projected point spacing to refine to, in pixels
        complete    a render of a view at rest waits for all of it: for screenshots. False: the
                    view refines before the user's eyes
        style       classes and techniques: JSON, a dictionary of that, or a vtkPointFrontStyle
        name, opacity, pickable, reset_camera, render   as in add_mesh

        Returns the pyvista.Actor; its mapper is a vtkPointFrontMapper.
        """
        self._opened()
        _host.require_vtk(
            "add_to() draws by VTK; plotter.add_mesh(cloud.to_pyvista()) does without")
        from . import _plotting

        return _plotting.add_cloud(self.path, plotter, **options)

    def screenshot(self, path=None, *, size=(1280, 720), color_by=None, view=None, camera=None,
                   technique=None, style=None, classes=None, where=None, error=None,
                   background=None, **options):
        """A picture of the cloud, drawn in software: no display, no OpenGL, the same bits anywhere.

        path        a file to write, whose name ends in .png; None: the Picture only
        size        (width, height) in pixels
        color_by    an attribute, "rgb", "elevation" ...
        view        "iso", "top", "front", "back", "left" or "right"
        camera      instead of view: a camera file (JSON), or a dictionary of that
        technique   "points", "splats", "spheres" or "ewa"
        style       a file of styles (JSON), or a dictionary of that
        classes     numbers of object classes
        where       a condition on attributes
        error       projected point spacing to refine to, in pixels
        background  (red, green, blue), 0 to 255
        options     others of `pointfront render` in snake case: edl=True, point_size=3 ... There
                    is no `progress`

        Returns a Picture: `.pixels` are height by width by 3, uint8. A picture that is coarser than
        `error` asks is a PointFrontWarning. Raises PointFrontError.
        """
        self._opened()
        if "progress" in options:
            raise TypeError("screenshot() takes no `progress`: it does not know how far it is")
        options.update(color_by=color_by, view=view, camera=camera, technique=technique,
                       style=style, classes=class_numbers(classes) or None, where=where,
                       error=error, background=background)
        return _pictures.draw(self._path, path, size, options, self._warnings)

    def show(self, *, size=(1280, 720), title=None):
        """Show the cloud in a window until the user closes it; in a notebook, as a view in the
        cell, drawn here without a display (the package's extra `web`), which is returned. Raises
        PointFrontError without a display: use screenshot() there.
        """
        if _in_notebook():
            from ._page import view_of_cell

            return view_of_cell([self._path], height=size[1])
        self._opened()
        _host.require_vtk("a window is VTK's; screenshot() and `pointfront serve` do without")
        from . import _window

        _window.show(self.path, size, title or self.path)
        return None


def _reopened(path, headers):
    return open(path, headers=headers and dict(line.split(": ", 1) for line in headers))


def _in_notebook():
    """Whether this process is the kernel of a notebook."""
    try:
        from IPython import get_ipython
    except ImportError:
        return False
    shell = get_ipython()
    return shell is not None and hasattr(shell, "kernel")


def open(path, *, headers=None, token=None,  # as in gzip.open: the module's name says what
         offline=None, cache=None, cache_size=None, timeout=None):
    """Open a stored cloud; see Cloud. Raises PointFrontError.

    headers     {"Name": "value"} of requests to the server of an address
    token       the header "Authorization: Bearer TOKEN"
    offline     True: no server is asked; the cloud is what the cache has
    cache       the folder of the cache on the disk; False: none
    cache_size  most bytes in that folder, also as "512M" or "4G"; 0: no cache
    timeout     seconds that a read waits while nothing comes, at most

    Headers and a token are for all clouds of that server which this process opens from then on. The
    others are for this cloud alone, its pictures and exports included, and for addresses only; None
    is what the environment says (POINTFRONT_OFFLINE, POINTFRONT_CACHE, POINTFRONT_CACHE_SIZE,
    POINTFRONT_REMOTE_TIMEOUT).
    """
    if headers is not None or token is not None:
        _far.use_headers(path, headers, token)
    return Cloud(_far.with_settings(path, offline, cache, cache_size, timeout))
