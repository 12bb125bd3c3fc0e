#pragma once
/// Light from all directions, infinitely far away: skies.

#include "scene/model/lights/light_list.h"
#include "scene/model/lights/polygon_light.h"

#include <memory>
#include <string>
#include <vector>

namespace nusselt::scene {

/// The radiance of all directions as an equal-area map of the octahedron (Clarberg 2008), interpolated bilinearly. Texel
/// (i, j) is at index j * size + i; z is in the centre of the square.
struct EnvironmentMapTexels {
    std::string name;
    int size = 0;               ///< columns and rows: a power of two from 16 to 4096
    std::vector<Float3> texels; ///< finite and not negative
    Float3 mean = {0, 0, 0};    ///< over all directions; 0 in channels where it is below kDarkest
    std::string path = {};      ///< of its file; empty for skies by formulas
    Float3 largest = {0, 0, 0}; ///< of the texels, for each channel
};

/// A sky around the scene. Cameras see it where they see nothing else. It has the radiance `radiance` * t / mean where the map
/// has a texel t, per channel. With a portal, only what passes through the portal arrives, at cameras as at surfaces.
struct EnvironmentLight {
    std::uint32_t emitter = 0;   ///< index into Scene::emitters
    std::int32_t map = -1;       ///< index into Scene::environment_maps, -1 for the same radiance everywhere
    Float3 radiance = {0, 0, 0}; ///< mean over all directions [W/(sr m^2)]
    // The axes of the map in world space: orthonormal, of either handedness.
    Float3 x_axis = {1, 0, 0};
    Float3 y_axis = {0, 1, 0};
    Float3 z_axis = {0, 0, 1};
    /// A convex planar polygon that light passes in both directions; empty if there is none.
    PolygonVertices portal = {};
};

template <>
struct LightKind<EnvironmentLight> {
    static constexpr std::string_view kName = "environment";
    static constexpr std::string_view kNoun = "environment";
    static constexpr std::string_view kPlural = "environments";
    static constexpr bool kScalesEvenly = true;
    static constexpr bool kHasBrdfSamples = false;
    static constexpr EmissionQuantity kQuantity = kRadiance;
    static constexpr auto kEmission = &EnvironmentLight::radiance;
    static void add_to(const EnvironmentLight& /*light*/, Bounds& /*bounds*/) {}
    static void hash(const EnvironmentLight& light, ContentHash& hash);
    /// What enters a sphere of the scene's radius, or passes the portal in one direction if the radiance is the same everywhere.
    static Double3 flux_per_emission(const EnvironmentLight& light, double scene_radius);
    /// It is where its portal is. Without one, it is everywhere, and the origin stands for its place.
    static void add_moment(const EnvironmentLight& light, Moment& moment);
    static bool is_valid(const EnvironmentLight& light);
    static void transform(EnvironmentLight& light, const Transform& transform);
    static bool same_shape(const EnvironmentLight& a, const EnvironmentLight& b);
    static const bool* two_sided(const EnvironmentLight& /*light*/) { return nullptr; }
    static void add_mesh(const EnvironmentLight& /*light*/, LightMesh& /*mesh*/) {}
    static double hit(const EnvironmentLight& light, const SightRay& ray);
    static std::string describe(std::span<const EnvironmentLight> lights, double scene_radius);
    /// Rigs make no environments.
    static std::string rig_field(const EnvironmentLight& /*light*/) { return ""; }
};

} // namespace nusselt::scene
