"""Point files: a store is built beside them, or the one that is there is used.

usage: pvbatch files.py FOLDER      on any number of processes; FOLDER has stadium.laz, points.ply,
                                    points.xyz, surface.ply, part_1.xyz, part_2.xyz and no store
"""

import os
import sys
import time

from paraview import servermanager, simple

simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())
PointFrontPointFiles = globals()["PointFrontPointFiles"]

from scene import POINTS, SIZE, Scene, require

folder = sys.argv[1]
RANKS = servermanager.ActiveConnection.GetNumberOfDataPartitions()


def at(name):
    return os.path.join(folder, name)


def points_of(reader):
    """That a reader's store has; -1: there is none."""
    reader.UpdatePipeline()
    array = reader.GetDataInformation().DataInformation.GetFieldDataInformation()
    found = array.GetArrayInformation("store_points")
    return int(found.GetComponentRange(0)[0]) if found else -1


def opened(*names):
    """By ParaView's choice, where no reader of its own has that ending; else by name."""
    paths = [at(name) for name in names]
    if not names[0].endswith(".laz"):
        return PointFrontPointFiles(FileName=paths)
    reader = simple.OpenDataFile(paths)
    require(reader.GetXMLName() == "PointFrontFiles", "%s by %s" % (names, reader.GetXMLName()))
    return reader


def candidates(name):
    """Readers that File > Open offers for a file."""
    factory = servermanager.vtkSMProxyManager.GetProxyManager().GetReaderFactory()
    found = factory.GetReaders(at(name), servermanager.ActiveConnection.Session)
    return [found.GetString(i) for i in range(found.GetNumberOfStrings())]


# A LAZ file: built at the first update, not when it is chosen.
scene = Scene()
scene.view.ViewSize = SIZE
scene.display.Visibility = 0
reader = opened("stadium.laz")
store = at("stadium.laz.pfront")
require(not os.path.exists(store), "built before Apply")
display = scene.show(reader)
display.TargetError, display.PointBudget = 0.01, 0
require(points_of(reader) == POINTS, "%d points" % points_of(reader))
require(display.Representation == "Point Front", "shown as " + str(display.Representation))
scene.color_by(display, "rgb")
scene.save("files-%d" % RANKS)
require(scene.frame(display) == (POINTS, True), "drawn: %s" % (scene.frame(display),))

# Once more: nothing is built.
built = os.stat(store).st_mtime_ns
again = opened("stadium.laz")
require(points_of(again) == POINTS, "opened again")
require(os.stat(store).st_mtime_ns == built, "a store that fits is built again")

# Changed files: an error, until it may be replaced. The folder's clock may be coarse.
os.utime(at("stadium.laz"), ns=(built + 10 ** 9, built + 10 ** 9))
print("== an older store", flush=True)
older = opened("stadium.laz")
require(points_of(older) == -1, "a store older than its file is used")
require(os.stat(store).st_mtime_ns == built, "replaced without being asked")
print("== replaced", flush=True)
os.utime(at("stadium.laz"), ns=(built - 10 ** 9, built - 10 ** 9))
older.Normals = "By PCA"
older.ReplaceStore = 1
require(points_of(older) == POINTS, "not built again")
require("normal" in older.PointData.keys(), "without normals: %s" % older.PointData.keys())
# A store does not say which normals it has: what is changed is built.
first = os.stat(store).st_mtime_ns
require(points_of(older) == POINTS and os.stat(store).st_mtime_ns == first, "built twice")
older.Normals = "From the scan"
require(points_of(older) == POINTS and os.stat(store).st_mtime_ns > first, "not built again")

# Where nothing can be written.
print("== no place", flush=True)
elsewhere = opened("points.xyz")
elsewhere.StoreFile = "/proc/none/points.pfront"
require(points_of(elsewhere) == -1, "written to /proc")
print("== another place", flush=True)
elsewhere.StoreFile = at("chosen.pfront")
require(points_of(elsewhere) == 1000, "another place: %d points" % points_of(elsewhere))
require(os.path.exists(at("chosen.pfront")), "not where it was asked for")
require(not os.path.exists(at("points.xyz.pfront")), "beside the file as well")

# Several files are one cloud; other families; a surface is none.
require(points_of(opened("part_1.xyz", "part_2.xyz")) == 2000, "two files")
require(points_of(opened("points.ply")) == 1000, "a PLY file of points")
for name in ("stadium.laz", "points.xyz", "points.ply"):
    require("PointFrontFiles" in candidates(name), "%s: %s" % (name, candidates(name)))

# A cloud that is read in place is not built.
with open(at("list.pfronts"), "w") as listed:
    listed.write("stadium.laz.pfront\n")
in_place = [at("list.pfronts")]
shared = os.environ["POINTFRONT_SHARED_DATA"]
if shared:
    in_place += [os.path.join(shared, "copc", "lone-star.copc.laz"),
                 os.path.join(shared, "ept", "lone-star-laszip", "ept.json")]
for path in in_place:
    offered = candidates(path)
    require("PointFrontReader" in offered and "PointFrontFiles" not in offered,
            "%s: %s" % (path, offered))
    require(points_of(simple.OpenDataFile(path)) > 1000, "no points of " + path)
require("PLYReader" in candidates("surface.ply"), "nobody reads surfaces")
require("PointFrontFiles" not in candidates("surface.ply"), "a surface is taken for a cloud")

# Aborted: nothing is left behind, nothing comes, and the next update builds.
if RANKS == 1:
    print("== aborted", flush=True)
    aborted = opened("points.xyz")
    algorithm = aborted.SMProxy.GetClientSideObject()
    observed = []

    def abort(*_):
        observed.append(algorithm.GetProgressText())
        algorithm.SetAbortExecute(1)

    number = algorithm.AddObserver("ProgressEvent", abort)
    require(points_of(aborted) == -1, "aborted, and there are points")
    require(observed, "no progress")
    require(not os.path.exists(at("points.xyz.pfront")), "aborted, and there is a store")
    algorithm.RemoveObserver(number)
    algorithm.SetAbortExecute(0)
    algorithm.Modified()
    aborted.SMProxy.MarkModified(aborted.SMProxy)
    require(points_of(aborted) == 1000, "not built after an abort")
print("== done", flush=True)
