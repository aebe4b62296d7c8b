#!/usr/bin/python3
"""Each C++ source of a build is compiled so that a product and a sum are rounded twice, also where
the processor could round them once: else results would differ from machine to machine.

usage: contraction.py BUILD      exit 1 names sources that are not
"""

import json
import pathlib
import shlex
import sys

FLAG = "-ffp-contract=off"
UNDONE = ("-ffp-contract=fast", "-ffp-contract=on", "-ffast-math", "-Ofast",
          "-funsafe-math-optimizations", "-fassociative-math", "-freciprocal-math")


def contracting(commands):
    """The files whose compiler may change sums; `commands` as compile_commands.json has them."""
    wrong = []
    for one in commands:
        words = shlex.split(one["command"])
        last = max((at for at, word in enumerate(words) if word in (FLAG, *UNDONE)), default=None)
        cxx = one["file"].endswith((".cxx", ".cpp", ".cc"))
        if cxx and (last is None or words[last] != FLAG or set(UNDONE[2:]) & set(words)):
            wrong.append(one["file"])
    return wrong


def main():
    commands = json.loads((pathlib.Path(sys.argv[1]) / "compile_commands.json").read_text())
    wrong = contracting(commands)
    for file in wrong:
        print(f"{file}: is compiled without {FLAG}, or with what undoes it")
    return 1 if wrong or not commands else 0


if __name__ == "__main__":
    sys.exit(main())
