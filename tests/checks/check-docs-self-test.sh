#!/usr/bin/env bash
# Shows that scripts/check-docs.py accepts good pages and finds each kind of offence.
set -euo pipefail
scripts=$(cd "$(dirname "$0")/../../scripts" && pwd)
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir -p "$tree/docs/techniques/images" "$tree/examples" "$tree/tests/checks"
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
expect links fails
printf '\n# The first, and only: part\n\n## Part\n[d](#the-first-and-only-part)\n```\n# no\n```\n' >>"$page"
expect links passes
echo '[e](#no)' >>"$page"
expect links fails

# Checks in the table.
checks=$tree/tests/checks/CMakeLists.txt
page=$tree/docs/testing.md
printf '| `checks.%s` | script |\n' a 'b_*' >"$page"
printf 'nusselt_add_check(%s script)\n' a a_self_test b_1 b_2 >"$checks"
expect checks passes
echo 'nusselt_add_check(c script)' >>"$checks"
expect checks fails
printf '| `checks.c` | script |\n' >>"$page"
expect checks passes
printf '| `checks.d` | script |\n' >>"$page"
expect checks fails
printf '| `checks.%s` | script |\n' a 'b_*' c >"$page"
echo 'nusselt_add_check(a_${check} script)' >>"$checks"
expect checks fails

# Pictures, drawn by a program that prints its argument.
printf '#!/bin/sh\nprintf "%%s\\n" "$2" >"$3"\n' >"$tree/program"
chmod +x "$tree/program"
expect pictures fails "$tree/program"
echo a >"$tree/docs/techniques/images/a.svg"
expect pictures passes "$tree/program"
