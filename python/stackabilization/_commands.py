"""The commands of the program as functions; every keyword is an option of the program."""

import json
import os
import typing

import numpy

from . import _core, _results
from ._mesh import arguments_of, as_mesh, checked_text, is_path


class Answer(typing.NamedTuple):
    """What a command of the program leaves."""

    document: dict
    meshes: dict  #: by the name that an option for an output was given
    texts: dict


#: Commands that go on from a structure instead of analysing a mesh.
_OF_PROJECTS = {"structure", "deform", "suggest", "compare", "improve"}


class Inputs:
    """Meshes and projects in memory, under names that are no files."""

    def __init__(self):
        self.meshes = {}
        self.projects = {}

    def name_of(self, mesh, name, command=None):
        """What the program is told to read: a path, or the name of something in memory."""
        if is_path(mesh):
            return checked_text("a path", os.fspath(mesh))
        if command in _OF_PROJECTS and isinstance(mesh, _results.Structured) and mesh.project is not None:
            self.projects[name] = mesh.project
        else:
            self.meshes[name] = as_mesh(mesh)
        return name


def command_line(command, positionals, options):
    """The arguments of a command. What begins with a hyphen may be a name too."""
    return [command, "--no-timing"] + arguments_of(options) + ["--"] + positionals


def run_command(command, mesh, options, progress=None, *, after=None, above=None, more=()):
    """Run a command of the program in this process."""
    inputs = Inputs()
    positionals = [inputs.name_of(mesh, "<mesh>", command)]
    if after is not None:
        positionals.append(inputs.name_of(after, "<after>"))
    if above is not None:
        positionals.append(inputs.name_of(above, "<above>"))
    positionals += [inputs.name_of(other, f"<mesh {number}>") for number, other in enumerate(more, 2)]
    if options.get("into") is not None:
        options = {**options, "into": inputs.name_of(options["into"], "<into>")}
    if options.get("onto") is not None:
        options = {**options, "onto": inputs.name_of(options["onto"], "<onto>")}
    arguments = command_line(command, positionals, options)
    _, text, meshes, texts = _core.run(arguments, inputs.meshes, inputs.projects, progress)
    return Answer(json.loads(text), meshes, texts)


def _table_of(text):
    """The numbers of a table with a heading, a row for each of its lines."""
    heading, _, rows = text.partition("\n")
    return numpy.array(rows.replace("\n", ",").rstrip(",").split(","), dtype=float).reshape(-1, heading.count(",") + 1)


def inspect(mesh, *, self_intersections=False, format=None, unit=None, up=None, labels=None):
    """Say what is in a mesh, and what is wrong with it.

    self_intersections: count the pairs of faces that intersect too (seconds on large meshes).
    format, unit, up, labels: how a file is read, see `load`; unit also says that of a mesh in memory.
    """
    options = {"self_intersections": self_intersections, "format": format, "unit": unit, "up": up, "labels": labels}
    return _results.Inspection(run_command("inspect", mesh, options).document)


def measure(mesh, *, direction=None, method=None, resolution=None, layer=None, semantics=None, boxes=None, format=None,
            unit=None, up=None, labels=None, threads=None):
    """Measure how well a mesh stacks along one direction.

    direction: three numbers, exact doubles (default: 0, 0, 1).
    method: 'exact' (default), or 'rays' or 'raster', which sample the surface; resolution: their samples
    along the longer side (default: 1024).
    layer: say how much of a copy lies within this of the one below when they touch, model units or a text such as
    '0.2mm' (`layer` of the result; for prints, with method 'exact').
    semantics: 'solid' (default): walls may slide along each other; 'closed': touching counts, for sheets.
    boxes: 'oriented' (default): minimal boxes, whatever the pose; 'frame': boxes along the axes.
    format, unit, up, labels: how a file is read, see `load`. threads: at most so many (default: all).
    """
    options = {"direction": direction, "method": method, "resolution": resolution, "layer": layer,
               "semantics": semantics, "boxes": boxes, "format": format, "unit": unit, "up": up, "labels": labels,
               "threads": threads}
    return _results.Measurement(run_command("measure", mesh, options).document)


