from os import PathLike
from typing import Any, Callable, Dict, Iterable, Iterator, List, Literal, Mapping, Optional, Protocol, Sequence, Tuple, Union

import numpy

# Stubs that VTK's generator makes for a wheel; elsewhere they are missing, and __getattr__ counts.
from .pointfrontCommon import *
from .pointfrontFiltersBuild import *
from .pointfrontFiltersExtract import *
from .pointfrontIOLASIndex import *
from .pointfrontIOStore import *
from .pointfrontRenderingCore import *
from .pointfrontRenderingOpenGL2 import *

_Path = Union[str, bytes, PathLike[str], PathLike[bytes]]
_Point = Tuple[float, float, float]
_Box = Union[Tuple[_Point, _Point], Sequence[float]]
_Progress = Union[None, bool, Callable[[str, float], Optional[bool]]]
_Classes = Union[None, int, Iterable[int]]

class _Columns(Protocol):
    """An opened .npz file, a data frame."""

    def keys(self) -> Iterable[str]: ...
    def __getitem__(self, name: str, /) -> Any: ...

__version__: str
VTK_PACKAGE: str

class PointFrontError(RuntimeError): ...
class PointFrontWarning(UserWarning): ...

class BuildReport:
    path: str
    points_read: int
    points_stored: int
    points_rejected: int
    points_outside: int
    files_skipped: int
    nodes: int
    bytes_written: int
    warnings: List[str]

def build(
    inputs: Union[_Path, Iterable[_Path], Mapping[str, Any], _Columns, numpy.ndarray],
    output: _Path,
    *,
    structure: str = ...,
    refinement: str = ...,
    layers: str = ...,
    normals: str = ...,
    attributes: Optional[Iterable[str]] = ...,
    color_from: Union[_Path, Iterable[_Path]] = ...,
    box: Optional[_Box] = ...,
    progress: _Progress = ...,
    **options: Any,
) -> BuildReport: ...
def index(
    las: _Path, side: Optional[_Path] = ..., *, overwrite: bool = ..., node_points: int = ...
) -> str: ...

class Picture:
    png: bytes
    def __init__(self, png: bytes) -> None: ...
    def save(self, path: _Path) -> None: ...
    @property
    def pixels(self) -> numpy.ndarray: ...
    def __array__(self, dtype: Any = ..., copy: Optional[bool] = ...) -> numpy.ndarray: ...

class Cloud:
    def __init__(self, path: _Path) -> None: ...
    def close(self) -> None: ...
    def __enter__(self) -> "Cloud": ...
    def __exit__(self, *_: Any) -> None: ...
    @property
    def path(self) -> str: ...
    def __len__(self) -> int: ...
    @property
    def bounds(self) -> Tuple[_Point, _Point]: ...
    @property
    def attributes(self) -> List[str]: ...
    @property
    def classes(self) -> Dict[int, str]: ...
    @property
    def info(self) -> Dict[str, Any]: ...
    @property
    def crs(self) -> Optional[str]: ...
    def extract(
        self,
        *,
        box: Optional[_Box] = ...,
        sphere: Optional[Tuple[_Point, float]] = ...,
        area: Optional[str] = ...,
        classes: _Classes = ...,
        where: Optional[str] = ...,
        spacing: Optional[float] = ...,
        attributes: Union[None, str, Iterable[str]] = ...,
        progress: _Progress = ...,
        **options: Any,
    ) -> Any: ...
    def points(
        self,
        *,
        box: Optional[_Box] = ...,
        sphere: Optional[Tuple[_Point, float]] = ...,
        area: Optional[str] = ...,
        classes: _Classes = ...,
        where: Optional[str] = ...,
        spacing: Optional[float] = ...,
        attributes: Union[None, str, Iterable[str]] = ...,
        progress: _Progress = ...,
        **options: Any,
    ) -> Dict[str, numpy.ndarray]: ...
    def chunks(
        self,
        size: int = ...,
        *,
        box: Optional[_Box] = ...,
        sphere: Optional[Tuple[_Point, float]] = ...,
        area: Optional[str] = ...,
        classes: _Classes = ...,
        where: Optional[str] = ...,
        spacing: Optional[float] = ...,
        attributes: Union[None, str, Iterable[str]] = ...,
        progress: _Progress = ...,
        **options: Any,
    ) -> Iterator[Dict[str, numpy.ndarray]]: ...
    def export(
        self,
        path: _Path,
        *,
        box: Optional[_Box] = ...,
        sphere: Optional[Tuple[_Point, float]] = ...,
        area: Optional[str] = ...,
        classes: _Classes = ...,
        where: Optional[str] = ...,
        spacing: Optional[float] = ...,
        crs: Optional[str] = ...,
        overwrite: bool = ...,
        progress: _Progress = ...,
        line_distance: float = ...,
        **options: Any,
    ) -> int: ...
    def to_pyvista(self, **query: Any) -> Any: ...
    def add_to(
        self,
        plotter: Any,
        *,
        scalars: Optional[str] = ...,
        cmap: Any = ...,
        clim: Optional[Tuple[float, float]] = ...,
        show_scalar_bar: Optional[bool] = ...,
        scalar_bar_args: Optional[Dict[str, Any]] = ...,
        point_size: Optional[float] = ...,
        error: float = ...,
        complete: bool = ...,
        style: Any = ...,
        name: Optional[str] = ...,
        opacity: float = ...,
        pickable: bool = ...,
        reset_camera: Optional[bool] = ...,
        render: bool = ...,
    ) -> Any: ...
    def screenshot(
        self,
        path: Optional[_Path] = ...,
        *,
        size: Tuple[int, int] = ...,
        color_by: Optional[str] = ...,
        view: Optional[str] = ...,
        camera: Union[None, _Path, Dict[str, Any]] = ...,
        technique: Optional[str] = ...,
        style: Union[None, _Path, Dict[str, Any]] = ...,
        classes: _Classes = ...,
        where: Optional[str] = ...,
        error: Optional[float] = ...,
        background: Optional[Tuple[int, int, int]] = ...,
        **options: Any,
    ) -> Picture: ...
    def show(self, *, size: Tuple[int, int] = ..., title: Optional[str] = ...) -> Any: ...

def open(
    path: _Path,
    *,
    headers: Optional[Mapping[str, str]] = ...,
    token: Optional[str] = ...,
    offline: Optional[bool] = ...,
    cache: Union[None, _Path, Literal[False]] = ...,
    cache_size: Union[None, int, str] = ...,
    timeout: Optional[float] = ...,
) -> Cloud: ...
def traffic() -> Dict[str, int]: ...

# The wrapped VTK classes: vtkPointFrontReader, vtkPointFrontMapper ...
def __getattr__(name: str) -> Any: ...
