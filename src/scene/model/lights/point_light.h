#pragma once
/// Lights at a point: equally bright in all directions, spots, and images that tell the intensity by direction.

#include "scene/model/lights/light_list.h"

namespace nusselt::scene {

/// How the intensity depends on the direction, in the frame of the light.
enum class PointDistribution : std::uint32_t {
    isotropic,
    smooth_cone,  ///< a cone around z, whose border falls off by the cubic step 3 t^2 - 2 t^3 of the cosine
    quartic_cone, ///< likewise by t^4
    octahedral_image, ///< of all directions, by the equal-area map of octahedra (Clarberg 2008), z in the centre
    latitude_image, ///< of all directions, by azimuth from x to y and inclination, z at the upper border
    projected_image, ///< of those that a pyramid around z contains, as a slide projector; x to the right, y down
    profile,         ///< that of a luminaire, whose axis is z
};

/// A light without extent. Cameras do not see it. Where `distribution` is 1 it has the intensity `intensity`.
struct PointLight {
    std::uint32_t emitter = 0; ///< index into Scene::emitters
    Float3 position = {0, 0, 0};
    Float3 intensity = {0, 0, 0}; ///< [W/sr]
    PointDistribution distribution = PointDistribution::isotropic;
    // The frame in world space: orthonormal, of either handedness. Cones need z alone.
    Float3 x_axis = {1, 0, 0};
    Float3 y_axis = {0, 1, 0};
    Float3 z_axis = {0, 0, 1};
    // Of cones: angles from the axis [degrees].
    float cone_angle = 30; ///< where it becomes dark, above 0 and at most 180
    float full_angle = 25; ///< up to which it is fully bright, from 0 to the other angle
    std::int32_t profile =
        -1; ///< of a luminaire: index into Scene::luminaires; the distribution is 1 at its peak
    // Of images.
    int texture = -1;                  ///< index into Scene::textures; -1 for a constant 1
    Float2 half_extent = {1, 1};       ///< of projected ones: of the picture at a distance of 1
    Float3 image_integral = {0, 0, 0}; ///< over all directions, also of luminaires [sr]
};

bool is_cone(PointDistribution distribution);
bool is_image(PointDistribution distribution);

/// The falloff of a cone in numbers that keep their precision for narrow cones: t = (end - x) / width with x = 1 - cosine.
struct ConeFalloff {
    double end;   ///< x at the border of the cone
    double width; ///< 0 for a sharp border
};
ConeFalloff cone_falloff(const PointLight& light);
/// 1 / width, and for sharp borders a number so large that t is 0 or 1 for any x beside the border.
float inverse_width(const ConeFalloff& falloff);

struct Luminaire;
/// Gives a light the distribution of a luminaire; its index is left to the caller.
void set_profile(const Luminaire& luminaire, PointLight& light);

/// The integral of the distribution over all directions, for each channel [sr].
Double3 solid_angle(const PointLight& light);

template <>
struct LightKind<PointLight> {
    static constexpr std::string_view kName = "point";
    static constexpr std::string_view kNoun = "point light";
    static constexpr std::string_view kPlural = "point lights";
    static constexpr bool kScalesEvenly = true;
    static constexpr bool kHasBrdfSamples = false;
    static constexpr EmissionQuantity kQuantity = kIntensity;
    static constexpr auto kEmission = &PointLight::intensity;
    /// They do not count: a lamp that stands for the sun is far away, and the size of the scene sets its tolerances.
    static void add_to(const PointLight& /*light*/, Bounds& /*bounds*/) {}
    static void hash(const PointLight& light, ContentHash& hash);
    static Double3 flux_per_emission(const PointLight& light, double scene_radius);
    static void add_moment(const PointLight& light, Moment& moment);
    static bool is_valid(const PointLight& light);
    static void transform(PointLight& light, const Transform& transform);
    static bool same_shape(const PointLight& a, const PointLight& b);
    static const bool* two_sided(const PointLight& /*light*/) { return nullptr; }
    static void add_mesh(const PointLight& /*light*/, LightMesh& /*mesh*/) {}
    static double hit(const PointLight& light, const SightRay& ray);
    static std::string describe(std::span<const PointLight> lights, double scene_radius);
    static std::string rig_field(const PointLight& light);
};

} // namespace nusselt::scene
