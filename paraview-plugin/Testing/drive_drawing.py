"""Ways to run ParaView that look at pictures. Each function is a test: see drive.py."""

import glob
import json
import os

import pictures
from expected import STOCK_SHARE, compare
from programs import HERE, mpi, python_client, tool, with_server


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
    # Another has the classes 1 to 67.
    with open("wide.csv", "w") as text:
        text.write("x,y,z,classification\n")
        text.writelines("%d,%d,0,%d\n" % (i % 67, i // 67, 1 + i % 67) for i in range(6700))
    wide = os.environ["POINTFRONT_WIDE"] = os.path.abspath("wide.pfront")
    tool("build", "wide.csv", "-o", wide, "--layers", "class", "--force")
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


def sparse_class():
    """A store with a class that each 40th point has, among the others."""
    tool("export", os.environ["POINTFRONT_STORE"], "-o", "sparse.csv", "--force")
    with open("sparse.csv") as rows, open("sparse-9.csv", "w") as marked:
        names = next(rows).strip().split(",")
        number = names.index("classification")
        marked.write(",".join(names) + "\n")
        for i, row in enumerate(rows):
            values = row.strip().split(",")
            values[number] = "9" if i % 40 == 0 else "2"
            marked.write(",".join(values) + "\n")
    store = os.path.abspath("sparse.pfront")
    tool("build", "sparse-9.csv", "-o", store, "--node-points", "1000", "--force")
    return store


def backends(programs):
    """Each technique gives the same pictures on 1, 2, 4 ranks, but for 0.1 % and 2 levels of 255.

    Found: 0 of what ranks add up together.
    """
    store = os.environ["POINTFRONT_STORE"] = os.path.abspath("small-nodes.pfront")
    tool("build", os.environ["POINTFRONT_CLOUD"], "-o", store, "--node-points", "1000", "--force")
    sparse = os.environ["POINTFRONT_SPARSE"] = sparse_class()
    os.environ["POINTFRONT_SPARSE_BOUNDS"] = json.dumps(
        json.loads(tool("info", sparse, "--json"))["bounds"])
    for old in glob.glob("backends-*.png"):
        os.remove(old)
    for count in (1, 2, 4):
        told = programs.told("backends-%d.log" % count, *mpi(
            count, os.environ["POINTFRONT_PVBATCH"], os.path.join(HERE, "backends.py"),
            "backends-%d" % count))
        if told.count("opacities of the color map") != (1 if count > 1 else 0):
            raise AssertionError("what is told of a color map's opacities on %d ranks" % count)
        for picture in sorted(glob.glob("backends-1-*.png")):
            way = picture[len("backends-1-"):-len(".png")]
            if way.endswith("away"):
                continue  # it is enough that no rank waits for the others
            if way in ("translucent", "map-translucent"):
                continue  # one process blends all points of a pixel
            ours, alone = "backends-%d-%s" % (count, way), "backends-1-" + way
            if way.startswith("small-"):
                compare(ours, alone, share=0.00002, channel=2, least=0.001)  # four pixels
                continue
            if way.startswith("beyond-"):
                # The first that is drawn of points at the same height is seen.
                compare(ours, alone, share=0.01, channel=2)
                seen = [pictures.load(one + ".png").max(axis=2) > 0 for one in (ours, alone)]
                if (seen[0] != seen[1]).any():
                    raise AssertionError("%s: %d pixels are cut off, %d added" % (
                        ours, (seen[1] & ~seen[0]).sum(), (seen[0] & ~seen[1]).sum()))
                continue
            compare(ours, alone, channel=2)
            if way.endswith("-moving") and count > 1:
                compare(ours, ours.replace("-moving", "-rest"), share=0, channel=0)
        if count > 1:
            # A color map's opacities are left out, and somebody says so.
            compare("backends-%d-map-translucent" % count, "backends-%d-mapped" % count, channel=2)
            # Half of the opaque picture's colour, over black.
            opaque = pictures.load("backends-%d-opaque.png" % count)
            translucent = pictures.load("backends-%d-translucent.png" % count)
            share = pictures.differing(translucent, opaque // 2, 2)
            print("translucent on %d ranks: %.3f %% not half as bright" % (count, 100 * share))
            if pictures.covered(opaque) < 0.1 or share > 0.001:
                raise AssertionError("translucent points on %d ranks" % count)


def server(programs):
    make_large()
    with_server(programs, python_client("client.py", "server", "2"))
    compare("server", "tool")


def colours(programs):
    with open("black.ply", "w") as ply:
        ply.write("ply\nformat ascii 1.0\nelement vertex 40000\n"
                  "property double x\nproperty double y\nproperty double z\n"
                  "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                  "property ushort intensity\nproperty float amplitude\nend_header\n")
        for i in range(40000):
            x, y = i % 200, i // 200
            amplitude = ("inf", "-inf", "nan")[i] if i < 3 else str(x + y)
            ply.write("%d %d %g 0 0 0 %d %s\n" % (x, y, 0.002 * x * y, x + y, amplitude))
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
    tool("export", os.environ["POINTFRONT_STORE"], "-o", "none.las", "--force",
         "--where", "z > 1e9")
    empty = os.path.abspath("empty.pfront")
    tool("build", "none.las", "-o", empty, "--force")
    command = [os.environ["POINTFRONT_PVBATCH"], os.path.join(HERE, "unseen.py"), empty]
    programs.run(*command)
    programs.run(*mpi(2, *command))


def looks(programs):
    with open("looks.log", "w") as log:
        done = programs.start(
            os.environ["POINTFRONT_PVBATCH"], os.path.join(HERE, "looks.py"), output=log)
        try:
            programs.finish(done)
        finally:
            print(open("looks.log").read())
    told = open("looks.log").read()
    for words in ("has no attribute", "the style sheet cannot be read", "not JSON"):
        if told.count(words) != 1:
            raise AssertionError("\"%s\" is told %d times" % (words, told.count(words)))


def lens(programs):
    for count in (1, 2):
        name = "lens-%d" % count
        log = name + ".log"
        with open(log, "w") as output:
            done = programs.start(*mpi(count, os.environ["POINTFRONT_PVBATCH"],
                                       os.path.join(HERE, "lens.py"), name), output=output)
        try:
            programs.finish(done)
        finally:
            told = open(log).read()
            print(told)
        if "where ranks meet it has gaps" in told:
            raise AssertionError("a lens around a class has gaps on %d ranks" % count)
    for way in ("Circle", "Rectangle", "Mask", "hidden", "around"):
        compare("lens-2-" + way, "lens-1-" + way, channel=2)


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


def applied(programs):
    """A filter that ParaView puts in the place of a surface takes that of a cloud."""
    found = programs.by_mouse("applied")
    if found["failure"] or "Clip" not in found["filters"]:
        raise AssertionError("no filter is applied")
    if not found["shown"][0] or found["shown"][-1]:
        raise AssertionError("the cloud is in view behind the filter")


def deleted(programs):
    """A deleted cloud's file is closed."""
    found = programs.by_mouse("deleted")
    if found["failure"] or not found["open"][0] or found["sources"][-1]:
        raise AssertionError("the cloud is not opened and deleted")
    if found["open"][-1]:
        raise AssertionError("the file of a cloud that is deleted stays open")


def panel(programs):
    try:
        programs.run(os.environ["POINTFRONT_PARAVIEW"], "--dr",
                     "--script=" + os.path.join(HERE, "panel.py"))
    finally:
        if os.path.exists("panel.json"):
            print(open("panel.json").read())
    with open("panel.json") as file:
        found = json.load(file)
    # Ten ticks of the script's own are in the seconds, and what Python does in them.
    if found["frames"] != 0 or not 0.0 <= found["seconds"] < 0.1:
        raise AssertionError("at rest, in two seconds: %d frames, %.3f s of processors"
                             % (found["frames"], found["seconds"]))
    if found["unseen"] != [1, "nothing"]:
        raise AssertionError("a cloud out of view is complete, limited by: %s" % found["unseen"])
    _, technique, error, told = found["quality"]
    if not told.startswith("quality 0.9: ") or " at %g px" % error not in told:
        raise AssertionError("a typed quality is %s at %g: %s" % (technique, error, told))


def panel_width(programs):
    """A cloud's panel needs no more width than a sphere's, and no property of ours more than there
    is at first; tables say what their columns are.
    """
    try:
        programs.run(os.environ["POINTFRONT_PARAVIEW"], "--dr",
                     "--script=" + os.path.join(HERE, "panel_width.py"))
    finally:
        if os.path.exists("panel_width.json"):
            print(open("panel_width.json").read())
    with open("panel_width.json") as file:
        told = json.load(file)
    sphere, found = told["sphere"], told["cloud"]
    heads = {name: table["heads"] for name, table in found["tables"].items()}
    style = ["Class", "Technique", "Color", "px"]
    if heads != {"ClassStyles": style, "ClassLights": ["Class", "Light", "Eye-Dome"],
                 "LensStyles": style}:
        raise AssertionError("heads of the tables: %s" % heads)
    if [found["tables"][name]["rows"] for name in sorted(heads)] != [1, 3, 1]:
        raise AssertionError("rows that are there, and one to write in: %s" % found["tables"])
    if not all(table["whole"] for table in found["tables"].values()):
        raise AssertionError("a head is cut off: %s" % found["tables"])
    if told["written"] != ["6", "splats", "#ff0000", "3", "5", "hidden", "", ""]:
        raise AssertionError("what is written into a table: %s" % told["written"])
    # ParaView 5.11's own panel scrolls sideways here: the heads "Display (...)" are too wide.
    wide = [one for one in found["wide"] if one["property"] not in ("", "ColorEditor")]
    if wide or found["content"] > sphere["content"]:
        raise AssertionError("too wide: %s" % wide)
