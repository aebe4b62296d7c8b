"""Random queries of random clouds, by the tool and by Python, against a filter in NumPy.

Environment: POINTFRONT_PYTHON_PACKAGE the folder of the Python package, where one was built; the
seeds: see random_cases.py. Ten seeds share a cloud. A query that differs is shrunk to the smallest
that still differs, which is printed with its seed and its cloud; docs/developer/random-tests.md
says what was found.
"""

import importlib
import json
import os
import random
import sys
import unittest

import numpy

from random_cases import COUNT, FIRST, shrunk
from random_clouds import columns_of, make_cloud, random_cloud, world
from random_queries import (masks_of, python_arguments, random_for_python, random_query,
                            tool_arguments)
from tool import ToolTest, pointfront

PACKAGE = os.environ.get("POINTFRONT_PYTHON_PACKAGE", "")
QUERIES_A_CLOUD = 10
# (cloud, query) of what once differed.
FOUND = (
    # A block that is higher than wide: a level of its index had gaps of five spacings.
    ({"seed": 267697234, "points": 2863, "shape": "block", "scale": [0.001, 0.001, 0.01],
      "offset": [637000.0, 851000.0, 400.0], "classes": 30, "form": "index",
      "options": {"node-points": 256}}, {"spacing": 0.0699}),
    # Two places far from all others, each of 40 points: none of them was in a level of the index.
    ({"seed": 510729647, "points": 3301, "shape": "lines", "scale": [0.01] * 3,
      "offset": [-4.0e6, 5.5e6, -100.0], "classes": 30, "form": "index",
      "options": {"node-points": 256}, "copies": 40}, {"spacing": 0.275}),
)


class Refused(Exception):
    """The query is none."""


def rows_of(positions, columns, names):
    """One row of doubles for each point, in an order that does not depend on that of the points.
    Coordinates are given as whole steps."""
    parts = [positions, *(columns[name] for name in names)]
    rows = numpy.column_stack([numpy.asarray(part, float) for part in parts])
    rows = numpy.where(numpy.isnan(rows), 1e300, rows)
    return rows[numpy.lexsort(rows.T[::-1])]


