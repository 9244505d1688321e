"""The examples that people copy run, and print what is said beside them."""

import contextlib
import io
import re

import pytest

from conftest import SOURCE


def python_blocks():
    text = (SOURCE / "README.md").read_text()
    return [block for block in re.findall(r"```python\n(.*?)```", text, re.DOTALL) if "import" in block]


@pytest.mark.parametrize("block", python_blocks())
def test_examples_of_the_readme_print_what_they_say(block, monkeypatch):
    monkeypatch.chdir(SOURCE / "data/models")
    said = re.findall(r"#> (.*)", block)
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(block, "README.md", "exec"), {})  # noqa: S102
    assert printed.getvalue().splitlines() == said


def test_the_readme_has_examples():
    assert len(python_blocks()) >= 2