def search(mesh, *, cone_degrees=None, direction=None, plane=None, certify=None, max_cells=None, semantics=None,
           boxes=None, format=None, unit=None, up=None, labels=None, threads=None, progress=None):
    """Find the direction along which a mesh stacks best.

    cone_degrees: look only within this angle around `direction` (default: everywhere, 0, 0, 1).
    plane: look only in the plane with this normal.
    certify: prove that no direction has an S larger by more than this, in (0, 1] (default: 0.001). The result's
    `bound` holds whether or not it comes that close (`proven`). max_cells: cells of directions to examine at most for
    that (default: 10000, with certify 200000; 0: no proof). semantics, boxes: as in `measure`; a bound is known for
    oriented boxes only.
    format, unit, up, labels: how a file is read, see `load`. threads: at most so many (default: all).
    progress: called as progress(step, fraction).
    """
    options = {"cone_degrees": cone_degrees, "direction": direction, "plane": plane, "certify": certify,
               "max_cells": max_cells, "semantics": semantics, "boxes": boxes, "format": format, "unit": unit, "up": up, "labels": labels, "threads": threads}
    return _results.Search(run_command("search", mesh, options, progress).document)


def map(mesh, *, step_degrees=None, semantics=None, boxes=None, format=None, unit=None, up=None, labels=None,
        threads=None, progress=None):
    """Measure the stackability along every direction.

    step_degrees: angle between directions, from 0.1 to 90 (default: 2). semantics, boxes: as in `measure`.
    format, unit, up, labels: how a file is read, see `load`. threads: at most so many (default: all).
    progress: called as progress(step, fraction).
    """
    options = {"step_degrees": step_degrees, "semantics": semantics, "boxes": boxes, "format": format, "unit": unit,
               "up": up, "labels": labels, "threads": threads, "output": "table"}
    answer = run_command("map", mesh, options, progress)
    return _results.Map(answer.document, _table_of(answer.texts["table"]))


def stack(mesh, *, n=None, into=None, direction=None, twist_degrees=None, period=None, place=None,
          turn=False, max_shift=None, clearance=None, lateral_clearance=None, layer=None, separators=False,
          within=None, semantics=None, boxes=None, format=None, unit=None, up=None, labels=None, threads=None):
    """Stack copies of a mesh, or lower it into another one.

    n: number of copies (default: 2), or 'max': as many as `within` holds. direction: they come from above along it
    (default: 0, 0, 1).
    twist_degrees: turn of each copy about the direction, or 'auto' for the best one; period: turn or flip
    copies in a cycle of this length, from 1 to 5, the best one found.
    place: 'given' (default), or 'best': each copy is shifted against the one below, by max_shift at most (default: a
    quarter of the longer side), and with turn turned, so that it comes to rest lowest.
    clearance: air between copies along the direction; lateral_clearance: sideways play that every contact
    allows; layer: lift copies by whole layers of a print, this thick; within: room along the direction. All four are
    model units, or texts such as '2mm'. separators: have the bodies that fill the gaps where they are narrow, too.
    into: a mesh that `mesh` is lowered into, at its place across the direction; then a Nest is returned.
    semantics, boxes: as in `measure`. format, unit, up, labels: how a file is read, see `load`.
    threads: at most so many (default: all).
    """
    options = {"n": n, "into": into, "direction": direction, "twist_degrees": twist_degrees, "period": period,
               "place": place, "turn": turn, "max_shift": max_shift, "clearance": clearance,
               "lateral_clearance": lateral_clearance, "layer": layer, "separators": separators, "within": within,
               "semantics": semantics, "boxes": boxes, "format": format, "unit": unit, "up": up, "labels": labels,
               "threads": threads}
    answer = run_command("stack", mesh, options)
    if into is not None:
        return _results.Nest(answer.document)
    return _results.Stack(answer.document, answer.meshes.get("separators"))


def gap(mesh, above, *, direction=None, semantics=None, format=None, unit=None, up=None, labels=None, threads=None):
    """Say how far `above` can come down along a direction before it touches `mesh`, signed and exact; a Gap.

    direction: from `mesh` to `above` (default: 0, 0, 1). semantics: as in `measure`.
    format, unit, up, labels: how a file is read, see `load`. threads: at most so many (default: all).
    """
    options = {"direction": direction, "semantics": semantics, "format": format, "unit": unit, "up": up,
               "labels": labels, "threads": threads}
    return _results.Gap(run_command("gap", mesh, options, above=above).document)


