"""The same points in several forms: moved, turned, in parts, with their columns in another order.

A cloud comes as a LAS 1.4 file of format 7 without extra bytes, as `pointfront generate` writes it.
"""

import json
import struct

import numpy

HEADER = 375
RECORD = numpy.dtype([
    ("grid", "<i4", 3), ("intensity", "<u2"), ("returns", "u1"), ("flags", "u1"),
    ("classification", "u1"), ("user_data", "u1"), ("scan_angle", "<i2"),
    ("point_source_id", "<u2"), ("gps_time", "<f8"), ("rgb", "<u2", 3)])
NORMAL = ("nx", "ny", "nz")
# Those of a PLY file, with the types that `pointfront` knows to be the attributes' own.
PLY_TYPES = {"x": ("double", "<f8"), "y": ("double", "<f8"), "z": ("double", "<f8"),
             "red": ("ushort", "<u2"), "green": ("ushort", "<u2"), "blue": ("ushort", "<u2"),
             "intensity": ("ushort", "<u2"), "classification": ("uchar", "u1"),
             "return_number": ("uchar", "u1"), "gps_time": ("double", "<f8"),
             **{name: ("float", "<f4") for name in NORMAL}}
EPT_SCHEMA = (("X", "i4"), ("Y", "i4"), ("Z", "i4"), ("Intensity", "u2"), ("ReturnNumber", "u1"),
              ("NumberOfReturns", "u1"), ("Classification", "u1"), ("Red", "u2"), ("Green", "u2"),
              ("Blue", "u2"))
EPT_KINDS = {"i": "signed", "u": "unsigned", "f": "float"}


class Points:
    """Records of a LAS file with its scale and offset."""

    def __init__(self, records, scale, offset):
        self.records, self.scale, self.offset = records, scale, offset

    @classmethod
    def read(cls, path):
        data = path.read_bytes()
        start, kind, length = (struct.unpack_from(form, data, at)[0]
                               for form, at in (("<I", 96), ("B", 104), ("<H", 105)))
        if kind & 127 != 7 or length < RECORD.itemsize:
            raise ValueError(f"{path} is of format {kind}, with {length} bytes a point")
        count = struct.unpack_from("<Q", data, 247)[0]
        rows = numpy.frombuffer(data, numpy.uint8, count * length, start).reshape(count, length)
        records = numpy.ascontiguousarray(rows[:, :RECORD.itemsize]).view(RECORD)[:, 0].copy()
        numbers = struct.unpack_from("<6d", data, 131)
        return cls(records, numbers[:3], numbers[3:])

    def positions(self):
        return numpy.asarray(self.offset) + numpy.asarray(self.scale) * self.records["grid"]

    def write(self, path):
        """A LAS file."""
        positions = self.positions()
        low, high = positions.min(axis=0), positions.max(axis=0)
        count = len(self.records)
        returns = numpy.bincount(self.records["returns"] & 15, minlength=16)[1:16]
        path.write_bytes(struct.pack(
            "<4sHH16sBB32s32sHHHIIBHI5I12dQQIQ15Q", b"LASF", 0, 16, bytes(16), 1, 4, b"test",
            b"pointfront tests", 1, 2020, HEADER, HEADER, 0, 7, RECORD.itemsize, 0, 0, 0, 0, 0, 0,
            *self.scale, *self.offset, high[0], low[0], high[1], low[1], high[2], low[2], 0, 0, 0,
            count, *returns) + self.records.tobytes())
        return path

    def part(self, chosen):
        return Points(self.records[chosen].copy(), self.scale, self.offset)

    def moved(self, steps):
        """By whole steps of the scale."""
        offset = [at + scale * by for at, scale, by in zip(self.offset, self.scale, steps)]
        return Points(self.records, self.scale, offset)

    def turned(self, quarters):
        """About the z axis through the offset."""
        records = self.records.copy()
        records["grid"][:, :2] = turned(records["grid"].astype(int), quarters)[:, :2]
        return Points(records, self.scale, self.offset)

    def columns(self):
        """Writes PLY with the types of PLY_TYPES and made-up normals."""
        positions, records = self.positions(), self.records
        columns = dict(zip("xyz", positions.T))
        columns.update(zip(("red", "green", "blue"), records["rgb"].T))
        columns.update({name: records[name] for name in ("intensity", "classification",
                                                         "gps_time")})
        columns["return_number"] = records["returns"] & 15
        columns.update(zip(NORMAL, wavy_normals(positions)))
        return columns


