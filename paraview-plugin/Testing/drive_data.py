"""Ways to run ParaView that look at points. Each function is a test: see drive.py."""

import json
import os
import random

import numpy
from expected import classified, compare, exported, surveys
from pictures import differing, load
from programs import HERE, mpi, python_client, tool, with_server


def facts(programs):
    """Ranges and facts, against what reading all points of the store says."""
    with open("statistics.json", "w") as file:
        file.write(tool("info", "--stats", "--json", os.environ["POINTFRONT_STORE"]))
    command = [os.environ["POINTFRONT_PVBATCH"], os.path.join(HERE, "facts.py"), "statistics.json"]
    programs.run(*command, "alone")
    programs.run(*mpi(2, *command))


def queries(programs):
    """Queries select what the tool exports for the same conditions."""
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


def refusals(programs):
    """Selections that cannot be had are told, on one process and on two."""
    with open("id.ply", "w") as ply:
        ply.write("ply\nformat ascii 1.0\nelement vertex 40000\n"
                  "property double x\nproperty double y\nproperty double z\n"
                  "property int id\nend_header\n")
        for i in range(40000):
            ply.write("%d %d %g %d\n" % (i % 200, i // 200, 0.001 * i, i % 10))
    store, damaged = os.path.abspath("id.pfront"), os.path.abspath("damaged.pfront")
    tool("build", "id.ply", "-o", store, "--node-points", "1000", "--force")
    with open(store, "rb") as file:
        content = bytearray(file.read())
    middle = len(content) // 2
    content[middle:middle + 64] = bytes(64)  # in the points of one node or two
    with open(damaged, "wb") as file:
        file.write(content)
    for count in (1, 2):
        told = programs.told("refusals-%d.log" % count, *mpi(
            count, os.environ["POINTFRONT_PVBATCH"], os.path.join(HERE, "refusals.py"), store,
            damaged))
        steps = dict(part.split("\n", 1) for part in told.split("== ")[1:])
        for step, words in (("id", None), ("malformed", "cannot be evaluated"),
                            ("no name", "cannot be evaluated"), ("sound", None),
                            ("beside", "lies beside the cloud"),
                            ("turned", "lies beside the cloud"),
                            ("class", "a class 300 is none of 0 to 255"),
                            ("radius", "its radius is 0 or more"), ("where", "character"),
                            ("too many", "PointFront Extract"), ("enough", None),
                            ("unnamed", "Most Selection Points"),
                            ("damaged", "cannot be read")):
            errors = steps[step].count(
                "WARN|" if step in ("beside", "turned") else "ERR|")
            most = count if words else 0  # each rank speaks for itself
            if not bool(words) <= errors <= most or (words or "") not in steps[step]:
                raise AssertionError("what is said of %s: %s" % (step, steps[step]))


def series(programs):
    steps = surveys()
    for script, told in (("series.py", steps), ("class_steps.py", classified())):
        command = [os.environ["POINTFRONT_PVBATCH"], os.path.join(HERE, script), json.dumps(told)]
        programs.run(*command)
        programs.run(*mpi(2, *command))


def epochs(programs):
    """Each step of the time slider shows what the tool draws of the epoch."""
    bounds = json.loads(tool("info", os.environ["POINTFRONT_STORE"], "--json"))["bounds"]
    middle = 0.5 * (bounds[0] + bounds[3])
    city = os.path.abspath("city.pfcollection")
    steps = []
    for time, epoch, west, east in ((2019, "2019", bounds[0] - 1, middle),
                                    (2024.5, "2024-07", middle - 300, bounds[3] + 1)):
        tool("export", os.environ["POINTFRONT_STORE"], "-o", epoch + ".las", "--force", "--box",
             "%r,%r,%r,%r,%r,%r" % (west, bounds[1] - 1, bounds[2] - 1, east, bounds[4] + 1,
                                    bounds[5] + 1))
        tool("build", epoch + ".las", "-o", epoch + ".pfront", "--force")
        if steps:
            tool("collection", "add", city, epoch + ".pfront", "--epoch", epoch)
        else:
            tool("collection", "create", city, epoch + ".pfront", "--epoch", epoch, "--force")
        steps.append((time, json.loads(tool("info", city, "--epoch", epoch, "--json"))["points"]))
        tool("render", city, "--epoch", epoch, "-o", "epoch-%d.png" % (len(steps) - 1), "--size",
             "640x360", "--camera", os.environ["POINTFRONT_CAMERA"], "--color-by", "rgb",
             "--point-size", "2", "--error", "0.01", "--background", "0,0,0")
    os.environ["POINTFRONT_STORE"] = city
    for ranks in (1, 2):
        name = "slider-%d" % ranks
        programs.run(*mpi(ranks, os.environ["POINTFRONT_PVBATCH"], os.path.join(HERE, "epochs.py"),
                          json.dumps(steps), name))
        for number in range(len(steps)):
            compare("%s-%d" % (name, number), "epoch-%d" % number)
    if not differing(load("epoch-0.png"), load("epoch-1.png"), 8) > 0.1:
        raise AssertionError("the epochs look alike")


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
    for way in ("turned", "negative", "turned-negative"):
        wanted[way] = wanted["box"]
    tool("generate", "--points", "60000", "--seed", "7", "-o", "survey.las", "--force")
    buildings = {}
    for layers in ("class", "none"):
        survey = os.path.abspath("survey-%s.pfront" % layers)
        tool("build", "survey.las", "-o", survey, "--layers", layers, "--force")
        told = tool("export", survey, "-o", "buildings.csv", "--classes", "6", "--force")
        buildings[survey] = int(told.split(": ")[1].split()[0])
    results = {}
    for count in (1, 2, 4):
        name = "extract-%d" % count
        programs.run(*mpi(count, os.environ["POINTFRONT_PVBATCH"],
                          os.path.join(HERE, "extract.py"), name, json.dumps(box),
                          json.dumps(sphere), json.dumps(buildings)))
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


def ranks_selection(programs):
    with_server(programs, python_client("selection.py"))


def rectangles(programs):
    """Fifty each on trees of several classes, a kd-tree and an octree; twenty on two processes."""
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


def through(programs):
    """A millimetre, where the coordinates are those of a map."""
    rng = random.Random(1)
    with open("fine.ply", "w") as ply:
        ply.write("ply\nformat ascii 1.0\nelement vertex 160000\n"
                  "property double x\nproperty double y\nproperty double z\nend_header\n")
        for place in rng.sample(range(7000 * 4000), 160000):
            ply.write("%.3f %.3f 100\n" % (600000 + 0.001 * (place % 7000),
                                           5600000 + 0.001 * (place // 7000)))
    store = os.environ["POINTFRONT_STORE"] = os.path.abspath("fine.pfront")
    tool("build", "fine.ply", "-o", store, "--force", "--node-points", "1000")
    os.environ["POINTFRONT_POINTS"], os.environ["POINTFRONT_CAMERA"] = "160000", ""
    programs.run(os.environ["POINTFRONT_PVBATCH"], os.path.join(HERE, "through.py"))


def rubber_band(programs):
    """A flat square of points seen from above: what the rubber band covers is known."""
    with open("flat.ply", "w") as ply:
        ply.write("ply\nformat ascii 1.0\nelement vertex 40000\n"
                  "property double x\nproperty double y\nproperty double z\nend_header\n")
        for i in range(40000):
            ply.write("%d %d 0\n" % (i % 200, i // 200))
    store = os.environ["POINTFRONT_STORE"] = os.path.abspath("flat.pfront")
    tool("build", "flat.ply", "-o", store, "--force")
    found = programs.by_mouse("rubber_band")
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