def drop(mesh, *, onto, place=None, least=None, overlap=None, turn=False, corner=None, eps=None, max_cells=None,
         map=False, step=None, direction=None, semantics=None, format=None, unit=None, up=None, labels=None,
         threads=None, progress=None):
    """Let a mesh come down onto another one, at its place or at the best one; a Drop.

    onto: what it falls on. place: 'given' (default), or 'best', with a proof; turn: it may turn, too.
    least: what the best place has the least of: 'height' (default), 'gap', the mean distance of the two where one lies
    above the other, or 'volume', the empty space below. overlap: with 'gap', area in which one lies above the other,
    at least, as a share of the smaller one's (default: 0.5).
    corner: corners (x, y) of a polygon that its centre stays in. eps: how close the proof comes, model units or
    a text such as '1mm'; max_cells: cells of places to examine at most.
    map: have the height at every place of a grid, too, as `heights`; step: distance between these places, model units
    or a text (default: 1/32 of what it falls on).
    direction: it comes down against it (default: 0, 0, 1). semantics: as in `measure`.
    format, unit, up, labels: how a file is read, see `load`. threads: at most so many (default: all).
    progress: called as progress(step, fraction).
    """
    options = {"onto": onto, "place": place, "least": least, "overlap": overlap, "turn": turn, "corner": corner,
               "eps": eps, "max_cells": max_cells, "map": "table" if map else None, "step": step,
               "direction": direction, "semantics": semantics, "format": format, "unit": unit, "up": up,
               "labels": labels, "threads": threads}
    answer = run_command("drop", mesh, options, progress)
    return _results.Drop(answer.document, _table_of(answer.texts["table"]) if map else None)


def items(mesh, *more, direction=None, clearance=None, lateral_clearance=None, step=None, copies=None, semantics=None,
          format=None, unit=None, up=None, labels=None, threads=None):
    """Make the item table of a load planner: boxes and nesting heights in whole numbers; Items.

    more: further meshes. A path may be that of a folder of meshes.
    direction: upwards in the stack (default: 0, 0, 1). clearance: air between copies along the direction;
    lateral_clearance: sideways play that every contact allows. step: length that the whole numbers count (default:
    '1mm'). All three are model units, or texts such as '2mm'. copies: of each item (default: 1); it stands in the table.
    semantics: as in `measure`. format, unit, up, labels: how a file is read, see `load`; format and labels are for one
    mesh. threads: at most so many (default: all).
    """
    options = {"direction": direction, "clearance": clearance, "lateral_clearance": lateral_clearance, "step": step,
               "copies": copies, "semantics": semantics, "format": format, "unit": unit, "up": up, "labels": labels,
               "threads": threads, "output": "table"}
    answer = run_command("items", mesh, options, more=more)
    return _results.Items(answer.document, answer.texts["table"])


def hold(mesh, *, n=None, direction=None, semantics=None, friction=None, side_gap=None, format=None, unit=None, up=None,
         labels=None, threads=None):
    """Say how a stack of copies holds: whether it stands, slides, centres itself or jams; a Holding.

    n: number of copies (default: 2). direction: of the stack (default: 0, 0, 1). semantics: as in `measure`.
    friction: coefficient between copies (default: 0.3). side_gap: walls that are closer than this across the direction
    are tight, model units or a text such as '2mm' (default: a thousandth of the diagonal). format, unit, up, labels: how
    a file is read, see `load`. threads: at most so many (default: all).
    """
    options = {"n": n, "direction": direction, "semantics": semantics, "friction": friction, "side_gap": side_gap,
               "format": format, "unit": unit, "up": up, "labels": labels, "threads": threads}
    return _results.Holding(run_command("hold", mesh, options).document)


