#!/usr/bin/env bash
# Shows that scripts/check-docs.py accepts good pages and finds each kind of offence.
set -euo pipefail
scripts=$(cd "$(dirname "$0")/../../scripts" && pwd)
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir -p "$tree/docs/techniques/images" "$tree/examples"
page=$tree/docs/techniques/page.md

# Expects that the check $1 succeeds or fails ($2); further arguments go to the check.
expect() {
    local check=$1 expected=$2 result
    shift 2
    if "$scripts/check-docs.py" "$check" "$tree" "$@" >"$tree/log" 2>&1; then result=passes; else result=fails; fi
    [ "$result" = "$expected" ] || { echo "check '$check' $result:"; cat "$page" "$tree/log"; exit 1; }
}

# Code.
echo 'int two() { return 1 + 1; } int three();' >"$tree/examples/a.cpp"
printf '```cpp\nint two() {  // comment\n    return 1 + 1;\n}\n\nint three();\n```\n' >"$page"
cp "$page" "$tree/README.md"
expect code passes
printf '```cpp\nint two() { return 2; }\n```\n' >"$page"
expect code fails

# Links.
echo '[a](page.md#part), [b](https://example.org), ![c](images/a.svg)' >"$page"
expect links fails
echo drawn >"$tree/docs/techniques/images/a.svg"
expect links passes

# Pictures, drawn by a program that prints its argument.
printf '#!/bin/sh\nprintf "%%s\\n" "$2" >"$3"\n' >"$tree/program"
chmod +x "$tree/program"
expect pictures fails "$tree/program"
echo a >"$tree/docs/techniques/images/a.svg"
expect pictures passes "$tree/program"
