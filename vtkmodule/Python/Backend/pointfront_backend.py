"""Builds the wheel by scikit-build-core, also for Python 3.11, which VTK's SDK does not name.

cvista-sdk asks for Python 3.12, whose stable interface its wrapping uses. Its headers and tools
make modules for one version, too, and cvista has libraries for 3.11. So for 3.11 a copy of the SDK
is taken into build/ and changed: it finds that Python, and links its cvista's wrapping library.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from scikit_build_core import build as _scikit
from scikit_build_core.build import *

_ROOT = pathlib.Path(__file__).resolve().parents[3]
_NAMED = (3, 12)  # by the SDK
_VERSION = "{}.{}".format(*sys.version_info)


def _replace(file, before, after):
    text = file.read_text()
    if before not in text:
        raise RuntimeError(f"{file} does not say '{before}': this SDK is another than was known")
    file.write_text(text.replace(before, after))


def _adapt(sdk):
    import cvista

    named = "{}.{}".format(*_NAMED)
    _replace(sdk / "cmake/vtk-config.cmake", "set(CVISTA_ABI3 ON)", "set(CVISTA_ABI3 OFF)")
    data = next((sdk / "content").glob("vtk-*.data")) / "headers/cmake"
    _replace(data / "VTK-vtk-module-find-packages.cmake", f"\n    {named}\n", f"\n    {_VERSION}\n")
    library = "libvtkWrappingPythonCore{}-cvista.so"
    _replace(data / "VTK-targets-release.cmake", library.format(named), library.format(_VERSION))
    there = next((sdk / "content").rglob(library.format(named))).parent
    shutil.copy(pathlib.Path(cvista.__file__).parent / library.format(_VERSION), there)


def _sdk():
    """The folder that the copy is in; loaded from the package index once."""
    package = re.search(r"cvista-sdk==[0-9.]+", (_ROOT / "pyproject.toml").read_text()).group(0)
    target = _ROOT / "build" / f"{package}-python{_VERSION}"
    if not target.exists():
        target.parent.mkdir(exist_ok=True)
        with tempfile.TemporaryDirectory(dir=target.parent) as folder:
            unfinished = pathlib.Path(folder) / "sdk"
            subprocess.run([sys.executable, "-m", "pip", "install", "--quiet", "--no-deps",
                            "--ignore-requires-python", "--disable-pip-version-check",
                            "--target", unfinished, package], check=True)
            _adapt(unfinished / "cvista_sdk")
            try:
                unfinished.rename(target)
            except OSError:
                if not target.exists():  # or another build was faster
                    raise
    return target


def _find_sdk():
    if sys.version_info < _NAMED:
        sys.path.insert(0, str(_sdk()))  # where scikit-build-core looks for CMake packages


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    _find_sdk()
    return _scikit.build_wheel(wheel_directory, config_settings, metadata_directory)


def build_editable(wheel_directory, config_settings=None, metadata_directory=None):
    _find_sdk()
    return _scikit.build_editable(wheel_directory, config_settings, metadata_directory)
