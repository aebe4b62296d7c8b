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
