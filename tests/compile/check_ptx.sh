#!/usr/bin/env bash
# Fails unless the PTX has one entry per __global__ of the source and calls nothing that it does not define.
# Usage: check_ptx.sh PTX SOURCE
set -euo pipefail
expected=$(grep -c '__global__' "$2")
entries=$(grep -c '^\.visible \.entry' "$1") || true
if [ "$entries" -ne "$expected" ] || [ "$expected" -eq 0 ]; then
    echo "$1: $entries kernels, the source has $expected"
    exit 1
fi
if grep -E '^\.extern' "$1"; then
    echo "$1: needs these functions from outside"
    exit 1
fi
