#!/usr/bin/python3
"""Writes the points of a LAZ file as LAS, in their order: what a scanner wrote stays as it was.

    Testing/Benchmarks/unpack_laz.py IN.laz OUT.las [MOST_POINTS]

Calls liblaszip, a point at a time: ten million points take about a minute. With MOST_POINTS the
file is cut there, and its header counts these points only.
"""

import ctypes
import ctypes.util
import pathlib
import struct
import sys

COUNT_AT = 107  # LAS 1.0 to 1.3: number of points, then five counts by return


def library():
    name = ctypes.util.find_library("laszip")
    if not name:
        sys.exit("unpack_laz.py: liblaszip is missing: scripts/setup installs it")
    return ctypes.CDLL(name)


def main(source, target, most=None):
    laszip = library()

    def call(name, *arguments):
        if getattr(laszip, name)(*arguments) != 0:
            sys.exit(f"unpack_laz.py: {name} failed for {source}")

    reader, writer = ctypes.c_void_p(), ctypes.c_void_p()
    compressed = ctypes.c_int()
    header, point = ctypes.c_void_p(), ctypes.c_void_p()
    call("laszip_create", ctypes.byref(reader))
    call("laszip_open_reader", reader, str(source).encode(), ctypes.byref(compressed))
    call("laszip_get_header_pointer", reader, ctypes.byref(header))
    call("laszip_get_point_pointer", reader, ctypes.byref(point))
    call("laszip_create", ctypes.byref(writer))
    call("laszip_set_header", writer, header)
    call("laszip_open_writer", writer, str(target).encode(), ctypes.c_int(0))
    with pathlib.Path(source).open("rb") as file:
        count = struct.unpack_from("<I", file.read(COUNT_AT + 4), COUNT_AT)[0]
    points = min(count, int(most)) if most else count
    for i in range(points):
        if (laszip.laszip_read_point(reader) or laszip.laszip_set_point(writer, point) or
                laszip.laszip_write_point(writer)):
            sys.exit(f"unpack_laz.py: point {i} of {source} cannot be copied")
    call("laszip_close_writer", writer)
    call("laszip_close_reader", reader)
    if points < count:
        with pathlib.Path(target).open("r+b") as file:
            file.seek(COUNT_AT)
            file.write(struct.pack("<I", points))
    print(f"{target}: {points} points")


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    main(*sys.argv[1:])
