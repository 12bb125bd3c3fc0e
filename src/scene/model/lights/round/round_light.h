#pragma once
/// Spheres, disks, ellipsoids and ellipses. Their light is that of the exact shape. They have triangles in the scene, too.

#include "scene/model/lights/light_list.h"

#include <array>

namespace nusselt::scene {

/// What a round light is, and to which side it shines unless it shines to both.
enum class RoundModel : std::uint32_t {
    ellipse,   ///< flat; to the side of u x v
    ellipsoid, ///< outwards
    hollow,    ///< an ellipsoid that shines inwards
};

/// The points center + x u + y v + z w with x^2 + y^2 + z^2 <= 1. The semi-diameters are conjugate: any linear image of a sphere
/// or a disk. Renderers give it the light of this shape, and cameras and shadow rays meet the shape itself. Line samples of other
/// lights meet its surface(), the corners of which lie on the shape, and the rest inside.
struct RoundLight {
    std::uint32_t emitter = 0; ///< index into Scene::emitters
    RoundModel model = RoundModel::ellipsoid;
    Float3 center = {0, 0, 0};
    Float3 u = {1, 0, 0};
    Float3 v = {0, 1, 0};
    Float3 w = {0, 0, 1}; ///< 0 for ellipses
    Float3 radiance = {0, 0, 0};
    bool two_sided = false;
};

/// The lengths of the principal semi-axes, the longest first [m]. The last one of ellipses is 0.
std::array<double, 3> semi_axes(const RoundLight& light);

/// The area of one side [m^2].
double area(const RoundLight& light);

/// The most pieces around the circumference of ellipsoids. There are half as many from pole to pole.
inline constexpr int kRoundSides = 64;
/// Ellipses have so many times as many, because flat surfaces need few triangles.
inline constexpr int kSidesOfEllipse = 4;

/// The triangles, see RoundLight. They turn their front to the side that emits, outwards if both do. Texture coordinates
/// are the angle from u to v, and the angle from -w to w or the distance from the rim to the centre.
/// \param sides around the circumference of ellipsoids, at least 4
LightSurface surface(const RoundLight& light, int sides);

template <>
struct LightKind<RoundLight> {
    static constexpr std::string_view kName = "round";
    static constexpr std::string_view kNoun = "round light";
    static constexpr std::string_view kPlural = "spheres and disks";
    static constexpr bool kScalesEvenly = false;
    static constexpr bool kHasBrdfSamples = false;
    static constexpr EmissionQuantity kQuantity = kRadiance;
    static constexpr auto kEmission = &RoundLight::radiance;
    static void add_to(const RoundLight& light, Bounds& bounds);
    static void hash(const RoundLight& light, ContentHash& hash);
    static Double3 flux_per_emission(const RoundLight& light, double scene_radius);
    static void add_moment(const RoundLight& light, Moment& moment);
    /// Not for shapes that are much flatter or longer than wide: single precision fails there.
    static bool is_valid(const RoundLight& light);
    static void transform(RoundLight& light, const Transform& transform);
    static bool same_shape(const RoundLight& a, const RoundLight& b);
    static const bool* two_sided(const RoundLight& light);
    static void add_mesh(const RoundLight& light, LightMesh& mesh);
    static void add_surface(const RoundLight& light, LightSurface& surface);
    static double hit(const RoundLight& light, const SightRay& ray);
    static std::string describe(std::span<const RoundLight> lights, double scene_radius);
    static std::string rig_field(const RoundLight& light);
};

} // namespace nusselt::scene
