#!/usr/bin/env bash
# Shows that count-tests.sh counts each test of a process, and a process that ended without a report as one failure.
set -euo pipefail
count=$(cd "$(dirname "$0")/../../scripts" && pwd)/count-tests.sh
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# What ctest writes, with $1 tests, $2 failures, $3 disabled and $4 skipped ones.
ctest_report() {
    printf '<testsuite name="(empty)"\n\ttests="%s"\n\tfailures="%s"\n\tdisabled="%s"\n\tskipped="%s"\n\t>\n' "$@" >ctest.xml
}
# What GoogleTest writes for a process $1 with two suites; the second has $2 failures, $3 disabled and $4 skipped tests.
process_report() {
    mkdir -p reports
    {
        echo "<testsuites tests=\"12\" failures=\"$2\" disabled=\"$3\" errors=\"0\" time=\"1\" name=\"AllTests\">"
        echo '  <testsuite name="A" tests="5" failures="0" disabled="0" skipped="0" errors="0" time="1">'
        echo '    <testcase name="tests" status="run" result="completed" time="1" classname="A" />'
        echo "  <testsuite name=\"B\" tests=\"7\" failures=\"$2\" disabled=\"$3\" skipped=\"$4\" errors=\"0\" time=\"1\">"
    } >"reports/$1.xml"
}
expect() {
    local text
    text=$("$count" ctest.xml reports)
    [ "$text" = "$1" ] || { echo "expected $1, found $text"; exit 1; }
}

ctest_report 10 1 2 3
expect '10 1 5'
process_report p 0 0 0
expect '21 1 5'
process_report p 4 0 0 # the process is the failed one of ten
expect '21 4 5'
process_report q 0 1 2
expect '32 4 8'
