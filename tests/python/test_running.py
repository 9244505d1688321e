"""Long calls: they tell how far they are, and stop when asked to."""

import signal
import subprocess
import sys
import textwrap

import numpy
import pytest

import stackabilization as st


class Enough(Exception):
    """Raised by a callable that has seen enough."""


@pytest.mark.parametrize("call, step", [
    (lambda mesh, progress: st.search(mesh, progress=progress), "Searching"),
    (lambda mesh, progress: st.map(mesh, step_degrees=5, progress=progress), "Mapping"),
    (lambda mesh, progress: st.structure(mesh, progress=progress), "Fitting primitives"),
    (lambda mesh, progress: st.Solver(mesh).measure_many(numpy.eye(3), progress=progress), "Measuring"),
])
def test_progress_goes_from_nothing_to_all(chair, call, step):
    told = []
    call(chair, lambda *arguments: told.append(arguments))
    fractions = [fraction for name, fraction in told if name == step]
    assert fractions and fractions == sorted(fractions) and 0 <= fractions[0] and fractions[-1] <= 1


def test_what_a_callable_raises_ends_the_call(chair):
    def progress(step, fraction):
        raise Enough(step)

    for call in (st.search, st.map):
        with pytest.raises(Enough):
            call(chair, progress=progress)
    with pytest.raises(Enough):
        st.Solver(chair).measure_many(numpy.eye(3), progress=progress)
    with pytest.raises(Enough):
        st.structure(chair, progress=progress)
    with pytest.raises(Enough):
        list(st.improve(chair, target=0.9, progress=progress))


@pytest.mark.parametrize("call", [
    "st.map(mesh, step_degrees=0.1, progress=progress)",
    "st.Solver(mesh).measure_many(numpy.tile([0.1, 0.2, 1.0], (3_000_000, 1)), progress=progress)",
    "list(st.improve(mesh, target=0.99, effort=1000, progress=progress))",
    "[st.structure(mesh, sections=900, progress=progress) for _ in range(20)]",
])
def test_an_interrupt_ends_a_long_call(chair, call):
    code = textwrap.dedent(f"""
        import numpy, stackabilization as st
        mesh = st.load({str(chair)!r})
        told = False
        def progress(step, fraction):
            global told
            first, told = not told, True
            if first:
                print("running", flush=True)
        try:
            {call}
        except KeyboardInterrupt:
            print("interrupted")
    """)
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "running\n"
        process.send_signal(signal.SIGINT)
        assert process.communicate(timeout=120)[0] == "interrupted\n"
    assert process.returncode == 0


def test_a_generator_that_is_closed_ends_its_search(chair):
    designs = st.improve(chair, target=0.99, effort=1000, progress=lambda *_: designs_told.append(1))
    designs_told = []
    designs.close()
    assert not designs_told
