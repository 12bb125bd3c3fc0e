#!/usr/bin/env python3
"""Jobs on this machine: images and sweeps by GNU parallel, what is printed for other engines, and mistakes of users.
Usage: engines_test.py NUSSELT NUSSELT-LAB SCENE [NAME...]"""

import fcntl
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

sys.dont_write_bytecode = True  # nothing new in the folder of the sources
from processes import processes_with

NUSSELT, LAB, SCENE = map(os.path.abspath, sys.argv[1:4])
OPTIONS = ["--resolution", "160x90", "--spp", "4"]
SKIPPED = 77  # for CTest
# What shells, make, Slurm and the scripts of jobs themselves might read as something else.
ODD_NAME = "nusselt 'a\"b $x\\n@tasks@ 5%a "


class EnginesTest(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix=ODD_NAME)
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def run_in(self, *command, **options):
        words = [str(word) for word in command]
        return subprocess.run(words, cwd=self.folder, capture_output=True, text=True, errors="replace", **options)

    def submit(self, *words, parts=4, engine="parallel", options=OPTIONS):
        return self.run_in(NUSSELT, "submit", SCENE, "--parts", parts, "--engine", engine, "-o", "image.exr", *words,
                           "--", *options)

    def copy_scene(self):
        shutil.copy(SCENE, self.folder / "scene.pbrt")
        shutil.copytree(pathlib.Path(SCENE).parent / "shapes", self.folder / "shapes")

    def expect_error(self, outcome, text, code=1):
        self.assertEqual(outcome.returncode, code, outcome.stderr)
        self.assertIn(text, outcome.stderr)
        self.assertEqual(outcome.stderr.count("\n"), 1, outcome.stderr)

    def times_of_results(self, job="image.job"):
        return {path.name: path.stat().st_mtime_ns for path in (self.folder / job / "results").iterdir()}

    def expect_success(self, outcome):
        self.assertEqual(outcome.returncode, 0, outcome.stderr)

    def expect_same(self, a, b):
        table = self.run_in(NUSSELT, "compare", a, b, "--metrics", "rmse")
        self.expect_success(table)
        self.assertEqual(float(table.stdout.split()[1]), 0, table.stdout)

    def test_an_image_has_the_bits_of_one_run(self):
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

    def test_a_part_that_is_not_what_it_was_is_named_with_the_remedy(self):
        outcome = self.submit("--run")
        self.expect_success(outcome)
        self.assertIn("4 of 4 tasks are left to do; they write to ", outcome.stderr)
        (self.folder / "image.exr").unlink()
        part = self.folder / "image.job/results/2.exr"
        whole = part.read_bytes()
        foreign = [NUSSELT, "render", SCENE, *OPTIONS, "-q", "--technique", "area", "--part", "2/4", "-o", part]
        for damage, text in ((lambda: part.write_bytes(whole[:-1000]), "2.exr"),
                             (lambda: part.write_bytes((part.parent / "1.exr").read_bytes()), "which would count twice"),
                             (lambda: self.expect_success(self.run_in(*foreign)),
                              "mis, strategies, technique and visibility_estimate differ")):
            damage()
            outcome = self.submit("--run", "-q")
            self.expect_error(outcome, text)
            self.assertIn("; to do a task again, delete its file in results, then run the same command", outcome.stderr)
            self.assertFalse((self.folder / "image.exr").exists())
        part.unlink()
        outcome = self.submit("--run")
        self.expect_success(outcome)
        self.assertIn("1 of 4 tasks are left to do; ", outcome.stderr)
        self.assertEqual(part.read_bytes()[-1000:], whole[-1000:])

    def test_a_job_is_written_without_being_started(self):
        outcome = self.submit()
        self.expect_success(outcome)
        self.assertEqual(outcome.stdout, f"{self.folder}/image.job\n")
        self.assertFalse((self.folder / "image.exr").exists())
        self.expect_success(self.run_in(self.folder / "image.job/start.sh"))
        self.assertTrue((self.folder / "image.exr").exists())

    def test_the_same_command_continues(self):
        """After Ctrl-C, only what is missing is done, from the checkpoints on."""
        options = ["--resolution", "640x360", "--spp", "128", "--checkpoint-interval", "0.1"]
        command = [NUSSELT, "submit", SCENE, "--parts", "3", "--engine", "parallel", "-o", "image.exr", "--run", "--"]
        # With two tasks at a time, the third one has just begun when another one is done.
        two_at_a_time = {**os.environ, "PARALLEL": "--jobs 2"}
        process = subprocess.Popen([*command, *options], cwd=self.folder, stderr=subprocess.PIPE, text=True,
                                   env=two_at_a_time)
        deadline = time.monotonic() + 120
        job = self.folder / "image.job"
        names = lambda folder: {path.name for path in (job / folder).glob("[0-9]*")}
        while not (names("done") and "3" in names("checkpoints")) and time.monotonic() < deadline:
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, err)
        self.assertIn("stopped; run the same command again to continue", err)
        self.assertFalse((self.folder / "image.exr").exists())
        # The command ends after its tasks, which have written their checkpoints.
        self.assertEqual(processes_with(str(self.folder)), {})
        done, stopped = names("done"), names("checkpoints") - names("done")
        self.assertTrue(done and stopped)
        # A task that cannot read its checkpoint says so: it would go on from there.
        number = stopped.pop()
        checkpoint = (job / "checkpoints" / number).read_bytes()
        (job / "checkpoints" / number).write_bytes(checkpoint[:100])
        self.assertEqual(self.run_in(job / "task.sh", number).returncode, 1)
        self.assertIn(f"checkpoints/{number}", (job / f"logs/{number}.txt").read_text())
        (job / "checkpoints" / number).write_bytes(checkpoint)
        before = self.times_of_results()
        self.expect_success(self.submit("--run", parts=3, options=options))
        after = self.times_of_results()
        for name in done:
            self.assertEqual(after[f"{name}.exr"], before[f"{name}.exr"])
        self.expect_success(self.run_in(NUSSELT, "render", SCENE, *options[:4], "-q", "-o", "whole.exr"))
        self.expect_same("image.exr", "whole.exr")

    def test_a_service_may_ignore_the_end_of_its_children(self):
        ignore = lambda: signal.signal(signal.SIGCHLD, signal.SIG_IGN)
        self.expect_success(self.run_in(NUSSELT, "submit", SCENE, "--parts", 2, "--engine", "parallel", "-o",
                                        "image.exr", "--run", "--", *OPTIONS, preexec_fn=ignore))

    def test_what_the_engine_says_is_said(self):
        """Of a list of machines that is missing, and of machines that cannot be reached."""
        submit = [NUSSELT, "submit", SCENE, "--parts", 2, "--engine", "parallel", "-o", "image.exr", "-q", "--run", "--",
                  *OPTIONS]
        outcome = self.run_in(*submit, env={**os.environ, "PARALLEL": "--sshloginfile missing-list"})
        self.expect_error(outcome, "the job cannot be started: ")
        self.assertIn("missing-list", outcome.stderr)
        (self.folder / "ssh").write_text("#!/bin/sh\necho no route to host >&2; exit 255\n")
        (self.folder / "ssh").chmod(0o755)
        outcome = self.run_in(*submit, env={**os.environ, "PARALLEL": "-S 1/other",
                                            "PATH": f"{self.folder}:{os.environ['PATH']}"})
        self.expect_error(outcome, "2 of 2 tasks left no result: 1 2 (the first one: no route to host); see ")
        self.assertFalse((self.folder / "image.exr").exists())

    def test_what_was_killed_is_said(self):
        self.expect_success(self.submit())
        job = self.folder / "image.job"
        # Of a job without the program that merges.
        text = (job / "gather.txt").read_text()
        (job / "gather.txt").write_text("kill -9 $$\n")
        self.run_in(job / "start.sh")
        self.assertIn("signal 9 ended: kill -9 $$", (job / "result.txt").read_text())
        (job / "gather.txt").write_text(text)
        start = (job / "start.sh").read_text()
        (job / "start.sh").write_text("kill -9 $$\n")
        self.expect_error(self.submit("--run", "-q"), "signal 9 ended '")
        (job / "start.sh").write_text(start)
        self.expect_success(self.submit("--run", "-q"))

    def test_templates_are_printed(self):
        outcome = self.submit(engine="print")
        self.expect_success(outcome)
        template = json.loads(outcome.stdout)
        self.assertEqual(template["specificationVersion"], "jobtemplate-2023-09")
        tasks, gather = template["steps"]
        self.assertEqual(tasks["parameterSpace"]["taskParameterDefinitions"],
                         [{"name": "Task", "type": "INT", "range": "1-4"}])
        self.assertEqual(gather["dependencies"], [{"dependsOn": tasks["name"]}])
        # What the engine would do. It takes no empty lists and names of at most 128 characters.
        self.assertNotIn("[]", outcome.stdout.replace(" ", ""))
        self.assertEqual(tasks["script"]["actions"]["onRun"]["cancelation"], {"mode": "NOTIFY_THEN_TERMINATE"})
        outcome = self.run_in(NUSSELT, "submit", SCENE, "--parts", 4, "--engine", "print", "-o", "a" * 150 + ".exr")
        self.assertEqual(len(json.loads(outcome.stdout)["name"]), 128)
        self.expect_error(self.submit("--job", "{{job", engine="print"), "choose another folder")
        name = "ü" * 100
        outcome = self.run_in(NUSSELT, "submit", SCENE, "--parts", 4, "--engine", "print", "-o", f"{name}.exr")
        self.assertTrue(f"nusselt-{name}".startswith(json.loads(outcome.stdout)["name"]))
        outcome = self.submit(engine="print")
        script = tasks["script"]["actions"]["onRun"]
        for number in range(1, 5):
            self.expect_success(self.run_in(script["command"], *(word.replace("{{Task.Param.Task}}", str(number))
                                                                 for word in script["args"])))
        self.expect_success(self.run_in(gather["script"]["actions"]["onRun"]["command"]))
        self.assertTrue((self.folder / "image.exr").exists())

    def test_mistakes_are_found_before_the_job_is_written(self):
        for words, options, code, text in (
                ((), ["--bad", "3"], 2, "unknown '--bad'"), ((), ["-h"], 2, "unknown '-h'"),
                (("--job", "a\nb"), [], 1, "has a line break, which jobs do not support"),
                (("--job", os.fsdecode(b"\xff")), [], 1, "has characters that are no UTF-8, which jobs do not support"),
                (("--job", "{}"), [], 1, "has {, which GNU parallel replaces"),
                ((), ["-o", "b.exr"], 2, "use the option -o of submit"),
                ((), ["-qo", "b.exr"], 2, "use the option -o of submit"), ((), ["--json=a"], 2, "--json"),
                (("--spp", "2"), [], 2, "unknown option '--spp'; options of the tasks come behind --; see"),
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
        self.assertIn("has another job (4 tasks in place of 5); delete it", outcome.stderr)
        for outcome, difference in (
                (self.submit(options=[*OPTIONS[:-1], "8"]), "'--spp 4' in place of '--spp 8'"),
                (self.submit("--threads", 2), "'--threads 1' in place of '--threads 2'"),
                (self.submit(engine="slurm"), "'parallel' in place of 'slurm'")):
            self.expect_error(outcome, f"has another job ({difference}); delete it")
        # A folder that has nothing of value may be left by a command that was stopped.
        shutil.rmtree(self.folder / "image.job")
        (self.folder / "image.job/results").mkdir(parents=True)
        (self.folder / "image.job/tasks.txt").write_text("")
        self.expect_success(self.submit(parts=5))
        (self.folder / "other").mkdir()
        (self.folder / "other/file").write_text("")
        outcome = self.submit("--job", "other")
        self.assertEqual(outcome.returncode, 1)
        self.assertIn("has other files", outcome.stderr)

    def test_a_task_that_fails_for_good_is_named_with_its_reason(self):
        self.copy_scene()
        submit = [NUSSELT, "submit", "scene.pbrt", "--parts", 2, "--engine", "parallel", "-o", "image.exr"]
        self.expect_success(self.run_in(*submit, "--", *OPTIONS))
        scene = (self.folder / "scene.pbrt").read_text()
        (self.folder / "scene.pbrt").write_text("WorldBegin\nShape \"sphere\n")
        self.run_in(self.folder / "image.job/start.sh")
        code, message = (self.folder / "image.job/result.txt").read_text().split("\n")
        self.assertEqual(code, "1")
        self.assertIn("2 of 2 tasks left no result: 1 2 (the first one: nusselt: error: ", message)
        self.assertFalse((self.folder / "image.exr").exists())
        (self.folder / "scene.pbrt").write_text(scene)
        self.expect_success(self.run_in(*submit, "--run", "--", *OPTIONS))

    def test_results_of_a_scene_that_has_changed_are_not_merged(self):
        self.copy_scene()
        submit = [NUSSELT, "submit", "scene.pbrt", "--parts", 2, "--engine", "parallel", "-o", "image.exr", "--run",
                  "--", *OPTIONS]
        self.expect_success(self.run_in(*submit))
        self.expect_success(self.run_in(*submit))
        (self.folder / "image.exr").unlink()
        text = (self.folder / "scene.pbrt").read_text()
        self.assertIn("LookAt", text)
        (self.folder / "scene.pbrt").write_text(text.replace("LookAt", "Translate 0.1 0 0\nLookAt", 1))
        self.expect_error(self.run_in(*submit), "the scene scene.pbrt has changed")
        self.assertFalse((self.folder / "image.exr").exists())
        # So it is with the program.
        (self.folder / "scene.pbrt").write_text(text)
        manifest = self.folder / "image.job/manifest.json"
        inputs = json.loads(manifest.read_text())["inputs"]
        manifest.write_text(manifest.read_text().replace(inputs["the program nusselt"], 16 * "0"))
        self.expect_error(self.run_in(*submit), "the program nusselt has changed")

    def test_more_parts_than_a_command_line_can_name(self):
        """An image of one tile: all other parts are empty, and alike but for their paths."""
        options = ["--resolution", "16x16", "--spp", "1"]
        self.expect_success(self.submit(parts=3000, options=options))
        job = self.folder / "image.job"
        self.assertGreater(len((job / "inputs/1.txt").read_text()), 131072)
        for number in (1, 2):
            self.expect_success(self.run_in(job / "task.sh", number))
        for number in range(3, 3001):
            os.link(job / "results/2.exr", job / f"results/{number}.exr")
            (job / f"done/{number}").touch()
        self.expect_success(self.run_in(job / "gather.sh"))
        self.expect_success(self.run_in(NUSSELT, "render", SCENE, *options, "-q", "-o", "whole.exr"))
        self.expect_same("image.exr", "whole.exr")

    def test_a_job_is_done_once_at_a_time(self):
        self.expect_success(self.submit())
        job = self.folder / "image.job"
        self.assertEqual(self.run_in(job / "alive.sh").returncode, 1)
        with open(job / "engine.lock", "w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            self.assertEqual(self.run_in(job / "alive.sh").returncode, 0)
            outcome = self.run_in(job / "start.sh")
            self.assertEqual(outcome.returncode, 1)
            self.assertIn("the job is being done already", outcome.stderr)
        self.assertEqual(self.run_in(job / "alive.sh").returncode, 1)

    def test_an_engine_that_does_not_answer_gets_nothing_twice(self):
        programs = self.folder / "bin"
        programs.mkdir()
        for name, text in (("sbatch", "echo >>called; echo 7"), ("squeue", "exit 1"), ("scancel", "exit 0")):
            (programs / name).write_text(f"#!/bin/sh\n{text}\n")
            (programs / name).chmod(0o755)
        environment = {**os.environ, "PATH": f"{programs}:{os.environ['PATH']}"}
        self.expect_success(self.submit(engine="slurm"))
        job = self.folder / "image.job"
        self.expect_success(self.run_in(job / "start.sh", env=environment))
        self.assertEqual((job / "called").read_text(), "\n\n")
        outcome = self.run_in(NUSSELT, "submit", SCENE, "--parts", 4, "--engine", "slurm", "-o", "image.exr", "--run",
                              "--", *OPTIONS, env=environment)
        self.expect_error(outcome, "the engine does not answer")
        self.assertEqual((job / "called").read_text(), "\n\n")

    def test_a_job_that_slurm_takes_in_part_is_taken_back(self):
        """Two arrays, of which a limit of the site refuses the second."""
        programs = self.folder / "bin"
        programs.mkdir()
        refuse = "[ -e called ] || { echo >called; echo 7; exit 0; }; echo too many jobs >&2; exit 1"
        for name, text in (("sbatch", refuse), ("scancel", "echo $* >>canceled")):
            (programs / name).write_text(f"#!/bin/sh\n{text}\n")
            (programs / name).chmod(0o755)
        self.expect_success(self.submit(engine="slurm", parts=1500))
        job = self.folder / "image.job"
        outcome = self.run_in(job / "start.sh", env={**os.environ, "PATH": f"{programs}:{os.environ['PATH']}"})
        self.assertEqual(outcome.returncode, 1)
        self.assertIn("too many jobs", outcome.stderr)
        self.assertEqual((job / "canceled").read_text(), "7\n")

    def test_only_what_is_missing_is_handed_to_slurm(self):
        programs = self.folder / "bin"
        programs.mkdir()
        (programs / "sbatch").write_text("#!/bin/sh\nprintf '%s\\n' \"$*\" >>called; echo 7\n")
        (programs / "sbatch").chmod(0o755)
        self.expect_success(self.submit(engine="slurm", parts=2500))
        job = self.folder / "image.job"
        for number in (*range(3, 1001), 1005, 2500):
            (job / f"done/{number}").touch()
            (job / f"results/{number}.exr").write_text("a")
        environment = {**os.environ, "PATH": f"{programs}:{os.environ['PATH']}"}
        self.expect_success(self.run_in(job / "start.sh", env=environment))
        lists = [word.split("=")[1] for line in (job / "called").read_text().splitlines() for word in line.split()
                 if word.startswith("--array=")]
        self.assertEqual(lists, ["1-2", "1-4,6-1000", "1-499"])

    def test_a_gathering_step_that_starts_again_does_not_start_the_job_twice(self):
        """Slurm starts it again after a failure of its machine. By then, another one may have the job."""
        programs = self.folder / "bin"
        programs.mkdir()
        (programs / "sleep").write_text("#!/bin/sh\n")
        (programs / "sleep").chmod(0o755)
        self.expect_success(self.submit(engine="slurm"))
        job = self.folder / "image.job"
        (job / "start.sh").write_text("#!/bin/sh\necho round >>starts.txt\n")

        def step(restarts):
            environment = {**os.environ, "PATH": f"{programs}:{os.environ['PATH']}", "SLURM_JOB_ID": "8",
                           "SLURM_RESTART_COUNT": str(restarts)}
            self.run_in(job / "gather-step.sh", env=environment)
            return (job / "starts.txt").read_text().count("round") if (job / "starts.txt").exists() else 0

        # Of an interrupted start, which did not write its number; then of an earlier round; then the current one.
        self.assertEqual(step(0), 0)
        (job / "engine-gather.txt").write_text("9\n")
        self.assertEqual(step(1), 0)
        (job / "engine-gather.txt").write_text("8\n")
        self.assertEqual(step(0), 1)
        # The current one failed while it handed the job on.
        (job / "engine-gather.txt").unlink()
        self.assertEqual(step(1), 2)

    def test_rounds_go_on_while_there_is_progress(self):
        """A task that needs more than its time limit goes on from round to round; one that fails does not."""
        self.expect_success(self.submit())
        job = self.folder / "image.job"
        (job / "start.sh").write_text("#!/bin/sh\necho round >>starts.txt\n")
        for _ in range(5):
            (job / "checkpoints/3").write_text("")
            self.run_in(job / "gather.sh")
            time.sleep(0.02)  # times of files have steps
        self.assertFalse((job / "result.txt").exists())
        (job / "logs/3.failed").touch()
        for _ in range(5):
            (job / "checkpoints/3").write_text("")
            self.run_in(job / "gather.sh")
        self.assertIn("4 of 4 tasks left no result: 1 2 3 4", (job / "result.txt").read_text())
        self.assertEqual((job / "starts.txt").read_text().count("round"), 6)

    def test_sweeps_of_images(self):
        outcome = self.run_in(LAB, "submit", "images", "--scene", SCENE, "--technique", "area", "--technique",
                              "solid_angle", "--seeds", 2, "--engine", "parallel", "--run", "-o", "sweep", "--",
                              *OPTIONS)
        self.expect_success(outcome)
        for technique in ("area", "solid_angle"):
            for seed in (0, 1):
                self.expect_success(self.run_in(NUSSELT, "render", SCENE, *OPTIONS, "-q", "--technique", technique,
                                                "--seed", seed, "-o", f"{seed}.exr"))
            self.expect_success(self.run_in(NUSSELT, "merge", "-o", "both.exr", "0.exr", "1.exr"))
            self.expect_same(f"sweep/room-{technique}.exr", "both.exr")

    def test_mistakes_in_sweeps_are_found_first(self):
        images = [LAB, "submit", "images", "--scene", SCENE, "--engine", "parallel", "-o", "sweep"]
        for options in (["--seed", "3"], ["--technique=area"], ["--isa", "sse"], ["-o", "x.exr"],
                        ["--backend", "vulkan"]):
            outcome = self.run_in(*images, "--technique", "area", "--", *options)
            self.expect_error(outcome, "not supported behind --", 2)
        self.expect_error(self.run_in(*images, "--technique", "area", "--technique", "area"), "is there twice", 2)
        outcome = self.run_in(LAB, "submit", "images", "--scene", SCENE, "--technique", "area", "--engine", "parallel", "-o",
                              "/dev/null/sweep")
        self.expect_error(outcome, "cannot create the folder '/dev/null/sweep': Not a directory; choose another one")
        for name in ("fuzz", "worst-case"):
            shards = [LAB, "submit", name, "--engine", "parallel", "-o"]
            for options in (["--json", "a"], ["--first", "3"], ["--count", "9"], ["--seed", "3"], ["--isa", "avx2"],
                            ["--threads", "2"], ["--starts=4"], ["--state", "a"]):
                self.expect_error(self.run_in(*shards, "x.json", "--", *options), "not supported behind --", 2)
            self.expect_error(self.run_in(*shards, "missing/x.json"), "the folder 'missing' does not exist")
        self.expect_error(self.run_in(LAB, "gather", "-o", "x.json", "/"), "'/' is a folder")
        self.assertEqual(list(self.folder.iterdir()), [])
        # What only tasks find out is what the command says.
        outcome = self.run_in(*images, "--technique", "area", "--run", "-q", "--", "--bad")
        self.expect_error(outcome, "1 of 1 tasks left no result: 1 (the first one: nusselt: unknown option '--bad'")

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
        shards = sorted(self.folder.glob("fuzz.job/results/*"))
        gather = lambda *files: self.run_in(LAB, "gather", "-o", "all.json", *files)
        self.expect_error(gather(*shards, shard), "would count twice")
        self.expect_error(gather(shards[0], shards[2]), "does not begin where")

        def change(edit):
            changed = json.loads(json.dumps(json_of_shard))
            edit(changed)
            shard.write_text(json.dumps(changed))
            return gather(*shards)

        def swap_columns(results):
            columns = results["tables"][0]["columns"]
            columns[1], columns[2] = columns[2], columns[1]

        self.expect_error(change(lambda results: results["settings"].update(isa="none")), "its setting isa is")
        self.expect_error(change(swap_columns), "its table techniques is")
        self.expect_error(change(lambda results: results["tables"][0].pop("rows")), "2.json")
        self.expect_error(change(lambda results: results.clear()), "2.json")

    def test_shards_of_the_worst_case_have_seeds_of_their_own(self):
        outcome = self.run_in(LAB, "submit", "worst-case", "--shards", 2, "--starts", 8, "--seed", 5, "--engine",
                              "parallel", "--run", "-o", "worst.json", "--", "--target", "lines")
        self.expect_success(outcome)
        results = json.loads((self.folder / "worst.json").read_text())
        self.assertEqual([row[0] for row in results["tables"][0]["rows"]], [1, 2])
        tasks = json.loads((self.folder / "worst.job/manifest.json").read_text())["tasks"]
        self.assertEqual([f" --seed {5 + i} " in tasks[i]["command"][2] for i in (0, 1)], [True, True])
        # Other starts give other errors.
        first, second = (row[-2] for row in results["tables"][0]["rows"])
        self.assertNotEqual(first, second)

    def test_a_shard_that_cannot_be_done_keeps_its_exit_code(self):
        """Another attempt is of no use after wrong usage, and an old result is none of this attempt."""
        outcome = self.run_in(LAB, "submit", "fuzz", "--shards", 1, "--count", 10, "--engine", "parallel", "-o",
                              "fuzz.json", "--", "--technique", "Unknown")
        self.expect_success(outcome)
        job = self.folder / "fuzz.job"
        (job / "results/1.json").write_text("old")
        self.assertEqual(self.run_in(job / "task.sh", 1).returncode, 2)
        self.assertEqual((job / "logs/1.txt").read_text().count("attempt"), 1)
        self.assertFalse((job / "results/1.json").exists())


if __name__ == "__main__":
    if shutil.which("parallel") is None:
        print("skipped: parallel is missing", file=sys.stderr)
        sys.exit(1 if os.environ.get("CI") == "true" else SKIPPED)
    unittest.main(argv=[sys.argv[0], *("EnginesTest." + name for name in sys.argv[4:])], verbosity=2)
