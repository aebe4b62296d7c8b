"""COPC and EPT as they are: drawn, described, brought out and queried without a copy."""

import json
import os
import random
import shutil
import struct
import unittest

from tool import DATA, ToolTest, pointfront, run

COPC = DATA / "copc"
COPC_FILES = ("lone-star", "ellipsoid_200k", "1.2-with-color")
EPT = DATA / "ept/lone-star-laszip"


class InPlace(ToolTest):
    def expect_same(self, one, other, points, *names):
        compared = run(os.environ["POINTFRONT_COMPARE_POINTS"], one, other, *names)
        self.assertEqual(compared.status, 0, compared)
        self.assertEqual(int(compared.out), points)

    def test_every_point_comes_out(self):
        for name in COPC_FILES:
            file = COPC / f"{name}.copc.laz"
            out = self.folder / f"{name}.laz"
            self.succeed("export", file, "-o", out)
            count = self.succeed("info", file, "--json").json["points"]
            self.expect_same(file, out, count, "intensity", "classification", "gps_time")
            self.assertEqual(self.succeed("verify", file, "--json").json["points_checked"], count)
        out = self.folder / "ept.las"
        self.succeed("export", EPT / "ept.json", "-o", out)
        stored = self.folder / "stored.las"
        self.succeed("export", self.build(EPT / "ept.json"), "-o", stored)
        self.expect_same(stored, out, 518862, "intensity", "classification", "gps_time")
        # Binary nodes; the tree lacks five of its ten points, so only a build brings them out.
        text = self.folder / "bcbf.xyz"
        refused = pointfront("export", DATA / "ept/bcbf/ept.json", "-o", text)
        self.assertEqual(refused.status, 1, refused)
        self.assertIn("5 of 10 points", refused.err)
        self.succeed("export", self.build(DATA / "ept/bcbf", name="bcbf.pfront"), "-o", text)
        self.assertEqual(len(text.read_text().splitlines()), 5 + 1)

    def test_what_is_missing_is_no_answer(self):
        """A page of the hierarchy cut short, an entry of 0 points, a key left out, a first look."""
        whole = (COPC / "1.2-with-color.copc.laz").read_bytes()
        broken = self.folder / "x.copc.laz"
        root, size = struct.unpack_from("<QQ", whole, 375 + 54 + 40)
        cut, none = bytearray(whole), bytearray(whole)
        struct.pack_into("<Q", cut, 375 + 54 + 48, size // 64 * 32)
        struct.pack_into("<i", none, root + 28, 0)
        for content in (cut, none):
            broken.write_bytes(content)
            self.incomplete(broken)
        tree = self.folder / "tree"
        shutil.copytree(EPT, tree)
        page = tree / "ept-hierarchy/0-0-0-0.json"
        keys = json.loads(page.read_text())
        keys.pop(max(keys))
        page.write_text(json.dumps(keys))
        self.incomplete(tree)
        tiles = self.folder / "tiles"
        tiles.mkdir()
        shutil.copyfile(DATA / "laz/autzen_trim.laz", tiles / "a.laz")
        self.incomplete(tiles)

    def incomplete(self, cloud):
        out = self.folder / "out.las"
        for arguments in (["export", cloud, "-o", out], ["verify", cloud]):
            outcome = pointfront(*arguments)
            self.assertEqual(outcome.status, 1, outcome)
            self.assertRegex(outcome.err, r"[0-9]+ of (the )?[0-9]+ points")
        self.assertFalse(out.exists())

    def test_a_store_that_is_linked_counts_once(self):
        tiles = self.folder / "linked"
        tiles.mkdir()
        store = self.build(DATA / "las/real/autzen_trim.las")
        shutil.copyfile(store, tiles / "a.pfront")
        os.link(tiles / "a.pfront", tiles / "b.pfront")
        (tiles / "c.pfront").symlink_to(tiles / "a.pfront")
        points = self.succeed("info", store, "--json").json["points"]
        self.assertEqual(self.succeed("verify", tiles, "--json").json["points_checked"], points)
        outcome = self.succeed("export", tiles, "-o", self.folder / "linked.las")
        self.assertIn(f" {points} points", outcome.out)
        self.assertIn("2 of 3 names are links", outcome.err)

    def test_a_box_is_what_a_filter_of_all_points_gives(self):
        whole = self.folder / "all.xyz"
        self.succeed("export", COPC / "1.2-with-color.copc.laz", "-o", whole)
        points = [tuple(map(float, line.split()[:3]))
                  for line in whole.read_text().splitlines()[1:]]
        self.assertEqual(len(points), 1065)
        generator = random.Random(7)
        part = self.folder / "part.xyz"
        for _ in range(12):
            a, b = generator.choice(points), generator.choice(points)
            low = [min(x, y) - 0.005 for x, y in zip(a, b)]  # between two steps
            high = [max(x, y) + 0.005 for x, y in zip(a, b)]
            wanted = sum(all(l <= v <= h for l, v, h in zip(low, p, high)) for p in points)
            self.succeed("export", COPC / "1.2-with-color.copc.laz", "-o", part, "--force",
                         "--box", ",".join(map(repr, low + high)))
            self.assertEqual(len(part.read_text().splitlines()) - 1, wanted, (low, high))

    def test_pictures(self):
        for file in (COPC / "lone-star.copc.laz", EPT / "ept.json", EPT):
            png, stats = self.folder / "x.png", self.folder / "s.json"
            self.succeed("render", file, "-o", png, "--stats", stats, "--color-by", "intensity")
            self.assertGreater(png.stat().st_size, 10000)

    def test_info_tells_the_tree(self):
        for file, nodes, levels in ((COPC / "lone-star.copc.laz", 15, 3),
                                    (EPT / "ept.json", 13, 4)):
            info = self.succeed("info", file, "--json").json
            self.assertEqual((info["structure"], info["nodes"], info["levels"]),
                             ("octree", nodes, levels))
            self.assertIn("13 nodes" if nodes == 13 else "15 nodes",
                          self.succeed("info", file).out)

    def damaged(self, at, data):
        path = self.folder / "damaged.copc.laz"
        content = bytearray((COPC / "lone-star.copc.laz").read_bytes())
        content[at:at + len(data)] = data
        path.write_bytes(content)
        return path

    def test_damage_is_told(self):
        info, root = 375 + 54, 2704713
        for at, data, says in (
                (info + 24, struct.pack("<d", -1.0), "cube"),            # half size
                (info + 40, struct.pack("<Q", 1 << 40), "hierarchy"),    # first page
                (root + 28, struct.pack("<i", 58392), "chunk"),          # points of the root
                (root + 32, struct.pack("<i", 99), "no cell"),           # a level
                (root + 16, struct.pack("<Q", 1 << 50), "do not lie"),   # where its points are
                (root + 32 + 4, struct.pack("<3i", 1, 1, 0), "twice")):
            error = self.refuse(1, "verify", self.damaged(at, data)).err
            self.assertIn(says, error)
        # A node in the wrong cell: what a query would leave out without a word.
        path = self.damaged(root + 32 + 4, struct.pack("<3i", 0, 0, 1))
        self.assertIn("outside of its cell", self.refuse(
            1, "export", path, "-o", self.folder / "x.xyz").err)

    def test_a_missing_node_is_told(self):
        tree = self.folder / "tree"
        shutil.copytree(EPT, tree)
        next(iter(sorted((tree / "ept-data").glob("2-*.laz")))).unlink()
        self.refuse(1, "export", tree, "-o", self.folder / "x.xyz")

    def test_outputs_do_not_replace_what_is_read(self):
        file = self.folder / "a.copc.laz"
        shutil.copyfile(COPC / "1.2-with-color.copc.laz", file)
        self.refuse(1, "export", file, "-o", file, "--force")
        self.assertEqual(file.read_bytes(), (COPC / "1.2-with-color.copc.laz").read_bytes())


if __name__ == "__main__":
    unittest.main(verbosity=2)
