"""Which room may know which.

    std, GLM <- vtkmodule/Core <- vtkmodule/Common <- IO/* Filters/* Rendering/* <- paraview-plugin

No edge among IO, Filters and Rendering, nor between two modules of IO or of Filters, but that
IO/Formats knows all readers, and the normals that clouds in place are given while they load
(ASSEMBLY_NEEDS), and Filters/Passes all passes: plain C++, which the VTK modules that open files
and build stores may know (ASSEMBLY_USERS). A foreign
library is known to the .cxx files of exactly one module. Tests may include anything; nothing
includes tests, examples or the plugin. Examples and consumers see only what is installed.
"""

import math
import re

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')

FOREIGN = (  # header, library, the one module that may include it
    (re.compile(r"^laszip/"), "LASzip", "IO/LAS"),
    (re.compile(r"^(pcl|flann|Eigen)/"), "PCL, FLANN and Eigen", "Filters/Normals"),
    (re.compile(r"^zlib\.h$"), "zlib", "IO/Text"),
    (re.compile(r"^proj(_experimental)?\.h$"), "PROJ", "Filters/Projection"),
    (re.compile(r"^png\.h$"), "libpng", "IO/PNG"),
    (re.compile(r"^tiffio\.h$"), "libtiff", "Filters/ImageColor"),
    (re.compile(r"^OpenImageIO/"), "OpenImageIO", "Filters/ImageColor"),
    (re.compile(r"^(GL|GLES\d?|EGL)/|^vtk_gl(ew|ad)\.h$|^glad/"), "OpenGL", "Rendering/OpenGL2"),
)
VTK = re.compile(r"^(vtk[A-Z_]\w*\.(h|txx)|vtksys/.*|pointfront\w+Module\.h)$")
PARAVIEW = re.compile(r"^(pq|vtkPV|vtkSM|vtkSI)[A-Z]\w*\.h$")
TEST_LIBRARY = re.compile(r"^(gtest|gmock|benchmark)/")
OUTSIDE = ("Examples", "Testing", "docs", "CommandLine")
LAYERS = ("IO", "Filters", "Rendering")
ASSEMBLIES = ("IO/Formats", "Filters/Passes")  # put together what their neighbours offer
ASSEMBLY_NEEDS = {"IO/Formats": ("Filters/Normals",)}  # assembly: rooms beyond its neighbours
ASSEMBLY_USERS = {  # room: assemblies that it may know
    "vtkmodule/Common": ("IO/Formats",),
    "Filters/Build": ASSEMBLIES,
}


def module_of(path):
    """The room of a file: "vtkmodule/Core", "IO/LAS", "Rendering/OpenGL2", "Testing" ..."""
    parts = path.split("/")
    if "Testing" in parts[:-1]:
        return "Testing"
    if len(parts) > 2 and parts[0] in ("vtkmodule",) + LAYERS:
        return "/".join(parts[:2])
    return parts[0] if len(parts) > 1 else ""


def may_know(room, other):
    """May a file of `room` include a header of the project's room `other`?"""
    if room == other or room in ("Testing", "CommandLine"):
        return True
    if other in ASSEMBLY_USERS.get(room, ()):
        return True
    if other in OUTSIDE or other == "paraview-plugin":
        return False
    if room == "vtkmodule/Core":
        return False
    if room == "vtkmodule/Common":
        return other in ("vtkmodule/Core", "IO/StyleJSON")  # plain C++: the text of a style
    if other in ASSEMBLY_NEEDS.get(room, ()):
        return True
    if room in ASSEMBLIES and other.split("/")[0] == room.split("/")[0]:
        return True
    if room.split("/")[0] in LAYERS:
        return other.startswith("vtkmodule/") or (
            room == "Rendering/OpenGL2" and other in ("Rendering/Core", "Rendering/Software"))
    return True  # paraview-plugin


def own_headers(files):
    headers = {}
    for file in files:
        if file.is_cpp:
            headers.setdefault(file.name, []).append(file.path)
    return headers


