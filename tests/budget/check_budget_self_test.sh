#!/usr/bin/env bash
# Shows that check_budget.sh accepts stages within their budgets, warns above them, and rejects what is far above.
set -euo pipefail
cd "$(dirname "$0")"
budgets=$(mktemp)
trap 'rm -f "$budgets"' EXIT
printf '# seconds\nrelease: build  100\nrelease: tests   50\n' >"$budgets"

# Fails unless the times $1 give the exit status $2 and the text $3.
expect() {
    local status=0 text
    text=$(printf "$1" | ./check_budget.sh "$budgets") || status=$?
    if [ "$status" -ne "$2" ] || [ "$text" != "$3" ]; then
        echo "times: $1 status: $status text: $text"
        exit 1
    fi
}

expect 'release: build 99.5\nrelease: tests 50\n' 0 ''
expect 'release: build 150\n' 0 'warning: release: build: 150 s of CPU time on the usual machine, above the budget of 100 s'
expect 'release: tests 76\n' 1 'release: tests: 76 s of CPU time on the usual machine, more than 1.5 times the budget of 50 s'
expect 'release: lint 1\n' 1 'release: lint: has no budget in tests/budget/budget.txt'
./check_budget.sh budget.txt </dev/null

speed=$(./machine_speed.sh)
awk -v speed="$speed" 'BEGIN { exit !(speed >= 0.2 && speed <= 20) }' || { echo "machine_speed.sh: $speed"; exit 1; }
