"""What the steps of the workflow and its report share: which files are models, and the records of steps."""

import json
import os
from pathlib import Path

STEPS = ("measure", "search", "improve")


def find_models(folder, suffixes):
    """Model name -> path of every file below `folder` with one of the suffixes (words, any case), sorted.

    The name is the path below the folder. Raises ValueError when there is no such folder or no model in it.
    """
    folder = Path(folder)
    if not folder.is_dir():
        raise ValueError(f"{folder}: no such folder, expected the models of a collection")
    wanted = tuple(suffix.lower() for suffix in suffixes.split())
    found = sorted(path for path in folder.rglob("*") if path.is_file() and path.name.lower().endswith(wanted))
    if not found:
        raise ValueError(f"{folder}: no file ends with {' '.join(wanted)}")
    return {path.relative_to(folder).as_posix(): path for path in found}


def record_path(output, model, step):
    return Path(output) / "models" / model / f"{step}.record.json"


def read_json(path):
    """The content of a JSON file, or None where there is none that can be read."""
    try:
        return json.loads(Path(path).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None


def write_text(path, text):
    """Writes a file that is complete or not there."""
    temporary = Path(f"{path}.tmp")
    temporary.write_text(text, encoding="utf-8")
    os.replace(temporary, path)
