"""Computations that end before their time: interrupts, exits, forks, generators that nobody reads on."""

import os
import signal
import subprocess
import sys
import textwrap

import numpy
import pytest

import stackabilization as st
from conftest import MODELS

CHAIR = str(next(model for model in MODELS if model.stem == "chair"))
TABLE = str(next(model for model in MODELS if model.stem == "table"))


def started(code):
    return subprocess.Popen([sys.executable, "-c", textwrap.dedent(code)], stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, text=True)


def ended(code):
    with started(code) as process:
        try:
            out, errors = process.communicate(timeout=200)
        except subprocess.TimeoutExpired:
            process.kill()  # leaving `with` would wait for it
            raise
    return process.returncode, out, errors


# A vessel with so many faces that every call on it takes seconds, and a call that does not look at the clock.
LARGE = """
    import numpy, stackabilization as st
    n = 300
    turn, z = numpy.meshgrid(numpy.linspace(0, 2 * numpy.pi, n, endpoint=False), numpy.linspace(0, 1, n))
    r = 0.5 + 0.3 * z + 0.01 * numpy.sin(9 * turn) * numpy.sin(11 * z)
    wall = numpy.stack([r * numpy.cos(turn), r * numpy.sin(turn), z], -1).reshape(-1, 3)
    row, column = numpy.arange(n - 1)[:, None] * n, numpy.arange(n)[None]
    a, b = (row + column).ravel(), (row + (column + 1) % n).ravel()
    faces = numpy.concatenate([numpy.stack([a, b, a + n], -1), numpy.stack([b, b + n, a + n], -1)])
    large = st.Mesh(wall, faces)
"""


@pytest.mark.parametrize("call", [
    "st.inspect(large, self_intersections=True)",
    "st.measure(large, method='rays', resolution=20000)",
    "st.stack(large, n=3, twist_degrees='auto', lateral_clearance=0.01)",
    "[st.separation(large, large) for _ in range(1000)]",
    "[st.Solver(large) for _ in range(1000)]",
    "[st.gap(large, large) for _ in range(1000)]",
    "[st.validate(large) for _ in range(1000)]",
    "[st.compare(chair, chair) for _ in range(1000)]",
    "[st.suggest(chair) for _ in range(1000)]",
    "[st.deform(chair, edit='seat scale 1.05 along 1 0 0') for _ in range(1000)]",
    "[st.load(chair) for _ in range(100000)]",
])
def test_an_interrupt_ends_every_call(call):
    with started(LARGE + f"""
    chair = {CHAIR!r}
    try:
        print("running", flush=True)
        {call}
    except KeyboardInterrupt:
        print("interrupted", flush=True)
    """) as process:
        assert process.stdout.readline() == "running\n", process.stderr.read()
        process.send_signal(signal.SIGINT)
        out, errors = process.communicate(timeout=100)
    assert (out, errors, process.returncode) == ("interrupted\n", "", 0)


@pytest.mark.parametrize("code, status", [
    ("designs = st.improve(chair, target=0.99, effort=1000)", 0),
    ("designs = st.improve(chair, target=0.99, effort=1000); sys.exit(5)", 5),
    ("designs = st.improve(chair, target=0.99, effort=1000); 1 / 0", 1),
    # A cycle that nobody collects.
    ("designs = [st.improve(chair, target=0.99, effort=1000)]; designs.append(designs); sys.modules['kept'] = designs", 0),
    ("threading.Thread(target=lambda: st.map(chair, step_degrees=0.1, progress=print), daemon=True).start()", 0),
])
def test_the_interpreter_ends_while_something_is_computed(code, status):
    found = ended(f"import stackabilization as st, sys, threading; chair = {CHAIR!r}\n{code}")
    assert found[0] == status and ("Error" in found[2]) == (status == 1)


def test_a_generator_is_closed_dropped_or_left_behind():
    for leave in (lambda designs: designs.close(), lambda designs: None):
        designs = st.improve(TABLE, target=0.1, effort=1000)
        first = next(designs)
        assert first.name == "design"
        leave(designs)
        del designs
    assert first.mesh.faces.shape[1] == 3


def test_two_searches_at_once_find_the_same():
    one, other = (st.improve(TABLE, target=0.1, keep=["top"], effort=0.1) for _ in range(2))
    pairs = list(zip(one, other))
    assert pairs and all(numpy.array_equal(a.vertices, b.vertices) and a == b for a, b in pairs)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")
def test_a_fork_measures_and_leaves_the_computation_of_its_parent_alone():
    assert ended(f"""
        import os, numpy, warnings, stackabilization as st
        warnings.simplefilter("ignore", DeprecationWarning)  # of Python 3.12 and newer, of any fork beside threads
        solver, rows = st.Solver({CHAIR!r}), numpy.random.default_rng(1).normal(size=(2000, 3))
        expected = solver.measure_many(rows).f_max
        designs = st.improve({CHAIR!r}, target=0.99, effort=1000)
        child = os.fork()
        if child == 0:
            try:
                next(designs)
            except st.UsageError as error:
                print(error, flush=True)
            del designs
            os._exit(0 if numpy.array_equal(solver.measure_many(rows).f_max, expected) else 7)
        print(os.waitpid(child, 0)[1])
        """) == (0, "a computation cannot be waited for in another process\n0\n", "")
