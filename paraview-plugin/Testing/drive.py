"""Runs ParaView in one of its ways on a store and compares its pictures with those of the tool.

usage: drive.py WAY      under a display of its own; one of the ways at the end of this file
Told by the environment: POINTFRONT_TOOL, POINTFRONT_PLUGIN, POINTFRONT_CLOUD (what to build the
store from), POINTFRONT_CAMERA, POINTFRONT_PVPYTHONPATH, POINTFRONT_{PVBATCH,PVSERVER,PARAVIEW,
MPIEXEC}. Writes under the current folder only.
"""

import glob
import json
import os
import re
import shlex
import shutil
import signal
import socket
import subprocess
import sys
import time

import numpy
import pictures

HERE = os.path.dirname(os.path.abspath(__file__))
# Seconds for all programs of a run together: below the test's own limit, to be ended here.
LIMIT = 240

# Two pictures of the same points with the same shader differ where two points meet in a pixel at
# nearly the same depth and the order of drawing decides: nodes come in another order, ranks are
# composited, and the depth buffer's 24 bits lie over another clipping range. Found: 9 pixels at
# most, 0.004 %.
CHANNEL = 8
SHARE = 0.001
# Against ParaView's own points, which Mesa draws: it rounds places to 1/256 of a pixel, the
# software back end does not, so points near a pixel's edge go to the one or the other side. Found:
# 0.13 % of colours, 0.33 % of intensities.
STOCK_SHARE = 0.005


def tool(*arguments):
    command = [os.environ["POINTFRONT_TOOL"], *arguments]
    done = subprocess.run(command, check=True, timeout=LIMIT, stdout=subprocess.PIPE, text=True)
    return done.stdout


class Programs:
    """The programs of a run, each in a process group of its own, all ended when the run ends."""

    def __init__(self):
        self.deadline = time.time() + LIMIT
        self.running = []
        # The user's settings stay out, none are left behind, and none of an earlier run are found.
        self.home = os.path.abspath("home")
        shutil.rmtree(self.home, ignore_errors=True)
        os.makedirs(self.home, mode=0o700)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for program in self.running:
            if program.poll() is None:
                os.killpg(program.pid, signal.SIGTERM)
        for program in self.running:
            try:
                program.wait(10)
            except subprocess.TimeoutExpired:
                os.killpg(program.pid, signal.SIGKILL)
                program.wait()

    def start(self, *command, output=None):
        environment = dict(os.environ)
        environment["PYTHONPATH"] = os.pathsep.join([os.environ["POINTFRONT_PVPYTHONPATH"], HERE])
        for name in ("HOME", "XDG_CONFIG_HOME", "XDG_RUNTIME_DIR"):
            environment[name] = self.home
        program = subprocess.Popen(command, env=environment, start_new_session=True, stdout=output,
                                   stderr=subprocess.STDOUT if output else None)
        self.running.append(program)
        return program

    def finish(self, program):
        status = program.wait(max(1.0, self.deadline - time.time()))
        if status != 0:
            raise AssertionError("%s ended with %d" % (os.path.basename(program.args[0]), status))

    def run(self, *command):
        self.finish(self.start(*command))


def mpi(ranks, program, *arguments):
    # One machine, no network: shared memory between the ranks, no remote shell. A waiting rank
    # leaves its core to others.
    return [os.environ["POINTFRONT_MPIEXEC"], "--allow-run-as-root", "--oversubscribe",
            "--mca", "btl", "self,vader", "--mca", "plm_rsh_agent", "false",
            "--mca", "mpi_yield_when_idle", "1",
            "-np", str(ranks), program, *arguments]


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def compare(one, other, share=SHARE, channel=CHANNEL):
    first, second = pictures.load(one + ".png"), pictures.load(other + ".png")
    covered = pictures.covered(first)
    found = pictures.differing(first, second, channel)
    print("%s, %s: %.3f %% of pixels differ by more than %d (limit %.3f %%), %.1f %% covered"
          % (one, other, 100 * found, channel, 100 * share, 100 * covered))
    # An empty picture agrees with an empty one.
    if covered < 0.1:
        raise AssertionError(one + " shows next to nothing")
    if found > share:
        raise AssertionError(one + " and " + other + " differ")


