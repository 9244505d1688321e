"""Results: frozen views of the JSON that the program writes."""

from __future__ import annotations

import copy
import fractions
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy

from ._core import Mesh

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[numpy.float64]

Document = dict[str, Any]
_DIGITS_AT_ONCE = 4000  # Python converts no more than 4300 at once


def _integer(text: str) -> int:
    """The number of a decimal text of any length."""
    sign, digits = (-1, text[1:]) if text.startswith("-") else (1, text)
    value = 0
    for start in range(0, len(digits), _DIGITS_AT_ONCE):
        part = digits[start:start + _DIGITS_AT_ONCE]
        value = value * 10**len(part) + int(part)
    return sign * value


def fraction_of(numerator: str, denominator: str) -> fractions.Fraction:
    """A Fraction of two decimal texts."""
    return fractions.Fraction(_integer(numerator), _integer(denominator))


def fraction(value: Mapping[str, str]) -> fractions.Fraction:
    return fraction_of(value["numerator"], value["denominator"])


def _fractions(values: Sequence[Mapping[str, str]]) -> tuple[fractions.Fraction, ...]:
    return tuple(fraction(value) for value in values)


def vector(values: Any) -> Floats:
    vector: Floats = numpy.array(values, dtype=float)
    vector.setflags(write=False)
    return vector


def _names(values: Sequence[Any]) -> tuple[Any, ...]:
    return tuple(values)


def copied(value: Any) -> Any:
    """A copy that may be changed."""
    return copy.deepcopy(value)


class _Field:
    """An attribute that reads a value of the document."""

    def __init__(self, doc: str, key: str | None, convert: Callable[[Any], object] | None) -> None:
        self.__doc__ = doc
        self.key = key
        self.convert = convert

    def __set_name__(self, owner: type, name: str) -> None:
        self.key = self.key or name

    def __get__(self, result: Result | None, owner: type | None = None) -> Any:
        if result is None:
            return self
        value = result._document.get(str(self.key))
        return value if self.convert is None or value is None else self.convert(value)

    def __set__(self, result: Result, value: object) -> None:
        raise AttributeError("results cannot be changed")

    def __delete__(self, result: Result) -> None:
        raise AttributeError("results cannot be changed")


def field(doc: str, key: str | None = None, convert: Callable[[Any], object] | None = None) -> Any:
    """An attribute that reads the value `key` of the document, by default of its own name."""
    return _Field(doc, key, convert)


class Frozen:
    """It cannot be changed, but copied and pickled."""

    __slots__ = ()

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError("results cannot be changed")

    def __delattr__(self, name: str) -> None:
        raise AttributeError("results cannot be changed")

    def __reduce__(self) -> tuple[Any, ...]:
        slots = [slot for kind in type(self).__mro__ for slot in getattr(kind, "__slots__", ())]
        return _remade, (type(self), {slot: getattr(self, slot) for slot in slots})


def _remade(kind: type, values: Mapping[str, Any]) -> Any:
    made: Any = object.__new__(kind)
    for slot, value in values.items():
        if isinstance(value, numpy.ndarray):
            value.setflags(write=False)
        object.__setattr__(made, slot, value)
    return made


class Result(Frozen):
    """Something that was found. It cannot be changed; results with the same values are equal."""

    __slots__ = ("_document",)
    _shown: tuple[str, ...] = ()
    _document: Document

    def __init__(self, document: Document) -> None:
        object.__setattr__(self, "_document", document)

    def to_dict(self) -> Document:
        """A copy of the whole result; of a command, what the program writes with --json --no-timing."""
        return copy.deepcopy(self._document)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Result) and type(self) is type(other) and self._document == other._document

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        shown = ", ".join(f"{name}={_short(getattr(self, name))}" for name in self._shown)
        return f"<{type(self).__name__}: {shown}>"


def _short(value: object) -> str:
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, numpy.ndarray) and value.ndim == 1:
        return "(" + ", ".join(f"{number:.6g}" for number in value) + ")"
    return repr(value)


