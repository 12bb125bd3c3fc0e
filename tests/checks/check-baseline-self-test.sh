#!/usr/bin/env bash
# Shows that the emulated baseline processor runs an ordinary program and stops one that uses AVX.
# Usage: tests/checks/check-baseline-self-test.sh COMPILER EMULATOR...
set -euo pipefail
compiler=$1
emulator=("${@:2}")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# Whether a program with the given body of main() exits with 0.
runs() {
    echo "int main() { $1 }" | "$compiler" -x c++ - -o "$folder/program"
    "${emulator[@]}" "$folder/program" >/dev/null 2>&1
}

runs 'asm volatile("crc32b %%al, %%eax" ::: "eax");' || { echo "SSE4.2 does not run"; exit 1; }
! runs 'asm volatile("vaddps %%ymm0, %%ymm0, %%ymm0" ::: "xmm0");' || { echo "AVX was not stopped"; exit 1; }
