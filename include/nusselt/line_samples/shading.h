#pragma once
/// What parts of the lines of a planar light contribute to diffuse and glossy surfaces, in closed form.
///
/// Along a line, the cosine at the light over the distance is constant up to one more cosine: a part of a line is a
/// linear light, times half the cosine at the light in the closest point of the infinite line. So the integrals per
/// radius of linear lights do it all (Billen and Dutre 2016, Eq. 20, in the end-point form of clip_line.h; the printed
/// equation cancels for short and distant parts, and has an error).
///
/// All functions return radiance per metre of offset for a light of radiance 1 and a lobe of albedo 1 [1/m]: the
/// integral over the offsets, for visible parts, is the radiance that is reflected. They are accurate relative to
/// themselves, apart from what the rounding of the light's position relative to the shading point does.
/// estimate/line_light.h has whole estimators for the surfaces of the renderer.

#include <nusselt/line_samples/line_family.h>
#include <nusselt/ltc/line_shading.h>

NUSSELT_NAMESPACE_BEGIN

/// Lights that shine where their normal points to.
struct FrontSide {
    template <class Real>
    NUSSELT_HD static Real lit(const Real& cosine) noexcept {
        return max(cosine, Real(0));
    }
};

/// Lights that shine to both sides.
struct BothSides {
    template <class Real>
    NUSSELT_HD static Real lit(const Real& cosine) noexcept {
        return abs(cosine);
    }
};

/// A line of a light as a shading point sees it: what its parts share, so that they add up to the whole.
template <class Real>
class SeenLine {
public:
    /// \param plane of the light, in shading space [m].
    /// \param chord of the light, or a part of it that includes all parts in question.
    NUSSELT_HD SeenLine(const LinePlane<Real>& plane, const Chord<Real>& chord) noexcept
        : along_(plane.along) {
        const Vec3<Real>& p = plane.origin;
        const Real& offset = chord.offset;
        const Real reach = max(abs(chord.extent.begin), abs(chord.extent.end));
        scale_ =
            reciprocal_power_of_two(max(max(max(abs(p.x), abs(p.y)), abs(p.z)), max(abs(offset), reach)));
        const Vec3<Real> origin = scale_ * plane.origin;
        base_ = fma(scale_ * offset, plane.across, origin);
        base_coordinate_ = dot(base_, plane.along);

        const Real height = detail::dot_or_zero(origin, plane.normal);
        const Real aside = fma(scale_, offset, dot(origin, plane.across));
        closest_ = fma(height, plane.normal, aside * plane.across);
        distance_ = sqrt(fma(height, height, aside * aside));
        cosine_ = -height / select(distance_ > Real(0), distance_, Real(1));
    }

    /// Cosine between the normal of the light and the direction to the shading point from the closest point of the
    /// infinite line; negative behind the light, 0 if its plane cannot be told from one through the point.
    NUSSELT_HD const Real& cosine_at_light() const noexcept { return cosine_; }

    /// A part of the line [m].
    NUSSELT_HD LineSegment<Real> segment(const Interval<Real>& part) const noexcept {
        const LineSegment<Real> in_units{fma(scale_ * part.begin, along_, base_), along_,
                                         scale_ * max(part.end - part.begin, Real(0))};
        return scaled(in_units, Real(1) / scale_);
    }

    /// What of a part is above the surface, times scale().
    NUSSELT_HD LineExtent<Real> above_horizon(const Interval<Real>& part) const noexcept {
        const Interval<Real> in_units{scale_ * part.begin, scale_ * part.end};
        return clipped_extent(along_, fma(in_units.begin, along_, base_), fma(in_units.end, along_, base_),
                              closest_, distance_, in_units.begin + base_coordinate_,
                              in_units.end + base_coordinate_, max(in_units.end - in_units.begin, Real(0)));
    }

    /// A power of two that takes positions to numbers of order one [1/m].
    NUSSELT_HD const Real& scale() const noexcept { return scale_; }

private:
    Vec3<Real> along_;
    Vec3<Real> base_; ///< the point with coordinate 0
    Real base_coordinate_;
    Vec3<Real> closest_; ///< to the shading point
    Real distance_;
    Real cosine_;
    Real scale_;
};

/// What a part of a line contributes to a Lambertian surface [1/m].
/// \tparam Sides FrontSide or BothSides.
template <class Sides = FrontSide, class Real>
NUSSELT_HD inline Real diffuse_part(const SeenLine<Real>& line, const Interval<Real>& part) noexcept {
    const LineExtent<Real> e = line.above_horizon(part);
    const Real per_radius = cosine_integral(e) / e.distance * line.scale();
    const Real factor = Real(1 / (2 * kPi<scalar_t<Real>>)) * Sides::lit(line.cosine_at_light());
    return select(e.visible, factor * per_radius, Real(0));
}

/// What a part of a line contributes to a glossy surface [1/m].
/// \tparam Horizons CosineHorizon, or BothHorizons where light below the surface shall not count.
/// \tparam Sides    FrontSide or BothSides.
/// \param line with wo in the xz half-plane.
template <class Horizons = BothHorizons, class Sides = FrontSide, class Real>
NUSSELT_HD inline Real lobe_part(const SeenLine<Real>& line, const Interval<Real>& part,
                                 const Ltc<Real>& ltc) noexcept {
    return Real(0.5) * Sides::lit(line.cosine_at_light()) * lobe_integral<Horizons>(line.segment(part), ltc);
}

NUSSELT_NAMESPACE_END
