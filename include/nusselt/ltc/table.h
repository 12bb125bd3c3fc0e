#pragma once
/// A view of a table of linearly transformed cosines, and its interpolation.

#include <cstdint>

#include <nusselt/core/trig.h>
#include <nusselt/core/vec.h>
#include <nusselt/ltc/coefficients.h>

NUSSELT_NAMESPACE_BEGIN

/// Lobes over perceptual roughness in [0, 1], inclination of wo in [0, pi / 2] and reflectance f0 at normal incidence
/// in [0, 1]. Samples lie on both ends of each axis and in equal steps between: sample i of n is at i / (n - 1) of the
/// range. The view owns nothing.
///
/// Interpolation is linear in each cell, so that there are no seams, and cheap to continue beyond the ends: arguments
/// are clamped, NaN is taken for 0. The entries are chosen such that it keeps narrow lobes in place: where the
/// direction of the peak turns by many times the width of a lobe from one sample to the next, its inclination is
/// interpolated (up to the third power of the step), whatever the widths do.
struct LtcTableView {
    /// The number of floats per sample: m00, m02 (a unit vector together), 1 / m11, -m20, m22, albedo; all at least 0.
    static constexpr int kStride = 6;
    /// Tables have fewer floats than this: float counts them exactly.
    static constexpr std::int64_t kMostFloats = std::int64_t{1} << 24;

    const float* entries; ///< index ((roughness * inclinations + inclination) * f0s + f0) * kStride
    int roughnesses;      ///< numbers of samples, at least 2
    int inclinations;
    int f0s;

    /// \param roughness perceptual.
    /// \param cos_o     cosine of the inclination of wo.
    /// \param f0        one number; coloured ones share a lobe, see albedo().
    /// \returns coefficients between the samples. Between the last two inclinations, BRDFs change within less than a
    ///          cell: the albedo of the shipped tables is off by up to 0.07 there (docs/ltc-tables.md).
    template <class Real>
    NUSSELT_HD LtcCoefficients<Real> lookup(const Real& roughness, const Real& cos_o,
                                            const Real& f0) const noexcept {
        const Axis<Real> r(roughness, roughnesses);
        const Axis<Real> i(inclination(cos_o), inclinations);
        const Axis<Real> f(f0, f0s);
        const int strides[] = {inclinations * f0s * kStride, f0s * kStride, kStride};
        const Offsets<Real> offsets = offsets_of(strides, r.index, i.index, f.index);
        Real entry[kStride] = {Real(0), Real(0), Real(0), Real(0), Real(0), Real(0)};
        for (int corner = 0; corner < 8; ++corner) {
            const int a = corner >> 2, b = corner >> 1 & 1, c = corner & 1;
            const Real weight = r.weight(a) * i.weight(b) * f.weight(c);
            const int shift = a * strides[0] + b * strides[1] + c * strides[2];
            for (int k = 0; k < kStride; ++k)
                entry[k] = fma(weight, offsets.load(entries + shift + k), entry[k]);
        }
        return {entry[0], entry[1], Real(1) / entry[2], -entry[3], entry[4], entry[5]};
    }

    /// Albedo for a coloured f0, of BRDFs that are linear in f0 (as all with Schlick's approximation are): the same as
    /// that of lookup(), at less cost.
    template <class Real>
    NUSSELT_HD Vec3<Real> albedo(const Real& roughness, const Real& cos_o,
                                 const Vec3<Real>& f0) const noexcept {
        const Axis<Real> r(roughness, roughnesses);
        const Axis<Real> i(inclination(cos_o), inclinations);
        const int strides[] = {inclinations * f0s * kStride, f0s * kStride, 0};
        const Offsets<Real> offsets = offsets_of(strides, r.index, i.index, Real(0));
        const int last = (f0s - 1) * kStride;
        Real of_black(0), of_white(0);
        for (int corner = 0; corner < 4; ++corner) {
            const int a = corner >> 1, b = corner & 1;
            const Real weight = r.weight(a) * i.weight(b);
            const float* albedos = entries + a * strides[0] + b * strides[1] + kStride - 1;
            of_black = fma(weight, offsets.load(albedos), of_black);
            of_white = fma(weight, offsets.load(albedos + last), of_white);
        }
        const auto mixed = [&](const Real& x) {
            const Real f = min(max(x, Real(0)), Real(1));
            return fma(f, of_white, (Real(1) - f) * of_black);
        };
        return {mixed(f0.x), mixed(f0.y), mixed(f0.z)};
    }

private:
    /// Inclination over pi / 2.
    template <class Real>
    NUSSELT_HD static Real inclination(const Real& cos_o) noexcept {
        const Real c = min(max(cos_o, Real(0)), Real(1));
        return atan2_positive(sqrt((Real(1) - c) * (Real(1) + c)), c) * Real(2 / kPi<scalar_t<Real>>);
    }

    /// The cell of a coordinate, and the weights of its two ends.
    template <class Real>
    struct Axis {
        NUSSELT_HD Axis(const Real& position, int samples) noexcept {
            const Real x = min(max(position, Real(0)), Real(1)) * Real(samples - 1);
            index = min(floor(x), Real(samples - 2));
            fraction = x - index;
        }
        NUSSELT_HD Real weight(int end) const noexcept { return end == 0 ? Real(1) - fraction : fraction; }

        Real index;
        Real fraction;
    };

    /// The offsets of the entries of each lane.
    template <class Real>
    struct Offsets {
        static constexpr int kLanes = RealTraits<Real>::kLanes;
        std::int32_t lane[kLanes];

        NUSSELT_HD Real load(const float* base) const noexcept {
            if constexpr (kLanes == 1) {
                return Real(base[lane[0]]);
            } else if constexpr (kIsSingle<Real>) {
                return Real::gather(base, lane);
            } else {
                scalar_t<Real> values[kLanes];
                for (int i = 0; i < kLanes; ++i) values[i] = base[lane[i]];
                return Real::load(values);
            }
        }
    };

    template <class Real>
    NUSSELT_HD static Offsets<Real> offsets_of(const int (&strides)[3], const Real& a, const Real& b,
                                               const Real& c) noexcept {
        Offsets<Real> result;
        const Real offset = a * Real(strides[0]) + b * Real(strides[1]) + c * Real(strides[2]);
        if constexpr (Offsets<Real>::kLanes == 1) {
            result.lane[0] = static_cast<std::int32_t>(offset);
        } else {
            scalar_t<Real> values[Offsets<Real>::kLanes];
            offset.store(values);
            for (int i = 0; i < Offsets<Real>::kLanes; ++i)
                result.lane[i] = static_cast<std::int32_t>(values[i]);
        }
        return result;
    }
};

NUSSELT_NAMESPACE_END
