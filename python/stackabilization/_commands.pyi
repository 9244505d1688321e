from collections.abc import Mapping, Sequence
from typing import Any, Literal, NamedTuple, overload

from . import _results
from ._core import Mesh
from ._results import (
    Comparison, Deformation, Draft, Drop, Gap, Holding, Inspection, Items, Map, Measurement, Nest, Search, Separation, Stack,
    Structure, Suggestions, Validation,
)
from ._types import (
    Boxes, DeformationModel, Length, MeshLike, Names, Path, Primitives, Progress, Relaxed, Segmentation, Semantics,
    Unit, Up, Vector,
)

class Answer(NamedTuple):
    document: dict[str, Any]
    meshes: dict[str, Mesh]
    texts: dict[str, str]

class Inputs:
    meshes: dict[str, Mesh]
    projects: dict[str, str]
    def __init__(self) -> None: ...
    def name_of(self, mesh: MeshLike, name: str, command: str | None = None) -> str: ...

def command_line(command: str, positionals: list[str], options: Mapping[str, object]) -> list[str]: ...
def run_command(
    command: str, mesh: MeshLike, options: Mapping[str, object], progress: Progress | None = None, *,
    after: MeshLike | None = None, above: MeshLike | None = None,
    more: Sequence[MeshLike] = (),
) -> Answer: ...

def inspect(
    mesh: MeshLike, *, self_intersections: bool = False, format: str | None = None, unit: Unit | None = None,
    up: Up | None = None, labels: Path | None = None,
) -> Inspection: ...

def measure(
    mesh: MeshLike, *, direction: Vector | None = None, method: Literal["exact", "rays", "raster"] | None = None,
    resolution: int | None = None, layer: Length | None = None, semantics: Semantics | None = None,
    boxes: Boxes | None = None, format: str | None = None, unit: Unit | None = None, up: Up | None = None,
    labels: Path | None = None, threads: int | None = None,
) -> Measurement: ...

def search(
    mesh: MeshLike, *, cone_degrees: float | None = None, direction: Vector | None = None,
    plane: Vector | None = None, certify: float | None = None, max_cells: int | None = None,
    semantics: Semantics | None = None, boxes: Boxes | None = None, format: str | None = None,
    unit: Unit | None = None, up: Up | None = None, labels: Path | None = None, threads: int | None = None,
    progress: Progress | None = None,
) -> Search: ...

def map(
    mesh: MeshLike, *, step_degrees: float | None = None, semantics: Semantics | None = None,
    boxes: Boxes | None = None, format: str | None = None, unit: Unit | None = None, up: Up | None = None,
    labels: Path | None = None, threads: int | None = None, progress: Progress | None = None,
) -> Map: ...

def stack(
    mesh: MeshLike, *, n: int | Literal["max"] | None = None, into: MeshLike | None = None, direction: Vector | None = None,
    twist_degrees: float | Literal["auto"] | None = None, period: int | None = None,
    place: Literal["given", "best"] | None = None, turn: bool = False, max_shift: Length | None = None,
    clearance: Length | None = None, lateral_clearance: Length | None = None, layer: Length | None = None,
    separators: bool = False, within: Length | None = None,
    semantics: Semantics | None = None, boxes: Boxes | None = None, format: str | None = None,
    unit: Unit | None = None, up: Up | None = None, labels: Path | None = None, threads: int | None = None,
) -> Stack: ...

def gap(
    mesh: MeshLike, above: MeshLike, *, direction: Vector | None = None, semantics: Semantics | None = None,
    format: str | None = None, unit: Unit | None = None, up: Up | None = None, labels: Path | None = None,
    threads: int | None = None,
) -> Gap: ...

def items(
    mesh: MeshLike, *more: MeshLike, direction: Vector | None = None, clearance: Length | None = None,
    lateral_clearance: Length | None = None, step: Length | None = None, copies: int | None = None,
    semantics: Semantics | None = None, format: str | None = None, unit: Unit | None = None, up: Up | None = None,
    labels: Path | None = None, threads: int | None = None,
) -> Items: ...

def hold(
    mesh: MeshLike, *, n: int | None = None, direction: Vector | None = None, semantics: Semantics | None = None,
    friction: float | None = None, side_gap: Length | None = None, format: str | None = None, unit: Unit | None = None,
    up: Up | None = None, labels: Path | None = None, threads: int | None = None,
) -> Holding: ...

