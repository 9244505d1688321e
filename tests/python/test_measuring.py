"""measure, inspect, search, map and validate."""

import copy
import fractions
import math
import pickle

import numpy
import pytest

import stackabilization as st
from conftest import box, program_error


def test_a_box_stacks_by_its_height():
    measured = st.measure(box((0, 0, 0), (1, 2, 3)))
    assert (measured.f_max, measured.height, measured.stackability) == (3, 3, 0)
    assert measured.f_max_exact == fractions.Fraction(3)
    assert measured.box_volume == pytest.approx(6)
    assert repr(measured) == "<Measurement: stackability=0, f_max=3, height=3, direction=(0, 0, 1)>"


def test_directions_are_exact_doubles_of_any_length():
    measured = st.measure(box((0, 0, 0), (1, 1, 1)), direction=(0, 0, 0.3))
    assert measured.f_max_exact == 1 / fractions.Fraction(0.3)
    assert measured.direction.tolist() == [0, 0, 0.3] and measured.f_max == 1


def test_the_witness_attains_f_max(chair):
    mesh = st.load(chair)
    measured = st.measure(mesh)
    witness = measured.witness
    assert witness.upper_point[2] - witness.lower_point[2] == pytest.approx(measured.f_max, rel=1e-14)
    for triangle, point in ((witness.upper_triangle, witness.upper_point),
                            (witness.lower_triangle, witness.lower_point)):
        corners = mesh.vertices[mesh.faces[triangle]]
        assert (point >= corners.min(axis=0) - 1e-12).all() and (point <= corners.max(axis=0) + 1e-12).all()


def test_results_cannot_be_changed(cup):
    measured = st.measure(cup)
    with pytest.raises(AttributeError):
        measured.f_max = 0
    with pytest.raises(ValueError):
        measured.direction[0] = 1
    measured.to_dict()["contacts"].clear()
    assert measured.contacts and measured == st.measure(cup)


def test_results_are_copied_and_pickled(cup):
    for result in (st.measure(cup), st.stack(cup), st.map(cup, step_degrees=45), st.structure(cup)):
        for again in (copy.deepcopy(result), pickle.loads(pickle.dumps(result))):
            assert again == result and repr(again) == repr(result)
            with pytest.raises(AttributeError):
                again.model = "other"
            with pytest.raises(AttributeError):
                del again.model
    assert numpy.array_equal(pickle.loads(pickle.dumps(st.map(cup, step_degrees=45))).stackability,
                             st.map(cup, step_degrees=45).stackability)


def test_a_layer_says_how_much_is_close(cup):
    layer = st.measure(cup, layer=0.5).layer
    assert 0 < layer["close_share"] < 1 and layer["distance"] == 0.5
    assert st.measure(cup).layer is None
    with pytest.raises(st.UsageError, match="--layer needs --method exact"):
        st.measure(cup, layer=0.5, method="rays")


def test_sampling_says_what_it_did(cup):
    sampled = st.measure(cup, method="raster", resolution=64)
    assert sampled.sampling["resolution"] == 64 and sampled.witness is None and sampled.f_max_exact is None


def test_self_intersections_are_counted_where_asked_for(cup):
    assert st.inspect(cup).findings.self_intersections is None
    assert st.inspect(cup, self_intersections=True).findings.self_intersections == 0


@pytest.mark.parametrize("keywords, arguments", [
    ({"direction": (0, 0, 0)}, ["--direction", 0, 0, 0]),
    ({"direction": (0, numpy.inf, 1)}, ["--direction", 0, "inf", 1]),
    ({"semantics": "soft"}, ["--semantics", "soft"]),
    ({"resolution": 0}, ["--resolution", 0]),
    ({"threads": -1}, ["--threads", -1]),
    ({"unit": "yard"}, ["--unit", "yard"]),
])
def test_options_are_refused_in_the_words_of_the_program(cup, keywords, arguments):
    with pytest.raises(st.UsageError) as refusal:
        st.measure(cup, **keywords)
    assert str(refusal.value) == program_error("measure", cup, *arguments)


@pytest.mark.parametrize("keywords, words", [
    ({"direction": (0, 0, 1, 1)}, r"direction expects three numbers, found \(0, 0, 1, 1\)"),
    ({"direction": []}, r"direction expects three numbers, found \[\]"),
    ({"direction": "0 0 1"}, "direction expects three numbers, found '0 0 1'"),
    ({"direction": 7}, "direction expects three numbers, found 7"),
    ({"resolution": object}, "resolution expects a number, a text or a list of these, found <class 'object'>"),
    ({"threads": True}, "threads expects a number, a text or a list of these, found True"),
    ({"semantics": "so\0lid"}, "semantics expects a text in UTF-8, found 'so\\\\x00lid'"),
])
def test_values_of_other_types_are_refused(cup, keywords, words):
    with pytest.raises(st.UsageError, match=words):
        st.measure(cup, **keywords)


