"""The project's files as the rules see them."""

import os
import re

CPP = (".h", ".hxx", ".cxx", ".cpp")
SHADER = (".glsl",)
SCRIPT = (".py", ".sh", ".cmake")
SKIPPED_FOLDERS = {".git", ".deps", ".cache", "__pycache__"}


class SourceFile:
    """One text file: its path relative to the root, with slashes, and its lines."""

    def __init__(self, root, path):
        self.root = root
        self.path = path
        with open(os.path.join(root, path), encoding="utf-8") as stream:
            self.lines = stream.read().split("\n")
        if self.lines and self.lines[-1] == "":
            self.lines.pop()

    @property
    def folders(self):
        return self.path.split("/")[:-1]

    @property
    def name(self):
        return self.path.split("/")[-1]

    def ends(self, *endings):
        return self.name.endswith(endings)

    @property
    def is_cpp(self):
        return self.ends(*CPP)

    @property
    def is_shader(self):
        return self.ends(*SHADER)

    @property
    def is_cmake(self):
        return self.ends(".cmake", ".cmake.in") or self.name == "CMakeLists.txt"

    @property
    def is_script(self):
        return self.ends(*SCRIPT) or self.folders[:1] in (["scripts"], [".ci"])

    @property
    def is_python(self):
        shebang = self.lines[0] if self.lines else ""
        return self.ends(".py", ".pyi") or bool(re.match(r"#!.*\bpython", shebang))

    @property
    def is_code(self):
        return self.is_cpp or self.is_shader or self.is_cmake or self.is_script

    @property
    def in_tests(self):
        return "Testing" in self.folders

    def numbered(self):
        return enumerate(self.lines, start=1)

    def code_lines(self):
        """Lines of C++ or GLSL without comments and without the insides of string literals."""
        text = "\n".join(self.lines)

        def blank(match):
            token = match.group(0)
            if token.startswith("/"):
                return re.sub(r"[^\n]", " ", token)
            return token[0] + re.sub(r"[^\n]", " ", token[1:-1]) + token[-1]

        pattern = r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\''
        return re.sub(pattern, blank, text, flags=re.S).split("\n")


def read_tree(root):
    """Every text file below `root`; build folders, hidden tool folders and binary data are not."""
    files = []
    for folder, names, leaves in os.walk(root):
        names[:] = sorted(
            n for n in names
            if n not in SKIPPED_FOLDERS and n != "build" and not n.startswith("build-")
        )
        for leaf in sorted(set(leaves) - SKIPPED_FOLDERS):  # .git is a file in a linked work tree
            path = os.path.relpath(os.path.join(folder, leaf), root).replace(os.sep, "/")
            try:
                files.append(SourceFile(root, path))
            except UnicodeDecodeError:
                continue  # a picture, a point cloud
    return files
