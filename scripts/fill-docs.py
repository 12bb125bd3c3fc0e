#!/usr/bin/env python3
"""Puts measured numbers into the documentation. Needs only the standard library of Python.

Usage: scripts/fill-docs.py [--check] [ROOT]
  --check  changes nothing and exits with 1 if a page lags behind docs/data, has a table of numbers of unknown origin,
           or is a page of docs/techniques without numbers; or if no page uses a file of docs/data

The files of docs/data are what commands of nusselt-lab write with --json. A page says which numbers it shows in a
comment and has the generated table between this comment and the next one:

    <!-- table: samplers.json samplers; technique = LineArea | LineSolidAngle; lanes != 1; once
    ### {technique}
    | lights | {code} |
    | {lights} | {prepare_ns:.3g} / {sample_ns:.3g} |
    On {processor}. -->
    <!-- end -->

The first line names files (separated by `+`, or with `*`), a table in each, and conditions that rows have to meet.
Then two lines of a table follow: the headings, and the cells of each row. `{...}` stands for a column, a setting or a
property of the machine, or for products and quotients of these and of numbers. A column whose heading has such a
field becomes a column for each of its values, and rows that do not differ in the other columns become one. A heading
above makes a table for each of its values. Remarks may follow. With `once`, the first column is left empty where it
repeats.

Formats are those of Python; `,` groups three digits, and `.2g%` shows a percentage. Without a format, numbers are
shown as the file has them. Null is shown as -, and a cell with nothing but null stays empty. True is shown as yes.

A table of numbers that no program prints has the comment `<!-- by hand: REASON -->` above it.
"""
import json
import pathlib
import re
import sys

REGION = re.compile(r"<!-- table: ([^\n]*)\n(.*?) -->\n(.*?)<!-- end -->", re.DOTALL)
FIELD = re.compile(r"\{([^{}:]+)(?::([^{}]*))?\}")
FACTOR = re.compile(r"\s*([*/]?)\s*(\w[\w.]*)\s*")
NUMBER = re.compile(r"[*`~<+-]*\s*\d")
BY_HAND = re.compile(r"<!-- by hand: (?:\S+\s+){3,}[^>]*-->$", re.DOTALL)


class Literal(float):
    """A number that remembers how the file has it."""

    def __new__(cls, text):
        number = super().__new__(cls, text)
        number.text = text
        return number


def load(file):
    document = json.loads(file.read_text(), parse_float=Literal)
    for key in ("bench", "command", "version", "machine", "settings", "tables"):
        if key not in document:
            raise ValueError(f"{file.name}: no '{key}'")
    return document


def records(document, name):
    """The rows of a table with all that a field can name."""
    for table in document["tables"]:
        if table["name"] == name:
            columns = [column["name"] for column in table["columns"]]
            common = {"bench": document["bench"], **document["machine"], **document["settings"]}
            return [{**common, **dict(zip(columns, row, strict=True))} for row in table["rows"]]
    raise ValueError(f"no table '{name}' of bench {document['bench']}")


def value_of(expression, record):
    """A field, or a product or quotient; None where a part of it is."""
    def operand(name):
        if name in record:
            return record[name]
        return float(name)  # raises ValueError for names that are not there

    factors = FACTOR.findall(expression)
    value = operand(factors[0][1])
    for operator, name in factors[1:]:
        other = operand(name)
        if value is None or other is None:
            return None
        value = value * other if operator == "*" else value / other
    return value


def shown(value, spec):
    if value is None:
        return "-"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if not spec:
        return getattr(value, "text", str(value))
    if spec == ",":
        return f"{value:,}".replace(",", " ")
    if value == 0 and spec[-1] in "e%":
        return "0"
    if spec[-1] != "%":
        return f"{value:{spec}}"
    percent = f"{100 * value:{spec[:-1]}}"
    return f"{100 * value:.0f} %" if "e+" in percent else f"{percent} %"


def fill_template(template, record):
    """The text; empty if all of its fields are null."""
    values = []

    def replacement(match):
        values.append(value_of(match.group(1), record))
        return shown(values[-1], match.group(2))

    text = FIELD.sub(replacement, template)
    return "" if values and all(v is None for v in values) else text


def cells_of(line):
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def is_value(value, text):
    """Whether a condition means this value. Numbers are compared as such; null is written as -."""
    if value is None or text == "-":
        return value is None and text == "-"
    if isinstance(value, (bool, str)):
        return shown(value, "") == text
    return value == float(text)


def selected(record, conditions):
    for condition in conditions:
        key, operator, values = re.fullmatch(r"(\w+) (=|!=) (.*)", condition).groups()
        if any(is_value(record[key], text.strip()) for text in values.split("|")) != (operator == "="):
            return False
    return True


