"""PNG pictures as arrays of height x width x 3 bytes, first row on top."""

import pathlib
import struct
import zlib

import numpy


def read_png(path):
    """8 bit RGB without interlacing, as the tools write it."""
    data = pathlib.Path(path).read_bytes()
    if data[:8] != b"\x89PNG\r\n\x1a\n":
        raise ValueError(f"{path} is not a PNG file")
    at, compressed, size = 8, b"", None
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, colour, _, _, interlace = struct.unpack(">IIBBBBB", body)
            if (depth, colour, interlace) != (8, 2, 0):
                raise ValueError(f"{path}: not 8 bit RGB without interlacing")
            size = (height, width)
        elif kind == b"IDAT":
            compressed += body
        at += 12 + length
    return unfilter(zlib.decompress(compressed), *size)


def write_png(path, picture):
    """Writes height x width x 3 bytes as 8 bit RGB without filters."""
    height, width = picture.shape[:2]
    rows = numpy.zeros((height, 3 * width + 1), numpy.uint8)
    rows[:, 1:] = picture.reshape(height, 3 * width)

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(
            ">I", zlib.crc32(kind + body))

    pathlib.Path(path).write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
        + chunk(b"IDAT", zlib.compress(rows.tobytes(), 6)) + chunk(b"IEND", b""))


def unfilter(raw, height, width):
    stride = 3 * width
    rows = numpy.frombuffer(raw, numpy.uint8).reshape(height, stride + 1)
    picture = numpy.zeros((height, width, 3), numpy.uint8)
    above = numpy.zeros((width, 3), numpy.uint8)
    for y in range(height):
        kind, row = rows[y, 0], rows[y, 1:].reshape(width, 3)
        if kind == 0:
            line = row.copy()
        elif kind == 1:
            line = numpy.cumsum(row, axis=0, dtype=numpy.uint8)
        elif kind == 2:
            line = row + above
        else:
            line = unfilter_pixelwise(kind, row, above)
        picture[y] = above = line
    return picture


def unfilter_pixelwise(kind, row, above):
    """Average (3) and Paeth (4) need the pixel before."""
    line = []
    before, corner = (0, 0, 0), (0, 0, 0)
    for value, over in zip(row.tolist(), above.tolist()):
        if kind == 3:
            guess = [(a + b) // 2 for a, b in zip(before, over)]
        else:
            guess = [paeth(a, b, c) for a, b, c in zip(before, over, corner)]
        before = [(v + g) & 255 for v, g in zip(value, guess)]
        corner = over
        line.append(before)
    return numpy.array(line, numpy.uint8)


def paeth(a, b, c):
    distance = [(abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c)]
    return min(distance)[2]


def share_alike(one, other, tolerance=8):
    """Share of pixels whose channels all differ by at most that."""
    difference = numpy.abs(one.astype(int) - other.astype(int)).max(axis=2)
    return float((difference <= tolerance).mean())