class Findings(Result):
    """What is in a mesh, and what is wrong with it."""

    __slots__ = ()
    _shown = ("brief",)
    brief: str = field("One line for people.")
    vertices: int = field("Rows of the vertices.")
    triangles: int = field("Rows of the faces.")
    parts: int = field("Named parts.")
    components: int = field("Connected pieces.")
    distinct_points: int = field("Points, those in the same place counted once.")
    unreferenced_vertices: int = field("Vertices that no face uses.")
    degenerate_faces: int = field("Faces without area.")
    duplicate_faces: int = field("Faces that occur before.")
    boundary_edges: int = field("Edges of one face only.")
    non_manifold_edges: int = field("Edges of more than two faces.")
    inconsistent_edges: int = field("Edges whose faces have opposite orientations.")
    self_intersections: int | None = field("Pairs of faces that intersect; None where not counted.")
    closed: bool = field("Is it a closed surface?")
    volume: float | None = field("Enclosed volume, model units cubed; None where it is open.")
    oriented_outward: bool = field("Do the faces point outwards?")
    lower: Floats = field("(3,) lowest corner of the axis-aligned box, model units.", convert=vector)
    upper: Floats = field("(3,) highest corner of the axis-aligned box, model units.", convert=vector)
    likely_unit: str | None = field("Unit that fits better, where its unit makes it smaller or larger than objects are.")
    likely_up: str | None = field("Axis that probably points up; None where it cannot be told.")
    up_reason: str = field("Why that axis.")


class OfModel(Result):
    """A result for one mesh."""

    __slots__ = ()
    command: str = field("Command of the program that says the same.")
    model: str = field("Path of the mesh, or '<mesh>' for one in memory.")
    unit: str | None = field("Unit of lengths; None where it is unknown.")
    findings: Findings = field("What is in the mesh.", convert=Findings)


class Inspection(OfModel):
    """What `inspect` finds."""

    __slots__ = ()
    _shown = ("findings", "part_names")
    part_names: tuple[str, ...] = field("Names of the parts.", convert=_names)


class Witness(Result):
    """Two points that attain a separation: on a common line along the direction before the lift."""

    __slots__ = ()
    _shown = ("upper_triangle", "lower_triangle", "upper_point", "lower_point")

    @property
    def upper_triangle(self) -> int:
        """Row of the face of the mesh below that is touched."""
        return int(self._document["triangles"][0])

    @property
    def lower_triangle(self) -> int:
        """Row of the face of the mesh above that touches it."""
        return int(self._document["triangles"][1])

    upper_point: Floats = field("(3,) point of that face below, model units, rounded.", "point", vector)
    lower_point: Floats = field("(3,) point of the face above, before the lift, model units, rounded.",
                                        convert=vector)


class Contact(Result):
    """A region where a copy rests on the one below."""

    __slots__ = ()
    _shown = ("type", "parts", "area")
    type: str = field("'dot', 'line' or 'ring'.")
    parts: tuple[str, str] = field("Names of the parts that touch: of the copy below, and of the one above.", convert=_names)
    area: float = field("Model units squared.")
    centre: Floats = field("(3,) on the copy below, model units.", convert=vector)
    lower_centre: Floats = field("(3,) on the copy above, before the lift.", convert=vector)
    long_axis: Floats = field("(3,) unit vector along the region.", convert=vector)


def _contacts(values: Sequence[Document]) -> tuple[Contact, ...]:
    return tuple(Contact(value) for value in values)


class Separation(Result):
    """The smallest lift that sets one mesh free of another, exact.

    Lifted by more along the direction, the mesh above never meets the one below again.
    """

    __slots__ = ()
    _shown = ("length", "witness")
    length: float = field("The lift, model units, within 4 ulp; negative where the mesh above can come down.")
    exact: fractions.Fraction = field("The lift in units of the direction: exact * direction is the translation.",
                                       convert=fraction)
    witness: Witness = field("What causes it.", convert=Witness)

    @property
    def gradient(self) -> Gradient | None:
        """A subgradient of `length`; None where a face without area attains it."""
        values = self._document["gradient"]
        return None if values is None else Gradient(values)


class Gradient(Result):
    """A subgradient of a separation, model units per model unit: by vertices that it does not name it is 0.

    Away from kinks, where other faces attain the same value, it is the gradient.
    """

    __slots__ = ()
    _shown = ("direction",)
    upper: Floats = field("(3, 3): row i by corner i of witness.upper_triangle, of the mesh below.",
                                 convert=vector)
    lower: Floats = field("(3, 3): row i by corner i of witness.lower_triangle, of the mesh above.",
                                 convert=vector)
    direction: Floats = field("(3,) by the direction.", convert=vector)


