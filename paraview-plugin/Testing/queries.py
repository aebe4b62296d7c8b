"""pvbatch on one process or several: queries select among all points of a store.

usage: pvbatch queries.py FILE     JSON: "wanted", points that each query selects; "means" of the
intensity; "steps", stores of several times, with their "highest" and "mean" elevation
"""

import json
import os
import sys

from paraview import servermanager, simple
from paraview.modules.vtkRemotingServerManager import vtkSMPropertyHelper
from paraview.modules.vtkRemotingViews import vtkSMSelectionHelper
from vtkmodules.vtkCommonDataModel import vtkSelectionNode

simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())

from scene import POINTS, Scene, require

with open(sys.argv[1]) as file:
    known = json.load(file)
scene = Scene()
reader = scene.reader
require(reader.OverviewPoints == 5000 < POINTS, "an overview")


def selected(invert=False):
    extracted = simple.ExtractSelection(Input=reader)
    extracted.UpdatePipeline()
    return extracted, extracted.GetDataInformation().GetNumberOfPoints()


for query, wanted in known["wanted"].items():
    for inside_out in (0, 1):
        simple.QuerySelect(
            QueryString=query, FieldType="POINT", Source=reader, InsideOut=inside_out)
        extracted, points = selected()
        expected = POINTS - wanted if inside_out else wanted
        print(query, inside_out, points, expected)
        require(points == expected > 0, "%s selects %d points, not %d" % (query, points, expected))
        # The view marks these points, and inspectors list them.
        marked = reader.SMProxy.GetSelectionOutput(0)
        marked.UpdatePipeline()
        found = marked.GetDataInformation(0).GetNumberOfPoints()
        require(found == expected, "%d points are marked, %d are selected" % (found, expected))
        require(set(reader.PointData.keys()) <= set(extracted.PointData.keys()), "arrays are gone")
        simple.Delete(extracted)

# A row's number is that of the reader's output, as a spreadsheet lists it.
simple.QuerySelect(QueryString="(id == 17)", FieldType="POINT", Source=reader)
extracted, points = selected()
ranks = servermanager.ActiveConnection.GetNumberOfDataPartitions()
require(points == ranks, "row 17: %d points" % points)
if ranks == 1:
    row = servermanager.Fetch(reader).GetPointData().GetArray("point_id").GetValue(17)
    found = extracted.PointData["point_id"].GetRange()
    require(found == (row, row), "row 17 is point %d, not %s" % (row, found))
simple.Delete(extracted)

# Frozen, the same points, by their names.
query, wanted = next(iter(known["wanted"].items()))
simple.QuerySelect(QueryString=query, FieldType="POINT", Source=reader)
appended = reader.SMProxy.GetSelectionInput(0)
frozen = vtkSMSelectionHelper.ConvertSelectionSource(
    vtkSelectionNode.INDICES, vtkSMPropertyHelper(appended, "Input").GetAsProxy(0),
    reader.SMProxy, 0)
frozen.UpdateVTKObjects()
require(frozen.GetXMLName() == "GlobalIDSelectionSource", "frozen as " + frozen.GetXMLName())
extracted = simple.ExtractSelection(Input=reader, Selection=servermanager._getPyProxy(frozen))
extracted.UpdatePipeline()
points = extracted.GetDataInformation().GetNumberOfPoints()
require(points == wanted, "frozen, %d points of %d" % (points, wanted))
simple.Delete(extracted)
simple.ClearSelection(reader)

# Statistics of what is selected at each time, of all points of each store.
steps = simple.OpenDataFile(known["steps"])
steps.OverviewPoints = 500
simple.Show(steps, scene.view)


def table_of(query):
    simple.QuerySelect(QueryString=query, FieldType="POINT", Source=steps)
    plot = simple.PlotSelectionOverTime(
        Input=steps, Selection=servermanager._getPyProxy(steps.SMProxy.GetSelectionInput(0)))
    plot.UpdatePipeline()
    fetched = servermanager.Fetch(plot)
    while fetched.IsA("vtkMultiBlockDataSet"):
        print("blocks", [fetched.GetMetaData(i).Get(fetched.NAME())
                         for i in range(fetched.GetNumberOfBlocks())])
        fetched = fetched.GetBlock(0)
    table = fetched.GetRowData()
    return {table.GetArrayName(i): [table.GetArray(i).GetValue(row)
                                    for row in range(table.GetArray(i).GetNumberOfTuples())]
            for i in range(table.GetNumberOfArrays()) if table.GetArray(i)}


def close(found, expected):
    return len(found) == 3 and all(abs(a - b) < 1e-3 for a, b in zip(found, expected))


everything = table_of("(elevation > -1000000)")
require(close(everything["max(elevation)"], known["highest"]), str(everything))
require(close(everything["avg(elevation)"], known["mean"]), str(everything))
highest = table_of("(elevation == max(elevation))")
require(close(highest["min(elevation)"], known["highest"]), str(highest))
