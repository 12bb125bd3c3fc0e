#pragma once
/// A plain transcription of a published method, to compare with: accuracy and cost of the formulas as printed.
///
/// N. Billen, P. Dutre 2016, Line Sampling for Direct Illumination, doi:10.1111/cgf.12948: Sec. 5.3.2 and Appendix B
/// (with the factor that Eq. 14 lacks), and the table of Sec. 6.1. Use phong_integral() instead: this one takes integer
/// exponents only, in time that is linear in them or with the error of the table, and cancels where the line is far from
/// the mirrored direction.

#include <algorithm>
#include <cmath>

#include <nusselt/bsdf/phong.h>
#include <nusselt/geometry/clip_line.h>

NUSSELT_NAMESPACE_BEGIN

/// The integral of cos(u)^n from 0 by the recursion of Eq. 16.
/// \tparam Real float, double or long double.
template <class Real>
class CosinePowerRecursion {
public:
    /// \param exponent at least 0.
    explicit CosinePowerRecursion(int exponent) noexcept : exponent_(exponent) {}

    /// \param u in [-pi / 2, pi / 2].
    Real operator()(const Real& u) const noexcept {
        const Real sine = std::sin(u);
        const Real cosine = std::cos(u);
        const bool odd = exponent_ % 2 != 0;
        Real integral = odd ? sine : u;
        Real power = odd ? cosine * cosine : cosine;
        for (int n = odd ? 3 : 2; n <= exponent_; n += 2) {
            const auto real_n = static_cast<Real>(n);
            integral = (power * sine + (real_n - 1) * integral) / real_n;
            power *= cosine * cosine;
        }
        return integral;
    }

private:
    int exponent_;
};

/// The same, tabulated and interpolated. Points are cubes of equidistant numbers: denser near 0, beyond which high powers
/// vanish.
/// \tparam Points number of intervals of the table.
template <class Real, int Points = 4096>
class CosinePowerTable {
public:
    /// \param exponent at least 0.
    explicit CosinePowerTable(int exponent) noexcept {
        const CosinePowerRecursion<double> recursion(exponent);
        for (int i = 0; i <= Points; ++i) {
            const double x = static_cast<double>(i) / Points;
            values_[i] = static_cast<Real>(recursion(kPi<double> / 2 * x * x * x));
        }
    }

    /// \param u in [-pi / 2, pi / 2].
    Real operator()(const Real& u) const noexcept {
        const Real share = std::fmin(std::fabs(u) / (kPi<Real> / 2), Real(1));
        const int cell = std::min(static_cast<int>(Real(Points) * std::cbrt(share)), Points - 1);
        const Real begin = cube(static_cast<Real>(cell) / Points);
        const Real end = cube(static_cast<Real>(cell + 1) / Points);
        const Real x = (share - begin) / (end - begin);
        return std::copysign(values_[cell] + x * (values_[cell + 1] - values_[cell]), u);
    }

private:
    static Real cube(Real x) noexcept { return x * x * x; }

    Real values_[Points + 1];
};

/// Meaning and parameters as those of phong_integral().
/// \param power CosinePowerRecursion or CosinePowerTable for exponent + 2.
template <class Real, class CosinePower>
Real phong_integral_billen(const LineSegment<Real>& light, const Vec3<Real>& mirror, int exponent,
                           const CosinePower& power) noexcept {
    const auto unit = to_safe_extent(light);
    const LineExtent<Real> e = clipped_extent(unit);
    const Vec3<Real> t = e.inverse_distance() * e.line.closest;
    const Real mirror_s = dot(mirror, e.line.inward);
    const Real mirror_t = dot(mirror, t);
    const Real in_plane = std::hypot(mirror_s, mirror_t);
    if (!e.visible() || !(in_plane > 0) || !(mirror.z > 0)) return 0;
    const Real cosine = mirror_t / in_plane;
    const Real sine = mirror_s / in_plane;
    const Real mirror_angle = std::atan2(sine, cosine);
    Real begin = std::atan2(e.near_sine(), e.near_cosine()) - mirror_angle;
    Real end = std::atan2(e.far_sine(), e.far_cosine()) - mirror_angle;
    const Real turns = begin > kPi<Real> / 2 ? -2 * kPi<Real> : end < -kPi<Real> / 2 ? 2 * kPi<Real> : 0;
    begin = std::fmax(begin + turns, -kPi<Real> / 2);
    end = std::fmin(end + turns, kPi<Real> / 2);
    if (!(begin < end)) return 0;

    // Cosine at the light and with the normal, as a cos(u) + b sin(u) each.
    const Real height = cosine * t.z + sine * e.line.inward.z;
    const Real slope = cosine * e.line.inward.z - sine * t.z;
    const auto n = static_cast<Real>(exponent);
    const Real cos_begin = std::cos(begin);
    const Real cos_end = std::cos(end);
    const Real even = power(end) - power(begin);
    const Real odd = (std::pow(cos_begin, n + 2) - std::pow(cos_end, n + 2)) / (n + 2);
    const Real boundary =
        std::pow(cos_end, n + 1) * std::sin(end) - std::pow(cos_begin, n + 1) * std::sin(begin);
    const Real squared_sines = ((n + 2) * even - boundary) / (n + 1) - even;
    const Real sum =
        cosine * height * even + (cosine * slope - sine * height) * odd - sine * slope * squared_sines;
    return 2 * phong_normalisation(n) * std::pow(in_plane, n) * std::fmax(sum, Real(0)) *
           e.inverse_distance() * unit.scale;
}

NUSSELT_NAMESPACE_END