def make_large():
    large = os.environ["POINTFRONT_LARGE"] = os.path.abspath("large.pfront")
    tool("generate", "--points", "4000000", "--seed", "5", "-o", "large.las")
    tool("build", "large.las", "-o", large, "--force")
    os.remove("large.las")


def batch(programs):
    make_large()
    programs.run(os.environ["POINTFRONT_PVBATCH"], os.path.join(HERE, "batch.py"), "batch", "alone")
    compare("batch", "tool")
    compare("batch", "batch-stock", STOCK_SHARE)
    compare("batch", "batch-moved")
    compare("batch-intensity", "batch-stock-intensity", STOCK_SHARE)


def classes(programs):
    """A made-up survey, whose points are classified."""
    store = os.environ["POINTFRONT_STORE"] = os.path.abspath("classes.pfront")
    # It has four classes.
    tool("generate", "--points", "200000", "--seed", "3", "-o", "survey.las", "--force")
    tool("build", "survey.las", "-o", store, "--layers", "class", "--force")
    described = json.loads(tool("info", store, "--json"))
    os.environ["POINTFRONT_POINTS"] = str(described["points"])
    points = json.dumps({layer["name"]: layer["points"] for layer in described["layers"]})
    programs.run(
        os.environ["POINTFRONT_PVBATCH"], os.path.join(HERE, "classes.py"), points)


def ranks(programs):
    programs.run(*mpi(2, os.environ["POINTFRONT_PVBATCH"], os.path.join(HERE, "batch.py"), "ranks"))
    compare("ranks", "tool")
    # Means above, the input's points in the leaves: at full detail the same picture.
    store = os.environ["POINTFRONT_STORE"] = os.path.abspath("replace.pfront")
    tool("build", os.environ["POINTFRONT_CLOUD"], "-o", store, "--refinement", "replace", "--force")
    script = os.path.join(HERE, "pieces.py")
    programs.run(*mpi(3, os.environ["POINTFRONT_PVBATCH"], script, "pieces"))
    compare("pieces", "tool")


def backends(programs):
    """Of each technique the same pictures on 1, 2 and 4 ranks, but for 0.1 % and two levels of 255.

    But for what is blended: ranks are composited by depth, and their sums are not added up. Found:
    2.7 % on four ranks.
    """
    store = os.environ["POINTFRONT_STORE"] = os.path.abspath("small-nodes.pfront")
    tool("build", os.environ["POINTFRONT_CLOUD"], "-o", store, "--node-points", "1000", "--force")
    for old in glob.glob("backends-*.png"):
        os.remove(old)
    for count in (1, 2, 4):
        programs.run(*mpi(count, os.environ["POINTFRONT_PVBATCH"],
                          os.path.join(HERE, "backends.py"), "backends-%d" % count))
        for picture in sorted(glob.glob("backends-1-*.png")):
            way = picture[len("backends-1-"):-len(".png")]
            compare("backends-%d-%s" % (count, way), "backends-1-" + way, channel=2,
                    share=0.04 if way.startswith("ewa") else SHARE)


def with_server(programs, script, *arguments):
    """A Python client of a server with two ranks."""
    port = free_port()
    with open("server.log", "w") as log:
        running = programs.start(
            *mpi(2, os.environ["POINTFRONT_PVSERVER"], "--server-port=%d" % port), output=log)
        # A probing connection would be taken for the client, so wait for what the server says.
        while "Accepting connection" not in open("server.log").read():
            if running.poll() is not None or time.time() > programs.deadline:
                raise AssertionError("pvserver does not start:\n" + open("server.log").read())
            time.sleep(0.1)
        programs.run(sys.executable, os.path.join(HERE, script), str(port), *arguments)
        programs.finish(running)  # a server ends with its client


