"""The notebook runs from its first cell to its last, and prints what it shows."""

import copy

import pytest

from conftest import SOURCE

nbclient = pytest.importorskip("nbclient")
nbformat = pytest.importorskip("nbformat")
pytest.importorskip("ipykernel")
pytest.importorskip("matplotlib")


def texts(cell):
    return "".join(output["text"] for output in cell.get("outputs", []) if output["output_type"] == "stream")


def pictures(cell):
    return [output["data"]["image/png"] for output in cell.get("outputs", [])
            if output["output_type"] == "display_data"]


def test_the_tour_shows_what_it_prints():
    shown = nbformat.read(SOURCE / "docs/tour.ipynb", 4)
    run = copy.deepcopy(shown)
    nbclient.NotebookClient(run, timeout=600, resources={"metadata": {"path": str(SOURCE / "docs")}}).execute()
    for before, after in zip(shown.cells, run.cells):
        assert len(pictures(before)) == len(pictures(after))
        # How a search words what it found may change with the search.
        if "improve(" not in before["source"]:
            assert texts(before) == texts(after)
    assert sum(len(pictures(cell)) for cell in run.cells) >= 5
