"""Rules about docs/papers.md: what it names is there. Each gives (path, line, message)."""

import re

PAGE = "docs/papers.md"
ITEM = re.compile(r"\* \*(Code|Tests)\*:")
QUOTED = re.compile(r"`([^`]+)`")
TEST = re.compile(r"\bTEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\)")


def named(file):
    """(line, "Code" or "Tests", name) of what is between backticks in such an item."""
    kind = None
    for number, line in file.numbered():
        item = ITEM.match(line)
        kind = item.group(1) if item else kind if line.startswith("  ") else None
        for name in QUOTED.findall(line) if kind else ():
            yield number, kind, name


def paths_of(files):
    """Every path with and without its ending, every folder, and each end of them."""
    paths = set()
    for file in files:
        words = file.path.split("/")
        for end in range(1, len(words) + 1):
            for begin in range(end):
                path = "/".join(words[begin:end])
                paths.update((path, path.rsplit(".", 1)[0]))
    return paths


def has_test(name, tests, paths):
    """Whether a test has that name, in which an end of `*` or `...` stands for any."""
    if name.startswith("Whole."):
        snake = re.sub(r"(?<=[a-z])(?=[A-Z])", "_", name.split(".")[1]).lower()
        return f"Testing/Whole/test_{snake}.py" in paths
    suite, _, rest = name.rpartition(".") if not name.endswith("...") else name[:-3].rpartition(".")
    whole = not name.endswith(("*", "..."))
    rest = rest.rstrip("*")
    return any((not suite or suite == of) and (test == rest if whole else test.startswith(rest))
               for of, test in tests)


def papers(files):
    """The files, folders and tests that docs/papers.md names as Code and Tests are there."""
    pages = [file for file in files if file.path == PAGE]
    if not pages:
        return
    paths, code = paths_of(files), [file for file in files if file.is_cpp]
    words = {word for file in code for line in file.lines for word in re.findall(r"\w+", line)}
    tests = {found for file in code for found in TEST.findall("\n".join(file.lines))}
    for number, kind, name in named(pages[0]):
        if kind == "Code":
            there = name.rstrip("/") in paths if "::" not in name \
                else all(word in words for word in name.split("::"))
        else:
            there = has_test(name, tests, paths)
        if not there:
            yield PAGE, number, f"{name} is not there"
