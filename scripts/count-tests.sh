#!/usr/bin/env bash
# Prints how many tests there were, how many failed and how many were skipped: "ALL FAILED SKIPPED".
# Usage: scripts/count-tests.sh REPORT FOLDER STATUS
#   REPORT   what ctest --output-junit wrote
#   FOLDER   reports of GoogleTest from processes with many tests, each of which is one test in REPORT. Its file `expected` has
#            their names, a line each. A process without a report, or with one without tests, has failed, unless ctest left it out,
#            as presets with filters do. Need not exist.
#   STATUS   the exit status of ctest: where it tells of a failure that REPORT lacks, such as a test that did not start, one test
#            has failed
set -euo pipefail
# The number in attribute $1 of the test suite.
count() { grep -m 1 -oE "^\s+$1=\"[0-9]+\"" "$report" | grep -oE "[0-9]+"; }
report=$1 folder=$2 status=$3
all=$(count tests) bad=$(count failures) ignored=$(($(count skipped) + $(count disabled)))
processes=()
[ ! -e "$folder/expected" ] || mapfile -t processes <"$folder/expected"
silent=0
for name in ${processes[@]+"${processes[@]}"}; do
    grep -qF "<testcase name=\"$name\"" "$report" || continue
    process=$folder/$name.xml
    tests=0 failures=0 skipped=0
    [ ! -e "$process" ] || read -r tests failures skipped < <(awk '/<testsuite / {
            for (i = 1; i <= NF; ++i) {
                split($i, field, "\"")
                if (field[1] == "tests=") tests += field[2]
                if (field[1] == "failures=") failures += field[2]
                if (field[1] == "skipped=" || field[1] == "disabled=") skipped += field[2]
            }
        }
        END { print tests + 0, failures + 0, skipped + 0 }' "$process")
    if [ "$tests" -eq 0 ]; then
        silent=$((silent + 1))
        continue
    fi
    # The process itself is not a test.
    all=$((all + tests - 1)) ignored=$((ignored + skipped))
    [ "$failures" -eq 0 ] || bad=$((bad + failures - 1))
done
# Those that crashed are among the failures of ctest.
[ "$silent" -le "$bad" ] || bad=$silent
[ "$status" -eq 0 ] || [ "$bad" -gt 0 ] || bad=1
echo "$all $bad $ignored"
