"""What may stand for a mesh, and for the arguments of a command."""

import numbers
import os

import numpy

from . import _core
from ._core import InputError, Mesh, UsageError


def load(path, *, format=None, unit=None, up=None, labels=None):
    """Read a mesh file and return a Mesh.

    path: .obj, .off, .ply, .stl, .3mf, .gltf or .glb; format: its format, when the extension does not say it;
    unit: unit of its coordinates; up: its axis that points up ('x', 'y' or 'z'), which becomes z; labels: a
    file of part labels. Coordinates are exactly the doubles in the file. Raises InputError naming the place.
    """
    return _core.read(arguments_of({"format": format, "unit": unit, "up": up, "labels": labels}) +
                      ["--", os.fspath(path)])


def arguments_of(options):
    """Keywords as the program's arguments. None and False leave an option out, True gives a flag."""
    arguments = []
    for key, value in options.items():
        name = "-n" if key == "n" else "--" + key.replace("_", "-")
        for values in _repeated(key, value):
            arguments.append(name)
            arguments.extend(values)
    return arguments


def _repeated(key, value):
    """The texts of an option, a list per time that it is given."""
    if value is None or value is False or isinstance(value, numpy.bool_) and not value:
        return []
    if value is True or isinstance(value, numpy.bool_):
        return [[]]
    if isinstance(value, dict):
        return [[f"{name}={_text(key, one)}"] for name, one in value.items()]
    if isinstance(value, numpy.ndarray):
        value = value.tolist()
    if not isinstance(value, (list, tuple, set, frozenset)):
        return [[_text(key, value)]]
    if all(isinstance(one, numbers.Real) for one in value):
        return [[_text(key, one) for one in value]]
    return [texts for one in value for texts in _repeated(key, one)]


def _text(key, value):
    """A value as it is typed: numbers with as many digits as bring them back."""
    if isinstance(value, (str, os.PathLike)):
        return os.fspath(value)
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))
    raise UsageError(f"{key} expects a number, a text or a list of these, found {type(value).__name__}")


def _from_polydata(polydata):
    """The arrays of a vtkPolyData."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    points = vtk_to_numpy(polydata.GetPoints().GetData())
    cells = polydata.GetPolys()
    return points, _triangles(vtk_to_numpy(cells.GetData()))


def _triangles(flat):
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


def _arrays_of(mesh):
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


def is_path(mesh):
    """Does it name a file?"""
    return isinstance(mesh, (str, os.PathLike))


def as_mesh(mesh):
    """The Mesh that an argument stands for; arrays are copied once, a Mesh is taken as it is."""
    if isinstance(mesh, Mesh):
        return mesh
    if is_path(mesh):
        return load(mesh)
    arrays = _arrays_of(mesh)
    if arrays is None:
        raise InputError("a mesh expects a path, a pair of arrays (vertices, faces), a Mesh, or an object of trimesh, "
                         f"Open3D, PyVista or VTK, found {type(mesh).__name__}")
    return Mesh(*arrays)

