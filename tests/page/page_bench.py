#!/usr/bin/env python3
"""Measures the live page in a browser without a window, with WebGL on the processor.

Usage: tests/page/page_bench.py OUTPUT.json [PAGE.html] [NAME...]
NAME restricts it to some of the rows below. Without a page, it builds one. Besides time by the clock, it measures
processor time of the browser, which depends less on what else the machine does.
"""
import json
import os
import pathlib
import platform
import re
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/browser"))
from browser import WEBGL, Browser

WIDTH, HEIGHT = 480, 270
FRAMES = 4   # in a run
RUNS = 3     # after a first one; the fastest counts, since other programs only make them longer
ONE = "compare=0&reference=0&"
# The link of each row.
ROWS = {
    "floor, area beside projected solid angle": "reference=0",
    "floor, area": ONE + "left=area",
    "floor, area, without shadows": ONE + "left=area&shadows=0",
    "floor, projected solid angle": ONE + "left=projected",
    "floor, projected solid angle + LTC": ONE + "left=projected_ltc",
    "room with a thick tube, area": ONE + "scene=room&thick=1&left=area",
}
COLUMNS = [{"name": "images"}, {"name": "first_s", "unit": "s"}, {"name": "first_cpu_s", "unit": "s"},
           {"name": "frame_s", "unit": "s"}, {"name": "frame_cpu_s", "unit": "s"}, {"name": "frames_per_second"}]
STATE = """
const done = arguments[0];
(function poll() {
    const { state } = document.documentElement.dataset;
    if (state === "loading") setTimeout(poll, 5);
    else done(state);
})();
"""
FRAME_COUNT = """
const [names, count, done] = arguments;
(function poll() {
    if (names.every(name => window.nusselt.frames(name) >= count)) done();
    else setTimeout(poll, 5);
})();
"""


def descendants(root):
    """The numbers of the processes that a process has started, and of those that these have."""
    parents = {}
    for entry in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            text = entry.read_text()
        except OSError:
            continue  # it has ended
        parents[int(entry.parent.name)] = int(text.rsplit(")", 1)[1].split()[1])
    found = {root}
    while len(added := {child for child, parent in parents.items() if parent in found} - found):
        found |= added
    return found


def processor_time(root):
    """Of a process and its descendants [s]."""
    ticks = 0
    for process in descendants(root):
        try:
            fields = pathlib.Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()
        except OSError:
            continue
        ticks += sum(map(int, fields[11:15]))
    return ticks / os.sysconf("SC_CLK_TCK")


class Stopwatch:
    def __init__(self, process):
        self.process = process
        self.begin = time.monotonic(), processor_time(process)

    def read(self):
        """Time by the clock and processor time since the start [s]."""
        return time.monotonic() - self.begin[0], processor_time(self.process) - self.begin[1]


def measure(page, name):
    """A browser of its own, which remembers no programs."""
    browser = Browser(WEBGL, ())
    try:
        browser.driver.set_script_timeout(600)
        browser.use_screen(1000, 800, False)
        browser.driver.get("about:blank")
        process = browser.driver.service.process.pid
        names = ["left"] if "compare=0" in ROWS[name] else ["left", "right"]
        wait = lambda count: browser.driver.execute_async_script(FRAME_COUNT, names, count)
        watch = Stopwatch(process)
        browser.driver.get(f"file://{page}#width={WIDTH}&frames={(RUNS + 1) * FRAMES + 1}&{ROWS[name]}")
        state = browser.driver.execute_async_script(STATE)
        first_wall, first_cpu = watch.read()
        assert state == "ready", browser.find("#failure").text
        wait(FRAMES)
        runs = []
        for run in range(RUNS):
            watch = Stopwatch(process)
            wait((run + 2) * FRAMES)
            runs.append(watch.read())
        wall, cpu = (min(times) for times in zip(*runs))
        assert browser.messages() == []
    finally:
        browser.quit()
    return [name, round(first_wall, 3), round(first_cpu, 2), round(wall / FRAMES, 4), round(cpu / FRAMES, 4),
            round(FRAMES / wall, 2)]


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    output, *others = sys.argv[1:]
    names = [other for other in others if other in ROWS] or list(ROWS)
    pages = [pathlib.Path(other).resolve() for other in others if other.endswith(".html")]
    with tempfile.TemporaryDirectory() as folder:
        page = pages[0] if pages else pathlib.Path(folder) / "index.html"
        if not pages:
            subprocess.run([ROOT / "web/build.py", page], check=True)
        rows = []
        for name in names:
            rows.append(measure(page, name))
            print(rows[-1], flush=True)
    version = re.search(r"project\(nusselt VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]
    processor = re.search(r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text())
    document = {
        "bench": "page", "command": "tests/page/page_bench.py docs/data/page.json", "version": version,
        "machine": {"processor": processor[1] if processor else platform.machine(), "threads": os.cpu_count()},
        "settings": {"width": WIDTH, "height": HEIGHT, "frames": FRAMES, "runs": RUNS},
        "tables": [{"name": "frames", "columns": COLUMNS, "rows": rows}]}
    pathlib.Path(output).write_text(json.dumps(document, indent=1) + "\n")


if __name__ == "__main__":
    main()
