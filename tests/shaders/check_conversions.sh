#!/usr/bin/env bash
# The GLSL of each technique becomes HLSL and Metal Shading Language with the functions of the technique, and glslang compiles
# the HLSL, of all techniques at full effort and of a few otherwise. No compiler for Metal runs on Debian.
# Usage: check_conversions.sh GLSLANG_VALIDATOR LIST WORK_FOLDER
# Ends with 77 where spirv-cross is missing; with CI=true in the environment, that is a failure.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
glslang=$1 list=$2 work=$3
failed=0
if ! command -v spirv-cross >/dev/null; then
    echo "spirv-cross is missing"
    [ "${CI:-}" != true ] || exit 1
    exit 77
fi

compiles() { "$glslang" -D -V -e main -S comp --quiet -o "$work/hlsl.spv" "$1" >"$work/log" 2>&1; }

rm -rf "$work"
cmake -D LIST="$list" -D OUTPUT="$work" -P "$root/scripts/convert-shaders.cmake"
# Techniques of the library, with the functions that techniques.json says they have: technique, function.
functions=$(PYTHONPATH=$root/scripts PYTHONDONTWRITEBYTECODE=1 python3 -c '
import importlib, pathlib, sys
techniques = importlib.import_module("check-techniques")
for row in techniques.rows_of(pathlib.Path(sys.argv[1])):
    if row["header"].startswith("related/") or "parity" in techniques.exemptions(row):
        continue
    glsl = row["glsl"]
    prefix = glsl.get("functions", glsl["file"].split("/")[-1])
    queries = glsl.get("queries", prefix)
    for function in (glsl.get("prepare", prefix + "_prepare"), prefix + "_sample",
                     *(f"{queries}_{query}" for query in ("pdf", "invert", "measure"))):
        print(techniques.snake_case(row["name"]), function)' "$root")
while read -r name function; do
    for file in "$work/hlsl/$name.hlsl" "$work/msl/$name.metal"; do
        grep -qE "^[a-zA-Z0-9]+ $function\(" "$file" || { echo "$file: no function $function"; failed=1; }
    done
done <<<"$functions"

compiled=(polygon_projected_solid_angle line_ltc cylinder_solid_angle)
if [ "${NUSSELT_TEST_EFFORT:-quick}" = full ]; then
    compiled=("$work"/hlsl/*.hlsl)
    compiled=("${compiled[@]##*/}")
    compiled=("${compiled[@]%.hlsl}")
fi
for name in "${compiled[@]}"; do
    compiles "$work/hlsl/$name.hlsl" || { echo "$name.hlsl:"; cat "$work/log"; failed=1; }
done
sed 's/nusselt_max(/unknown_max(/' "$work/hlsl/line_ltc.hlsl" | sed '0,/unknown_max(/s//nusselt_max(/' >"$work/wrong.hlsl"
! compiles "$work/wrong.hlsl" || { echo "HLSL that calls what is not there compiles"; failed=1; }
exit $failed
