#!/usr/bin/python3
"""A Markdown table of what a command says in JSON, a row for each way to run it.

    Testing/Benchmarks/json_table.py --first HEAD --row NAME=WORDS... --column HEAD=FIELD...
      [--runs N] COMMAND

COMMAND is one of bash. `{words}` in it becomes the WORDS of a row, `{json}` a file for what it
says; without `{json}` the command prints it. FIELD is `name.name/DIVISOR:FORMAT`, for example
`frame_ms.p50:.0f`, `peak_rss_bytes/1048576:,.0f` or `benchmarks.0.p50_ms` (of a list's first). A
DIVISOR is a number or another name; there may be several: `points/seconds/1e6:.1f`.
With --runs all rows run N times in turn, and a cell is the median.
"""

import argparse
import json
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

FIELD = re.compile(r"(?P<path>[\w.]+)(?P<divisors>(?:/[\w.]+)*)(?::(?P<format>.+))?$")
NUMBER = re.compile(r"[\d.]+(?:e\d+)?")


def told_by(command, words):
    """Runs the command with these words and returns what it says."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "told.json"
        text = command.replace("{words}", words).replace("{json}", str(file))
        done = subprocess.run(["bash", "-euo", "pipefail", "-c", text], check=False, text=True,
                              stdout=subprocess.PIPE)
        if done.returncode != 0:
            sys.exit(f"status {done.returncode}: {text}")
        return json.loads(file.read_text() if file.exists() else done.stdout)


def value_at(told, path):
    value = told
    for name in path.split("."):
        value = value[int(name) if isinstance(value, list) else name]
    return value


def number_of(told, field):
    value = value_at(told, field["path"])
    for divisor in field["divisors"].split("/")[1:]:
        value /= float(divisor) if NUMBER.fullmatch(divisor) else value_at(told, divisor)
    return value


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--first", default="", help="the head of the rows' names")
    parser.add_argument("--row", action="append", required=True, metavar="NAME=WORDS")
    parser.add_argument("--column", action="append", required=True, metavar="HEAD=FIELD")
    parser.add_argument("--runs", type=int, default=1)
    parser.add_argument("command")
    given = parser.parse_args()
    rows = [row.split("=", 1) for row in given.row]
    columns = [column.rsplit("=", 1) for column in given.column]
    fields = [FIELD.match(field) for _, field in columns]
    if not all(fields):
        parser.error("a FIELD is name.name/DIVISOR:FORMAT")
    told = [[told_by(given.command, words) for _, words in rows] for _ in range(given.runs)]
    print(f"| {given.first} | " + " | ".join(head for head, _ in columns) + " |")
    print("| --- |" + " ---: |" * len(columns))
    for place, (name, _) in enumerate(rows):
        cells = [format(statistics.median(number_of(run[place], field) for run in told),
                        field["format"] or "") for field in fields]
        print(f"| {name} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