def draft(
    mesh: MeshLike, *, direction: Vector | None = None, draft_degrees: float | None = None, format: str | None = None,
    unit: Unit | None = None, up: Up | None = None, labels: Path | None = None, threads: int | None = None,
) -> Draft: ...

def drop(
    mesh: MeshLike, *, onto: MeshLike, place: Literal["given", "best"] | None = None,
    least: Literal["height", "gap", "volume"] | None = None, overlap: float | None = None, turn: bool = False,
    corner: Sequence[Sequence[float]] | None = None, eps: Length | None = None, max_cells: int | None = None,
    map: bool = False, step: Length | None = None, direction: Vector | None = None, semantics: Semantics | None = None,
    format: str | None = None, unit: Unit | None = None, up: Up | None = None, labels: Path | None = None,
    threads: int | None = None, progress: Progress | None = None,
) -> Drop: ...

def validate(
    mesh: MeshLike, *, direction: Vector | None = None, format: str | None = None, unit: Unit | None = None,
    up: Up | None = None, labels: Path | None = None, threads: int | None = None,
) -> Validation: ...

def separation(
    below: MeshLike, above: MeshLike, direction: Vector = (0, 0, 1), *, semantics: Semantics = 'solid',
) -> Separation | None: ...

def structure(
    mesh: MeshLike, *, segmentation: Segmentation | None = None, segments: int | None = None,
    seeds: Path | None = None, primitive: Primitives | None = None, sections: int | None = None,
    symmetry_tolerance: float | None = None, joint_reach: float | None = None, ctrl: Path | None = None,
    grp: Path | None = None, format: str | None = None, unit: Unit | None = None, up: Up | None = None,
    labels: Path | None = None, threads: int | None = None, progress: Progress | None = None,
) -> Structure: ...

def deform(
    mesh: MeshLike, *, edit: Names, model: DeformationModel | None = None,
    follow: Literal["free", "smooth"] | None = None, direction: Vector | None = None,
    keep_extent: Vector | None = None, extent_ends: Literal["free", "fixed"] | None = None,
    box_tolerance: float | str | None = None, fix: Names | None = None,
    fix_point: Vector | Sequence[Vector] | None = None, segmentation: Segmentation | None = None,
    segments: int | None = None, seeds: Path | None = None, primitive: Primitives | None = None,
    sections: int | None = None, symmetry_tolerance: float | None = None, joint_reach: float | None = None,
    ctrl: Path | None = None, grp: Path | None = None, format: str | None = None, unit: Unit | None = None,
    up: Up | None = None, labels: Path | None = None, threads: int | None = None, progress: Progress | None = None,
) -> Deformation: ...

def suggest(
    mesh: MeshLike, *, direction: Vector | None = None, semantics: Semantics | None = None,
    boxes: Boxes | None = None, model: DeformationModel | None = None,
    edits: Literal["extended", "paper", "smooth"] | None = None, bend: bool = False, alpha: float | None = None,
    target: float | None = None, keep: Names | None = None, only: Names | None = None, change_height: bool = False,
    box_tolerance: float | str | None = None, thickness: Length | None = None, clearance: Length | None = None,
    lateral_clearance: Length | None = None, draft_degrees: float | None = None, standing: int | None = None,
    tilt_degrees: float | None = None, friction: float | None = None, rest_on: str | None = None,
    relax: Relaxed | None = None, any_quality: bool = False,
    top: int | None = None, all: bool = False, apply: int | None = None, roll_back: int | None = None,
    segmentation: Segmentation | None = None, segments: int | None = None, seeds: Path | None = None,
    primitive: Primitives | None = None, sections: int | None = None, symmetry_tolerance: float | None = None,
    joint_reach: float | None = None, ctrl: Path | None = None, grp: Path | None = None, format: str | None = None,
    unit: Unit | None = None, up: Up | None = None, labels: Path | None = None, threads: int | None = None,
    progress: Progress | None = None,
) -> Suggestions: ...

def compare(
    mesh: MeshLike, after: MeshLike, *, after_up: Up | None = None, relax: Relaxed | None = None,
    segmentation: Segmentation | None = None, segments: int | None = None, seeds: Path | None = None, primitive: Primitives | None = None,
    sections: int | None = None, symmetry_tolerance: float | None = None, joint_reach: float | None = None,
    ctrl: Path | None = None, grp: Path | None = None, format: str | None = None, unit: Unit | None = None,
    up: Up | None = None, labels: Path | None = None, threads: int | None = None, progress: Progress | None = None,
) -> Comparison: ...
