"""A selection that cannot be had is an error, told once, on all ranks; nobody waits for ever.

usage: pvbatch refusals.py STORE DAMAGED      on any number of processes. STORE has an attribute
that is called "id"; DAMAGED has parts that cannot be read
Prints "== " and the step before each, so that what is told of it can be found.
"""

import os
import sys
import time

from paraview import servermanager, simple
from paraview.modules.vtkRemotingServerManager import vtkSMPropertyHelper
from paraview.modules.vtkRemotingViews import vtkSMSelectionHelper
from vtkmodules.vtkCommonDataModel import vtkSelectionNode

simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())

from scene import require

store, damaged = sys.argv[1:3]
RANKS = servermanager.ActiveConnection.GetNumberOfDataPartitions()
POINTS = 40000


view = simple.CreateView("RenderView")


def opened(name):
    reader = simple.OpenDataFile(name)
    reader.OverviewPoints = 1000
    simple.Show(reader, view)
    return reader


def selected(reader, query=None):
    """Points that are extracted of a query, or of the active selection."""
    if query:
        simple.QuerySelect(QueryString=query, FieldType="POINT", Source=reader)
    extracted = simple.ExtractSelection(Input=reader)
    extracted.UpdatePipeline()
    points = extracted.GetDataInformation().GetNumberOfPoints()
    simple.Delete(extracted)
    return points


def step(name):
    """In the stream of errors: mpiexec keeps the order of one rank's stream only."""
    time.sleep(0.5)
    print("== " + name, file=sys.stderr, flush=True)


reader = opened(store)
settings = simple.GetSettingsProxy("PointFrontSettings")

# An attribute of that name is meant, not the row: in the files, id is 7 of every tenth point.
step("id")
require(selected(reader, "(id == 7)") == POINTS // 10, "an attribute that is called id")

# A malformed query is an error, and the program goes on.
for name, query in (("malformed", "(id >"), ("no name", "(no_such_attribute > 1)")):
    step(name)
    require(selected(reader, query) == 0, "%s selects something" % query)
step("sound")
require(selected(reader, "(id == 7)") == POINTS // 10, "after a malformed query")
simple.ClearSelection(reader)

# A region that misses the cloud: that there are no points is told, not left to be found out.
step("beside")
beside = PointFrontExtract(Input=reader, UseRegion=1)
beside.Region = "Sphere"
beside.Region.Center, beside.Region.Radius = [1e9, 1e9, 1e9], 1.0
beside.UpdatePipeline()
simple.Delete(beside)
# So it is with a turned box, of which no side has the whole cloud beyond it.
step("turned")
turned = PointFrontExtract(Input=reader, UseRegion=1)
turned.Region = "Box"
turned.Region.Position, turned.Region.Length = [210.0, 99.0, -1e3], [10.0, 10.0, 2e3]
turned.Region.Rotation = [0.0, 0.0, 45.0]
turned.UpdatePipeline()
require(turned.GetDataInformation().GetNumberOfPoints() == 0, "points of a box beside")
simple.Delete(turned)

# Nor does what cannot be meant bring all points.
for name, region, settings_ in (("class", "Box", {"Classes": [300]}),
                                ("radius", "Sphere", {}), ("where", "Box", {"Where": "id >"})):
    step(name)
    refused = PointFrontExtract(Input=reader, Region=region, **settings_)
    if region == "Sphere":
        refused.Region.Radius = -1.0
    refused.UpdatePipeline()
    require(refused.GetDataInformation().GetNumberOfPoints() == 0, name + ": points come")
    simple.Delete(refused)

step("too many")
settings.MostSelectionPoints = 100
require(selected(reader, "(id == 7)") == 0, "more points than may be read")
step("unnamed")
query = reader.SMProxy.GetSelectionInput(0)
frozen = vtkSMSelectionHelper.ConvertSelectionSource(
    vtkSelectionNode.INDICES, vtkSMPropertyHelper(query, "Input").GetAsProxy(0), reader.SMProxy, 0)
step("enough")
settings.MostSelectionPoints = 50 * 10 ** 6
require(selected(reader, "(id == 7)") == POINTS // 10, "after a refusal")

# Behind the first ranks' parts lie some that cannot be read.
step("damaged")
simple.ClearSelection(reader)
broken = opened(damaged)
require(selected(broken, "(id < 100)") == 0, "a part of what is selected")
step("done")
