#!/usr/bin/env bash
# Looks for lights that break techniques: each libFuzzer harness for the given time, then COUNT hostile
# configurations per technique in float and double, with a new seed.
# Usage: scripts/fuzz.sh [SECONDS [COUNT]]   (default: 600 s, 1e8)
set -euo pipefail
cd "$(dirname "$0")/.."

seconds=${1:-600} count=${2:-100000000}
seed=$(date +%s)
folder=build/release/tests/fuzz
status=0

cmake --preset release -DNUSSELT_BUILD_TESTS=ON >/dev/null
cmake --build --preset release --target nusselt_app
cmake --build --preset release --target fuzzers

for harness in polygon line clip; do
    echo "== libFuzzer: $harness, $seconds s"
    "$folder/${harness}_fuzzer" -max_total_time="$seconds" -timeout=10 -artifact_prefix="$folder/$harness-" \
        "$folder/found/$harness" "tests/fuzz/corpus/$harness" || status=1
done
for scalar in float double; do
    echo "== hostile lights: $scalar, seed $seed"
    build/release/apps/nusselt/nusselt bench fuzz --scalar "$scalar" --seed "$seed" --count "$count" || status=1
done
exit $status