def room_of_include(file, header, headers):
    """The room of the project's header that `header` names from `file`; None for a foreign one."""
    candidates = [
        path for path in headers.get(header.split("/")[-1], ())
        if ("/" + path).endswith("/" + header.lstrip("./"))
    ]
    if not candidates:
        return None
    rooms = {module_of(path) for path in candidates}
    own = module_of(file.path)
    return own if own in rooms else sorted(rooms)[0]


def foreign_fault(file, room, header):
    for pattern, library, home in FOREIGN:
        if pattern.search(header) and room not in (home, "Testing"):
            return f"{library} is known to {home} only"
        if pattern.search(header) and room == home and not file.ends(".cxx", ".cpp"):
            if library != "OpenGL":  # its classes are GL objects; its headers stay inside
                return f"{library} is included in a header: only .cxx files may"
    if VTK.search(header) and room == "vtkmodule/Core":
        return "the kernel includes VTK"
    if PARAVIEW.search(header) and room not in ("paraview-plugin", "Testing"):
        return "ParaView is known to the plugin only"
    if TEST_LIBRARY.search(header) and room != "Testing":
        return "a test library outside of tests"
    return None


def includes(files):
    """Includes follow the order of the rooms."""
    headers = own_headers(files)
    for file in files:
        if not file.is_cpp:
            continue
        room = module_of(file.path)
        outside = file.folders[:1] == ["Examples"] or file.folders[:2] == ["Testing", "Consumer"]
        for number, line in file.numbered():
            match = INCLUDE.match(line)
            if not match:
                continue
            header = match.group(2)
            if outside:
                if header.startswith("."):
                    yield file.path, number, f"{header}: only the installed package may be seen"
                continue
            fault = foreign_fault(file, room, header)
            if fault:
                yield file.path, number, f"{header}: {fault}"
                continue
            other = room_of_include(file, header, headers)
            if other is not None and not may_know(room, other):
                yield file.path, number, f"{header}: {room} must not know {other}"


def module_edges(files):
    """The DEPENDS of vtk.module files follow the order of the rooms."""
    modules = [f for f in files if f.name == "vtk.module"]
    rooms = {}
    for file in modules:
        text = "\n".join(file.lines)
        name = re.search(r"^NAME\s+(\S+)", text, re.M)
        if name:
            rooms[name.group(1)] = module_of(file.path)
    for file in modules:
        room = module_of(file.path)
        for number, line in file.numbered():
            other = rooms.get(line.strip())
            if other and not may_know(room, other):
                yield file.path, number, f"{line.strip()}: {room} must not depend on {other}"


KERNEL = "vtkmodule/Core/pointfront/"
ROOMS_PAGE = "docs/developer/rooms.md"
FLOOR = re.compile(r"^ *(\d+)((?: +[A-Z]\w+)+)$")


def floors_of(files):
    """Room of the kernel: its floor, as the page of the rooms draws it."""
    lines = [line for file in files if file.path == ROOMS_PAGE for line in file.lines]
    return {room: int(match.group(1)) for match in map(FLOOR.match, lines) if match
            for room in match.group(2).split()}


def kernel_order(files):
    """A room of the kernel includes by name, and only rooms of lower floors (ROOMS_PAGE)."""
    floors, built = floors_of(files), set()
    for file in files:
        if not file.path.startswith(KERNEL) or not file.is_cpp:
            continue
        room = file.path[len(KERNEL):].split("/")[0]
        if room not in floors and room not in built:
            yield file.path, 1, f"{ROOMS_PAGE} does not show the room {room}"
        built.add(room)
        for number, line in file.numbered():
            match = INCLUDE.match(line)
            if not match or match.group(1) == "<":
                continue
            parts = match.group(2).split("/")
            if parts[0] != "pointfront" or len(parts) != 3:
                yield file.path, number, f"{match.group(2)}: an include names its room"
            elif parts[1] != room and not floors.get(parts[1], math.inf) < floors.get(room, 0):
                yield file.path, number, f"{match.group(2)}: {parts[1]} is not below {room}"
    for room in sorted(set(floors) - built):
        yield ROOMS_PAGE, 1, f"there is no room {room}"
