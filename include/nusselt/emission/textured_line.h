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
#include <nusselt/emission/line_profile.h>
#include <nusselt/sampling/line_ltc.h>
#include <nusselt/sampling/line_projected_solid_angle.h>

NUSSELT_NAMESPACE_BEGIN

/// A sample on a light whose radiance varies along it.
template <class Real>
struct LineTextureSample : LightSample<Real> {
    Real at; ///< share of the length before p, in [0, 1]. Look up the radiance there
};

/// The measure of cells for diffuse surfaces: projected solid angle per radius. Samples are above the horizon.
template <class T>
struct ProjectedLines {
    static constexpr T kIntegral = 1 / kPi<T>; ///< of the normalised component, over the measure

    NUSSELT_HD auto technique_for(const LineSegment<T>& part) const noexcept {
        return LineProjectedSolidAngle<T>(part);
    }
    /// The line in the space where measures are projected solid angles. \param line with coordinates of order one
    NUSSELT_HD LineSegment<T> image_of(const LineSegment<T>& line) const noexcept { return line; }
    /// Measures of parts of a line over projected solid angles of their images. \param line with coordinates of order one
    NUSSELT_HD T ratio_for(const LineSegment<T>& /*line*/) const noexcept { return T(1); }
};

/// The measure of cells for glossy surfaces: the integral of a lobe above the horizon, per radius. Samples are not below it.
template <class T>
struct LobeLines {
    static constexpr T kIntegral = 1; ///< \copydoc ProjectedLines::kIntegral
    Ltc<T> ltc;

    NUSSELT_HD auto technique_for(const LineSegment<T>& part) const noexcept {
        return LineClippedLtc<T>(part, ltc);
    }
    /// \copydoc ProjectedLines::image_of
    NUSSELT_HD LineSegment<T> image_of(const LineSegment<T>& line) const noexcept {
        return to_cosine_space(line, ltc);
    }
    /// \copydoc ProjectedLines::ratio_for
    NUSSELT_HD T ratio_for(const LineSegment<T>& line) const noexcept {
        const T thicker = kPi<T> * radius_ratio(cross(line.p0, line.s), ltc);
        const T ratio = T(1) / thicker;
        return thicker > T(0) && is_finite(ratio) && centered(to_safe_extent(line)).length > T(0) ? ratio
                                                                                                  : T(0);
    }
};

/// \tparam T       float, double or long double. One light and shading point at a time: cells are lanes.
/// \tparam n       as in LineProfile.
/// \tparam Measure ProjectedLines or LobeLines.
///
/// Measure: pdf is the density of wi in solid angle times the radius of the cylinder that tends to 0 [m/sr], as that of
/// LineProjectedSolidAngle.
/// Space: shading space; the shading point is the origin, the normal +z. For a lobe, wo is in the xz half-plane.
/// Edge cases: nothing of the light above the horizon or in the lobe, black light, no length, or origin on the infinite line
/// up to rounding: pdf = 0, measure 0. Black parts are never sampled.
template <class T, int n = 64, class Measure = ProjectedLines<T>>
class TexturedLine {
public:
    using Profile = LineProfile<T, n>;

