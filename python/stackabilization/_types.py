"""What arguments may be, for type checkers; nothing here is needed to run."""

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, Literal, Protocol, Union

import numpy
from numpy.typing import ArrayLike, NDArray

from ._core import Mesh
from ._results import Structured

Floats = NDArray[numpy.float64]
Vector = ArrayLike  #: three numbers
Path = Union[str, "os.PathLike[str]"]
Length = Union[float, str]  #: model units, or a text such as '2mm'
Names = Union[str, Sequence[str]]
Relaxed = Union[Names, Mapping[str, float]]
Progress = Callable[[str, float], object]

Semantics = Literal["solid", "closed"]
Boxes = Literal["oriented", "frame"]
Unit = Literal["um", "mm", "cm", "m", "in", "ft"]
Up = Literal["x", "y", "z"]
DeformationModel = Literal["controllers", "surface", "iwires", "gap-scaling"]
Segmentation = Literal["automatic", "given", "members", "whole", "components", "primitives", "shape-diameter"]
Primitives = Mapping[str, Literal["cuboid", "cylinder"]]


class VerticesAndFaces(Protocol):
    """As of trimesh."""

    @property
    def vertices(self) -> Any: ...
    @property
    def faces(self) -> Any: ...


class VerticesAndTriangles(Protocol):
    """As of Open3D."""

    @property
    def vertices(self) -> Any: ...
    @property
    def triangles(self) -> Any: ...


class PointsAndFaces(Protocol):
    """As of PyVista."""

    @property
    def points(self) -> Any: ...
    @property
    def faces(self) -> Any: ...


class PolyData(Protocol):
    """As of VTK."""

    def GetPoints(self) -> Any: ...
    def GetPolys(self) -> Any: ...


MeshLike = Union[Mesh, Path, tuple[ArrayLike, ArrayLike], VerticesAndFaces, VerticesAndTriangles, PointsAndFaces,
                 PolyData, Structured]
