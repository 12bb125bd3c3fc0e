#!/usr/bin/env bash
# Installs the library and its shaders from a build and uses them.
# Usage: install_and_consume.sh BUILD_FOLDER WORK_FOLDER COMPILER
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
build=$1 work=$2 compiler=$3

rm -rf "$work"
cmake --install "$build" --prefix "$work/prefix"
grep -q '^class PolygonSolidAngle' "$work/prefix/include/nusselt.h" || { echo "no single header"; exit 1; }
diff -r "$root/shaders/nusselt" "$work/prefix/share/nusselt/shaders" || { echo "other shaders are installed"; exit 1; }
"$here/consume.sh" "$work/prefix" "$work" "$compiler"
