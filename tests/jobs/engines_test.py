#!/usr/bin/env python3
"""Jobs on this machine: images and sweeps by GNU parallel, what is printed for other engines, and mistakes of users.
Usage: engines_test.py NUSSELT NUSSELT-LAB SCENE [NAME...]"""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

NUSSELT, LAB, SCENE = map(os.path.abspath, sys.argv[1:4])
OPTIONS = ["--resolution", "160x90", "--spp", "4"]
SKIPPED = 77  # for CTest


class EnginesTest(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="nusselt jobs ")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def run_in(self, *command, **options):
        words = [str(word) for word in command]
        return subprocess.run(words, cwd=self.folder, capture_output=True, text=True, **options)

    def submit(self, *words, parts=4, engine="parallel", options=OPTIONS):
        return self.run_in(NUSSELT, "submit", SCENE, "--parts", parts, "--engine", engine, "-o", "image.exr", *words,
                           "--", *options)

    def expect_success(self, outcome):
        self.assertEqual(outcome.returncode, 0, outcome.stderr)

    def expect_same(self, a, b):
        table = self.run_in(NUSSELT, "compare", a, b, "--metrics", "rmse")
        self.expect_success(table)
        self.assertEqual(float(table.stdout.split()[1]), 0, table.stdout)

    def test_an_image_has_the_bits_of_one_run(self):
        """The folder's name has a space, and so has that of the job."""
        outcome = self.submit("--run", "--job", "my job")
        self.expect_success(outcome)
        self.assertEqual(outcome.stdout, f"{self.folder}/image.exr\n")
        self.expect_success(self.run_in(NUSSELT, "render", SCENE, *OPTIONS, "-q", "-o", "whole.exr"))
        self.expect_same("image.exr", "whole.exr")
        manifest = json.loads((self.folder / "my job/manifest.json").read_text())
        self.assertEqual(manifest["version"], 1)
        self.assertEqual([task["number"] for task in manifest["tasks"]], [1, 2, 3, 4])
        for task in manifest["tasks"]:
            self.assertIn("--isa", task["command"])

    def test_a_job_is_written_without_being_started(self):
        outcome = self.submit()
        self.expect_success(outcome)
        self.assertEqual(outcome.stdout, f"{self.folder}/image.job\n")
        self.assertFalse((self.folder / "image.exr").exists())
        self.expect_success(self.run_in(self.folder / "image.job/start.sh"))
        self.assertTrue((self.folder / "image.exr").exists())

    def test_the_same_command_continues(self):
        """After Ctrl-C, only what is missing is done, from the checkpoints on."""
        options = ["--resolution", "640x360", "--spp", "32", "--checkpoint-interval", "0.1"]
        command = [NUSSELT, "submit", SCENE, "--parts", "3", "--engine", "parallel", "-o", "image.exr", "--run", "--"]
        process = subprocess.Popen([*command, *options], cwd=self.folder, stderr=subprocess.PIPE, text=True)
        deadline = time.monotonic() + 60
        while not list(self.folder.glob("image.job/checkpoints/*")) and time.monotonic() < deadline:
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, err)
        self.assertIn("stopped; run the same command again to continue", err)
        self.assertFalse((self.folder / "image.exr").exists())
        self.expect_success(self.submit("--run", parts=3, options=options))
        self.expect_success(self.run_in(NUSSELT, "render", SCENE, *options[:4], "-q", "-o", "whole.exr"))
        self.expect_same("image.exr", "whole.exr")

    def test_templates_are_printed(self):
        outcome = self.submit(engine="print")
        self.expect_success(outcome)
        template = json.loads(outcome.stdout)
        self.assertEqual(template["specificationVersion"], "jobtemplate-2023-09")
        tasks, gather = template["steps"]
        self.assertEqual(tasks["parameterSpace"]["taskParameterDefinitions"],
                         [{"name": "Task", "type": "INT", "range": "1-4"}])
        self.assertEqual(gather["dependencies"], [{"dependsOn": tasks["name"]}])
        # What the engine would do.
        script = tasks["script"]["actions"]["onRun"]
        for number in range(1, 5):
            self.expect_success(self.run_in(script["command"], *(word.replace("{{Task.Param.Task}}", str(number))
                                                                 for word in script["args"])))
        self.expect_success(self.run_in(gather["script"]["actions"]["onRun"]["command"]))
        self.assertTrue((self.folder / "image.exr").exists())

    def test_mistakes_are_found_before_the_job_is_written(self):
        for words, options, code, text in (
                ((), ["--bad", "3"], 2, "unknown '--bad'"), ((), ["-o", "b.exr"], 2, "use the option -o of submit"),
                ((), ["--part", "1/2"], 2, "--parts"), ((), ["--spp", "x"], 2, "--spp"),
                ((), ["--threads", "2"], 2, "--threads"), ((), ["--backend", "vulkan"], 2, "--backend"),
                (("--engine", "lsf"), [], 2, "--engine"),
                (("--run", "--engine", "print"), [], 2, "--engine")):
            outcome = self.submit(*words, options=options)
            self.assertEqual(outcome.returncode, code, options)
            self.assertIn(text, outcome.stderr)
            self.assertEqual(outcome.stderr.count("\n"), 1, outcome.stderr)
            self.assertFalse((self.folder / "image.job").exists())
        outcome = self.submit("--run", engine="print")
        self.assertEqual(outcome.returncode, 2)
        self.assertIn("nothing can be started", outcome.stderr)

    def test_folders_of_other_jobs_stay_as_they_are(self):
        self.expect_success(self.submit())
        outcome = self.submit(parts=5)
        self.assertEqual(outcome.returncode, 1)
        self.assertIn("has another job; delete it", outcome.stderr)
        (self.folder / "other").mkdir()
        (self.folder / "other/file").write_text("")
        outcome = self.submit("--job", "other")
        self.assertEqual(outcome.returncode, 1)
        self.assertIn("has other files", outcome.stderr)

    def test_a_task_that_fails_for_good_is_named_with_its_reason(self):
        shutil.copy(SCENE, self.folder / "scene.pbrt")
        submit = [NUSSELT, "submit", "scene.pbrt", "--parts", 2, "--engine", "parallel", "-o", "image.exr"]
        self.expect_success(self.run_in(*submit, "--", *OPTIONS))
        (self.folder / "scene.pbrt").write_text("WorldBegin\nShape \"sphere\n")
        outcome = self.run_in(*submit, "--run", "--", *OPTIONS)
        self.assertEqual(outcome.returncode, 1)
        self.assertIn("2 of 2 tasks left no result: 1 2 (the first one: nusselt: error: ", outcome.stderr)
        self.assertFalse((self.folder / "image.exr").exists())

    def test_sweeps_of_images(self):
        outcome = self.run_in(LAB, "submit", "images", "--scene", SCENE, "--technique", "area", "--technique",
                              "solid_angle", "--seeds", 2, "--engine", "parallel", "--run", "-o", "sweep", "--", *OPTIONS)
        self.expect_success(outcome)
        for technique in ("area", "solid_angle"):
            self.assertTrue((self.folder / f"sweep/room-{technique}.exr").exists())

    def test_shards_of_the_fuzzer_are_one_run(self):
        outcome = self.run_in(LAB, "submit", "fuzz", "--shards", 3, "--count", 1000, "--engine", "parallel", "--run",
                              "-o", "fuzz.json", "--", "--technique", "LineSolidAngle")
        self.expect_success(outcome)
        manifest = json.loads((self.folder / "fuzz.job/manifest.json").read_text())
        pieces = [task["command"][2] for task in manifest["tasks"]]
        for piece, (first, count) in zip(pieces, ((0, 334), (334, 334), (668, 332))):
            self.assertIn(f"--first {first} --count {count} ", piece)
        results = json.loads((self.folder / "fuzz.json").read_text())
        self.assertEqual(results["settings"]["shards"], 3)
        rows = results["tables"][0]["rows"]
        self.assertEqual([row[0] for row in rows], [1, 2, 3])
        # A shard that found something is a result, and the job says so.
        shard = self.folder / "fuzz.job/results/2.json"
        json_of_shard = json.loads(shard.read_text())
        json_of_shard["tables"][0]["rows"][0][2] = 7
        shard.write_text(json.dumps(json_of_shard))
        outcome = self.run_in(LAB, "gather", "-o", "all.json", *sorted(self.folder.glob("fuzz.job/results/*")))
        self.assertEqual(outcome.returncode, 1)
        self.assertIn("broken contract", outcome.stderr)
        shard.write_text("{}")
        outcome = self.run_in(LAB, "gather", "-o", "all.json", *sorted(self.folder.glob("fuzz.job/results/*")))
        self.assertEqual(outcome.returncode, 1)
        self.assertIn("2.json", outcome.stderr)

    def test_shards_of_the_worst_case_have_seeds_of_their_own(self):
        outcome = self.run_in(LAB, "submit", "worst-case", "--shards", 2, "--starts", 8, "--seed", 5, "--engine",
                              "parallel", "--run", "-o", "worst.json", "--", "--target", "lines")
        self.expect_success(outcome)
        results = json.loads((self.folder / "worst.json").read_text())
        self.assertEqual([row[0] for row in results["tables"][0]["rows"]], [1, 2])


if __name__ == "__main__":
    if shutil.which("parallel") is None:
        print("skipped: parallel is missing", file=sys.stderr)
        sys.exit(1 if os.environ.get("CI") == "true" else SKIPPED)
    unittest.main(argv=[sys.argv[0], *("EnginesTest." + name for name in sys.argv[4:])], verbosity=2)
