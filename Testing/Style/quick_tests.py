#!/usr/bin/python3
"""Testing/quick-leaves-out.txt names tests that exist, and `scripts/test quick` runs the shorter
tests that it names in their place.

    quick_tests.py LIST CTEST BUILD
"""

import pathlib
import re
import subprocess
import sys

MOST_GROUPS = 8  # CMake's regular expressions have nine, and one is around the whole list


def rows(text):
    """(pattern, names of the tests in its place) of each line that says something."""
    for line in text.splitlines():
        if line and not line.startswith("#"):
            pattern, *instead = line.split()
            yield pattern, instead


def faults(text, tests):
    """Yields what is wrong with the list, as sentences; `tests` are the names of all tests."""
    listed = list(rows(text))
    left_out = re.compile("|".join(pattern for pattern, _ in listed))
    if left_out.groups > MOST_GROUPS:
        yield f"{left_out.groups} groups in parentheses: CTest would leave out no test at all"
    for pattern, instead in listed:
        if not any(re.fullmatch(pattern, name) for name in tests):
            yield f"no test is called {pattern}"
        if not instead:
            yield f"{pattern}: name the tests that look at the same thing"
        for name in instead:
            # Tests of a suite have a name each, but under sanitizers.
            found = [test for test in tests if test == name or test.startswith(name + ".")]
            if not found:
                yield f"{pattern}: there is no test {name}"
            if any(left_out.fullmatch(test) for test in found):
                yield f"{pattern}: {name} is left out itself"


def names_of(ctest, build):
    """The names of all tests of a build tree."""
    shown = subprocess.run([ctest, "--test-dir", build, "-N"], check=True, capture_output=True,
                           text=True).stdout
    return re.findall(r"Test +#\d+: (\S+)", shown)


def main():
    list_file, ctest, build = sys.argv[1:]
    tests = names_of(ctest, build)
    if any(name.endswith(("_NOT_BUILT", "_is_not_built")) for name in tests):
        print("not every test program is built: their tests have no names yet")
        sys.exit(77)  # CTest takes it as skipped
    wrong = list(faults(pathlib.Path(list_file).read_text(), tests))
    print(*wrong, sep="\n")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
