#pragma once
/// Clear and hazy skies by formulas, and the disk of the sun.
///
/// A. J. Preetham, P. Shirley, B. Smits 1999, A Practical Analytic Model for Daylight, doi:10.1145/311535.311545: the
/// luminance and chromaticity of the sky in Perez' form, of the zenith from turbidity and the height of the sun, and
/// the transmittance of the atmosphere.

#include "scene/colour/colour_space.h"

namespace nusselt::scene {

/// The space of the sky has its zenith at +z. Radiance is in linear sRGB [W/(sr m^2)], with the lumens per watt of
/// intensity profiles (kLumensPerWatt). Components outside the gamut become 0.
class PreethamSky {
public:
    // The model was fitted for 2 to 6 and bends beyond. Other numbers count as the nearest one.
    static constexpr double kLeastTurbidity = 2;
    static constexpr double kMostTurbidity = 10;
    /// Half of the angle under which the sun is seen [rad].
    static constexpr double kSunRadius = 0.00465;

    /// \param turbidity optical thickness of haze and molecules over that of molecules: 2 is very clear, 10 hazy.
    /// \param to_sun    not zero. A sun below the horizon counts as on the horizon.
    PreethamSky(double turbidity, const Double3& to_sun);

    /// The sky without the disk of the sun. Directions below the horizon have the radiance of the horizon above them:
    /// the ground is up to the caller.
    /// \param direction of unit length; the azimuth of the nadir is that of +x.
    Double3 sky_radiance(const Double3& direction) const;
    /// The sun, the same in all of its disk: its edge is not darker than its centre.
    const Double3& sun_radiance() const { return sun_radiance_; }
    /// Unit direction, at or above the horizon.
    const Double3& to_sun() const { return to_sun_; }
    /// Whether a unit direction points to the disk.
    bool is_in_sun(const Double3& direction) const;

    /// Luminance of the zenith [cd/m^2].
    double zenith_luminance() const { return zenith_[0]; }
    Chromaticity zenith_chromaticity() const { return {zenith_[1], zenith_[2]}; }

private:
    double turbidity_;
    Double3 to_sun_;
    double zenith_[3];          ///< luminance [cd/m^2], CIE x and y
    double over_perez_[3];      ///< the same, over Perez' function at the zenith
    double coefficients_[3][5]; ///< of Perez' function for each of these
    Double3 sun_radiance_;
};

} // namespace nusselt::scene
