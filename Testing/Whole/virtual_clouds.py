"""Virtual point clouds (VPC): tiles of one COPC file at many places, and the lists that name them.

Environment as tool.py. By itself it makes a folder of tiles and their list:
python3 virtual_clouds.py COPC FOLDER SIDE
"""

import json
import pathlib
import struct
import sys

OFFSET, HIGHEST = 155, 179  # places in a LAS header: the grid's, the box's (high, low by axis)
CENTRE = 375 + 54  # place of the cube's, in the first record, which is that of COPC


class Tile:
    """A COPC file that can be put elsewhere: its points are steps from an offset."""

    def __init__(self, path):
        self.bytes = pathlib.Path(path).read_bytes()
        box = struct.unpack_from("<6d", self.bytes, HIGHEST)
        self.low, self.high = box[1::2], box[0::2]
        self.points, = struct.unpack_from("<Q", self.bytes, 247)

    def moved(self, by):
        """The bytes of the file `by` further along each axis, and its box there."""
        moved = bytearray(self.bytes)
        for axis in range(3):
            for at in (OFFSET + 8 * axis, HIGHEST + 16 * axis, HIGHEST + 16 * axis + 8,
                       CENTRE + 8 * axis):
                value, = struct.unpack_from("<d", moved, at)
                struct.pack_into("<d", moved, at, value + by[axis])
        return bytes(moved), [low + add for low, add in zip(self.low, by)] + \
            [high + add for high, add in zip(self.high, by)]


def item(name, box, points, **properties):
    """A STAC item of a file, as PDAL's wrench writes it."""
    return {
        "type": "Feature", "stac_version": "1.0.0", "id": pathlib.Path(name).stem,
        "bbox": [-1.0, -1.0, 1.0, 1.0], "geometry": None, "links": [],
        "assets": {"data": {"href": name, "roles": ["data"]}},
        "properties": {"datetime": "2024-01-01T00:00:00Z", "pc:count": points, "pc:type": "lidar",
                       "pc:encoding": "?", "proj:bbox": box, **properties}}


def write_list(path, items):
    path.write_text(json.dumps({"type": "FeatureCollection", "features": items}))
    return path


def write_tiles(copc, folder, side, step=None, name="all.vpc"):
    """`side` by `side` tiles, tile-COLUMN-ROW.copc.laz, and their list. Returns the list's path."""
    tile = Tile(copc)
    step = step or [round(1.01 * (tile.high[axis] - tile.low[axis])) + 1 for axis in range(2)]
    items = []
    for column in range(side):
        for row in range(side):
            file = folder / f"tile-{column}-{row}.copc.laz"
            content, box = tile.moved((column * step[0], row * step[1], 0))
            file.write_bytes(content)
            items.append(item(f"./{file.name}", box, tile.points))
    return write_list(folder / name, items)


def main():
    target = pathlib.Path(sys.argv[2])
    target.mkdir(parents=True, exist_ok=True)
    print(write_tiles(sys.argv[1], target, int(sys.argv[3])))


if __name__ == "__main__":
    main()
