"""A page's legend and switches, of frames of the tool: no browser, no packages of the web."""

import contextlib
import io
import pathlib
import shutil
import tempfile
import unittest
import warnings

import numpy
import pointfront
from pointfront._controls import TECHNIQUES, Classes, colours_of, legend_state, may_choose
from pointfront._serve import address_of, parser
from pointfront._stream import FrameStream


class Legends(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="pointfront-controls-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def shown(self, classes, layers, colour):
        """The legend and the switches of a cloud with points of these classes."""
        random = numpy.random.default_rng(1)
        store = self.folder / "a.pfront"
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            pointfront.build(
                {"position": random.uniform(0, 100, (900, 3)),
                 "classification": numpy.resize(classes, 900).astype("u1")},
                store, layers=layers, overwrite=True, preview=False)
        stream = FrameStream([store], ["--color-by", colour])
        self.addCleanup(stream.close)
        legend = stream.frame(size=(16, 9), legend=True).facts["legend"]
        switches = Classes([store])
        return legend_state(legend, switches), switches.state(legend)

    def test_one_class_has_a_legend_and_several_have_switches(self):
        for layers in ("none", "class"):
            for classes, name in (([0], "0 never classified"), ([6], "6 building")):
                with self.subTest(layers=layers, classes=classes):
                    legend, switches = self.shown(classes, layers, "classification")
                    self.assertEqual(switches, [])
                    self.assertEqual(legend["attribute"], "classification")
                    (told, colour), = legend["values"]
                    self.assertEqual(told, name)
                    self.assertRegex(colour, "^#[0-9a-f]{6}$")
            legend, switches = self.shown([2, 6], layers, "classification")
            self.assertIsNone(legend)
            self.assertEqual([one["code"] for one in switches], [2, 6])
            self.assertTrue(all(one["colour"] for one in switches))
            legend, switches = self.shown([0], layers, "elevation")
            self.assertEqual(legend["attribute"], "elevation")
            self.assertEqual(switches, [])

    def test_what_has_no_colours_is_not_offered(self):
        store = self.folder / "many.pfront"
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            pointfront.build({"position": numpy.zeros((3, 3)), "vec": numpy.ones((3, 2)),
                              "rgb": numpy.ones((3, 3), "u1"), "normal": numpy.ones((3, 3), "f4")},
                             store, preview=False)
        offered = colours_of(store)
        self.assertEqual(set(offered), {"vec[0]", "vec[1]", "rgb", "normal", "elevation",
                                        "horizontality"})
        for colour in offered:
            FrameStream([store], ["--color-by", colour]).close()

    def test_what_is_not_offered_is_not_chosen(self):
        for value in ("", "points", "solid"):
            self.assertTrue(may_choose(value, TECHNIQUES, "solid"), value)
        for value in ([], {}, ["points"], None, 3, "solid", "--edl"):
            self.assertFalse(may_choose(value, TECHNIQUES, None), value)


class Addresses(unittest.TestCase):
    def test_an_address_of_ipv6_stands_in_brackets(self):
        for host, shown in (("localhost", "localhost"), ("::1", "[::1]"), ("[::1]", "[::1]")):
            self.assertEqual(address_of(host, 80), f"http://{shown}:80/")

    def test_there_are_ports_to_65535(self):
        for port in ("-1", "65536", "99999", "x"):
            said = io.StringIO()
            with self.assertRaises(SystemExit) as ended, contextlib.redirect_stderr(said):
                parser().parse_args(["a.pfront", f"--port={port}"])
            self.assertEqual(ended.exception.code, 2)
            self.assertIn("0 to 65535", said.getvalue())
        self.assertEqual(parser().parse_args(["a.pfront", "--port", "65535"]).port, 65535)


if __name__ == "__main__":
    unittest.main(verbosity=2)