class Touch(Result):
    """Two points that attain a separation, with a plane between their faces, and the subgradient there."""

    __slots__ = ()
    _shown = ("triangles", "normal")
    triangles: tuple[int, int] = field("Rows of the faces that touch: of the mesh below, and of the one above.",
                                        convert=_names)
    weights: Floats = field("(2, 3) barycentric weights of the points on these faces.", convert=vector)
    normal: Floats = field("(3,) of the plane; its product with the direction is the direction's length.",
                           convert=vector)
    direction: Floats = field("(3,) derivative by the direction, model units.", convert=vector)

    @property
    def upper(self) -> Floats:
        """(3, 3): row i, the derivative by corner i of the face of the mesh below."""
        return vector(numpy.outer(self.weights[0], self.normal))

    @property
    def lower(self) -> Floats:
        """(3, 3): row i, the derivative by corner i of the face of the mesh above."""
        return vector(-numpy.outer(self.weights[1], self.normal))


class Gradients(Result):
    """All subgradients of a separation at a kink; one where there is none.

    The separation rises by the largest product of a change with one of them where `complete` and
    `one_plane_each`, and else by no more than that, unless touches are missing.
    """

    __slots__ = ()
    _shown = ("touches", "complete")
    touches: tuple[Touch, ...] = field("One for each pair of faces that attains it, and each corner of where it does.",
                                       convert=lambda values: tuple(map(Touch, values)))
    complete: bool = field("Are these all?")
    one_plane_each: bool = field("Is there one plane only between every two faces?")


def separation_of(found: tuple[Any, ...] | None) -> Separation | None:
    """A Separation of what the compiled part returns."""
    if found is None:
        return None
    numerator, denominator, length, (upper, lower, upper_point, lower_point), gradient = found
    return Separation({
        "length": length,
        "exact": {"numerator": numerator, "denominator": denominator},
        "witness": {"triangles": [upper, lower], "point": upper_point.tolist(), "lower_point": lower_point.tolist()},
        "gradient": gradient and dict(zip(("upper", "lower", "direction"), (part.tolist() for part in gradient))),
    })


class Measurement(OfModel):
    """How well a mesh stacks along a direction."""

    __slots__ = ()
    _shown = ("stackability", "f_max", "height", "direction")
    direction: Floats = field("(3,) as given.", convert=vector)
    method: str = field("'exact', 'rays' or 'raster'.")
    semantics: str = field("'solid': walls may slide along each other; 'closed': touching counts.")
    boxes: str = field("'oriented' or 'frame'.")
    f_max: float = field("Smallest lift that sets a copy free, model units: the pitch of the stack.")
    height: float = field("Of one copy along the direction, model units.")
    f_max_over_height: float | None = field("f_max / height; None for a flat mesh across the direction.")
    stackability: float | None = field("S: the share of space that a tall stack saves; None for a flat mesh.")
    nesting_increment: float = field("What each further copy adds to the stack, model units.")
    box_volume: float = field("Box of one copy, model units cubed.")
    stack_box_volume: float = field("Box of one copy with a side along the direction, model units cubed.")
    f_max_exact: fractions.Fraction | None = field("f_max in units of the direction; None where sampled.", "exact",
                                                      fraction)
    witness: Witness | None = field("What causes f_max; None where nothing does, or sampled.", convert=Witness)
    gradient: Gradients | None = field("How f_max changes with the mesh and the direction; None as the witness.",
                                       convert=Gradients)
    contacts: tuple[Contact, ...] | None = field("Where a copy rests on the one below; None where sampled.", convert=_contacts)
    layer: Document | None = field("How much lies within a layer of the copy below; None where not asked for.", convert=copied)
    sampling: Document | None = field("What sampling did to f_max; None where exact.", convert=copied)


class Optimum(Result):
    """A local optimum of a search."""

    __slots__ = ()
    _shown = ("stackability", "direction")
    direction: Floats = field("(3,) unit vector.", convert=vector)
    stackability: float = field("S along it.")


