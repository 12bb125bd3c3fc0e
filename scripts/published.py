#!/usr/bin/env python3
"""Checks lab/report/published.json, the list of what the papers show, and the tables of docs/reproduce.md that follow from it.

Usage: scripts/published.py [--update] [--root FOLDER] [--program NUSSELT_LAB]

Each item is shown by experiments of `nusselt-lab reproduce` or by other commands (`by`), does not apply (`not_applicable`)
or is missing (`missing`), for a reason. Exits with 1 and a line for each problem. --update writes the tables. The program
knows which experiments and commands there are; by default, it is that of the build in build/release. Without it, the names
in `by` are not checked, which a line on standard error says.
"""
import argparse
import json
import pathlib
import re
import shutil
import subprocess
import sys

KINDS = {"figure", "table", "statement"}
BEGIN, END = "<!-- items: {} -->\n", "<!-- /items -->\n"


def items_of(papers):
    return [item for paper in papers for item in paper["items"]]


def check_items(papers):
    items = items_of(papers)
    ids = [item["id"] for item in items]
    for name in sorted({name for name in ids if ids.count(name) > 1}):
        yield f"{name}: is there twice"
    for item in items:
        states = [state for state in ("not_applicable", "missing") if item.get(state)] + ["by"] * bool(item["by"])
        if len(states) != 1:
            yield f"{item['id']}: is {' and '.join(states) or 'nothing'}; it needs one of by, not_applicable and missing"
        if item["kind"] not in KINDS:
            yield f"{item['id']}: unknown kind '{item['kind']}'"
        if item.get("scene") == "own" and not item.get("why"):
            yield f"{item['id']}: has an own scene without a reason"
        for number in item["published"]:
            if number.get("value") is None:
                yield f"{item['id']}: '{number.get('quantity')}' has no value"


def check_names(papers, program):
    listed = subprocess.run([program, "reproduce", "--list"], capture_output=True, text=True, check=True).stdout
    known = {line.split()[0] for line in listed.splitlines() if line[:1].strip()}
    for name in sorted({name for item in items_of(papers) for name in item["by"]} - known):
        help_text = subprocess.run([program, *name.split(), "--help"], capture_output=True, text=True).stdout
        # Words that are no command leave the help of the command before them.
        if not re.search(rf"^Usage: nusselt-lab {re.escape(name)}(?! COMMAND)( |$)", help_text, re.MULTILINE):
            yield from (f"{item['id']}: there is neither an experiment nor a command '{name}'"
                        for item in items_of(papers) if name in item["by"])


def row(item):
    if item.get("not_applicable"):
        shown = f"not applicable: {item['not_applicable']}"
    elif item.get("missing"):
        shown = f"**missing**: {item['missing']}"
    else:
        shown = ", ".join(f"`{name}`" for name in item["by"])
        shown += f". Lacks: {item['lacks']}" if item.get("lacks") else ""
    return f"| {item['item']} | {item['shows']} | {shown} |\n"


def table(paper):
    return "| | shows | by |\n| --- | --- | --- |\n" + "".join(row(item) for item in paper["items"])


def check_page(papers, page, update):
    text = page.read_text()
    for paper in papers:
        begin = BEGIN.format(paper["key"])
        parts = re.fullmatch(f"(.*{re.escape(begin)})(.*?)({re.escape(END)}.*)", text, re.DOTALL)
        if parts is None:
            yield f"{page}: has no lines '{begin.strip()}' and '{END.strip()}'"
        elif parts[2] != table(paper):
            text = parts[1] + table(paper) + parts[3]
            if not update:
                yield f"{page}: the table of '{paper['key']}' is out of date; run scripts/published.py --update"
    if update:
        page.write_text(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--update", action="store_true")
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent.parent)
    parser.add_argument("--program")
    arguments = parser.parse_args()
    papers = json.loads((arguments.root / "lab/report/published.json").read_text())["papers"]
    problems = list(check_items(papers)) + list(check_page(papers, arguments.root / "docs/reproduce.md", arguments.update))
    program = shutil.which(arguments.program or arguments.root / "build/release/apps/nusselt-lab/nusselt-lab")
    if program:
        problems += check_names(papers, program)
    elif arguments.program:
        problems.append(f"there is no program {arguments.program}")
    else:
        print("published: no nusselt-lab is built, so that the names in `by` are not checked", file=sys.stderr)
    print("\n".join(problems), end="\n" if problems else "")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
