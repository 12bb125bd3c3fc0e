#pragma once
/// Parallel light from infinity, such as that of the sun.

#include "scene/model/lights/light_list.h"

namespace nusselt::scene {

/// It fills the whole scene. Cameras do not see it.
struct DistantLight {
    std::uint32_t emitter = 0;     ///< index into Scene::emitters
    Float3 direction = {0, 0, 1};  ///< of the light on its way to the scene, unit
    Float3 irradiance = {0, 0, 0}; ///< of surfaces normal to the direction [W/m^2]
};

template <>
struct LightKind<DistantLight> {
    static constexpr std::string_view kName = "distant";
    static constexpr std::string_view kNoun = "distant light";
    static constexpr std::string_view kPlural = "distant lights";
    static constexpr bool kScalesEvenly = true;
    static constexpr bool kHasBrdfSamples = false;
    static constexpr EmissionQuantity kQuantity = kIrradiance;
    static constexpr auto kEmission = &DistantLight::irradiance;
    static void add_to(const DistantLight& /*light*/, Bounds& /*bounds*/) {}
    static void hash(const DistantLight& light, ContentHash& hash);
    /// As in pbrt: what passes a disk of the scene's radius.
    static Double3 flux_per_emission(const DistantLight& light, double scene_radius);
    /// It is everywhere; the origin stands for its place.
    static void add_moment(const DistantLight& light, Moment& moment);
    static bool is_valid(const DistantLight& light);
    static void transform(DistantLight& light, const Transform& transform);
    static bool same_shape(const DistantLight& a, const DistantLight& b);
    static const bool* two_sided(const DistantLight& /*light*/) { return nullptr; }
    static void add_mesh(const DistantLight& /*light*/, LightMesh& /*mesh*/) {}
    static double hit(const DistantLight& light, const SightRay& ray);
    static std::string describe(std::span<const DistantLight> lights, double scene_radius);
    static std::string rig_field(const DistantLight& light);
};

} // namespace nusselt::scene