class Search(Measurement):
    """The best direction found, measured."""

    __slots__ = ()
    evaluated: int = field("Directions tried.")
    abandoned: int = field("Of these, given up too far below the best.")
    optima: tuple[Optimum, ...] = field("Local optima, best first.", convert=lambda values: tuple(map(Optimum, values)))
    bound: "float | None" = field("No direction has a larger S; None without a proof.")
    accuracy: "float | None" = field("How close to the best S the bound was to come.")
    proven: "bool | None" = field("Whether the bound is within `accuracy` of the best S.")
    cells: "int | None" = field("Cells of directions that were examined.")
    open_cells: "int | None" = field("Of these, cells that may hold an S above the best by more than `accuracy`.")


class Map(OfModel):
    """S over the hemisphere above the xy plane, k directions; opposite directions stack alike."""

    __slots__ = ("_samples",)
    _samples: Floats
    _shown = ("step_degrees", "best", "mean_stackability")

    def __init__(self, document: Document, samples: Floats) -> None:
        super().__init__(document)
        samples.setflags(write=False)
        object.__setattr__(self, "_samples", samples)

    step_degrees: float = field("Angle between neighbours.")
    best: Optimum = field("The best of the directions.", convert=Optimum)
    worst: Optimum = field("The worst of the directions.", convert=Optimum)
    mean_stackability: float = field("Mean over the directions, which are spread evenly.")

    @property
    def theta_degrees(self) -> Floats:
        """(k,) angles from +z."""
        return self._samples[:, 0]

    @property
    def phi_degrees(self) -> Floats:
        """(k,) angles from +x towards +y."""
        return self._samples[:, 1]

    @property
    def directions(self) -> Floats:
        """(k, 3) unit vectors, rings from +z downwards."""
        return self._samples[:, 2:5]

    @property
    def f_max_over_height(self) -> Floats:
        """(k,) in [0, 1]."""
        return self._samples[:, 5]

    @property
    def stackability(self) -> Floats:
        """(k,) S along each."""
        return self._samples[:, 6]


def _transforms(copies: Sequence[Document]) -> Floats:
    transforms = numpy.zeros((len(copies), 4, 4))
    transforms[:, 3, 3] = 1
    for transform, one in zip(transforms, copies):
        transform[:3, :3] = one["rotation"]
        transform[:3, 3] = one["translation"]
    transforms.setflags(write=False)
    return transforms


class Stack(OfModel):
    """Copies on top of each other."""

    __slots__ = ("_separators",)
    _separators: Mesh | None
    _shown = ("n", "height", "nesting_increment", "stackability")

    def __init__(self, document: Document, separators: Mesh | None) -> None:
        super().__init__(document)
        object.__setattr__(self, "_separators", separators)

    @property
    def separators(self) -> Mesh | None:
        """The bodies above the first copy, which `transforms[k]` takes to their places above copy k.

        None where they were not asked for, or the copies are close to each other over no area.
        """
        return self._separators

    direction: Floats = field("(3,) as given; copies come from above along it.", convert=vector)
    n: int = field("Number of copies.")
    transforms: Floats = field("(n, 4, 4): takes the mesh to its place as each copy, bottom first.", "copies",
                                       _transforms)
    offsets: tuple[float, ...] = field("(n,) lifts along the direction, model units.", convert=_names)
    exact_offsets: tuple[fractions.Fraction, ...] = field("(n,) the same as Fractions, in units of the direction.", convert=_fractions)
    twist_degrees: float = field("Turn of each copy against the one below.")
    period: int = field("Length of the cycle of poses.")
    poses: tuple[Document, ...] = field("Per copy of a period, how it is turned.", convert=_names)
    step: Document | None = field("Shift x, y and turn yaw_degrees from each copy to the next, and its proof; None where "
                                  "not searched.", convert=copied)
    clearance: float = field("Air along the direction, model units.")
    lateral_clearance: float = field("Sideways play, model units.")
    layer: float | None = field("Thickness of the layers of which each lift is a whole number; None where not asked for.")
    copy_height: float = field("Of one copy, model units.")
    height: float = field("Of the stack, model units.")
    nesting_increment: float = field("What each further copy adds, model units.")
    stackability: float = field("Share of space that this stack saves.")
    conflicts: list[Any] = field("Pairs of copies that are no neighbours and would overlap.", convert=copied)
    within: Document | None = field("Whether the stack fits the length asked for: 'met' says so.", convert=copied)


