"""The package itself: what it loads, what it documents, and that its keywords are the program's options."""

import ast
import csv
import inspect
import os
import pathlib
import re
import shutil
import subprocess
import sys

import pytest

import stackabilization as st
from conftest import SOURCE
from stackabilization import _core

PACKAGE = pathlib.Path(st.__file__).parent
FUNCTIONS = [name for name in _core.commands() if name != "edit"]  # which serves a page

# Options that say where the program writes, and how much it prints.
OF_FILES = {"--json", "--quiet", "--no-timing", "--seed", "--help", "-h", "--version", "--picture", "--pictures",
            "--output", "-o", "--to-unit", "--save", "--graph", "--no-pictures", "--resume", "--history",
            "--list-handles"}


def keyword_of(names):
    longest = max(names, key=len)
    return longest.lstrip("-").replace("-", "_")


def test_every_command_is_a_function():
    assert all(callable(getattr(st, name)) for name in FUNCTIONS)


@pytest.mark.parametrize("command", FUNCTIONS)
def test_keywords_are_the_options_of_the_program(command):
    keywords = {name for name, parameter in inspect.signature(getattr(st, command)).parameters.items()
                if parameter.kind is parameter.KEYWORD_ONLY} - {"progress"}
    options = {keyword_of(option["names"]) for option in _core.options(command)
               if not OF_FILES.intersection(option["names"])}
    # Where nothing runs in parallel there is no --threads to ask for.
    assert keywords == options - ({"threads"} if command == "inspect" else set())


@pytest.mark.parametrize("command", FUNCTIONS)
def test_help_explains_every_keyword(command):
    function = getattr(st, command)
    doc = inspect.getdoc(function)
    missing = {name for name in inspect.signature(function).parameters
               if name != "mesh" and not re.search(rf"\b{name}\b", doc)}
    shared = {"segmentation", "segments", "seeds", "primitive", "sections", "symmetry_tolerance", "joint_reach", "ctrl",
              "grp", "format", "unit", "up", "labels", "threads", "progress"}
    if "Other keywords: as in `structure`" in doc or "other keywords: as in `structure`" in doc:
        missing -= shared
    if "keep to any_quality: as in `improve`" in doc:
        missing -= {"only", "change_height", "box_tolerance", "thickness", "clearance", "lateral_clearance",
                    "draft_degrees", "standing", "tilt_degrees", "friction", "rest_on", "relax"}
    assert not missing


def test_every_public_name_and_attribute_is_documented():
    for name in st.__all__:
        thing = getattr(st, name)
        assert inspect.getdoc(thing), name
        if inspect.isclass(thing):
            for member, value in vars(thing).items():
                if not member.startswith("_"):
                    assert getattr(value, "__doc__", None), f"{name}.{member}"


def test_stubs_name_what_the_compiled_part_has():
    stubs = {node.name if hasattr(node, "name") else node.target.id
             for node in ast.parse((PACKAGE / "_core.pyi").read_text()).body
             if isinstance(node, (ast.ClassDef, ast.FunctionDef, ast.AnnAssign))}
    assert stubs == {name for name in dir(_core) if not name.startswith("_")}
    assert (PACKAGE / "py.typed").exists()


EXAMPLE = """
import numpy
import stackabilization as st

measured: st.Measurement = st.measure("chair.obj", direction=(0, 0, 1), threads=1)
pitch: float = measured.f_max
exact = measured.f_max_exact
if exact is not None:
    half = exact / 2
solver = st.Solver((numpy.eye(3), [[0, 1, 2]]), semantics="closed")
rows = solver.measure_many(numpy.eye(3)).f_max
print(rows.shape, st.stack(solver.mesh, n=3).transforms[2], st.gap("a.obj", "b.obj").gap)
for design in st.improve(st.structure("chair.obj"), target=0.6, keep=["seat"], progress=print):
    design.vertices.sum()
    print(design.name, design.edits, design.stackability)
"""


@pytest.mark.skipif(shutil.which("mypy") is None, reason="mypy is not installed")
def test_strict_type_checks_pass_and_find_mistakes(tmp_path):
    def checked(name, text):
        (tmp_path / name).write_text(text)
        return subprocess.run(["mypy", "--strict", "--python-executable", sys.executable, "--cache-dir",
                               tmp_path / "cache", name], capture_output=True, text=True, check=False, cwd=tmp_path,
                              env={**os.environ, "MYPYPATH": str(PACKAGE.parent)})

    right = checked("right.py", EXAMPLE)
    assert right.returncode == 0, right.stdout
    wrong = checked("wrong.py", EXAMPLE + "st.measure(7)\nst.measure('a.obj', semantics='soft')\nst.stack('a', m=3)\n")
    assert wrong.returncode == 1 and wrong.stdout.count("error:") == 3, wrong.stdout


def signatures(path):
    """By function, names, kinds and defaults of what it takes."""
    found = {}
    for node in ast.parse(path.read_text()).body:
        if isinstance(node, ast.FunctionDef) and not node.name.startswith("_"):
            defaults = [default and ast.unparse(default) for default in node.args.defaults + node.args.kw_defaults]
            found[node.name] = ([arg.arg for arg in node.args.args], [arg.arg for arg in node.args.kwonlyargs], defaults)
    return found


def test_stubs_have_the_signatures_of_the_functions():
    assert signatures(PACKAGE / "_commands.pyi") == signatures(PACKAGE / "_commands.py")
    assert signatures(PACKAGE / "_improvement.pyi")["improve"] == signatures(PACKAGE / "_improvement.py")["improve"]


def test_the_package_loads_without_vtk():
    code = "import stackabilization; print(open('/proc/self/maps').read())"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert "libstackabilization" in loaded or "_core" in loaded
    assert "libvtk" not in loaded and "libEGL" not in loaded


def test_the_ratios_of_the_overhead_are_those_of_its_times(tmp_path):
    program = SOURCE / "experiments/speed/python_overhead.py"
    subprocess.run([sys.executable, program, "--directions", "50", "--repeats", "2", "-o", tmp_path], check=True)
    lines = (tmp_path / "python_overhead.clocks.csv").read_text().splitlines()
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    assert [row["quantity"] for row in rows] == ["a direction of measure_many", "a direction of the cup", "import"]
    for row in rows:
        times = float(row["first_cpu_seconds"]), float(row["second_cpu_seconds"])
        assert min(times) > 0 and float(row["ratio"]) == pytest.approx(times[0] / times[1])
    refused = subprocess.run([sys.executable, program, "--repeats", "0"], check=False, capture_output=True, text=True)
    assert refused.returncode == 2 and "expect whole numbers from 1" in refused.stderr


def test_the_version_is_that_of_the_program(cup):
    assert st.__version__ == st.inspect(cup).to_dict()["version"]
