"""All commands on every mesh of outside data: test_every_mesh.py PROGRAM [COUNT [SLOWDOWN]].

The folders are those that STACKABILIZATION_PAPER_DATA and STACKABILIZATION_CORPORA name; with COUNT an evenly spread
sample of so many files. A program with sanitizers computes SLOWDOWN times as long, and reserves more addresses than
there is memory. Whatever is in a file, a command ends within a minute of computing on one core and within its
memory, with a status from 0 to 3: with a result that is JSON without NaN, or with one sentence and no result. Every
other run is listed with its command line, and then the status of this script is 1.
"""

import json
import os
import resource
import shlex
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

CPU_SECONDS = 60
GUARD_SECONDS = 20 * CPU_SECONDS  # of the clock, for what waits for ever
ADDRESS_SPACE = 6 << 30
SUFFIXES = {".obj", ".off", ".ply", ".stl", ".3mf", ".glb", ".gltf"}
FOLDERS = ("STACKABILIZATION_PAPER_DATA", "STACKABILIZATION_CORPORA")
# OUT stands for a name in an empty folder, MODEL for the mesh once more.
COMMANDS = [
    ["inspect", "--self-intersections"],
    ["measure", "--direction", "0.3", "-0.2", "1"],
    ["search", "--cone-degrees", "10", "--certify", "0.05", "--max-cells", "100"],
    ["map", "--step-degrees", "30", "-o", "OUT.csv"],
    ["stack", "-n", "3", "-o", "OUT.obj"],
    ["hold", "-n", "3"],
    ["gap", "MODEL", "--direction", "0.3", "-0.2", "1"],
    ["drop", "--onto", "MODEL", "--place", "best", "--max-cells", "300", "-o", "OUT.stl"],
    ["items", "--step", "0.01", "-o", "OUT.csv"],
    ["draft", "-o", "OUT.csv"],
    ["compare", "MODEL"],
    ["validate"],
    ["structure", "--save", "OUT.json"],
    ["deform", "--edit", "shape scale 1.1", "-o", "OUT.ply"],
    ["suggest", "--top", "3"],
    ["improve", "--target", "0.5", "--expansions", "2", "--time", "5", "--solutions", "1", "--no-pictures", "-o", "OUT"],
]


def mesh_files():
    files = []
    for variable in FOLDERS:
        if folder := os.environ.get(variable):
            files += [path for path in Path(folder).rglob("*") if path.suffix.lower() in SUFFIXES and path.is_file()]
    return sorted(files)


def spread(files, count):
    if count >= len(files):
        return files
    return [files[(2 * k + 1) * len(files) // (2 * count)] for k in range(count)]


SLOWDOWN = int(sys.argv[3]) if len(sys.argv) > 3 else 1


def limit():
    if SLOWDOWN == 1:
        resource.setrlimit(resource.RLIMIT_AS, (ADDRESS_SPACE, ADDRESS_SPACE))
    resource.setrlimit(resource.RLIMIT_CPU, (SLOWDOWN * CPU_SECONDS, SLOWDOWN * CPU_SECONDS + 5))


def refuse_constant(name):
    raise ValueError(f"{name} in the JSON")


def complaint(line, result):
    """What is wrong with this run, or None."""
    try:
        ran = subprocess.run(line, capture_output=True, timeout=SLOWDOWN * GUARD_SECONDS, preexec_fn=limit)
    except subprocess.TimeoutExpired:
        return f"does not end within {SLOWDOWN * GUARD_SECONDS} s"
    if ran.returncode == -signal.SIGXCPU:
        return f"computes for more than {SLOWDOWN * CPU_SECONDS} s"
    words = ran.stderr.decode(errors="replace")
    if ran.returncode not in range(4):
        return f"ends with {ran.returncode}: {words[-300:]}"
    if "unexpected failure" in words or "more memory" in words:
        return words[-300:]
    if ran.returncode >= 2:
        if not words.startswith("stackabilize: ") or words.count("\n") != 1:
            return f"does not say in one sentence why it ends with {ran.returncode}: {words[-300:]}"
        return "leaves a result although it fails" if result.exists() else None
    try:
        json.loads(result.read_text(), parse_constant=refuse_constant)
    except (OSError, ValueError) as error:
        return f"writes no good JSON: {error}"
    return None


def main():
    program = sys.argv[1]
    files = mesh_files()
    if not files:
        print("SKIPPED: neither", " nor ".join(FOLDERS), "names a folder with meshes")
        return 0
    if len(sys.argv) > 2:
        files = spread(files, int(sys.argv[2]))
    offenders = 0
    for path in files:
        for command in COMMANDS:
            with tempfile.TemporaryDirectory() as folder:
                result = Path(folder) / "result.json"
                options = [str(path) if word == "MODEL" else word.replace("OUT", f"{folder}/out")
                           for word in command[1:]]
                line = [program, command[0], str(path), *options, "--threads", "1", "--quiet", "--json", str(result)]
                if wrong := complaint(line, result):
                    offenders += 1
                    print(f"{shlex.join(line)}\n    {wrong}", flush=True)
    print(f"{len(files)} files, {len(files) * len(COMMANDS)} runs, {offenders} of them wrong")
    return 1 if offenders else 0


sys.exit(main())