def server(programs):
    make_large()
    with_server(programs, "client.py", "server", "2")
    compare("server", "tool")


def colours(programs):
    with open("black.ply", "w") as ply:
        ply.write("ply\nformat ascii 1.0\nelement vertex 40000\n"
                  "property double x\nproperty double y\nproperty double z\n"
                  "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                  "property ushort intensity\nend_header\n")
        for i in range(40000):
            x, y = i % 200, i // 200
            ply.write("%d %d %g 0 0 0 %d\n" % (x, y, 0.002 * x * y, x + y))
    os.environ["POINTFRONT_COLOURED"] = os.environ["POINTFRONT_STORE"]
    store = os.environ["POINTFRONT_STORE"] = os.path.abspath("black.pfront")
    tool("build", "black.ply", "-o", store, "--force")
    with open("colours.log", "w") as log:
        programs.finish(programs.start(
            os.environ["POINTFRONT_PVBATCH"], os.path.join(HERE, "colours.py"), output=log))
    told = open("colours.log").read()
    print(told)
    if told.count("point_id") != 1:
        raise AssertionError("nobody is told, or more than once, that ids are no colours")


def facts(programs):
    """Ranges and facts, against what reading all points of the store says."""
    with open("statistics.json", "w") as file:
        file.write(tool("info", "--stats", "--json", os.environ["POINTFRONT_STORE"]))
    command = [os.environ["POINTFRONT_PVBATCH"], os.path.join(HERE, "facts.py"), "statistics.json"]
    programs.run(*command, "alone")
    programs.run(*mpi(2, *command))


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
        log = "files-%d.log" % ranks_
        with open(log, "w") as output:
            done = programs.start(*(command if ranks_ == 1 else mpi(ranks_, *command)),
                                  output=output)
        try:
            programs.finish(done)
        finally:
            told = open(log).read()
            print(told)
        steps = dict(part.split("\n", 1) for part in told.split("== ")[1:])
        for step, words in (("an older store", ["is older than", "Replace Store"]),
                            ("no place", ["/proc/none/points.pfront", "Store File"]),
                            ("replaced", []), ("another place", []), ("aborted", [])):
            if step in steps and (steps[step].count("ERR|") != (1 if words else 0) or
                                  not all(word in steps[step] for word in words)):
                raise AssertionError("what is said of %s: %s" % (step, steps[step]))
        compare("files-%d" % ranks_, "tool")


def written(programs):
    for ranks_ in (1, 2):
        name = "written-%d" % ranks_
        command = [os.environ["POINTFRONT_PVBATCH"], os.path.join(HERE, "written.py"), name]
        programs.run(*(command if ranks_ == 1 else mpi(ranks_, *command)))
        compare(name, "tool")


def filtered(programs):
    with open("filtered.log", "w") as log:
        programs.finish(programs.start(
            os.environ["POINTFRONT_PVBATCH"], os.path.join(HERE, "filtered.py"), output=log))
    told = open("filtered.log").read()
    print(told)
    if "is a filter's output" not in told:
        raise AssertionError("nobody is told why a filter's output is not drawn")
    compare("filtered", "tool")


def views(programs):
    whole = open(os.environ["POINTFRONT_STORE"], "rb").read()
    damaged = os.path.abspath("damaged.pfront")
    with open(damaged, "wb") as file:
        file.write(whole[:len(whole) // 2])
    with open("views.log", "w") as log:
        done = programs.start(os.environ["POINTFRONT_PVBATCH"], os.path.join(HERE, "views.py"),
                              damaged, output=log)
        try:
            programs.finish(done)
        finally:
            print(open("views.log").read())
    told = open("views.log").read().split("damaged", 1)[1]
    if told.count("ERR|") != 1:
        raise AssertionError("%d errors for one damaged store" % told.count("ERR|"))


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
    """What docs/user/paraview.md says, line by line; alone and on two ranks."""
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
        for old in glob.glob("flight*.png") + wanted:
            if os.path.exists(old):
                os.remove(old)
        programs.run(*command, "hour.py")
        for name in wanted:
            found = glob.glob(name.replace(".", "*."))
            if not found or min(os.path.getsize(path) for path in found) < 5000:
                raise AssertionError("%s on %d ranks: %s" % (name, ranks_, found))
        if len(glob.glob("flight*.png")) != 4:
            raise AssertionError("frames: %s" % glob.glob("flight*.png"))


def looks(programs):
    with open("looks.log", "w") as log:
        done = programs.start(
            os.environ["POINTFRONT_PVBATCH"], os.path.join(HERE, "looks.py"), output=log)
        try:
            programs.finish(done)
        finally:
            print(open("looks.log").read())
    told = open("looks.log").read()
    if told.count("has no attribute") != 1:
        raise AssertionError("an unknown attribute is told of %d times"
                             % told.count("has no attribute"))


def lens(programs):
    for count in (1, 2):
        name = "lens-%d" % count
        programs.run(*mpi(count, os.environ["POINTFRONT_PVBATCH"],
                          os.path.join(HERE, "lens.py"), name))
    for way in ("Circle", "Rectangle", "hidden"):
        compare("lens-2-" + way, "lens-1-" + way, channel=2)


def surveys():
    """Three made-up surveys; the second has other attributes. Pairs of a store and its points."""
    steps = []
    for time, points in enumerate((20000, 50000, 30000)):
        store = os.path.abspath("survey_%d.pfront" % time)
        tool("generate", "--points", str(points), "--seed", str(time + 1), "-o", "survey.las",
             "--force")
        tool("build", "survey.las", "-o", store, "--force",
             *(["--attributes", "rgb"] if time == 1 else []))
        steps.append((store, json.loads(tool("info", store, "--json"))["points"]))
    return steps


def queries(programs):
    """What queries select is what the tool exports for the same conditions."""
    rows = exported("all")
    height, intensity = rows[:, 2], rows[:, 3]
    middle = float(numpy.median(height))
    wanted = {
        "(intensity > 100)": (intensity > 100).sum(),
        "intensity == 100": (intensity == 100).sum(),
        "(intensity >= 50) & (intensity <= 60)": ((intensity >= 50) & (intensity <= 60)).sum(),
        "(intensity < 50) | (elevation > %r)" % middle:
            ((intensity < 50) | (height > middle)).sum(),
        "(elevation == max(elevation))": (height == height.max()).sum(),
        "(intensity > mean(intensity)) & (elevation > %r)" % middle:
            ((intensity > intensity.mean()) & (height > middle)).sum()}
    means = {query: intensity[eval(query, {"intensity": intensity})].mean()
             for query in ("(intensity > 100)",)}
    steps = [(store, int(points), tool("info", "--stats", "--json", store))
             for store, points in surveys()]
    heights = [next(a for a in json.loads(told)["stats"]["attributes"] if a["name"] == "z")
               for _, _, told in steps]
    with open("queries.json", "w") as file:
        json.dump({"wanted": {query: int(count) for query, count in wanted.items()},
                   "means": means, "steps": [store for store, _, _ in steps],
                   "highest": [one["maximum"] for one in heights],
                   "mean": [one["mean"] for one in heights]}, file)
    command = [os.environ["POINTFRONT_PVBATCH"], os.path.join(HERE, "queries.py"), "queries.json"]
    programs.run(*command)
    programs.run(*mpi(2, *command))


def series(programs):
    steps = surveys()
    command = [os.environ["POINTFRONT_PVBATCH"], os.path.join(HERE, "series.py"), json.dumps(steps)]
    programs.run(*command)
    programs.run(*mpi(2, *command))


def exported(name, *conditions):
    """What the tool exports: rows of x, y, z and intensity, in order."""
    path = os.path.abspath(name + ".csv")
    tool("export", os.environ["POINTFRONT_STORE"], "-o", path, "--force", *conditions)
    table = numpy.genfromtxt(path, delimiter=",", names=True)
    print(name, table.dtype.names, len(table))
    rows = numpy.stack([table[column] for column in ("x", "y", "z", "intensity")], axis=1)
    return rows[numpy.lexsort(rows.T[::-1])]


def extract(programs):
    """On 1, 2 and 4 ranks, what the tool exports."""
    store = os.environ["POINTFRONT_STORE"] = os.path.abspath("small-nodes.pfront")
    tool("build", os.environ["POINTFRONT_CLOUD"], "-o", store, "--node-points", "1000", "--force")
    bounds = json.loads(tool("info", store, "--json"))["bounds"]
    low, high = numpy.array(bounds[:3]), numpy.array(bounds[3:])
    # Ends that add up exactly in doubles.
    box = [*numpy.round(low + 0.25 * (high - low)), *numpy.round(low + 0.75 * (high - low))]
    box[2], box[5] = float(numpy.floor(low[2])), float(numpy.ceil(high[2]))
    sphere = [*numpy.round(0.5 * (low + high)), 150.0]
    text = ",".join("%.17g" % end for end in box)
    wanted = {"box": exported("box", "--box", text),
              "sphere": exported("sphere", "--sphere", ",".join("%.17g" % x for x in sphere)),
              "conditions": exported("conditions", "--box", text, "--classes", "0,2", "--where",
                                     "intensity > 60 and return_number == 1")}
    wanted["turned"] = wanted["box"]
    results = {}
    for count in (1, 2, 4):
        name = "extract-%d" % count
        programs.run(*mpi(count, os.environ["POINTFRONT_PVBATCH"],
                          os.path.join(HERE, "extract.py"), name, json.dumps(box),
                          json.dumps(sphere)))
        results[count] = found = numpy.load(name + ".npz")
        for what, rows in wanted.items():
            got = found[what][:, :4]
            got = got[numpy.lexsort(got.T[::-1])]
            if len(rows) < 100 or got.shape != rows.shape or not numpy.allclose(got, rows, 0, 1e-6):
                raise AssertionError("%s on %d ranks: %d points, the tool exports %d, or others"
                                     % (what, count, len(got), len(rows)))
        if not numpy.array_equal(found["frustum"], results[1]["frustum"]):
            raise AssertionError("a frustum on %d ranks has other points" % count)
        print("%d ranks read %s bytes" % (count, found["bytes"]))
        compare("extract-%d" % count, "extract-1")
    if max(results[2]["bytes"]) > 0.6 * results[1]["bytes"][0]:
        raise AssertionError("a rank of two reads as much as one alone")


def selection(programs):
    programs.run(os.environ["POINTFRONT_PVBATCH"], os.path.join(HERE, "selection.py"))


def batch_selection(programs):
    """On a rank that shows what all drew nothing is left of the depths that VTK relies on."""
    programs.run(*mpi(2, os.environ["POINTFRONT_PVBATCH"], os.path.join(HERE, "selection.py")))


def rectangles(programs):
    """Fifty each on trees of several classes, a kd-tree and an octree; on one process and two."""
    os.environ["POINTFRONT_ONLY"] = "rectangles"
    tool("generate", "--points", "120000", "--seed", "7", "-o", "survey.las", "--force")
    stadium = os.environ["POINTFRONT_CLOUD"], os.environ["POINTFRONT_CAMERA"]
    for name, (cloud, camera), options in (
            ("classes", ("survey.las", ""), ["--layers", "class", "--node-points", "2000"]),
            ("kd-tree", stadium, ["--structure", "kdtree", "--node-points", "4000"]),
            ("octree", ("survey.las", ""), ["--layers", "none", "--node-points", "1000"])):
        store = os.environ["POINTFRONT_STORE"] = os.path.abspath(name + ".pfront")
        tool("build", cloud, "-o", store, "--force", *options)
        os.environ["POINTFRONT_POINTS"] = str(json.loads(tool("info", store, "--json"))["points"])
        os.environ["POINTFRONT_CAMERA"] = camera
        command = [os.environ["POINTFRONT_PVBATCH"], os.path.join(HERE, "selection.py")]
        programs.run(*command)
        programs.run(*mpi(2, *command))


def rubber_band(programs):
    """A flat square of points seen from above: what the rubber band covers is known."""
    with open("flat.ply", "w") as ply:
        ply.write("ply\nformat ascii 1.0\nelement vertex 40000\n"
                  "property double x\nproperty double y\nproperty double z\nend_header\n")
        for i in range(40000):
            ply.write("%d %d 0\n" % (i % 200, i // 200))
    store = os.environ["POINTFRONT_STORE"] = os.path.abspath("flat.pfront")
    tool("build", "flat.ply", "-o", store, "--force")
    script = os.path.join(HERE, "rubber_band")
    programs.run(os.environ["POINTFRONT_PARAVIEW"], "--dr", "--script=%s.py" % script,
                 "--test-script=%s.xml" % script, "--exit")
    with open("rubber_band.json") as file:
        found = json.load(file)
    print(found)
    selected = found["selected"]
    if found["failure"] or found["extracted"] != selected:
        raise AssertionError("extracted is not what was selected")
    low_x, high_x, low_y, high_y = selected["bounds"][:4]
    # Around the middle, twice as wide as high at most, and no hole in it.
    if abs(low_x + high_x - 199) > 4 or abs(low_y + high_y - 199) > 4 or high_y - low_y > 100:
        raise AssertionError("selected is not what the rubber band covers")
    grid = (high_x - low_x + 1) * (high_y - low_y + 1)
    if not 1000 < selected["points"] == grid:
        raise AssertionError("%d points selected, the band covers %d" % (selected["points"], grid))


def ranks_selection(programs):
    with_server(programs, "selection.py")


def application(programs):
    try:
        programs.run(os.environ["POINTFRONT_PARAVIEW"], "--dr",
                     "--script=" + os.path.join(HERE, "application.py"))
    finally:
        if os.path.exists("application.json"):
            with open("application.json") as file:
                print(file.read())
    points = int(os.environ["POINTFRONT_POINTS"])
    with open("application.json") as file:
        phases = json.load(file)["phases"]
    drawn = {phase: [count for count, _ in frames] for phase, frames in phases.items()}
    opened = drawn["opened"]
    if opened != sorted(opened) or opened[-1] != points:
        raise AssertionError("refinement at rest loses nothing on its way, not %s" % opened)
    if not drawn["moving"][-1] < points:
        raise AssertionError("frames in motion keep to their time, not %s" % drawn["moving"])
    if drawn["at rest again"][-1] != points:
        raise AssertionError("all points come back at rest, not %s" % drawn["at rest again"])
    compare("application", "tool")


def main(way):
    # Ended from outside: through the exits, so that no program stays behind.
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    os.environ["POINTFRONT_OUTPUT"] = os.getcwd()
    store = os.environ["POINTFRONT_STORE"] = os.path.abspath("cloud.pfront")
    tool("build", os.environ["POINTFRONT_CLOUD"], "-o", store, "--force")
    os.environ["POINTFRONT_POINTS"] = str(json.loads(tool("info", store, "--json"))["points"])
    tool("render", store, "-o", "tool.png", "--size", "640x360",
         "--camera", os.environ["POINTFRONT_CAMERA"], "--color-by", "rgb", "--point-size", "2",
         "--error", "0.01", "--background", "0,0,0")
    ways = {"application": application, "backends": backends, "batch": batch,
            "batch-selection": batch_selection, "classes": classes, "colours": colours,
            "extract": extract, "facts": facts, "files": files, "filtered": filtered,
            "first-hour": first_hour, "lens": lens, "looks": looks, "queries": queries,
            "ranks": ranks, "ranks-selection": ranks_selection, "rectangles": rectangles,
            "rubber-band": rubber_band, "selection": selection, "series": series,
            "server": server, "state": state, "views": views, "written": written}
    with Programs() as programs:
        ways[way](programs)


if __name__ == "__main__":
    main(sys.argv[1])
