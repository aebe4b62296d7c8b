#!/usr/bin/python3
"""Testing/longest-tests.txt names tests that exist, in the presets that `scripts/test` has built.

    longest_tests.py LIST CTEST BUILD PRESET...
"""

import pathlib
import re
import sys

from quick_tests import names_of

MAIN = "release"  # names of its tests have no preset before them
OTHERS = ("paraview", "asan", "tsan")


def preset_of(name):
    preset = name.split(".")[0]
    return preset if preset in OTHERS else MAIN


def faults(text, tests, presets):
    """Yields what is wrong with the list, as sentences; `tests` are the names of all tests."""
    for line in text.splitlines():
        if line.startswith("#"):
            continue
        row = re.fullmatch(r"\d+ (\S+)", line)
        if not row:
            yield f"not seconds and a name: {line}"
        elif preset_of(row[1]) in presets and row[1] not in tests:
            yield f"no test is called {row[1]}"


def main():
    list_file, ctest, build, *presets = sys.argv[1:]
    wrong = list(faults(pathlib.Path(list_file).read_text(), names_of(ctest, build), presets))
    print(*wrong, sep="\n")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
