"""The examples that people copy run, and print what is said beside them."""

import contextlib
import doctest
import io
import re

import pytest

import stackabilization
from conftest import SOURCE


def python_blocks(page):
    return [block for block in re.findall(r"```python\n(.*?)```", (SOURCE / page).read_text(), re.DOTALL)
            if "import" in block]


def printed_by(block, page):
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(block, page, "exec"), {})  # noqa: S102
    return printed.getvalue().splitlines()


@pytest.mark.parametrize("block", python_blocks("README.md"))
def test_examples_of_the_readme_print_what_they_say(block, monkeypatch):
    monkeypatch.chdir(SOURCE / "data/models")
    assert printed_by(block, "README.md") == re.findall(r"#> (.*)", block) != []


@pytest.mark.parametrize("block", python_blocks("docs/guide.md"))
def test_examples_of_the_guide_run(block, monkeypatch):
    monkeypatch.chdir(SOURCE / "data/models")
    assert printed_by(block, "guide.md")


def test_both_pages_have_examples():
    assert len(python_blocks("README.md")) >= 2 and python_blocks("docs/guide.md")


def test_the_example_of_help_prints_what_it_says(monkeypatch):
    monkeypatch.chdir(SOURCE / "data/models")
    tried = doctest.testmod(stackabilization, optionflags=doctest.ELLIPSIS)
    assert tried.attempted >= 3 and tried.failed == 0
