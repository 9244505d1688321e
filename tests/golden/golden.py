"""Checksums of what the program answers and writes, so that a change of the code is seen to change no result.

    golden.py PROGRAM [--models FOLDER ...] [--only NAME ...] [--commands NAME ...] [--threads N ...] [--load N]
              (--write FILE | --check FILE | --alike)

Every command is run on every mesh of the folders (without one: the shipped models), without a limit of time, from
inside the folder, so that no path is part of an answer. --write keeps the checksums of all JSON, meshes and tables;
--check compares with those that were kept, and says what differs, is missing or new. With several --threads all counts
must give the same bytes; --alike checks that alone. With --load the runs with all but the first number of threads have
so many busy processes beside them, which must change nothing either. Status 1 where anything differs.

The last digits depend on the compiler and the libraries: a file of checksums begins with both, and is compared only
where they are the same.
"""

import argparse
import contextlib
import hashlib
import json
import platform
import subprocess
import sys
import tempfile
from pathlib import Path

SUFFIXES = {".obj", ".off", ".ply", ".stl", ".3mf", ".glb", ".gltf"}
SHIPPED = Path(__file__).resolve().parents[2] / "data" / "models"
SEARCH = ["--target", "0.6", "--expansions", "4", "--no-pictures", "-o", "OUT"]
# OUT stands for a folder or, with a suffix, for a file, of its own; MODEL for the model itself.
COMMANDS = {
    "inspect": ["inspect"],
    "measure": ["measure", "--direction", "0.3", "-0.2", "1"],
    "measure_frame": ["measure", "--direction", "0", "0", "1", "--boxes", "frame", "--semantics", "closed"],
    "search": ["search", "--cone-degrees", "20"],
    "map": ["map", "--step-degrees", "30", "-o", "OUT.csv"],
    "stack": ["stack", "-n", "3", "-o", "OUT.obj"],
    "hold": ["hold", "-n", "5"],
    "validate": ["validate"],
    "gap": ["gap", "MODEL", "--direction", "0.1", "0", "1"],
    "draft": ["draft"],
    "items": ["items", "-o", "OUT.csv"],
    "compare": ["compare", "MODEL"],
    "structure": ["structure", "--save", "OUT.json"],
    "deform": ["deform", "--edit", "FIRST scale 1.05 along 0 0 1", "-o", "OUT.ply"],
    "deform_surface": ["deform", "--model", "surface", "--edit", "shape scale 1.05 along 1 0 0", "-o", "OUT.ply"],
    "suggest": ["suggest", "--top", "3"],
    "improve": ["improve", "--effort", "0.05", *SEARCH],
    "improve_paper": ["improve", "--effort", "0.05", "--preset", "paper", *SEARCH],
}


def platform_line(program):
    """What the last digits depend on."""
    version = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout.strip()
    libc = "-".join(platform.libc_ver())
    return f"# {platform.machine()} {libc} {version}"


def checksum(data):
    return hashlib.sha256(data).hexdigest()[:24]


def first_part(program, model):
    run = subprocess.run([program, "inspect", model.name, "--quiet", "--json", "-"], capture_output=True, text=True,
                         cwd=model.parent)
    try:
        return json.loads(run.stdout)["part_names"][0]
    except (ValueError, KeyError, IndexError):
        return "shape"


@contextlib.contextmanager
def busy(count):
    """So many processes that take what processor time they get."""
    loops = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(count)]
    try:
        yield
    finally:
        for loop in loops:
            loop.kill()
            loop.wait()


def answers(program, model, threads, commands, keep=None):
    """The checksum of everything that the commands give, by command and file. `keep`: folder for all of that."""
    found = {}
    first = first_part(program, model)
    for name in commands:
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder)
            stands_for = {"OUT": str(out / "out"), "FIRST": first, "MODEL": model.name}
            words = list(COMMANDS[name])
            for mark, text in stands_for.items():
                words = [word.replace(mark, text) for word in words]
            line = [program, words[0], model.name, *words[1:], "--threads", str(threads), "--quiet",
                    "--no-timing", "--json", str(out / "answer.json")]
            run = subprocess.run(line, capture_output=True, cwd=model.parent)
            said = run.stderr.replace(folder.encode(), b"OUT")
            found[f"{name}/status"] = f"{run.returncode} {checksum(said)}"
            for file in sorted(path for path in out.rglob("*") if path.is_file()):
                data = file.read_bytes().replace(folder.encode(), b"OUT")
                found[f"{name}/{file.relative_to(out)}"] = checksum(data)
                if keep:
                    copy = keep / model.name / name / file.relative_to(out)
                    copy.parent.mkdir(parents=True, exist_ok=True)
                    copy.write_bytes(data)
    return found


def compare(wanted, found, what):
    differing = [key for key in sorted(wanted.keys() | found.keys()) if wanted.get(key) != found.get(key)]
    for key in differing:
        how = "is new" if key not in wanted else "is missing" if key not in found else "differs"
        print(f"{key} {how} {what}")
    return not differing


def read_checksums(file):
    lines = file.read_text().splitlines()
    return lines[0], dict(reversed(line.split("  ", 1)) for line in lines[1:])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--models", nargs="+", type=Path, default=[SHIPPED])
    parser.add_argument("--only", nargs="+", help="names of models, without suffix")
    parser.add_argument("--commands", nargs="+", choices=COMMANDS, default=list(COMMANDS), metavar="NAME",
                        help="those of " + ", ".join(COMMANDS))
    parser.add_argument("--threads", nargs="+", type=int, default=[1, 2])
    parser.add_argument("--load", type=int, default=0)
    parser.add_argument("--keep", type=Path, help="folder for the answers and files, to see what differs")
    how = parser.add_mutually_exclusive_group(required=True)
    how.add_argument("--write", type=Path)
    how.add_argument("--check", type=Path)
    how.add_argument("--alike", action="store_true")
    options = parser.parse_args()
    program = str(Path(options.program).resolve())

    kept = {}
    if options.check:
        made_by, kept = read_checksums(options.check)
        if made_by != platform_line(program):
            print(f"SKIPPED: {options.check.name} was made by {made_by[2:]}, this is {platform_line(program)[2:]}")
            return 0
    models = sorted(path for folder in options.models for path in folder.rglob("*") if path.suffix.lower() in SUFFIXES)
    models = [model for model in models if not options.only or model.stem in options.only]
    if not models:
        print("SKIPPED: there are no models")
        return 0

    good = True
    all_found = {}
    for model in models:
        by_threads = {}
        for threads in options.threads:
            with busy(options.load if by_threads else 0):
                by_threads[threads] = answers(program, model, threads, options.commands, options.keep)
        found = by_threads[options.threads[0]]
        for threads, others in by_threads.items():
            good &= compare({f"{model.name}/{key}": value for key, value in found.items()},
                            {f"{model.name}/{key}": value for key, value in others.items()},
                            f"with {threads} threads")
        all_found |= {f"{model.name}/{key}": value for key, value in found.items()}
    if options.check:
        names = {model.name for model in models}
        good &= compare({key: value for key, value in kept.items() if key.split("/")[0] in names}, all_found,
                        f"from {options.check.name}")
    if options.write:
        lines = [f"{value}  {key}" for key, value in sorted(all_found.items())]
        options.write.write_text("\n".join([platform_line(program), *lines]) + "\n")
    print(f"{len(models)} models, {len(all_found)} answers and files, {'all as expected' if good else 'not all alike'}")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
