"""Many directions: the same numbers one by one, in any number of threads, without leaks."""

import concurrent.futures
import resource

import numpy
import pytest

import stackabilization as st
from conftest import box


def directions(count, seed=1):
    rows = numpy.random.default_rng(seed).normal(size=(count, 3))
    return rows / numpy.linalg.norm(rows, axis=1, keepdims=True)


def test_many_directions_are_measured_as_one_by_one(chair):
    solver = st.Solver(chair)
    asked = directions(40)
    many = solver.measure_many(asked)
    for row, f_max, height, value in zip(asked, many.f_max, many.height, many.stackability):
        one = solver.measure(row)
        assert f_max == pytest.approx(one.f_max, rel=1e-11) and height == one.height
        assert value == pytest.approx(one.stackability, rel=1e-9)


def test_a_solver_measures_what_the_function_measures(chair):
    solver = st.Solver(str(chair), semantics="closed", boxes="frame")
    assert solver.measure((0.1, 0, 1)).to_dict()["exact"] == st.measure(
        str(chair), direction=(0.1, 0, 1), semantics="closed", boxes="frame").to_dict()["exact"]
    assert st.Solver(str(chair)).measure() == st.measure(str(chair))


def test_threads_change_nothing(cup):
    solver = st.Solver(cup)
    asked = directions(3000)
    alone = solver.measure_many(asked, threads=1)
    assert numpy.array_equal(alone.f_max, solver.measure_many(asked).f_max)


def test_a_solver_serves_many_threads_at_once(cup):
    solver = st.Solver(cup)
    parts = [directions(300, seed) for seed in range(8)]
    expected = [solver.measure_many(part).f_max for part in parts]
    with concurrent.futures.ThreadPoolExecutor(8) as pool:
        found = list(pool.map(lambda part: solver.measure_many(part).f_max, parts))
    assert all(map(numpy.array_equal, expected, found))


@pytest.mark.parametrize("rows, words", [
    ([[0, 0, 1], [0, 0, 0]], "row 1 of the directions: a direction cannot be (0, 0, 0)"),
    ([[0, 0, 1], [0, numpy.nan, 0]], "row 1 of the directions: a direction needs three finite numbers"),
])
def test_rows_that_are_no_directions_are_named(rows, words):
    with pytest.raises(st.UsageError) as refusal:
        st.Solver(box((0, 0, 0), (1, 1, 1))).measure_many(rows)
    assert str(refusal.value) == words


def test_other_shapes_of_directions_are_refused():
    solver = st.Solver(box((0, 0, 0), (1, 1, 1)))
    with pytest.raises(st.InputError, match=r"directions expects an array of shape \(n, 3\), found \(3,\)"):
        solver.measure_many([0, 0, 1])
    with pytest.raises(st.UsageError, match="direction expects three numbers"):
        solver.measure([0, 1])
    with pytest.raises(st.UsageError, match="--threads expects a whole number from 1 to 1024, found '0'"):
        solver.measure_many([[0, 0, 1]], threads=0)
    assert len(solver.measure_many(numpy.zeros((0, 3)))) == 0


def test_flat_meshes_have_no_stackability_but_a_height():
    flat = st.Solver(([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]))
    many = flat.measure_many([[0, 0, 1], [1, 0, 0]])
    assert numpy.isnan(many.stackability).all() and many.height.tolist() == [0, 1]
    assert flat.measure().stackability is None


def test_memory_does_not_grow():
    mesh = box((0, 0, 0), (1, 2, 3))
    solver = st.Solver(mesh)
    rows = directions(4)

    def calls(count):
        for _ in range(count):
            solver.measure_many(rows)
            solver.separation()
            st.separation(mesh, mesh)
            st.measure(mesh)

    calls(500)
    grown = []
    for _ in range(5):
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        calls(500)
        grown.append(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before)
    # A leak grows with every batch; threads that come late take memory of their own once.
    assert min(grown) < 200  # kB, over 2,000 calls of each batch
