"""The exception and the warning of the package."""

import difflib
import pathlib
import sys
import warnings

_PACKAGE = str(pathlib.Path(__file__).parent)


class PointFrontError(RuntimeError):
    """Something asked of PointFront did not happen. The message says what, where, what to try."""


class PointFrontWarning(UserWarning):
    """Something was not as it should be, and the work went on. A full sentence says what."""


def did_you_mean(name, known):
    """The end of every message about a name that does not exist, empty if no known one is near."""
    near = difflib.get_close_matches(name, list(known), n=1, cutoff=0.7)
    return f"; did you mean '{near[0]}'?" if near else ""


def warn(texts):
    """Raises each as a PointFrontWarning, at the first caller outside of this package."""
    level, frame = 2, sys._getframe(1)
    while frame is not None and frame.f_code.co_filename.startswith(_PACKAGE):
        level, frame = level + 1, frame.f_back
    for text in texts:
        warnings.warn(text, PointFrontWarning, stacklevel=level)
