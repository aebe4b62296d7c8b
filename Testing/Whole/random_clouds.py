"""Random clouds: LAS files of which every value is known, and what is made of them.

A cloud is a dictionary that JSON can print; the same dictionary gives the same files everywhere.
Its points have every kind of attribute that a LAS file can have: bits, bytes, a scaled integer, a
float with NaN and infinities; `serial` numbers them in the order of the file.
"""

import random
import struct

import numpy

RECORD = numpy.dtype([
    ("grid", "<i4", 3), ("intensity", "<u2"), ("returns", "u1"), ("flags", "u1"),
    ("classification", "u1"), ("user_data", "u1"), ("scan_angle", "<i2"),
    ("point_source_id", "<u2"), ("gps_time", "<f8"), ("rgb", "<u2", 3),
    ("quality", "<f4"), ("level", "<i2"), ("serial", "<u4")])  # format 7 and extra bytes
LEVEL_SCALE, LEVEL_OFFSET = 0.25, 5.0
# LAS's number of the type, scale and offset (None: none)
EXTRA = {"quality": (9, None), "level": (4, (LEVEL_SCALE, LEVEL_OFFSET)), "serial": (5, None)}
SHAPES = ("surface", "block", "lines", "clumps")
# Steps of both kinds: sums of powers of two are exact in doubles, those of decimals are not.
SCALES = ([0.01] * 3, [0.125] * 3, [0.001, 0.001, 0.01], [0.25, 0.25, 0.0625])
OFFSETS = ([0.0, 0.0, 0.0], [637000.0, 851000.0, 400.0], [-4.0e6, 5.5e6, -100.0])


