"""Measures what Python adds to the C++ code: per direction, per call, and when the package is loaded.

    PYTHONPATH=build/release/python python3 experiments/speed/python_overhead.py [--directions N] [--repeats N] [-o FOLDER]

Each time stands beside another that is taken in the same run, turn by turn, and its ratio to it is the result: processor
seconds of one thread, the least of the repeats. With -o the table goes to FOLDER/python_overhead.clocks.csv.
"""

import argparse
import contextlib
import csv
import pathlib
import subprocess
import sys
import time

import numpy

import stackabilization as st

MODELS = pathlib.Path(__file__).parents[2] / "data/models"


def seconds(work):
    start = time.process_time()
    work()
    return time.process_time() - start


def loading(module):
    """Of a fresh interpreter; of our package without what NumPy costs, which is loaded before."""
    code = f"import time{', numpy' if module != 'numpy' else ''}; start = time.process_time(); import {module}; " \
           "print(time.process_time() - start)"
    return float(subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout)


def paired(first, second, repeats):
    """The least of each, taken in turns."""
    pairs = [(first(), second()) for _ in range(repeats)]
    return [min(column) for column in zip(*pairs)]


def table(directions, repeats):
    cup = st.Solver(st.load(MODELS / "cup.obj"))
    # Along its plane a triangle takes next to nothing to measure, so that what Python adds is all there is.
    triangle = st.Solver(([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]))
    along_plane = numpy.tile([1.0, 0, 0], (directions, 1))
    upwards = numpy.column_stack((numpy.linspace(0, 0.5, directions), numpy.zeros(directions), numpy.ones(directions)))
    one_by_one = upwards[:: max(1, directions // 200)]

    def per_direction(solver, rows):
        return lambda: seconds(lambda: solver.measure_many(rows, threads=1)) / len(rows)

    def in_a_loop():
        return seconds(lambda: [cup.measure(row) for row in one_by_one]) / len(one_by_one)

    comparisons = [
        ("a direction of measure_many", "a triangle along its plane", per_direction(triangle, along_plane),
         "the cup", per_direction(cup, upwards)),
        ("a direction of the cup", "a loop over measure, with contacts and box", in_a_loop, "measure_many", per_direction(cup, one_by_one)),
        ("import", "stackabilization, after numpy", lambda: loading("stackabilization"), "numpy", lambda: loading("numpy")),
    ]
    for quantity, first_name, first, second_name, second in comparisons:
        times = paired(first, second, repeats)
        yield {"quantity": quantity, "first": first_name, "first_cpu_seconds": times[0], "second": second_name,
               "second_cpu_seconds": times[1], "ratio": times[0] / times[1]}


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--directions", type=int, default=20_000, help="rows of each array")
    parser.add_argument("--repeats", type=int, default=7, help="of each time; the least counts")
    parser.add_argument("-o", "--output", type=pathlib.Path, help="folder of the table (default: standard output)")
    options = parser.parse_args()
    if min(options.directions, options.repeats) < 1:
        parser.error("--directions and --repeats expect whole numbers from 1")
    rows = list(table(options.directions, options.repeats))
    if options.output:
        options.output.mkdir(parents=True, exist_ok=True)
        destination = open(options.output / "python_overhead.clocks.csv", "w", newline="")
    else:
        destination = contextlib.nullcontext(sys.stdout)
    with destination as stream:
        stream.write(f"# program: python_overhead\n# options: directions = {options.directions}, "
                     f"repeats = {options.repeats}\n# version: {st.__version__}\n")
        writer = csv.DictWriter(stream, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


if __name__ == "__main__":
    main()
