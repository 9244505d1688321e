"""Measure exactly how well 3D shapes stack, and change them so that they stack.

    >>> import stackabilization as st
    >>> result = st.measure("chair.obj", direction=(0, 0, 1))
    >>> result.f_max, result.height, result.stackability
    (0.8224..., 0.8623..., 0.0349...)

Functions are named as the commands of the program `stackabilize`, and their keywords as its options, with
an underscore in the place of a hyphen. A mesh is a path, a pair of arrays (vertices, faces), a `Mesh`, or an
object of trimesh, Open3D, PyVista or VTK. Results cannot be changed; `to_dict()` of each is what the program
writes with `--json`.

Lengths are in model units; directions are three numbers, not all zero, of any length, used exactly as given.
Errors say what was expected: `InputError` and `UsageError` are ValueErrors. Ctrl-C ends a call at once, and
`progress=f` calls f(step, fraction) now and then.

The same input gives the same numbers, whatever the number of threads.
"""

import atexit as _atexit

from . import _core
from ._commands import (compare, deform, draft, drop, gap, hold, inspect, items, map, measure, search, separation, stack,
                        structure, suggest, validate)
from ._core import Error, InputError, Mesh, OutputError, RenderError, UsageError
from ._core import version as __version__
from ._improvement import Design, Improvement, improve, improvement
from ._mesh import load
from ._results import (Comparison, Contact, Deformation, Draft, Drop, Findings, Gap, Gradient, Gradients, Holding,
                       Inspection, Items, LoadItem, Map, Measurement, Nest, Result, Search, Separation, Stack, Structure, Suggestion, Suggestions, Touch,
                       Validation, Witness)
from ._solver import Measurements, Solver

_atexit.register(_core.end_of_interpreter)

__all__ = [
    "Comparison", "Contact", "Deformation", "Design", "Draft", "Drop", "Error", "Findings", "Gap", "Gradient", "Gradients", "Holding", "Improvement", "InputError",
    "Inspection", "Items", "LoadItem", "Map", "Measurement", "Measurements", "Mesh", "Nest", "OutputError", "RenderError", "Result",
    "Search", "Separation", "Solver", "Stack", "Structure", "Suggestion", "Suggestions", "Touch", "UsageError",
    "Validation", "Witness", "compare", "deform", "draft", "drop", "gap", "hold", "improve", "improvement", "inspect", "items", "load", "map", "measure", "search",
    "separation", "stack", "structure", "suggest", "validate",
]
