"""Designs that stack better, as they are found."""

import fractions
import json

import numpy

from . import _core, _results
from ._commands import Inputs, command_line


class Design(_results.Structured):
    """A shape that meets the target and every requirement, or the nearest one."""

    __slots__ = ()
    _shown = ("name", "stackability", "explanation")
    name: str = _results.field("'solution_1' and so on; 'design' for one that was found on the way; 'nearest'.")
    direction: numpy.ndarray = _results.field("(3,) along which copies are stacked.", convert=_results.vector)
    target: float = _results.field("S that was asked for.")
    stackability: float = _results.field("S of the design.")
    stackability_before: float = _results.field("S of the shape at rest along the same direction.")
    f_max: float = _results.field("Model units.")
    f_max_exact: fractions.Fraction = _results.field("In units of the direction.", convert=_results.fraction)
    height: float = _results.field("Of one copy along the direction, model units.")
    explanation: tuple = _results.field("What changes, in words.", convert=_results.lines)
    edits: list = _results.field("A dict per edit: text, as `deform` takes it, words, reason and numbers.",
                                 convert=_results.copied)
    change: dict = _results.field("Of the vertices, fractions of the diagonal: root_mean_square and largest.",
                                  convert=_results.copied)
    requirements: list = _results.field("A dict per requirement: name, value, demanded, passed.",
                                        convert=_results.copied)
    stack: dict = _results.field("Copies on top of each other: height_before, height, saving.",
                                 convert=_results.copied)
    holding: "dict | None" = _results.field("How that stack holds, as a Holding; None where copies pass each other.",
                                            convert=_results.copied)
    good: bool = _results.field("Are target and requirements met, and does the mesh confirm it?")

    @property
    def vertices(self):
        """(n, 3) float64, model units, in the order of the mesh at rest; a read-only view."""
        return self.mesh.vertices


class Improvement(_results.OfModel):
    """How a search for designs ended."""

    __slots__ = ("_meshes", "_texts")
    _shown = ("reached", "solutions")

    def __init__(self, document, meshes, texts):
        super().__init__(document)
        object.__setattr__(self, "_meshes", meshes)
        object.__setattr__(self, "_texts", texts)

    def _design(self, one):
        return Design(one, self._meshes[one["name"]], self._texts[one["name"]])

    reached: bool = _results.field("Is there a solution, and is each of them good?")
    target: dict = _results.field("What was asked for.", convert=_results.copied)
    diagnosis: "dict | None" = _results.field("Without a solution: what blocks, and what would help.",
                                              convert=_results.copied)
    search: dict = _results.field("How the search ended and what it did.", convert=_results.copied)
    front: "list | None" = _results.field("With `front`: a dict per design, that at rest first.",
                                          convert=_results.copied)

    @property
    def solutions(self):
        """The solutions, a Design each, that of least change first."""
        return tuple(self._design(one) for one in self._document["solutions"])

    @property
    def nearest(self):
        """Without solutions, the Design that came nearest; else None."""
        one = self._document["nearest"]
        return None if one is None else self._design(one)


def improve(mesh, *, target=None, copies=None, within=None, solutions=None, front=False, direction=None,
            semantics=None, boxes=None, model=None, preset=None, least=None, effort=None, time=None, expansions=None,
            alpha=None, bend=False, cone_degrees=None, keep=None, only=None, change_height=False, box_tolerance=None,
            thickness=None, clearance=None, lateral_clearance=None, draft_degrees=None, standing=None,
            tilt_degrees=None, friction=None, rest_on=None, relax=None, any_quality=False, remove=None, twist=False,
            segmentation=None, segments=None, seeds=None, primitive=None, sections=None, symmetry_tolerance=None, joint_reach=None,
            ctrl=None, grp=None, format=None, unit=None, up=None, labels=None, threads=None, progress=None):
    """Change a design as little as possible so that it stacks as asked for.

    A generator: it yields a Design whenever the search finds one that meets everything, and these are named
    'design'; then the solutions, that of least change first, named 'solution_1' and so on. What it returns,
    the value of `yield from`, is an Improvement; `improvement(...)` returns that at once. To close the
    generator ends the search.

    target: stackability to be reached; or copies: so many within the length `within`. solutions: how many
    different ones (default: 3). front: designs from rest to the target, or as far as it goes.
    direction: to stack along, or several, the first is preferred. keep: parts that stay; only: parts that
    may be edited; change_height: the height may change; box_tolerance: the sides of the box may, by this
    fraction; thickness: of walls that must remain; clearance, lateral_clearance: air between copies along
    and across the direction (model units or texts such as '2mm'); draft_degrees: of walls where copies touch;
    standing: so many copies stand; tilt_degrees: on a floor tilted so far; friction: between copies, which
    then neither jam nor slide; rest_on: the part of the copy below on which copies rest, or 'PART=FRACTION';
    relax: limits of quality, names or a dict from name to value; any_quality: no such limits; remove: parts
    to leave out first.
    effort: how much work (1 takes up to about 40 seconds on two cores); time: seconds; expansions: of
    candidates. preset: 'refined' (default) or 'paper'; least: 'both' (default), 'distortion' or
    'displacement'; alpha, bend, cone_degrees, twist, semantics, boxes, model: see the manual of the program.
    Other keywords: as in `structure`. progress: called as progress(step, fraction) in the calling thread.
    """
    options = {"target": target, "copies": copies, "within": within, "solutions": solutions, "front": front,
               "direction": direction, "semantics": semantics, "boxes": boxes, "model": model, "preset": preset,
               "least": least, "effort": effort, "time": time, "expansions": expansions, "alpha": alpha, "bend": bend,
               "cone_degrees": cone_degrees, "keep": keep, "only": only, "change_height": change_height,
               "box_tolerance": box_tolerance, "thickness": thickness, "clearance": clearance,
               "lateral_clearance": lateral_clearance, "draft_degrees": draft_degrees, "standing": standing,
               "tilt_degrees": tilt_degrees, "friction": friction, "rest_on": rest_on, "relax": relax,
               "any_quality": any_quality, "remove": remove,
               "twist": twist, "segmentation": segmentation, "segments": segments, "seeds": seeds,
               "primitive": primitive, "sections": sections, "symmetry_tolerance": symmetry_tolerance,
               "joint_reach": joint_reach, "ctrl": ctrl, "grp": grp, "format": format, "unit": unit, "up": up,
               "labels": labels, "threads": threads, "no_pictures": True, "output": "designs"}
    inputs = Inputs()
    arguments = command_line("improve", [inputs.name_of(mesh, "<mesh>", "improve")], options)
    return _designs(_core.ImprovementRun(arguments, inputs.meshes, inputs.projects), progress)


def _designs(run, progress):
    try:
        while (found := run.next(progress)) is not None:
            text, mesh = found
            yield Design(json.loads(text), mesh, None)
        _, text, meshes, texts = run.result()
    finally:
        run.stop()
    improvement = Improvement(json.loads(text), meshes, texts)
    yield from improvement.solutions
    return improvement


def improvement(mesh, **options):
    """Run `improve` to its end and return the Improvement: solutions, or why there are none."""
    designs = improve(mesh, **options)
    while True:
        try:
            next(designs)
        except StopIteration as end:
            return end.value
