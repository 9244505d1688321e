#!/usr/bin/env python3
"""Runs the commands of the guide, in their order, on copies of this project's models.

    guide.py PROJECT PROGRAM    PROGRAM is the stackabilize to run; everything happens in a temporary folder

A command may end with 0, or with 1 where its answer may be no. Searches do a tenth of their work: what they find is
tested elsewhere.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ANSWERS = re.compile(r"--within|stackabilize (improve|suggest)")
SEARCH = re.compile(r"stackabilize improve")


def commands(text):
    """The indented blocks but the first, which builds: line by line, loops in one piece."""
    blocks = re.findall(r"(?:^ {4}.*\n)+", text, re.MULTILINE)[1:]
    for block in blocks:
        lines = [line[4:] for line in block.splitlines()]
        yield from ["\n".join(lines)] if lines[0].startswith("for ") else lines


def main():
    project, program = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
    environment = dict(os.environ, PATH=f"{program.parent}{os.pathsep}{os.environ['PATH']}")
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        for model in (project / "data/models").glob("*.obj"):
            shutil.copy(model, folder)
        for command in commands((project / "docs/guide.md").read_text(encoding="utf-8")):
            if SEARCH.search(command):
                command += " --effort 0.1"
            run = subprocess.run(["bash", "-c", command], cwd=folder, env=environment, text=True,
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            if run.returncode not in ((0, 1) if ANSWERS.search(command) else (0,)):
                failures += 1
                print(f"{command}\n  ended with {run.returncode}:\n{run.stdout}")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
