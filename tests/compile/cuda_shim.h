#pragma once
/// The few declarations of the CUDA toolkit that device code of the library needs. Square roots, fma and the
/// like are compiler built-ins, which become PTX instructions.

#include <stddef.h>

#define __host__ __attribute__((host))
#define __device__ __attribute__((device))
#define __global__ __attribute__((global))

extern "C" __device__ inline void* memcpy(void* destination, const void* source, size_t size) noexcept {
    return __builtin_memcpy(destination, source, size);
}
