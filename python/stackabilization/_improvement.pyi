from collections.abc import Generator, Mapping, Sequence
from fractions import Fraction
from typing import Any, Literal

from ._core import Mesh
from ._results import OfModel, Structured
from ._types import (
    Boxes, DeformationModel, Floats, Length, MeshLike, Names, Path, Primitives, Progress, Relaxed, Segmentation,
    Semantics, Unit, Up, Vector,
)

class Design(Structured):
    name: str
    direction: Floats
    target: float
    stackability: float
    stackability_before: float
    f_max: float
    f_max_exact: Fraction
    height: float
    explanation: tuple[str, ...]
    edits: list[dict[str, Any]]
    change: dict[str, Any]
    requirements: list[dict[str, Any]]
    stack: dict[str, Any]
    holding: dict[str, Any] | None
    good: bool
    @property
    def vertices(self) -> Floats: ...

class Improvement(OfModel):
    reached: bool
    target: dict[str, Any]
    diagnosis: dict[str, Any] | None
    search: dict[str, Any]
    front: list[dict[str, Any]] | None
    def __init__(self, document: dict[str, Any], meshes: Mapping[str, Mesh], texts: Mapping[str, str]) -> None: ...
    @property
    def solutions(self) -> tuple[Design, ...]: ...
    @property
    def nearest(self) -> Design | None: ...

def improve(
    mesh: MeshLike, *, target: float | None = None, copies: int | None = None, within: Length | None = None,
    solutions: int | None = None, front: bool = False, direction: Vector | Sequence[Vector] | None = None,
    semantics: Semantics | None = None, boxes: Boxes | None = None, model: DeformationModel | None = None,
    preset: Literal["refined", "paper"] | None = None,
    least: Literal["both", "distortion", "displacement"] | None = None, effort: float | None = None,
    time: float | None = None, expansions: int | None = None, alpha: float | None = None, bend: bool = False,
    cone_degrees: float | None = None, keep: Names | None = None, only: Names | None = None,
    change_height: bool = False, box_tolerance: float | str | None = None, thickness: Length | None = None,
    clearance: Length | None = None, lateral_clearance: Length | None = None, draft_degrees: float | None = None,
    standing: int | None = None, tilt_degrees: float | None = None, friction: float | None = None,
    rest_on: str | None = None, relax: Relaxed | None = None,
    any_quality: bool = False, remove: Names | None = None, twist: bool = False,
    segmentation: Segmentation | None = None, segments: int | None = None, seeds: Path | None = None,
    primitive: Primitives | None = None, sections: int | None = None, symmetry_tolerance: float | None = None,
    joint_reach: float | None = None, ctrl: Path | None = None, grp: Path | None = None, format: str | None = None,
    unit: Unit | None = None, up: Up | None = None, labels: Path | None = None, threads: int | None = None,
    progress: Progress | None = None,
) -> Generator[Design, None, Improvement]: ...

def improvement(
    mesh: MeshLike, *, target: float | None = None, copies: int | None = None, within: Length | None = None,
    solutions: int | None = None, front: bool = False, direction: Vector | Sequence[Vector] | None = None,
    semantics: Semantics | None = None, boxes: Boxes | None = None, model: DeformationModel | None = None,
    preset: Literal["refined", "paper"] | None = None,
    least: Literal["both", "distortion", "displacement"] | None = None, effort: float | None = None,
    time: float | None = None, expansions: int | None = None, alpha: float | None = None, bend: bool = False,
    cone_degrees: float | None = None, keep: Names | None = None, only: Names | None = None,
    change_height: bool = False, box_tolerance: float | str | None = None, thickness: Length | None = None,
    clearance: Length | None = None, lateral_clearance: Length | None = None, draft_degrees: float | None = None,
    standing: int | None = None, tilt_degrees: float | None = None, friction: float | None = None,
    rest_on: str | None = None, relax: Relaxed | None = None,
    any_quality: bool = False, remove: Names | None = None, twist: bool = False,
    segmentation: Segmentation | None = None, segments: int | None = None, seeds: Path | None = None,
    primitive: Primitives | None = None, sections: int | None = None, symmetry_tolerance: float | None = None,
    joint_reach: float | None = None, ctrl: Path | None = None, grp: Path | None = None, format: str | None = None,
    unit: Unit | None = None, up: Up | None = None, labels: Path | None = None, threads: int | None = None,
    progress: Progress | None = None,
) -> Improvement: ...
