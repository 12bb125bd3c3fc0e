#pragma once
/// How the radiance of lights with area depends on the direction: by a measured luminaire, by a spread, or by both.

#include "scene/model/lights/profiled_emission.h"
#include "scene/model/profiles/luminaire.h"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace nusselt::scene {

/// Spreads of this many degrees and more have no effect.
inline constexpr double kWidestSpread = 180;
/// Single precision holds the slopes of narrower spreads, but nobody can see the difference.
inline constexpr double kNarrowestSpread = 0.01;

/// A flat face of the shape that shines as a luminaire.
struct LuminousFace {
    Double3 normal;  ///< in the frame of the profile
    double area = 0; ///< of all polygons with this normal [m^2]
};

/// The most normals of the faces of one shape.
inline constexpr std::size_t kMostLuminousFaces = 16;

/// The function f of ProfiledEmission: the intensity of the luminaire over the area of the shape that is visible in the
/// direction [cd/m^2], times what the spread lets pass.
struct EmissionProfile {
    std::shared_ptr<const Luminaire>
        luminaire;                   ///< null for light that is alike in all directions before the spread
    double spread = kWidestSpread;   ///< [degrees], the angle of the cone that contains all light of a point
    std::vector<LuminousFace> faces; ///< of shapes with a luminaire
    double lost = 0; ///< the share of the flux of the luminaire that the shape does not emit, in [0, 1]
};

/// The intensity of the luminaire over the visible area [cd/m^2]; 1 without one.
/// \param direction of unit length, in the frame of the profile
double luminance_of_profile(const EmissionProfile& profile, const Double3& direction);

/// The area of the faces that is visible in a direction, at least least_visible_area() [m^2]. \copydetails luminance_of_profile
double visible_area(const EmissionProfile& profile, const Double3& direction);

/// Visible areas below this one count as this one, see kGrazingCosine [m^2].
double least_visible_area(const EmissionProfile& profile);

/// The tangent of half of the spread; nothing if it has no effect.
std::optional<double> spread_slope(const EmissionProfile& profile);

/// The share that the spread lets pass. \param cosine of the direction with the normal of the light, positive
double passed_share(const EmissionProfile& profile, double cosine);

/// What the lights of one shape are to have.
struct ProfileRequest {
    std::shared_ptr<const Luminaire> luminaire; ///< may be null
    double spread = kWidestSpread;              ///< [degrees], from kNarrowestSpread
    /// By which the half-plane of 0 degrees is turned about the axis, counter-clockwise for those who look at the side that
    /// emits [degrees].
    double angle = 0;
};

struct ProfiledShape {
    std::vector<ProfiledEmission> emissions; ///< for each polygon
    /// The radiance of each polygon with which the shape has the intensities of the luminaire, if the luminance of its colour
    /// is one [W/(sr m^2)]; empty without a luminaire.
    std::vector<double> radiance;
};

/// Profiles for the polygons of one shape. The axis of the luminaire is the normal of the first one, and its half-plane of 0
/// degrees contains an edge of it.
/// \param first_edge its number in the first polygon
/// \returns nothing if the shape has more than kMostLuminousFaces normals: round ones, say
std::optional<ProfiledShape> profile_shape(std::span<const PolygonLight> lights, std::size_t first_edge,
                                           const ProfileRequest& request);

} // namespace nusselt::scene