class Nest(OfModel):
    """One mesh lowered into another."""

    __slots__ = ()
    _shown = ("offset", "height", "saving", "on_floor")
    into: str = field("The container.")
    direction: Floats = field("(3,) as given.", convert=vector)
    offset: float = field("Lift from where the file puts the mesh, model units; negative: it comes down.")
    exact_offset: fractions.Fraction = field("The same in units of the direction.", convert=fraction)
    on_floor: bool = field("Does it stand on the floor below the container?")
    witness: Witness | None = field("What it rests on; None on the floor.", convert=Witness)
    container_height: float = field("Model units.")
    content_height: float = field("Model units.")
    height: float = field("Of both, model units.")
    saving: float = field("How much less that is than both heights, model units.")
    stackability: float | None = field("Share of space that nesting saves.")

    @property
    def transform(self) -> Floats:
        """(4, 4): takes the mesh from its place to where it rests."""
        transform = numpy.eye(4)
        transform[:3, 3] = float(self.exact_offset) * self.direction
        transform.setflags(write=False)
        return transform


class Gap(OfModel):
    """How far one mesh is above another along a direction."""

    __slots__ = ()
    _shown = ("gap", "witness")
    above: str = field("The mesh that comes down.")
    direction: Floats = field("(3,) as given.", convert=vector)
    semantics: str = field("'solid' or 'closed'.")
    gap: float | None = field("How far it can come down, model units; negative: it has to be lifted by as much to "
                                "be free; None: the two pass each other.")
    exact: fractions.Fraction | None = field("The same in units of the direction.", convert=fraction)
    witness: Witness | None = field("What touches first.", convert=Witness)
    gradient: Gradients | None = field("How minus the gap changes with both meshes and the direction.",
                                       convert=Gradients)


class Holding(OfModel):
    """How a stack of n copies holds, on ground that does not let it slide."""

    __slots__ = ()
    _shown = ("stands", "tipping_degrees", "jams")
    direction: Floats = field("(3,) as given.", convert=vector)
    semantics: str = field("'solid' or 'closed'.")
    contacts: tuple[Contact, ...] = field("Where a copy rests on the one below.", convert=_contacts)
    n: int = field("Number of copies.")
    friction: float = field("Coefficient between copies.")
    stands: bool = field("Does the stack stay on level ground?")
    tipping_degrees: float = field("Smallest tilt of the ground at which it topples or slides; negative: the tilt that "
                                   "is lacking.")
    weakest_copy: int = field("The copy that goes first with those above it; 0: the whole stack.")
    needed_friction: float | None = field("With less, copies slide on level ground; None: they topple all the same.")
    lean_degrees: float = field("Between the direction and up.")
    drift: float = field("How far the last copy stands beside the first, model units.")
    centring_slope: float = field("A copy beside its place slides back where friction is below; negative: it slides off.")
    draft_degrees: float = field("Least angle between the direction and surfaces that touch.")
    jams: bool = field("By contacts or by tight walls.")
    pull_off: float = field("Force that pulls a copy off, over that which pressed it on; 0: it does not jam.")
    walls_pull_off: float = field("The same, pressed against tight walls; 0: they add nothing.")
    tight_walls: list[Document] = field("Parts, least gap and draft, and area of walls that are close to each other.",
                                        convert=copied)
    centre_of_mass: Floats = field("(3,) of one copy, model units.", convert=vector)


class Draft(OfModel):
    """Undercuts and draft of a mesh of m triangles. Areas are of the surface, in model units squared."""

    __slots__ = ("_triangles",)
    _triangles: Floats
    _shown = ("undercut_area", "min_draft_degrees")

    def __init__(self, document: Document, triangles: Floats) -> None:
        super().__init__(document)
        triangles.setflags(write=False)
        object.__setattr__(self, "_triangles", triangles)

    direction: Floats = field("(3,) as given: the halves of the mould part along it.", convert=vector)
    draft_degrees: float = field("Draft that is enough.")
    complete: bool = field("Were all pairs of triangles above each other looked at? Otherwise undercuts are too small.")
    area: float = field("Of the surface, without inner_area.")
    undercut_area: float = field("Neither half of the mould can leave it.")
    little_draft_area: float = field("Not undercut, with less draft than is enough.")
    inner_area: float = field("Where parts touch or overlap: no surface of the object.")
    min_draft_degrees: float | None = field("Of what is not undercut; None where all is.")
    parts: list[Document] = field("The same areas per part, with its name.", convert=copied)

    @property
    def triangle_draft_degrees(self) -> Floats:
        """(m,) angles to the direction, from 0 (a wall along it) to 90."""
        return self._triangles[:, 1]

    @property
    def triangle_areas(self) -> Floats:
        """(m,)."""
        return self._triangles[:, 2]

    @property
    def triangle_undercut_areas(self) -> Floats:
        """(m,)."""
        return self._triangles[:, 3]

    @property
    def triangle_inner_areas(self) -> Floats:
        """(m,)."""
        return self._triangles[:, 4]


