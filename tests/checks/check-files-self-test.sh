#!/usr/bin/env bash
# Shows that scripts/check-files.sh accepts a good tree and finds each kind of offence.
set -euo pipefail
scripts=$(cd "$(dirname "$0")/../../scripts" && pwd)
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir -p "$tree"/{include,src,proof,lab,apps,web,wasm,python,site,tests,examples,shaders,scripts,cmake}
cp "$scripts/../.clang-format" "$tree"
touch "$tree/CMakeLists.txt" "$tree/Makefile"
good=$'#include "/usr/include/math.h"\nint sum(int a, int b) { return a + b; } // and/or\n'

# Expects that the check $1 succeeds or fails ($2) on a tree with the file content $3.
expect() {
    printf '%s' "$3" >"$tree/src/a.cpp"
    if "$scripts/check-files.sh" "$1" "$tree" >/dev/null 2>&1; then result=passes; else result=fails; fi
    [ "$result" = "$2" ] || { echo "check '$1' $result on: ${3:0:100}"; exit 1; }
}

for check in format length folders paths; do expect "$check" passes "$good"; done
expect format fails $'int  sum(int a,int b) { return a+b; }\n'
expect length passes "$(yes '// line' | head -n 600)"
expect length fails "$(yes '// line' | head -n 601)"
for file in shaders/a.{glsl,comp,vert,frag} scripts/a.{py,sh} web/a.ts site/a.py cmake/a.{cmake,h.in} tests/CMakeLists.txt CMakeLists.txt Makefile; do
    head -n 601 < <(yes '# line') >"$tree/$file"
    expect length fails "$good"
    : >"$tree/$file"
done
for i in $(seq 30); do touch "$tree/src/$i.h"; done
expect folders fails "$good"
rm "$tree/src/30.h"
expect folders passes "$good"
rm "$tree"/src/*.h
root=/somewhere
expect paths fails "const char* file = \"$root/else/file.txt\";"
expect paths fails "// see $root/notes.txt"
