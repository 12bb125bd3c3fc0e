#!/usr/bin/env bash
# Prints how many tests there were, how many failed and how many were skipped: "ALL FAILED SKIPPED".
# Usage: scripts/count-tests.sh REPORT FOLDER
#   REPORT   what ctest --output-junit wrote
#   FOLDER   reports of GoogleTest from processes with many tests, each of which is one test in REPORT; need not exist
set -euo pipefail
# The number in attribute $1 of the test suite.
count() { grep -m 1 -oE "^\s+$1=\"[0-9]+\"" "$report" | grep -oE "[0-9]+"; }
report=$1
all=$(count tests) bad=$(count failures) ignored=$(($(count skipped) + $(count disabled)))
for process in "$2"/*.xml; do
    [ -e "$process" ] || break
    read -r tests failures skipped < <(awk '/<testsuite / {
            for (i = 1; i <= NF; ++i) {
                split($i, field, "\"")
                if (field[1] == "tests=") tests += field[2]
                if (field[1] == "failures=") failures += field[2]
                if (field[1] == "skipped=" || field[1] == "disabled=") skipped += field[2]
            }
        }
        END { print tests + 0, failures + 0, skipped + 0 }' "$process")
    # The process itself is not a test.
    all=$((all + tests - 1)) ignored=$((ignored + skipped))
    [ "$failures" -eq 0 ] || bad=$((bad + failures - 1))
done
echo "$all $bad $ignored"
