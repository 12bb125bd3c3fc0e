#!/usr/bin/env bash
# Shows that scripts/check-twins.py accepts shaders that follow their headers and finds each kind of offence.
set -euo pipefail
check=$(cd "$(dirname "$0")/../../scripts" && pwd)/check-twins.py
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir -p "$tree/include/nusselt/core" "$tree/shaders/nusselt/core"
header=$tree/include/nusselt/core/sine.h
shader=$tree/shaders/nusselt/core/sine.glsl

# Writes a good header and a good shader.
reset() {
    printf '%s\n' '/// A sine.' 'template <class T>' 'T sine(T x) { return T(-1.66666e-1f) * x; } // cubic' >"$header"
    printf '%s\n' '// Follows include/nusselt/core/sine.h @ 0' 'float sine(float x) { return -1.66666e-1 * x; }' >"$shader"
    "$check" --root "$tree" --update shaders/nusselt/core/sine.glsl
}

# Expects that the check succeeds or fails ($1) and, for a failure, prints $2.
expect() {
    local result
    if "$check" --root "$tree" >"$tree/log" 2>&1; then result=passes; else result=fails; fi
    if [ "$result" != "$1" ] || ! grep -q -- "${2:-^}" <(echo; cat "$tree/log"); then
        echo "$result, expected: $1 '${2:-}'"
        cat "$tree/log" "$header" "$shader"
        exit 1
    fi
}

reset
expect passes
# Comments and white space are free.
printf '%s\n' '/// The sine of an angle.' 'template <class T>  T sine(T x)' '{ return T(-1.66666e-1f) * /* odd */ x; }' >"$header"
expect passes
sed -i 's/\* x;/* x * x;/' "$shader"
expect passes
reset
sed -i 's/sine(T x)/sine(T y)/' "$header"
expect fails '--update shaders/nusselt/core/sine.glsl'
reset
printf '%s\n' 'const char* a = "// x";' >>"$header"
"$check" --root "$tree" --update shaders/nusselt/core/sine.glsl
sed -i 's|// x|// y|' "$header"
expect fails 'has changed'
reset
sed -i 1d "$shader"
expect fails 'must have either'
sed -i '1i // Follows no header: the built-in function' "$shader"
expect passes
sed -i '1i // Follows include/nusselt/core/sine.h @ 0' "$shader"
expect fails 'must have either'
reset
sed -i 's|core/sine.h|core/cosine.h|' "$shader"
expect fails 'does not exist'
reset
sed -i 's/66666e-1 /66667e-1 /' "$shader"
expect fails '0.166666'
reset
sed -i 's/return -/return /' "$shader"
expect fails '0.166666'
reset
printf '%s\n' 'float again(float x) { return -1.66666e-1 * x; }' >>"$shader"
expect fails 'appears here 1 times'
reset
sed -i 's/1.66666e-1f/1.66667e-1f/' "$header"
"$check" --root "$tree" --update shaders/nusselt/core/sine.glsl >/dev/null && exit 1
expect fails '0.16666[67]'
rm "$shader"
expect fails 'no shaders'
