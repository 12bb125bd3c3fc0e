#!/usr/bin/env bash
# Where the packages of the programs are installed, the library installs before the programs are built.
# Usage: install_unbuilt.sh WORK_FOLDER COMPILER
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
work=$1 compiler=$2

rm -rf "$work"
cmake -S "$root" -B "$work/build" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" -DNUSSELT_BUILD_RENDERER=ON \
    -DNUSSELT_BUILD_TESTS=OFF
cmake --install "$work/build" --prefix "$work/prefix"
[ -e "$work/prefix/include/nusselt.h" ] && [ ! -e "$work/prefix/bin/nusselt" ]
