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
    solver = st.Solver(mesh)
    exact = solver.separation().length
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
