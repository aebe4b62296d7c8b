#!/usr/bin/python3
"""Fails if a benchmark is not a program of today's classes: nothing else compiles them every day.

usage: benchmarks_compile.py BUILD

BUILD has compile_commands.json. Looks at syntax and types; writes no object.
"""

import json
import pathlib
import shlex
import subprocess
import sys

ALONE = {"-c", "-MD"}
WITH_NEXT = {"-o", "-MT", "-MF"}


def checked(command):
    """The words of a compiler's call that look at the source and write nothing."""
    words, result = iter(command), []
    for word in words:
        if word in WITH_NEXT:
            next(words)
        elif word not in ALONE:
            result.append(word)
    return [*result, "-fsyntax-only"]


def broken(commands):
    """The files that do not compile; `commands` as compile_commands.json has them."""
    return [one["file"] for one in commands if subprocess.run(
        checked(shlex.split(one["command"])), cwd=one["directory"], check=False).returncode]


def main():
    commands = json.loads((pathlib.Path(sys.argv[1]) / "compile_commands.json").read_text())
    commands = [one for one in commands if "/Testing/Benchmarks/" in one["file"]]
    if not commands:
        sys.exit("compile_commands.json knows no source in Testing/Benchmarks")
    wrong = broken(commands)
    if wrong:
        sys.exit("the preset `bench` does not compile: " + ", ".join(wrong))
    print(f"{len(commands)} sources of benchmarks compile")


if __name__ == "__main__":
    main()
