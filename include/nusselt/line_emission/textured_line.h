#pragma once
/// Sampling of linear lights whose radiance varies along them, in proportion to radiance times the cosine at the surface, or
/// times a glossy lobe.
///
/// Radiance is interpolated between the centres of texels. From each of them to the next one goes a cell, whose measure is
/// known in closed form (C. Peters 2021, BRDF Importance Sampling for Linear Lights, CGF 40(8), doi:10.1111/cgf.14379). One
/// cell is chosen in proportion to its measure times the mean of radiance at both ends. In the cell, radiance is taken to be
/// a linear function of the measure in place of the length: the density is that function times the cosine or the lobe, and
/// agrees with the product at both ends of each cell. docs/techniques/textured_line.md derives it.

#include <nusselt/core/light_sample.h>
#include <nusselt/emission/cell_lanes.h>
#include <nusselt/emission/lane_index.h>
#include <nusselt/line_emission/line_profile.h>
#include <nusselt/sampling/line_ltc.h>
#include <nusselt/sampling/line_projected_solid_angle.h>

NUSSELT_NAMESPACE_BEGIN

/// A sample on a light whose radiance varies along it.
template <class Real>
struct LineTextureSample : LightSample<Real> {
    Real at; ///< share of the length before p, in [0, 1]. Look up the radiance there
};

/// The measure of cells for diffuse surfaces: projected solid angle per radius. Samples are above the horizon.
template <class Real>
struct ProjectedLines {
    static constexpr scalar_t<Real> kIntegral =
        1 / kPi<scalar_t<Real>>; ///< of the normalised component, over the measure

    NUSSELT_HD auto technique_for(const LineSegment<Real>& part) const noexcept {
        return LineProjectedSolidAngle<Real>(part);
    }
    /// The line in the space where measures are projected solid angles. \param line with coordinates of order one
    NUSSELT_HD LineSegment<Real> image_of(const LineSegment<Real>& line) const noexcept { return line; }
    /// Measures of parts of a line over projected solid angles of their images. \param line with coordinates of order one
    NUSSELT_HD Real ratio_for(const LineSegment<Real>& /*line*/) const noexcept { return Real(1); }
};

/// The measure of cells for glossy surfaces: the integral of a lobe above the horizon, per radius. Samples are not below it.
template <class Real>
struct LobeLines {
    static constexpr scalar_t<Real> kIntegral = 1; ///< \copydoc ProjectedLines::kIntegral
    Ltc<Real> ltc;

    NUSSELT_HD auto technique_for(const LineSegment<Real>& part) const noexcept {
        return LineClippedLtc<Real>(part, ltc);
    }
    /// \copydoc ProjectedLines::image_of
    NUSSELT_HD LineSegment<Real> image_of(const LineSegment<Real>& line) const noexcept {
        return to_cosine_space(line, ltc);
    }
    /// \copydoc ProjectedLines::ratio_for
    NUSSELT_HD Real ratio_for(const LineSegment<Real>& line) const noexcept {
        const Real thicker = Real(kPi<scalar_t<Real>>) * radius_ratio(cross(line.p0, line.s), ltc);
        const Real ratio = Real(1) / select(thicker > Real(0), thicker, Real(1));
        const Real length = centered(to_safe_extent(line)).length;
        const mask_t<Real> finite = is_finite(ratio);
        return select((thicker > Real(0)) & finite & (length > Real(0)), ratio, Real(0));
    }
};

/// \tparam Real    float, double, long double, or a pack with a shading point and its view of the light per lane.
/// \tparam n       as in LineProfile.
/// \tparam Measure ProjectedLines or LobeLines.
/// \tparam Along   LineProfile, or LineNodes for radiance that depends on the direction (line_emission/line_nodes.h).
///
/// Measure: pdf is the density of wi in solid angle times the radius of the cylinder that tends to 0 [m/sr], as that of
/// LineProjectedSolidAngle.
/// Space: shading space; the shading point is the origin, the normal +z. For a lobe, wo is in the xz half-plane.
/// Edge cases: nothing of the light above the horizon or in the lobe, black light, no length, or origin on the infinite line
/// up to rounding: pdf = 0, measure 0. Black parts are never sampled.
template <class Real, int n = 64, class Measure = ProjectedLines<Real>,
          class Along = LineProfile<scalar_t<Real>, n>>
