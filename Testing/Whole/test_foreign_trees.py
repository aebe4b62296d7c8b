"""EPT and COPC whose hierarchies have thousands of pages: only those are read that are needed."""

import json
import os
import pathlib
import re
import shutil
import sys
import threading
import unittest

from foreign_trees import SIDE, key_of, write_copc, write_ept
from pictures import read_png
from tool import ToolTest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "Support"))

# pylint: disable=wrong-import-position
from far_server import FarServer, asked_again

HERE = "127.0.0.1"
LEVELS, STEP = 7, 2  # 5,461 nodes in 4,369 pages
NODES = sum(4 ** level for level in range(LEVELS))
PART = (96.0, 96.0, 0.0, 160.0, 160.0, 9.0)  # a box with 4 by 4 of the smallest cells


class ForeignTrees(ToolTest):
    @classmethod
    def setUpClass(cls):
        cls.trees = pathlib.Path(os.environ["POINTFRONT_WORK"]) / "foreign-trees"
        shutil.rmtree(cls.trees, ignore_errors=True)
        cls.trees.mkdir(parents=True)
        cls.ept = write_ept(cls.trees / "ept", LEVELS, STEP)
        cls.one_page = write_ept(cls.trees / "whole", LEVELS, 0)
        cls.copc = write_copc(cls.trees / "tree.copc.laz", LEVELS, STEP)
        cls.environment = {name: value for name, value in os.environ.items()
                           if "proxy" not in name.lower()}
        cls.environment.update(POINTFRONT_CACHE="off")

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.trees, ignore_errors=True)

    def setUp(self):
        super().setUp()
        self.server = FarServer(self.trees)
        self.server.__enter__()
        self.addCleanup(self.server.__exit__)
        self.far = self.camera("far", [SIDE / 2, SIDE / 2, 9000], 9)
        self.near = self.camera("near", [115, 115, 40], 30)

    def address(self, path):
        return f"http://{HERE}:{self.server.port}/{path.relative_to(self.trees)}"

    def camera(self, name, eye, angle):
        path = self.folder / f"{name}.json"
        path.write_text(json.dumps({"position": eye, "focal_point": [*eye[:2], 0],
                                    "view_up": [0, 1, 0], "view_angle": angle}))
        return path

    def draw(self, cloud, *options):
        """The picture, what it says of itself, and how much of the hierarchy was asked for."""
        self.server.requests.clear()
        picture, facts = self.folder / "picture.png", self.folder / "facts.json"
        self.succeed("render", cloud, "-o", picture, "--size", "320x240", "--stats", facts,
                     "--backend", "software", *options, environment=self.environment)
        return read_png(picture), json.loads(facts.read_text()), self.asked()

    def asked(self):
        """Files of an EPT's hierarchy, or bytes of a COPC's behind its beginning."""
        files = [seen["path"] for seen in self.server.requests if "ept-hierarchy" in seen["path"]]
        self.assertEqual(len(files), len(set(files)), "a page is read once")
        return len(files)

    def points(self, cloud, *options):
        out = self.folder / "points.csv"
        self.succeed("export", cloud, "-o", out, "--force", *options, environment=self.environment)
        return sorted(out.read_bytes().splitlines())

    def test_the_first_picture_reads_the_first_page(self):
        """No page below it comes before the picture is there: what is asked for does not depend on
        the machine."""
        drawn = threading.Event()
        self.addCleanup(drawn.set)

        def wait(path):
            if "ept-hierarchy" in path and not path.endswith("/0-0-0-0.json"):
                drawn.wait(30)

        self.server.before = wait
        for cloud, pages in ((self.ept, 1), (self.copc, 0)):
            with self.subTest(cloud.name):
                _, facts, asked = self.draw(self.address(cloud), "--camera", self.near,
                                            "--frames", "1")
                # Once it is there, the near view asks for the pages below four nodes.
                self.assertLessEqual(asked, 5 * pages)
                self.assertLessEqual(facts["requests"], 5 + 2 * asked)

    def test_a_promised_tree_is_drawn_again_without_a_question(self):
        self.environment = {**self.environment, "POINTFRONT_CACHE": str(self.folder / "cache")}
        for cloud in (self.ept, self.copc):
            with self.subTest(cloud.name):
                address = (f"http://{HERE}:{self.server.port}/~immutable/"
                           f"{cloud.relative_to(self.trees)}")
                first, facts, _ = self.draw(address, "--camera", self.near)
                self.assertGreater(facts["requests"], 2)
                before = list(self.server.requests)
                second, _, _ = self.draw(address, "--camera", self.near)
                self.assertEqual(asked_again(before, self.server.requests), 0)
                self.assertTrue((first == second).all())

    def test_a_far_view_reads_few_pages(self):
        near, _, _ = self.draw(self.one_page, "--camera", self.far)
        far, _, asked = self.draw(self.address(self.ept), "--camera", self.far)
        self.assertTrue((far == near).all())
        self.assertLessEqual(asked, 1 + 16)

    def test_a_near_view_reads_the_pages_in_sight(self):
        near, facts, _ = self.draw(self.one_page, "--camera", self.near)
        self.assertGreater(facts["points_drawn"], 20)
        for cloud in (self.ept, self.copc):
            with self.subTest(cloud.name):
                far, _, asked = self.draw(self.address(cloud), "--camera", self.near)
                self.assertTrue((far == near).all())
                local, _, _ = self.draw(cloud, "--camera", self.near)
                self.assertTrue((local == near).all())
                self.assertLess(asked, 120)
                self.assertEqual(asked > 20, cloud == self.ept)

    def test_the_whole_view_is_that_of_one_page(self):
        """Every point is drawn, each page is read, and nothing else differs."""
        options = ("--error", "0.01", "--camera", self.far)
        levels = 5
        pictures = []
        for name, step in (("one", 0), ("many", STEP), ("each", 1)):
            tree = write_ept(self.folder / name, levels, step)
            picture, facts, _ = self.draw(tree, *options)
            self.assertEqual(facts["points_drawn"], sum(4 ** level for level in range(levels)))
            pictures.append(picture)
        self.assertTrue((pictures[0] == pictures[1]).all() and (pictures[0] == pictures[2]).all())

    def test_questions_read_what_they_need(self):
        expected = self.points(self.one_page)
        box = ",".join(map(str, PART))
        part = self.points(self.one_page, "--box", box)
        self.assertEqual(len(expected), NODES + 1)
        self.assertGreater(len(part), 10)
        for cloud in (self.ept, self.copc):
            with self.subTest(cloud.name):
                def columns(lines):  # the COPC has other attributes
                    return [line.split(b",")[:3] for line in lines]
                self.assertEqual(columns(self.points(cloud)), columns(expected))
                self.server.requests.clear()
                self.assertEqual(columns(self.points(self.address(cloud), "--box", box)),
                                 columns(part))
                self.assertLess(self.asked(), 120)
        self.assertEqual(self.points(self.address(self.ept)), expected)
        told = self.succeed("verify", self.address(self.copc), "--json",
                            environment=self.environment).json
        self.assertEqual((told["ok"], told["points_checked"]), (True, NODES))

    def test_info_counts_by_the_header(self):
        for cloud, pages in ((self.ept, 1), (self.copc, 0)):
            with self.subTest(cloud.name):
                self.server.requests.clear()
                told = self.succeed("info", self.address(cloud), "--json",
                                    environment=self.environment).json
                self.assertEqual((told["points"], told["nodes"]), (NODES, None))
                self.assertEqual(self.asked(), pages)
                local = self.succeed("info", cloud, "--json", environment=self.environment).json
                self.assertEqual((local["points"], local["nodes"]), (NODES, NODES))

    def test_lists_have_the_whole_tree(self):
        trees = self.folder / "trees.pfronts"
        trees.write_text(f"{self.ept}\n{self.copc}\n")
        told = self.succeed("info", trees, "--together", "--json").json
        self.assertEqual((told["points"], told["nodes"]), (2 * NODES, 2 * NODES))

    def test_a_page_that_is_missing_is_told_where_it_matters(self):
        broken = self.trees / "broken"
        shutil.copytree(self.ept.parent, broken, copy_function=os.link)
        self.addCleanup(shutil.rmtree, broken)
        page = (4, 1, 1, 0)  # has the middle of PART
        (broken / "ept-hierarchy" / f"{key_of(page)}.json").unlink()
        out = self.folder / "no.csv"
        for cloud in (broken / "ept.json", self.address(broken / "ept.json")):
            self.draw(cloud, "--camera", self.far)
            refused = self.refuse(1, "export", cloud, "-o", out, "--box",
                                  ",".join(map(str, PART)), environment=self.environment)
            self.assertIn(key_of(page), refused.err)
            self.assertFalse(out.exists())
            refused = self.refuse(1, "render", cloud, "-o", self.folder / "no.png", "--size",
                                  "320x240", "--backend", "software", "--camera", self.near,
                                  environment=self.environment)
            self.assertIn(key_of(page), refused.err)
            refused = self.refuse(1, "verify", cloud, environment=self.environment)
            self.assertIn(key_of(page), refused.err)
        elsewhere = ",".join(map(str, (900.0, 900.0, 0.0, 930.0, 930.0, 9.0)))
        self.assertEqual(self.points(broken / "ept.json", "--box", elsewhere),
                         self.points(self.one_page, "--box", elsewhere))

    def test_pages_that_lie(self):
        """They name cells that are not below them, or pages above, or too few points."""
        below = (2, 0, 0, 0)
        for page, word in (('{"2-0-0-0": 1, "3-4-0-0": 1}', "3-4-0-0"),
                           ('{"2-0-0-0": -1}', "2-0-0-0"), ('{"2-0-0-0": 1, "0-0-0-0": -1}',
                                                            "0-0-0-0"), ("[]", "page")):
            with self.subTest(page):
                broken = self.trees / "lying"
                shutil.copytree(self.ept.parent, broken, copy_function=os.link)
                self.addCleanup(shutil.rmtree, broken, True)
                path = broken / "ept-hierarchy" / f"{key_of(below)}.json"
                path.unlink()
                path.write_text(page)
                refused = self.refuse(1, "export", broken / "ept.json", "-o",
                                      self.folder / "no.csv", environment=self.environment)
                self.assertIn(word, refused.err)
                shutil.rmtree(broken)
        few = write_ept(self.folder / "few", 4, STEP, points=86)
        refused = self.refuse(1, "export", few, "-o", self.folder / "no.csv")
        self.assertIn("lacks 1 of the 86 points", refused.err)
        _, facts, _ = self.draw(few, "--error", "0.01")
        self.assertEqual(facts["points_drawn"], 85)

    def test_a_source_is_not_written_over(self):
        some = write_ept(self.folder / "some", 4, STEP)
        leaf = some.parent / "ept-data" / "3-7-7-0.laz"
        before = leaf.read_bytes()
        refused = self.refuse(1, "export", some, "-o", leaf, "--force")
        self.assertTrue(re.search("3-7-7-0", refused.err), refused)
        self.assertEqual(leaf.read_bytes(), before)


if __name__ == "__main__":
    unittest.main()
