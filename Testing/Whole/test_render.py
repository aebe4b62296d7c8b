"""Pictures of render show what is in the store: clouds whose picture is known, pictures compared
with each other, and what the tool says of them. For each back end: see scenes.py."""

import csv
import json
import shutil
import time
import unittest

import numpy

from pictures import share_alike
from scenes import BACKEND, SIZE, TRIM, SceneTest, SharedSceneTest
from tool import DATA, write_las

RED, GREEN, BLUE, WHITE = (255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 255)
SOFTWARE = BACKEND == "software"


def quadrants():
    """A plane at z = 0, 100 x 100, one point every 0.25: south-west red, south-east green,
    north-west blue, north-east white."""
    points = []
    for j in range(400):
        for i in range(400):
            colour = ((RED, GREEN), (BLUE, WHITE))[j // 200][i // 200]
            points.append((i * 0.25, j * 0.25, 0.0, *(257 * c for c in colour)))
    return points


class KnownPictures(SharedSceneTest):
    @classmethod
    def make_store(cls, folder):
        return [write_las(folder / "plane.las", quadrants())]

    def colour_at(self, picture, x, y):
        """At a share of width from the left and of height from the top."""
        return tuple(picture[int(y * SIZE[1]), int(x * SIZE[0])].tolist())

    def test_top_view_has_north_up_and_east_right(self):
        picture = self.picture(self.store, "--view", "top", "--background", "0,0,0")
        self.assertEqual(self.colour_at(picture, 0.4, 0.7), RED)
        self.assertEqual(self.colour_at(picture, 0.6, 0.7), GREEN)
        self.assertEqual(self.colour_at(picture, 0.4, 0.3), BLUE)
        self.assertEqual(self.colour_at(picture, 0.6, 0.3), WHITE)
        self.assertEqual(self.colour_at(picture, 0.01, 0.5), (0, 0, 0))

    def test_no_hole_in_a_plane(self):
        picture = self.picture(self.store, "--view", "top", "--background", "0,0,0")
        inside = picture[40:440, 150:490].max(axis=2)
        self.assertEqual(int((inside == 0).sum()), 0)

    def test_a_few_pixels_are_a_picture(self):
        for size in ((1, 1), (1, 2), (5, 1)):
            for error in ("1", "100"):
                options = ("--view", "top", "--background", "0,0,0", "--error", error)
                picture = self.picture(self.store, *options, size=size)
                self.assertGreater(int(picture.max()), 0, f"{size}, error {error}")

    def test_views_from_the_sides_see_an_edge(self):
        for view in ("front", "back", "left", "right"):
            picture = self.picture(self.store, "--view", view, "--background", "0,0,0")
            rows = picture.max(axis=2).max(axis=1).nonzero()[0]
            self.assertGreater(len(rows), 0, view)
            self.assertLess(rows.max() - rows.min(), 30, view)
        front = self.picture(self.store, "--view", "front", "--background", "0,0,0")
        row = front[:, 200].max(axis=1).argmax()
        self.assertEqual(tuple(front[row, 200].tolist()), RED) # west is left, south is near

    def test_camera_file_in_world_coordinates(self):
        camera = {"position": [25, 25, 50], "focal_point": [25, 25, 0], "view_up": [0, 1, 0],
                  "parallel_scale": 10}
        path = self.folder / "camera.json"
        path.write_text(json.dumps(camera))
        picture = self.picture(self.store, "--camera", path)
        self.assertEqual(len(set(map(tuple, picture.reshape(-1, 3).tolist()))), 1)
        self.assertEqual(self.colour_at(picture, 0.5, 0.5), RED)

    def test_background(self):
        picture = self.picture(self.store, "--view", "top", "--background", "10,200,30")
        self.assertEqual(self.colour_at(picture, 0.01, 0.01), (10, 200, 30))

    def test_eye_dome_lighting_darkens_and_keeps_colours(self):
        plain = self.picture(self.store, "--view", "iso", "--background", "0,0,0")
        shaded = self.picture(self.store, "--view", "iso", "--background", "0,0,0", "--edl")
        self.assertEqual(plain.shape, shaded.shape)
        self.assertLess(int(shaded.sum()), int(plain.sum()))
        self.assertGreater(int(shaded.sum()), int(plain.sum()) // 3)
        self.assertFalse((shaded == plain).all())


class InPlace(SceneTest):
    def test_an_indexed_file_looks_like_its_store(self):
        las = self.folder / "points.las"
        shutil.copyfile(TRIM, las)
        self.succeed("index", las, "--node-points", "2000")
        store = self.build(las)
        for view in ("iso", "top"):
            common = ("--view", view, "--background", "0,0,0", "--point-size", "2")
            all_of = (*common, "--error", "0.01")
            ours, statistics = self.statistics(self.folder / "points.las.pfindex", *all_of)
            self.assertTrue(statistics["complete"])
            self.assertEqual(statistics["points_drawn"], 110000)
            # Equal depths may be drawn in another order; nothing else can differ.
            self.assertGreater(share_alike(ours, self.picture(store, *all_of)), 0.995, view)
            coarse, statistics = self.statistics(
                self.folder / "points.las.pfindex", *common, "--error", "4")
            self.assertTrue(statistics["complete"])
            self.assertLess(statistics["points_drawn"], 60000)
            self.assertGreater(share_alike(coarse, ours), 0.5, view)


class ChosenClasses(SharedSceneTest):
    @classmethod
    def make_store(cls, folder):
        return [TRIM, "--layers", "class"]

    def drawn(self, *arguments):
        picture, statistics = self.statistics(
            self.store, "--view", "top", "--error", "0.01", "--background", "0,0,0",
            "--color-by", "classification", *arguments)
        self.assertTrue(statistics["complete"])
        return picture, statistics["points_drawn"]

    def test_only_their_points_are_drawn(self):
        everything, count = self.drawn()
        self.assertEqual(count, 110000)
        self.assertEqual(self.drawn("--classes", "1,2")[1], 110000)
        for classes, points in (("1", 83893), ("2", 26107), ("2,6", 26107)):
            picture, count = self.drawn("--classes", classes)
            self.assertEqual(count, points)
            colours = {tuple(c) for c in picture.reshape(-1, 3).tolist()} - {(0, 0, 0)}
            self.assertEqual(len(colours), 1, classes)
            self.assertLess(int((picture.max(axis=2) > 0).sum()),
                            int((everything.max(axis=2) > 0).sum()))

    def test_what_cannot_be_chosen_is_told(self):
        picture = self.folder / "x.png"
        outcome = self.refuse(1, "render", self.store, "-o", picture, "--classes", "9")
        self.assertIn("no store here has a point of these classes", outcome.err)
        self.assertFalse(picture.exists())

    def test_one_tree_shows_them_too(self):
        plain = self.folder / "plain.pfront"
        self.succeed("build", TRIM, "-o", plain, "--layers", "none")
        words = ("--view", "top", "--error", "0.01", "--background", "0,0,0", "--color-by",
                 "classification", "--classes", "2", "--point-size", "1")
        alike = share_alike(self.picture(plain, *words), self.picture(self.store, *words))
        self.assertGreaterEqual(alike, 1.0 if SOFTWARE else 0.995)


class Styles(SharedSceneTest):
    """Options become a style sheet; how it is read and resolved is tested beside it."""

    @classmethod
    def make_store(cls, folder):
        return [write_las(folder / "plane.las", quadrants())]

    def setUp(self):
        super().setUp()
        camera = {"position": [50, 50, 40], "focal_point": [52, 49, 0], "view_up": [0, 1, 0],
                  "view_angle": 30}
        self.camera = self.folder / "camera.json"
        self.camera.write_text(json.dumps(camera))
        self.near = (self.store, "--camera", self.camera, "--background", "0,0,0")

    def test_techniques_close_the_surface(self):
        # Points stand 5 pixels apart.
        points = self.picture(*self.near, "--point-size", 1)
        self.assertGreater(int((points.max(axis=2) == 0).sum()), SIZE[0] * SIZE[1] // 2)
        pictures = []
        for technique in ("points", "splats", "spheres", "ewa", "silhouettes"):
            picture = self.picture(*self.near, "--technique", technique, "--unlit")
            self.assertEqual(int((picture.max(axis=2) == 0).sum()), 0, technique)
            corners = picture[[-5, -5, 5, 5], [5, -5, 5, -5]].tolist()
            self.assertEqual(list(map(tuple, corners)), [RED, GREEN, BLUE, WHITE], technique)
            pictures.append(picture)
        # Spheres are lit unless told otherwise.
        lit = self.picture(*self.near, "--technique", "spheres")
        self.assertLess(int(lit.sum()), 0.95 * int(pictures[2].sum()))
        # Splats that are blended mix colours where they meet.
        self.assertEqual(len(numpy.unique(pictures[1].reshape(-1, 3), axis=0)), 4)
        self.assertGreater(len(numpy.unique(pictures[3].reshape(-1, 3), axis=0)), 20)

    def test_bands_of_splats_look_like_the_picture(self):
        # How large a splat of a coarse node is follows from the finer ones in sight, which a band
        # has fewer of.
        store = self.folder / "trim.pfront"
        self.succeed("build", TRIM, "-o", store, "--height-above-ground")
        for technique, view in (("points", "top"), ("splats", "top"), ("spheres", "top"),
                                ("ewa", "top"), ("silhouettes", "top"), ("solid", "front")):
            words = (store, "--view", view, "--technique", technique)
            whole = self.picture(*words, size=(1200, 900))
            banded, statistics = self.statistics(*words, "--memory", "32M", size=(1200, 900))
            self.assertLessEqual(statistics["picture_bytes"], 16 << 20)
            self.assertGreater(share_alike(whole, banded, 0), 0.999, technique)

    def test_walls_come_down_from_above_the_view(self):
        roof = [(40 + 0.5 * (i % 40), 40 + 0.5 * (i // 40), 60.0, 60.0) for i in range(1600)]
        ground = [(2.0 * (i % 50), 2.0 * (i // 50), 0.0, 0.0) for i in range(2500)]
        table = self.folder / "tall.csv"
        with open(table, "w", encoding="ascii") as file:
            file.write("x,y,z,height_above_ground\n")
            file.writelines(",".join(map(str, point)) + "\n" for point in roof + ground)
        store = self.folder / "tall.pfront"
        self.succeed("build", table, "-o", store, "--node-points", "256")
        self.camera.write_text(json.dumps(
            {"position": [50, -60, 5], "focal_point": [50, 50, 5], "view_up": [0, 0, 1],
             "view_angle": 12}))
        style = self.folder / "style.json"
        style.write_text(json.dumps(
            {"default": {"technique": "solid", "color": "#00ff00", "wall_color": "#ff00ff"}}))
        picture, statistics = self.statistics(store, "--camera", self.camera, "--style", style,
                                              "--background", "0,0,0", "--error", "0.5")
        self.assertGreater(statistics["points_drawn"], 3500)  # the roof's nodes too
        upper = picture[:SIZE[1] // 3, SIZE[0] // 2].tolist()
        self.assertEqual(set(map(tuple, upper)), {(255, 0, 255)})

    def test_solid_takes_heights(self):
        outcome = self.refuse(1, "render", self.store, "-o", self.folder / "x.png", "--technique",
                              "solid")
        self.assertIn("build it with --height-above-ground", outcome.err)

    def test_where(self):
        words = (self.store, "--view", "top", "--background", "0,0,0")
        colours = self.picture(*words, "--where", "rgb[2] > 40000").reshape(-1, 3)
        self.assertLessEqual(set(map(tuple, colours.tolist())), {(0, 0, 0), BLUE, WHITE})
        self.assertIn(WHITE, set(map(tuple, colours.tolist())))
        outcome = self.refuse(1, "render", *words, "-o", self.folder / "x.png", "--where",
                              "weight > 2")
        self.assertIn("weight", outcome.err)

    def test_what_differs_between_tiles_is_told(self):
        tiles = self.folder / "tiles"
        tiles.mkdir()
        shutil.copy(self.store, tiles)
        self.succeed("build", write_las(self.folder / "far.las", [(1e6, 0.0, 0.0, 0, 0, 0),
                                                                  (1e6 + 1, 1.0, 0.0, 0, 0, 0)]),
                     "-o", tiles / "far.pfront", "--attributes", "intensity")
        out = self.succeed("render", tiles, "-o", self.folder / "x.png", "--size", "64x64",
                           "--backend", BACKEND)
        self.assertIn("1 of 2 stores lack", out.err)
        self.assertIn("far apart", out.err)

    def test_style_file(self):
        style = self.folder / "style.json"
        style.write_text(json.dumps({"default": {"color": "#20ff40", "technique": "splats"}}))
        picture, statistics = self.statistics(*self.near, "--style", style)
        self.assertEqual(set(map(tuple, picture.reshape(-1, 3).tolist())), {(32, 255, 64)})
        self.assertEqual(statistics["attributes_read"], [])


class Refinement(SharedSceneTest):
    @classmethod
    def make_store(cls, folder):
        return [DATA / "classified/lidarhd_rgb_nir_698k.laz"]

    def test_statistics(self):
        _, statistics = self.statistics(self.store)
        self.assertEqual(set(statistics), {
            "complete", "time_to_first_image_ms", "time_to_complete_ms", "points_drawn",
            "nodes_drawn", "error_px", "peak_rss_bytes", "resident_bytes", "gpu_bytes",
            "bytes_read", "attributes_read", "limited_by", "left_out", "failed_nodes", "backend",
            "picture_bytes", "classes", "expected",
            "requests", "bytes_fetched", "retries", "cache_hits", "cache_bytes"})
        self.assertEqual(statistics["backend"], BACKEND)
        self.assertIs(statistics["complete"], True)
        self.assertLessEqual(statistics["error_px"], 1)
        self.assertLessEqual(
            statistics["time_to_first_image_ms"], statistics["time_to_complete_ms"])
        self.assertEqual(statistics["attributes_read"], ["rgb"]) # only what the picture needs
        for key in ("points_drawn", "nodes_drawn", "bytes_read", "resident_bytes"):
            self.assertGreater(statistics[key], 0, key)
        self.assertEqual(statistics["gpu_bytes"] == 0, SOFTWARE)
        self.assertEqual(statistics["picture_bytes"] > 0, SOFTWARE)

    def test_two_runs_give_the_same_picture(self):
        one, other = (self.picture(self.store) for _ in range(2))
        self.assertTrue((one == other).all())

    def test_smaller_error_draws_more(self):
        points = [self.statistics(self.store, "--error", error)[1]["points_drawn"]
                  for error in (8, 2, 0.5)]
        self.assertLess(points[0], points[1])
        self.assertLess(points[1], points[2])

    def test_frames_refine_towards_the_complete_picture(self):
        complete, all_statistics = self.statistics(self.store)
        points, alike = [], []
        for frames in (1, 64):  # each a process of its own: how much is there varies in between
            picture, statistics = self.statistics(self.store, "--frames", frames)
            points.append(statistics["points_drawn"])
            alike.append(share_alike(picture, complete))
        self.assertGreater(points[0], 0)
        self.assertLessEqual(points[0], points[1])
        self.assertLessEqual(points[1], all_statistics["points_drawn"])
        self.assertGreaterEqual(alike[1], alike[0])

    def test_colours(self):
        pictures = [self.picture(self.store, "--color-by", name) for name in
                    ("rgb", "classification", "intensity", "elevation", "return_number")]
        for i, one in enumerate(pictures):
            self.assertGreater(one.std(), 5.0)
            for other in pictures[:i]:
                self.assertLess(share_alike(one, other), 0.9)
        self.refuse(1, "render", self.store, "-o", self.folder / "x.png", "--color-by", "weight")

    def test_colours_of_normals_and_heights(self):
        outcome = self.refuse(
            1, "render", self.store, "-o", self.folder / "x.png", "--color-by", "horizontality")
        self.assertIn("--normals", outcome.err)
        store = self.folder / "shapes.pfront"
        self.succeed("build", TRIM, "-o", store, "--normals", "pca", "--local-height",
                     "--layers", "class")
        by_name = {name: self.picture(store, "--color-by", name) for name in
                   ("normal", "horizontality", "global-height", "local-height", "elevation")}
        pictures = list(by_name.values())
        for i, one in enumerate(pictures):
            self.assertGreater(one.std(), 5.0)
            for other in pictures[:i]:
                self.assertLess(share_alike(one, other), 0.95)
        # Airborne ground is flat: its normals point up, which is blue, and it is fully horizontal,
        # which is the end of the table.
        drawn = numpy.any(by_name["horizontality"] != by_name["horizontality"][0, 0], axis=2)
        blue = by_name["normal"][drawn]
        self.assertGreater(numpy.median(blue[:, 2]), 200)
        self.assertLess(abs(numpy.median(blue[:, 0]) - 127), 40)
        yellow = numpy.median(by_name["horizontality"][drawn], axis=0)
        self.assertGreater(yellow[0], 200)
        self.assertLess(yellow[2], 80)

    def test_point_budget_is_held_and_told(self):
        path = self.folder / "x.png"
        stats = self.folder / "stats.json"
        outcome = self.succeed("render", self.store, "-o", path, "--point-budget", 50000,
                               "--stats", stats)
        statistics = json.loads(stats.read_text())
        self.assertLessEqual(statistics["points_drawn"], 50000)
        self.assertIn("--point-budget", outcome.err)
        self.assertNotIn("--memory", outcome.err)
        self.assertEqual(statistics["limited_by"], ["points"])
        self.assertEqual(statistics["failed_nodes"], 0)

    def test_a_level_for_the_view_that_is_coarser_than_asked_is_told(self):
        las = self.folder / "large.las"  # more points than an overview has
        self.succeed("generate", "--points", 4000000, "-o", las)
        store = self.build(las, name="large.pfront")
        told = set()
        for error in (0.1, 1, 2):
            stats = self.folder / f"{error}.json"
            outcome = self.succeed("render", store, "-o", self.folder / f"{error}.png",
                                   "--detail", "view", "--error", error, "--stats", stats)
            statistics = json.loads(stats.read_text())
            coarser = statistics["error_px"] > error
            self.assertEqual(statistics["limited_by"], ["detail"] if coarser else [], statistics)
            self.assertEqual("--detail front" in outcome.err, coarser)
            told.add(coarser)
        self.assertEqual(told, {False, True})

    @unittest.skipIf(SOFTWARE, "takes no GPU memory")
    def test_gpu_memory_is_held_and_told(self):
        path = self.folder / "x.png"
        stats = self.folder / "stats.json"
        outcome = self.succeed("render", self.store, "-o", path, "--gpu-memory", "4M",
                               "--stats", stats)
        statistics = json.loads(stats.read_text())
        self.assertLessEqual(statistics["gpu_bytes"], 4 << 20)
        self.assertGreater(statistics["gpu_bytes"], 2 << 20)
        self.assertIn("raise --gpu-memory", outcome.err)
        self.assertEqual(statistics["limited_by"], ["gpu-memory"])
        self.succeed("bench", self.store, "--path", "zoom", "--frames", 12, "--interactive",
                     "--gpu-memory", "4M", "--settle", "--stats", stats, "--size", "320x240")
        result = json.loads(stats.read_text())
        self.assertLessEqual(result["gpu_bytes_max"], 4 << 20)
        self.assertEqual(result["gpu_budget_bytes"], 4 << 20)
        self.assertTrue(result["settle"]["complete"])

    def test_bench(self):
        stats, table = self.folder / "bench.json", self.folder / "frames.csv"
        for path in ("orbit", "zoom", "flight"):
            self.succeed("bench", self.store, "--path", path, "--frames", 6, "--interactive",
                         "--memory", "64M", "--stats", stats, "--frames-csv", table,
                         "--size", "320x240")
            result = json.loads(stats.read_text())
            self.assertEqual(set(result), {
                "frames", "frame_ms", "front_update_ms", "points_drawn", "resident_bytes_max",
                "gpu_bytes_max", "gpu_budget_bytes", "budget_bytes", "bytes_read",
                "frames_that_read_files", "loading", "backend", "rasterise_ms", "picture_bytes",
                "empty_scene_rss_bytes", "peak_rss_bytes",
                "requests", "bytes_fetched", "retries", "cache_hits", "cache_bytes", "expected"})
            self.assertEqual(result["backend"], BACKEND)
            self.assertGreater(result["peak_rss_bytes"], result["empty_scene_rss_bytes"])
            self.assertEqual(result["frames"], 6)
            self.assertEqual(result["budget_bytes"], 64 << 20)
            self.assertLessEqual(result["resident_bytes_max"], result["budget_bytes"])
            self.assertEqual(result["rasterise_ms"] is not None, SOFTWARE)
            for key in ("frame_ms", "front_update_ms") + SOFTWARE * ("rasterise_ms",):
                values = [result[key][p] for p in ("p50", "p95", "p99", "max")]
                self.assertEqual(values, sorted(values))
                self.assertGreater(values[-1], 0.0)
            rows = list(csv.DictReader(table.read_text().splitlines()))
            self.assertEqual(list(rows[0]), [
                "frame", "ms", "points", "front_length", "threshold_px", "moves", "requests",
                "cancelled", "resident_bytes", "front_ms", "error_px", "gpu_bytes",
                "thread_read_bytes", "rasterise_ms"])
            self.assertEqual(len(rows), 6)
            for row in rows:
                self.assertEqual(row["rasterise_ms"] != "", SOFTWARE)

    def test_bench_settles(self):
        stats, table, picture = (self.folder / f"settle.{end}" for end in ("json", "csv", "png"))
        begin = time.monotonic()
        self.succeed("bench", self.store, "--path", "orbit", "--frames", 4, "--interactive",
                     "--frame-ms", 5, "--seconds", 2, "--settle", "--picture", picture,
                     "--stats", stats, "--frames-csv", table, "--size", "320x240")
        self.assertGreaterEqual(time.monotonic() - begin, 1.5)  # when the last frame begins
        result = json.loads(stats.read_text())
        settle = result["settle"]
        self.assertTrue(settle["complete"])
        self.assertGreaterEqual(settle["frames"], 1)
        self.assertGreaterEqual(settle["ms"], max(settle["drawing_ms"], settle["loaded_ms"]))
        self.assertLessEqual(settle["error_px"], 1.01)
        self.assertLessEqual(settle["bytes_decoded"], result["loading"]["bytes_decoded"])
        rows = list(csv.DictReader(table.read_text().splitlines()))
        self.assertEqual(len(rows), 4 + settle["frames"])
        self.assertEqual(int(rows[-1]["points"]), settle["points_drawn"])
        self.assertTrue(picture.read_bytes().startswith(b"\x89PNG"))


class Trouble(SceneTest):
    def test_broken_node(self):
        store = self.build(TRIM)
        data = bytearray(store.read_bytes())
        for at in range(len(data) // 4, len(data) // 2, 997):
            data[at] ^= 0x55
        store.write_bytes(data)
        outcome = self.refuse(1, "render", store, "-o", self.folder / "x.png")
        self.assertIn("node", outcome.err)
        self.assertEqual(self.entries(), ["cloud.pfront"])

    def test_picture_that_cannot_be_written(self):
        store = self.build(TRIM)
        self.refuse(1, "render", store, "-o", "/proc/x.png")
        self.refuse(1, "render", store, "-o", self.folder / "x.png", "--camera", "no/such.json")
        self.refuse(1, "render", "no/such.pfront", "-o", self.folder / "x.png")


if __name__ == "__main__":
    unittest.main(verbosity=2)
