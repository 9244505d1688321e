"""One step of one model: runs the program under a time limit and writes a record of how it went.

Ends with status 0 whatever the program did: a model that fails is a result of the workflow. Status other than 0 means
that there is no record, for instance because the folder cannot be written.
"""

import argparse
import json
import shlex
import signal
import subprocess
import sys
import time
from pathlib import Path

from records import STEPS, read_json, write_text


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--step", required=True, choices=STEPS)
    parser.add_argument("--model", required=True, type=Path, help="mesh file")
    parser.add_argument("--record", required=True, type=Path, help="file to be written; results go beside it")
    parser.add_argument("--program", default="stackabilize")
    parser.add_argument("--direction", default="0 0 1", help="three numbers")
    parser.add_argument("--boxes", default="oriented", choices=("oriented", "frame"))
    parser.add_argument("--gain", type=float, default=0.2, help="target is S + gain (1 - S)")
    parser.add_argument("--effort", type=float, default=1, help="work of the search for a design")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=600, help="limit of the step")
    parser.add_argument("--options", default="", help="more options for improve")
    parsed = parser.parse_args()
    if not 0 < parsed.gain < 1:
        parser.error(f"--gain {parsed.gain}: expected a number between 0 and 1")
    return parsed


def target(options):
    """The stackability to be reached, or None where the model could not be measured."""
    measured = read_json(options.record.with_name("measure.json"))
    if measured is None:
        return None
    return measured["stackability"] + options.gain * (1 - measured["stackability"])


def command(options, result):
    """The words of the command whose JSON is `result`, or None where there is nothing to go on from."""
    words = [options.program, options.step, str(options.model), "--threads", str(options.threads),
             "--boxes", options.boxes, "--no-timing"]
    direction = ["--direction", *options.direction.split()]
    if options.step == "search":
        return words + ["--json", str(result)]
    if options.step == "measure":
        return words + direction + ["--json", str(result)]
    wanted = target(options)
    if wanted is None:
        return None
    return words + direction + ["--target", repr(wanted), "--effort", str(options.effort), "--output", str(result.parent),
                                *shlex.split(options.options)]


def outcome(words, seconds):
    """How the command ended: the fields `status`, `exit_status` and `message` of a record."""
    try:
        ran = subprocess.run(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, timeout=seconds, check=False)
    except subprocess.TimeoutExpired:
        return {"status": "timed out", "exit_status": None, "message": f"stopped after {seconds:g} seconds"}
    except OSError as error:
        return {"status": "failed", "exit_status": None, "message": f"{words[0]}: {error.strerror}"}
    lines = ran.stderr.decode("utf-8", "replace").strip().splitlines()
    message = lines[-1] if lines else ""
    if ran.returncode in (0, 1):
        return {"status": "done" if ran.returncode == 0 else "no", "exit_status": ran.returncode, "message": ""}
    if ran.returncode < 0:
        message = f"ended by {signal.Signals(-ran.returncode).name}"
    return {"status": "failed", "exit_status": ran.returncode, "message": message}


def main():
    options = arguments()
    folder = options.record.parent
    folder.mkdir(parents=True, exist_ok=True)
    result = folder / f"{options.step}.json" if options.step != "improve" else folder / "improve" / "result.json"
    words = command(options, result)
    start = time.monotonic()
    if words is None:
        record = {"status": "skipped", "exit_status": None, "message": "the model could not be measured"}
    else:
        record = outcome(words, options.seconds)
    record = {"step": options.step, "model": str(options.model), "command": words, **record,
              "result": str(result.relative_to(folder)), "seconds": round(time.monotonic() - start, 3)}
    write_text(options.record, json.dumps(record, indent=2) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
