#!/usr/bin/env bash
# Shows that check_ptx.sh accepts a complete kernel, and rejects a missing one and a call of an undefined function.
# Usage: check_ptx_self_test.sh CLANG
set -euo pipefail
clang=$1
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# Whether the check passes on the CUDA source $1.
passes() {
    printf '%s' "$1" >"$folder/a.cu"
    "$clang" -x cuda --cuda-device-only --cuda-gpu-arch=sm_60 -nocudainc -nocudalib -Wno-unknown-cuda-version -O2 \
        -include "$here/cuda_shim.h" -S "$folder/a.cu" -o "$folder/a.ptx"
    "$here/check_ptx.sh" "$folder/a.ptx" "$folder/a.cu" >/dev/null
}

passes '__global__ void kernel(float* x) { *x = 1; }' || { echo "a good kernel was rejected"; exit 1; }
! passes 'template <class T> __global__ void kernel(T* x) { *x = 1; }' || { echo "a missing kernel was accepted"; exit 1; }
! passes '__device__ float f(float); __global__ void kernel(float* x) { *x = f(*x); }' ||
    { echo "the call of an undefined function was accepted"; exit 1; }
! passes '' || { echo "a source without kernels was accepted"; exit 1; }
