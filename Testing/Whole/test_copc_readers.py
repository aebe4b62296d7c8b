"""COPC that `export` wrote, read by programs that are not ours: laspy (lazrs) and copclib.
Run by the Python of scripts/copc-readers."""

import unittest

import copclib
import laspy
import numpy
from laspy.copc import Bounds, CopcReader

from copc_file import CopcFile
from tool import DATA, ToolTest, write_las

CLOUDS = ("classified/lidarhd_rgb_nir_698k.laz", "las/real/autzen_trim.las",
          "las/real/test1_4.las", "las/real/extrabytes.las", "copc/lone-star.copc.laz")
# Scan angles of the formats below 6 are whole degrees, those above steps of 0.006 degrees; their
# flags are other bits.
NOT_COMPARED = {"X", "Y", "Z", "scan_angle", "scan_angle_rank", "classification_flags",
                "synthetic", "key_point", "withheld", "overlap"}


class Readers(ToolTest):
    def published(self, cloud):
        store = self.build(cloud, name=f"{cloud.stem}.pfront")
        out = self.folder / f"{cloud.stem}.copc.laz"
        self.succeed("export", store, "-o", out)
        return out

    def test_points_are_those_of_the_source_value_for_value(self):
        for name in CLOUDS:
            source = laspy.read(DATA / name)
            copc = laspy.read(self.published(DATA / name))
            self.assertEqual(len(copc), len(source), name)
            numpy.testing.assert_array_equal(copc.header.scales, source.header.scales)
            names = [n for n in source.point_format.dimension_names if n not in NOT_COMPARED
                     and n in copc.point_format.dimension_names]
            grids = []
            for cloud in (source, copc):
                shift = numpy.rint((cloud.header.offsets - source.header.offsets) /
                                   source.header.scales).astype(numpy.int64)
                columns = [numpy.asarray(getattr(cloud, axis), numpy.int64) + shift[i]
                           for i, axis in enumerate("XYZ")]
                columns += [numpy.asarray(cloud[n]) for n in names]
                flat = []
                for column in columns:
                    flat += list(column.T) if column.ndim > 1 else [column]
                order = numpy.lexsort(flat[::-1])
                grids.append([column[order] for column in flat])
            for i, (was, now) in enumerate(zip(*grids)):
                numpy.testing.assert_array_equal(was, now, f"{name}, column {i} of {names}")

    def test_a_box_and_a_level(self):
        out = self.published(DATA / CLOUDS[0])
        cloud = laspy.read(out)
        # A quarter of a step beside the grid: laspy rounds a box to the grid.
        quarter = cloud.header.scales / 4
        half = numpy.floor((cloud.header.maxs - cloud.header.mins) / 2 / cloud.header.scales)
        low = cloud.header.mins - quarter
        high = cloud.header.mins + half * cloud.header.scales + quarter
        x, y, z = (numpy.asarray(cloud[axis]) for axis in "xyz")
        inside = ((x >= low[0]) & (x <= high[0]) & (y >= low[1]) & (y <= high[1]) &
                  (z >= low[2]) & (z <= high[2])).sum()
        box = ",".join(repr(float(v)) for v in (*low, *high))
        part = self.folder / "part.las"
        self.succeed("export", out, "-o", part, "--box", box)
        self.assertEqual(len(laspy.read(part)), inside)
        with CopcReader.open(out) as reader:
            self.assertEqual(len(reader.query(bounds=Bounds(mins=low, maxs=high))), inside)
            counts = [len(reader.query(level=range(k + 1))) for k in range(4)]
            self.assertEqual(counts, sorted(counts))
            self.assertEqual(len(reader.query()), len(cloud))

    def test_each_point_lies_in_its_node(self):
        far = write_las(self.folder / "far.las", [
            (i * 7919.01 % 1e7, i * 104729.5 % 1e7, i % 100, i % 256, 0, 0)
            for i in range(120000)])
        for cloud in (far, *(DATA / name for name in CLOUDS)):
            out = self.published(cloud)
            reader = copclib.FileReader(str(out))
            header = reader.copc_config.las_header
            nodes = reader.GetAllNodes()
            self.assertEqual(sum(node.point_count for node in nodes), header.point_count)
            info = reader.copc_config.copc_info
            corner = numpy.array([info.center_x, info.center_y, info.center_z]) - info.halfsize
            for node in nodes:
                points = reader.GetPoints(node)
                side = 2 * info.halfsize / 2 ** node.key.d
                places = numpy.array([points.x, points.y, points.z]).T
                cells = numpy.floor((places - corner) / side).astype(int)
                key = [node.key.x, node.key.y, node.key.z]
                self.assertTrue((cells == key).all(), (cloud, node.key))
            times = numpy.asarray(laspy.read(out).gps_time)
            self.assertEqual(CopcFile(out).times, (times.min(), times.max()))


if __name__ == "__main__":
    unittest.main(verbosity=2)
