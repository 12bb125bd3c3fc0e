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
/// The same for a material at texture coordinates.
float alpha_at(const scene::Scene& scene, const scene::Material& material, const scene::Float2& uv);

/// A number in [0, 1) that depends only on the ray and what it hits: each hit of a ray gets its own.
/// \param instance or another number that tells hits on the same triangle apart
float random_of_hit(const scene::Float3& origin, const scene::Float3& direction, std::uint32_t triangle,
                    std::uint32_t instance);

} // namespace nusselt::visibility
