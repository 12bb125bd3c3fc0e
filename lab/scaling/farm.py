#!/usr/bin/env python3
"""Simulates a film on many cores: tasks with checkpoints, failures of cores, stragglers, shared storage and merges.
docs/scaling.md has the results. `farm.py` prints its table; `farm.py --help` lists what can be changed.

A core fails at random, with the same rate at any time. A failure ends the task of the core, which goes on where its
last checkpoint ends once the engine has waited and a slot is free. Storage serves requests one after the other at its
full bandwidth. Merging is a task of one core per frame, and begins when all parts of the frame are there."""

import argparse
import dataclasses
import heapq
import math
import random
import sys

MONTH = 30 * 24 * 3600  # [s]


@dataclasses.dataclass
class Farm:
    """Times in seconds, data in bytes."""

    cores: int = 100_000
    frames: int = 10_000
    parts: int = 32  # of a frame
    threads: int = 8  # of a task
    frame_work: float = 2400 * 25  # core seconds
    straggling: float = 0.2  # standard deviation of the logarithm of the time of a task
    start: float = 5.0  # of a task, until it renders: the program, the scene and its hierarchy
    failures_per_core: float = 1 / MONTH  # [1/s]
    checkpoint_interval: float = 60.0
    checkpoint_cost: float = 0.3
    requeue_delay: float = 121.0
    frame_bytes: float = 7680 * 4320 * 12
    scene_bytes: float = 0.2e9  # read by each task that starts
    storage: float = 100e9  # [bytes/s]
    merge_rate: float = 120e6  # [bytes/s] of the frame


@dataclasses.dataclass
class Outcome:
    makespan: float = 0.0
    useful: float = 0.0  # core seconds of rendering that counted
    failures: int = 0
    storage_busy: float = 0.0  # [s]
    merge_seconds: float = 0.0  # core seconds
    starts: int = 0

    def efficiency(self, farm):
        return self.useful / (farm.cores * self.makespan)


class Storage:
    """Serves requests in order at full bandwidth."""

    def __init__(self, bandwidth):
        self.bandwidth, self.free, self.busy = bandwidth, 0.0, 0.0

    def serve(self, now, size):
        """\\returns when the request is served"""
        seconds = size / self.bandwidth
        self.free = max(self.free, now) + seconds
        self.busy += seconds
        return self.free


def stretch_until_failure(work, farm, rate, rng):
    """One attempt at `work` seconds of rendering. \\returns wall seconds, seconds of rendering that are kept, whether it
    failed"""
    pieces = max(1, math.ceil(work / farm.checkpoint_interval - 1e-9))
    # The last piece ends with the image instead of a checkpoint.
    whole = work + (pieces - 1) * farm.checkpoint_cost
    failure = rng.expovariate(rate) if rate > 0 else math.inf
    if failure >= whole:
        return whole, work, False
    kept = math.floor(failure / (farm.checkpoint_interval + farm.checkpoint_cost)) * farm.checkpoint_interval
    return failure, kept, True


