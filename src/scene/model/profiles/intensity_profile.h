#pragma once
/// Luminous intensity by direction, as photometric files measure it in the far field of a luminaire.

#include "scene/model/vector_math.h"

#include <cstddef>
#include <vector>

namespace nusselt::scene {

/// The numbers of a profile: intensities [cd] in half-planes that meet in the axis of the luminaire (type C of
/// LM-63). Angles in radians.
struct IntensityTable {
    /// From the axis, strictly increasing, in [0, pi], two or more. Beyond them the profile is dark.
    std::vector<double> vertical;
    /// Of the half-planes, strictly increasing, in [0, 2 pi), one or more. They close: the first half-plane follows
    /// the last.
    std::vector<double> horizontal;
    std::vector<double> candelas; ///< at [half-plane * vertical.size() + vertical], finite and not negative
};

/// Intensity that is linear in either angle between the numbers of its table.
///
/// Directions are in the frame of the light, which is right-handed: +z is the axis (the normal of a flat light, nadir
/// for one that hangs from the ceiling), and the half-plane of 0 degrees contains +x. Horizontal angles count
/// counter-clockwise for those who look down on such a light from above, along +z. So the half-plane of 90 degrees
/// contains -y: w = (sin v cos h, -sin v sin h, cos v).
class IntensityProfile {
public:
    /// \param table  as described there; asserts it. Half-planes that disagree on the axis get their mean there.
    explicit IntensityProfile(IntensityTable table);

    /// \param direction  of any length but zero, away from the light
    /// \returns the intensity [cd]
    double intensity(const Double3& direction) const;
    /// The same for angles [rad], `vertical` in [0, pi], `horizontal` in [0, 2 pi).
    double intensity_at(double vertical, double horizontal) const;

    /// The flux [lm] between two vertical angles [rad], in closed form: with J the integral of the intensity over
    /// horizontal angles, which is linear between the numbers of the table, it integrates J(v) sin v.
    double flux_between(double begin, double end) const;
    /// The same for J(v) sin v cos v: the flux weighted by the cosine, which is negative for what goes up.
    double cosine_flux_between(double begin, double end) const;
    double flux() const;       ///< in all directions [lm]
    double lower_flux() const; ///< in the hemisphere around +z [lm]
    double upper_flux() const; ///< in the other one [lm]

    /// A number of the table that none exceeds.
    struct Peak {
        double candelas = 0;
        double vertical = 0, horizontal = 0; ///< where it is [rad]
    };
    Peak peak() const;

    /// The angle [rad] between the outermost directions of a plane through the axis whose intensity reaches a share
    /// of the peak: the beam angle for one half, the field angle for one tenth. Measured across +z, or across -z if
    /// more flux goes there.
    /// \param horizontal  of one half of the plane [rad]
    /// \param share       in (0, 1]
    /// \returns 0 if no direction of the plane reaches it
    double spread(double horizontal, double share) const;

    const IntensityTable& table() const { return table_; }

private:
    double at(std::size_t half_plane, std::size_t vertical) const {
        return table_.candelas[half_plane * table_.vertical.size() + vertical];
    }
    double width_of(std::size_t half_plane) const;
    void agree_at(std::size_t vertical);
    template <class Moment>
    double integral(double begin, double end, const Moment& moment) const;

    IntensityTable table_;
    std::vector<double> ring_; ///< J [cd rad] at each vertical angle
};

} // namespace nusselt::scene
