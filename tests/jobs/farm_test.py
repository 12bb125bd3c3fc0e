#!/usr/bin/env python3
"""Compares the simulation of docs/scaling.md with closed forms. Wrong simulations must be found by the same checks."""

import dataclasses
import math
import pathlib
import random
import statistics
import sys
import unittest

sys.dont_write_bytecode = True  # nothing new in the folders of the sources
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "lab/scaling"))
import farm

# Nothing but rendering.
PLAIN = farm.Farm(cores=64, frames=10, parts=8, threads=4, frame_work=3200.0, straggling=0.0, start=0.0,
                  failures_per_core=0.0, checkpoint_interval=10.0, checkpoint_cost=0.0, requeue_delay=0.0,
                  frame_bytes=0.0, scene_bytes=0.0, storage=1e12, merge_rate=1e12)


def forgets_lost_work(work, settings, rate, rng):
    """A wrong attempt: all work until the failure is kept, as if checkpoints were free and everywhere."""
    seconds, kept, failed = farm.stretch_until_failure(work, settings, rate, rng)
    return seconds, min(seconds, work) if failed else kept, failed


def task_times(stretch, count):
    """Wall times of single tasks with many failures, and the settings."""
    settings = dataclasses.replace(PLAIN, cores=4, frames=1, parts=1, frame_work=400.0, checkpoint_cost=1.0,
                                   requeue_delay=7.0, failures_per_core=1 / 200)
    return [farm.simulate(settings, seed, stretch).makespan for seed in range(count)], settings


def deviations(values, expected):
    """By how many standard errors the mean is off."""
    return (statistics.fmean(values) - expected) / (statistics.stdev(values) / math.sqrt(len(values)))


class FarmTest(unittest.TestCase):
    def test_without_losses_tasks_come_in_waves(self):
        # 80 tasks of 100 s on 16 slots.
        outcome = farm.simulate(PLAIN)
        self.assertAlmostEqual(outcome.makespan, 500)
        self.assertAlmostEqual(outcome.efficiency(PLAIN), 1)
        self.assertAlmostEqual(farm.simulate(dataclasses.replace(PLAIN, frames=11)).makespan, 600)

    def test_failures_agree_with_the_closed_form(self):
        times, settings = task_times(farm.stretch_until_failure, 4000)
        # The last piece has no checkpoint; its failures are those of a shorter step.
        rate = settings.threads * settings.failures_per_core
        work = settings.frame_work / settings.threads
        expected = (farm.expected_task_seconds(work - settings.checkpoint_interval, settings, rate) +
                    (1 / rate + settings.requeue_delay) * math.expm1(rate * settings.checkpoint_interval))
        self.assertLess(abs(deviations(times, expected)), 4)
        wrong, _ = task_times(forgets_lost_work, 4000)
        self.assertGreater(abs(deviations(wrong, expected)), 4)

    def test_the_slowest_of_many_exponential_tasks(self):
        """The mean of the largest of n exponential times is the n-th harmonic number."""
        settings = dataclasses.replace(PLAIN, frames=2)
        count = settings.frames * settings.parts
        expected = 100 * sum(1 / k for k in range(1, count + 1))
        times = [farm.simulate(settings, seed, factor=lambda rng: rng.expovariate(1)).makespan for seed in range(2000)]
        self.assertLess(abs(deviations(times, expected)), 4)
        self.assertGreater(abs(deviations([random.Random(seed).uniform(0, 200) for seed in range(2000)], expected)), 4)

    def test_stragglers_keep_the_mean(self):
        settings = dataclasses.replace(PLAIN, cores=4, frames=1, parts=1, straggling=0.5)
        times = [farm.simulate(settings, seed).makespan for seed in range(4000)]
        self.assertLess(abs(deviations(times, 800)), 4)

    def test_saturated_storage_limits_the_time(self):
        # Each frame is written in parts, read and written by its merge; tasks read the scene.
        settings = dataclasses.replace(PLAIN, frame_work=1e-6, frame_bytes=8e9, scene_bytes=1e9, storage=1e9)
        outcome = farm.simulate(settings)
        bytes_of_all = settings.frames * (3 * settings.frame_bytes + settings.parts * settings.scene_bytes)
        self.assertAlmostEqual(outcome.storage_busy, bytes_of_all / settings.storage)
        self.assertGreaterEqual(outcome.makespan, outcome.storage_busy)
        self.assertLess(outcome.makespan, 1.05 * outcome.storage_busy)

    def test_merges_come_before_new_parts(self):
        # 16 slots: the first two frames are rendered after 100 s, the last two begin after 400 s.
        outcome = farm.simulate(PLAIN)
        self.assertAlmostEqual(outcome.first_merge, 100)
        self.assertAlmostEqual(outcome.last_new_part, 400)
        self.assertLess(farm.simulate(farm.Farm(frames=1000)).first_merge, 400)

    def test_storage_serves_in_the_order_of_requests(self):
        """Two slots, 90 s for a part, 100 s for a merge; 1 s to read the scene or a frame or to write a frame. Parts 1
        and 2 are written at 91.5 and 93; part 3, which begins at 91.5, is written at 183 while frame 1 is merged;
        part 4 at 274.5, and then frame 2 is merged."""
        settings = dataclasses.replace(PLAIN, cores=8, frames=2, parts=2, frame_work=720.0, frame_bytes=1e9,
                                       scene_bytes=1e9, storage=1e9, merge_rate=1e7)
        outcome = farm.simulate(settings)
        self.assertAlmostEqual(outcome.last_new_part, 183)
        self.assertAlmostEqual(outcome.makespan, 375.5)

    def test_the_page_has_the_numbers_of_the_simulation(self):
        settings = farm.Farm()
        outcome = farm.simulate(settings)
        self.assertGreaterEqual(outcome.efficiency(settings), 0.9)
        page = pathlib.Path(__file__).resolve().parents[2] / "docs/scaling.md"
        self.assertIn(farm.row("base", settings, outcome), page.read_text().splitlines())

    def test_failures_are_as_frequent_as_their_rate(self):
        settings = dataclasses.replace(PLAIN, frames=1000, failures_per_core=1e-4)
        outcome = farm.simulate(settings)
        busy = outcome.useful  # lost work adds little
        expected = busy * settings.failures_per_core
        self.assertLess(abs(outcome.failures - expected), 4 * math.sqrt(expected) + 0.05 * expected)


if __name__ == "__main__":
    unittest.main(verbosity=2)
