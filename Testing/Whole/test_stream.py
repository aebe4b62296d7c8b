"""`pointfront stream`: frames for another program."""

import contextlib
import json
import os
import pathlib
import shutil
import subprocess
import sys
import unittest

import halves
import numpy
import pictures
import tool

CLOUD = tool.DATA / "las/real/1.2-with-color.las"


class Stream:
    """The tool, asked for a frame at a time."""

    def __init__(self, *arguments):
        self.process = subprocess.Popen([tool.TOOL, "stream", *map(str, arguments)],
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE)

    def ask(self, **request):
        return self.send(json.dumps(request))

    def send(self, line):
        """The answer, and the pixels of its frame."""
        self.process.stdin.write(line.encode() + b"\n")
        self.process.stdin.flush()
        answer = json.loads(self.process.stdout.readline() or b"null")
        return answer, self.process.stdout.read(answer["bytes"]) if answer else b""

    def settle(self, **request):
        answer, pixels = self.ask(**request)
        while not answer["settled"]:
            answer, newer = self.ask(wait_ms=200)
            pixels = newer or pixels
        return answer, pixels

    def end(self):
        """Its status and what it complained of."""
        with contextlib.suppress(BrokenPipeError):  # it ended before it had read all
            self.process.stdin.close()
        said = self.process.stderr.read().decode()
        status = self.process.wait(60)
        self.process.stdout.close()
        self.process.stderr.close()
        return status, said


