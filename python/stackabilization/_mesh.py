"""What may stand for a mesh, and for the arguments of a command."""

from __future__ import annotations

import numbers
import os
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, TypeGuard

import numpy

from . import _core
from ._core import InputError, Mesh, UsageError
from ._results import Structured

if TYPE_CHECKING:
    from ._types import MeshLike, Path, Unit, Up


def load(path: Path, *, format: str | None = None, unit: Unit | None = None, up: Up | None = None,
         labels: Path | None = None) -> Mesh:
    """Read a mesh file and return a Mesh.

    path: .obj, .off, .ply, .stl, .3mf, .gltf or .glb; format: its format, when the extension does not say it;
    unit: unit of its coordinates; up: its axis that points up ('x', 'y' or 'z'), which becomes z; labels: a
    file of part labels. Coordinates are exactly the doubles in the file. Raises InputError naming the place.
    """
    return _core.read(arguments_of({"format": format, "unit": unit, "up": up, "labels": labels}) +
                      ["--", checked_text("path", os.fspath(path))])


#: Keywords that are True or False, and those that are three numbers.
FLAGS = {"self_intersections", "bend", "change_height", "any_quality", "all", "front", "twist", "turn", "no_pictures",
         "separators"}
VECTORS = {"direction", "plane", "keep_extent", "fix_point"}


def arguments_of(options: Mapping[str, object]) -> list[str]:
    """Keywords as the program's arguments. None leaves an option out, and so does an empty list."""
    arguments = []
    for key, value in options.items():
        name = "-n" if key == "n" else "--" + key.replace("_", "-")
        for values in _repeated(key, value):
            arguments.append(name)
            arguments.extend(values)
    return arguments


def _repeated(key: str, value: Any) -> list[list[str]]:
    """The texts of an option, a list per time that it is given."""
    if key in FLAGS:
        if not isinstance(value, (bool, numpy.bool_)):
            raise UsageError(f"{key} expects True or False, found {value!r}")
        return [[]] if value else []
    if value is None:
        return []
    if isinstance(value, numpy.ndarray):
        value = value.tolist()
    if isinstance(value, dict):
        return [[f"{_text(key, name)}={_text(key, one)}"] for name, one in value.items()]
    if key in VECTORS:
        return _vectors(key, value)
    if key == "corner":
        return [[_text(key, one) for one in corner] for corner in value]
    if isinstance(value, (list, tuple, set, frozenset)):
        return [[_text(key, one)] for one in value]
    return [[_text(key, value)]]


def _vectors(key: str, value: Any) -> list[list[str]]:
    """Three numbers, or several times three."""
    if not isinstance(value, (list, tuple)):
        raise UsageError(f"{key} expects three numbers, found {value!r}")
    if any(isinstance(one, (list, tuple, numpy.ndarray)) for one in value):
        return [texts for one in value for texts in _vectors(key, one.tolist() if isinstance(one, numpy.ndarray) else one)]
    if len(value) != 3 or not all(isinstance(one, numbers.Real) for one in value):
        raise UsageError(f"{key} expects three numbers, found {value!r}")
    return [[_text(key, one) for one in value]]


def _text(key: str, value: object) -> str:
    """A value as it is typed: numbers with as many digits as bring them back."""
    if isinstance(value, (str, os.PathLike)):
        return checked_text(key, os.fspath(value))
    if isinstance(value, numbers.Real) and not isinstance(value, bool):
        return str(int(value)) if isinstance(value, numbers.Integral) else repr(float(value))
    raise UsageError(f"{key} expects a number, a text or a list of these, found {value!r}")


def checked_text(what: str, text: object) -> str:
    """The text, which the program takes in UTF-8 and without a character of value 0."""
    try:
        if isinstance(text, str) and b"\0" not in text.encode():
            return text
    except UnicodeEncodeError:
        pass
    raise UsageError(f"{what} expects a text in UTF-8, found {text!r}")


def _from_polydata(polydata: Any) -> tuple[Any, Any]:
    """The arrays of a vtkPolyData."""
    from vtkmodules.util.numpy_support import vtk_to_numpy  # type: ignore[import]

    if polydata.GetPoints() is None or polydata.GetPolys() is None or polydata.GetPolys().GetNumberOfCells() == 0:
        raise InputError("the vtkPolyData has no polygons")
    if hasattr(polydata, "GetStrips") and polydata.GetStrips().GetNumberOfCells() > 0:
        raise InputError("the vtkPolyData has triangle strips: triangulate the mesh first")
    return vtk_to_numpy(polydata.GetPoints().GetData()), _triangles(vtk_to_numpy(polydata.GetPolys().GetData()))


def _triangles(flat: Any) -> Any:
    """Triangles of VTK's flat list: the number of corners before the corners of each face."""
    flat = numpy.asarray(flat)
    if flat.ndim != 1:
        return flat
    if flat.size % 4 == 0 and (flat[::4] == 3).all():
        return flat.reshape(-1, 4)[:, 1:]
    row = place = 0
    while place < flat.size and flat[place] == 3:
        row, place = row + 1, place + 4
    corners = int(flat[place]) if place < flat.size else 0
    raise InputError(f"face {row} has {corners} corners, expected 3: triangulate the mesh first")


def _arrays_of(mesh: Any) -> tuple[Any, Any] | None:
    """The arrays behind an object, or None."""
    if isinstance(mesh, (tuple, list)) and len(mesh) == 2:
        return mesh[0], mesh[1]
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):  # trimesh
        return mesh.vertices, mesh.faces
    if hasattr(mesh, "vertices") and hasattr(mesh, "triangles"):  # Open3D
        return numpy.asarray(mesh.vertices), numpy.asarray(mesh.triangles)
    if hasattr(mesh, "points") and hasattr(mesh, "faces"):  # PyVista
        return mesh.points, _triangles(mesh.faces)
    if hasattr(mesh, "GetPoints") and hasattr(mesh, "GetPolys"):  # VTK
        return _from_polydata(mesh)
    return None


def is_path(mesh: object) -> TypeGuard[Path]:
    """Does it name a file?"""
    return isinstance(mesh, (str, os.PathLike))


def as_mesh(mesh: MeshLike) -> Mesh:
    """The Mesh that an argument stands for; arrays are copied once, a Mesh is taken as it is."""
    if isinstance(mesh, Mesh):
        return mesh
    if is_path(mesh):
        return load(mesh)
    if isinstance(mesh, Structured):
        if mesh.mesh is None:
            raise InputError(f"{mesh!r} has no mesh")
        return mesh.mesh
    arrays = _arrays_of(mesh)
    if arrays is None:
        raise InputError("a mesh expects a path, a pair of arrays (vertices, faces), a Mesh, a result that has one, "
                         f"or an object of trimesh, Open3D, PyVista or VTK, found {type(mesh).__name__}")
    return Mesh(*arrays)

