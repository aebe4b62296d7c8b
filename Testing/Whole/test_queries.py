"""`export` of regions, classes and conditions: the points that a filter of the whole gives."""

import json
import math
import unittest

from tool import DATA, ToolTest, write_las

TRIMMED = DATA / "las/real/autzen_trim.las"
AREA = [(636500.001, 849000.0), (636700.0, 849050.0), (636650.0, 849250.001), (636520.0, 849180.0)]
HOLE = [(636580.0, 849080.001), (636620.0, 849080.0), (636620.0, 849140.0), (636580.001, 849140.0)]


def inside(ring, x, y):
    """Even-odd; no point of the cloud lies on an edge of these rings."""
    result = False
    for (ax, ay), (bx, by) in zip(ring, ring[1:] + ring[:1]):
        if (ay > y) != (by > y) and x < ax + (y - ay) / (by - ay) * (bx - ax):
            result = not result
    return result


def geojson(rings, **members):
    return json.dumps({"type": "Polygon", **members,
                       "coordinates": [[list(v) for v in ring + ring[:1]] for ring in rings]})


def wkt(rings):
    return "POLYGON (" + ", ".join(
        "(" + ", ".join(f"{x} {y}" for x, y in ring + ring[:1]) + ")" for ring in rings) + ")"


class Queries(ToolTest):
    def rows(self, store, *options, name="x.csv"):
        """Rows of a CSV export as tuples of numbers, sorted; and what was said on stderr."""
        out = self.folder / name
        said = self.succeed("export", store, "-o", out, "--force", *options)
        with open(out, encoding="ascii") as file:
            self.names = file.readline().strip().split(",")
            rows = sorted(tuple(map(float, line.split(","))) for line in file)
        self.assertIn(f"{len(rows)} points", said.out)
        return rows, said.err

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def test_regions_and_conditions_are_filters_of_the_whole(self):
        for command, *options in (("build",), ("build", "--structure", "kdtree"), ("index",)):
            store = self.folder / f"{command}{len(options)}.pfront"
            self.succeed(command, TRIMMED, "-o", store, *options)
            everything, _ = self.rows(store)
            self.assertEqual(len(everything), 110000)
            column = {name: i for i, name in enumerate(self.names)}
            area = self.write("area.geojson", geojson([AREA, HOLE]))
            text = self.write("area.wkt", wkt([AREA, HOLE]))
            line = self.write("line.wkt", "LINESTRING (636500 849000, 636700 849200)")
            centre = (636600.0, 849100.0, 430.0)

            def near_line(p):
                along = min(1.0, max(0.0, (p[0] - 636500 + p[1] - 849000) / 400))
                return math.hypot(p[0] - 636500 - 200 * along, p[1] - 849000 - 200 * along) <= 15

            cases = (
                (["--polygon", area],
                 lambda p: inside(AREA, *p[:2]) and not inside(HOLE, *p[:2])),
                (["--polygon", text],
                 lambda p: inside(AREA, *p[:2]) and not inside(HOLE, *p[:2])),
                (["--sphere", "636600,849100,430,60"], lambda p: math.dist(p[:3], centre) <= 60),
                (["--corridor", line, "--within", "15"], near_line),
                (["--where", "intensity in [100, 200] and z > 420"],
                 lambda p: 100 <= p[column["intensity"]] <= 200 and p[2] > 420),
                (["--box", "636500,849000,0,636700,849200,1000", "--classes", "2",
                  "--where", "return_number == 1", "--polygon", text],
                 lambda p: 636500 <= p[0] <= 636700 and 849000 <= p[1] <= 849200 and
                 p[column["classification"]] == 2 and p[column["return_number"]] == 1 and
                 inside(AREA, *p[:2]) and not inside(HOLE, *p[:2])),
            )
            for chosen, passes in cases:
                expected = [p for p in everything if passes(p)]
                got, _ = self.rows(store, *chosen)
                self.assertGreater(len(expected), 5, chosen)
                self.assertEqual(got, expected, (command, options, chosen))

    def test_what_is_derived_of_class_and_normal(self):
        for layers in ("class", "none"):
            store = self.folder / f"{layers}.pfront"
            self.succeed("build", TRIMMED, "-o", store, "--layers", layers, "--normals", "pca")
            everything, _ = self.rows(store)
            column = {name: i for i, name in enumerate(self.names)}
            code = column["classification"] if layers == "class" else None
            ends = {}
            for p in everything:
                own = ends.setdefault(code and p[code], [p[2], p[2]])
                own[:] = [min(own[0], p[2]), max(own[1], p[2])]
            self.assertEqual(len(ends) > 1, layers == "class")

            def height(p):
                low, high = ends[code and p[code]]
                return (p[2] - low) / (high - low)

            def level(p):
                return abs(p[column["nz"]])  # four decimals: limits lie between two of them

            for text, passes in (
                    ("global-height > 0.50001", lambda p: height(p) > 0.50001),
                    ("horizontality < 0.30005 and global_height in [0.10001, 0.80001]",
                     lambda p: level(p) < 0.30005 and 0.10001 <= height(p) <= 0.80001),
                    ("horizontality not in [0.10005, 0.99005)",
                     lambda p: not 0.10005 <= level(p) < 0.99005)):
                expected = [p for p in everything if passes(p)]
                got, _ = self.rows(store, "--where", text)
                self.assertGreater(len(expected), 100, text)
                self.assertLess(len(expected), 109000, text)
                self.assertEqual(got, expected, (layers, text))
        bare = self.build(TRIMMED, name="bare.pfront")
        said = self.refuse(1, "export", bare, "-o", self.folder / "y.csv", "--where",
                           "horizontality > 0.5").err
        self.assertIn("no attribute 'normal', which horizontality needs", said)

    def test_the_files_system_is_heeded(self):
        corner = (500000.0, 5600000.0)
        las = write_las(self.folder / "a.las", [(corner[0] + x, corner[1] + y, 100.0, 0, 0, 0)
                                                for x in range(20) for y in range(20)])
        store = self.folder / "a.pfront"
        self.succeed("build", las, "-o", store, "--assume-crs", "EPSG:25832")
        ring = [(corner[0] + x, corner[1] + y) for x, y in
                ((4.5, 4.5), (9.5, 4.5), (9.5, 9.5), (4.5, 9.5))]
        own, said = self.rows(store, "--polygon", self.write("own.geojson", geojson([ring])))
        self.assertEqual(len(own), 25)
        self.assertEqual(said, "")
        degrees = las_to_degrees(self, ring)
        named = {"type": "name", "properties": {"name": "urn:ogc:def:crs:OGC:1.3:CRS84"}}
        for text, note in ((geojson([degrees]), "longitudes"), (geojson([degrees], crs=named), ""),
                           ("SRID=4326;" + wkt([degrees]), "")):
            got, said = self.rows(store, "--polygon", self.write("x.txt", text))
            self.assertEqual(got, own)
            self.assertEqual(note in said and bool(said), bool(note), said)
        bare = self.build(las, name="bare.pfront")  # knows no system: numbers are numbers
        got, said = self.rows(bare, "--polygon", self.write("x.txt", geojson([degrees])))
        self.assertEqual(got, [])
        self.assertIn("outside of the store", said)

    def test_areas_meet_the_antimeridian(self):
        # Points every 0.1 degrees on both sides, with longitudes that go on and with those that do
        # not; the area, from 179.45 to -179.55, holds 10 x 10 of them.
        part = {"east": (179.45, 180.0), "west": (-180.0, -179.55)}
        parts = [[(low, -17.05), (high, -17.05), (high, -16.05), (low, -16.05)]
                 for low, high in part.values()]
        one = [(179.45, -17.05), (180.45, -17.05), (180.45, -16.05), (179.45, -16.05)]
        wound = [(x - 360.0 * (x > 180.0), y) for x, y in one]
        split = json.dumps({"type": "MultiPolygon", "coordinates": [
            [[list(v) for v in ring + ring[:1]]] for ring in parts]})
        places = [(1785 + i, -18.0 + 0.1 * j) for i in range(30) for j in range(30)]
        stores = []
        for name, longitude in (
                ("on", lambda x: x / 10.0), ("back", lambda x: (x - 3600 * (x > 1800)) / 10.0),
                ("before", lambda x: (x - 3600) / 10.0)):
            las = write_las(self.folder / f"{name}.las",
                            [(longitude(x), y, 0.0, 0, 0, 0) for x, y in places], 1e-6)
            stores.append(self.folder / f"{name}.pfront")
            self.succeed("build", las, "-o", stores[-1], "--assume-crs", "EPSG:4326")
        for crs in ("EPSG:32760", "EPSG:4167"):  # UTM 60 S; degrees of New Zealand
            stores.append(self.folder / f"{crs[5:]}.pfront")
            self.succeed("build", self.folder / "on.las", "-o", stores[-1], "--assume-crs",
                         "EPSG:4326", "--crs", crs)
        line = "SRID=4326;LINESTRING (179.45 -16.5, 180.45 -16.5)"
        for store in stores:
            for text in (split, "SRID=4326;" + wkt([one])):
                got, said = self.rows(store, "--polygon", self.write("x.txt", text))
                self.assertEqual(len(got), 100, (store, text, said))
            said = self.refuse(1, "export", store, "-o", self.folder / "z.csv", "--polygon",
                               self.write("x.txt", geojson([wound]))).err
            self.assertIn("from longitude 179.45 to -179.55", said)
            self.assertIn("cut it there into two parts", said)
        for store in stores[:3]:
            got, _ = self.rows(store, "--corridor", self.write("x.txt", line), "--within", "0.02")
            self.assertEqual(len(got), 10, store)
            # Numbers that say no system are the store's own: degrees, too.
            self.refuse(1, "export", store, "-o", self.folder / "z.csv", "--polygon",
                        self.write("x.txt", wkt([wound])))
        globe = [(-180.0, -90.0), (180.0, -90.0), (180.0, 90.0), (-180.0, 90.0)]
        for store in stores[:3]:
            got, _ = self.rows(store, "--polygon", self.write("x.txt", geojson([globe])))
            self.assertEqual(len(got), 900, store)

    def test_wrong_ones_are_refused(self):
        store = self.build(DATA / "las/real/1.2-with-color.las")
        out = ("-o", self.folder / "x.las")
        line = self.write("line.wkt", "LINESTRING (0 0, 1 1)")
        broken = self.write("broken.geojson", '{"type": "Polygon"')
        for status, word, options in (
                (1, "missing.wkt", ["--polygon", self.folder / "missing.wkt"]),
                (1, "not JSON", ["--polygon", broken]), (1, "no area", ["--polygon", line]),
                (2, "--within", ["--corridor", line]), (2, "--corridor", ["--within", "3"]),
                (2, "--within", ["--corridor", line, "--within", "-3"]),
                (2, "--sphere", ["--sphere", "1,2,3"]), (2, "--sphere", ["--sphere", "1,2,3,-1"]),
                (2, "--sphere", ["--sphere", "1,2,3,nan"]),
                (2, "--where", ["--where", "intensity >"]),
                (1, "nonsense", ["--where", "nonsense > 3"])):
            self.assertIn(word, self.refuse(status, "export", store, *out, *options).err)
        self.assertNotIn("x.las", self.entries())
        # Nothing is written over a file that is read, by whatever name.
        area = self.write("area.csv", wkt([[(0, 0), (1, 0), (1, 1)]]))
        self.refuse(1, "export", store, "-o", area, "--polygon", area, "--force")
        self.assertTrue(area.read_text().startswith("POLYGON"))


def las_to_degrees(test, ring):
    """The ring's vertices in WGS 84, by the tool's own transformation of points."""
    las = write_las(test.folder / "ring.las", [(x, y, 0.0, i, 0, 0)
                                               for i, (x, y) in enumerate(ring)], 0.001)
    test.succeed("build", las, "-o", test.folder / "ring.pfront", "--assume-crs", "EPSG:25832",
                 "--precision", "0.001")
    out = test.folder / "ring.csv"
    test.succeed("export", test.folder / "ring.pfront", "-o", out, "--crs", "EPSG:4326")
    with open(out, encoding="ascii") as file:
        names = file.readline().strip().split(",")
        red = names.index("red") if "red" in names else names.index("r")
        rows = sorted((list(map(float, row.split(","))) for row in file), key=lambda r: r[red])
    return [(row[0], row[1]) for row in rows]


if __name__ == "__main__":
    unittest.main(verbosity=2)
