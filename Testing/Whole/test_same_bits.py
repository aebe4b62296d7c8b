"""The same bits whatever the processor can do: with and without fused multiplication and addition,
with wide vectors and with none.

The compiler fuses nothing (Style.Contraction). Yet the C library chooses its functions (exp, pow,
tan ...) when the program starts, and some of them fuse where the processor can: their last bit is
another then. The library's tunables say here that the processor cannot.
Testing/Benchmarks/same_bits.py compares other builds, too, and other processors by an emulator.
"""

import pathlib
import platform
import sys
import unittest

from tool import TOOL, ToolTest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "Benchmarks"))
import same_bits  # noqa: E402 (found by the line above)

WITHOUT_FUSED = "GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2,-AVX2_Usable,-FMA_Usable"


RESULTS = pathlib.Path(__file__).resolve().parents[2] / "docs/tradeoffs/results.txt"


def is_debian_12():
    """Other systems have other versions of zstd, LASzip and libpng, which code alike otherwise."""
    release = platform.freedesktop_os_release()
    return (release.get("ID"), release.get("VERSION_ID")) == ("debian", "12")


@unittest.skipUnless(platform.machine() == "x86_64", "other processors have one way")
class SameBits(ToolTest):
    def test_the_processor_does_not_show_and_tables_are_of_these_results(self):
        first = same_bits.Maker([TOOL], self.folder / "first").make()
        self.assertGreater(len(first), 60)
        if is_debian_12():
            known = {name: digest for digest, _, name in (
                line.partition(" ") for line in RESULTS.read_text().splitlines())}
            self.assertEqual(
                same_bits.differing(first, known), [],
                "tables of docs are of other results: run Testing/Benchmarks/same_bits.py --work "
                "FOLDER TOOL --write docs/tradeoffs/results.txt, then the test Style.OldTables "
                "names the tables to be made anew")
        plain = ["env", WITHOUT_FUSED, "POINTFRONT_INSTRUCTIONS=portable", TOOL]
        other = same_bits.Maker(plain, self.folder / "other").make()
        self.assertEqual(same_bits.differing(first, other), [])

    def test_a_difference_is_seen(self):
        self.assertEqual(same_bits.differing({"a": "1", "b": "2"}, {"a": "1", "b": "3", "c": "4"}),
                         ["b", "c"])


if __name__ == "__main__":
    unittest.main()