class TexturedLine {
    using T = scalar_t<Real>;
    using Mask = mask_t<Real>;
    using Index = detail::index_t<Real>;
    using Lanes = detail::CellLanes<Real>;

public:
    using Profile = Along;

    /// \param light   in shading space [m].
    /// \param profile has to live as long as this.
    /// \param measure with the lobe, if there is one.
    NUSSELT_HD TexturedLine(const LineSegment<Real>& light, const Profile& profile,
                            const Measure& measure = {}) noexcept
        : profile_(&profile), measure_(measure), safe_(to_safe_extent(light)) {
        // Parts of the line have the same lengths in its image, up to a factor.
        const LineSegment<Real> image = measure_.image_of(safe_.line);
        const Real scale = safe_.scale * measure_.ratio_for(safe_.line);
        lit_ = part_above(safe_.line, part_above(image, {Real(0), Real(1)}));
        using L = typename Lanes::Type;
        const Vec3<L> p0 = broadcast<L>(image.p0);
        const Vec3<L> s = broadcast<L>(image.s);
        Real total = Real(0);
        Vec3<L> expected{L(T(0)), L(T(0)), L(T(0))};
        detail::store_lanes<Real>(sum_, total);
        for (int first = 0; first < profile.cells; first += Lanes::kCount) {
            // Cut the cells to the part that counts.
            const L low = Lanes::load_shared(profile.border + first);
            const L high = Lanes::load_shared(profile.border + first + 1);
            const L begin = min(max(low, L(lit_.begin)), high);
            const L end = max(min(high, L(lit_.end)), begin);
            const L unlimited =
                L(scale) * projected_solid_angle(LineSegment<L>{fma(L(image.length) * begin, s, p0), s,
                                                                L(image.length) * (end - begin)});
            // Those of denormal lines may overflow, and black cells must not turn that into NaN.
            const L share = min(max(unlimited, L(T(0))), L(kLargest));
            // Interpolation at both ends, which takes half of what lies within.
            const L width = select(high > low, high - low, L(T(1)));
            const L last = L(T(0.5)) * ((begin - low) + (end - low)) / width;
            const auto mean = [&](const T* values) {
                return (L(T(1)) - last) * Lanes::load_shared(values + first) +
                       last * Lanes::load_shared(values + first + 1);
            };
            expected.x += share * mean(profile.radiance[0]);
            expected.y += share * mean(profile.radiance[1]);
            expected.z += share * mean(profile.radiance[2]);
            alignas(Real) T weights[Lanes::kCount * Lanes::kPoints];
            Lanes::store(weights, share * mean(profile.value));
            for (int i = 0; i < Lanes::kCount; ++i) {
                total += detail::load_lanes<Real>(weights + Lanes::kPoints * i);
                detail::store_lanes<Real>(sum_ + Lanes::kPoints * (first + i + 1), total);
            }
        }
        const Mask lit = (total > Real(0)) & is_finite(total);
        total_ = select(lit, total, Real(0));
        const auto coefficient = [&](const L& sums) {
            return select(lit, min(Real(Measure::kIntegral) * Lanes::sum(sums), Real(kLargest)), Real(0));
        };
        unshadowed_ = {coefficient(expected.x), coefficient(expected.y), coefficient(expected.z)};
    }

