#pragma once
/// How the radiance of lights with area depends on the direction: by a measured luminaire, a grid in front
/// of the light, or both.

#include "scene/model/lights/profiled_emission.h"
#include "scene/model/profiles/luminaire.h"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace nusselt::scene {

/// Spreads and honeycombs of this many degrees have no effect.
inline constexpr double kWidestSpread = 180;
/// Single precision holds the slopes of narrower spreads, but nobody can see the difference.
inline constexpr double kNarrowestSpread = 0.01;

/// The angles [degrees] between the outermost directions that a honeycomb with rectangular holes passes, in the planes along
/// and across the x axis of the profile: twice the arctangent of width over depth of the holes.
struct HoneycombAngles {
    double along = kWidestSpread, across = kWidestSpread;
    bool operator==(const HoneycombAngles&) const = default;
};

/// A flat face of the shape that shines as a luminaire.
struct LuminousFace {
    Double3 normal;  ///< in the frame of the profile
    double area = 0; ///< of all polygons with this normal [m^2]
};

/// The lateral surface of a tube that shines as a luminaire.
struct LuminousRound {
    Double3 axis; ///< unit, in the frame of the profile
    double area =
        0; ///< of its section along the axis, which directions across the axis see [m^2]; 0 for flat shapes
};

/// The most normals of the faces of one shape.
inline constexpr std::size_t kMostLuminousFaces = 16;

/// The function f of ProfiledEmission: the intensity of the luminaire over the area of the shape that is visible in the
/// direction [cd/m^2], times what the spread or the honeycomb lets pass.
struct EmissionProfile {
    std::shared_ptr<const Luminaire>
        luminaire;                  ///< null for light that is alike in all directions before the spread
    double spread = kWidestSpread;  ///< [degrees], the angle of the cone that contains all light of a point
    HoneycombAngles honeycomb = {}; ///< of polygons; not together with a spread
    std::vector<LuminousFace> faces = {}; ///< of shapes with a luminaire
    LuminousRound round = {};             ///< of tubes and lines with a luminaire
    double lost = 0; ///< the share of the flux of the luminaire that the shape does not emit, in [0, 1]
};

/// The intensity of the luminaire over the visible area [cd/m^2]; 1 without one.
/// \param direction of unit length, in the frame of the profile
double luminance_of_profile(const EmissionProfile& profile, const Double3& direction);

/// The area of the shape that is visible in a direction [m^2]. \copydetails luminance_of_profile
double visible_area(const EmissionProfile& profile, const Double3& direction);
/// The same, but at least least_visible_area().
double effective_area(const EmissionProfile& profile, const Double3& direction);

/// Visible areas below this one count as this one, see kGrazingCosine [m^2].
double least_visible_area(const EmissionProfile& profile);

/// The tangent of half of the spread; nothing if it has no effect.
std::optional<double> spread_slope(const EmissionProfile& profile);

/// Tangents of half the angles of the honeycomb, infinite where an angle has no effect; nothing if none has.
std::optional<std::array<double, 2>> honeycomb_slopes(const EmissionProfile& profile);

/// The direction along which the holes of a honeycomb on a face lie, in the frame of the profile: the x axis in the plane of the
/// face, or the y axis if the face looks along x.
Double3 honeycomb_direction(const Double3& normal);

/// The same direction in world space, unit and in the plane of the face.
Double3 honeycomb_axis(const ProfilePlacement& placement);

/// The share that the spread or the honeycomb lets pass.
/// \param normal    of the face, unit, in the frame of the profile
/// \param direction unit, in the frame of the profile, on the side of the normal
double passed_share(const EmissionProfile& profile, const Double3& normal, const Double3& direction);

/// What the spread or the honeycomb would let pass of light that is alike in all directions, in (0, 1].
double passed_flux(const EmissionProfile& profile);

/// What the lights of one shape are to have.
struct ProfileRequest {
    std::shared_ptr<const Luminaire> luminaire; ///< may be null
    double spread = kWidestSpread;              ///< [degrees], from kNarrowestSpread
    /// By which the half-plane of 0 degrees is turned about the axis, counter-clockwise for those who look at the side that
    /// emits [degrees].
    double angle = 0;
    HoneycombAngles honeycomb = {}; ///< polygons only
};
/// Whether it differs from light that is alike in all directions.
bool has_effect(const ProfileRequest& request);

struct ProfiledShape {
    std::vector<ProfiledEmission> emissions; ///< for each polygon
    /// The radiance of each polygon with which the shape has the intensities of the luminaire, if the luminance of its colour
    /// is one [W/(sr m^2)]; empty without a luminaire.
    std::vector<double> radiance;
};

/// The axes of a profile or a light: right-handed and orthonormal.
struct Axes {
    /// \param along_x need not be perpendicular to `along_z`, nor of unit length
    static Axes of(const Double3& along_x, const Double3& along_z);
    Double3 to_local(const Double3& v) const { return {dot(x, v), dot(y, v), dot(z, v)}; }
    Double3 to_world(const Double3& v) const { return v.x * x + v.y * y + v.z * z; }
    /// Turned about z, counter-clockwise for those whom z points at [degrees].
    Axes turned(double angle) const;

    Double3 x, y, z;
};

/// Profiles for the polygons of one shape. The axis of the luminaire is the normal of the first one, and its half-plane of 0
/// degrees contains an edge of it.
/// \param first_edge its number in the first polygon
/// \returns nothing if the shape has more than kMostLuminousFaces normals: round ones, say
std::optional<ProfiledShape> profile_shape(std::span<const PolygonLight> lights, std::size_t first_edge,
                                           const ProfileRequest& request);

} // namespace nusselt::scene
