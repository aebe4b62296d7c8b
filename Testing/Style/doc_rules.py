"""Rules about the documentation. Each gives (path, line, message) for every fault."""

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
MEASURED = ("README.md", "docs/tradeoffs.md", "docs/papers.md")
COMMAND = re.compile(r"<!-- table(?: \d+)?(?: by hand)?: (.+) -->")
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