def one_table(headings, cells, rows, once):
    """The lines of a Markdown table."""
    titles = {}  # of the output columns: the position in the template, in the order of appearance
    output = {}  # key of a row: its cells by title
    pivots = [i for i, heading in enumerate(headings) if FIELD.search(heading)]
    for number, record in enumerate(rows):
        texts = [fill_template(cell, record) for cell in cells]
        key = tuple(text for i, text in enumerate(texts) if i not in pivots) if pivots else number
        row = output.setdefault(key, {})
        for i, heading in enumerate(headings):
            title = (i, fill_template(heading, record) if i in pivots else heading)
            titles[title] = True
            if row.get(title, texts[i]) != texts[i]:
                raise ValueError(f"two values in one cell: {row[title]} and {texts[i]}")
            row[title] = texts[i]
    columns = sorted(titles, key=lambda title: title[0])
    lines = [[title for _, title in columns], ["---"] * len(columns)]
    last = None
    for row in output.values():
        lines.append([row.get(title, "") for title in columns])
        name = lines[-1][0]
        if once and name == last:
            lines[-1][0] = ""
        last = name
    return "".join("| " + " | ".join(line) + " |\n" for line in lines)


def files_of(source, folder):
    """The files of `FILE + FILE TABLE`."""
    for pattern in source.split()[:-1]:
        files = sorted(folder.glob(pattern)) if pattern != "+" else []
        if not files and pattern != "+":
            raise ValueError(f"no file {pattern}")
        yield from files


def region(selection, template, folder):
    """The generated text of a region."""
    source, *conditions = [part.strip() for part in selection.split(";")]
    once = "once" in conditions
    conditions = [condition for condition in conditions if condition != "once"]
    rows = []
    for file in files_of(source, folder):
        found = [r for r in records(load(file), source.split()[-1]) if selected(r, conditions)]
        if not found:
            raise ValueError(f"{file.name} has no such rows")
        rows += found
    lines = template.split("\n")
    heading = lines.pop(0) if lines[0].startswith("#") else ""
    headings, cells = cells_of(lines[0]), cells_of(lines[1])
    if len(headings) != len(cells):
        raise ValueError("not as many cells as headings")
    parts = {}
    for record in rows:
        parts.setdefault(fill_template(heading, record), []).append(record)
    text = "\n".join((f"{title}\n\n" if title else "") + one_table(headings, cells, part, once)
                     for title, part in parts.items())
    remarks = "\n".join(fill_template(line, rows[0]) for line in lines[2:])
    return text + (f"\n{remarks}\n" if remarks else "")


def fill(page, text, folder):
    """The text with all regions filled. Raises ValueError where that is not possible."""
    def content(match):
        selection, template, _ = match.groups()
        try:
            return f"<!-- table: {selection}\n{template} -->\n{region(selection, template, folder)}<!-- end -->"
        except (KeyError, OSError, ValueError, AttributeError, ZeroDivisionError) as error:
            raise ValueError(f"{page}: <!-- table: {selection}: {error}") from error

    if len(REGION.findall(text)) != text.count("<!-- table:"):
        raise ValueError(f"{page}: a table without a template or an end")
    return REGION.sub(content, text)


def is_numeric(table):
    cells = [cell for line in table[2:] for cell in cells_of(line)]
    return 4 * sum(bool(NUMBER.match(cell)) for cell in cells) >= len(cells) > 0


def unmarked_tables(text):
    """First lines of tables of numbers that are neither generated nor accounted for."""
    text = re.sub(r"^```.*?^```", "", REGION.sub("", text), flags=re.DOTALL | re.MULTILINE)
    for match in re.finditer(r"(?:^\|[^\n]*\n){3,}", text, re.MULTILINE):
        above = text[:match.start()].rstrip()
        table = match.group().splitlines()
        if is_numeric(table) and not BY_HAND.search(above[above.rfind("<!--"):] if "<!--" in above else ""):
            yield table[0]


def pages(root):
    folders = ("docs", "shaders", "examples", "scenes", "data")
    return sorted([*root.glob("*.md"), *(page for folder in folders for page in (root / folder).rglob("*.md"))])


def complaints(root):
    folder = root / "docs/data"
    used = set()
    for page in pages(root):
        text = page.read_text()
        try:
            used.update(file for selection, *_ in REGION.findall(text)
                        for file in files_of(selection.split(";")[0], folder))
            if fill(page, text, folder) != text:
                yield f"{page}: lags behind docs/data; run scripts/fill-docs.py"
        except ValueError as error:
            yield str(error)
        for line in unmarked_tables(text):
            yield f"{page}: numbers of unknown origin; name their data, or the reason why there is none:\n{line}"
        if page.parent.name == "techniques" and page.name != "README.md" and not re.search(
                "<!-- (table|by hand):", text):
            yield f"{page}: no table of numbers"
    for file in sorted(folder.glob("*.json")):
        if file not in used:
            yield f"{file}: no page shows it"


def main(arguments):
    check = arguments[:1] == ["--check"]
    root = pathlib.Path(*arguments[check:]) if arguments[check:] else pathlib.Path(__file__).parent.parent
    if check:
        found = list(complaints(root))
        for complaint in found:
            print(complaint)
        return 1 if found else 0
    for page in pages(root):
        text = page.read_text()
        filled = fill(page, text, root / "docs/data")
        if filled != text:
            page.write_text(filled)
    return 0


if __name__ == "__main__":
    if len(sys.argv) > 3 or any(argument in ("-h", "--help") for argument in sys.argv):
        sys.exit(__doc__)
    try:
        sys.exit(main(sys.argv[1:]))
    except ValueError as error:
        sys.exit(str(error))