def draft(mesh, *, direction=None, draft_degrees=None, format=None, unit=None, up=None, labels=None, threads=None):
    """Say what of a mesh is undercut, so that neither half of a mould can leave it, and how much draft the rest has; a Draft.

    direction: the halves part along it (default: 0, 0, 1). draft_degrees: draft that is enough (default: 1).
    format, unit, up, labels: how a file is read, see `load`. threads: at most so many (default: all).
    """
    options = {"direction": direction, "draft_degrees": draft_degrees, "format": format, "unit": unit, "up": up,
               "labels": labels, "threads": threads, "output": "table"}
    answer = run_command("draft", mesh, options)
    return _results.Draft(answer.document, _table_of(answer.texts["table"]))


def validate(mesh, *, direction=None, format=None, unit=None, up=None, labels=None, threads=None):
    """Find f_max by independent methods: height fields, collision tests and, for small meshes, Minkowski sums.

    direction: three numbers (default: 0, 0, 1). format, unit, up, labels: how a file is read, see `load`.
    threads: at most so many (default: all).
    """
    options = {"direction": direction, "format": format, "unit": unit, "up": up, "labels": labels, "threads": threads}
    return _results.Validation(run_command("validate", mesh, options).document)


def separation(below, above, direction=(0, 0, 1), *, semantics="solid"):
    """Return the smallest lift of `above` along `direction` that sets it free of `below`, exact; a Separation.

    Lifted by more, it never meets `below` again; the lift is negative where it can come down. None when they
    pass each other at any height. semantics: as in `measure`.
    """
    return _results.separation_of(_core.separation(as_mesh(below), as_mesh(above), direction, semantics))


def structure(mesh, *, segmentation=None, segments=None, seeds=None, primitive=None, sections=None,
              symmetry_tolerance=None, joint_reach=None, ctrl=None, grp=None, format=None, unit=None, up=None,
              labels=None, threads=None, progress=None):
    """Find the parts of a mesh, what stands for them, and how they are related.

    segmentation: 'automatic' (default), 'given', 'members', 'whole', 'components', 'primitives' or
    'shape-diameter'; segments: parts to cut every component into; seeds: file of triangles marked by hand.
    primitive: a dict from part, or 'all', to 'cuboid' or 'cylinder'; sections: cross-sections of a
    generalized cylinder (default: 24).
    symmetry_tolerance, joint_reach: fractions of the diagonal (default: 0.01).
    ctrl, grp: files of the paper's authors in the place of an analysis.
    format, unit, up, labels: how a file is read, see `load`. threads: at most so many (default: all).
    progress: called as progress(step, fraction).
    """
    options = {"segmentation": segmentation, "segments": segments, "seeds": seeds, "primitive": primitive,
               "sections": sections, "symmetry_tolerance": symmetry_tolerance, "joint_reach": joint_reach,
               "ctrl": ctrl, "grp": grp, "format": format, "unit": unit, "up": up, "labels": labels,
               "threads": threads, "output": "mesh", "save": "project"}
    answer = run_command("structure", mesh, options, progress)
    return _results.Structure(answer.document, answer.meshes["mesh"], answer.texts["project"])


def deform(mesh, *, edit, model=None, follow=None, direction=None, keep_extent=None, extent_ends=None,
           box_tolerance=None, fix=None, fix_point=None, segmentation=None, segments=None, seeds=None, primitive=None,
           sections=None, symmetry_tolerance=None, joint_reach=None, ctrl=None, grp=None, format=None, unit=None,
           up=None, labels=None, threads=None, progress=None):
    """Edit a shape so that its symmetries and joints stay, or say why that cannot be.

    mesh: a mesh, a project file, or a Structure, which is not analysed anew.
    edit: a text such as 'seat scale 1.1 along 1 0 0', or several, made in order: a handle (PART,
    PART/face=-z, PART/corner=0, PART/section=3, point=7, wire=2, shape) and 'move X Y Z',
    'rotate DEGREES about X Y Z', 'scale FACTOR [along X Y Z]' or
    'lean X Y Z towards X Y Z' of a part.
    model: what moves the mesh: 'controllers' (default), 'surface', 'iwires' or 'gap-scaling'; follow: 'free'
    (default) or 'smooth', how other parts follow with controllers; direction: of gap scaling.
    keep_extent: direction along which the extent is kept; extent_ends: 'free' (default) or 'fixed'.
    box_tolerance: fraction by which the box may change; fix: parts that stay; fix_point: points that stay.
    Other keywords: as in `structure`.
    """
    options = {"edit": edit, "model": model, "follow": follow, "direction": direction, "keep_extent": keep_extent,
               "extent_ends": extent_ends, "box_tolerance": box_tolerance, "fix": fix, "fix_point": fix_point,
               "segmentation": segmentation, "segments": segments, "seeds": seeds, "primitive": primitive,
               "sections": sections, "symmetry_tolerance": symmetry_tolerance, "joint_reach": joint_reach,
               "ctrl": ctrl, "grp": grp, "format": format, "unit": unit, "up": up, "labels": labels,
               "threads": threads, "output": "mesh"}
    if model in (None, "controllers"):
        options["save"] = "project"
    answer = run_command("deform", mesh, options, progress)
    return _results.Deformation(answer.document, answer.meshes.get("mesh"), answer.texts.get("project"))