    /// \param u in [0, 1); increasing u moves from the start of the light to its end.
    NUSSELT_HD LineTextureSample<Real> sample(const Real& u) const noexcept {
        const Mask lit = total_ > Real(0);
        const Vec3<Real> up{Real(0), Real(0), Real(1)};
        if (!any(lit)) return {{up, Real(0), up}, Real(0)};
        const Real target = below_one(u) * total_;
        const Cell cell = make_cell(cell_for(target));
        const Real rest = below_one((target - cell.before) / max(cell.after - cell.before, Real(kSmallest)));
        // Invert the distribution of a density that is linear in x.
        const Real both = cell.first + cell.last;
        const Real root =
            sqrt(max(cell.first * cell.first + rest * (cell.last - cell.first) * both, Real(0)));
        const Real x = below_one(rest * both / max(cell.first + root, Real(kSmallest)));
        const LightSample<Real> s = measure_.technique_for(cell.part).sample(x);
        const Real at = min(max(position_of(s.wi), cell.begin), cell.end);
        return {{select(lit, s.wi, up), select(lit, density(cell, x, s.pdf), Real(0)),
                 select(lit, safe_.inverse_scale * s.p, up)},
                select(lit, at, Real(0))};
    }

    /// \param wi a unit direction towards the light.
    NUSSELT_HD Real pdf(const Vec3<Real>& wi) const noexcept {
        return any(total_ > Real(0)) ? pdf_along(wi, position_of(wi)) : Real(0);
    }

    /// The density of the direction to a point of the light [m/sr]. \param at share of the length before it, in [0, 1]
    NUSSELT_HD Real pdf_at(const Real& at) const noexcept {
        return any(total_ > Real(0)) ? pdf_along(normalize(point_at(at)), at) : Real(0);
    }

    /// The random number for which sample() returns wi, a unit direction on the light.
    NUSSELT_HD Real invert(const Vec3<Real>& wi) const noexcept {
        const Mask lit = total_ > Real(0);
        if (!any(lit)) return Real(0);
        const Cell cell = make_cell(cell_at(position_of(wi)));
        const Real x = measure_.technique_for(cell.part).invert(wi);
        const Real both = cell.first + cell.last;
        const Real below = x * (Real(2) * cell.first + x * (cell.last - cell.first));
        const auto bright = both > Real(0);
        const Real rest = select(bright, min(below / select(bright, both, Real(1)), Real(1)), Real(0));
        const Real sum = cell.before + rest * (cell.after - cell.before);
        return select(lit, below_one(sum / select(lit, total_, Real(1))), Real(0));
    }

    /// The sum over cells of mean radiance, averaged over channels, times projected solid angle or the integral of the lobe,
    /// per radius [W/m^3, W/(sr m^3)].
    NUSSELT_HD Real measure() const noexcept { return total_; }

    /// The light that is reflected without shadows per radius and albedo of the component, per channel [W/(sr m^3)]: the
    /// coefficient of heuristics for multiple importance sampling (estimate/mis.h). Exact where the light is constant.
    NUSSELT_HD Vec3<Real> unshadowed() const noexcept { return unshadowed_; }

private:
    static constexpr T kSmallest = std::numeric_limits<T>::min();
    static constexpr T kLargest = std::numeric_limits<T>::max();

    struct Part {
        Real begin, end; ///< shares of the length
    };
    struct Cell {
        LineSegment<Real> part; ///< that counts
        Real begin, end;        ///< shares of the length
        Real first, last;       ///< radiance there
        Real before, after;     ///< sums of weights at the ends
    };

    NUSSELT_HD Vec3<Real> point_at(const Real& at) const noexcept {
        return fma(at * safe_.line.length, safe_.line.s, safe_.line.p0);
    }

    /// What is above the horizon of a part of a line.
    NUSSELT_HD static Part part_above(const LineSegment<Real>& line, const Part& part) noexcept {
        const Real start = line.p0.z;
        const Real end = end_of(line).z;
        const auto none = (start <= Real(0)) & (end <= Real(0));
        const auto rises = (start < Real(0)) & (end > Real(0));
        const auto falls = (start > Real(0)) & (end < Real(0));
        const Real crossing = start / select(rises | falls, start - end, Real(1));
        return {select(none, Real(0), select(rises, max(part.begin, crossing), part.begin)),
                select(none, Real(0), select(falls, min(part.end, crossing), part.end))};
    }

