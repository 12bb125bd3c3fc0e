#!/usr/bin/env bash
# Prints how many times as much CPU time the machine takes at present as the machine of the budgets: other processors,
# and neighbours that share cores and caches, change the CPU time of the same work by a factor of two.
# The unit is the time to compile speed_probe.cpp with g++ 12, in one process per core at once.
set -euo pipefail
cd "$(dirname "$0")"
unit=3.2 # CPU time on the machine of the budgets [s]

compile_on_all_cores() {
    local i processes=()
    for ((i = 0; i < $(nproc); ++i)); do
        "${CXX:-c++}" -std=c++20 -O2 -c -o /dev/null speed_probe.cpp 2>&3 &
        processes+=($!)
    done
    for i in "${processes[@]}"; do wait "$i"; done
}

exec 3>&2
TIMEFORMAT='%U %S' # user and system time of all processes
seconds=$({ time compile_on_all_cores; } 2>&1)
awk -v unit="$unit" -v processes="$(nproc)" '{ printf "%.2f\n", ($1 + $2) / processes / unit }' <<<"$seconds"
