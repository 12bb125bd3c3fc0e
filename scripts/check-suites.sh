#!/usr/bin/env bash
# Fails unless each technique of the registry is in each suite of tests, or exempt for a reason.
# Usage: scripts/check-suites.sh BUILD_FOLDER UNIT_TESTS STATISTICS_TESTS PARITY_TESTS NUSSELT_LAB
set -euo pipefail
cd "$(dirname "$0")/.."
build=$1 unit=$2 statistics=$3 parity=$4 lab=$5
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

"$unit" --gtest_list_tests >"$folder/unit"
"$statistics" --gtest_list_tests >"$folder/statistics"
"$parity" --gtest_list_tests >"$folder/parity"
"$lab" fuzz --count 1 >"$folder/fuzz"
"$lab" bench samplers --isa sse42 --repetitions 1 --json - >"$folder/timing"
python3 scripts/check-techniques.py suites \
    contract="$folder/unit" inversion="$folder/unit" density="$folder/unit" packs="$folder/unit" \
    statistics="$folder/statistics" parity="$folder/parity" fuzz="$folder/fuzz" timing="$folder/timing" \
    accuracy=docs/data/accuracy.json gpu_timing="$build/lab/shaders/gpu_samplers_table.h" \
    cuda="$build/tests/compile/cuda_techniques.cu"
