#!/usr/bin/env bash
# A pass compiles with the table of kinds of light in shaders/passes/lights.glsl, and does not without one of its rows.
# Usage: check_light_rows.sh GLSLANG_VALIDATOR WORK_FOLDER
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
glslang=$1 work=$2

compile() {
    "$glslang" --quiet --target-env vulkan1.1 -I"$work" -DTEXTURE_IMAGES=0 -DLIGHT_VERTICES=4 \
        -DEMISSION_CELLS=0 -DLINE_CELLS=0 -DROUND_LIGHTS=1 -DNUSSELT_UNROLL= -DNUSSELT_MAX_VERTICES=5 -o "$work/pass.spv" "$work/passes/integrate_lights.comp" \
        >"$work/log" 2>&1
}

rm -rf "$work"
mkdir -p "$work"
cp -r "$root/shaders/." "$work"
table=$work/passes/lights.glsl
compile || { cat "$work/log"; exit 1; }
kinds=$(sed -n 's/^ *ROW(\(k[A-Za-z]*Kind\),.*/\1/p' "$table")
[ "$(wc -w <<<"$kinds")" -ge 2 ] || { echo "$table: no rows found"; exit 1; }
for kind in $kinds; do
    # The line before the last row continues it, so that a row is emptied, not removed.
    sed -i.bak "s/ROW($kind,[^)]*)//" "$table"
    if compile; then
        echo "a pass compiles without the row of $kind"
        exit 1
    fi
    grep -q "array size must be a positive integer" "$work/log" || { cat "$work/log"; exit 1; }
    mv "$table.bak" "$table"
done