    /// \param light   in shading space [m].
    /// \param profile has to live as long as this.
    /// \param measure with the lobe, if there is one.
    NUSSELT_HD TexturedLine(const LineSegment<T>& light, const Profile& profile,
                            const Measure& measure = {}) noexcept
        : profile_(&profile), measure_(measure), safe_(to_safe_extent(light)) {
        // Parts of the line have the same lengths in its image, up to a factor.
        const LineSegment<T> image = measure_.image_of(safe_.line);
        const T scale = safe_.scale * measure_.ratio_for(safe_.line);
        lit_ = part_above(safe_.line, part_above(image, {T(0), T(1)}));
        using Lanes = detail::CellLanes<T>;
        using L = typename Lanes::Type;
        T total = T(0);
        Vec3<T> expected{T(0), T(0), T(0)};
        const Vec3<L> p0 = broadcast<L>(image.p0);
        const Vec3<L> s = broadcast<L>(image.s);
        for (int first = 0; first < profile.cells; first += Lanes::kCount) {
            // Cut the cells to the part that counts.
            const L low = Lanes::load(profile.border + first);
            const L high = Lanes::load(profile.border + first + 1);
            const L begin = min(max(low, L(lit_.begin)), high);
            const L end = max(min(high, L(lit_.end)), begin);
            const L length = L(image.length) * (end - begin);
            const L angles =
                projected_solid_angle(LineSegment<L>{fma(L(image.length) * begin, s, p0), s, length});
            T share[Lanes::kCount], from[Lanes::kCount], to[Lanes::kCount];
            const L inverse = L(T(1)) / select(high > low, high - low, L(T(1)));
            Lanes::store(share, L(scale) * angles);
            Lanes::store(from, (begin - low) * inverse);
            Lanes::store(to, (end - low) * inverse);
            for (int i = 0; i < Lanes::kCount; ++i) {
                const int k = first + i;
                // Interpolation at both ends, which takes half of what lies within.
                const T last = T(0.5) * (from[i] + to[i]);
                const T mean = (T(1) - last) * profile.value[k] + last * profile.value[k + 1];
                const T weight = share[i] * mean;
                total += weight > T(0) ? weight : T(0);
                sum_[k] = total;
                expected += share[i] * ((T(1) - last) * profile.radiance[k] + last * profile.radiance[k + 1]);
            }
        }
        total_ = total > T(0) && is_finite(total) ? total : T(0);
        unshadowed_ = total_ > T(0) ? Measure::kIntegral * expected : Vec3<T>{T(0), T(0), T(0)};
    }

    /// \param u in [0, 1); increasing u moves from the start of the light to its end.
    NUSSELT_HD LineTextureSample<T> sample(const T& u) const noexcept {
        if (!(total_ > T(0))) return none();
        const T target = below_one(u) * total_;
        int k = 0;
        while (k < profile_->cells - 1 && sum_[k] <= target) ++k;
        const Cell cell = make_cell(k);
        const T rest = below_one((target - before(k)) / max(sum_[k] - before(k), kSmallest));
        // Invert the distribution of a density that is linear in x.
        const T both = cell.first + cell.last;
        const T root = sqrt(max(cell.first * cell.first + rest * (cell.last - cell.first) * both, T(0)));
        const T x = below_one(rest * both / max(cell.first + root, kSmallest));
        const auto technique = measure_.technique_for(cell.part);
        const LightSample<T> s = technique.sample(x);
        const T at = min(max(position_of(s.wi), cell.begin), cell.end);
        return {{s.wi, density(cell, x, s.pdf), safe_.inverse_scale * s.p}, at};
    }

    /// \param wi a unit direction towards the light.
    NUSSELT_HD T pdf(const Vec3<T>& wi) const noexcept {
        return total_ > T(0) ? pdf_along(wi, position_of(wi)) : T(0);
    }

    /// The density of the direction to a point of the light [m/sr]. \param at share of the length before it, in [0, 1]
    NUSSELT_HD T pdf_at(const T& at) const noexcept {
        return total_ > T(0) ? pdf_along(normalize(point_at(at)), at) : T(0);
    }

    /// The random number for which sample() returns wi, a unit direction on the light.
    NUSSELT_HD T invert(const Vec3<T>& wi) const noexcept {
        if (!(total_ > T(0))) return T(0);
        const int k = cell_at(position_of(wi));
        const Cell cell = make_cell(k);
        const T x = measure_.technique_for(cell.part).invert(wi);
        const T both = cell.first + cell.last;
        const T below = x * (T(2) * cell.first + x * (cell.last - cell.first));
        const T rest = both > T(0) ? min(below / both, T(1)) : T(0);
        return below_one((before(k) + rest * (sum_[k] - before(k))) / total_);
    }

    /// The sum over cells of mean radiance, averaged over channels, times projected solid angle or the integral of the lobe,
    /// per radius [W/m^3, W/(sr m^3)].
    NUSSELT_HD T measure() const noexcept { return total_; }

