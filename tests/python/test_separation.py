"""Exact separations, against closed forms and against a search by hand."""

import fractions

import numpy
import pytest

import stackabilization as st
from conftest import box


def test_two_boxes_are_as_far_apart_as_their_coordinates():
    below, above = box((0, 0, 0), (1, 1, 0.3)), box((0.5, 0.5, 0.7), (2, 2, 1))
    apart = st.separation(below, above)
    assert apart.exact == fractions.Fraction(0.3) - fractions.Fraction(0.7)
    assert apart.length == float(apart.exact) < 0
    assert st.separation(above, below).exact == 1
    assert st.separation(below, box((3, 3, 0), (4, 4, 1))) is None


def test_walls_slide_in_solid_and_touch_in_closed_semantics():
    below, beside = box((0, 0, 0), (1, 1, 1)), box((1, 0, 0), (2, 1, 1))
    assert st.separation(below, beside) is None
    assert st.separation(below, beside, semantics="closed").exact == 1


def test_the_exact_value_is_a_rational_of_the_coordinates():
    """A wedge under a wedge: heights on a common line are quotients of the doubles."""
    wedge = numpy.array([[0, 0, 0], [3, 0, 0], [3, 1, 0], [0, 1, 0], [0, 0, 1], [0, 1, 1]]), numpy.array(
        [[0, 2, 1], [0, 3, 2], [0, 1, 4], [2, 3, 5], [0, 4, 5], [0, 5, 3], [1, 2, 5], [1, 5, 4]])
    above = (numpy.array([[1, 0.2, 2], [2, 0.2, 2], [1, 0.8, 2.0]]), [[0, 1, 2]])
    assert st.separation(wedge, above).exact == fractions.Fraction(2, 3) - 2


def test_lengths_are_in_units_of_the_direction():
    below, above = box((0, 0, 0), (1, 1, 1)), box((0, 0, 5), (1, 1, 6))
    apart = st.separation(below, above, (0, 0, 2))
    assert apart.exact == -2 and apart.length == -4


def test_one_call_takes_the_place_of_lowering_until_it_clips(cup):
    """The loop that simulators use finds the same height, to the step of its bisection."""
    mesh = st.load(cup)
    exact = -st.gap(mesh, mesh).gap
    low, high = 0.0, float(numpy.ptp(mesh.vertices[:, 2]))
    while high - low > 1e-9:
        middle = (low + high) / 2
        lifted = st.Mesh(mesh.vertices + [0, 0, middle], mesh.faces)
        clips = st.separation(mesh, lifted).length > 0
        low, high = (middle, high) if clips else (low, middle)
    assert exact == pytest.approx(low, abs=2e-9)


def test_the_witness_names_rows_of_the_meshes():
    below, above = box((0, 0, 0), (1, 1, 1)), box((0, 0, 2), (1, 1, 3))
    witness = st.separation(below, above).witness
    assert (below[0][below[1][witness.upper_triangle]][:, 2] == 1).all()
    assert (above[0][above[1][witness.lower_triangle]][:, 2] == 2).all()
    assert witness.upper_point[:2] == pytest.approx(witness.lower_point[:2])


def test_a_gap_is_how_far_one_can_come_down():
    below, above = box((0, 0, 0), (1, 1, 0.3)), box((0.5, 0.5, 0.7), (2, 2, 1))
    found = st.gap(below, above)
    assert found.exact == fractions.Fraction(0.7) - fractions.Fraction(0.3) == -st.separation(below, above).exact
    assert found.gap == float(found.exact) and found.above == "<above>"
    assert st.gap(above, below).gap == -1
    assert st.gap(below, box((3, 3, 0), (4, 4, 1))).gap is None
    with pytest.raises(st.UsageError, match="MODEL is in mm and ABOVE is in an unknown unit"):
        st.gap(st.Mesh(*below, unit="mm"), st.Mesh(*above))


def test_a_gradient_is_a_quotient_of_differences(cup):
    mesh = st.load(cup)
    rows = numpy.random.default_rng(5).normal(size=mesh.vertices.shape)
    rows *= 1e-9  # the cup is no longer the same all around, so one pair alone causes f_max
    noisy = st.Mesh(mesh.vertices + 1000 * rows, mesh.faces)
    gradient = st.Solver(noisy).gradient()
    moved = [st.Solver(st.Mesh(noisy.vertices + sign * rows, mesh.faces)).separation().length for sign in (1, -1)]
    assert (moved[0] - moved[1]) / 2 == pytest.approx((gradient * rows).sum(), rel=1e-5)
    assert (gradient * noisy.vertices).sum() == pytest.approx(st.Solver(noisy).separation().length)


