#pragma once
/// Offsets of line samples by what the surface would reflect of their lines without shadows.
///
/// K. Salesin, W. Jarosz 2019, Combining Point and Line Samples for Direct Illumination, doi:10.1111/cgf.13779, add point
/// samples where densities of lines by length miss highlights. Deviation: the integrals along unshadowed lines, which have
/// closed forms, are tabulated, and offsets drawn from the table: they stay stratified in one dimension.

#include <nusselt/estimate/line_light.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real  float, double, long double or a pack: a line per lane, of one light and surface point.
/// \tparam N     bound on the number of vertices of the light.
/// \tparam Nodes of the table, a power of two, even ones; half as many are added around highlights that are narrower than
///               the distance of two. Each costs as much as a line without shadows.
template <class Real, int N, int Nodes = 32>
class ReflectedOffsets {
    static_assert(Nodes >= 4 && (Nodes & (Nodes - 1)) == 0,
                  "for the search by halves and the roots of place_nodes()");
    using Scalar = scalar_t<Real>;
    static constexpr int kLanes = RealTraits<Real>::kLanes;
    static constexpr int kPeakNodes = Nodes / 2; ///< the same on both sides
    static constexpr int kMostNodes = Nodes + kPeakNodes;

public:
    /// The same family and light in all lanes.
    /// \param family must outlive the object.
    template <class Brdf>
    NUSSELT_HD ReflectedOffsets(const LineFamily<Real, N>& family,
                                const LineLight<Real, Brdf>& light) noexcept
        : family_(family) {
        place_nodes(light.peak(family.offsets()));
        for (int begin = 0; begin <= cells_; begin += kLanes) {
            Scalar lanes[kLanes];
            for (int i = 0; i < kLanes; ++i) lanes[i] = node_[begin + i < cells_ ? begin + i : cells_];
            store(relative_radiance(light, load(lanes)), lanes);
            for (int i = 0; i < kLanes && begin + i <= cells_; ++i) density_[begin + i] = lanes[i];
        }
        // Whatever the table misses is sampled by length, and all of lights that are next to black.
        const Scalar mean = integrate();
        const bool is_lit = mean > kTiny<Scalar> && mean <= std::numeric_limits<Scalar>::max();
        const Scalar scale = is_lit ? Scalar(1) / mean : Scalar(0);
        for (int i = 0; i <= cells_; ++i)
            density_[i] = is_lit ? fma(density_[i], scale, Scalar(kLeastShare)) : Scalar(1);
        integrate();
    }

    /// \param u in [0, 1); increasing u increases the offset.
    NUSSELT_HD LineChoice<Real> sample(const Real& u) const noexcept {
        const Real target = u * Real(below_[cells_]);
        const Cell cell = cell_of(target);
        const Real width = cell.end - cell.begin;
        const Real rest = max(target - cell.below, Real(0)) / width;
        const Real rise = cell.right - cell.left;
        const Real root = sqrt(max(fma(Real(2) * rise, rest, cell.left * cell.left), Real(0)));
        const Real share = min(Real(2) * rest / (cell.left + root), Real(1));
        const LineChoice<Real> by_length = family_.sample_by_length(below_one(fma(share, width, cell.begin)));
        const Real density = fma(share, rise, cell.left) * Real(Scalar(1) / below_[cells_]);
        return {by_length.offset, by_length.pdf * density};
    }

private:
    /// This share of the mean of the table is added everywhere: what is between two nodes has about that share of its
    /// density by length, and all else loses no more than that.
    static constexpr double kLeastShare = 0.1;

    /// Nodes at the ends of the light are moved inside by this share of its area: the first and the last line may have no
    /// length.
    static constexpr double kInset = 1e-3;

    /// The narrowest highlight whose flanks get nodes, as a share of the light: single precision still distinguishes them. A
    /// narrower one gets a node at its centre, or nodes on both sides would miss lobes without tails.
    static constexpr double kNarrowest = 1e-5;

    /// Between two nodes.
    struct Cell {
        Real begin, end, below, left, right;
    };

