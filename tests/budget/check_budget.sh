#!/usr/bin/env bash
# Compares the CPU time of stages with their budgets. Warns about a stage above its budget, and fails if one takes more
# than 1.5 times its budget or has none. What remains of the noise of shared machines is below that.
# Usage: tests/budget/check_budget.sh BUDGETS < TIMES     lines of both: STAGE SECONDS, where the stage may contain spaces
set -euo pipefail
awk '
    function stage_of(line) { sub(/ +[0-9.]+$/, "", line); return line }
    /^#/ || NF == 0 { next }
    FILENAME != "-" { budget[stage_of($0)] = $NF; next }
    {
        stage = stage_of($0)
        if (!(stage in budget)) {
            printf "%s: has no budget in tests/budget/budget.txt\n", stage
            failed = 1
        } else if ($NF > 1.5 * budget[stage]) {
            printf "%s: %d s of CPU time on the usual machine, more than 1.5 times the budget of %d s\n", stage, $NF, budget[stage]
            failed = 1
        } else if ($NF > budget[stage]) {
            printf "warning: %s: %d s of CPU time on the usual machine, above the budget of %d s\n", stage, $NF, budget[stage]
        }
    }
    END { exit failed }' "$1" -
