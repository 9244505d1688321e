"""Many directions of one mesh."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy

from . import _core, _results
from ._mesh import as_mesh

if TYPE_CHECKING:
    from ._types import Boxes, Floats, MeshLike, Progress, Semantics, Vector


class Measurements(_results.Frozen):
    """How well a mesh stacks along k directions."""

    __slots__ = ("_f_max", "_height", "_stackability")
    _f_max: Floats
    _height: Floats
    _stackability: Floats

    def __init__(self, f_max: Floats, height: Floats, stackability: Floats) -> None:
        for slot, array in zip(self.__slots__, (f_max, height, stackability)):
            array.setflags(write=False)
            object.__setattr__(self, slot, array)

    @property
    def f_max(self) -> Floats:
        """(k,) smallest lifts that set a copy free, model units, within 1e-12 of the height."""
        return self._f_max

    @property
    def height(self) -> Floats:
        """(k,) heights of one copy along the directions, model units."""
        return self._height

    @property
    def stackability(self) -> Floats:
        """(k,) S along each; NaN for a flat mesh."""
        return self._stackability

    def to_dict(self) -> dict[str, Any]:
        """Lists of f_max, height and stackability; None in the place of NaN, as in JSON."""
        return {"f_max": self.f_max.tolist(), "height": self.height.tolist(),
                "stackability": [None if numpy.isnan(value) else value for value in self.stackability.tolist()]}

    def __len__(self) -> int:
        return len(self.f_max)

    def __repr__(self) -> str:
        best = f", best S {numpy.max(self.stackability):.6g}" if len(self) else ""
        return f"<Measurements: {len(self)} directions{best}>"


class Solver:
    """A mesh prepared for measurements along many directions; may be used from several threads at once.

    mesh: anything that stands for a mesh. It is copied once more, into the search tree of the solver.
    semantics, boxes: as in `measure`.
    """

    def __init__(self, mesh: MeshLike, *, semantics: Semantics = "solid", boxes: Boxes = "oriented") -> None:
        self._name = str(mesh) if isinstance(mesh, str) else "<mesh>"
        self._solver = _core.Solver(as_mesh(mesh), semantics, boxes)

    @property
    def mesh(self) -> _core.Mesh:
        """The Mesh that was given, or that was made of what was given."""
        return self._solver.mesh

    def measure(self, direction: Vector = (0, 0, 1)) -> _results.Measurement:
        """Return what `stackabilization.measure` returns, quicker: the mesh is prepared already."""
        return _results.Measurement(json.loads(self._solver.measure(self._name, direction)))

    def measure_many(self, directions: Vector, *, threads: int | None = None,
                     progress: Progress | None = None) -> Measurements:
        """Measure along every row of `directions`; a Measurements.

        directions: (k, 3), none of them 0, 0, 0. A float64 array in C order is used without a copy.
        threads: at most so many (default: all); progress: called as progress(step, fraction). The
        interpreter's lock is released. Raises UsageError naming the first row that is no direction, before
        anything is measured.
        """
        return Measurements(*self._solver.measure_many(directions, threads, progress))

    def separation(self, direction: Vector = (0, 0, 1)) -> _results.Separation | None:
        """Return the exact f_max with its witness; a Separation, None when copies never collide."""
        return _results.separation_of(self._solver.separation(direction))

    def gradient(self, direction: Vector = (0, 0, 1)) -> Floats | None:
        """Return a subgradient of f_max by the vertices, (n, 3), model units per model unit; see Gradient.

        Zero but for the corners of the two faces that cause f_max. None when copies never collide, or where a
        face without area attains it.
        """
        found = self.separation(direction)
        if found is None or found.gradient is None:
            return None
        by_vertices = numpy.zeros(self.mesh.vertices.shape)
        for face, rows in ((found.witness.upper_triangle, found.gradient.upper),
                           (found.witness.lower_triangle, found.gradient.lower)):
            numpy.add.at(by_vertices, self.mesh.faces[face], rows)
        return by_vertices

    def __repr__(self) -> str:
        return f"<Solver of {self.mesh!r}>"