    NUSSELT_HD void place_nodes(const LinePeak<Real>& peak) noexcept {
        constexpr Scalar kSpacing = Scalar(1) / Scalar(Nodes - 1);
        const Scalar centre = first_lane(family_.invert_by_length(peak.offset));
        // The density would not do: it is 0 at the tips of lights.
        const Scalar width =
            first_lane(Real(Scalar(0.5)) * (family_.invert_by_length(peak.offset + peak.width) -
                                            family_.invert_by_length(peak.offset - peak.width)));
        Scalar around[kPeakNodes];
        // False for NaN.
        const bool has_peak = width < kSpacing && centre >= 0;
        if (has_peak) {
            // Distances grow in proportion to themselves, from half the width to the spacing of the others.
            Scalar distance = Scalar(0.5) * max(width, Scalar(kNarrowest));
            Scalar ratio = kSpacing / distance;
            for (int nodes = kPeakNodes / 2; nodes > 1; nodes /= 2) ratio = sqrt(ratio);
            for (int i = 0; i < kPeakNodes / 2; ++i, distance *= ratio) {
                around[kPeakNodes / 2 - 1 - i] = centre - distance;
                around[kPeakNodes / 2 + i] = centre + distance;
            }
            if (width < Scalar(kNarrowest)) around[kPeakNodes / 2 - 1] = centre;
        }
        int next = has_peak ? 0 : kPeakNodes;
        while (next < kPeakNodes && !(around[next] > 0)) ++next;
        int count = 0;
        for (int i = 0; i < Nodes; ++i) {
            const Scalar even = static_cast<Scalar>(i) / static_cast<Scalar>(Nodes - 1);
            while (next < kPeakNodes && around[next] < even) node_[count++] = around[next++];
            if (next < kPeakNodes && around[next] == even) ++next;
            node_[count++] = even;
        }
        cells_ = count - 1;
    }

    /// \returns the integral from 0 to 1
    NUSSELT_HD Scalar integrate() noexcept {
        below_[0] = 0;
        for (int i = 0; i < cells_; ++i)
            below_[i + 1] =
                below_[i] + Scalar(0.5) * (density_[i] + density_[i + 1]) * (node_[i + 1] - node_[i]);
        return below_[cells_];
    }

    NUSSELT_HD Cell cell_of(const Real& target) const noexcept {
        Scalar lanes[kLanes], begin[kLanes], end[kLanes], below[kLanes], left[kLanes], right[kLanes];
        store(target, lanes);
        for (int i = 0; i < kLanes; ++i) {
            int cell = 0;
            for (int step = Nodes; step > 0; step /= 2)
                if (cell + step < cells_ && below_[cell + step] <= lanes[i]) cell += step;
            begin[i] = node_[cell];
            end[i] = node_[cell + 1];
            below[i] = below_[cell];
            left[i] = density_[cell];
            right[i] = density_[cell + 1];
        }
        return {load(begin), load(end), load(below), load(left), load(right)};
    }

    NUSSELT_HD static Scalar first_lane(const Real& x) noexcept {
        Scalar lanes[kLanes];
        store(x, lanes);
        return lanes[0];
    }
    NUSSELT_HD static Real load(const Scalar* lanes) noexcept {
        if constexpr (kLanes == 1)
            return lanes[0];
        else
            return Real::load(lanes);
    }
    NUSSELT_HD static void store(const Real& x, Scalar* lanes) noexcept {
        if constexpr (kLanes == 1)
            lanes[0] = x;
        else
            x.store(lanes);
    }

    /// The radiance that a line sampled by length would add, without shadows.
    /// \param u random number of the line, beyond [0, 1] the same as at its end
    template <class Brdf>
    NUSSELT_HD Real relative_radiance(const LineLight<Real, Brdf>& light, const Real& u) const noexcept {
        const Real inside = min(max(u, Real(Scalar(kInset))), Real(Scalar(1 - kInset)));
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
    int cells_;                  ///< number of nodes less one
    Scalar node_[kMostNodes];    ///< random numbers of sample_by_length(), increasing from 0 to 1
    Scalar density_[kMostNodes]; ///< of that number, not normalised
    Scalar below_[kMostNodes];   ///< its integral from 0 to the node
};

NUSSELT_NAMESPACE_END
