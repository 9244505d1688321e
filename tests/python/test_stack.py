"""Stacks as transforms, and one mesh in another."""

import fractions
import pickle

import numpy
import pytest

import stackabilization as st
from conftest import box


def placed(mesh, transform):
    vertices = numpy.asarray(mesh[0]) @ transform[:3, :3].T + transform[:3, 3]
    return vertices, mesh[1]


def test_copies_stand_on_each_other():
    tray = box((0, 0, 0), (2, 1, 0.5))
    stack = st.stack(tray, n=4)
    assert stack.transforms.shape == (4, 4, 4)
    assert stack.transforms[:, 2, 3].tolist() == [0, 0.5, 1, 1.5]
    assert stack.height == 2 and stack.nesting_increment == 0.5
    assert stack.exact_offsets[3] == fractions.Fraction(3, 2)


def test_copies_of_a_real_chair_touch_and_do_not_overlap(chair):
    mesh = st.load(chair)
    stack = st.stack(mesh, n=3, twist_degrees=7)
    copies = [placed((mesh.vertices, mesh.faces), transform) for transform in stack.transforms]
    for below, above in zip(copies, copies[1:]):
        assert st.separation(below, above).length == pytest.approx(0, abs=1e-9)


def test_clearance_may_have_a_unit():
    stack = st.stack(box((0, 0, 0), (1, 1, 1)), unit="cm", clearance="2mm")
    assert stack.clearance == pytest.approx(0.2) and stack.nesting_increment == pytest.approx(1.2)


def test_prints_are_stacked_in_whole_layers_with_separators():
    tile = box((0, 0, 0), (4, 3, 2))
    stack = st.stack(tile, n="max", within=9, clearance=0.2, layer=0.25, separators=True)
    assert (stack.n, stack.nesting_increment, stack.layer) == (4, 2.25, 0.25)
    body = stack.separators
    assert (body.vertices.min(axis=0).tolist(), body.vertices.max(axis=0).tolist()) == ([0, 0, 2], [4, 3, 2.25])
    below, above = placed((body.vertices, body.faces), stack.transforms[0]), placed(tile, stack.transforms[1])
    assert st.gap(below, above).gap == 0
    assert pickle.loads(pickle.dumps(stack)).separators.vertices.shape == body.vertices.shape
    assert st.stack(tile).separators is None


def test_the_room_that_is_asked_for_is_met_or_not():
    assert st.stack(box((0, 0, 0), (1, 1, 1)), n=3, within=3).within["met"]
    assert not st.stack(box((0, 0, 0), (1, 1, 1)), n=3, within=2.9).within["met"]


def test_one_mesh_is_lowered_into_another():
    crate = [box((0, 0, 0), (4, 4, 1)), box((0, 0, 1), (1, 4, 3)), box((3, 0, 1), (4, 4, 3))]
    vertices = numpy.vstack([part[0] for part in crate])
    faces = numpy.vstack([part[1] + 8 * i for i, part in enumerate(crate)])
    ball = box((1.5, 1.5, 10), (2.5, 2.5, 11))
    nest = st.stack(ball, into=(vertices, faces))
    assert isinstance(nest, st.Nest) and nest.exact_offset == -9 and not nest.on_floor
    assert nest.transform[2, 3] == -9 and nest.height == 3
    assert nest.model == "<mesh>" and nest.into == "<into>"


def test_options_that_do_not_go_together_are_refused():
    cube = box((0, 0, 0), (1, 1, 1))
    with pytest.raises(st.UsageError, match="--twist-degrees auto cannot be combined with --period"):
        st.stack(cube, twist_degrees="auto", period=2)
    with pytest.raises(st.UsageError, match="-n makes no sense with --into"):
        st.stack(cube, into=cube, n=3)
