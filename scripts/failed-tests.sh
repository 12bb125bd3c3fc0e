#!/usr/bin/env bash
# Prints the names of the tests that failed, a line each: those of ctest, and below a process those of GoogleTest in it.
# Usage: scripts/failed-tests.sh LIST REPORT FOLDER
#   LIST            what ctest wrote to Testing/Temporary/LastTestsFailed.log. Need not exist.
#   REPORT FOLDER   as for scripts/count-tests.sh
set -euo pipefail
list=$1 report=$2 folder=$3
names=()
[ ! -e "$list" ] || mapfile -t names < <(cut -d: -f2- "$list")
for name in ${names[@]+"${names[@]}"}; do
    echo "$name"
    [ ! -e "$folder/$name.xml" ] || awk '
        /<testcase / { match($0, / name="[^"]*"/); test = substr($0, RSTART + 7, RLENGTH - 8)
                       match($0, / classname="[^"]*"/); suite = substr($0, RSTART + 12, RLENGTH - 13) }
        /<failure / && !(suite "." test in seen) { seen[suite "." test]; print "    " suite "." test }' \
        "$folder/$name.xml"
done
[ -e "$folder/expected" ] || exit 0
# Processes that ended well, but ran no test.
while read -r name; do
    grep -qF "<testcase name=\"$name\"" "$report" || continue
    [[ " ${names[*]-} " != *" $name "* ]] || continue
    grep -q '<testcase ' "$folder/$name.xml" 2>/dev/null || echo "$name (without a report)"
done <"$folder/expected"
