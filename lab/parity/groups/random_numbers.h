#pragma once
/// Random numbers of renderers, which have the same bits on devices and in C++.

#include "lab/parity/shader_platform.h"

#include <array>
#include <cstdint>
#include <span>

namespace nusselt::parity {

/// Values of nusselt::Sampler.
inline constexpr int kSamplers = 6;

/// How many numbers of a shader differ from those of C++, for each sampler and, in the last entry, for camera rays.
std::array<int, kSamplers + 1> different_random_numbers(const ShaderPlatform& platform,
                                                        const VariantShader& shader, std::size_t calls);

} // namespace nusselt::parity
