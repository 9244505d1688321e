"""Gathers the records of a collection: collection.csv, times.csv and report.md in the folder of the workflow."""

import argparse
import csv
import io
import statistics
import sys
from pathlib import Path

from records import STEPS, find_models, read_json, record_path, write_text

COLUMNS = ("model", "stackability", "best_stackability", "best_direction", "target", "reached", "stackability_after",
           "distortion", "root_mean_square_change", "measure", "search", "improve", "message")


def first_solution(improved):
    """The best solution of an improvement, else what came nearest to one, else {}."""
    if not improved:
        return {}
    return (improved.get("solutions") or [improved.get("nearest") or {}])[0]


def row(output, model):
    """The columns of a model, and the seconds of its steps. What there is no value for is empty."""
    records = {step: read_json(record_path(output, model, step)) or {"status": "no record"} for step in STEPS}
    results = {step: read_json(record_path(output, model, step).parent / record["result"])
               for step, record in records.items() if record["status"] in ("done", "no")}
    measured, searched, improved = (results.get(step) or {} for step in STEPS)
    solution = first_solution(improved)
    values = {
        "model": model,
        "stackability": measured.get("stackability"),
        "best_stackability": searched.get("stackability"),
        "best_direction": " ".join(repr(value) for value in searched.get("direction", [])),
        "target": improved.get("target", {}).get("stackability"),
        "reached": improved.get("reached"),
        "stackability_after": solution.get("stackability"),
        "distortion": solution.get("energy", {}).get("distortion", {}).get("total"),
        "root_mean_square_change": solution.get("change", {}).get("root_mean_square"),
        "message": next((record["message"] for record in records.values() if record.get("message")), ""),
        **{step: record["status"] for step, record in records.items()},
    }
    return values, {"model": model, **{step: record.get("seconds") for step, record in records.items()}}


def csv_text(columns, rows):
    text = io.StringIO()
    writer = csv.DictWriter(text, columns, lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()


def summary(rows):
    """The lines of report.md."""
    complete = [each for each in rows if each["improve"] in ("done", "no")]
    reached = [each for each in complete if each["reached"]]
    broken = [each for each in rows if each not in complete or each["search"] != "done"]
    lines = ["# Collection", "", f"{len(rows)} models: {len(complete)} went through every step, "
             f"{len(reached)} reached the target; without a result in some step: {len(broken)}.", ""]
    if reached:
        median = statistics.median_low
        lines += [f"Those that reached it: median S {median(each['stackability'] for each in reached):.4f} before and "
                  f"{median(each['stackability_after'] for each in reached):.4f} after, at a median distortion of "
                  f"{median(each['distortion'] for each in reached):.4f}.", ""]
    if broken:
        lines += ["| Model | measure | search | improve | message |", "| --- | --- | --- | --- | --- |"]
        for each in broken:
            cells = (each["model"], each["measure"], each["search"], each["improve"], each["message"])
            lines.append("| " + " | ".join(str(cell).replace("|", "\\|") for cell in cells) + " |")
    return "\n".join(lines).rstrip() + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--models", required=True, help="folder of the collection")
    parser.add_argument("--suffixes", required=True, help="of the files that are models")
    parser.add_argument("output", type=Path, help="folder of the workflow")
    options = parser.parse_args()
    try:
        models = find_models(options.models, options.suffixes)
        both = [row(options.output, model) for model in models]
        rows, times = [each for each, _ in both], [each for _, each in both]
        options.output.mkdir(parents=True, exist_ok=True)
        write_text(options.output / "collection.csv", csv_text(COLUMNS, rows))
        write_text(options.output / "times.csv", csv_text(("model", *STEPS), times))
        write_text(options.output / "report.md", summary(rows))
    except (OSError, ValueError) as error:
        print(f"report.py: {error}", file=sys.stderr)
        return 3
    print(f"Wrote {options.output / 'report.md'}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