class LoadItem(Result):
    """A mesh as an item of a load planner: lengths in whole numbers of `step`, rounded up."""

    __slots__ = ()
    _shown = ("length", "width", "height", "nesting_height")
    model: str = field("Path of the mesh, or a name in angle brackets for one in memory.")
    unit: str | None = field("Unit of the mesh; None where it is unknown.")
    findings: Findings = field("What is in the mesh.", convert=Findings)
    step: float = field("Length that the numbers count, model units.")
    length: int = field("Longer side of its box across the direction.")
    width: int = field("Shorter side of that box.")
    height: int = field("Along the direction.")
    nesting_height: int = field("How far a copy sinks into the one below: n copies are height + (n - 1) increment high.")
    increment: int = field("What each further copy adds: height - nesting_height.")


def _load_items(documents: Sequence[Document]) -> tuple[LoadItem, ...]:
    return tuple(LoadItem(document) for document in documents)


class Items(Result):
    """Meshes as the items of a load planner."""

    __slots__ = ("_table",)
    _table: str
    _shown = ("items",)

    def __init__(self, document: Document, table: str) -> None:
        super().__init__(document)
        object.__setattr__(self, "_table", table)

    command: str = field("Command of the program that says the same.")
    direction: Floats = field("(3,) as given.", convert=vector)
    semantics: str = field("'solid' or 'closed'.")
    items: tuple[LoadItem, ...] = field("One per mesh, in the order given.", convert=_load_items)

    @property
    def table(self) -> str:
        """CSV with the columns of PackingSolver's boxstacks, as the program writes it."""
        return self._table


class Drop(OfModel):
    """Where one mesh comes to rest on another."""

    __slots__ = ("_samples",)
    _samples: "Floats | None"
    _shown = ("height", "bound", "place")

    def __init__(self, document: Document, samples: "Floats | None" = None) -> None:
        super().__init__(document)
        if samples is not None:
            samples.setflags(write=False)
        object.__setattr__(self, "_samples", samples)

    onto: str = field("What it falls on.")
    direction: numpy.ndarray = field("(3,) as given.", convert=vector)
    semantics: str = field("'solid' or 'closed'.")
    place: dict = field("x, y and yaw_degrees: centre of its box across the direction, and its turn.", convert=copied)
    given_place: dict = field("The same where its coordinates put it.", convert=copied)
    height: float = field("Of its lowest point above that of the other, model units.")
    on_floor: bool = field("Does it stand beside the other?")
    lift: float = field("From the height of its coordinates, model units.")
    exact_lift: fractions.Fraction = field("The same in units of the direction.", convert=fraction)
    witness: "Witness | None" = field("What touches; None on the floor.", convert=Witness)
    least: "str | None" = field("What the best place has the least of: 'height', 'gap' or 'volume'.")
    mean_gap: "dict | None" = field("low and high: a range that holds it, model units; None but for 'gap'.", convert=copied)
    mean_depth: "dict | None" = field("The same of the space below; None but for 'volume'.", convert=copied)
    volume: "dict | None" = field("low and high of the space below, model units cubed.", convert=copied)
    bound: "float | None" = field("No place has a smaller height, mean gap or mean depth; None without a search.")
    proven: "bool | None" = field("Is the bound within eps of what was found?")
    eps: "float | None" = field("How close the proof had to come, model units.")
    cells: "int | None" = field("Cells of places examined.")
    open_cells: "int | None" = field("Of these, cells that may hold a better place.")

    @property
    def heights(self) -> "Floats | None":
        """(k, 3) rows x, y, height: places of a grid, and its height where it comes to rest there; None without a map."""
        return self._samples

    @property
    def transform(self):
        """(4, 4) matrix that puts it there."""
        transform = numpy.eye(4)
        transform[:3, :3] = self._document["rotation"]
        transform[:3, 3] = self._document["translation"]
        return transform


