#!/usr/bin/env bash
# Each file of a folder of shaders compiles alone and included twice, as GLSL 4.50 for Vulkan and, flattened, as GLSL
# 4.50 and GLSL ES 3.00, for several capacities of polygons where they matter; so does the example in README.md. Leaves the shaders in GLSL ES in
# the subfolder es, for tests/browser.
# Usage: check_shaders.sh GLSLANG_VALIDATOR SHADERS WORK_FOLDER
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
glslang=$1 shaders=$2 work=$3
failed=0

# Compiles the shader $1; $2 says what it is, the rest are options. Warnings count as failures.
compile() {
    local shader=$1 what=$2
    shift 2
    # Functions that nobody calls are compiled too.
    if ! "$glslang" --keep-uncalled "$@" "$shader" >"$work/log" 2>&1 || grep -q "^WARNING" "$work/log"; then
        echo "$what:"
        cat "$work/log"
        failed=1
    fi
}

rm -rf "$work"
mkdir -p "$work/es"
cmake -D SHADERS="$shaders" -D OUTPUT="$work/flat" -P "$root/scripts/flatten-glsl.cmake"
files=$(cd "$shaders" && find . -name '*.glsl' -printf '%P\n' | sort)
[ -n "$files" ] || { echo "no shaders in $shaders"; exit 1; }
# To the preprocessor, the name of a specialisation constant is 0.
if grep -rnE '^#\s*(el)?if.*NUSSELT_FUSED_FMA' --exclude=compatibility.glsl "$shaders"; then
    echo "branches on NUSSELT_FUSED_FMA use kNusseltFusedFma instead of the preprocessor"
    failed=1
fi
defaults=$(grep -hs NUSSELT_MAX_VERTICES "$shaders/core/compatibility.glsl" || true)
for file in $files; do
    flat=$work/flat/$(basename "$file")
    # A flattened file has all that it includes, so it tells whether the capacity matters beyond its default.
    bounds=(4)
    if grep NUSSELT_MAX_VERTICES "$flat" | grep -qvxF "$defaults"; then bounds=(3 4 7); fi
    # What programs have to define.
    program=$(sed -n -e 's/^\(uint [a-z_]*_word(uint at)\);$/\1 { return at; }/p' \
        -e 's/^\(vec3 environment_map_texel(uint map, ivec2 at)\);$/\1 { return vec3(vec2(at), float(map)); }/p' "$flat")
    for vertices in "${bounds[@]}"; do
        printf '%s\n' '#version 450' '#extension GL_GOOGLE_include_directive : require' \
            'layout(constant_id = 0) const bool fused = false;' '#define NUSSELT_FUSED_FMA fused' \
            "#define NUSSELT_MAX_VERTICES $vertices" "#include \"$file\"" "#include \"$file\"" "$program" \
            'void main() {}' >"$work/source.comp"
        compile "$work/source.comp" "$file, $vertices vertices" -V -I"$shaders" -o "$work/source.spv"
        {
            printf '%s\n' '#version 450' "#define NUSSELT_MAX_VERTICES $vertices"
            cat "$flat"
            printf '%s\n' "$program" 'void main() {}'
        } >"$work/flat.comp"
        compile "$work/flat.comp" "$file flattened, $vertices vertices" -V -o "$work/flat.spv"
        {
            printf '%s\n' '#version 300 es' "#define NUSSELT_MAX_VERTICES $vertices"
            cat "$flat"
            printf '%s\n' "$program" 'void main() {}'
        } >"$work/es/$(basename "$file" .glsl)-$vertices.frag"
        compile "$work/es/$(basename "$file" .glsl)-$vertices.frag" "$file as GLSL ES, $vertices vertices"
    done
done
if [ -e "$shaders/README.md" ]; then
    sed -n '/^#version/,/^```/p' "$shaders/README.md" | sed '$d' >"$work/example.frag"
    [ -s "$work/example.frag" ] || { echo "README.md: no example"; exit 1; }
    compile "$work/example.frag" "the example of README.md" -V -I"$shaders" -o "$work/example.spv"
fi
exit $failed
