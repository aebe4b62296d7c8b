"""EPT and COPC with deep hierarchies: one point a node, so that thousands of nodes are small.

Environment as tool.py. By itself it makes trees: python3 foreign_trees.py FOLDER LEVELS STEP
"""

import json
import pathlib
import struct
import sys

from tool import pointfront, write_las

SIDE = 1024.0  # side of the cube, which begins at the origin; the points lie on its floor
SCALE = 0.01
BOUNDS, POINT_COUNT, EXTENDED = 179, 247, 235  # places in a LAS header
INFO = 375 + 54  # place of COPC's info, in the first record


def one_point(folder, ending):
    """The bytes of a file with one point, which LAZ leaves as it is, and the point's place."""
    las, store = folder / "one.las", folder / "one.pfront"
    out = folder / f"one{ending}"
    write_las(las, [(0.0, 0.0, 0.0, 0, 0, 0)], SCALE)
    for command in (("build", las, "-o", store, "--force"), ("export", store, "-o", out)):
        outcome = pointfront(*command)
        assert outcome.status == 0, outcome
    content = out.read_bytes()
    for path in (las, store, out):
        path.unlink()
    begin, = struct.unpack_from("<I", content, 96)
    return bytearray(content), begin + 8


def cells(levels):
    """All cells of the floor, level by level."""
    for level in range(levels):
        for x in range(2 ** level):
            for y in range(2 ** level):
                yield level, x, y, 0


def point_of(cell):
    """Steps of the grid of the cell's point, and its colour."""
    level, x, y, _ = cell
    size = SIDE / 2 ** level
    mixed = (x * 2654435761 + y * 40503 + level * 97) & 0xffffffff
    place = [round((c + 0.2 + 0.6 * ((mixed >> shift) % 997) / 997) * size / SCALE)
             for c, shift in ((x, 3), (y, 13))]
    return (*place, 100), (9000 * level % 65536, 65535 - 6000 * level, mixed % 65536)


def key_of(cell):
    return "-".join(map(str, cell))


def page_of(cell, step):
    """The root of the page that has a cell; one page for all if `step` is 0."""
    level = cell[0] // step * step if step else 0
    up = cell[0] - level
    return (level, *(c >> up for c in cell[1:]))


def write_ept(folder, levels, step, points=None):
    """An EPT of laszip nodes whose pages have `step` levels. Returns its ept.json."""
    (folder / "ept-data").mkdir(parents=True)
    (folder / "ept-hierarchy").mkdir()
    content, at = one_point(folder, ".laz")
    pages = {}
    count = 0
    for cell in cells(levels):
        place, colour = point_of(cell)
        struct.pack_into("<3i", content, at, *place)
        struct.pack_into("<3H", content, at + 20, *colour)
        low = [value * SCALE for value in place]
        struct.pack_into("<6d", content, BOUNDS, *(v for value in low for v in (value, value)))
        (folder / "ept-data" / f"{key_of(cell)}.laz").write_bytes(content)
        page = page_of(cell, step)
        pages.setdefault(page, {})[key_of(cell)] = 1
        if page == cell and cell[0] > 0:
            above = (cell[0] - 1, *(c >> 1 for c in cell[1:]))
            pages[page_of(above, step)][key_of(cell)] = -1
        count += 1
    for page, nodes in pages.items():
        (folder / "ept-hierarchy" / f"{key_of(page)}.json").write_text(json.dumps(nodes))
    box = [0, 0, 0, SIDE, SIDE, SIDE]
    (folder / "ept.json").write_text(json.dumps({
        "bounds": box, "boundsConforming": [0, 0, 0, SIDE, SIDE, 2], "dataType": "laszip",
        "hierarchyType": "json", "points": points or count, "span": 128, "version": "1.1.0",
        "schema": [{"name": name, "type": "signed", "size": 4, "scale": SCALE, "offset": 0}
                   for name in "XYZ"]}))
    return folder / "ept.json"


def entry(cell, offset, size, points):
    return struct.pack("<4iQii", *cell, offset, size, points)


def write_copc(path, levels, step):
    """A COPC whose pages have `step` levels; all lie in its hierarchy's record, the last first. Its
    chunk table, which readers of the tree do not look at, names no chunk. Returns its path."""
    content, begin = one_point(path.parent, ".copc.laz")
    table, = struct.unpack_from("<Q", content, begin - 8)
    chunk = bytearray(content[begin:table])
    out = bytearray(content[:begin])
    pages = {}
    for cell in cells(levels):
        place, colour = point_of(cell)
        struct.pack_into("<3i", chunk, 0, *place)
        struct.pack_into("<3H", chunk, 30, *colour)
        page = page_of(cell, step)
        pages.setdefault(page, []).append(entry(cell, len(out), len(chunk), 1))
        out += chunk
    struct.pack_into("<Q", out, begin - 8, len(out))
    out += struct.pack("<II", 0, 0)
    record = len(out)
    out += struct.pack("<2x16sHQ32x", b"copc", 1000,
                       32 * (sum(map(len, pages.values())) + len(pages) - 1))
    for page in sorted(pages, reverse=True):  # pages below are known when one is written
        bytes_of = b"".join(pages[page])
        if page[0] > 0:
            above = page_of((page[0] - 1, *(c >> 1 for c in page[1:])), step)
            pages[above].append(entry(page, len(out), len(bytes_of), -1))
        else:
            struct.pack_into("<QQ", out, INFO + 40, len(out), len(bytes_of))
        out += bytes_of
    struct.pack_into("<5d", out, INFO, *[SIDE / 2] * 4, SIDE / 128)
    struct.pack_into("<6d", out, BOUNDS, SIDE, 0, SIDE, 0, 2, 0)
    struct.pack_into("<QI", out, EXTENDED, record, 1)
    struct.pack_into("<Q", out, POINT_COUNT, sum(4 ** level for level in range(levels)))
    path.write_bytes(out)
    return path


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    levels, step = map(int, sys.argv[2:4])
    print(write_ept(folder / "ept", levels, step))
    print(write_copc(folder / "tree.copc.laz", levels, step))


if __name__ == "__main__":
    main()