    /// The light that is reflected without shadows per radius and albedo of the component, per channel [W/(sr m^3)]: the
    /// coefficient of heuristics for multiple importance sampling (estimate/mis.h). Exact where the light is constant.
    NUSSELT_HD Vec3<T> unshadowed() const noexcept { return unshadowed_; }

private:
    static constexpr T kSmallest = std::numeric_limits<T>::min();

    struct Part {
        T begin, end; ///< shares of the length
    };
    struct Cell {
        LineSegment<T> part; ///< that counts
        T begin, end;        ///< shares of the length
        T first, last;       ///< radiance there
        T probability;
    };

    NUSSELT_HD static LineTextureSample<T> none() noexcept {
        const Vec3<T> up{T(0), T(0), T(1)};
        return {{up, T(0), up}, T(0)};
    }

    NUSSELT_HD Vec3<T> point_at(const T& at) const noexcept {
        return fma(at * safe_.line.length, safe_.line.s, safe_.line.p0);
    }

    /// What is above the horizon of a part of a line.
    NUSSELT_HD static Part part_above(const LineSegment<T>& line, const Part& part) noexcept {
        const T start = line.p0.z;
        const T end = end_of(line).z;
        if (start <= T(0) && end <= T(0)) return {T(0), T(0)};
        if (start >= T(0) && end >= T(0)) return part;
        const T crossing = start / (start - end);
        return start < T(0) ? Part{max(part.begin, crossing), part.end}
                            : Part{part.begin, min(part.end, crossing)};
    }

    /// Where a direction meets the line, as a share of its length.
    NUSSELT_HD T position_of(const Vec3<T>& wi) const noexcept {
        const CenteredLine<T> line = centered(safe_);
        const T ahead = max(dot(wi, line.closest), kSmallest);
        const T l = min(max(line.squared * (dot(wi, line.inward) / ahead), line.near_l), line.far_l);
        const T distance = line.sign > T(0) ? l - line.near_l : line.far_l - l;
        return min(max(distance / safe_.line.length, T(0)), T(1));
    }

    NUSSELT_HD T before(int k) const noexcept { return k > 0 ? sum_[k - 1] : T(0); }

    /// The cell at a point, or the closest one that is sampled where rounding decides.
    NUSSELT_HD int cell_at(const T& at) const noexcept {
        return profile_->cell_at(min(max(at, lit_.begin), lit_.end));
    }

    NUSSELT_HD Cell make_cell(int k) const noexcept {
        const T low = profile_->border[k];
        const T high = profile_->border[k + 1];
        const T begin = min(max(low, lit_.begin), high);
        const T end = max(min(high, lit_.end), begin);
        const auto value = [&](const T& at) {
            const T share = (at - low) / (high - low);
            return (T(1) - share) * profile_->value[k] + share * profile_->value[k + 1];
        };
        return {{point_at(begin), safe_.line.s, safe_.line.length * (end - begin)},
                begin,
                end,
                value(begin),
                value(end),
                (sum_[k] - before(k)) / total_};
    }

    /// \param x     random number of the technique for the cell
    /// \param whole density of that technique, in units of the scaled line
    NUSSELT_HD T density(const Cell& cell, const T& x, const T& whole) const noexcept {
        const T both = cell.first + cell.last;
        if (!(both > T(0))) return T(0);
        const T here = (T(1) - x) * cell.first + x * cell.last;
        const T density = cell.probability * (T(2) * here / both) * whole * safe_.inverse_scale;
        return is_finite(density) ? density : T(0);
    }

    NUSSELT_HD T pdf_along(const Vec3<T>& wi, const T& at) const noexcept {
        const Cell cell = make_cell(cell_at(at));
        if (!(cell.probability > T(0)) || wi.z < T(0)) return T(0);
        const auto technique = measure_.technique_for(cell.part);
        return density(cell, technique.invert(wi), technique.pdf(wi));
    }

    const Profile* profile_;
    Measure measure_;
    SafeLine<T> safe_;
    Part lit_;
    T sum_[Profile::kSlots]; ///< of weights up to each cell
    T total_;
    Vec3<T> unshadowed_;
};

/// For glossy surfaces.
template <class T, int n = 64>
using TexturedLineLtc = TexturedLine<T, n, LobeLines<T>>;

NUSSELT_NAMESPACE_END
