#!/usr/bin/env bash
# Builds a project with the lines of CMake from README.md against an installed library only, and checks what it prints.
# Usage: consume.sh PREFIX WORK_FOLDER COMPILER
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
prefix=$1 work=$2 compiler=$3

mkdir -p "$work/project"
cp "$here/main.cpp" "$work/project"
{
    printf 'cmake_minimum_required(VERSION 3.25)\nproject(consumer LANGUAGES CXX)\n'
    "$here/readme_block.sh" cmake find_package
} >"$work/project/CMakeLists.txt"
cmake -S "$work/project" -B "$work/build" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_PREFIX_PATH="$prefix" \
    -DCMAKE_CXX_STANDARD=17 -DCMAKE_CXX_EXTENSIONS=OFF
grep -q "nusselt_DIR:PATH=$prefix/" "$work/build/CMakeCache.txt" || { echo "another nusselt was found"; exit 1; }
cmake --build "$work/build"
output=$("$work/build/app")
echo "$output"
# A sixth of all directions, and the random numbers that went in.
[ "$output" = "solid angle 2.094395, u 0.750000 0.250000" ]
