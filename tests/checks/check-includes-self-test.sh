#!/usr/bin/env bash
# Shows that scripts/check-includes.sh accepts each allowed kind of #include and finds each wrong kind.
set -euo pipefail
check=$(cd "$(dirname "$0")/../../scripts" && pwd)/check-includes.sh
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT

# Whether the check passes on a tree whose only source file is $1 with the line `#include $2`, or an import of $2.
passes() {
    rm -rf "${tree:?}"/*
    mkdir -p "$tree"/{include,src,proof,lab,apps,wasm,python,web,shaders} "$tree/$(dirname "$1")"
    case "$1" in
    *.ts) printf '/// Comment.\nimport { a } from %s;\n' "$2" >"$tree/$1" ;;
    *) printf '#pragma once\n#include %s\n' "$2" >"$tree/$1" ;;
    esac
    "$check" "$tree" >"$tree/report"
}

failed=0
while read -r verdict file include; do
    if passes "$file" "$include"; then found=right; else found=wrong; fi
    [ "$found" = wrong ] && ! grep -q "^$file:2: " "$tree/report" && found="wrong, without file and line"
    [ "$found" = "$verdict" ] && continue
    echo "$file with #include $include: expected $verdict, found $found"
    failed=1
done <<'CASES'
right include/nusselt/core/a.h <cmath>
right include/nusselt/sampling/a.h <nusselt/core/vec.h>
right include/nusselt/sampling/a.h <nusselt/sampling/b.h>
right include/nusselt/estimate/a.h <nusselt/related/b.h>
right include/nusselt/simd/a.h <immintrin.h>
right include/nusselt/simd/b.h <arm_neon.h>
right include/nusselt/simd/c.h <wasm_simd128.h>
right python/bindings/a.cpp "render/backend.h"
wrong python/bindings/a.cpp "lab/report/report.h"
right wasm/a.h "wasm/b.h"
right wasm/a.h <nusselt/core/vec.h>
wrong wasm/a.h "base/a.h"
wrong src/base/a.h "wasm/a.h"
right include/nusselt/nusselt.h <nusselt/sampling/b.h>
right src/visibility/a.cpp "scene/model/b.h"
right src/scene/build/polygons/a.cpp "scene/build/b.h"
right src/scene/import/a.cpp "scene/import/pbrt/b.h"
right src/scene/import/pbrt/syntax/a.cpp "scene/build/textures/b.h"
right lab/figures/a.cpp "scene/import/b.h"
right src/render_cpu/a.cpp <nusselt/simd/pack.h>
right src/render_cpu/a.cpp <embree3/rtcore.h>
right src/gpu/a.cpp "shaders/b.h"
right lab/timing/a.cpp "gpu/b.h"
right lab/timing/a.cpp "proof/hostile/b.h"
right apps/nusselt-lab/bench/a.cpp "lab/timing/b.h"
right apps/nusselt/render/a.cpp "apps/common/b.h"
wrong apps/nusselt/render/a.cpp "lab/timing/b.h"
wrong apps/nusselt/render/a.cpp "proof/b.h"
wrong apps/nusselt/render/a.cpp "apps/nusselt-lab/bench/b.h"
wrong proof/a.h "lab/timing/b.h"
wrong src/render_cpu/a.cpp "proof/b.h"
wrong src/gpu/a.cpp "render_cpu/b.h"
wrong src/render_cpu/a.cpp "gpu/b.h"
right apps/nusselt/a.cpp "commands.h"
right shaders/nusselt/geometry/a.glsl "../core/b.glsl"
right shaders/nusselt/geometry/a.glsl "../geometry/b.glsl"
right shaders/parity/functions/a.comp "nusselt/core/b.glsl"
right shaders/parity/a.glsl "parity/b.glsl"
right shaders/bench/a.glsl "interface/b.glsl"
wrong shaders/nusselt/core/a.glsl "../geometry/b.glsl"
wrong shaders/nusselt/core/a.glsl "../../parity/b.glsl"
wrong shaders/nusselt/core/a.glsl "parity/b.glsl"
wrong shaders/nusselt/core/a.glsl <nusselt/core/b.glsl>
wrong shaders/bench/a.glsl "parity/b.glsl"
wrong shaders/parity/a.glsl "b.glsl"
wrong shaders/unheard_of/a.glsl "nusselt/core/b.glsl"
wrong src/gpu/a.cpp "nusselt/core/b.glsl"
wrong include/nusselt/core/a.h <nusselt/geometry/b.h>
wrong include/nusselt/core/a.h <nusselt/nusselt.h>
wrong include/nusselt/geometry/a.h <nusselt/simd/pack.h>
wrong include/nusselt/sampling/a.h <nusselt/related/b.h>
wrong include/nusselt/sampling/a.h <nusselt/estimate/b.h>
wrong include/nusselt/nusselt.h <nusselt/simd/pack.h>
wrong include/nusselt/core/a.h <nusselt/unheard_of/b.h>
wrong include/nusselt/core/a.h "vec.h"
wrong include/nusselt/core/a.h "scene/model/scene.h"
wrong include/nusselt/core/a.h <immintrin.h>
wrong include/nusselt/core/a.h <fmt/core.h>
wrong include/nusselt/core/a.h "../geometry/b.h"
wrong src/image/a.cpp "scene/model/scene.h"
wrong src/scene/model/a.cpp "visibility/b.h"
wrong src/scene/model/a.cpp "scene/build/b.h"
wrong src/scene/build/polygons/a.cpp "scene/import/pbrt/b.h"
wrong src/scene/rig/a.cpp "scene/import/b.h"
wrong src/scene/import/pbrt/a.cpp "scene/import/b.h"
wrong src/scene/import/ply/a.cpp "scene/import/pbrt/b.h"
wrong src/scene/unheard_of/a.cpp "scene/model/b.h"
wrong src/visibility/a.cpp "scene/build/b.h"
wrong src/render/a.cpp "scene/import/b.h"
wrong src/visibility/a.cpp "render_cpu/b.h"
wrong src/render_cpu/a.cpp "lab/timing/b.h"
wrong src/render_cpu/a.cpp "local.h"
wrong src/render_cpu/a.cpp "nusselt/core/vec.h"
wrong lab/timing/a.cpp "apps/nusselt/b.h"
wrong src/scene/model/a.cpp "tests/b.h"
right web/page/a.ts "../library/b"
right web/page/a.ts "../scenes.json"
right web/library/a.ts "./b"
right web/three/example/a.ts "../../library/b"
right web/three/example/a.ts "../b"
right web/three/a.ts "../../data/b.bin"
wrong web/library/a.ts "../page/b"
wrong web/page/a.ts "../three/b"
wrong web/page/a.ts "../../lab/b"
wrong web/three/example/a.ts "../../page/b"
CASES
exit $failed
