#!/usr/bin/env bash
# Runs one of the harnesses of tests/fuzz/harnesses, which the target `fuzzers` builds.
# Usage: tests/fuzz/run.sh HARNESS SECONDS [OPTION]...      options of libFuzzer
# What fails: an input that breaks a promise, invalid memory access, undefined behaviour, a leak, more than 5 s or 2 GiB
# for one input, or an allocation that no file of this size justifies.
set -euo pipefail
cd "$(dirname "$0")/../.."

harness=$1 seconds=$2
shift 2
corpora=("tests/fuzz/corpus/$harness")
dictionary=$harness longest=8192
# Cylinders start from lines. Compressed images are shorter: the largest that a file can hold is to stay below the limit of an allocation.
case "$harness" in
    cylinder) corpora=(tests/fuzz/corpus/line) ;;
    pbrt) corpora+=(tests/scene/corpus) ;;
    image) longest=2048 ;;
    texture) corpora=(tests/fuzz/corpus/image) dictionary=image longest=2048 ;;
    exr_metadata) dictionary=image ;;
esac
options=(-max_total_time="$seconds" -timeout=5 -rss_limit_mb=2048 -malloc_limit_mb=256 -max_len="$longest"
    -print_final_stats=1 -print_funcs=0)
if [ -f "tests/fuzz/dictionaries/$dictionary.dict" ]; then
    options+=(-dict="tests/fuzz/dictionaries/$dictionary.dict")
fi

# New inputs go to the first folder, the committed ones stay as they are.
found=build/fuzz/found/$harness
mkdir -p "$found" build/fuzz/findings
# Inputs pass through files, thousands per second.
if [ -w /dev/shm ]; then memory=/dev/shm; else memory=${TMPDIR:-/tmp}; fi
TMPDIR=$(mktemp -d "$memory/nusselt_fuzz_XXXXXX")
export TMPDIR
trap 'rm -rf "$TMPDIR"' EXIT
"build/sanitizers/tests/fuzz/harnesses/${harness}_fuzzer" "${options[@]}" "$@" \
    -artifact_prefix="build/fuzz/findings/$harness-" "$found" "${corpora[@]}"
