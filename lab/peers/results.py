"""Writes results in the format of lab/results/results.h, from which scripts/fill-docs.py fills the documentation."""
import json
import math
import os
import pathlib


def processor():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":")[1].strip()
    return "unknown"


def rounded(value):
    """Six digits: more would only be noise. Numbers that are not finite become null."""
    if isinstance(value, float):
        return float(f"{value:.6g}") if math.isfinite(value) else None
    return value


def rows_of_other_scenes(file, scenes, settings):
    """The rows of each table of a file, without those of the given scenes. Scenes are in the first column."""
    try:
        document = json.loads(file.read_text())
        old = document["settings"]
        rows = {table["name"]: [row for row in table["rows"] if row[0] not in scenes] for table in document["tables"]}
    except (AttributeError, KeyError, TypeError, json.JSONDecodeError):
        raise ValueError(f"{file} has no results of this script; name another file, or remove it") from None
    for name, value in settings.items():
        if old.get(name) != value:
            raise ValueError(f"{file}: {name} is not {value}; its rows and new ones do not belong together")
    return rows


def line_of(value):
    return json.dumps(value, ensure_ascii=False)


def to_json(bench, command, version, settings, tables):
    """`tables` are triples of a name, columns (a name or a name with a unit), and rows with a cell for each column."""
    texts = []
    for name, columns, rows in tables:
        heads = [{"name": c} if isinstance(c, str) else {"name": c[0], "unit": c[1]} for c in columns]
        if any(len(row) != len(columns) for row in rows):
            raise ValueError(f"table {name}: a row without a cell for each column")
        lines = ",\n".join(line_of([rounded(cell) for cell in row]) for row in rows)
        body = f"[\n{lines}\n]" if rows else "[]"
        texts.append(f'{{"name": {line_of(name)}, "columns": {line_of(heads)}, "rows": {body}}}')
    head = {"bench": bench, "command": command, "version": version,
            "machine": {"processor": processor(), "threads": os.cpu_count()}, "settings": settings}
    lines = ",\n".join(f"{line_of(key)}: {line_of(value)}" for key, value in head.items())
    joined = ",\n".join(texts)
    return f'{{{lines},\n"tables": [\n{joined}\n]}}\n'