class OpenedCloud:
    """A stored cloud and all of its points."""

    def __init__(self, cloud, folder, succeed):
        self.path, records = make_cloud(cloud, folder, succeed)
        self.scale, self.offset = numpy.array(cloud["scale"]), numpy.array(cloud["offset"])
        self.positions, self.columns = world(records, self.scale, self.offset), columns_of(records)
        self.means = cloud.get("options", {}).get("refinement") == "replace"
        # An index has the points of a node in the order of the file: as many as asked, not evenly.
        # A store's spacing is the usual distance of neighbours: TrueGaps.* knows gaps of 2.2.
        self.is_index = cloud.get("form") == "index"
        self.most_gap = 4.0 if self.is_index else 2.2
        self.levels = {}

    def grid(self, positions):
        return numpy.rint((positions - self.offset) / self.scale)

    def rows(self, mask):
        return rows_of(self.grid(self.positions[mask]),
                       {name: column[mask] for name, column in self.columns.items()},
                       sorted(self.columns))

    def gap_beyond(self, mask, most):
        """Largest distance of one of 500 points from the nearest of the mask; 0: none is as far as
        `most`. Each has the same chance to be in a level of an index, so one that has few others
        near it may be missing with all of them."""
        chosen, places = self.positions[mask], numpy.unique(self.positions, axis=0)
        widest = 0.0
        for point in self.positions[:: 1 + len(self.positions) // 500]:
            gap = numpy.sqrt(((chosen - point) ** 2).sum(axis=1).min())
            if gap >= most and not (self.is_index and
                                    (((places - point) ** 2).sum(axis=1) < most ** 2).sum() < 8):
                widest = max(widest, gap)
        return widest

    def named_by(self, rows):
        """Which points these rows are, by their serial numbers."""
        at = 3 + sum(column.size // len(column) for name, column in self.columns.items()
                     if name < "serial")
        return numpy.isin(self.columns["serial"], rows[:, at].astype(int))


def difference(expected, got):
    """Both are rows of rows_of()."""
    if expected.shape != got.shape:
        return f"{len(got)} points, not {len(expected)}"
    if not numpy.array_equal(expected, got):
        return f"{(expected != got).any(axis=1).sum()} of {len(got)} points differ"
    return ""


class RandomQueries(ToolTest):
    generator = staticmethod(random_query)

    def clouds(self):
        """(seed, specification of the cloud, cloud, its queries) of the seeds."""
        for first in range(FIRST // QUERIES_A_CLOUD, (FIRST + COUNT - 1) // QUERIES_A_CLOUD + 1):
            spec = random_cloud(random.Random(first))
            cloud = OpenedCloud(spec, self.folder / f"cloud{first}", self.succeed)
            for seed in range(first * QUERIES_A_CLOUD, (first + 1) * QUERIES_A_CLOUD):
                if FIRST <= seed < FIRST + COUNT:
                    query = self.generator(random.Random(seed), cloud.positions, cloud.columns)
                    yield seed, spec, cloud, query

    def judge(self, judge, asked=None):
        """`judge(cloud, query)` says what is wrong, or nothing."""
        for seed, spec, cloud, query in asked or self.clouds():
            with self.subTest(seed=seed):
                wrong = judge(cloud, query)
                if not wrong:
                    continue
                smallest = shrunk(query, lambda one: self.still(judge, cloud, one))
                found = (f"seed {seed}: {wrong}; {json.dumps(spec)} smallest: "
                         f"{json.dumps(smallest)}: {judge(cloud, smallest)}")
                print(found, flush=True)  # a night is long
                self.fail(found)

    def still(self, judge, cloud, query):
        try:
            return judge(cloud, query)
        except Refused:
            return ""

    def found(self):
        for number, (spec, query) in enumerate(FOUND):
            cloud = OpenedCloud(spec, self.folder / f"found{number}", self.succeed)
            yield f"found {number}", spec, cloud, query

    # The tool.

    def exported(self, cloud, query):
        """Rows of the points that the tool writes."""
        out = self.folder / "out.csv"
        words = tool_arguments(query, self.folder)
        outcome = self.run_tool("export", cloud.path, "-o", out, "--force", *words)
        head, text = out.read_text().split("\n", 1)
        names = head.split(",")
        table = numpy.fromstring(text.replace("\n", ","), sep=",").reshape(-1, len(names))
        self.assertIn(f": {len(table)} points", outcome.out)
        place = {name: number for number, name in enumerate(names)}
        columns = {}
        for name, column in cloud.columns.items():
            at = place["red" if name == "rgb" else name]
            values = table[:, at:at + (1 if column.ndim == 1 else column.shape[1])]
            # Written with the digits that a float needs.
            columns[name] = values.astype(numpy.float32) if column.dtype == "f4" else values
        return rows_of(cloud.grid(table[:, :3]), columns, sorted(columns))

    def run_tool(self, *arguments):
        outcome = pointfront(*arguments)
        if outcome.status == 2 or "no area" in outcome.err:
            raise Refused(outcome.err)
        self.assertEqual(outcome.status, 0, outcome)
        return outcome

    def judge_export(self, cloud, query):
        surely, perhaps = masks_of(query, cloud.positions, cloud.columns)
        got = self.exported(cloud, query)
        if "spacing" not in query:
            return between(cloud, surely, perhaps, got)
        if cloud.means:
            return ""  # means of points, which no filter of the points gives
        level = self.level(cloud, query["spacing"])
        return between(cloud, surely & level, perhaps & level, got)

    def level(self, cloud, spacing):
        """Which points the whole cloud has at that spacing: each once, and each as it is."""
        if spacing not in cloud.levels:
            rows = self.exported(cloud, {"spacing": spacing})
            mask = cloud.named_by(rows)
            self.assertEqual(difference(cloud.rows(mask), rows), "", "a level has other points")
            gap = cloud.gap_beyond(mask, cloud.most_gap * spacing)
            self.assertEqual(gap, 0, f"a level of spacing {spacing} has holes")
            cloud.levels[spacing] = mask
        return cloud.levels[spacing]

    def test_the_tool(self):
        self.judge(self.judge_export)

    def test_what_the_tool_once_had_wrong(self):
        self.judge(self.judge_export, self.found())


def between(cloud, surely, perhaps, got):
    """Says what is wrong with the rows `got`."""
    if (surely == perhaps).all():
        return difference(cloud.rows(surely), got)
    mask = cloud.named_by(got)
    if (surely & ~mask).any() or (mask & ~perhaps).any():
        return f"{(surely & ~mask).sum()} points are missing, {(mask & ~perhaps).sum()} too many"
    return difference(cloud.rows(mask), got)


@unittest.skipUnless(PACKAGE, "the Python package was not built")
class RandomQueriesInPython(RandomQueries):
    """The same of Cloud.points: each array in its type, in the order of the store."""

    generator = staticmethod(random_for_python)

    @classmethod
    def setUpClass(cls):
        sys.path.insert(0, PACKAGE)
        import pointfront
        cls.package = pointfront

    def everything(self, cloud):
        """Reads all points, which the filter is applied to."""
        if not hasattr(cloud, "all"):
            cloud.opened = self.package.open(cloud.path)
            cloud.all = cloud.opened.points()
            cloud.stored = dict(cloud.all, rgb=cloud.columns["rgb"][cloud.all["serial"]])
            self.assertTrue((cloud.all["rgb"] == cloud.stored["rgb"]).all(), "colours")
            rows = rows_of(cloud.grid(cloud.all["position"]), cloud.stored, sorted(cloud.columns))
            every = numpy.ones(len(cloud.positions), bool)
            self.assertEqual(difference(cloud.rows(every), rows), "", "all points")

    def judge_points(self, cloud, query):
        self.everything(cloud)
        words = python_arguments(query)
        if "ids" in query:
            words["point_ids"] = self.ids_array(cloud, *query["ids"])
        if "planes" in query:
            words["frustum"] = self.planes(query["planes"])
        try:
            got = cloud.opened.points(**words)
        except (self.package.PointFrontError, ValueError) as problem:
            raise Refused(str(problem)) from None
        surely, perhaps = masks_of(query, cloud.all["position"], cloud.stored)
        if "spacing" in query:
            if cloud.means:
                return ""
            level = self.ids_at(cloud, query["spacing"])
            surely, perhaps = surely & level, perhaps & level
        return self.wrong_arrays(cloud, query, surely, perhaps, got)

    def ids_array(self, cloud, first, step):
        """Backwards: the answer is in the order of the store all the same."""
        array = self.vtk("vtkCommonCore").vtkIdTypeArray()
        for number in cloud.all["id"][first::step][::-1]:
            array.InsertNextValue(number)
        return array

    def planes(self, planes):
        points, normals = (self.vtk("vtkCommonCore").vtkPoints(),
                           self.vtk("vtkCommonCore").vtkDoubleArray())
        points.SetDataTypeToDouble()
        normals.SetNumberOfComponents(3)
        for normal, place in planes:
            normals.InsertNextTuple(normal)
            points.InsertNextPoint(place)
        result = self.vtk("vtkCommonDataModel").vtkPlanes()
        result.SetPoints(points)
        result.SetNormals(normals)
        return result

    def vtk(self, module):
        return importlib.import_module(f"{self.package.VTK_PACKAGE}.{module}")

    def ids_at(self, cloud, spacing):
        """Which points the whole cloud has at that spacing."""
        if ("ids", spacing) not in cloud.levels:
            ids = cloud.opened.points(spacing=spacing, attributes=["serial"])["id"]
            cloud.levels["ids", spacing] = numpy.isin(cloud.all["id"], ids)
        return cloud.levels["ids", spacing]

    def wrong_arrays(self, cloud, query, surely, perhaps, got):
        everything = cloud.all
        names = {"position", "id", *query.get("attributes", cloud.columns)}
        if not names <= set(got):
            return f"no array of {sorted(names - set(got))}"
        if (numpy.diff(got["id"]) <= 0).any():
            return "ids are not in the order of the store"
        mask = numpy.isin(everything["id"], got["id"])
        if (surely & ~mask).any() or (mask & ~perhaps).any() or mask.sum() != len(got["id"]):
            return (f"{(surely & ~mask).sum()} points are missing, {(mask & ~perhaps).sum()} too "
                    f"many of {len(got['id'])}")
        for name in names:
            if got[name].dtype != everything[name].dtype:
                return f"{name} has type {got[name].dtype}"
            if not numpy.array_equal(got[name], everything[name][mask],
                                     equal_nan=got[name].dtype.kind == "f"):
                return f"{name} has other values"
        return ""

    def test_the_tool(self):
        """Python has what the tool has."""
        self.judge(self.judge_points)

    def test_what_the_tool_once_had_wrong(self):
        self.judge(self.judge_points, self.found())


if __name__ == "__main__":
    unittest.main()