class Validation(OfModel):
    """The same number by independent methods."""

    __slots__ = ()
    _shown = ("passed", "checks")
    passed: bool = field("Do all agree?")
    checks: list[Document] = field("A dict per method: name, value, error, verdict and note.", convert=copied)


class Structured(OfModel):
    """A result that has a mesh of its own."""

    __slots__ = ("_mesh", "_project")
    _mesh: Mesh | None
    _project: str | None

    def __init__(self, document: Document, mesh: Mesh | None, project: str | None) -> None:
        super().__init__(document)
        object.__setattr__(self, "_mesh", mesh)
        object.__setattr__(self, "_project", project)

    @property
    def mesh(self) -> Mesh | None:
        """The Mesh; None where there is none."""
        return self._mesh

    @property
    def project(self) -> str | None:
        """Text of a project file, which holds mesh and structure; None where there is none.

        Written to a file it is read by the program. The result itself may stand for a mesh in `deform`,
        `suggest`, `compare` and `improve`, which then analyse nothing anew.
        """
        return self._project


class Structure(Structured):
    """Parts of a mesh, what stands for them, and how they are related."""

    __slots__ = ()
    _shown = ("part_names",)
    diagonal: float = field("Of the mesh, model units: residuals are fractions of it.")
    parts: list[Document] = field("A dict per part: name, triangles.", convert=copied)
    primitives: list[Document] = field("A dict per part: its cuboid or generalized cylinder.", convert=copied)
    symmetries: list[Document] = field("A dict per symmetry of the whole.", convert=copied)
    relations: list[Document] = field("A dict per relation: type, parts, residual.", convert=copied)

    @property
    def part_names(self) -> tuple[str, ...]:
        """Names of the parts."""
        return tuple(part["name"] for part in self._document["parts"])


def lines(explanation: Mapping[str, Any]) -> tuple[str, ...]:
    return tuple(explanation["lines"])


class Deformation(Structured):
    """A shape after edits, or why they were refused; then `mesh` is None."""

    __slots__ = ()
    _shown = ("edits", "refusal", "explanation")
    deformation: str = field("What moved the mesh: the `model` asked for.")
    edits: tuple[str, ...] = field("What was done.", convert=_names)
    refusal: Document | None = field("Why it was refused: reason, relation, amount; None: it was not.",
                                    convert=copied)
    explanation: tuple[str, ...] | None = field("What changes, in words.", convert=lines)
    displacement: Document | None = field("Of the vertices, model units: root_mean_square and largest.",
                                         convert=copied)
    residuals: Document | None = field("Largest residuals of joints and symmetries, fractions of the diagonal.",
                                      convert=copied)
    relations: list[Document] | None = field("As in Structure, after the edits.", convert=copied)


class Suggestion(Result):
    """An edit that would make the shape stack better."""

    __slots__ = ()
    _shown = ("number", "edit", "stackability")
    number: int | None = field("For `apply`; None where it is refused.")
    edit: str = field("What to do, as `deform` takes it.")
    words: str = field("The same in words.")
    why: str = field("What it is good for.")
    stackability: float | None = field("S after it.")
    energy: Document | None = field("E of the paper after it, and what it is made of.", convert=copied)
    refusal: str | None = field("Why it cannot be made.")


class Suggestions(Structured):
    """The edits of one step, best first."""

    __slots__ = ()
    _shown = ("possible", "suggestions")
    direction: Floats = field("(3,) along which copies are stacked.", convert=vector)
    now: Document = field("Where the shape stands: S, E, f_max.", convert=copied)
    contacts: tuple[Contact, ...] = field("Where copies touch now.", convert=_contacts)
    possible: int = field("How many can be made.")
    refused: int = field("How many cannot.")
    suggestions: tuple[Suggestion, ...] = field("What was asked for of them.",
                                convert=lambda values: tuple(Suggestion(value) for value in values))
    applied: int | None = field("The number that was applied.")
    history: Document = field("The tree of what was tried: current and nodes.", convert=copied)


class Comparison(OfModel):
    """What a person would mind in a changed shape."""

    __slots__ = ()
    _shown = ("acceptable", "explanation")
    after: str = field("The changed shape.")
    acceptable: bool = field("Are all limits kept?")
    explanation: tuple[str, ...] = field("What changes, in words.", convert=lines)
    quality: list[Document] = field("A dict per measure: name, value, limit, unit, kept, part, other.", convert=copied)
