#!/usr/bin/env bash
# Fails where an #include runs against the arrows of the design: a layer includes only itself, what the table
# below allows, and system headers; the library includes only the standard library and itself. Folders of
# shaders/nusselt obey the arrows of the same folders of include/nusselt, and scripts of web/ those of its folders.
# Usage: scripts/check-includes.sh [ROOT]
set -euo pipefail
cd "${1:-$(dirname "$0")/..}"

find include src proof lab apps wasm python shaders -name '*.h' -o -name '*.cpp' -o -name '*.glsl' -o -name '*.comp' -o -name '*.vert' -o -name '*.frag' | LC_ALL=C sort | xargs awk '
BEGIN {
    # Layer, then the layers that it may include besides itself. "library" is all of include/nusselt.
    # Templates see packs through the operations that core names. Only scalar code that takes vertices as lanes names them.
    allow("include/core", "")
    allow("include/simd", "include/core")
    allow("include/geometry", "include/core")
    below = "include/core include/geometry"
    allow("include/random", below)
    allow("include/bsdf", below)
    allow("include/ltc", below)
    below = below " include/random include/bsdf include/ltc"
    allow("include/sampling", below " include/simd")
    allow("include/cones", below " include/sampling include/simd")
    allow("include/line_samples", below " include/sampling")
    allow("include/related", below " include/sampling include/line_samples include/cones")
    below = below " include/sampling include/line_samples include/cones include/related"
    allow("include/emission", "include/core include/geometry include/ltc include/sampling include/simd")
    allow("include/line_emission", "include/core include/emission include/geometry include/ltc include/sampling")
    below = below " include/emission include/line_emission"
    allow("include/estimate", below)
    allow("include/all", below " include/estimate")

    # Proofs are right above the library; tests, fuzzers and the laboratory share them. They check shadows in the form that
    # src/visibility stores (stored_shadows.h).
    allow("proof", "library src/visibility")
    # The library for JavaScript.
    allow("wasm", "library")
    allow("src/base", "")
    allow("src/image", "library src/base")
    # The scene: renderers see its model, which does not depend on formats. Importers describe the content of a file, the
    # builder makes the model from it, rigs change it.
    allow("src/scene/input", "src/base")
    allow("src/scene/model", "library src/base src/scene/input")
    allow("src/scene/colour", "src/scene/input src/scene/model")
    allow("src/scene/sky", "src/scene/model src/scene/colour")
    allow("src/scene/build", "library src/image src/scene/input src/scene/model src/scene/colour src/scene/sky")
    allow("src/scene/rig", "src/scene/input src/scene/model src/scene/colour src/scene/build src/scene/import/ies")
    below = "src/scene/input src/scene/model src/scene/colour src/scene/sky src/scene/build"
    allow("src/scene/import/ply", below)
    allow("src/scene/import/ies", below " src/scene/import")
    allow("src/scene/import/pbrt", below " src/scene/import/ply src/scene/import/ies")
    # The table of importers.
    allow("src/scene/import", below " src/base src/scene/import/pbrt")
    scene = "src/scene/input src/scene/model src/scene/rig src/scene/import src/scene/import/ies"
    allow("src/visibility", "library src/scene/model src/interface")
    allow("src/tables", "library")
    allow("src/fit", "library src/base src/image")
    allow("src/render", "library src/base src/image src/scene/model src/interface")
    allow("src/render_cpu", "library src/base src/image src/scene/model src/visibility src/tables src/render src/interface")
    # The build generates SPIR-V as arrays. The two renderers never see each other.
    allow("src/shaders", "")
    # Structures that C++ and shaders share: shaders/interface.
    allow("src/interface", "")
    allow("src/gpu", "library src/shaders")
    allow("src/render_vulkan", "library src/base src/image src/scene/model src/visibility src/tables src/render src/gpu src/shaders src/interface")
    below = "library src/base src/image " scene " src/visibility src/render src/render_cpu src/render_vulkan src/gpu"
    below = below " src/shaders src/tables"
    allow("apps/common", below)
    allow("apps/viewer", below " src/scene/colour")
    # The product links nothing of the laboratory.
    allow("apps/nusselt", below " apps/common apps/viewer")
    # The module for Python, beside the programs.
    allow("python", "library wasm src/base src/image " scene " src/render src/render_cpu src/render_vulkan src/gpu src/tables")
    allow("lab", below " proof wasm src/interface")
    allow("apps/nusselt-lab", below " proof lab src/fit apps/common")

    allow("shaders/interface", "shaders/nusselt")
    below = "shaders/nusselt shaders/interface"
    allow("shaders/passes", below)
    allow("shaders/parity", below " shaders/passes")
    allow("shaders/bench", below)
    known["shaders/nusselt"] = 1
}

