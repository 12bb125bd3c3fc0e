#!/usr/bin/env python3
"""Renders on a real Slurm cluster of two nodes on this machine, and breaks what can break: tasks, parts, disks, the
controller. Usage: slurm_test.py PROGRAM SCENE [NAME...]    PROGRAM is nusselt; names select tests.
The last lines of `test_eight_parts` are the row of docs/scaling.md."""

import os
import pathlib
import shlex
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.dont_write_bytecode = True  # nothing new in the folder of the sources
import cluster
from processes import processes_with

PROGRAM, SCENE = map(os.path.abspath, sys.argv[1:3])
IS_FULL = os.environ.get("NUSSELT_TEST_EFFORT") == "full"
SKIPPED = 77  # for CTest


class SlurmTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory(prefix="nusselt-slurm-")
        # What shells, Slurm and the scripts of jobs themselves might read as something else.
        cls.odd = tempfile.TemporaryDirectory(prefix="nusselt 'a\"b $x\\n@tasks@ 5%a ")
        # Nodes of one processor: two tasks at a time, one for each core of the smallest machine that runs the tests.
        cls.cluster = cluster.Cluster(pathlib.Path(cls.temporary.name) / "cluster", cpus=1)
        cls.cluster.__enter__()

    @classmethod
    def tearDownClass(cls):
        cls.cluster.stop()
        cls.temporary.cleanup()
        cls.odd.cleanup()

    def setUp(self):
        self.folder = pathlib.Path(self.odd.name) / self.id().split(".")[-1]
        self.folder.mkdir()
        self.job = self.folder / "image.job"

    def options(self, size):
        return ["--resolution", size, "--spp", "32", "--checkpoint-interval", "0.2"]

    def start(self, parts, size, *more):
        command = [PROGRAM, "submit", SCENE, "--parts", str(parts), "--engine", "slurm", "-o", "image.exr", *more, "--"]
        return subprocess.Popen([*command, *self.options(size)], cwd=self.folder, env=self.cluster.environment,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def finish(self, process, seconds=120):
        out, err = process.communicate(timeout=seconds)
        return process.returncode, out, err

    def render(self, size, threads):
        """A single run. \\returns its seconds"""
        begin = time.monotonic()
        command = [PROGRAM, "render", SCENE, *self.options(size)[:4], "--threads", str(threads), "-q"]
        subprocess.run([*command, "-o", "whole.exr"], cwd=self.folder, check=True)
        return time.monotonic() - begin

    def expect_bits_of_one_run(self, size):
        if not (self.folder / "whole.exr").exists():
            self.render(size, 2)
        compare = [PROGRAM, "compare", "image.exr", "whole.exr", "--metrics", "rmse"]
        table = subprocess.run(compare, cwd=self.folder, check=True, capture_output=True, text=True).stdout
        self.assertEqual(float(table.split()[1]), 0, table)

    def logs(self):
        return {path.name: path.read_text() for path in (self.job / "logs").glob("*.txt")}

    def array(self):
        return (self.job / "engine-jobs.txt").read_text().split()[0]

    def wait_for_end(self):
        """Slurm lists the last step for a moment after its end."""
        cluster.wait_for(lambda: subprocess.run([self.job / "alive.sh"], env=self.cluster.environment).returncode == 1, 60,
                         "the end of the job")

    def wait_for_checkpoint(self, task):
        cluster.wait_for((self.job / "checkpoints" / str(task)).exists, 60, f"a checkpoint of task {task}")

    def kill_task(self, task):
        """Kills a task with all its processes, as a machine does that fails."""
        killed = processes_with(f"{self.job}/results/{task}.exr")
        self.assertTrue(killed)
        for group in {os.getpgid(process) for process in killed}:
            os.killpg(group, signal.SIGKILL)

    def seconds_of_empty_job(self):
        """What Slurm itself takes: as many tasks that do nothing and a step after them, twice."""
        submit = ("sbatch", "--parsable", "--output=/dev/null", "--wrap", "true")
        begin = time.monotonic()
        for _ in range(2):
            array = self.cluster.output(*submit, "--array=1-8")
            last = self.cluster.output(*submit, f"--dependency=afterany:{array}")
            cluster.wait_for(lambda: last not in self.cluster.output("squeue", "--noheader", "--format=%F").split(), 60,
                             "an empty job")
        return time.monotonic() - begin

    def seconds_of_requeueing(self):
        """How long a job that is requeued waits until it starts again."""
        started = self.folder / "started"
        job = self.cluster.output("sbatch", "--parsable", "--requeue", "--output=/dev/null", "--wrap",
                                  f"echo >>{shlex.quote(str(started))}; sleep 600")
        starts = lambda: len(started.read_text()) if started.exists() else 0
        cluster.wait_for(lambda: starts() == 1, 60, "a start")
        begin = time.monotonic()
        self.cluster.output("scontrol", "requeue", job)
        cluster.wait_for(lambda: starts() == 2, 60, "a second start")
        seconds = time.monotonic() - begin
        self.cluster.output("scancel", job)
        return seconds

    def test_eight_parts(self):
        """One task is killed, one is requeued, and one command gives the image."""
        size = "960x540"
        begin = time.monotonic()
        process = self.start(8, size, "--run")
        self.wait_for_checkpoint(1)
        self.kill_task(1)
        self.wait_for_checkpoint(3)
        requeued = f"{self.array()}_3"
        finished = {number: (self.job / f"results/{number}.exr").stat().st_mtime_ns for number in range(1, 9)
                    if (self.job / f"done/{number}").exists()}
        self.cluster.output("scontrol", "requeue", requeued)
        code, out, err = self.finish(process)
        wall = time.monotonic() - begin
        self.assertEqual(code, 0, err + str(self.logs()))
        self.assertEqual(out, str(self.folder / "image.exr") + "\n")
        self.assertIn("no result of 1 tasks: 1; starting them again", self.logs()["gather.txt"])
        for number, changed in finished.items():
            self.assertEqual((self.job / f"results/{number}.exr").stat().st_mtime_ns, changed, number)
        self.assertIn("Restarts=1", self.cluster.output("scontrol", "show", "job", requeued))
        ideal = self.render(size, 2)
        self.expect_bits_of_one_run(size)
        delay = self.seconds_of_empty_job() + self.seconds_of_requeueing()
        print(f"\n8 parts on two nodes, one task killed, one requeued: RMSE 0, {wall:.1f} s; two threads of one run: "
              f"{ideal:.1f} s; Slurm for two rounds of tasks that do nothing and for requeueing one: {delay:.1f} s; "
              f"1.3 times the former and the latter: {1.3 * ideal + delay:.1f} s")
        if IS_FULL:
            self.assertLess(wall, 1.3 * ideal + delay)

    def test_lost_part(self):
        """The file of a part is lost, or holds less than was written: an error names it, and the same command then does
        only that."""
        size = "320x180"
        code, _, err = self.finish(self.start(4, size, "--run"))
        self.assertEqual(code, 0, err)
        part = self.job / "results/3.exr"
        whole = part.read_bytes()
        part.write_bytes(whole[:-1000])
        (self.folder / "image.exr").unlink()
        self.wait_for_end()
        code, _, err = self.finish(self.start(4, size, "--run"))
        self.assertEqual(code, 1, err)
        self.assertIn("results/3.exr", err)
        self.assertFalse((self.folder / "image.exr").exists())
        part.unlink()
        self.wait_for_end()
        others = {name: (self.job / "results" / name).stat().st_mtime_ns for name in ("1.exr", "2.exr", "4.exr")}
        code, _, err = self.finish(self.start(4, size, "--run"))
        self.assertEqual(code, 0, err)
        self.assertEqual(part.read_bytes()[-1000:], whole[-1000:])
        for name, changed in others.items():
            self.assertEqual((self.job / "results" / name).stat().st_mtime_ns, changed, name)
        self.expect_bits_of_one_run(size)

    @unittest.skipUnless(IS_FULL, "takes half a minute")
    def test_requeued_gathering(self):
        """The step that merges is requeued while it merges: it starts again, and does not start the tasks again."""
        size = "320x180"
        code, _, err = self.finish(self.start(2, size))
        self.assertEqual(code, 0, err)
        gather = self.job / "gather.txt"
        gather.write_text(": >merging-$SLURM_RESTART_COUNT; sleep 5; " + gather.read_text())
        process = self.start(2, size, "--run")
        cluster.wait_for((self.folder / "merging-").exists, 60, "the step that merges")
        step = (self.job / "engine-gather.txt").read_text().strip()
        self.cluster.output("scontrol", "requeue", step)
        code, _, err = self.finish(process)
        self.assertEqual(code, 0, err + str(self.logs()))
        self.assertTrue((self.folder / "merging-1").exists())
        self.assertEqual((self.job / "engine-jobs.txt").read_text().split()[-1], step)
        self.expect_bits_of_one_run(size)

    def test_lost_controller(self):
        """Tasks go on without the controller, and so does the command."""
        size = "640x360"
        process = self.start(6, size, "--run")
        cluster.wait_for((self.job / "results/1.exr").exists, 60, "the first part")
        self.cluster.end("slurmctld")
        # The command asks the engine every five seconds, and waits four for an answer.
        time.sleep(10)
        self.cluster.start_controller()
        code, _, err = self.finish(process)
        self.assertEqual(code, 0, err + str(self.logs()))
        self.assertIn("the engine does not answer; waiting", err)
        self.expect_bits_of_one_run(size)

    def test_full_disk(self):
        """A task that cannot write fails with the reason, the others do their part, and there is no image until it
        can."""
        size = "320x180"
        code, _, err = self.finish(self.start(4, size))
        self.assertEqual(code, 0, err)
        script = self.job / "task.sh"
        text = script.read_text()
        script.write_text(text.replace("number=$1\n", "number=$1\n[ $number != 2 ] || ulimit -f 8\n"))
        code, _, err = self.finish(self.start(4, size, "--run"))
        self.assertEqual(code, 1, err)
        self.assertIn("1 of 4 tasks left no result: 2 (the first one: nusselt: error: cannot write", err)
        self.assertFalse((self.folder / "image.exr").exists())
        self.assertEqual(sorted(path.name for path in (self.job / "results").iterdir()), ["1.exr", "3.exr", "4.exr"])
        script.write_text(text)
        code, _, err = self.finish(self.start(4, size, "--run"))
        self.assertEqual(code, 0, err)
        self.expect_bits_of_one_run(size)


if __name__ == "__main__":
    missing = cluster.missing_programs()
    if missing:
        print(f"skipped: {', '.join(missing)} missing; install slurm-wlm and munge", file=sys.stderr)
        sys.exit(1 if os.environ.get("CI") == "true" else SKIPPED)
    unittest.main(argv=[sys.argv[0], *("SlurmTest." + name for name in sys.argv[3:])], verbosity=2)
