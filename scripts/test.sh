#!/usr/bin/env bash
# Builds and runs tests, stage by stage; docs/testing.md lists what each stage proves.
# Usage: scripts/test.sh [check|all|full]    (check: the library, for this processor; full: also the tests of portability)
# NUSSELT_TEST_EFFORT is the effort of the tests, quick (the default) or full.
# The last line sums up: `N passed, N failed`, with `, N skipped` where tests were skipped. The lines before it name what failed.
# With CI=true in the environment compiler warnings are errors.
set -uo pipefail
cd "$(dirname "$0")/.."
export CCACHE_BASEDIR=$PWD # clones share what ccache keeps

if [ "${CI:-}" = true ]; then warnings_as_errors=ON; else warnings_as_errors=OFF; fi
case "${1:-all}" in
    check | all) portability=OFF ;;
    full) portability=ON ;;
    *) echo "usage: scripts/test.sh [check|all|full]" >&2; exit 2 ;;
esac
jobs=$(nproc)
results=build/test-results
rm -rf "$results"
mkdir -p "$results"
passed=0 failed=0 skipped=0
times=()

# The CPU time of the commands that have ended, from the output of the builtin `times` in a file [s].
cpu_seconds() {
    awk 'NR == 2 { split($1, user, /[ms]/); split($2, kernel, /[ms]/)
                   print 60 * (user[1] + kernel[1]) + user[2] + kernel[2] }' "$1"
}

# Runs a command as a stage and records its time, and what that is on the machine of the budgets.
stage() {
    local name=$1 start status=0 cpu speed
    shift
    echo "== $name"
    speed=$(tests/budget/machine_speed.sh) || return 1
    start=$SECONDS
    times >"$results/times"
    cpu=$(cpu_seconds "$results/times")
    "$@" || status=$?
    times >"$results/times"
    cpu=$(awk -v before="$cpu" -v after="$(cpu_seconds "$results/times")" 'BEGIN { print after - before }')
    times+=("$(printf '%5d s, %5.0f s of CPU time  %s (the machine took %s times its usual CPU time)' \
        $((SECONDS - start)) "$cpu" "$name" "$speed")")
    awk -v name="$name" -v cpu="$cpu" -v speed="$speed" 'BEGIN { print name, cpu / speed }' >>"$results/cpu-times"
    return $status
}

# Builds a preset. $2: whether warnings are errors; others: options of cmake.
build() {
    cmake --preset "$1" "${@:3}" -DNUSSELT_BUILD_TESTS=ON -DNUSSELT_TEST_PORTABILITY="$portability" \
        -DNUSSELT_WARNINGS_AS_ERRORS="$2" >"$results/$1-configure.log" 2>&1 ||
        { cat "$results/$1-configure.log"; return 1; }
    cmake --build --preset "$1" && is_up_to_date "$1"
}

# Whether a second build does nothing.
is_up_to_date() {
    local work
    work=$(cmake --build --preset "$1")
    [[ $work == *"no work to do"* ]] || { echo "parts of the build are never up to date:"; head -5 <<<"$work"; return 1; }
}

# Lines of passed tests are left out: there are thousands.
run_tests() {
    rm -f "build/$1/test-reports/"*.xml "build/$1/Testing/Temporary/LastTestsFailed.log"
    ctest --preset "$1" -j "$jobs" --output-junit "$2" | grep -vE '^ *Start +[0-9]+:|Passed +[0-9.]+ sec *$'
}

# Counts something that is not a test as a failed one. $1: its name
add_failure() {
    failed=$((failed + 1))
    echo "$1" >>"$results/failed"
}

# Builds a preset with the arguments of build(), runs its tests and adds up the results.
build_and_test() {
    local preset=$1 report=$PWD/$results/$1.xml
    if ! stage "$preset: build" build "$@"; then
        add_failure "$preset: build"
        return
    fi
    local all bad ignored status=0
    stage "$preset: tests" run_tests "$preset" "$report" || status=$?
    read -r all bad ignored < <(scripts/count-tests.sh "$report" "build/$preset/test-reports" "$status")
    if [ "${all:-0}" -eq 0 ]; then
        add_failure "$preset: no test ran"
        return
    fi
    scripts/failed-tests.sh "build/$preset/Testing/Temporary/LastTestsFailed.log" "$report" \
        "build/$preset/test-reports" >>"$results/failed"
    passed=$((passed + all - bad - ignored)) failed=$((failed + bad)) skipped=$((skipped + ignored))
}

if [ "${1:-all}" = check ]; then
    build_and_test check "$warnings_as_errors"
else
    build_and_test release "$warnings_as_errors"
    # The tests of fuzzing have built the modules with this compiler already. The release build checks warnings.
    build_and_test sanitizers OFF "-DCMAKE_CXX_COMPILER=$(sed -n 's/^CLANG_CXX:.*=//p' build/release/CMakeCache.txt)"
fi

echo "== times"
printf '%s\n' "${times[@]}"
# A stage that is far above its budget counts as a failed test. The full effort has none.
if [ "${NUSSELT_TEST_EFFORT:-quick}" = quick ] && [ "$portability" = OFF ]; then
    tests/budget/check_budget.sh tests/budget/budget.txt <"$results/cpu-times" || add_failure "the budget of a stage"
fi
# The output of tests is long, and the end of it is what people see first.
[ ! -s "$results/failed" ] || sed '1i == failed tests' "$results/failed"
summary="$passed passed, $failed failed"
[ "$skipped" -eq 0 ] || summary+=", $skipped skipped"
echo "$summary" | tee "$results/summary"
[ "$failed" -eq 0 ]
