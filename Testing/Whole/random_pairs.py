"""Ways to draw the same scene, which must give the same picture: by the tool alone.

A kind of pair has a few clouds, made from a number, and draws a case in several ways. A case is
what JSON can print: a style, a camera, and what the kind chooses besides.
"""

import json
import os
import random
import re
import shutil
import subprocess

import numpy

from pictures import read_png, share_alike
from random_cases import chance
from random_forms import PLY_TYPES, Points, turned, write_csv, write_ept, write_ply
from random_scenes import random_camera, random_sheet
from sheets import styles_of, with_fixed_sizes, with_known_ranges, without_sums
from tool import DATA, TOOL, pointfront

SIZE = (320, 240)
BACKGROUND = (51, 26, 77)  # 0.2,0.1,0.3
EVERYTHING = "0.01"  # pixels between points: all points of a cloud
# The tool may refuse a case for these reasons. Any other end of the tool is a failure.
REFUSALS = ("no point", "has a point of these classes", "style.json")
COPC = (DATA / "copc/1.2-with-color.copc.laz", DATA / "copc/ellipsoid_200k.copc.laz")


class Refused(Exception):
    """The tool says that the case makes no sense."""


class Pair:
    """A kind of pair. `folder` is its own; `clouds` seeds share a cloud."""

    least_alike = 1.0
    tolerance = 0
    clouds = 20
    fixed_sizes = None  # metres; None: sizes are as the style has them
    size = SIZE

    def __init__(self, folder):
        self.root = self.folder = folder
        self.cloud = None
        self.bounds = None
        self.refused = 0  # cases that no way draws

    def close(self):
        """No case is drawn any more."""

    def succeed(self, *arguments):
        outcome = pointfront(*arguments)
        if outcome.status != 0:
            raise AssertionError(f"{arguments}: {outcome}")
        return outcome

    def town(self, number, points=20000):
        """Points of a made-up town."""
        path = self.folder / f"{number}.las"
        # From seed 3 on: that town has ground, buildings and trees.
        self.succeed("generate", "--points", points, "--seed", number + 2, "-o", path)
        return Points.read(path)

    def build(self, name, *arguments):
        self.succeed("build", *arguments, "-o", self.folder / name)
        return self.folder / name

    def make(self, number, rng):
        """The files of a cloud; gives the one whose bounds count."""
        raise NotImplementedError

    def choose(self, rng):
        """Returns all that a case has besides style and camera."""
        return {"error": rng.choice((EVERYTHING, "1", "3"))}

    def take(self, number):
        """That cloud is drawn from now on."""
        if number == self.cloud:
            return
        self.folder = self.root / str(number)
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir()
        first = self.make(number, random.Random(number))
        self.bounds = self.succeed("info", first, "--json").json["bounds"]
        self.cloud = number

    def case(self, seed):
        self.take(1 + (seed - 1) // self.clouds)
        rng = random.Random(seed)
        case = {"cloud": self.cloud, "style": random_sheet(rng, self.size), "view": None}
        case["view"], case["camera"] = random_camera(rng, self.bounds)
        return {**case, **self.choose(rng)}

    def styled(self, sheet):
        """Returns the sheet that is drawn in place of a random one."""
        return with_fixed_sizes(sheet, self.fixed_sizes) if self.fixed_sizes else sheet

    def pictures(self, case):
        """(what, picture) of each way; the first is the one to compare with."""
        raise NotImplementedError

    def drawn(self, stores, case, *arguments, environment=None):
        paths = {name: self.folder / f"{name}.json" for name in ("style", "camera")}
        for name, path in paths.items():
            path.write_text(json.dumps(case[name]))
        picture, facts = self.folder / "picture.png", self.folder / "stats.json"
        stores = stores if isinstance(stores, (list, tuple)) else [stores]
        outcome = pointfront(
            "render", *stores, "-o", picture, "--size", "x".join(map(str, self.size)), "--style",
            paths["style"], "--camera", paths["camera"], "--error", case["error"], "--background",
            "0.2,0.1,0.3", "--stats", facts, *arguments, environment=environment)
        if outcome.status in (1, 2) and any(word in outcome.err for word in REFUSALS):
            raise Refused(outcome.err)
        if outcome.status != 0:
            raise AssertionError(f"{json.dumps(case)}: {outcome}")
        facts = json.loads(facts.read_text())
        if facts["error_px"] > 1.000001 * float(case["error"]) and not facts["limited_by"]:
            raise AssertionError(f"{json.dumps(case)}: {facts}: error_px, and nothing limits it")
        return read_png(picture)

    def difference(self, case):
        """Says what differs; None where all is alike, or all ways refuse the case."""
        self.take(case["cloud"])
        case = {**case, "style": self.styled(case["style"])}
        ways = []
        for what, draw in self.pictures(case):
            try:
                ways.append((what, draw()))
            except Refused as refusal:
                ways.append((what, refusal))
        self.refused += all(isinstance(picture, Refused) for _, picture in ways)
        for other in ways[1:]:
            if found := self.compared(*ways[0], *other, case):
                return found
        return None

    def compared(self, usual, first, what, picture, case):
        """Says how two ways differ, each a name and a picture or Refused."""
        del case  # alike for all
        refusals = [one for one in (first, picture) if isinstance(one, Refused)]
        if refusals:
            return None if len(refusals) == 2 else (
                f"only one of {usual} and {what} is refused: {refusals[0]}")
        alike = share_alike(first, picture, self.tolerance)
        if alike < self.least_alike:
            return f"{usual} and {what}: {alike:.5f} of the pixels are alike"
        return None


class Threads(Pair):
    """1, 2 and 7 threads that draw and load: the same bits."""

    def make(self, number, rng):
        source = self.folder / "town.las"
        self.town(number).write(source)
        self.store = self.build("town.pfront", source, "--normals", "pca", "--node-points", 500,
                                "--layers", rng.choice(("none", "class")))
        return self.store

    def pictures(self, case):
        for count in (2, 1, 7):
            environment = {**os.environ, "POINTFRONT_TEST_THREADS": str(count),
                           "LD_PRELOAD": os.environ["POINTFRONT_THREAD_COUNT"]}
            yield f"{count} threads", lambda: self.drawn(self.store, case, environment=environment)


class Bands(Threads):
    """One picture, and bands of rows as --memory has no room for it: the same bits, except that
    sizes by spacing follow the nodes in sight, of which a band has fewer."""

    size = (640, 480)
    fixed_sizes = 0.3
    clouds = 40

    def choose(self, rng):
        return {**super().choose(rng), "memory": rng.choice(("10M", "12M"))}

    def pictures(self, case):
        yield "one picture", lambda: self.drawn(self.store, case)
        yield "bands", lambda: self.banded(case)

    def banded(self, case):
        """With as little memory as the case says, or else with the least that the style takes."""
        try:
            return self.drawn(self.store, case, "--memory", case["memory"])
        except AssertionError as failure:
            least = re.search(r"takes --memory (\d+) at least", str(failure))
            if not least:
                raise
            return self.drawn(self.store, case, "--memory", least[1])


class NodeByNode(Threads):
    """A picture drawn at once, and frames while nodes load, after frames from elsewhere."""

    def choose(self, rng):
        return {**super().choose(rng), "before": random_camera(rng, self.bounds)[1],
                "moving": chance(rng, 0.5)}

    def frames(self, case):
        style = self.folder / "style.json"
        style.write_text(json.dumps(case["style"]))
        tool = subprocess.Popen(
            [TOOL, "stream", self.store, "--style", style, "--error", case["error"],
             "--background", "0.2,0.1,0.3", "--frame-ms", "5"], stdin=subprocess.PIPE,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE)

        def ask(**request):
            tool.stdin.write(json.dumps(request).encode() + b"\n")
            tool.stdin.flush()
            facts = json.loads(tool.stdout.readline())
            pixels = numpy.frombuffer(tool.stdout.read(facts["bytes"]), numpy.uint8)
            return facts, pixels.reshape(*self.size[::-1], 4)[..., :3] if facts["bytes"] else None

        try:
            ask(size=self.size, camera=case["before"], moving=case["moving"])
            facts, picture = ask(camera=case["camera"])
            points, settled = facts["points"], facts["settled"]
            while not settled:
                facts, newer = ask(wait_ms=200)
                settled = facts["settled"]
                if newer is not None:
                    points, picture = facts["points"], newer
            return picture, points
        except (OSError, ValueError, TypeError):
            tool.stdin.close()
            tool.stdin = None  # communicate() must not flush it
            said = tool.stderr.read().decode()
            if any(word in said for word in REFUSALS):
                raise Refused(said) from None
            raise AssertionError(f"{json.dumps(case)}: stream: {said}") from None
        finally:
            tool.kill()
            tool.communicate()

    def streamed(self, case):
        picture, points = self.frames(case)
        if points == 0 or (picture == BACKGROUND).all():
            raise Refused("no point in sight")
        return picture

    def pictures(self, case):
        yield "render", lambda: self.drawn(self.store, case)
        yield "stream", lambda: self.streamed(case)


class Alike(Pair):
    """Ways whose arithmetic rounds differently."""

    least_alike = 0.995
    tolerance = 2
    fixed_sizes = 0.3

    def choose(self, rng):
        return {"error": EVERYTHING}

    def styled(self, sheet):
        return with_known_ranges(super().styled(sheet), self.bounds)


class Forms(Alike):
    """A store, an index, COPC, an EPT and a folder of tiles with the same points."""

    fixed_sizes = 1.0

    def styled(self, sheet):
        """A LAS file in place has normals, which are computed for light and EWA splats; a store
        that was built without them has none."""
        sheet = without_sums(super().styled(sheet))
        for style in styles_of(sheet):
            if "normal.z" in json.dumps(style.get("color")):
                style["color"] = "rgb"
            if style.get("orientation") == "normal":
                style["orientation"] = "view"
        sheet["default"].setdefault("orientation", "view")
        if "lit" in sheet.get("shading", {}).get("mode", ""):
            sheet["shading"] = {"mode": "edl"}
        return sheet

    def make(self, number, rng):
        copc = COPC[number % 5 == 0]
        twice = copc == COPC[1]
        self.fixed_sizes = 3.0 if twice else 30.0
        source = self.folder / "points.las"
        self.succeed("export", copc, "-o", source)
        points = Points.read(source)
        if twice:
            # The ellipsoid has two points in each place, in colours of their own. Which one is seen
            # depends on their order in the file.
            _, first = numpy.unique(points.records["grid"], axis=0, return_index=True)
            points = points.part(numpy.sort(first))
            points.write(source)
        plain = points.write(self.folder / "plain.las")
        tiles = self.folder / "tiles"
        tiles.mkdir()
        west = points.records["grid"][:, 0] < numpy.median(points.records["grid"][:, 0])
        for name, chosen in (("west", west), ("east", ~west)):
            part = points.part(chosen).write(self.folder / f"{name}.las")
            self.build(f"tiles/{name}.pfront", part)
        index = self.folder / "points.pfindex"
        self.succeed("index", plain, "-o", index, "--node-points", 300)
        self.stores = {
            "octree": self.build("o.pfront", source, "--node-points", 400),
            "kd-tree": self.build("k.pfront", source, "--structure", "kdtree"),
            "classes": self.build("c.pfront", source, "--layers", "class"),
            "index": index, "tiles": tiles,
            "EPT": write_ept(self.folder / "ept", points, len(points.records) // 20)}
        if not twice:
            self.stores["COPC"] = copc
        return self.stores["octree"]

    def pictures(self, case):
        for name, store in self.stores.items():
            yield name, lambda store=store: self.drawn(store, case)


class Columns(Pair):
    """The columns of a text or PLY file in another order: the same bits."""

    def make(self, number, rng):
        columns = self.town(number, 5000).columns()
        self.stores = []
        for write, suffix in ((write_csv, "csv"), (write_ply, "ply")):
            orders = [list(PLY_TYPES), list(PLY_TYPES)]
            rng.shuffle(orders[1])
            for place, order in enumerate(orders):
                file = write(self.folder / f"{place}.{suffix}", columns, order)
                name = f"{place}-{suffix}.pfront"
                self.stores.append(self.build(name, file, "--node-points", 500))
        return self.stores[0]

    def choose(self, rng):
        return {**super().choose(rng), "pair": rng.choice((0, 2))}

    def pictures(self, case):
        for place, name in enumerate(("one order", "another order"), case["pair"]):
            yield name, lambda place=place: self.drawn(self.stores[place], case)


class Moved(Alike):
    """A scene and its copy elsewhere: moved, and turned by quarters about the z axis."""

    STEPS = (3000000, -70000000, 0)  # in millimetres; heights keep their colours

    def make(self, number, rng):
        town = self.town(number)
        ways = {"here": (town, 0), "elsewhere": (town.moved(self.STEPS), 0)}
        ways.update({f"turned {n} times": (town.turned(n), n) for n in (1, 2, 3)})
        self.ways = {}
        for name, (points, quarters) in ways.items():
            file = points.write(self.folder / f"{quarters}-{len(self.ways)}.las")
            store = self.build(f"{file.stem}.pfront", file, "--normals", "pca", "--node-points",
                               rng.choice((500, 5000)))
            self.ways[name] = (store, quarters)
        self.offset = numpy.array(town.offset)
        self.by = numpy.array(town.moved(self.STEPS).offset) - self.offset
        return self.ways["here"][0]

    def choose(self, rng):
        return {**super().choose(rng), "quarters": rng.choice((1, 2, 3))}

    def turned_case(self, case, quarters):
        def place(at):
            return (self.offset + turned(numpy.array(at) - self.offset, quarters)).tolist()

        case = json.loads(json.dumps(case))
        camera = case["camera"]
        camera.update(position=place(camera["position"]), focal_point=place(camera["focal_point"]),
                      view_up=turned(camera["view_up"], quarters).tolist())
        for style in styles_of(case["style"]):
            if isinstance(style.get("orientation"), list):
                style["orientation"] = turned(style["orientation"], quarters).tolist()
        return case

    def pictures(self, case):
        for name in ("here", "elsewhere", f"turned {case['quarters']} times"):
            store, quarters = self.ways[name]
            one = self.turned_case(case, quarters)
            if name == "elsewhere":
                for key in ("position", "focal_point"):
                    one["camera"][key] = (numpy.array(one["camera"][key]) + self.by).tolist()
            yield name, lambda store=store, one=one: self.drawn(store, one)


class SeveralClouds(Alike):
    """One cloud, and the same points in three clouds, in either order."""

    def make(self, number, rng):
        columns = self.town(number).columns()
        self.stores = []
        for name, chosen in (("whole", slice(None)), *((f"part{n}", slice(n, None, 3))
                                                       for n in range(3))):
            file = write_ply(self.folder / f"{name}.ply", {
                key: column[chosen] for key, column in columns.items()}, list(PLY_TYPES))
            self.stores.append(self.build(f"{name}.pfront", file, "--structure",
                                          rng.choice(("octree", "kdtree"))))
        return self.stores[0]

    def styled(self, sheet):
        return without_sums(super().styled(sheet))

    def pictures(self, case):
        yield "one cloud", lambda: self.drawn(self.stores[0], case)
        yield "three clouds", lambda: self.drawn(self.stores[1:], case)
        yield "in another order", lambda: self.drawn(self.stores[:0:-1], case)


KINDS = (Threads, Bands, NodeByNode, Forms, Columns, Moved, SeveralClouds)
