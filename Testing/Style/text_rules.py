"""Rules about single files. Each gives (path, line, message) for every place that breaks it."""

import os
import re
import shutil
import subprocess

from comments import beginnings

FILE_LINES = 450
FUNCTION_LINES = 60
SHADER_LINES = 150
COLUMNS = 100
LONGER = re.compile(r"^(//|#) Longer than \d+ lines: \w+")  # the first line, and the reason
FOLDER_FILES = 40
CLANG_FORMAT = ("clang-format-14", "clang-format")  # other releases format otherwise


def file_length(files):
    """No file is longer than 450 lines, no shader than 150, unless its first line says why."""
    for file in files:
        if not file.is_code or LONGER.match(file.lines[0] if file.lines else ""):
            continue
        limit = SHADER_LINES if file.is_shader else FILE_LINES
        if len(file.lines) > limit:
            yield file.path, len(file.lines), f"{len(file.lines)} lines, at most {limit}"


def folder_size(files):
    """No folder holds more than 40 files of C++, tests' folders neither."""
    folders = {}
    for file in files:
        if file.is_cpp:
            folders.setdefault("/".join(file.folders), []).append(file)
    for folder, held in sorted(folders.items()):
        if len(held) > FOLDER_FILES:
            yield folder, len(held), f"{len(held)} files, at most {FOLDER_FILES}"


def clang_format():
    """The program of release 14; None if there is none."""
    for name in CLANG_FORMAT:
        program = shutil.which(name)
        if program is None:
            continue
        said = subprocess.run([program, "--version"], capture_output=True, text=True, check=True)
        if re.search(r"version 14\.", said.stdout):
            return program
    return None


def formatting(files):
    """C++ is as clang-format 14 writes it."""
    program = clang_format()
    if program is None:
        yield "clang-format", 14, "is not there; scripts/setup installs it"
        return
    sources = [file for file in files if file.is_cpp]
    for begin in range(0, len(sources), 200):
        paths = [os.path.join(file.root, file.path) for file in sources[begin:begin + 200]]
        said = subprocess.run([program, "--dry-run", "-Werror", "--ferror-limit=1", *paths],
                              capture_output=True, text=True, check=False)
        for match in re.finditer(r"^(.*?):(\d+):\d+: error:", said.stderr, flags=re.M):
            path = os.path.relpath(match.group(1), sources[0].root)
            yield path, int(match.group(2)), "not as clang-format writes it; run clang-format -i"


def line_length(files):
    """No line of code is longer than 100 columns."""
    for file in files:
        for number, line in file.numbered() if file.is_code else ():
            if len(line) > COLUMNS:
                yield file.path, number, f"{len(line)} columns, at most {COLUMNS}"


WITHOUT_SUBJECT = re.compile(r"(of|what)\b", re.IGNORECASE)


def comment_subjects(files):
    """No comment or docstring begins with "of" or "what": it names what it speaks of."""
    for file in files:
        for number, comment in beginnings(file):
            if WITHOUT_SUBJECT.match(comment):
                yield file.path, number, "a comment that begins with \"of\" or \"what\""


NOT_A_FUNCTION = re.compile(
    r"\s*(namespace|class|struct|union|enum|extern)\b"
    r"|\s*(if|else|for|while|do|switch|try|catch|case|default)\b"
)


def function_length(files):
    """No function is longer than 60 lines, from the first line of its head to its closing brace.

    Counts on braces that stand alone (Allman)."""
    for file in files:
        if not file.is_cpp:
            continue
        code = file.code_lines()
        for start, line in enumerate(code):
            if line.strip() != "{" or start == 0:
                continue
            head = start - 1
            while head > 0 and code[head - 1].strip() and code[head - 1].rstrip()[-1] not in ";{}":
                head -= 1
            text = " ".join(code[head:start])
            if "(" not in text or NOT_A_FUNCTION.match(text):
                continue
            close = re.compile(re.escape(line[: line.index("{")]) + r"\}")
            ends = (n for n in range(start + 1, len(code)) if close.match(code[n]))
            length = next(ends, len(code) - 1) - head + 1
            if length > FUNCTION_LINES:
                message = f"a function of {length} lines, at most {FUNCTION_LINES}"
                yield file.path, head + 1, message


MACHINE_PATH = re.compile(r"(^|[^a-zA-Z0-9_.])/(tmp|work|farm|root|home)/[a-z]")


def machine_paths(files):
    """Nothing names a folder of somebody's machine."""
    for file in files:
        for number, line in file.numbered():
            if MACHINE_PATH.search(line):
                yield file.path, number, "names a folder of one machine"


