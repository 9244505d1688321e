"""The workflow of experiments/collection on a collection with a broken model: test_collection.py SOURCE PROGRAM."""

import csv
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE, PROGRAM = Path(sys.argv[1]), Path(sys.argv[2])
WORKFLOW = SOURCE / "experiments" / "collection"
BROKEN = "sub/it's | broken.obj"


def python(script, *arguments):
    return subprocess.run([sys.executable, WORKFLOW / script, *map(str, arguments)], capture_output=True, text=True)


class Collection(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.models, self.output = self.folder / "in", self.folder / "out"
        (self.models / "sub").mkdir(parents=True)
        shutil.copy(SOURCE / "data" / "models" / "table.obj", self.models)
        (self.models / BROKEN).write_text("v 1 x\n")
        (self.models / "notes.txt").write_text("no model\n")

    def step(self, step, model, *options):
        record = self.output / "models" / model / f"{step}.record.json"
        ran = python("step.py", "--step", step, "--model", self.models / model, "--record", record,
                     "--program", PROGRAM, "--gain", "0.1", "--options=--no-pictures --preset paper --expansions 5", *options)
        self.assertEqual(ran.returncode, 0, ran.stderr)
        return json.loads(record.read_text())

    def rows(self):
        ran = python("report.py", "--models", self.models, "--suffixes", ".obj .off", self.output)
        self.assertEqual(ran.returncode, 0, ran.stderr)
        with open(self.output / "collection.csv", encoding="utf-8") as file:
            return {row["model"]: row for row in csv.DictReader(file)}

    def test_a_broken_model_is_a_row_of_the_report(self):
        self.assertEqual(self.step("measure", BROKEN)["exit_status"], 3)
        self.assertEqual(self.step("improve", BROKEN)["status"], "skipped")
        self.assertEqual(self.step("measure", "table.obj")["status"], "done")
        self.assertEqual(self.step("improve", "table.obj")["status"], "done")
        rows = self.rows()
        self.assertEqual(sorted(rows), [BROKEN, "table.obj"])
        self.assertIn("broken.obj:1: expected the y coordinate", rows[BROKEN]["message"])
        table = rows["table.obj"]
        before, target = float(table["stackability"]), float(table["target"])
        self.assertAlmostEqual(target, before + 0.1 * (1 - before), places=12)
        self.assertGreaterEqual(float(table["stackability_after"]), target)
        self.assertEqual(table["search"], "no record")
        self.assertIn("2 models: 1 went through every step", (self.output / "report.md").read_text())
        self.assertIn("| sub/it's \\| broken.obj | failed |", (self.output / "report.md").read_text())

    def test_a_step_that_takes_too_long_is_stopped(self):
        record = self.step("search", "table.obj", "--seconds", "0.001")
        self.assertEqual((record["status"], record["exit_status"]), ("timed out", None))

    def test_a_program_that_is_not_there_is_told(self):
        record = self.step("search", "table.obj", "--program", self.folder / "nothing")
        self.assertEqual(record["status"], "failed")
        self.assertIn("No such file", record["message"])

    def test_a_missing_collection_is_refused(self):
        ran = python("report.py", "--models", self.folder / "none", "--suffixes", ".obj", self.output)
        self.assertEqual(ran.returncode, 3)
        self.assertIn("none: no such folder", ran.stderr)
        self.assertFalse(self.output.exists())

    @unittest.skipUnless(shutil.which("snakemake"), "snakemake is not installed")
    def test_the_workflow_goes_on_after_a_broken_model_and_where_it_was_cut_off(self):
        command = ["snakemake", "--snakefile", WORKFLOW / "Snakefile", "--profile", WORKFLOW / "profiles" / "local",
                   "--config", f"models={self.models}", f"output={self.output}", f"program={PROGRAM}", "gain=0.1",
                   "options=--no-pictures --preset paper --expansions 5"]
        environment = {**os.environ, "XDG_CACHE_HOME": str(self.folder / "cache")}

        def run():
            ran = subprocess.run(list(map(str, command)), cwd=self.folder, env=environment, capture_output=True, text=True)
            self.assertEqual(ran.returncode, 0, ran.stderr)
            return (self.output / "collection.csv").read_bytes()

        first = run()
        rows = self.rows()
        self.assertEqual((rows["table.obj"]["improve"], rows[BROKEN]["measure"]), ("done", "failed"))
        kept = self.output / "models" / "table.obj" / "search.record.json"
        before = kept.stat().st_mtime_ns
        (self.output / "models" / "table.obj" / "improve.record.json").unlink()
        self.assertEqual(run(), first)
        self.assertEqual(kept.stat().st_mtime_ns, before)


if __name__ == "__main__":
    if not shutil.which("snakemake"):
        print("SKIPPED in part: snakemake is not installed, its workflow is not run")
    unittest.main(argv=sys.argv[:1], verbosity=2)