def wavy_normals(positions):
    """Unit vectors that are the same at the same place: their x, y and z."""
    leaning = 0.5 * numpy.sin(positions[:, :2])
    return *leaning.T, numpy.sqrt(1 - (leaning ** 2).sum(axis=1))


def turned(vectors, quarters):
    """Vectors, or one, after so many quarter turns about the z axis."""
    vectors = numpy.array(vectors)
    for _ in range(quarters % 4):
        vectors = numpy.stack([-vectors[..., 1], vectors[..., 0], vectors[..., 2]], axis=-1)
    return vectors


def write_ply(path, columns, order):
    """A binary PLY file with its properties in that order."""
    rows = numpy.zeros(len(columns["x"]), [(name, PLY_TYPES[name][1]) for name in order])
    for name in order:
        rows[name] = columns[name]
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(rows)}",
              *(f"property {PLY_TYPES[name][0]} {name}" for name in order), "end_header\n"]
    path.write_bytes("\n".join(header).encode() + rows.tobytes())
    return path


def write_csv(path, columns, order):
    """With all digits."""
    texts = [map(repr, columns[name].tolist()) for name in order]
    with open(path, "w") as file:
        file.write(",".join(order) + "\n")
        file.writelines(",".join(row) + "\n" for row in zip(*texts))
    return path


def write_ept(folder, points, node_points):
    """An EPT of binary nodes, each with the first points of its place that no node above has."""
    kinds = numpy.dtype([(name, "<" + kind) for name, kind in EPT_SCHEMA])
    rows, source = numpy.zeros(len(points.records), kinds), points.records
    for axis, name in enumerate("XYZ"):
        rows[name] = source["grid"][:, axis]
    for channel, name in enumerate(("Red", "Green", "Blue")):
        rows[name] = source["rgb"][:, channel]
    rows["Intensity"], rows["Classification"] = source["intensity"], source["classification"]
    rows["ReturnNumber"], rows["NumberOfReturns"] = source["returns"] & 15, source["returns"] >> 4
    positions = points.positions()
    low, high = positions.min(axis=0), positions.max(axis=0)
    edge = 1.001 * (high - low).max()
    for name in ("ept-data", "ept-hierarchy"):
        (folder / name).mkdir(parents=True)
    hierarchy = {}

    def split(rest, key):
        depth, place = key[0], numpy.array(key[1:])
        name = "-".join(map(str, key))
        mine, rest = rest[:node_points], rest[node_points:]
        hierarchy[name] = len(mine)
        (folder / f"ept-data/{name}.bin").write_bytes(rows[mine].tobytes())
        middle = low + edge * (2 * place + 1) / 2 ** (depth + 1)
        sides = (positions[rest] >= middle).astype(int)
        for octant in numpy.unique(sides, axis=0) if len(rest) else ():
            chosen = rest[(sides == octant).all(axis=1)]
            split(chosen, (depth + 1, *(2 * place + octant).tolist()))

    split(numpy.random.default_rng(1).permutation(len(rows)), (0, 0, 0, 0))
    (folder / "ept-hierarchy/0-0-0-0.json").write_text(json.dumps(hierarchy))
    schema = [{"name": name, "type": EPT_KINDS[kind[0]], "size": int(kind[1])}
              for name, kind in EPT_SCHEMA]
    for axis in range(3):
        schema[axis].update(scale=points.scale[axis], offset=points.offset[axis])
    (folder / "ept.json").write_text(json.dumps({
        "bounds": [*low.tolist(), *(low + edge).tolist()],
        "boundsConforming": [*low.tolist(), *high.tolist()], "dataType": "binary",
        "hierarchyType": "json", "points": len(rows), "schema": schema, "span": 128,
        "srs": {}, "version": "1.0.0"}))
    return folder / "ept.json"