def random_cloud(rng, most_points=8000):
    """Draws a random description of a cloud, which make_cloud() takes."""
    cloud = {"seed": rng.randrange(1 << 30), "points": rng.randint(most_points // 8, most_points),
             "shape": rng.choice(SHAPES), "scale": rng.choice(SCALES),
             "offset": rng.choice(OFFSETS), "classes": rng.choice((1, 2, 5, 30))}
    form = rng.choice(("store", "store", "store", "index", "tiles", "merged"))
    if form != "store":
        cloud["form"] = form
    options = {}
    if form != "index":
        options["structure"] = rng.choice(("octree", "octree", "kdtree"))
        if rng.random() < 0.3:
            options["layers"] = rng.choice(("none", "class"))
        if rng.random() < 0.2:
            options["refinement"] = "replace"
    options["node-points"] = rng.choice((256, 300, 1000))
    cloud["options"] = options
    if rng.random() < 0.15:
        cloud["copies"] = rng.choice((2, 3, 40))
    return cloud


def grid_positions(cloud, rng):
    """Whole steps, with points that share places, rows and columns."""
    count, shape = cloud["points"], cloud["shape"]
    if shape == "block":
        grid = rng.integers(0, (1500, 1000, 700), (count, 3))
    elif shape == "lines":
        along = numpy.arange(count)
        grid = numpy.stack([along % 100 * 7, along // 100 * 40, (along * along) % 97], axis=1)
    elif shape == "clumps":
        middles = rng.integers(0, 4000, (max(1, count // 200), 3))
        grid = middles[rng.integers(0, len(middles), count)] + rng.integers(-9, 10, (count, 3))
    else:
        grid = rng.integers(0, 3000, (count, 3))
        grid[:, 2] = (200 * numpy.sin(grid[:, 0] / 500.0) + grid[:, 1] / 10).astype(int)
    copies = rng.integers(0, count, count // 20)
    grid[rng.integers(0, count, count // 20)] = grid[copies]
    if "copies" in cloud:  # so many points have the same place
        grid = rng.permutation(numpy.resize(grid[:-(-count // cloud["copies"])], (count, 3)))
    return grid


def make_records(cloud):
    rng = numpy.random.default_rng(cloud["seed"])
    count = cloud["points"]
    records = numpy.zeros(count, RECORD)
    records["grid"] = grid_positions(cloud, rng)
    records["intensity"] = rng.choice((50, 1000, 65536)) * rng.random(count)
    returns = rng.integers(1, 6, (count, 2))
    records["returns"] = returns.min(axis=1) | returns.max(axis=1) << 4
    records["flags"] = rng.integers(0, 256, count)
    codes = numpy.append(2, rng.integers(0, 256, cloud["classes"] - 1))
    records["classification"] = codes[rng.integers(0, len(codes), count)]
    records["user_data"] = rng.integers(0, 4, count)
    records["scan_angle"] = rng.integers(-5000, 5001, count)
    records["point_source_id"] = rng.integers(0, 65536, 3)[rng.integers(0, 3, count)]
    records["gps_time"] = 1e6 + numpy.cumsum(rng.random(count)) / 1024
    records["rgb"] = rng.integers(0, 65536, (count, 3))
    records["quality"] = rng.normal(0, 3, count)
    strange = numpy.array([numpy.nan, numpy.inf, -numpy.inf, 0.0, -0.0], numpy.float32)
    odd = rng.random(count) < 0.05
    records["quality"][odd] = rng.choice(strange, odd.sum())
    records["level"] = rng.integers(-200, 200, count)
    records["serial"] = numpy.arange(count)
    return records


def write_records(path, records, scale, offset):
    """A LAS 1.4 file of format 7."""
    extra = b""
    for name, (kind, scaled) in EXTRA.items():
        factor, shift = scaled or (0.0, 0.0)
        extra += struct.pack("<HBB32s4x72x3d3d32x", 0, kind, 0x18 if scaled else 0, name.encode(),
                             factor, 0, 0, shift, 0, 0)
    variable = struct.pack("<H16sHH32s", 0, b"LASF_Spec", 4, len(extra), b"extra bytes") + extra
    positions = world(records, scale, offset)
    low, high = positions.min(axis=0), positions.max(axis=0)
    header = struct.pack(
        "<4sHH16sBB32s32sHHHIIBHI5I12dQQIQ15Q", b"LASF", 0, 16, bytes(16), 1, 4, b"test",
        b"pointfront tests", 1, 2020, 375, 375 + len(variable), 1, 7, RECORD.itemsize, 0,
        0, 0, 0, 0, 0, *scale, *offset, high[0], low[0], high[1], low[1], high[2], low[2],
        0, 0, 0, len(records), *numpy.bincount(records["returns"] & 15, minlength=16)[1:16])
    path.write_bytes(header + variable + records.tobytes())
    return path


def world(records, scale, offset):
    return numpy.asarray(offset) + numpy.asarray(scale) * records["grid"].astype(float)


def columns_of(records):
    """Attributes as a store has them, by name, in world values."""
    flags, returns = records["flags"], records["returns"]
    return {
        "intensity": records["intensity"], "return_number": returns & 15,
        "return_count": returns >> 4, "classification": records["classification"],
        "classification_flags": flags & 15, "scan_direction": flags >> 6 & 1,
        "edge_of_flight_line": flags >> 7, "scanner_channel": flags >> 4 & 3,
        "scan_angle": (records["scan_angle"] * 0.006).astype(numpy.float32),
        "user_data": records["user_data"], "point_source_id": records["point_source_id"],
        "gps_time": records["gps_time"], "rgb": records["rgb"], "quality": records["quality"],
        "level": records["level"] * LEVEL_SCALE + LEVEL_OFFSET, "serial": records["serial"]}


def make_cloud(cloud, folder, succeed):
    """The path of the stored cloud in a new folder, and its records in the order of the file.
    `succeed` runs the tool."""
    records = make_records(cloud)
    form, options = cloud.get("form", "store"), cloud.get("options", {})
    words = [word for name, value in options.items() for word in (f"--{name}", value)]
    parts = [records]
    if form in ("tiles", "merged"):
        parts = [records[records["serial"] % 3 == 0], records[records["serial"] % 3 != 0]]
        parts = [part for part in parts if len(part)]
    folder.mkdir()
    files = [write_records(folder / f"{number}.las", part, cloud["scale"], cloud["offset"])
             for number, part in enumerate(parts)]
    if form == "index":
        succeed("index", files[0], "-o", folder / "cloud.pfindex", *words)
        return folder / "cloud.pfindex", records
    if form == "store":
        succeed("build", *files, "-o", folder / "cloud.pfront", *words)
        return folder / "cloud.pfront", records
    (folder / "tiles").mkdir()
    for number, file in enumerate(files):
        succeed("build", file, "-o", folder / f"tiles/{number}.pfront", *words)
    if form == "tiles":
        return folder / "tiles", records
    succeed("build", *sorted((folder / "tiles").iterdir()), "-o", folder / "cloud.pfront", *words)
    return folder / "cloud.pfront", records
