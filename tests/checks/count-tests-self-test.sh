#!/usr/bin/env bash
# Shows that count-tests.sh counts each test of a process, and as a failure each process without a report and what did not
# start, and that failed-tests.sh names them.
set -euo pipefail
scripts=$(cd "$(dirname "$0")/../../scripts" && pwd)
count=$scripts/count-tests.sh
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# What ctest writes, with $1 tests, $2 failures, $3 disabled and $4 skipped ones. Processes p and q are among them.
ctest_report() {
    printf '<testsuite name="(empty)"\n\ttests="%s"\n\tfailures="%s"\n\tdisabled="%s"\n\tskipped="%s"\n\t>\n' "$@" >ctest.xml
    printf '\t<testcase name="%s" classname="%s" time="1" status="run">\n' p p q q >>ctest.xml
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
# The processes of which reports are expected.
expect_reports() {
    mkdir -p reports
    printf '%s\n' "$@" >reports/expected
}
# $1: the counts, $2: the exit status of ctest.
expect() {
    local text
    text=$("$count" ctest.xml reports "${2:-0}")
    [ "$text" = "$1" ] || { echo "line ${BASH_LINENO[0]}: expected $1, found $text"; exit 1; }
}

ctest_report 10 1 2 3
expect '10 1 5'
expect_reports p
process_report p 0 0 0
expect '21 1 5'
process_report p 4 0 0 # the process is the failed one of ten
expect '21 4 5'
expect_reports p q
process_report q 0 1 2
expect '32 4 8'
# A process that crashed has no report, and is the failed one of ten.
rm reports/*.xml
expect_reports p
expect '10 1 5' 8
# One that ended well without a report, and one whose filter names no test, have failed all the same.
ctest_report 10 0 2 3
expect '10 1 5'
echo '<testsuites tests="0" failures="0" disabled="0" errors="0" time="0" name="AllTests">' >reports/p.xml
expect '10 1 5'
# Among the skipped tests of ctest are those that did not start.
process_report p 0 0 0
expect '21 0 5'
expect '21 1 5' 8
# The filter of a preset left out the process r.
expect_reports p r
expect '21 0 5'

names() { "$scripts/failed-tests.sh" failed.log ctest.xml reports; }
[ "$(names)" = "" ] || { echo "names without failures"; exit 1; }
expect_reports p q
rm -f reports/q.xml
[ "$(names)" = 'q (without a report)' ] || { names; exit 1; }
printf '%s\n' '7:checks.format' '12:p' >failed.log
cat >reports/p.xml <<'END'
    <testcase name="Passes" line="1" classname="A" />
    <testcase name="Fails/1" line="2" classname="B/C">
      <failure message="one" type=""><![CDATA[one]]></failure>
      <failure message="two" type=""><![CDATA[two]]></failure>
END
[ "$(names)" = $'checks.format\np\n    B/C.Fails/1\nq (without a report)' ] || { names; exit 1; }
