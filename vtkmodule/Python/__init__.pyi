from os import PathLike
from typing import Any, Callable, Dict, Iterable, List, Optional, Tuple, Union

import numpy

_Path = Union[str, PathLike[str]]
_Point = Tuple[float, float, float]

__version__: str

class PointFrontError(RuntimeError): ...

class BuildReport:
    path: str
    points_read: int
    points_stored: int
    points_rejected: int
    files_skipped: int
    nodes: int
    bytes_written: int
    warnings: List[str]

def build(
    inputs: Union[_Path, Iterable[_Path]],
    output: _Path,
    *,
    structure: str = ...,
    refinement: str = ...,
    layers: str = ...,
    normals: str = ...,
    attributes: Optional[Iterable[str]] = ...,
    color_from: Union[_Path, Iterable[_Path]] = ...,
    progress: Optional[Callable[[str, float], Optional[bool]]] = ...,
    **options: Any,
) -> BuildReport: ...
def index(
    las: _Path, side: Optional[_Path] = ..., *, overwrite: bool = ..., node_points: int = ...
) -> str: ...

class Cloud:
    def __init__(self, path: _Path) -> None: ...
    @property
    def path(self) -> str: ...
    @property
    def points(self) -> int: ...
    def __len__(self) -> int: ...
    @property
    def bounds(self) -> Tuple[_Point, _Point]: ...
    @property
    def attributes(self) -> List[str]: ...
    @property
    def classes(self) -> Dict[int, str]: ...
    def query(
        self, *, area: Optional[str] = ..., where: Optional[str] = ..., **options: Any
    ) -> Dict[str, numpy.ndarray]: ...

def open(path: _Path) -> Cloud: ...

# The wrapped VTK classes: vtkPointFrontReader, vtkPointFrontMapper ...
def __getattr__(name: str) -> Any: ...
