#!/usr/bin/env bash
# What a call from Python costs beside a loop in C++. Usage: overhead_test.sh PYTHON LIBRARY
# At full effort, the limit is that of docs/python.md, for all instruction sets of the processor. Between the other tests of
# the quick effort, caches and clocks are shared: its limit only notices what is much too slow.
set -euo pipefail
bench=$(cd "$(dirname "$0")/../.." && pwd)/python/bench/overhead.py
case "${NUSSELT_TEST_EFFORT:-quick}" in
    quick) "$1" "$bench" "$2" --limit 1.3 ;;
    full)
        "$1" "$bench" "$2" --limit 1.1
        for isa in sse42 avx2; do
            if NUSSELT_ISA=$isa "$1" -c "import nusselt; nusselt.instruction_set()" 2>/dev/null; then
                NUSSELT_ISA=$isa "$1" "$bench" "$2" --limit 1.1
            else
                echo "this processor does not have $isa"
            fi
        done ;;
    *) echo "NUSSELT_TEST_EFFORT must be quick or full" >&2; exit 2 ;;
esac