class Streams(tool.ToolTest):
    def setUp(self):
        super().setUp()
        self.store = self.folder / "a.pfront"
        self.succeed("build", CLOUD, "-o", self.store, "--node-points", "256")

    def open(self, *arguments, store=None):
        stream = Stream(store or self.store, *arguments)
        self.addCleanup(stream.process.kill)
        return stream

    def test_settled_is_as_fine_as_asked(self):
        # Frames pause while points arrive; a pause is no end.
        large = self.folder / "large.pfront"
        # A sanitizer sees the same pauses between smaller nodes of fewer points.
        made, points, turns = 3000000, "8192", 6
        if tool.SLOWNESS > 1:
            made, points, turns = 110000, "512", 2
        self.succeed("generate", "--points", made, "-o", self.folder / "made.las")
        self.succeed("build", self.folder / "made.las", "-o", large, "--node-points", points)
        for turn in range(turns):
            stream = Stream(large)
            self.addCleanup(stream.process.kill)
            answer, _ = stream.ask()
            drawn = answer
            while not answer["settled"]:
                answer, pixels = stream.ask(wait_ms=200)
                drawn = answer if pixels else drawn
            self.assertTrue(drawn["complete"], (turn, drawn))
            self.assertEqual(stream.end()[0], 0)

    def test_no_cloud_vanishes_when_a_motion_begins(self):
        stores, camera = halves.halves_of_a_town(self)
        style = self.folder / "white.json"
        style.write_text(json.dumps(halves.WHITE))
        stream = Stream(*stores, "--style", style, "--background", "0,0,0", "--error", "0.5",
                        "--frame-ms", "1")
        self.addCleanup(stream.process.kill)

        def shown(answer, pixels):
            return halves.lit(numpy.frombuffer(pixels, numpy.uint8).reshape(
                answer["height"], answer["width"], 4))

        rest = shown(*stream.settle(size=halves.SIZE, camera=camera))
        self.assertGreater(min(rest), 1000)
        for frame in range(1, 4):
            moving = shown(*stream.ask(camera=halves.moved(camera, frame), moving=True))
            for before, now in zip(rest, moving):
                self.assertGreater(now, before / 10, (frame, rest, moving))
        self.assertEqual(stream.end(), (0, ""))

    def test_memory_is_what_was_allowed(self):
        # A frame of 8192 x 8192 takes 1.1 GB and more.
        stream = self.open("--memory", "64M")
        self.assertIsNotNone(stream.ask()[0])
        answer, _ = stream.ask(size=[8192, 8192])
        self.assertIsNone(answer)
        status, said = stream.end()
        self.assertEqual(status, 1, said)
        self.assertIn("8192 x 8192 pixels takes --memory", said)

    def test_a_line_without_end_is_refused(self):
        stream = self.open()
        with contextlib.suppress(BrokenPipeError):
            for _ in range(1000):
                stream.process.stdin.write(b"x" * 1000000)
            stream.process.stdin.flush()
        status, said = stream.end()
        self.assertEqual(status, 1, said)
        self.assertIn("longer than", said)

    def test_a_view_at_rest_is_what_render_draws(self):
        look = ["--color-by", "intensity", "--technique", "splats", "--background", "0,0,255"]
        stream = self.open(*look)
        answer, pixels = stream.settle(size=[160, 90])
        self.assertTrue(answer["settled"])
        self.assertEqual(stream.end(), (0, ""))
        picture = self.folder / "a.png"
        self.succeed("render", self.store, "-o", picture, "--size", "160x90", *look)
        drawn = numpy.frombuffer(pixels, numpy.uint8).reshape(90, 160, 4)
        numpy.testing.assert_array_equal(drawn[..., :3], pictures.read_png(picture))
        self.assertTrue((drawn[..., 3] == 255).all())

    def test_sizes_may_change_as_often_as_a_window_does(self):
        stream = self.open()
        for i in range(160 if tool.SLOWNESS == 1 else 24):
            answer, _ = stream.ask(size=[320, 180] if i % 2 else [1280, 720], moving=True)
            self.assertIsNotNone(answer, f"it ended at size {i}")
        self.assertEqual(stream.end(), (0, ""))

    def test_sizes_cameras_and_views(self):
        stream = self.open()
        iso, first = stream.settle(size=[64, 48])
        self.assertEqual((iso["width"], iso["height"]), (64, 48))
        self.assertEqual(len(iso["bounds"]), 6)
        top, from_above = stream.settle(view="top")
        self.assertNotEqual(from_above, first)
        self.assertEqual(top["camera"]["view_up"], [0.0, 1.0, 0.0])
        again, back = stream.settle(camera=iso["camera"])
        self.assertEqual(again["camera"], iso["camera"])
        self.assertEqual(back, first)
        large, _ = stream.settle(size=[128, 96], moving=False)
        self.assertEqual(large["bytes"], 4 * 128 * 96)
        moving, pixels = stream.ask(camera=iso["camera"], moving=True)
        self.assertEqual(len(pixels), moving["bytes"])
        nothing, pixels = stream.ask(wait_ms=0)
        self.assertIn(nothing["bytes"], (0, 4 * 128 * 96))
        self.assertEqual(stream.end()[0], 0)

    def test_the_point_under_a_pixel_is_told(self):
        """Random pixels: what is picked is a stored point that is drawn there."""
        table = self.folder / "a.csv"
        self.succeed("export", self.store, "-o", table)
        names, *lines = table.read_text().splitlines()
        names = names.replace(",", " ").split()
        rows = [dict(zip(names, map(float, line.replace(",", " ").split()))) for line in lines]
        random = numpy.random.default_rng(3)
        stream = self.open("--point-size", "5", "--error", "0.1", "--background", "0,0,0")
        for view in ("iso", "top"):
            answer, pixels = stream.settle(size=[160, 90], view=view)
            camera = answer["camera"]
            before = numpy.frombuffer(pixels, numpy.uint8).reshape(90, 160, 4)
            met = 0
            for column, row in random.integers(0, [160, 90], (40, 2)).tolist():
                told, nothing = stream.ask(pick=[column, row])
                self.assertEqual((told["bytes"], nothing), (0, b""))
                point = told["picked"]
                if point is None:
                    near = before[max(0, row - 4):row + 5, max(0, column - 4):column + 5, :3]
                    self.assertEqual(int(near.max()), 0, "points are there, and none is told")
                    continue
                met += 1
                x, y = self.projected(camera, point["position"], 160, 90)
                self.assertLess(numpy.hypot(x - column - 0.5, y - row - 0.5), 6 + 5)
                same = [r for r in rows if max(abs(r[axis] - point["position"][i])
                                               for i, axis in enumerate("xyz")) < 0.006]
                self.assertTrue(any(r["intensity"] == point["attributes"]["intensity"]
                                    and r["red"] == point["attributes"]["rgb"][0]
                                    for r in same), (point, same))
                self.assertEqual(point["store"], str(self.store))
            self.assertGreater(met, 5)
            again, pixels = stream.settle(view=view)
            after = numpy.frombuffer(pixels, numpy.uint8).reshape(90, 160, 4)
            numpy.testing.assert_array_equal(after, before)
        self.assertIsNone(stream.ask(pick=[-50, 3])[0]["picked"])
        self.assertEqual(stream.end(), (0, ""))

    def test_a_path_may_be_any_bytes(self):
        odd = pathlib.Path(os.fsdecode(os.fsencode(self.folder) + b"/\xff.pfront"))
        shutil.copyfile(self.store, odd)
        stream = self.open(store=odd)
        stream.settle(size=[160, 90])
        told = [stream.ask(pick=[column, row])[0]["picked"]
                for column in range(0, 160, 12) for row in range(0, 90, 12)]
        stores = {point["store"] for point in told if point}
        self.assertEqual(len(stores), 1)
        self.assertIn("\ufffd.pfront", stores.pop())
        self.assertEqual(stream.end(), (0, ""))

    @staticmethod
    def projected(camera, place, width, height):
        """Pixels from the left and from the top."""
        eye, focus, up = (numpy.array(camera[name]) for name in
                          ("position", "focal_point", "view_up"))
        back = (eye - focus) / numpy.linalg.norm(eye - focus)
        right = numpy.cross(up, back)
        right /= numpy.linalg.norm(right)
        off = numpy.array(place) - eye
        half = -(off @ back) * numpy.tan(numpy.radians(camera["view_angle"]) / 2)
        x, y = off @ right / half, off @ numpy.cross(back, right) / half
        return width / 2 + x * height / 2, height / 2 - y * height / 2

    def test_the_colours_are_told(self):
        for colour, says in (("intensity", "ramp"), ("elevation", "ramp"),
                             ("classification", "values"), ("rgb", None)):
            stream = self.open("--color-by", colour)
            legend = stream.ask(legend=True)[0]["legend"]
            self.assertNotIn("legend", stream.ask()[0])
            self.assertEqual(stream.end()[0], 0)
            if says is None:
                self.assertIsNone(legend)
                continue
            self.assertEqual(legend["attribute"], colour)
            if says == "ramp":
                self.assertLess(*legend["range"])
                self.assertEqual(len(legend["colours"]), 17)
                self.assertRegex(legend["colours"][0], "^#[0-9a-f]{6}$")
            else:
                self.assertEqual(dict(legend["values"])[2], "#a5784b")  # ground

    def test_nothing_new_is_said(self):
        stream = self.open()
        stream.settle(size=[64, 48])
        answer, _ = stream.ask(wait_ms=10)
        self.assertEqual((answer["bytes"], answer["settled"]), (0, True))
        self.assertEqual(stream.end()[0], 0)

    def test_a_view_that_changes_is_drawn_whatever_it_waits_for(self):
        stream = self.open()
        iso, first = stream.settle(size=[64, 48])
        for request in ({"view": "top"}, {"size": [128, 96]}, {"camera": iso["camera"]},
                        {"moving": True}, {"moving": False}):
            answer, _ = stream.ask(wait_ms=10, **request)
            self.assertEqual(answer["bytes"], 4 * answer.get("width", 0) * answer.get("height", 0))
            self.assertGreater(answer["bytes"], 0, request)
            answer, _ = stream.settle(**request)
            again, _ = stream.ask(wait_ms=10, **request)
            self.assertEqual((again["bytes"], again["settled"]), (0, True), request)
        _, back = stream.settle(size=[64, 48], wait_ms=10)
        self.assertEqual(back, first)
        answer, _ = stream.ask(wait_ms=10, legend=True)
        self.assertEqual(answer["bytes"], 0)
        self.assertIn("legend", answer)
        self.assertIn("picked", stream.ask(wait_ms=10, pick=[32, 24])[0])
        self.assertEqual(stream.end(), (0, ""))

    def test_wrong_requests_end_it(self):
        for line, says in (("{", "JSON object"), ("[]", "JSON object"),
                           ('{"size": [0, 5]}', "size"), ('{"size": [9000, 5]}', "size"),
                           ('{"size": 5}', "size"), ('{"view": "sideways"}', "view"),
                           ('{"moving": 1}', "moving"), ('{"wait_ms": "long"}', "wait_ms"),
                           ('{"wait_ms": -5}', "wait_ms"), ('{"wait": 5}', '"wait"'),
                           ('{"legend": 1}', "legend"), ('{"pick": 3}', "pick"),
                           ('{"pick": ["a", 1]}', "pick"),
                           ('{"camera": {}}', "position")):
            stream = self.open()
            answer, _ = stream.send(line)
            self.assertIsNone(answer, line)
            status, said = stream.end()
            self.assertEqual(status, 1, line)
            self.assertIn(says, said)
            self.assertEqual(len(said.splitlines()), 1)
        self.refuse(1, "stream", self.folder / "none.pfront")
        self.refuse(1, "stream", self.store, "--backend", "opengl")
        self.refuse(2, "stream")

    def test_serve_is_of_python(self):
        """It becomes the page of the Python package, where that is, and says so where it is not."""
        package = self.folder / "python" / "pointfront"
        package.mkdir(parents=True)
        (package / "__init__.py").write_text("")
        (package / "__main__.py").write_text("import sys\nprint(sys.argv[1:])\nsys.exit(7)\n")
        plain = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
        python = {**plain, "POINTFRONT_PYTHON": sys.executable}
        words = ["serve", self.store, "--port", "0", "--help"]
        served = tool.pointfront(*words, environment={**python, "PYTHONPATH": str(package.parent)})
        self.assertEqual(served.status, 7, served)
        self.assertEqual(served.out.strip(), str(list(map(str, words))))
        for environment, says in (({**python, "PYTHONPATH": str(self.folder / "none")}, "install"),
                                  ({**plain, "POINTFRONT_PYTHON": "no-python"}, "no-python")):
            refused = tool.pointfront(*words, environment=environment)
            self.assertEqual(refused.status, 1, refused)
            self.assertIn(says, refused.err)
            self.assertEqual(len(refused.err.splitlines()), 1)


if __name__ == "__main__":
    unittest.main()
