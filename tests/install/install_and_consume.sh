#!/usr/bin/env bash
# Installs the library and its shaders, builds the consumer project against the installed files only, and checks what it prints.
# Usage: install_and_consume.sh BUILD_FOLDER WORK_FOLDER COMPILER
set -euo pipefail
consumer=$(cd "$(dirname "$0")" && pwd)/consumer
root=$(cd "$(dirname "$0")/../.." && pwd)
build=$1 work=$2 compiler=$3

rm -rf "$work"
cmake --install "$build" --prefix "$work/prefix"
grep -q '^class PolygonSolidAngle' "$work/prefix/include/nusselt.h" || { echo "no single header"; exit 1; }
diff -r "$root/shaders/nusselt" "$work/prefix/share/nusselt/shaders" || { echo "other shaders are installed"; exit 1; }
cmake -S "$consumer" -B "$work/build" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_PREFIX_PATH="$work/prefix"
grep -q "nusselt_DIR:PATH=$work/prefix/" "$work/build/CMakeCache.txt" || { echo "another nusselt was found"; exit 1; }
cmake --build "$work/build"
output=$("$work/build/consumer")
echo "$output"
# A sixth of all directions, and the random numbers that went in.
[ "$output" = "solid angle 2.094395, u 0.750000 0.250000" ]
