#!/usr/bin/env bash
# Looks for lights that break techniques and for files that break readers: each libFuzzer harness for the given time,
# then COUNT hostile configurations per technique in float and double, with a new seed. COUNT 0 leaves these out.
# Usage: scripts/fuzz.sh [SECONDS [COUNT [HARNESS...]]]   (default: 600 s, 1e8, all harnesses)
set -euo pipefail
cd "$(dirname "$0")/.."

seconds=${1:-600} count=${2:-100000000}
harnesses=("${@:3}")
seed=$(date +%s)
status=0

cmake --preset release -DNUSSELT_BUILD_TESTS=ON >/dev/null
cmake --build --preset release --target fuzzers
if [ ${#harnesses[@]} -eq 0 ]; then
    programs=(build/sanitizers/tests/fuzz/harnesses/*_fuzzer)
    programs=("${programs[@]##*/}")
    harnesses=("${programs[@]%_fuzzer}")
fi

for harness in "${harnesses[@]}"; do
    echo "== libFuzzer: $harness, $seconds s"
    tests/fuzz/run.sh "$harness" "$seconds" || status=1
done
[ "$count" -gt 0 ] || exit $status

cmake --build --preset release --target nusselt_lab_app
for scalar in float double; do
    echo "== hostile lights: $scalar, seed $seed"
    build/release/apps/nusselt-lab/nusselt-lab fuzz --scalar "$scalar" --seed "$seed" --count "$count" || status=1
done
exit $status
