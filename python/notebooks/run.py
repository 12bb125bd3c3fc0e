#!/usr/bin/env python3
"""Runs the notebooks, which are Python files, and writes each as a page of Markdown with its texts, code, output and plots.

Usage: python/notebooks/run.py [--limit SECONDS] FOLDER [NAME...]
       python/notebooks/run.py --check FOLDER    fails if the pages in a folder have other code or texts than the notebooks
A cell begins with `# %%` and a title. The first string of the file is the introduction. Code runs in the folder of the repository,
where it finds scenes. The limit is one for the CPU time of all threads and notebooks, which other programs do not change; on an
idle machine, they take less than that.
"""
import argparse
import ast
import contextlib
import io
import os
import pathlib
import re
import sys
import time

try:
    import matplotlib
    import nusselt
except ModuleNotFoundError as error:
    sys.exit(f"{sys.executable} has no {error.name}; docs/python.md says what notebooks need")

matplotlib.use("agg")
import matplotlib.pyplot as plt

HERE = pathlib.Path(__file__).resolve().parent
NAMES = sorted(path.stem for path in HERE.glob("*.py") if path.stem != "run")


def cells(text):
    """(title, code) of each cell behind the introduction."""
    parts = re.split(r"^# %% *(.*)\n", text, flags=re.MULTILINE)
    yield None, parts[0]
    yield from zip(parts[1::2], parts[2::2])


def sources(path):
    """The texts and code of a page: what does not depend on the machine."""
    text = path.read_text()
    parts = [ast.get_docstring(ast.parse(text))]
    for title, code in cells(text):
        parts += [code.split('"""', 2)[2]] if title is None else [f"## {title}", code]
    return [part.strip() for part in parts]


def sources_of(page):
    """The same of a page: all but output and plots."""
    page = re.sub(r"^```text\n.*?^```\n", "", page, flags=re.MULTILINE | re.DOTALL)
    page = re.sub(r"^!\[.*\n", "", page, flags=re.MULTILINE)
    parts = re.split(r"^```python\n(.*?)^```\n", page, flags=re.MULTILINE | re.DOTALL)
    return [part.strip() for part in parts if part.strip()]


def check(folder):
    """Fails if a page has other code, titles or another introduction than its notebook, or is missing. Outputs and plots
    depend on times, and are not compared."""
    for name in NAMES:
        page = folder / f"{name}.md"
        if not page.exists() or sources_of(page.read_text()) != sources(HERE / f"{name}.py"):
            sys.exit(f"{page} is not that of python/notebooks/{name}.py; run python/notebooks/run.py {folder}")


def run(path, folder):
    """Runs one notebook. Returns the text of its page."""
    text = path.read_text()
    introduction = ast.get_docstring(ast.parse(text))
    page = [introduction, ""]
    names = {"__name__": "__main__"}
    plots = 0
    for title, code in cells(text):
        if title is None:
            code = code.split('"""', 2)[2]
        else:
            page += [f"## {title}", ""]
        output = io.StringIO()
        with contextlib.redirect_stdout(output):
            exec(compile(code, str(path), "exec"), names)  # the files are our own
        page += ["```python", code.strip(), "```", ""]
        if output.getvalue():
            page += ["```text", output.getvalue().rstrip(), "```", ""]
        for number in plt.get_fignums():
            plots += 1
            name = f"{path.stem}-{plots}.png"
            plt.figure(number).savefig(folder / name, dpi=100)
            page += [f"![{title}]({name})", ""]
        plt.close("all")
    return "\n".join(page)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--limit", type=float, default=float("inf"))
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("names", nargs="*", metavar="name")
    arguments = parser.parse_args()
    folder = arguments.folder.resolve()
    if arguments.check:
        return check(folder)
    unknown = [name for name in arguments.names if name not in NAMES]
    if unknown:
        parser.error(f"no notebook has the name {unknown[0]}; use {', '.join(NAMES)}")
    folder.mkdir(parents=True, exist_ok=True)
    plt.show = lambda: None
    os.chdir(HERE.parents[1])
    for name in arguments.names or NAMES:
        begin = time.process_time()
        (folder / f"{name}.md").write_text(run(HERE / f"{name}.py", folder))
        print(f"{name}: {time.process_time() - begin:.1f} s")
    if time.process_time() > arguments.limit:
        sys.exit(f"the notebooks take {time.process_time():.0f} s of CPU time, more than {arguments.limit:.0f} s")


if __name__ == "__main__":
    main()
