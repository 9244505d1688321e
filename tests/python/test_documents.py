"""to_dict() is what the program writes with --json."""

import json

import pytest

import stackabilization as st
from conftest import MODELS, program_json


def same(result, *arguments):
    found, expected = result.to_dict(), program_json(*arguments)
    assert list(found) == list(expected)
    assert json.dumps(found) == json.dumps(expected)


@pytest.mark.parametrize("model", [str(model) for model in MODELS[::3]], ids=[model.stem for model in MODELS[::3]])
def test_measuring_says_the_same(model):
    same(st.inspect(model, self_intersections=True), "inspect", model, "--self-intersections")
    same(st.measure(model, direction=(0.1, -0.2, 1), semantics="closed"), "measure", model, "--direction", "0.1",
         "-0.2", "1", "--semantics", "closed")
    same(st.Solver(model).measure(), "measure", model)
    same(st.stack(model, n=3, period=2, unit="m", clearance="1mm"), "stack", model, "-n", "3", "--period", "2",
         "--unit", "m", "--clearance", "1mm")
    same(st.map(model, step_degrees=30), "map", model, "--step-degrees", "30")
    same(st.structure(model), "structure", model)


@pytest.mark.parametrize("model", [str(model) for model in MODELS if model.stem in ("cup", "chair", "crate")])
def test_searching_and_editing_say_the_same(model):
    same(st.search(model, cone_degrees=20), "search", model, "--cone-degrees", "20")
    same(st.stack(model, into=str(MODELS[0])), "stack", model, "--into", MODELS[0])
    same(st.gap(model, str(MODELS[0]), direction=(0, 0.1, 1)), "gap", model, MODELS[0], "--direction", "0", "0.1", "1")
    same(st.items(model, str(MODELS[0]), unit="m", clearance="2mm"), "items", model, MODELS[0], "--unit", "m",
         "--clearance", "2mm")
    same(st.compare(model, model), "compare", model, model)
    same(st.suggest(model, top=3), "suggest", model, "--top", "3")
