#!/usr/bin/env bash
# Fails unless each technique of the registry is in each suite of tests, or exempt for a reason.
# Usage: scripts/check-suites.sh BUILD_FOLDER SCALAR_TESTS PACK_TESTS STATISTICS_TESTS PARITY_TESTS NUSSELT_LAB
set -euo pipefail
cd "$(dirname "$0")/.."
build=$1 scalars=$2 packs=$3 statistics=$4 parity=$5 lab=$6
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

"$scalars" --gtest_list_tests >"$folder/scalars"
"$packs" --gtest_list_tests >"$folder/packs"
"$statistics" --gtest_list_tests >"$folder/statistics"
"$parity" --gtest_list_tests >"$folder/parity"
"$lab" fuzz --count 1 >"$folder/fuzz"
"$lab" bench samplers --isa sse42 --repetitions 1 --json - >"$folder/timing"
python3 scripts/check-techniques.py suites \
    contract="$folder/packs" packs="$folder/packs" inversion="$folder/scalars" density="$folder/scalars" \
    statistics="$folder/statistics" parity="$folder/parity" fuzz="$folder/fuzz" timing="$folder/timing" \
    accuracy=docs/data/accuracy.json gpu_timing="$build/lab/shaders/gpu_samplers_table.h" \
    cuda="$build/tests/compile/cuda_techniques.cu" wasm="$build/wasm/typescript/techniques.ts" page=web/library/techniques.ts
