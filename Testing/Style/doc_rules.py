"""Rules about the documentation. Each gives (path, line, message) for every fault."""

import hashlib
import os
import re

LINKED_NAME = re.compile(r"\[`([^`]+)`\]\(([^)#\s]+\.(?:h|cxx))\)")
NAME = re.compile(r"[A-Za-z_]\w*")


def linked_names(files):
    """A name of C++ that the documentation links to a file is in that file."""
    held = {os.path.normpath(file.path): file for file in files if file.is_cpp}
    for file in files:
        for number, line in file.numbered() if file.ends(".md") else ():
            for text, target in LINKED_NAME.findall(line):
                path = os.path.normpath(os.path.join(*file.folders, target))
                if path not in held:
                    continue  # the rule Links reports it
                source = held[path]
                words = set(NAME.findall("\n".join(source.lines)))
                wanted = [] if text == source.name else NAME.findall(text)
                for name in wanted:
                    if name not in words:
                        yield file.path, number, f"{name} is not in {path}"


ANCHOR = re.compile(r"\]\(([^)#\s]*)#([^)\s]+)\)")
HEADING = re.compile(r"#{1,6} (.*)")


def anchors_of(file):
    """Names of a page's headings, as hosts of repositories make them."""
    names = set()
    for line in file.lines:
        heading = HEADING.match(line)
        if heading:
            plain = re.sub(r"[`*]|\]\([^)]*\)|\[", "", heading.group(1)).lower()
            names.add(re.sub(r"[^\w\- ]", "", plain).replace(" ", "-"))
    return names


def anchors(files):
    """Links of the documentation to a heading lead to one."""
    pages = {os.path.normpath(file.path): file for file in files if file.ends(".md")}
    for file in pages.values():
        for number, line in file.numbered():
            for target, name in ANCHOR.findall(line):
                path = os.path.join(*file.folders, target) if target else file.path
                path = os.path.normpath(path)
                if path in pages and name not in anchors_of(pages[path]):
                    yield file.path, number, f"{path} has no heading {name}"


# Pages whose tables of numbers Testing/Benchmarks/tables makes.
MEASURED = ("README.md", "docs/tradeoffs.md", "docs/papers.md", "docs/promise.md")
COMMAND = re.compile(r"<!-- table(?: \d+)?: (.+) -->")
CALLED = re.compile(r"Testing/Benchmarks/(\w+(?:\.py)?)|\bpointfront(\w+)Benchmark\b")


def is_of_numbers(rows):
    """At least half of a table's filled cells, but for its head and first column, are numbers."""
    cells = [cell.strip() for row in rows[2:] for cell in row.strip("|").split("|")[1:]]
    cells = [cell for cell in cells if cell]
    numbers = [cell for cell in cells if re.match(r"[-+<]?\.?\d", cell)]
    return 2 * len(numbers) >= len(cells) > 0


def table_commands(files):
    """A table of numbers of a MEASURED page has its command, which calls what is there."""
    there = {file.path for file in files}
    for file in files:
        for number, line in file.numbered() if file.path in MEASURED else ():
            before = file.lines[number - 2] if number > 1 else ""
            command = COMMAND.match(line)
            if line.startswith("|") and not before.startswith("|"):
                end = number - 1
                while end < len(file.lines) and file.lines[end].startswith("|"):
                    end += 1
                after = file.lines[end] if end < len(file.lines) else ""
                marked = COMMAND.match(before) and after == "<!-- end of table -->"
                if is_of_numbers(file.lines[number - 1:end]) and not marked:
                    yield file.path, number, "a table of numbers without its command"
            for script, program in CALLED.findall(command.group(1)) if command else ():
                path = f"Testing/Benchmarks/{script or program.lower() + '.cxx'}"
                if path not in there:
                    yield file.path, number, f"{path} is not there"


# The programs of each table: a line has the first digits of two SHA-256, those of the table's
# command, and of the programs that the command calls with the results that its numbers follow from.
# Testing/Benchmarks/tables writes it.
MADE = "docs/tradeoffs/made.txt"
# A checksum of each thing that the tool makes of small clouds; Whole.SameBits compares them.
RESULTS = "docs/tradeoffs/results.txt"
# Programs whose tables have more than times, and the kinds of results that these follow from.
FOLLOWS = {
    "Testing/Benchmarks/truth_tradeoff.py": ("store", "picture"),
    "Testing/Benchmarks/promise.py": ("store", "picture", "told"),
    "Testing/Benchmarks/precision_tradeoff.py": ("store", "picture"),
    "Testing/Benchmarks/refinement_tradeoff.py": ("store", "picture", "told"),
    "Testing/Benchmarks/flicker.cxx": ("store", "picture"),
}
# Tables of docs/tradeoffs/curve.csv are compared with it by Whole.Curve; ages are git's.
MADE_OTHERWISE = ("curve_tables.py", "--ages")


def digest(text):
    return hashlib.sha256(text.encode()).hexdigest()[:12]


def programs_of(command):
    """The files of the programs that a table's command calls, without repetition."""
    return list(dict.fromkeys(f"Testing/Benchmarks/{script or program.lower() + '.cxx'}"
                              for script, program in CALLED.findall(command)))


def results_of(programs, results):
    """The lines of RESULTS that tables of these programs follow from."""
    kinds = {kind for path in programs for kind in FOLLOWS.get(path, ())}
    return [line for line in results.split("\n")
            if line.partition(" ")[2].partition(":")[0] in kinds]


def made_line(command, text_of):
    """The line of MADE for a table that was made by its programs as they are now, of the results
    that the tool has now."""
    programs = programs_of(command)
    texts = [text_of(path) for path in programs]
    texts += results_of(programs, text_of(RESULTS))
    return f"{digest(command)} {digest(''.join(texts))}"


def old_tables(files):
    """A table of numbers is not older than the programs that its command calls, nor than the
    stores and pictures that its numbers follow from."""
    text = {file.path: "\n".join(file.lines) for file in files}
    made = text.get(MADE, "").split("\n")
    for file in files:
        for number, line in file.numbered() if file.path in MEASURED else ():
            marked = COMMAND.match(line)
            if marked and not any(word in marked.group(1) for word in MADE_OTHERWISE) \
                    and made_line(marked.group(1), lambda path: text.get(path, "")) not in made:
                yield file.path, number, "a table that is older than its program or than what " \
                    "the tool makes: make it anew by Testing/Benchmarks/tables (or --still), or " \
                    "take it away"
