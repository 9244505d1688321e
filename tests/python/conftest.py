import json
import os
import pathlib
import subprocess

import numpy
import pytest

SOURCE = pathlib.Path(os.environ["STACKABILIZATION_SOURCE_DIR"])
PROGRAM = os.environ["STACKABILIZATION_PROGRAM"]
MODELS = sorted((SOURCE / "data/models").glob("*.obj"))


def program_json(*arguments):
    """What the program writes with --json for the same question."""
    run = subprocess.run([PROGRAM, *map(str, arguments), "--json", "-", "--no-timing"], capture_output=True, text=True,
                         check=False)
    assert run.returncode in (0, 1), run.stderr
    return json.loads(run.stdout)


def program_error(*arguments):
    """The sentence that the program refuses something with."""
    run = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False)
    assert run.returncode in (2, 3), run.stdout
    return run.stderr.removeprefix("stackabilize: ").rstrip("\n")


def box(low, high):
    """Vertices and outward faces of an axis-aligned box."""
    low, high = numpy.array(low, float), numpy.array(high, float)
    vertices = numpy.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]) * (high - low) + low
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    faces = numpy.array([f for a, b, c, d in quads for f in ((a, b, c), (a, c, d))])
    return vertices, faces


@pytest.fixture(scope="session")
def chair():
    return SOURCE / "data/models/chair.obj"


@pytest.fixture(scope="session")
def cup():
    return SOURCE / "data/models/cup.obj"
