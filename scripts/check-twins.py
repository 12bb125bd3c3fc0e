#!/usr/bin/env python3
"""Fails where a shader of shaders/nusselt may have fallen behind the C++ text that it follows.

Each file there has one line or more of
    // Follows include/nusselt/FILE.h @ 0123456789ab
whose stamp is a hash of that header without comments and white space, or one line
    // Follows no header: REASON
Coefficients of polynomials, which C++ writes with the suffix f and at least five digits, must stand in the shaders that
follow their header too, each as often as there.

Usage: scripts/check-twins.py [--root FOLDER]                 checks
       scripts/check-twins.py [--root FOLDER] --update FILE...  stamps these shaders, after a look at both texts
"""
import argparse
import collections
import hashlib
import pathlib
import re
import struct
import sys

STAMP = re.compile(r"^// Follows (include/nusselt/\S+\.h) @ (\S+)$", re.MULTILINE)
EXEMPT = re.compile(r"^// Follows no header: \S.*$", re.MULTILINE)
# Strings stay, whatever their content; comments go.
COMMENT = re.compile(r'("(?:\\.|[^"\\\n])*")|//[^\n]*|/\*.*?\*/', re.DOTALL)
NUMBER = re.compile(r"(-?)(?<![\w.])(\d+\.\d*|\.\d+|\d+(?=e))(e[-+]?\d+)?(f?)(?![\w.])", re.IGNORECASE)


def code_of(text):
    return COMMENT.sub(lambda match: match.group(1) or " ", text)


def stamp_of(text):
    return hashlib.sha256("".join(code_of(text).split()).encode()).hexdigest()[:12]


def as_float(text):
    """The number in single precision."""
    return struct.unpack("f", struct.pack("f", float(text)))[0]


def numbers(text, suffix):
    """Counts each number with five digits or more in the text."""
    found = collections.Counter()
    for match in NUMBER.finditer(code_of(text)):
        sign, mantissa, exponent, ending = match.groups(default="")
        if ending.lower() == suffix and len(mantissa.replace(".", "").lstrip("0")) >= 5:
            found[as_float(sign + mantissa + exponent)] += 1
    return found


def check_stamps(root, shader, text):
    """Yields the defects of the stamps of a shader."""
    stamps = STAMP.findall(text)
    if bool(stamps) == bool(EXEMPT.search(text)):
        yield f"{shader}: must have either lines '// Follows include/nusselt/FILE.h @ STAMP' or '// Follows no header: REASON'"
    for header, stamp in stamps:
        path = root / header
        if not path.exists():
            yield f"{shader}: follows {header}, which does not exist"
        elif stamp != stamp_of(path.read_text()):
            yield (f"{shader}: {header} has changed since the two were last compared. Look at both, carry over what "
                   f"changed, then run: scripts/check-twins.py --update {shader}")


def check_coefficients(root, shaders):
    """Yields the coefficients that differ; shaders is a dictionary of their texts."""
    followers = collections.defaultdict(list)
    for shader, text in shaders.items():
        for header, _ in STAMP.findall(text):
            followers[header].append(shader)
    for header, names in sorted(followers.items()):
        if not (root / header).exists():
            continue
        here = numbers((root / header).read_text(), "f")
        there = sum((numbers(shaders[name], "") for name in names), collections.Counter())
        for value, count in here.items():
            if there[value] != count:
                yield f"{header}: {value:.9g} appears here {count} times and in {', '.join(names)} {there[value]} times"


def update(root, name):
    path = root / name
    path.write_text(STAMP.sub(lambda match: f"// Follows {match.group(1)} @ {stamp_of((root / match.group(1)).read_text())}",
                              path.read_text()))


def main():
    parser = argparse.ArgumentParser(description="Checks that shaders follow the C++ text.")
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent.parent)
    parser.add_argument("--update", nargs="+", metavar="FILE", default=[], help="shaders to stamp, relative to the root")
    arguments = parser.parse_args()
    root = arguments.root
    for name in arguments.update:
        update(root, name)
    files = sorted((root / "shaders/nusselt").rglob("*.glsl"))
    shaders = {str(path.relative_to(root)): path.read_text() for path in files}
    problems = [] if shaders else [f"{root}/shaders/nusselt: no shaders"]
    for shader, text in shaders.items():
        problems += check_stamps(root, shader, text)
    problems += check_coefficients(root, shaders)
    print("\n".join(problems), end="\n" if problems else "")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
