"""`compare` on pictures written here, byte by byte: keys, exit codes, messages."""

import math
import struct
import unittest
import zlib

from tool import ToolTest

SKY, WALL, BLACK, WHITE = (10, 20, 30), (200, 150, 100), (0, 0, 0), (255, 255, 255)
KEYS = {"identical", "pixels", "psnr", "ssim", "share_over_8", "mean_difference",
        "holes", "bloat", "background"}


def chunk(kind, body):
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def png(rows):
    """A PNG file of rows of (red, green, blue)."""
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 2, 0, 0, 0)
    raw = b"".join(b"\0" + b"".join(bytes(pixel) for pixel in row) for row in rows)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(raw))
            + chunk(b"IEND", b""))


def scene(inside, outside, side=12):
    """A square of the one in the middle of the other: half of the width, a quarter of the area."""
    middle = range(side // 4, 3 * side // 4)
    return [[inside if x in middle and y in middle else outside for x in range(side)]
            for y in range(side)]


class Compare(ToolTest):
    def picture(self, name, rows):
        path = self.folder / name
        path.write_bytes(png(rows))
        return path

    def setUp(self):
        super().setUp()
        self.reference = self.picture("b.png", scene(WALL, SKY))
        self.mask = self.picture("m.png", scene(WHITE, BLACK))

    def test_a_picture_with_itself(self):
        outcome = self.succeed("compare", self.reference, self.reference, "--json")
        self.assertEqual(set(outcome.json), KEYS)
        self.assertEqual(outcome.json["identical"], True)
        self.assertEqual(outcome.json["pixels"], 144)
        self.assertEqual((outcome.json["psnr"], outcome.json["ssim"]), (None, 1.0))
        self.assertEqual((outcome.json["holes"], outcome.json["bloat"]), (None, None))
        self.assertIn("identical", self.succeed("compare", self.reference, self.reference).out)

    def test_faults_against_the_mask(self):
        rows = scene(WALL, SKY)
        rows[3][3] = rows[4][4] = SKY
        rows[0][0] = WALL
        rows[5][5] = (WALL[0] + 9, *WALL[1:])
        drawn = self.picture("a.png", rows)
        told = self.succeed("compare", drawn, self.reference, "--mask", self.mask, "--json").json
        self.assertEqual(told["pixels"], 36)
        self.assertAlmostEqual(told["holes"], 100 * 2 / 36)
        self.assertAlmostEqual(told["bloat"], 100 * 1 / 36)
        self.assertAlmostEqual(told["share_over_8"], 3 / 36)
        self.assertEqual(told["background"], list(SKY))
        squares = 2 * sum((a - b) ** 2 for a, b in zip(WALL, SKY)) + 81
        self.assertAlmostEqual(told["psnr"], 10 * math.log10(255 ** 2 * 3 * 36 / squares))
        self.assertLess(told["ssim"], 1)
        # Without a mask, what the reference draws on that background is the mask.
        background = ("--background", ",".join(map(str, SKY)))
        self.assertEqual(
            self.succeed("compare", drawn, self.reference, *background, "--json").json, told)
        whole = self.succeed("compare", drawn, self.reference, "--json").json
        self.assertEqual((whole["pixels"], whole["holes"]), (144, None))
        self.assertAlmostEqual(whole["share_over_8"], 4 / 144)

    def test_what_cannot_be_compared(self):
        wide = self.picture("wide.png", scene(WALL, SKY, 16))
        said = self.refuse(1, "compare", wide, self.reference)
        self.assertIn("16x16 and 12x12", said.err)
        said = self.refuse(1, "compare", self.reference, self.reference, "--mask", wide)
        self.assertIn("mask", said.err)
        self.assertEqual(said.out, "")
        cut = self.folder / "cut.png"
        cut.write_bytes(self.reference.read_bytes()[:-20])
        said = self.refuse(1, "compare", cut, self.reference, "--json")
        self.assertIn("cut.png", said.err)
        self.assertIn("cut short", said.err)
        cut.write_bytes(b"no picture at all")
        self.assertIn("not a PNG", self.refuse(1, "compare", self.reference, cut).err)
        self.refuse(1, "compare", self.reference, self.folder / "none.png")
        full = self.picture("full.png", scene(WHITE, WHITE))
        said = self.refuse(1, "compare", self.reference, self.reference, "--mask", full)
        self.assertIn("say its colour", said.err)

    def test_wrong_usage(self):
        self.refuse(2, "compare", self.reference)
        self.refuse(2, "compare", self.reference, self.reference, "--background", "red")
        self.refuse(2, "compare", self.reference, self.reference, "--tolerance", "3")


if __name__ == "__main__":
    unittest.main()