function allow(layer, others,    names, count, i) {
    known[layer] = 1
    allowed[layer, layer] = 1
    count = split(others, names, " ")
    for (i = 1; i <= count; ++i) allowed[layer, names[i]] = 1
}

function report(message) {
    printf "%s:%d: %s\n", FILENAME, FNR, message
    failed = 1
}

# The layer of a file, from its path: include/nusselt/core/vec.h is in include/core, the headers directly
# in include/nusselt are in include/all; shaders/nusselt/core/vec.glsl is in include/core, too. Elsewhere it is the
# innermost folder around the file that is a layer, or else a folder of src, apps or shaders.
function layer_of(path,    parts, count, folder) {
    count = split(path, parts, "/")
    if (path ~ /^shaders\/nusselt\//) return "include/" parts[3]
    if (parts[1] == "include") return count == 3 ? "include/all" : "include/" parts[3]
    folder = path
    while (sub(/\/[^\/]*$/, "", folder)) if (folder in known) return folder
    return parts[1] "/" parts[2]
}

# The layer of "name/...": a path from the root for proof, lab and apps, else a module of src or apps/viewer.
function included_layer(name) {
    if (name ~ /^(proof|lab|apps|wasm|python)\//) return layer_of(name)
    return name ~ /^viewer\// ? "apps/viewer" : layer_of("src/" name)
}

function check(from, to,    layer) {
    if (!(to in known)) return report("no layer " to "; new layers are entered in scripts/check-includes.sh")
    layer = from !~ /^include/ && to ~ /^include/ ? "library" : to
    if (!((from, layer) in allowed)) report(from " must not include " to)
}

# Headers of the compiler, for vector instructions.
function is_of_compiler(from, name) {
    return from == "include/simd" && name ~ /^(immintrin|arm_neon|wasm_simd128)\.h$/ || from == "include/core" && name == "emmintrin.h"
}

function check_shader(from, name, quoted) {
    if (from == "shaders/interface" && name == "cstdint") return
    if (!quoted) return report("write \"" name "\"")
    if (from ~ /^include/) {
        if (name ~ /^\.\.\/[a-z_]+\/[a-z_]+\.glsl$/) check(from, "include/" substr(name, 4, index(substr(name, 4), "/") - 1))
        else report("shaders/nusselt includes its own files only, as \"../folder/file.glsl\"")
    } else if (name ~ /^[a-z_]+\//) check(from, "shaders/" substr(name, 1, index(name, "/") - 1))
    else report("write \"folder/" name "\", relative to shaders/")
}

FNR == 1 {
    from = layer_of(FILENAME)
    if (!(from in known)) report("no layer " from "; new layers are entered in scripts/check-includes.sh")
}

/^[ \t]*#[ \t]*include[ \t]*[<"]/ {
    name = $0
    sub(/^[^<"]*/, "", name)
    quoted = substr(name, 1, 1) == "\""
    sub(/[>"][^>"]*$/, "", name)
    name = substr(name, 2)
    in_library = from ~ /^include/

    if (FILENAME ~ /^shaders\//) check_shader(from, name, quoted)
    else if (name ~ /^\.\.?\//) report("relative #include of " name)
    else if (name ~ /^nusselt\//) {
        if (quoted) report("write <" name ">")
        check(from, layer_of("include/" name))
    } else if (quoted && in_library) report("the library includes itself as <nusselt/...>")
    else if (quoted && name ~ /\//) check(from, included_layer(name))
    else if (quoted && from !~ /^apps/) report("write \"module/" name "\"")
    else if (!quoted && in_library && name ~ /[.\/]/ && !is_of_compiler(from, name))
        report("the library uses the standard library only, not <" name ">")
}

END { exit failed }'

# Scripts in TypeScript: web/library is below web/page and web/three, and nothing of web/ depends on the laboratory.
find web -name '*.ts' | LC_ALL=C sort | xargs -r awk '
/^(import|export|\}).* from "\.\.\// {
    folder = FILENAME
    sub(/\/[^\/]*$/, "", folder)
    name = $0
    gsub(/.* from "|";?$/, "", name)
    while (sub(/^\.\.\//, "", name)) sub(/\/?[^\/]*$/, "", folder)
    target = folder == "" ? name : folder "/" name
    split(FILENAME, parts, "/")
    if (index(target, "web/" parts[2] "/") == 1 || target ~ /^data\// || target == "web/scenes.json") next
    if (parts[2] != "library" && target ~ /^web\/library\//) next
    printf "%s:%d: %s must not import %s\n", FILENAME, FNR, FILENAME, target
    failed = 1
}
END { exit failed }'
