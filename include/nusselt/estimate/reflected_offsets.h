#pragma once
/// Offsets of line samples by what the surface would reflect of their lines without shadows.
///
/// K. Salesin, W. Jarosz 2019, Combining Point and Line Samples for Direct Illumination, doi:10.1111/cgf.13779, add point
/// samples where densities of lines by length miss highlights. Deviation: the integrals along unshadowed lines, which have
/// closed forms, are tabulated, and offsets drawn from the table: they stay stratified in one dimension.

#include <nusselt/estimate/line_light.h>
#include <nusselt/sampling/piecewise_linear.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real  float, double, long double or a pack: a line per lane, of one light and surface point.
/// \tparam N     bound on the number of vertices of the light.
/// \tparam Nodes of the table: narrower highlights than the distance between two of them are left to chance.
template <class Real, int N, int Nodes = 32>
class ReflectedOffsets {
    using Scalar = scalar_t<Real>;
    static constexpr int kLanes = RealTraits<Real>::kLanes;

public:
    /// The same family and light in all lanes.
    /// \param family must outlive the object.
    template <class Brdf>
    NUSSELT_HD ReflectedOffsets(const LineFamily<Real, N>& family,
                                const LineLight<Real, Brdf>& light) noexcept
        : family_(family) {
        Scalar value[Nodes];
        Scalar sum = 0;
        for (int begin = 0; begin < Nodes; begin += kLanes) {
            Real x = Real(0);
            for (int i = 0; i < kLanes; ++i) {
                const int node = begin + i < Nodes ? begin + i : Nodes - 1;
                set_lane(x, i, Table::node(node));
            }
            const Real reflected = relative_radiance(light, x);
            for (int i = 0; i < kLanes && begin + i < Nodes; ++i) {
                value[begin + i] = lane_of(reflected, i);
                sum += value[begin + i];
            }
        }
        // Whatever the table misses is sampled by length.
        const Scalar least = sum > 0 ? sum * Scalar(kLeastShare / Nodes) : Scalar(1);
        Real density[Nodes];
        for (int i = 0; i < Nodes; ++i) density[i] = Real(value[i] + least);
        table_ = Table(density);
    }

    /// \param u in [0, 1); increasing u increases the offset.
    NUSSELT_HD LineChoice<Real> sample(const Real& u) const noexcept {
        const Real x = below_one(table_.invert(u));
        const LineChoice<Real> by_length = family_.sample_by_length(x);
        return {by_length.offset, by_length.pdf * (table_.value(x) / table_.integral())};
    }

private:
    using Table = PiecewiseLinear<Real, Nodes>;

    /// Of the mean of the table, everywhere.
    static constexpr double kLeastShare = 0.1;

    NUSSELT_HD static void set_lane(Real& x, int lane, Scalar value) noexcept {
        if constexpr (kLanes == 1)
            x = value;
        else
            x.set_lane(lane, value);
    }
    NUSSELT_HD static Scalar lane_of(const Real& x, int lane) noexcept {
        if constexpr (kLanes == 1)
            return x;
        else
            return x.lane(lane);
    }

    /// What a line sampled by length would add, without shadows. \param x random number of the line
    template <class Brdf>
    NUSSELT_HD Real relative_radiance(const LineLight<Real, Brdf>& light, const Real& x) const noexcept {
        // The first and the last line of a light may have no length.
        const Real inside = min(max(x, Real(Scalar(1e-3))), Real(Scalar(1 - 1e-3)));
        const LineChoice<Real> choice = family_.sample_by_length(inside);
        Interval<Real> whole[1];
        VisibleParts<Real> parts(whole, 1);
        parts.reset(family_.chord(choice.offset).extent);
        const BrdfComponents<Real> reflected = light.analytic(choice.offset, parts);
        const Vec3<Real> sum = reflected.diffuse + reflected.specular;
        const auto lit = choice.pdf > Real(0);
        return select(lit, (sum.x + sum.y + sum.z) / select(lit, choice.pdf, Real(1)), Real(0));
    }

    const LineFamily<Real, N>& family_;
    Table table_;
};

NUSSELT_NAMESPACE_END
