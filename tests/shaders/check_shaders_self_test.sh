#!/usr/bin/env bash
# check_shaders.sh accepts a good folder and finds each kind of mistake that it is for.
# Usage: check_shaders_self_test.sh GLSLANG_VALIDATOR WORK_FOLDER
set -euo pipefail
check=$(cd "$(dirname "$0")" && pwd)/check_shaders.sh
glslang=$1 work=$2
failed=0

# Writes a folder with a file `base` and one named $1 that holds the text on standard input.
folder() {
    rm -rf "$work/shaders"
    mkdir -p "$work/shaders/core"
    printf '%s\n' '#ifndef BASE' '#define BASE' 'precision highp float;' 'float twice(float x) { return 2.0 * x; }' '#endif' \
        >"$work/shaders/core/base.glsl"
    printf '%s\n' '#ifndef FILE' '#define FILE' >"$work/shaders/core/$1"
    cat >>"$work/shaders/core/$1"
    echo '#endif' >>"$work/shaders/core/$1"
}
passes() { "$check" "$glslang" "$work/shaders" "$work/compile" >"$work/report" 2>&1; }
expect_failure() {
    ! passes || { echo "not found: $1"; failed=1; }
}

folder file.glsl <<<'#include "../core/base.glsl"
float four(float x) { return twice(twice(x)); }'
passes || { echo "a good folder fails:"; cat "$work/report"; failed=1; }
truncate -s -1 "$work/shaders/core/file.glsl"
passes || { echo "a file without a final newline fails:"; cat "$work/report"; failed=1; }
mkdir -p "$work/shaders/other"
cp "$work/shaders/core/file.glsl" "$work/shaders/other"
expect_failure "two files of one name"

folder file.glsl <<<'precision highp float;
float four(float x) { return twice(twice(x)); }'
expect_failure "a missing include"
folder file.glsl <<<'#include "../core/base.glsl"
float integer(float x) { return 2 * x; }'
expect_failure "what GLSL ES lacks"
folder file.glsl <<<'float half_of(float x) { return 0.5 * x; }'
expect_failure "no precision in GLSL ES"
folder file.glsl <<<'#include "../core/missing.glsl"'
expect_failure "an include without a file"
folder file.glsl </dev/null
printf '%s\n' 'precision highp float;' 'float twice(float x) { return 2.0 * x; }' >"$work/shaders/core/base.glsl"
expect_failure "a missing include guard"
folder file.glsl <<<'#if NUSSELT_MAX_VERTICES == 7
error
#endif'
expect_failure "an error for one capacity"
folder file.glsl <<<'#if NUSSELT_FUSED_FMA
#define HALF 0.5
#endif'
expect_failure "a preprocessor that decides on a fused fma"
exit $failed
