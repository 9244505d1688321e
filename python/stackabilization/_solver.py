"""Many directions of one mesh."""

import json

import numpy

from . import _core, _results
from ._mesh import as_mesh


class Measurements:
    """How well a mesh stacks along k directions."""

    __slots__ = ("_arrays",)

    def __init__(self, arrays):
        for array in arrays:
            array.setflags(write=False)
        object.__setattr__(self, "_arrays", arrays)

    def __setattr__(self, name, value):
        raise AttributeError("results cannot be changed")

    @property
    def f_max(self) -> numpy.ndarray:
        """(k,) smallest lifts that set a copy free, model units, within 1e-12 of the height."""
        return self._arrays[0]

    @property
    def height(self) -> numpy.ndarray:
        """(k,) heights of one copy along the directions, model units."""
        return self._arrays[1]

    @property
    def stackability(self) -> numpy.ndarray:
        """(k,) S along each; NaN for a flat mesh."""
        return self._arrays[2]

    def __len__(self):
        return len(self.f_max)

    def __repr__(self):
        best = f", best S {numpy.max(self.stackability):.6g}" if len(self) else ""
        return f"<Measurements: {len(self)} directions{best}>"


class Solver:
    """A mesh prepared for measurements along many directions; may be used from several threads at once.

    mesh: anything that stands for a mesh. It is copied once more, into the search tree of the solver.
    semantics, boxes: as in `measure`.
    """

    def __init__(self, mesh, *, semantics="solid", boxes="oriented"):
        self._name = str(mesh) if isinstance(mesh, str) else "<mesh>"
        self._solver = _core.Solver(as_mesh(mesh), semantics, boxes)

    @property
    def mesh(self):
        """The Mesh that was given, or that was made of what was given."""
        return self._solver.mesh

    def measure(self, direction=(0, 0, 1)):
        """Return what `stackabilization.measure` returns, quicker: the mesh is prepared already."""
        return _results.Measurement(json.loads(self._solver.measure(self._name, direction)))

    def measure_many(self, directions, *, threads=None, progress=None):
        """Measure along every row of `directions`; a Measurements.

        directions: (k, 3), none of them 0, 0, 0. A float64 array in C order is used without a copy.
        threads: at most so many (default: all); progress: called as progress(step, fraction). The
        interpreter's lock is released. Raises UsageError naming the first row that is no direction, before
        anything is measured.
        """
        return Measurements(self._solver.measure_many(directions, threads, progress))

    def separation(self, direction=(0, 0, 1)):
        """Return the exact f_max with its witness; a Separation, None when copies never collide."""
        return _results.separation_of(self._solver.separation(direction))

    def gradient(self, direction=(0, 0, 1)):
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

    def __repr__(self):
        return f"<Solver of {self.mesh!r}>"