def test_flags_are_true_or_false(cup):
    with pytest.raises(st.UsageError, match="self_intersections expects True or False, found 1"):
        st.inspect(cup, self_intersections=1)
    assert st.inspect(cup, self_intersections=numpy.bool_(True)).findings.self_intersections == 0


def test_a_search_finds_what_no_sample_of_the_map_beats(cup):
    best = st.search(cup, cone_degrees=30)
    mapped = st.map(cup, step_degrees=10)
    assert best.stackability >= mapped.stackability[mapped.theta_degrees <= 30].max() - 1e-9
    assert best.optima[0].stackability == pytest.approx(best.stackability)


def test_a_search_proves_that_no_direction_is_better():
    # A box saves nothing along any direction.
    corners = numpy.array([[x, y, z] for x in (0, 1) for y in (0, 2) for z in (0, 3)], dtype=float)
    hull = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4],
            [1, 5, 7], [1, 7, 3]]
    found = st.search((corners, hull), certify=0.05)
    assert found.proven and found.open_cells == 0 and found.cells > 0
    assert found.stackability == pytest.approx(0, abs=1e-9) and 0 <= found.bound <= 0.05 and found.accuracy == 0.05
    early = st.search((corners, hull), certify=0.05, max_cells=1)
    assert early.proven is False and found.bound <= early.bound <= 1 and early.open_cells > 0
    unasked = st.search((corners, hull))
    assert unasked.proven and unasked.accuracy == 0.001 and unasked.bound <= unasked.stackability + 0.001
    assert st.search((corners, hull), max_cells=0).bound is None
    with pytest.raises(st.UsageError, match="certify"):
        st.search((corners, hull), certify=0.05, boxes="frame")


def test_a_map_agrees_with_its_solver(cup):
    mapped = st.map(cup, step_degrees=15)
    again = st.Solver(cup).measure_many(mapped.directions)
    assert numpy.array_equal(mapped.stackability, again.stackability)
    assert numpy.array_equal(mapped.f_max_over_height, again.f_max / again.height)
    assert mapped.best.stackability == mapped.stackability.max()
    assert numpy.allclose(numpy.cos(numpy.radians(mapped.theta_degrees)), mapped.directions[:, 2])


def test_independent_methods_agree(cup):
    assert st.validate(cup).passed


def test_what_lies_between_others_is_undercut():
    boxes = [box((0, 0, 5), (10, 10, 6)), box((1, 4, 2), (9, 5, 3))]
    seat_over_bar = (numpy.vstack([corners for corners, _ in boxes]),
                     numpy.vstack([boxes[0][1], boxes[1][1] + len(boxes[0][0])]))
    draft = st.draft(seat_over_bar)
    assert draft.undercut_area == pytest.approx(16) and draft.area == pytest.approx(274) and draft.complete
    assert draft.triangle_undercut_areas.sum() == pytest.approx(16) and draft.min_draft_degrees == 0
    assert set(draft.triangle_draft_degrees) == {0, 90} and not draft.triangle_areas.flags.writeable
    assert (draft.triangle_inner_areas == 0).all() and draft.parts[0]["undercut_area"] == draft.undercut_area
    assert st.draft(seat_over_bar, draft_degrees=0).little_draft_area == 0
    with pytest.raises(st.UsageError, match="draft"):
        st.draft(seat_over_bar, draft_degrees=91)


def test_a_stack_of_blocks_on_a_slope_needs_its_friction():
    corners, faces = box((0, 0, 0), (4, 3, 1))
    corners = corners.astype(float)
    corners[:, 2] += corners[:, 0] / 4
    held = st.hold((corners, faces), n=3, friction=0.5)
    assert held.needed_friction == pytest.approx(0.25, rel=1e-5) and held.n == 3 and not held.jams
    assert held.centring_slope == pytest.approx(-0.25) and len(held.contacts) == 1 and held.tight_walls == []
    level = st.hold(box((0, 0, 0), (2, 2, 2)), friction=2)
    assert level.stands and level.tipping_degrees == pytest.approx(math.degrees(math.atan(0.5)))
    with pytest.raises(st.UsageError, match="friction"):
        st.hold((corners, faces), friction=-1)
