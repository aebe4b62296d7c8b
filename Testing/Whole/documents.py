"""The code blocks of the documentation, and the data that their commands name."""

import json
import pathlib
import re
import shutil
import struct
import subprocess
import unittest

from tool import DATA, TOOL

STADIUM = pathlib.Path(__file__).resolve().parents[1] / "Data/autzen_stadium.laz"
# Where made-up surveys lie: easting, northing of the lower left corner, and a zone they fit into.
CORNER = (400000.0, 5600000.0)
ZONE = "EPSG:25832"


def blocks(path):
    """(language, first line's number, text) of each block between three backquotes."""
    found, begin, language, lines = [], 0, None, []
    for number, line in enumerate(path.read_text().splitlines(), 1):
        fence = re.match(r"\s*```(\w*)\s*$", line)
        if not fence:
            lines.append(line)
        elif language is None:
            begin, language, lines = number + 1, fence.group(1), []
        else:
            found.append((language, begin, "\n".join(lines)))
            language = None
    return found


def write_tiff(path, bands, corner, pixel, edge):
    """A GeoTIFF of uint8 (3 bands) or float32 (1 band) with `edge` times `edge` pixels of `pixel`
    metres; `corner` is its upper left one. Its system is ZONE."""
    floats = bands == 1
    pixels = b"".join(
        struct.pack("<f", 0.01 * (x + y)) if floats else bytes((x % 256, y % 256, 128))
        for y in range(edge) for x in range(edge))
    keys = (1, 1, 0, 2, 1024, 0, 1, 1, 3072, 0, 1, int(ZONE.split(":")[1]))
    tags = {256: ("H", (edge,)), 257: ("H", (edge,)),
            258: ("H", (32,) if floats else (8, 8, 8)), 259: ("H", (1,)),
            262: ("H", (1 if floats else 2,)), 273: ("I", (8,)), 277: ("H", (bands,)),
            278: ("H", (edge,)), 279: ("I", (len(pixels),)), 284: ("H", (1,)),
            339: ("H", (3,) if floats else (1, 1, 1)), 33550: ("d", (pixel, pixel, 0.0)),
            33922: ("d", (0.0, 0.0, 0.0, corner[0], corner[1], 0.0)), 34735: ("H", keys)}
    kinds = {"H": 3, "I": 4, "d": 12}
    entries, values = b"", b""
    values_at = 8 + len(pixels) + 2 + 12 * len(tags) + 4
    for tag, (kind, numbers) in sorted(tags.items()):
        data = struct.pack(f"<{len(numbers)}{kind}", *numbers)
        if len(data) > 4:
            place = struct.pack("<I", values_at + len(values))
            values += data
        else:
            place = data.ljust(4, b"\0")
        entries += struct.pack("<HHI", tag, kinds[kind], len(numbers)) + place
    path.write_bytes(b"II*\0" + struct.pack("<I", 8 + len(pixels)) + pixels +
                     struct.pack("<H", len(tags)) + entries + bytes(4) + values)


CITY_POINTS = 300000


class Workplace:
    """A folder with what the documentation's commands read. All but the first are copies."""

    first = None

    def __init__(self, folder):
        self.folder = folder
        if Workplace.first:
            shutil.copytree(Workplace.first, folder, symlinks=True, dirs_exist_ok=True)
            return
        for name in ("survey", "incoming", "tiles", "ortho"):
            (folder / name).mkdir()
        self._make_survey()
        self._make_city()
        write_tiff(folder / "ortho/west.tif", 3, (CORNER[0], CORNER[1] + 400), 2.0, 200)
        write_tiff(folder / "dtm.tif", 1, (CORNER[0], CORNER[1] + 400), 2.0, 200)
        low, high = CORNER, (CORNER[0] + 320, CORNER[1] + 320)
        ring = [list(low), [high[0], low[1]], list(high), [low[0], high[1]], list(low)]
        (folder / "lake.geojson").write_text(
            json.dumps({"type": "Polygon", "coordinates": [ring]}))
        (folder / "lone-star.copc.laz").symlink_to(DATA / "copc/lone-star.copc.laz")
        (folder / "white.json").write_text('{"default": {"color": "#ffffff"}}')
        for name, more in (("drawn", ("--error", 4)), ("reference", ()),
                           ("silhouette", ("--style", "white.json", "--background", "0,0,0"))):
            self.tool("render", "city.pfront", "-o", f"{name}.png", "--size", "160x120", *more)
        Workplace.first = folder.with_name("workplace")
        shutil.rmtree(Workplace.first, ignore_errors=True)
        shutil.copytree(folder, Workplace.first, symlinks=True)
        unittest.addModuleCleanup(shutil.rmtree, Workplace.first)

    def tool(self, *arguments):
        done = subprocess.run([TOOL, *map(str, arguments)], cwd=self.folder, capture_output=True,
                              check=False, text=True)
        if done.returncode != 0:
            raise RuntimeError(f"{arguments}: {done.stderr}")

    def _make_survey(self):
        """Two tiles of Autzen, in feet."""
        las = DATA / "las/real/autzen_trim.las"
        (self.folder / "flight.las").write_bytes(las.read_bytes())
        self.tool("build", STADIUM, "-o", "whole.pfront")
        for name, box in (("west", "0,0,0,637400,1e7,1e5"), ("east", "637400,0,0,1e7,1e7,1e5")):
            self.tool("export", "whole.pfront", "-o", f"survey/{name}.laz", "--box", box)
            self.tool("export", "whole.pfront", "-o", f"incoming/{name}.laz", "--box", box)
        (self.folder / "whole.pfront").unlink()

    def _make_city(self):
        """A made-up survey in ZONE, whole and in parts."""
        self.tool("generate", "--points", CITY_POINTS, "-o", "made.las")
        self.tool("build", "made.las", "-o", "city.pfront", "--assume-crs", ZONE)
        for name in ("city.laz", "a.laz", "a_utm.laz", "b.ply", "new.laz"):
            self.tool("export", "city.pfront", "-o", name)
        self.tool("export", "city.pfront", "-o", "b_geographic.laz", "--crs", "EPSG:4326")
        for name, box in (("west", "0,0,0,400150,1e7,1e5"), ("east", "400150,0,0,1e6,1e7,1e5")):
            self.tool("export", "city.pfront", "-o", "part.laz", "--box", box)
            self.tool("build", "part.laz", "-o", f"{name}.pfront")
            self.tool("build", "part.laz", "-o", f"tiles/{name}.pfront")
            (self.folder / "part.laz").unlink()


def shown_points(text):
    """Returns how many points `render` and `export` said they drew or wrote."""
    return [int(number) for number in re.findall(r": (\d+) points\b", text)]
