"""Ways to run ParaView that open and write files. Each function is a test: see drive.py."""

import contextlib
import csv
import glob
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import urllib.request

import numpy
import pictures
from expected import compare, exported
from programs import HERE, mpi, python_client, tool, with_server

sys.path.insert(0, os.path.join(HERE, "..", "..", "Testing", "Whole"))
# pylint: disable=wrong-import-position
import virtual_clouds


def files(programs):
    """Point files of several families, opened on one process and on two."""
    def places(shift):
        return [(i % 40, i // 40 + shift, 0.01 * i) for i in range(1000)]

    header = "ply\nformat ascii 1.0\nelement vertex %d\n" + "".join(
        "property double %s\n" % axis for axis in "xyz") + "%send_header\n"
    for ranks_ in (1, 2):
        folder = os.path.abspath("files-of-%d" % ranks_)
        shutil.rmtree(folder, ignore_errors=True)
        os.makedirs(folder)
        shutil.copyfile(os.environ["POINTFRONT_CLOUD"], os.path.join(folder, "stadium.laz"))
        for name, shift in (("points.xyz", 0), ("part_1.xyz", 0), ("part_2.xyz", 25)):
            with open(os.path.join(folder, name), "w") as file:
                file.writelines("%g %g %g\n" % place for place in places(shift))
        with open(os.path.join(folder, "points.ply"), "w") as file:
            file.write(header % (1000, ""))
            file.writelines("%g %g %g\n" % place for place in places(0))
        with open(os.path.join(folder, "surface.ply"), "w") as file:
            file.write(header % (3, "element face 1\nproperty list uchar int vertex_indices\n"))
            file.write("0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
        command = [os.environ["POINTFRONT_PVBATCH"], os.path.join(HERE, "files.py"), folder]
        told = programs.told(
            "files-%d.log" % ranks_, *(command if ranks_ == 1 else mpi(ranks_, *command)))
        steps = dict(part.split("\n", 1) for part in told.split("== ")[1:])
        for step, words in (("an older store", ["is older than", "Replace Store"]),
                            ("no place", ["/proc/none/points.pfront", "Store File"]),
                            ("replaced", []), ("another place", []), ("aborted", [])):
            if step in steps and (steps[step].count("ERR|") != (1 if words else 0) or
                                  not all(word in steps[step] for word in words)):
                raise AssertionError("what is said of %s: %s" % (step, steps[step]))
        compare("files-%d" % ranks_, "tool")


def opened(programs):
    """Lines chosen in File > Open are a cloud each; a group, which is one line, is one cloud."""
    for old in glob.glob("*.las*"):
        os.remove(old)
    tiles = {}
    for number, name in enumerate(
            "north east south west tile_1 tile_2 tile_3 tile_4".split()):
        tool("generate", "--points", str(2000 + 1000 * number), "--seed", str(number),
             "-o", name + ".las")
        tiles[name + ".las"] = json.loads(tool("info", name + ".las", "--json"))["points"]
    single = [name for name in sorted(tiles) if "_" not in name]
    group = sorted(set(tiles) - set(single))
    os.environ["POINTFRONT_LINES"] = json.dumps([single, ["tile_..las"]])
    try:
        programs.run(os.environ["POINTFRONT_PARAVIEW"], "--dr",
                     "--script=" + os.path.join(HERE, "opened.py"))
    finally:
        if os.path.exists("opened.json"):
            print(open("opened.json").read())
    with open("opened.json") as file:
        rounds = json.load(file)["rounds"]
    wanted = [[["PointFrontFiles", [name], tiles[name]] for name in single],
              [["PointFrontFiles", group, sum(tiles[name] for name in group)]]]
    if rounds != wanted:
        raise AssertionError("opened are %s, not %s" % (rounds, wanted))
    stores = sorted(glob.glob("*.las*.pfront"))
    if sorted(name.split(".las")[0] + ".las" for name in stores) != sorted([*single, group[0]]):
        raise AssertionError("the stores are %s" % stores)
    for number in (0, 1):
        picture = pictures.load("opened-%d.png" % number)
        if (picture != picture[-1, -1]).any(axis=2).mean() < 0.02:
            raise AssertionError("nothing is shown")


THIS_MACHINE = "127.0.0.1"


@contextlib.contextmanager
def served(folder):
    """The origin of a web server of this machine that has the folder's files."""
    script = os.path.join(HERE, "..", "..", "Testing", "Support", "far_server.py")
    with subprocess.Popen([sys.executable, "-B", script, folder], stdin=subprocess.PIPE,
                          stdout=subprocess.PIPE, text=True) as server:
        yield f"http://{THIS_MACHINE}:{server.stdout.readline().strip()}"
        server.stdin.close()


def write_tiles(origin):
    """far.vpc: the points of the store in two COPC files, and a third one far away."""
    items = []
    for name, where in (("dark", "intensity <= 100"), ("bright", "intensity > 100")):
        tool("export", "cloud.pfront", "-o", name + ".copc.laz", "--force", "--where", where)
        tile = virtual_clouds.Tile(name + ".copc.laz")
        items.append(virtual_clouds.item(f"{origin}/{name}.copc.laz", [*tile.low, *tile.high],
                                         tile.points))
    content, box = tile.moved((3000, 0, 0))
    with open("away.copc.laz", "wb") as file:
        file.write(content)
    items.append(virtual_clouds.item(f"{origin}/away.copc.laz", box, tile.points))
    return virtual_clouds.write_list(pathlib.Path("far.vpc").absolute(), items)


def far(programs):
    """A cloud by its address, in the application and on a server with two ranks; lists of it."""
    for name in [name for name in os.environ if name.lower().endswith("_proxy")]:
        del os.environ[name]
    os.environ["POINTFRONT_CACHE"] = "off"
    with served(os.getcwd()) as origin:
        address = origin + "/cloud.pfront?sig=SECRET"
        with open("far.pfronts", "w") as listed:
            listed.write("# the store, by its address\n%s\n" % address)
        os.environ["POINTFRONT_ADDRESS"] = address
        try:
            programs.run(os.environ["POINTFRONT_PARAVIEW"], "--dr",
                         "--script=" + os.path.join(HERE, "far_panel.py"))
        finally:
            if os.path.exists("far_panel.json"):
                print(open("far_panel.json").read())
        shutil.rmtree("a cache", ignore_errors=True)
        with_server(programs, python_client("far.py", address, os.path.abspath("far.pfronts"),
                                            str(write_tiles(origin))))
        with urllib.request.urlopen(origin + "/~log") as log:
            asked = {one["path"] for one in json.load(log)["requests"]}
    with open("far_panel.json") as file:
        seen = json.load(file)
    points = "{:,}".format(int(os.environ["POINTFRONT_POINTS"]))
    if not seen["frame"][1].endswith(" of " + points) or not seen["store"].startswith(points):
        raise AssertionError("by the panel: %s" % seen)
    compare("far", "tool")
    for name in ("list", "vpc", "kept", "offline"):
        compare("far-" + name, "tool")
    if not {"/dark.copc.laz", "/bright.copc.laz"} <= asked:
        raise AssertionError("the tiles were not read: %s" % asked)
    told = open("server.log").read()
    if (not 2 <= told.count("ERR|") <= 4 or "none.pfront" not in told or
            "is not in the cache" not in told or "SECRET" in told):
        raise AssertionError("what is said of addresses that name nothing: " + told)


def written(programs):
    for ranks_ in (1, 2):
        name = "written-%d" % ranks_
        command = [os.environ["POINTFRONT_PVBATCH"], os.path.join(HERE, "written.py"), name]
        with open(name + ".log", "w") as log:
            done = programs.start(*(command if ranks_ == 1 else mpi(ranks_, *command)), output=log)
        try:
            programs.finish(done)
        finally:
            told = open(name + ".log").read()
            print(told)
        compare(name, "tool")
        if told.split("== kept")[1].split("== done")[0].count("is no file that") > 1:
            raise AssertionError("more than one error for one file")
        # The tool reads what was written: the points of the store, to the last bit, and the places
        # of a surface.
        wanted = exported("all")
        for ending in ("laz", "las"):
            path = os.path.abspath("%s-points.%s" % (name, ending))
            tool("build", path, "-o", name + "-points.pfront", "--force")
            got = exported("written", store=name + "-points.pfront")
            if not numpy.array_equal(got, wanted):
                raise AssertionError("%s has other points: %s, not %s"
                                     % (path, got.shape, wanted.shape))
            described = json.loads(tool("info", path, "--json"))
            if described["precision"] != 0.01:
                raise AssertionError("the grid is not kept: %s" % described)


def state(programs):
    """The state as a file and as a script, and the trace, in a ParaView that knows nothing."""
    pvbatch, script = os.environ["POINTFRONT_PVBATCH"], os.path.join(HERE, "state.py")
    programs.run(pvbatch, script, "save")
    programs.run(pvbatch, script, "load")
    compare("state-loaded", "state")
    # A trace of a script has what simple's functions did, and loads the plugin.
    programs.run(pvbatch, os.path.abspath("saved-trace.py"))
    # ParaView's states as scripts load no plugins: it is told of ours as of any that it shall load.
    with open("plugins.xml", "w") as file:
        file.write('<Plugins><Plugin name="PointFront" filename="%s" auto_load="1"/></Plugins>\n'
                   % os.environ["POINTFRONT_PLUGIN"])
    os.environ["PV_PLUGIN_CONFIG_FILE"] = os.path.abspath("plugins.xml")
    programs.run(pvbatch, os.path.abspath("saved-state.py"))
    compare("by-state", "state-loaded")


def first_hour(programs):
    """The program of docs/user/paraview.md, line by line; alone and on two ranks."""
    with open(os.path.join(HERE, "..", "..", "docs", "user", "paraview.md")) as file:
        chapter = file.read().split("## A first hour", 1)[1].split("\n## ", 1)[0]
    blocks = re.findall(r"```(sh|python)\n(.*?)```", chapter, re.DOTALL)
    for line in "".join(text for kind, text in blocks if kind == "sh").splitlines():
        program, *arguments = shlex.split(line)
        if program != "pointfront":
            raise AssertionError("not ours to run: " + line)
        tool(*arguments, "--force")
    script = "".join(text for kind, text in blocks if kind == "python")
    with open("hour.py", "w") as file:
        file.write(script.replace('"PointFront.so"', repr(os.environ["POINTFRONT_PLUGIN"])))
    wanted = re.findall(r'"(\w+\.(?:png|csv))"', script)
    # One process comes last: its pictures are those of the documentation.
    for ranks_, command in ((2, mpi(2, os.environ["POINTFRONT_PVBATCH"])),
                            (1, [os.environ["POINTFRONT_PVBATCH"]])):
        for old in glob.glob("flight*.png") + glob.glob("buildings*.*") + wanted:
            if os.path.exists(old):
                os.remove(old)
        programs.run(*command, "hour.py")
        for name in wanted:
            found = glob.glob(name.replace(".", "*."))
            if not found or min(os.path.getsize(path) for path in found) < 5000:
                raise AssertionError("%s on %d ranks: %s" % (name, ranks_, found))
        # Each building's points have places of their own, inside the box.
        places = []
        for path in glob.glob("buildings*.csv"):
            with open(path) as table:
                places += [[float(row["Points:%d" % axis]) for axis in range(3)]
                           for row in csv.DictReader(table)]
        places = numpy.array(places)
        sides = places.max(axis=0) - places.min(axis=0)
        if len(numpy.unique(places, axis=0)) < 0.99 * len(places) or sides[:2].max() > 200.01:
            raise AssertionError("coordinates are lost: %d places of %d points, sides %s"
                                 % (len(numpy.unique(places, axis=0)), len(places), sides))
        if len(glob.glob("flight*.png")) != 4:
            raise AssertionError("frames: %s" % glob.glob("flight*.png"))


def previewed(programs, *ways):
    points = 1500000  # some seconds of work, in which some pictures are drawn
    for way in ways:
        name = "large-%s.las" % way
        for old in glob.glob("large-%s*" % way) + glob.glob("preview*.*"):
            os.remove(old)
        tool("generate", "--points", str(points), "--seed", "5", "-o", name)
        os.environ["POINTFRONT_FILES"] = json.dumps([os.path.abspath(name)])
        os.environ["POINTFRONT_CANCEL"] = way if way in ("cancelled", "deleted") else ""
        command = [os.environ["POINTFRONT_PARAVIEW"], "--dr",
                   "--script=" + os.path.join(HERE, "preview.py")]
        try:
            if way == "ranks":
                with_server(programs,
                            lambda port: [*command, "--url=cs://127.0.0.1:%d" % port])
            else:
                programs.run(*command)
        finally:
            if os.path.exists("preview.json"):
                print(way, open("preview.json").read())
        with open("preview.json") as file:
            seen = json.load(file)
        begun, last = seen["while"], (seen["after"] or [None])[-1]
        if len(begun) < 3 or begun[0]["there"] or not begun[0]["drawn"] > 1000:
            raise AssertionError(way + ": no preview, or not before the store: %s" % begun)
        if not all(frame["store"].endswith(".preview.pfront") for frame in begun[:3]):
            raise AssertionError(way + ": not a preview: %s" % begun)
        left = sorted(os.path.basename(path) for path in glob.glob(name + ".*"))
        if way == "deleted":
            if left:
                raise AssertionError("deleted, and there is %s" % left)
        elif way == "cancelled":
            if last["store"] or last["drawn"] or left:
                raise AssertionError("cancelled, and there is %s, %s" % (last, left))
        elif last["drawn_of"] != points or last["store_points"] != points:
            raise AssertionError(way + ": not the store in the end: %s" % last)
        elif not seen["panel"].startswith("{:,} points".format(points)):
            raise AssertionError("%s: the panel of the store says %s" % (way, seen["panel"][:30]))
        elif left != [name + ".pfront"]:
            raise AssertionError("left behind: %s" % left)
        else:
            shutil.copyfile("preview.png", way + ".png")
        os.remove(name)


def preview(programs):
    """In the application a preview is in view while a store is built; so it is on a server."""
    previewed(programs, "alone", "cancelled", "ranks")
    compare("ranks", "alone")


def preview_deleted(programs):
    """The build of a cloud that is deleted ends."""
    previewed(programs, "deleted")
