#!/usr/bin/env python3
"""Runs the notebooks, which are Python files, and writes each as a page of Markdown with its texts, code, output and plots.

Usage: python/notebooks/run.py FOLDER [NAME...]
       python/notebooks/run.py --check FOLDER    fails if the pages in a folder do not have the code of the notebooks
A cell begins with `# %%` and a title. The first string of the file is the introduction.
"""
import ast
import contextlib
import io
import pathlib
import re
import sys
import time

import matplotlib

matplotlib.use("agg")
import matplotlib.pyplot as plt

HERE = pathlib.Path(__file__).resolve().parent
NAMES = sorted(path.stem for path in HERE.glob("*.py") if path.stem != "run")


def cells(text):
    """(title, code) of each cell behind the introduction."""
    parts = re.split(r"^# %% *(.*)\n", text, flags=re.MULTILINE)
    yield None, parts[0]
    yield from zip(parts[1::2], parts[2::2])


def code_of(page):
    return "\n".join(re.findall(r"^```python\n(.*?)^```", page, flags=re.MULTILINE | re.DOTALL))


def check(folder):
    """Fails if a page has other code or texts than its notebook, or is missing."""
    for name in NAMES:
        page = folder / f"{name}.md"
        source = (HERE / f"{name}.py").read_text()
        code = "\n".join((code.split('"""', 2)[2] if title is None else code).strip() + "\n"
                         for title, code in cells(source))
        if not page.exists() or code_of(page.read_text()) != code:
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
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    if sys.argv[1] == "--check":
        return check(pathlib.Path(sys.argv[2]))
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    names = sys.argv[2:] or NAMES
    plt.show = lambda: None
    for name in names:
        begin = time.perf_counter()
        (folder / f"{name}.md").write_text(run(HERE / f"{name}.py", folder))
        print(f"{name}: {time.perf_counter() - begin:.1f} s")


if __name__ == "__main__":
    main()
