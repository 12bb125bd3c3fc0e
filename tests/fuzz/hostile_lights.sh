#!/usr/bin/env bash
# All techniques on random hostile lights, as many as the effort of the tests asks for.
# Usage: tests/fuzz/hostile_lights.sh NUSSELT_LAB
set -euo pipefail
case "${NUSSELT_TEST_EFFORT:-quick}" in
    quick) count=2000000 ;;
    full) count=10000000 ;;
    *) echo "NUSSELT_TEST_EFFORT must be quick or full" >&2; exit 2 ;;
esac
"$1" fuzz --count "$count"
