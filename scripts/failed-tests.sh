#!/usr/bin/env bash
# Prints the names of the tests that failed, a line each, with those of GoogleTest that failed in a process.
# Usage: scripts/failed-tests.sh LIST FOLDER
#   LIST     what ctest wrote to Testing/Temporary/LastTestsFailed.log. Need not exist.
#   FOLDER   reports of GoogleTest, NAME.xml for the test NAME. Need not exist.
set -euo pipefail
list=$1 folder=$2
[ -e "$list" ] || exit 0
while IFS=: read -r _ name; do
    echo "$name"
    [ ! -e "$folder/$name.xml" ] || awk '
        /<testcase / { match($0, / name="[^"]*"/); test = substr($0, RSTART + 7, RLENGTH - 8)
                       match($0, / classname="[^"]*"/); suite = substr($0, RSTART + 12, RLENGTH - 13) }
        /<failure / && !(suite "." test in seen) { seen[suite "." test]; print "    " suite "." test }' \
        "$folder/$name.xml"
done <"$list"