SYSTEM_PYTHON = "#!/usr/bin/python3"


def interpreters(files):
    """A script of Python names the system's Python: another may come first on the path."""
    for file in files:
        first = file.lines[0] if file.lines else ""
        if first.startswith("#!") and "python" in first and first != SYSTEM_PYTHON:
            yield file.path, 1, f"begins with {first}; write {SYSTEM_PYTHON}"


# Not of this machine, nor put together from what a program was told.
ADDRESS = re.compile(r"https?:" + r"//(?!localhost\b|[{\\])")


def addresses(files):
    """Scripts and CMake files name no host: packages come from where the machine gets its own."""
    for file in files:
        for number, line in file.numbered() if file.is_cmake or file.is_script else ():
            if ADDRESS.search(line):
                yield file.path, number, "names a host"


# Spelt so that this file does not break its own rule.
UNFINISHED = re.compile(
    r"\b(TO" r"DO|FIX" r"ME|XX" r"X|HA" r"CK|not imple" r"mented|unimple" r"mented|st" r"ub"
    r"|place" r"holder|for n" r"ow|dum" r"my)\b"
)


def unfinished(files):
    """No word that says that something is not done."""
    for file in files:
        for number, line in file.numbered() if file.is_code else ():
            if UNFINISHED.search(line):
                yield file.path, number, "says that something is not done"


IDLE_TEST = re.compile(r"GTEST_SKIP|DISABLED_|(EXPECT|ASSERT)_TRUE\(true\)|WILL_FAIL")


def idle_tests(files):
    """No test is switched off, skips itself, cannot fail or passes by failing anyhow."""
    for file in files:
        if not (file.is_cpp or file.is_cmake):
            continue
        for number, line in file.numbered():
            if IDLE_TEST.search(line):
                yield file.path, number, "a test that may assert nothing"


LIBRARY_ROOMS = ("vtkmodule", "IO", "Filters", "Rendering", "paraview-plugin")
LOUD = re.compile(r"(\b(exit|abort|printf|fprintf|puts)\s*\(|std::(cout|cerr|clog)\b)")
SWALLOWED = re.compile(r"catch\s*\(\s*\.\.\.\s*\)\s*\{\s*\}")


def quiet_libraries(files):
    """A library does not end the program, does not print and does not swallow exceptions."""
    for file in files:
        if not file.is_cpp or file.in_tests or file.folders[:1] == []:
            continue
        if file.folders[0] not in LIBRARY_ROOMS:
            continue
        code = file.code_lines()
        for number, line in enumerate(code, start=1):
            if LOUD.search(line):
                yield file.path, number, "a library that ends the program or prints"
        text = "\n".join(code)
        for match in SWALLOWED.finditer(text):
            yield file.path, text.count("\n", 0, match.start()) + 1, "swallows an exception"


LOCALE = re.compile(
    r"\bstd::(to(lower|upper)|is(alpha|alnum|space|upper|lower|punct|print|graph))\b"
)


# A program's own locale may write a comma in numbers; the tool never sets one.
POINT = re.compile(r"\b(strtod|stod|strtof|stof|atof)\b")
# Numbers of printf(); not the "%2f" of an address.
COMMA = re.compile(r'"(\\.|[^"\\])*?%(?![0-9A-Fa-f]{2})[-+#0]*(\d+|\*)?(\.(\d+|\*))?l?[efgEG]')


def letters(files):
    """Letters and numbers are read as ASCII has them, not as the process's locale does."""
    for file in files:
        if file.is_cpp and not file.in_tests:
            for number, line in enumerate(file.code_lines(), start=1):
                if LOCALE.search(line):
                    yield file.path, number, "asks the locale; Base/LetterCase.h asks ASCII"
                elif POINT.search(line) and file.folders[0] != "CommandLine":
                    yield file.path, number, "asks the locale; Base/NumberText.h does not"
                elif file.folders[0] in LIBRARY_ROOMS and COMMA.search(file.lines[number - 1]):
                    yield file.path, number, "writes a number by the locale; Base/NumberText.h " \
                        "does not"


LINK = re.compile(r"\]\(([^)#\s]+)[^)]*\)")


def links(files):
    """Links of the documentation to files of the project lead somewhere."""
    for file in files:
        for number, line in file.numbered() if file.ends(".md") else ():
            for target in LINK.findall(line):
                path = os.path.join(file.root, *file.folders, target)
                if ":" not in target and not os.path.exists(path):
                    yield file.path, number, f"{target} is not there"
