"""structure, deform, suggest, improve and compare."""

import json

import numpy
import pytest

import stackabilization as st
from conftest import program_json


@pytest.fixture(scope="module")
def chair_structure(chair):
    return st.structure(chair)


@pytest.fixture(scope="module")
def table(chair):
    return str(chair.with_name("table.obj"))


def test_a_structure_has_a_mesh_with_its_parts(chair, chair_structure):
    mesh = chair_structure.mesh
    assert chair_structure.part_names == mesh.parts
    counts = numpy.bincount(mesh.face_parts)
    assert [part["triangles"] for part in chair_structure.parts] == counts.tolist()
    assert numpy.array_equal(mesh.vertices, st.load(chair).vertices)


def test_a_project_goes_on_without_an_analysis(chair, chair_structure, tmp_path):
    project = tmp_path / "chair.json"
    project.write_text(chair_structure.project)
    edit = "seat scale 1.05 along 1 0 0"
    from_text = st.deform(chair_structure, edit=edit)
    from_file = st.deform(project, edit=edit)
    anew = st.deform(chair, edit=edit)
    assert from_text.relations == from_file.relations
    assert numpy.allclose(from_text.mesh.vertices, anew.mesh.vertices, atol=1e-12)
    assert numpy.array_equal(from_text.mesh.vertices, from_file.mesh.vertices)
    assert from_text.model == "<mesh>"


def test_edits_keep_the_joints_and_the_mesh_shows_them(chair_structure):
    edited = st.deform(chair_structure, edit=["seat scale 1.05 along 1 0 0"], keep_extent=(0, 0, 1))
    assert edited.refusal is None and edited.residuals["joint"] < 1e-6
    moved = numpy.linalg.norm(edited.mesh.vertices - chair_structure.mesh.vertices, axis=1)
    assert moved.max() == pytest.approx(edited.displacement["largest"])
    assert numpy.ptp(edited.mesh.vertices[:, 2]) == pytest.approx(numpy.ptp(chair_structure.mesh.vertices[:, 2]))


def test_what_cannot_be_edited_is_refused_with_a_reason(chair_structure):
    refused = st.deform(chair_structure, edit="seat move 0 0 0.1", fix=["seat"])
    assert refused.mesh is None and refused.refusal["reason"] and refused.project is None


def test_edits_that_are_none_are_refused(chair_structure):
    with pytest.raises(st.UsageError, match="nowhere"):
        st.deform(chair_structure, edit="nowhere move 0 0 1")
    with pytest.raises(st.UsageError, match="--segments"):
        st.deform(chair_structure, edit="seat move 0 0 1", segments=3)


def test_suggestions_are_applied_and_rolled_back(chair_structure):
    first = st.suggest(chair_structure, top=4)
    assert 0 < len(first.suggestions) <= 4
    values = [suggestion.energy["value"] for suggestion in first.suggestions]
    assert values == sorted(values)
    applied = st.suggest(chair_structure, apply=1)
    second = st.suggest(applied, top=1)
    assert second.now["stackability"] == pytest.approx(first.suggestions[0].stackability, rel=1e-9)
    back = st.suggest(applied, roll_back=0)
    assert back.history["current"] == 0 and len(back.history["nodes"]) == 2
    by_hand = st.deform(chair_structure, edit=first.suggestions[0].edit, keep_extent=(0, 0, 1), extent_ends="fixed")
    assert st.measure(by_hand.mesh).stackability == pytest.approx(first.suggestions[0].stackability, rel=1e-6)


def test_a_shape_is_acceptable_beside_itself(chair):
    compared = st.compare(chair, st.load(chair))
    assert compared.acceptable and compared.after == "<after>"
    squashed = st.load(chair)
    squashed = st.Mesh(squashed.vertices * [1, 1, 0.5], squashed.faces)
    assert not st.compare(chair, squashed).acceptable


def test_a_file_in_which_y_points_up_is_compared_with_one_in_which_z_does(chair, tmp_path):
    lying, standing = tmp_path / "lying.obj", tmp_path / "standing.obj"
    mesh = st.load(chair)
    faces = "".join(f"f {a} {b} {c}\n" for a, b, c in mesh.faces + 1)
    for path, axes in ((lying, [[1, 0, 0], [0, 0, 1], [0, -1, 0]]), (standing, numpy.eye(3))):
        path.write_text("".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in (mesh.vertices @ numpy.transpose(axes)).tolist())
                        + faces)
    assert st.compare(lying, standing, up="y", after_up="z").acceptable
    assert not st.compare(lying, standing, up="y").acceptable
    with pytest.raises(st.UsageError, match="in memory"):
        st.compare(lying, mesh, after_up="z")


def test_designs_come_as_they_are_found(table):
    designs = st.improve(table, target=0.3, keep=["top"], effort=0.3)
    rest = st.load(table)
    seen = list(designs)
    names = [design.name for design in seen]
    assert names[0] == "design" and "solution_1" in names
    assert names.index("solution_1") == names.count("design")
    for design in seen:
        assert design.stackability >= 0.3
        assert st.measure(design.mesh, direction=design.direction).f_max == pytest.approx(design.f_max, rel=1e-9)
        assert numpy.array_equal(design.mesh.faces, rest.faces) and design.vertices.shape == rest.vertices.shape
    assert all(design.good for design in seen if design.name != "design")


def test_an_improvement_is_what_the_program_writes(table, tmp_path):
    found = st.improvement(table, target=0.3, effort=0.3)
    expected = program_json("improve", table, "--target", "0.3", "--effort", "0.3", "--no-pictures",
                            "-o", tmp_path / "designs")
    assert json.dumps(found.to_dict()) == json.dumps(expected)
    written = st.load(tmp_path / "designs/solution_1.obj")
    assert numpy.array_equal(found.solutions[0].vertices, written.vertices)


def test_a_target_that_is_missed_is_explained(table):
    missed = st.improvement(table, target=0.99, effort=0.05)
    assert not missed.reached and missed.solutions == () and missed.diagnosis["blockers"]
    assert missed.nearest.stackability < 0.99 and missed.nearest.mesh is not None


def test_wishes_are_refused_in_the_words_of_the_program(table):
    with pytest.raises(st.UsageError, match="expected --target S, or --copies N with --within LENGTH"):
        st.improvement(table)
    with pytest.raises(st.UsageError, match="--keep expects the name of a part"):
        st.improvement(table, target=0.8, keep=["wheel"])
