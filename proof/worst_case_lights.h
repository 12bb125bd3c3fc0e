#pragma once
/// The smallest families of lights that contain every sector and every line up to symmetry, for the search for the
/// worst backward error.

#include <nusselt/estimate/backward_error.h>
#include <nusselt/random/pcg.h>
#include <nusselt/related/line_projected_solid_angle_peters.h>
#include <nusselt/related/polygon_projected_solid_angle_peters.h>
#include <nusselt/sampling/line_projected_solid_angle.h>
#include <nusselt/sampling/polygon_projected_solid_angle.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace nusselt::proof {

/// Coordinates of the search are logits from -kReach to kReach. Steps are thus relative to the distance from the
/// closer end, because errors peak within 1e-5 of the ends of a range.
inline constexpr int kReach = 16;

/// Maps the coordinates of the search to [0, 1], ends included.
template <class Real>
Real share_of(Real coordinate) {
    const auto logistic = [](Real x) { return 1 / (1 + std::exp(-x)); };
    const Real rest = logistic(-Real(kReach));
    return below_one((logistic(coordinate) - rest) / (1 - 2 * rest));
}

/// Random coordinates of the search.
class RandomCoordinates {
public:
    /// \param index number of the sequence.
    RandomCoordinates(std::uint64_t seed, std::uint64_t index) : generator_(start_of(seed, index)) {}

    /// A random coordinate, uniform in the quantity that it stands for.
    double uniform() {
        const double u = (generator_() + 0.5) * 0x1p-32;
        return std::fmin(std::fmax(std::log(u / (1 - u)), -kReach), kReach);
    }

    /// Like uniform(), but half of the coordinates are uniform themselves, so that all distances from the ends are
    /// equally frequent.
    double hard() {
        if (generator_() % 2 == 0) return uniform();
        return kReach * (generator_() * 0x1p-31 - 1);
    }

private:
    static std::uint64_t start_of(std::uint64_t seed, std::uint64_t index) {
        const auto low = [](std::uint64_t x) { return static_cast<std::uint32_t>(x); };
        const UInt4 hash = pcg4d({low(index), low(index >> 32), low(seed), low(seed >> 32)});
        return (static_cast<std::uint64_t>(hash.x) << 32) | hash.y;
    }

    Pcg32 generator_;
};

/// A random number and a sector between two great circles, like those into which a decentral polygon is cut. The
/// family is complete: a trapezoid with two vertical edges has exactly one sector, and the azimuth at which it starts
/// does not matter.
template <class Real>
struct SectorCase {
    static constexpr std::size_t kDimension = 6;
    static constexpr std::array<const char*, kDimension> kNames = {
        "azimuth_range", "inner_begin", "inner_end", "outer_begin", "outer_end", "u"};
    /// The range of azimuths in radians, the tangents of both circles' elevations at its ends, and the random number.
    std::array<Real, kDimension> parameters;

    /// Ranges reach up to 179.999 degrees, as in the paper.
    static SectorCase at(const std::array<Real, kDimension>& coordinates) {
        const Real inner_begin = std::exp(coordinates[1]);
        const Real inner_end = std::exp(coordinates[2]);
        return {{kPi<Real> * Real(179.999L / 180) * share_of(coordinates[0]), inner_begin, inner_end,
                 inner_begin * share_of(coordinates[3]), inner_end * share_of(coordinates[4]),
                 share_of(coordinates[5])}};
    }

    ConvexPolygon<Real, 4> light() const {
        const auto& [range, inner_begin, inner_end, outer_begin, outer_end, u] = parameters;
        const Real x = std::cos(range);
        const Real y = std::sin(range);
        const Vec3<Real> corners[4] = {
            {1, 0, outer_begin}, {x, y, outer_end}, {x, y, inner_end}, {1, 0, inner_begin}};
        return make_polygon<4>(corners, 4);
    }

    template <int Iterations>
    using Technique = PolygonProjectedSolidAngle<Real, 4, Iterations>;