def suggest(mesh, *, direction=None, semantics=None, boxes=None, model=None, edits=None, bend=False, alpha=None,
            target=None, keep=None, only=None, change_height=False, box_tolerance=None, thickness=None, clearance=None,
            lateral_clearance=None, draft_degrees=None, standing=None, tilt_degrees=None, friction=None, rest_on=None,
            relax=None,
            any_quality=False, top=None, all=False, apply=None, roll_back=None, segmentation=None, segments=None,
            seeds=None, primitive=None, sections=None, symmetry_tolerance=None, joint_reach=None, ctrl=None, grp=None,
            format=None, unit=None, up=None, labels=None, threads=None, progress=None):
    """List the edits of one step that would make a shape stack better.

    mesh: a mesh, a project file, a Structure, or Suggestions, whose history goes on.
    apply: take the suggestion of this number; roll_back: make this node of the history current. The
    `project` of the result has the history then.
    edits: 'extended' (default), 'paper' or 'smooth'; bend: let straight parts bend; alpha: weight of the
    distortion; target: say which suggestions reach this stackability; top: how many to return (default:
    12); all: all of them, and those that are refused. direction, semantics, boxes: as in `measure`; model:
    as in `deform`; keep to any_quality: as in `improve`; other keywords: as in `structure`.
    """
    options = {"direction": direction, "semantics": semantics, "boxes": boxes, "model": model, "edits": edits,
               "bend": bend, "alpha": alpha, "target": target, "keep": keep, "only": only,
               "change_height": change_height, "box_tolerance": box_tolerance, "thickness": thickness,
               "clearance": clearance, "lateral_clearance": lateral_clearance, "draft_degrees": draft_degrees,
               "standing": standing, "tilt_degrees": tilt_degrees, "friction": friction, "rest_on": rest_on,
               "relax": relax, "any_quality": any_quality,
               "top": top, "all": all, "apply": apply, "roll_back": roll_back, "segmentation": segmentation,
               "segments": segments, "seeds": seeds, "primitive": primitive, "sections": sections,
               "symmetry_tolerance": symmetry_tolerance, "joint_reach": joint_reach, "ctrl": ctrl, "grp": grp,
               "format": format, "unit": unit, "up": up, "labels": labels, "threads": threads, "save": "project"}
    answer = run_command("suggest", mesh, options, progress)
    return _results.Suggestions(answer.document, None, answer.texts["project"])


def compare(mesh, after, *, after_up=None, relax=None, segmentation=None, segments=None, seeds=None, primitive=None,
            sections=None, symmetry_tolerance=None, joint_reach=None, ctrl=None, grp=None, format=None, unit=None,
            up=None, labels=None, threads=None, progress=None):
    """Say what a person would mind in a changed shape.

    after: a mesh of the same faces with other vertices. after_up: its axis that points up; default: as `up`.
    What is made of a mesh with `up` has z up. relax: limits of quality, names or a dict from name to value.
    Other keywords: as in `structure`.
    """
    options = {"after_up": after_up, "relax": relax, "segmentation": segmentation, "segments": segments,
               "seeds": seeds, "primitive": primitive, "sections": sections, "symmetry_tolerance": symmetry_tolerance,
               "joint_reach": joint_reach, "ctrl": ctrl, "grp": grp, "format": format, "unit": unit, "up": up,
               "labels": labels, "threads": threads}
    return _results.Comparison(run_command("compare", mesh, options, progress, after=after).document)
