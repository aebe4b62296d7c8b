"""A page's legend and switches, of frames of the tool: no browser, no packages of the web."""

import pathlib
import shutil
import tempfile
import unittest
import warnings

import numpy
import pointfront
from pointfront._controls import Classes, legend_state
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


if __name__ == "__main__":
    unittest.main(verbosity=2)