def simulate(farm, seed=1, stretch=stretch_until_failure, factor=None):
    """\\param factor  gives the time of a task relative to the mean, from a random generator; otherwise it is
    log-normal with mean 1"""
    rng = random.Random(seed)
    if factor is None:
        shift = -farm.straggling**2 / 2
        factor = lambda source: math.exp(source.gauss(shift, farm.straggling)) if farm.straggling > 0 else 1.0
    slots = max(1, farm.cores // farm.threads)
    rate = farm.threads * farm.failures_per_core
    mean = farm.frame_work / farm.parts / farm.threads
    storage, outcome = Storage(farm.storage), Outcome()
    missing = [farm.parts] * farm.frames
    # What may start: (time from which on, kind, frame, seconds of rendering left). Merges come before new frames, so
    # that frames do not pile up; requeued tasks wait.
    render, merge = 0, 1
    ready = [(0.0, i // farm.parts, render, mean * factor(rng)) for i in range(farm.frames * farm.parts)]
    heapq.heapify(ready)
    free = slots
    events = []  # (time, number, kind, frame, seconds left)
    count, now = 0, 0.0

    def push(time, kind, frame, left):
        nonlocal count
        count += 1
        heapq.heappush(events, (time, count, kind, frame, left))

    def begin(frame, kind, left):
        outcome.starts += 1
        if kind == merge:
            if farm.parts == 1:
                push(now, merge, frame, 0.0)
                return
            seconds = farm.frame_bytes / farm.merge_rate
            outcome.merge_seconds += seconds
            read = storage.serve(now, farm.frame_bytes)
            push(storage.serve(max(read, now + seconds), farm.frame_bytes), merge, frame, 0.0)
            return
        begun = max(storage.serve(now, farm.scene_bytes), now + farm.start)
        seconds, kept, failed = stretch(left, farm, rate, rng)
        outcome.useful += farm.threads * kept
        if failed:
            outcome.failures += 1
            push(begun + seconds, render, frame, left - kept)
        else:
            # Its part is written once the storage has time for it. The order of requests follows the order of starts.
            push(begun + seconds, -1, frame, 0.0)

    while ready or events:
        while free > 0 and ready and ready[0][0] <= now:
            _, frame, kind, left = heapq.heappop(ready)
            free -= 1
            begin(frame, kind, left)
        if not events:
            now = max(now, ready[0][0])
            continue
        next_ready = ready[0][0] if ready and free > 0 else math.inf
        if next_ready < events[0][0]:
            now = next_ready
            continue
        now, _, kind, frame, left = heapq.heappop(events)
        if kind == -1:
            push(storage.serve(now, farm.frame_bytes / farm.parts), -2, frame, 0.0)
            continue
        free += 1
        if kind == -2:
            missing[frame] -= 1
            if missing[frame] == 0:
                heapq.heappush(ready, (now, -1, merge, 0.0) if farm.parts == 1 else (now, frame, merge, 0.0))
        elif kind == render:
            heapq.heappush(ready, (now + farm.requeue_delay, frame, render, left))
    outcome.makespan, outcome.storage_busy = now, storage.busy
    return outcome


def expected_task_seconds(work, farm, rate):
    """The mean wall time of `work` seconds with a checkpoint after each interval, failures at a rate and a wait after
    each, if a slot is always free: for each interval of length t, (1 / rate + wait) (exp(rate t) - 1). That is the
    classical result for restarts (J. T. Daly 2006, A higher order estimate of the optimum checkpoint interval for
    restart dumps), with a wait during which nothing fails."""
    pieces = work / farm.checkpoint_interval
    step = farm.checkpoint_interval + farm.checkpoint_cost
    return pieces * (1 / rate + farm.requeue_delay) * math.expm1(rate * step)


def rows():
    """The cases of docs/scaling.md."""
    base = Farm()
    change = lambda **changes: dataclasses.replace(base, **changes)
    yield "base", base
    yield "no failures", change(failures_per_core=0.0)
    yield "ten times the failures", change(failures_per_core=10 / MONTH)
    yield "no checkpoints", change(checkpoint_interval=1e9)
    yield "no checkpoints, ten times the failures", change(checkpoint_interval=1e9, failures_per_core=10 / MONTH)
    yield "tasks equally long", change(straggling=0.0)
    yield "stragglers of 0.4 instead of 0.2", change(straggling=0.4)
    yield "4 parts of a frame", change(parts=4)
    yield "16 parts of a frame", change(parts=16)
    yield "storage of 20 GB/s", change(storage=20e9)
    yield "storage of 10 GB/s", change(storage=10e9)
    yield "frames of a tenth of the work", change(frame_work=base.frame_work / 10)
    yield "frames of ten times the work, 16 parts", change(frame_work=10 * base.frame_work, parts=16)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    for field in dataclasses.fields(Farm):
        parser.add_argument("--" + field.name.replace("_", "-"), type=field.type, help=f"default: {field.default:g}")
    parser.add_argument("--seed", type=int, default=1)
    arguments = vars(parser.parse_args())
    seed = arguments.pop("seed")
    changes = {name: value for name, value in arguments.items() if value is not None}
    cases = [("as given", dataclasses.replace(Farm(), **changes))] if changes else rows()
    print("| case | time [s] | efficiency | failures | per hour | starts per second | storage busy |")
    print("|---|---|---|---|---|---|---|")
    for name, farm in cases:
        outcome = simulate(farm, seed)
        hours = outcome.makespan / 3600
        print(f"| {name} | {outcome.makespan:.0f} | {outcome.efficiency(farm):.3f} | {outcome.failures} | "
              f"{outcome.failures / hours:.0f} | {outcome.starts / outcome.makespan:.0f} | "
              f"{100 * outcome.storage_busy / outcome.makespan:.0f} % |")
        sys.stdout.flush()


if __name__ == "__main__":
    main()
