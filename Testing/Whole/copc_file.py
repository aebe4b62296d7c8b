"""Checks a COPC file against the specification (copc.io, 1.0; LAS 1.4 R15). By itself:
python3 copc_file.py FILE... prints what is wrong. It knows nothing of this project's code, and
reads no compressed point but the first of each chunk, which LAZ leaves as it is."""

import struct
import sys

HEADER = 375


class CopcFile:
    """A COPC file: all that it says, and in `faults` what it must not say."""

    def __init__(self, path):
        with open(path, "rb") as file:
            self.bytes = file.read()
        self.faults = []
        self.nodes = {}  # (level, x, y, z) -> (offset, bytes, points)
        self.pages = 0
        self.read_header()
        self.read_records()
        if not self.faults:
            self.read_info()
            self.read_page(self.root_offset, self.root_size)
            self.check_tree()
            self.check_chunks()
            # Last: writers of other projects set them all the same.
            self.check(self.unpack("6I", 107) == (0,) * 6, "legacy counts are not 0")

    def check(self, holds, fault):
        if not holds:
            self.faults.append(fault)

    def unpack(self, form, at):
        return struct.unpack_from("<" + form, self.bytes, at)

    def read_header(self):
        self.check(self.bytes[:4] == b"LASF", "no LAS")
        self.check(self.unpack("BB", 24) == (1, 4), "not LAS 1.4")
        encoding, = self.unpack("H", 6)
        self.check(encoding & 16, "the WKT bit is not set")
        size, self.point_offset, self.record_count = self.unpack("HII", 94)
        self.check(size == HEADER, "the header has not 375 bytes")
        form, self.record_bytes = self.unpack("BH", 104)
        self.check(form & 0x80, "not marked as compressed")
        self.format = form & 0x3F
        self.check(self.format in (6, 7, 8), f"point format {self.format}")
        least = {6: 30, 7: 36, 8: 38}.get(self.format, 0)
        self.check(self.record_bytes >= least, "records are too short")
        self.extra = self.record_bytes - least
        self.scale, self.offset = self.unpack("3d", 131), self.unpack("3d", 155)
        bounds = self.unpack("6d", 179)
        self.high, self.low = bounds[0::2], bounds[1::2]
        waveforms, self.extended_offset, self.extended_count = self.unpack("QQI", 227)
        self.check(waveforms == 0, "waveforms")
        self.points, = self.unpack("Q", 247)
        self.by_return = self.unpack("15Q", 255)
        self.check(sum(self.by_return) <= self.points, "more returns than points")

    def read_records(self):
        self.records = {}
        at = HEADER
        first = None
        for _ in range(self.record_count):
            owner, ident, size = self.unpack("2x16sHH32x", at)
            key = (owner.rstrip(b"\0").decode(), ident)
            first = first or (key, size)
            self.check(key not in self.records, f"{key} is there twice")
            self.records[key] = self.bytes[at + 54:at + 54 + size]
            at += 54 + size
        self.check(at == self.point_offset, "points do not begin behind the records")
        self.check(first == (("copc", 1), 160), f"the first record is {first}")
        at = self.extended_offset
        for _ in range(self.extended_count):
            owner, ident, size = self.unpack("2x16sHQ32x", at)
            key = (owner.rstrip(b"\0").decode(), ident)
            self.check(key not in self.records, f"{key} is there twice")
            self.records[key] = self.bytes[at + 60:at + 60 + size]
            if key == ("copc", 1000):
                self.hierarchy = (at + 60, at + 60 + size)
            at += 60 + size
        self.check(at == len(self.bytes), "the file does not end with its extended records")
        self.check(("copc", 1000) in self.records, "no hierarchy")
        for geotiff in (34735, 34736, 34737):
            self.check(("LASF_Projection", geotiff) not in self.records, "GeoTIFF keys")
        laszip = self.records.get(("laszip encoded", 22204), bytes(34))
        scheme, = struct.unpack_from("<H", laszip, 0)
        chunk, = struct.unpack_from("<I", laszip, 12)
        self.check(scheme == 3, f"compressor {scheme}, not the layered one")
        self.check(chunk == 0xFFFFFFFF, f"chunks of {chunk} points, not of variable size")
        if self.extra:
            self.check(("LASF_Spec", 4) in self.records, "extra bytes without names")

    def read_info(self):
        info = self.records[("copc", 1)]
        *self.centre, self.half, self.spacing = struct.unpack_from("<5d", info)
        self.root_offset, self.root_size = struct.unpack_from("<QQ", info, 40)
        self.times = struct.unpack_from("<2d", info, 56)
        self.check(info[72:] == bytes(88), "reserved bytes are not 0")
        self.check(self.half > 0 and self.spacing > 0, "no cube")
        self.check(self.times[0] <= self.times[1], "times are in no order")
        if self.points:
            for axis in range(3):
                inside = (self.centre[axis] - self.half <= self.low[axis] and
                          self.high[axis] <= self.centre[axis] + self.half)
                self.check(inside, f"the cube has not all of {'xyz'[axis]}")

    def read_page(self, offset, size):
        self.pages += 1
        begin, end = self.hierarchy
        self.check(begin <= offset and offset + size <= end, "a page lies outside")
        self.check(size % 32 == 0 and size > 0, "a page of no whole entries")
        for at in range(offset, offset + size, 32):
            *key, place, length, points = self.unpack("4iQii", at)
            if points == -1:
                self.check(tuple(key) not in self.nodes, f"{key} is there and has a page")
                self.read_page(place, length)
                self.check(tuple(key) in self.nodes, f"the page of {key} has it not")
                continue
            self.check(tuple(key) not in self.nodes, f"{key} is there twice")
            self.check(points >= 0 and (points > 0) == (length > 0), f"{key}: counts")
            self.nodes[tuple(key)] = (place, length, points)

    def check_tree(self):
        self.check((0, 0, 0, 0) in self.nodes, "no root")
        for level, *cell in self.nodes:
            self.check(all(0 <= c < 2 ** level for c in cell), f"{level} {cell}: no such cell")
            if level:
                parent = (level - 1, *(c // 2 for c in cell))
                self.check(parent in self.nodes, f"{level} {cell} has no parent")
        total = sum(points for _, _, points in self.nodes.values())
        self.check(total == self.points, f"nodes have {total} points, the header {self.points}")

    def cell_of(self, grid, level):
        """The cell of a point of whole steps, as a reader computes it."""
        side = 2 * self.half / 2 ** level
        return tuple(int((self.offset[a] + grid[a] * self.scale[a] - self.centre[a] + self.half) /
                         side) for a in range(3))

    def check_chunks(self):
        """Chunks fill the file from the points' beginning to the chunk table."""
        table, = self.unpack("Q", self.point_offset)
        at = self.point_offset + 8
        chunks = sorted((place, length, points, key)
                        for key, (place, length, points) in self.nodes.items() if points)
        for place, length, points, key in chunks:
            self.check(place == at, f"{key}: its chunk does not follow the one before")
            at = place + length
            count, = self.unpack("I", place + self.record_bytes)
            self.check(count == points, f"{key}: the chunk has {count} points, not {points}")
            grid = self.unpack("3i", place)
            self.check(self.cell_of(grid, key[0]) == key[1:], f"{key}: its first point is outside")
        self.check(at == table, "the chunk table does not follow the last chunk")
        version, count = self.unpack("II", table)
        self.check((version, count) == (0, len(chunks)), "the chunk table's number of chunks")

    def levels(self):
        """Nodes and points of each level."""
        found = {}
        for (level, *_), (_, _, points) in self.nodes.items():
            nodes, sum_ = found.get(level, (0, 0))
            found[level] = (nodes + 1, sum_ + points)
        return [found[level] for level in sorted(found)]


if __name__ == "__main__":
    bad = False
    for name in sys.argv[1:]:
        copc = CopcFile(name)
        bad = bad or bool(copc.faults)
        print(name, "; ".join(copc.faults[:5]) or "is sound:", copc.levels(), copc.pages, "pages")
    sys.exit(1 if bad else 0)
