#pragma once
/// Surfaces that are only partly there.

#include "scene/model/scene.h"

#include <cstdint>

namespace nusselt::visibility {

enum class Presence {
    full,    ///< rays always hit
    partial, ///< rays hit with a probability that may depend on the place
    none,    ///< rays never hit
};

Presence presence_of(const scene::Material& material);

/// The probability that rays hit a triangle at barycentric coordinates (see HitPacket). Texture coordinates that are
/// not finite count as 0.
float alpha_at(const scene::Scene& scene, std::uint32_t triangle, float u, float v);

} // namespace nusselt::visibility
