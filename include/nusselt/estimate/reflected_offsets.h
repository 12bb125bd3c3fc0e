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
/// \tparam Nodes of the table, a power of two, closer to each other near the peak of the lobe. Each costs as much as a line
///               without shadows.
template <class Real, int N, int Nodes = 32>
class ReflectedOffsets {
    static_assert(Nodes >= 4 && (Nodes & (Nodes - 1)) == 0, "for the search by halves and the root of the ratio");
    using Scalar = scalar_t<Real>;
    static constexpr int kLanes = RealTraits<Real>::kLanes;
    static constexpr int kCells = Nodes - 1;

public:
    /// The same family and light in all lanes.
    /// \param family must outlive the object.
    template <class Brdf>
    NUSSELT_HD ReflectedOffsets(const LineFamily<Real, N>& family,
                                const LineLight<Real, Brdf>& light) noexcept
        : family_(family) {
        place_nodes(light.peak(family.offsets()));
        for (int begin = 0; begin < Nodes; begin += kLanes) {
            Scalar lanes[kLanes];
            for (int i = 0; i < kLanes; ++i) lanes[i] = node_[begin + i < kCells ? begin + i : kCells];
            store(relative_radiance(light, load(lanes)), lanes);
            for (int i = 0; i < kLanes && begin + i < Nodes; ++i) density_[begin + i] = lanes[i];
        }
        // Whatever the table misses is sampled by length, and all of lights that are next to black.
        const Scalar mean = integrate();
        const bool is_lit = mean > kTiny<Scalar> && mean <= std::numeric_limits<Scalar>::max();
        const Scalar scale = is_lit ? Scalar(1) / mean : Scalar(0);
        for (Scalar& density : density_)
            density = is_lit ? fma(density, scale, Scalar(kLeastShare)) : Scalar(1);
        integrate();
    }

    /// \param u in [0, 1); increasing u increases the offset.
    NUSSELT_HD LineChoice<Real> sample(const Real& u) const noexcept {
        const Real target = u * Real(below_[kCells]);
        const Cell cell = cell_of(target);
        const Real width = cell.end - cell.begin;
        const Real rest = max(target - cell.below, Real(0)) / width;
        const Real rise = cell.right - cell.left;
        const Real root = sqrt(max(fma(Real(2) * rise, rest, cell.left * cell.left), Real(0)));
        const Real share = min(Real(2) * rest / (cell.left + root), Real(1));
        const LineChoice<Real> by_length =
            family_.sample_by_length(below_one(fma(share, width, cell.begin)));
        const Real density = fma(share, rise, cell.left) * Real(Scalar(1) / below_[kCells]);
        return {by_length.offset, by_length.pdf * density};
    }

private:
    /// Of the mean of the table, everywhere: what is between two nodes has about that share of its density by length, and
    /// all else loses no more than that.
    static constexpr double kLeastShare = 0.1;

    /// Nodes at the ends of the light are moved inside by this share of its area: the first and the last line may have no
    /// length.
    static constexpr double kInset = 1e-5;

    /// The narrowest peak that gets nodes of its own, as a share of the light: single precision still tells them apart.
    static constexpr double kNarrowest = 1e-4;

    /// Nodes for wider peaks are even, and their differences would only lose digits.
    static constexpr double kWidest = 8;

    /// Between two nodes.
    struct Cell {
        Real begin, end, below, left, right;
    };

    /// With distances to the peak that grow like a hyperbolic sine: even inside the peak, in proportion to themselves
    /// outside, even everywhere if the peak is as wide as the light.
    NUSSELT_HD void place_nodes(const LinePeak<Real>& peak) noexcept {
        const Scalar at_peak = first_lane(family_.invert_by_length(peak.offset));
        const Scalar relative_width = first_lane(peak.width * family_.pdf_by_length(peak.offset));
        // Comparisons that are false for NaN.
        const Scalar centre = at_peak > 0 ? at_peak : Scalar(0);
        const Scalar width =
            relative_width < Scalar(kWidest) ? max(relative_width, Scalar(kNarrowest)) : Scalar(kWidest);
        const auto growth = [&](Scalar distance) {
            const Scalar x = distance / width;
            return x + sqrt(fma(x, x, Scalar(1)));
        };
        const Scalar before = growth(centre);
        Scalar ratio = before * growth(1 - centre);
        for (int cells = Nodes; cells > 1; cells /= 2) ratio = sqrt(ratio);
        Scalar power = Scalar(1) / before;
        for (int i = 0; i < Nodes; ++i, power *= ratio)
            node_[i] = fma(Scalar(0.5) * width, power - Scalar(1) / power, centre);
        node_[0] = 0;
        node_[kCells] = 1;
    }

    /// \returns the integral from 0 to 1
    NUSSELT_HD Scalar integrate() noexcept {
        below_[0] = 0;
        for (int i = 0; i < kCells; ++i)
            below_[i + 1] = below_[i] +
                            Scalar(0.5) * (density_[i] + density_[i + 1]) * (node_[i + 1] - node_[i]);
        return below_[kCells];
    }

    NUSSELT_HD Cell cell_of(const Real& target) const noexcept {
        Scalar lanes[kLanes], begin[kLanes], end[kLanes], below[kLanes], left[kLanes], right[kLanes];
        store(target, lanes);
        for (int i = 0; i < kLanes; ++i) {
            int cell = 0;
            for (int step = Nodes / 2; step > 0; step /= 2)
                cell += below_[cell + step] <= lanes[i] ? step : 0;
            cell = cell < kCells ? cell : kCells - 1;
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

    /// What a line sampled by length would add, without shadows.
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
    Scalar node_[Nodes];    ///< random numbers of sample_by_length()
    Scalar density_[Nodes]; ///< of that number, not normalised
    Scalar below_[Nodes];   ///< its integral from 0 to the node
};

NUSSELT_NAMESPACE_END