    template <class Sampler>
    Real error(const Sampler& technique) const {
        // The error of the method does not depend on the inclination.
        const Vec2<Real> u{parameters[5], Real(0.5)};
        return backward_error(technique, u, technique.sample(u).wi);
    }
};

/// A line at distance 1, clipped to the horizon, and a random number.
template <class Real>
struct LineCase {
    static constexpr std::size_t kDimension = 4;
    static constexpr std::array<const char*, kDimension> kNames = {"tilt", "begin", "end", "u"};
    /// The angle between the normal and the plane perpendicular to the line; the angles from the direction of the
    /// closest point to the start and the end; and the random number. Angles are in radians.
    std::array<Real, kDimension> parameters;

    static LineCase at(const std::array<Real, kDimension>& coordinates) {
        // For shorter lines, or lines seen closer to their own axis, the rounding of directions would dominate.
        const Real shortest = Real(1e-3L);
        const Real steepest = kPi<Real> / 2 - Real(1e-6L);
        const Real last_begin = steepest - shortest;
        const Real tilt = (last_begin + kPi<Real> / 2) * share_of(coordinates[0]);
        const Real low = std::fmax(-steepest, tilt - kPi<Real> / 2);
        const Real begin = low + (last_begin - low) * share_of(coordinates[1]);
        const Real first_end = begin + shortest;
        const Real end = first_end + (steepest - first_end) * share_of(coordinates[2]);
        return {{tilt, begin, end, share_of(coordinates[3])}};
    }

    LineSegment<Real> light() const {
        const auto& [tilt, begin, end, u] = parameters;
        const Vec3<Real> s{std::cos(tilt), 0, std::sin(tilt)};
        const Vec3<Real> t{-s.z, 0, s.x};
        return {std::tan(begin) * s + t, s, std::tan(end) - std::tan(begin)};
    }

    template <int Iterations>
    using Technique = LineProjectedSolidAngle<Real, Iterations>;

    template <class Sampler>
    Real error(const Sampler& technique) const {
        const Real u = parameters[3];
        return backward_error(technique, u, technique.sample(u).wi);
    }
};

/// Sectors for the published iteration, which takes two steps. Random numbers keep 1e-4 away from 0 and 1.
/// \tparam LeastTangent of the elevation of the inner circle at both ends, in units of 1e-6.
template <class Real, int LeastTangent>
struct PublishedSectorCase : SectorCase<Real> {
    using Base = SectorCase<Real>;

    static PublishedSectorCase at(const std::array<Real, Base::kDimension>& coordinates) {
        return {Base::at(coordinates)};
    }

    template <int>
    using Technique = PolygonProjectedSolidAnglePeters<Real, 4>;

    /// -infinity for cases that are left out.
    Real error(const Technique<2>& technique) const {
        const auto& [range, inner_begin, inner_end, outer_begin, outer_end, x] = this->parameters;
        const Real lowest = std::fmin(inner_begin, inner_end);
        const Real distance = std::fmin(x, 1 - x);
        if (lowest < Real(1e-6L) * LeastTangent || distance < Real(1e-4L))
            return -std::numeric_limits<Real>::infinity();
        const Vec2<Real> u{x, Real(0.5)};
        const PolygonProjectedSolidAngle<Real, 4> exact(this->light());
        return backward_error(exact, u, technique.sample(u).wi);
    }
};

/// Lines for the published iteration, which takes two steps.
template <class Real>
struct PublishedLineCase : LineCase<Real> {
    using Base = LineCase<Real>;

    static PublishedLineCase at(const std::array<Real, Base::kDimension>& coordinates) {
        return {Base::at(coordinates)};
    }

    template <int>
    using Technique = LineProjectedSolidAnglePeters<Real>;

    /// -infinity for random numbers within 1e-5 of 0 and 1, for which there is no iteration.
    Real error(const Technique<2>& technique) const {
        const Real u = this->parameters[3];
        if (std::fmin(u, 1 - u) < Real(1e-5L)) return -std::numeric_limits<Real>::infinity();
        const LineProjectedSolidAngle<Real> exact(this->light());
        return backward_error(exact, u, technique.sample(u).wi);
    }
};

} // namespace nusselt::proof
