#!/usr/bin/env python3
"""Simulates a film on many cores: tasks with checkpoints, failures of cores, stragglers, shared storage and merges.
docs/scaling.md has the results. `farm.py` prints its table; `farm.py --help` lists what can be changed.

A core fails at random, with the same rate at any time while it renders; in the few seconds of starting, reading,
writing and merging, nothing fails. A failure ends the task of the core, which goes on where its last checkpoint ends once the
engine has waited and a slot is free. Storage serves requests one after the other at its full bandwidth, in the order in
which they are made. A merge takes a slot for one core of work per frame, and can begin when all parts of the frame are
there. Of all tasks that can begin, requeued ones come first, then merges, then new parts in the order of frames."""

import argparse
import dataclasses
import heapq
import math
import random

MONTH = 30 * 24 * 3600  # [s]
REQUEUED, MERGE = 0, 1  # what comes before new parts, in this order


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
    first_merge: float = math.inf  # when it begins
    last_new_part: float = 0.0  # when it begins

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
    lengths = [mean * factor(rng) for _ in range(farm.frames * farm.parts)]
    new_parts = 0  # that have begun
    ready = []  # what else can begin: (step of the order above, frame, number, seconds of rendering left)
    events = []  # (time, number, what happens, frame, seconds left)
    free, count, now = slots, 0, 0.0

    def push(time, event, frame, left=0.0):
        nonlocal count
        count += 1
        heapq.heappush(events, (time, count, event, frame, left))

    def make_ready(order, frame, left=0.0):
        nonlocal count
        count += 1
        heapq.heappush(ready, (order, frame, count, left))

    def render(frame, left):
        begun = max(storage.serve(now, farm.scene_bytes), now + farm.start)
        seconds, kept, failed = stretch(left, farm, rate, rng)
        outcome.useful += farm.threads * kept
        outcome.failures += failed
        push(begun + seconds, "failed" if failed else "rendered", frame, left - kept)

    def begin_next():
        nonlocal new_parts
        outcome.starts += 1
        if not ready:
            outcome.last_new_part = now
            frame, left = new_parts // farm.parts, lengths[new_parts]
            new_parts += 1
            render(frame, left)
            return
        order, frame, _, left = heapq.heappop(ready)
        if order == REQUEUED:
            render(frame, left)
            return
        outcome.first_merge = min(outcome.first_merge, now)
        seconds = farm.frame_bytes / farm.merge_rate
        outcome.merge_seconds += seconds
        push(max(storage.serve(now, farm.frame_bytes), now + seconds), "merged", frame)

    while True:
        while free > 0 and (ready or new_parts < len(lengths)):
            free -= 1
            begin_next()
        if not events:
            break
        now, _, event, frame, left = heapq.heappop(events)
        if event == "rendered":
            push(storage.serve(now, farm.frame_bytes / farm.parts), "part", frame)
        elif event == "part":
            free += 1
            missing[frame] -= 1
            if missing[frame] == 0 and farm.parts > 1:
                make_ready(MERGE, frame)
        elif event == "merged":
            push(storage.serve(now, farm.frame_bytes), "frame", frame)
        elif event == "frame":
            free += 1
        elif event == "failed":
            free += 1
            push(now + farm.requeue_delay, "requeued", frame, left)
        else:
            make_ready(REQUEUED, frame, left)
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


def row(name, farm, outcome):
    """A row of the table in docs/scaling.md."""
    return (f"| {name} | {outcome.makespan:.0f} | {outcome.efficiency(farm):.3f} | {outcome.failures} | "
            f"{3600 * outcome.failures / outcome.makespan:.0f} | {outcome.starts / outcome.makespan:.0f} | "
            f"{100 * outcome.storage_busy / outcome.makespan:.0f} % |")


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
        print(row(name, farm, simulate(farm, seed)), flush=True)


if __name__ == "__main__":
    main()