def test_the_touches_of_a_box_say_what_any_of_its_corners_does():
    vertices, faces = box((0, 0, 0), (2, 3, 1))
    gradient = st.measure((vertices, faces)).gradient
    assert gradient.complete and gradient.one_plane_each
    moves = numpy.random.default_rng(6).normal(size=vertices.shape)
    products = [(touch.upper * moves[faces[touch.triangles[0]]]).sum()
                + (touch.lower * moves[faces[touch.triangles[1]]]).sum() for touch in gradient.touches]
    moved = st.separation((vertices + 1e-7 * moves, faces), (vertices + 1e-7 * moves, faces)).length
    assert (moved - 1) / 1e-7 == pytest.approx(max(products), abs=1e-5)
    assert st.gap((vertices, faces), (vertices + [0, 0, 5], faces)).gradient.touches[0].normal == pytest.approx([0, 0, 1])


def test_a_parameter_of_a_cup_descends_to_a_wanted_pitch(cup):
    """The rim of the cup is widened until each further copy adds 15 mm."""
    mesh, wanted, rim = st.load(cup), 0.015, 1.0
    across = mesh.vertices * [1, 1, 0] * (mesh.vertices[:, 2:] / numpy.ptp(mesh.vertices[:, 2]))  # by the factor
    for _ in range(20):
        solver = st.Solver((mesh.vertices + (rim - 1) * across, mesh.faces))
        error = solver.separation().length - wanted
        rim -= error / (solver.gradient() * across).sum()
    assert error == pytest.approx(0, abs=1e-12) and 1.2 < rim < 1.3


def test_there_is_no_gradient_where_nothing_is_in_the_way():
    flat = st.Solver(([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]))
    assert flat.gradient((1, 0, 0)) is None and not flat.gradient().any()


def test_a_box_drops_to_the_bottom_of_what_it_fits_in():
    floor, item = box((0, 0, 0), (4, 4, 0.5)), box((7, 7, 7), (8, 8, 8))
    found = st.drop(item, onto=floor, place="best", eps=0.01)
    beside = st.drop(item, onto=floor, place="best", eps=0.01, corner=[(9, 9), (10, 9), (10, 10)])
    assert found.height == 0.5 and found.proven and 0.49 <= found.bound <= 0.5
    assert beside.on_floor
    corner = found.transform @ [7, 7, 7, 1]
    assert corner[2] == pytest.approx(0.5) and (0 <= corner[:2]).all() and (corner[:2] <= 3).all()
    assert st.drop(item, onto=floor).on_floor and st.drop(item, onto=floor).bound is None


def test_a_plate_finds_the_place_with_the_least_space_or_gap_below_it():
    # A step, 1 and 2 high: over 1 of 3 of the plate there is a gap of 1, in the best case.
    step = tuple(numpy.concatenate(parts) for parts in zip(box((0, 0, 0), (2, 2, 1)), box((2, 0, 0), (4, 2, 2))))
    step[1][12:] += 8
    plate = box((0, 0, 7), (3, 2, 8))
    space = st.drop(plate, onto=step, place="best", least="volume")
    gap = st.drop(plate, onto=step, place="best", least="gap", overlap=0.9)
    assert space.proven and space.mean_depth["low"] <= 1 / 3 <= space.mean_depth["high"] + 1e-9
    assert space.volume["low"] <= 2 + 1e-9 and space.bound <= 1 / 3 + 1e-9 and space.mean_gap is None
    assert gap.mean_gap["high"] == pytest.approx(1 / 3, abs=0.02) and gap.mean_depth is None


def test_the_map_of_a_drop_has_the_height_at_each_place():
    mound = (numpy.array([[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0], [1, 2, 3.0]]),
             [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [0, 2, 1], [0, 3, 2]])
    item = box((0, 0, 0), (0.5, 0.5, 0.5))
    found = st.drop(item, onto=mound, map=True, step=0.7)
    assert found.heights.shape[1] == 3 and len(found.heights) > 20 and not found.heights.flags.writeable
    for x, y, height in found.heights:
        placed = (item[0] + [x - 0.25, y - 0.25, 0], item[1])
        assert st.drop(placed, onto=mound).height == pytest.approx(height, abs=1e-12)
    assert found.heights[:, 2].max() > 2 and st.drop(item, onto=mound).heights is None
    with pytest.raises(st.UsageError, match="--step needs --map"):
        st.drop(item, onto=mound, step=0.7)
