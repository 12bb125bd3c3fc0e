#pragma once
/// A kind of light for tests: round, one-sided, sampled by its area. It shows what another kind takes: this folder, and a
/// row in the table of each renderer that supports it.

#include "scene/model/lights/lights.h"
#include "scene/model/scene.h"

namespace nusselt::scene {

/// Emits to the side of its normal.
struct DiscLight {
    std::uint32_t emitter = 0;
    Float3 center = {0, 0, 0};
    Float3 normal = {0, 0, 1}; ///< unit
    float radius = 0;
    Float3 radiance = {0, 0, 0};
};

template <>
struct LightKind<DiscLight> {
    static constexpr std::string_view kName = "disc";
    static constexpr std::string_view kNoun = "disc";
    static constexpr std::string_view kPlural = "discs";
    static constexpr bool kScalesEvenly = true;
    static constexpr bool kHasBrdfSamples = false;
    static constexpr EmissionQuantity kQuantity = kRadiance;
    static constexpr auto kEmission = &DiscLight::radiance;
    static void add_to(const DiscLight& light, Bounds& bounds);
    static void hash(const DiscLight& light, ContentHash& hash);
    static Double3 flux_per_emission(const DiscLight& light, double scene_radius);
    static void add_moment(const DiscLight& light, Moment& moment);
    static bool is_valid(const DiscLight& light);
    static void transform(DiscLight& light, const Transform& transform);
    static bool same_shape(const DiscLight& a, const DiscLight& b);
    static const bool* two_sided(const DiscLight& light);
    static void add_mesh(const DiscLight& light, LightMesh& mesh);
    static double hit(const DiscLight& light, const SightRay& ray);
    static std::string describe(std::span<const DiscLight> lights, double scene_radius);
    static std::string rig_field(const DiscLight& light);
};

} // namespace nusselt::scene
