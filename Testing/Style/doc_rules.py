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
