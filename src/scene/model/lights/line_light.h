#pragma once
/// Linear lights, tubes and strips.

#include "scene/model/lights/light_list.h"

namespace nusselt::scene {

/// The model by which a tube gives light.
enum class TubeModel : std::uint32_t {
    linear, ///< that of a linear light with brightness radiance * radius [W/(sr m)]: the limit of a small radius
    solid, ///< that of a closed cylinder, which shines outwards from its lateral surface and its caps
    open,  ///< that of a cylinder with black caps, which shines outwards from its lateral surface only
    strip, ///< that of a rectangle with two bright sides, in the limit of a small width: a line with a normal
};

/// A tube or a strip. Cameras see it as a cylinder of this radius, or as a rectangle; it casts no shadows.
struct LineLight {
    std::uint32_t emitter = 0; ///< index into Scene::emitters
    Float3 start = {0, 0, 0};
    Float3 end = {0, 0, 0};
    float radius = 0; ///< [m]; of strips, half the width
    Float3 radiance = {
        0, 0, 0}; ///< with a texture the mean over all that emits, with a profile that over directions
    TubeModel model = TubeModel::solid;
    /// Of strips and of lights with a profile, whose axis it is: unit, perpendicular to the line. Else 0.
    Float3 normal = {0, 0, 0};
    /// Index into Scene::emission_textures, -1 for uniform radiance. Radiance varies along the line only: the texture has one
    /// column and up to kMaxLineTexels rows, from the start to the end. Caps have the radiance of the ends.
    std::int32_t texture = -1;
    std::int32_t profile =
        -1; ///< index into Scene::emission_profiles, -1 for the same radiance in all directions
};

/// The area of the lateral surface, or of both sides of a strip [m^2].
double lateral_area(const LineLight& light);
/// The area of all that emits: the lateral surface, and the caps of solid tubes [m^2].
double area(const LineLight& light);

inline constexpr int kMaxLineTexels = 64;

/// Sides of a tube as cameras see it; the polygon with this many corners has the area of the circle.
inline constexpr int kTubeSides = 32;
/// Lateral surface and two caps.
inline constexpr int kTrianglesPerTube = 2 * kTubeSides + 2 * (kTubeSides - 2);

template <>
struct LightKind<LineLight> {
    static constexpr std::string_view kName = "line";
    static constexpr std::string_view kNoun = "tube";
    static constexpr std::string_view kPlural = "tubes and lines";
    static constexpr bool kScalesEvenly = true;
    static constexpr bool kHasBrdfSamples = false;
    static constexpr EmissionQuantity kQuantity = kRadiance;
    static constexpr auto kEmission = &LineLight::radiance;
    static void add_to(const LineLight& light, Bounds& bounds);
    static void hash(const LineLight& light, ContentHash& hash);
    static Double3 flux_per_emission(const LineLight& light, double scene_radius);
    static void add_moment(const LineLight& light, Moment& moment);
    static bool is_valid(const LineLight& light);
    static void transform(LineLight& light, const Transform& transform);
    static bool same_shape(const LineLight& a, const LineLight& b);
    static const bool* two_sided(const LineLight& light);
    static void add_mesh(const LineLight& light, LightMesh& mesh);
    static double hit(const LineLight& light, const SightRay& ray);
    static std::string describe(std::span<const LineLight> lights, double scene_radius);
    static std::string rig_field(const LineLight& light);
};

} // namespace nusselt::scene
