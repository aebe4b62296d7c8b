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
    if rows[:, 0].max() > 2:
        return unfilter_diagonally(rows, height, width)
    picture = numpy.zeros((height, width, 3), numpy.uint8)
    above = numpy.zeros((width, 3), numpy.uint8)
    for y in range(height):
        kind, row = rows[y, 0], rows[y, 1:].reshape(width, 3)
        if kind == 0:
            line = row.copy()
        elif kind == 1:
            line = numpy.cumsum(row, axis=0, dtype=numpy.uint8)
        else:
            line = row + above
        picture[y] = above = line
    return picture


def unfilter_diagonally(rows, height, width):
    """Average (3) and Paeth (4) need the pixel before, too: so all pixels of a diagonal at once.

    Row y is at column step - y. Arrays over rows have one above the first, which is black."""
    kinds = rows[:, 0]
    filtered = rows[:, 1:].reshape(height, width, 3)
    skewed = numpy.zeros((width + height, height, 3), numpy.int16)  # step, row, channel
    for y in range(height):
        skewed[y:y + width, y] = filtered[y]
    is_left, is_above, is_mean, is_paeth = (
        numpy.repeat((kinds == kind)[:, None], 3, axis=1) for kind in (1, 2, 3, 4))
    older, before, now = (numpy.zeros((height + 1, 3), numpy.int16) for _ in range(3))
    for step in range(width + height - 1):
        low, high = max(0, step - width + 1), min(height, step + 1)
        left, above, corner = before[low + 1:high + 1], before[low:high], older[low:high]
        # The distances of left + above - corner from each of the three.
        to_left, to_above = above - corner, left - corner
        to_corner = numpy.abs(to_left + to_above)
        to_left, to_above = numpy.abs(to_left), numpy.abs(to_above)
        paeth = numpy.where(to_above <= to_corner, above, corner)
        numpy.copyto(paeth, left, where=(to_left <= to_above) & (to_left <= to_corner))
        pixels = left * is_left[low:high] + above * is_above[low:high]
        numpy.copyto(pixels, (left + above) >> 1, where=is_mean[low:high])
        numpy.copyto(pixels, paeth, where=is_paeth[low:high])
        pixels += skewed[step, low:high]
        pixels &= 255
        skewed[step, low:high] = now[low + 1:high + 1] = pixels
        older, before, now = before, now, older
    picture = numpy.empty((height, width, 3), numpy.uint8)
    for y in range(height):
        picture[y] = skewed[y:y + width, y]
    return picture


def share_alike(one, other, tolerance=8):
    """Share of pixels whose channels all differ by at most that."""
    difference = numpy.abs(one.astype(int) - other.astype(int)).max(axis=2)
    return float((difference <= tolerance).mean())