    /// Where a direction meets the line, as a share of its length.
    NUSSELT_HD Real position_of(const Vec3<Real>& wi) const noexcept {
        const CenteredLine<Real> line = centered(safe_);
        const Real ahead = max(dot(wi, line.closest), Real(kSmallest));
        const Real l = min(max(line.squared * (dot(wi, line.inward) / ahead), line.near_l), line.far_l);
        const Real distance = select(line.sign > Real(0), l - line.near_l, line.far_l - l);
        return min(max(distance / safe_.line.length, Real(0)), Real(1));
    }

    /// The cell whose weights reach beyond a sum of weights.
    NUSSELT_HD Index cell_for(const Real& target) const noexcept {
        const int last = profile_->cells - 1;
        const auto is_before = [&](int k) {
            return detail::load_lanes<Real>(sum_ + Lanes::kPoints * (k + 1)) <= target;
        };
        Index cell = 0;
        if constexpr (Lanes::kPoints == 1) {
            while (cell < last && is_before(cell)) ++cell;
        } else {
            for (int k = 0; k < last; ++k) cell += select(is_before(k), Real(1), Real(0));
        }
        return cell;
    }

    /// The cell at a point, or the closest one that is sampled where rounding decides.
    NUSSELT_HD Index cell_at(const Real& at) const noexcept {
        return profile_->cell_at(min(max(at, lit_.begin), lit_.end));
    }

    NUSSELT_HD Cell make_cell(const Index& k) const noexcept {
        const auto place = detail::places<Real>(k, Index(0), 0);
        const Real low = place.load(profile_->border);
        const Real high = place.load(profile_->border + 1);
        const Real value_low = place.load(profile_->value);
        const Real value_high = place.load(profile_->value + 1);
        const Real begin = min(max(low, lit_.begin), high);
        const Real end = max(min(high, lit_.end), begin);
        const auto value = [&](const Real& at) {
            const Real share = (at - low) / (high - low);
            return (Real(1) - share) * value_low + share * value_high;
        };
        return {{point_at(begin), safe_.line.s, safe_.line.length * (end - begin)},
                begin,
                end,
                value(begin),
                value(end),
                place.load_own(sum_),
                place.load_own(sum_ + Lanes::kPoints)};
    }

    /// \param x     random number of the technique for the cell
    /// \param whole density of that technique, in units of the scaled line
    NUSSELT_HD Real density(const Cell& cell, const Real& x, const Real& whole) const noexcept {
        const Real both = cell.first + cell.last;
        const auto lit = (total_ > Real(0)) & (both > Real(0));
        const Real here = (Real(1) - x) * cell.first + x * cell.last;
        const Real probability = (cell.after - cell.before) / select(lit, total_, Real(1));
        const Real density =
            probability * (Real(2) * here / select(lit, both, Real(1))) * whole * safe_.inverse_scale;
        return select(lit & is_finite(density), density, Real(0));
    }

    NUSSELT_HD Real pdf_along(const Vec3<Real>& wi, const Real& at) const noexcept {
        const Cell cell = make_cell(cell_at(at));
        const auto counts = (cell.after > cell.before) & !(wi.z < Real(0));
        if (!any(counts)) return Real(0);
        const auto technique = measure_.technique_for(cell.part);
        return select(counts, density(cell, technique.invert(wi), technique.pdf(wi)), Real(0));
    }

    const Profile* profile_;
    Measure measure_;
    SafeLine<Real> safe_;
    Part lit_;
    alignas(Real) T sum_[Lanes::kPoints * (Profile::kSlots + 1)]; ///< of the weights before each cell
    Real total_;
    Vec3<Real> unshadowed_;
};

/// For glossy surfaces.
template <class Real, int n = 64>
using TexturedLineLtc = TexturedLine<Real, n, LobeLines<Real>>;

NUSSELT_NAMESPACE_END
