"""Where the comments of a file begin, by its language."""

import ast
import io
import re
import tokenize

CPP_MARK = re.compile(r"///?<?|//!<?")
HASH_MARK = re.compile(r"#+:?")
# Text in quotes, which may hold a #, or a # that begins a word: a comment.
QUOTED_OR_COMMENT = re.compile(r"\"(?:\\.|[^\"\\])*(?:\"|$)|'[^']*(?:'|$)|(?<!\S)#.*")


def lines_of_cpp(file):
    """Yields line number, code before the comment, and comment, of each line of C++ or GLSL."""
    for (number, line), code in zip(file.numbered(), file.code_lines()):
        code = code.rstrip()
        comment = line[len(code):].strip()
        mark = CPP_MARK.match(comment)
        yield number, code.strip(), comment[mark.end():].strip() if mark else None


def lines_of_python(file):
    """Yields the same of Python, for the lines that have a comment."""
    text = "\n".join(file.lines) + "\n"
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT:
            row, column = token.start
            mark = HASH_MARK.match(token.string)
            yield row, token.line[:column].strip(), token.string[mark.end():].strip()


def lines_of_hash(file):
    """Yields the same of shell and CMake. A quote is taken to end in its line."""
    for number, line in file.numbered():
        for match in QUOTED_OR_COMMENT.finditer(line):
            if match.group().startswith("#"):
                mark = HASH_MARK.match(match.group())
                yield number, line[:match.start()].strip(), match.group()[mark.end():].strip()


def docstrings(file):
    """Yields line number and text of each docstring of a Python file."""
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
    for node in ast.walk(ast.parse("\n".join(file.lines))):
        if isinstance(node, documented) and ast.get_docstring(node):
            yield node.body[0].lineno, ast.get_docstring(node)


def beginnings(file):
    """Yields line number and text of each comment's first line, and of each docstring.

    A comment that stands alone in its line goes on where the line above it was one, too."""
    if file.is_cpp or file.is_shader:
        lines = lines_of_cpp(file)
    elif file.is_python:
        lines = lines_of_python(file)
        yield from docstrings(file)
    elif file.is_cmake or file.is_script:
        lines = lines_of_hash(file)
    else:
        return
    last_alone = -1  # the line of the last comment without code
    for number, code, comment in lines:
        if comment is None:
            continue
        if code or number != last_alone + 1:
            yield number, comment
        last_alone = -1 if code else number
