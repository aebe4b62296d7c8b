"""The version of the project is written once."""

import re

PROJECT = re.compile(r"project\(PointFront VERSION (\d+\.\d+\.\d+)")
WRITTEN = (".cmake", ".in", ".toml", ".xml", ".json", ".py", ".pyi", ".h", ".cxx", ".module",
           ".plugin")


def one_version(files):
    """CMakeLists.txt has the version; CHANGELOG.md begins with it; nothing else repeats it."""
    root = next((file for file in files if file.path == "CMakeLists.txt"), None)
    match = root and PROJECT.search("\n".join(root.lines))
    if not match:
        yield "CMakeLists.txt", 1, "project(PointFront VERSION a.b.c) is not there"
        return
    version = match.group(1)
    literal = re.compile(r"(?<![\d.])" + re.escape(version) + r"(?![\d.])")
    for file in files:
        if file.path == "CHANGELOG.md":
            heads = [n for n, line in file.numbered() if line.startswith("## ")]
            if not heads or not literal.search(file.lines[heads[0] - 1]):
                yield file.path, heads[0] if heads else 1, f"its first version is not {version}"
        elif file.path != "CMakeLists.txt" and (
                file.ends(*WRITTEN) or file.name == "CMakeLists.txt"):
            for number, line in file.numbered():
                line = line.split("//")[0] if file.is_cpp else line  # comments may give examples
                if literal.search(line):
                    yield file.path, number, f"repeats the version {version}"
