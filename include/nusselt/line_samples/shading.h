#pragma once
/// Contributions of parts of the lines of a planar light to diffuse and glossy surfaces, in closed form.
///
/// Along a line, the cosine at the light over the distance is constant up to one more cosine: a part of a line is a
/// linear light, times half the cosine at the light in the closest point of the infinite line. So the integrals of
/// linear lights do it all (Billen and Dutre 2016, Eq. 20, in the end-point form of clip_line.h; the printed equation
/// cancels for short and distant parts, and has an error). Linearly transformed cosines take the plane of the light to
/// another plane, and its lines to lines (Heitz and Hill 2017, Linear-Light Shading with Linearly Transformed Cosines).
///
/// Integrals are radiance per metre of offset for a light of radiance 1 and a lobe of albedo 1 [1/m]: the integral over
/// the offsets, for visible parts, is the radiance that is reflected. They are accurate relative to themselves, apart
/// from what the rounding of the light's position relative to the shading point does. estimate/line_light.h has whole
/// estimators for the surfaces of the renderer.

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

/// The line of a light on which a lobe is brightest.
template <class Real>
struct LinePeak {
    Real offset; ///< [m]
    Real width;  ///< about that of the peak [m]; infinite if there is none
};

/// The plane of a light in units that make coordinates of order one, so that their products stay in range.
template <class Real>
struct ScaledPlane {
    /// \param metric the plane, in shading space [m].
    /// \param reach  LineFamily::reach() of the lines [m], or more.
    NUSSELT_HD ScaledPlane(const LinePlane<Real>& metric, const Real& reach) noexcept : plane(metric) {
        const Vec3<Real>& p = metric.origin;
        scale = reciprocal_power_of_two(max(max(max(abs(p.x), abs(p.y)), abs(p.z)), reach));
        plane.origin = scale * p;
        height = -detail::dot_or_zero(plane.origin, plane.normal);
    }

    LinePlane<Real> plane;
    Real scale;  ///< a power of two [1/m]
    Real height; ///< of the shading point over the plane; negative behind the light
};

/// A line of a light in the cosine space of a lobe. Coordinates of parts are those on the light.
template <class Real>
struct LobeLine {
    Vec3<Real> along;   ///< unit
    Vec3<Real> closest; ///< point of the line
    Real distance;      ///< of the line
    Real shift;         ///< coordinate along the image of the point with coordinate 0
    Real stretch;       ///< of lengths on the light [1/m]
    Real height;        ///< of the point with coordinate 0 over the horizon of the lobe
    Real slope;         ///< of that height by the coordinate [1/m]
    Real factor;        ///< of cosine_integral() [1/m]

    /// The integral of the lobe over a part, times cosine / distance^2 of the light [1/m].
    /// \param part above the horizon of the lobe, see clipped() [m].
    NUSSELT_INLINE Real integral(const Interval<Real>& part) const noexcept {
        const LineExtent<Real> e = extent(part);
        return select(e.visible(), cosine_integral(e) * factor, Real(0));
    }

    /// \param part as for integral() [m].
    NUSSELT_INLINE LineExtent<Real> extent(const Interval<Real>& part) const noexcept {
        const Real l0 = fma(part.begin, stretch, shift);
        const Real l1 = fma(part.end, stretch, shift);
        Vec3<Real> p0 = fma(l0, along, closest);
        Vec3<Real> p1 = fma(l1, along, closest);
        p0.z = max(fma(part.begin, slope, height), Real(0));
        p1.z = max(fma(part.end, slope, height), Real(0));
        const auto passes_by = distance > Real(kSmallestDistance<scalar_t<Real>>);
        const Real length = (part.end - part.begin) * stretch;
        return make_line_extent(line_between(along, p0, p1, closest,
                                             select(passes_by, distance * distance, Real(1)), l0, l1,
                                             select(passes_by, length, Real(0))));
    }

    /// The piece of a part that is above the horizon of the lobe.
    /// \param part with finite ends [m].
    NUSSELT_INLINE Interval<Real> clipped(const Interval<Real>& part) const noexcept {
        const auto rises = slope > Real(0);
        const auto falls = slope < Real(0);
        const auto is_level = !(rises | falls);
        const Real crossing = -height / select(is_level, Real(1), slope);
        const auto hidden = is_level & !(height > Real(0));
        const Real begin = min(select(rises, max(part.begin, crossing), part.begin), part.end);
        const Real end = max(select(falls, min(part.end, crossing), part.end), begin);
        return {begin, select(hidden, begin, end)};
    }

    NUSSELT_INLINE static LobeLine select_between(const mask_t<Real>& mask, const LobeLine& a,
                                                  const LobeLine& b) noexcept {
        return {select(mask, a.along, b.along),       select(mask, a.closest, b.closest),
                select(mask, a.distance, b.distance), select(mask, a.shift, b.shift),
                select(mask, a.stretch, b.stretch),   select(mask, a.height, b.height),
                select(mask, a.slope, b.slope),       select(mask, a.factor, b.factor)};
    }
};

/// The lines of a light in the cosine space of a lobe.
/// \tparam Sides FrontSide or BothSides.
template <class Real, class Sides = FrontSide>
class LobePlane {
public:
    /// The plane for Lambertian surfaces, whose lobe is the cosine itself.
    NUSSELT_HD explicit LobePlane(const ScaledPlane<Real>& light) noexcept
        : LobePlane(light, light.plane.origin, light.plane.across, light.plane.along, Real(1)) {}

    /// \param light in shading space with wo in the xz half-plane.
    NUSSELT_HD LobePlane(const ScaledPlane<Real>& light, const Ltc<Real>& ltc) noexcept
        : LobePlane(light, ltc.to_cosine(light.plane.origin), ltc.to_cosine(light.plane.across),
                    ltc.to_cosine(light.plane.along),
                    ltc.minor() * ltc.to_cosine({Real(0), Real(1), Real(0)}).y) {}

    /// \param offset of the line [m].
    NUSSELT_INLINE LobeLine<Real> line(const Real& offset) const noexcept {
        const Vec3<Real> p = fma(offset, across_, origin_);
        const Vec3<Real> moment = cross(p, along_);
        const Real squared = dot(moment, moment);
        const Real inverse = Real(1) / select(squared > Real(0), squared, Real(1));
        return {along_,
                cross(along_, moment),
                sqrt(squared),
                dot(p, along_),
                stretch_,
                p.z,
                stretch_ * along_.z,
                scale_ * (factor_ * inverse)};
    }

    /// The offset, among those in the interval, whose plane through the origin is closest to the pole of the lobe, and by
    /// how much the offset changes until that plane has turned away from it.
    NUSSELT_INLINE LinePeak<Real> peak(const Interval<Real>& offsets) const noexcept {
        const Vec3<Real> moment = cross(origin_, along_);
        const Vec3<Real> slope = cross(across_, along_);
        const auto has_peak = slope.z != Real(0);
        const Real steepness = select(has_peak, slope.z, Real(1));
        const Real offset = min(max(-moment.z / steepness, offsets.begin), offsets.end);
        const Vec3<Real> there = fma(offset, slope, moment);
        constexpr scalar_t<Real> kInfinity = std::numeric_limits<scalar_t<Real>>::infinity();
        return {offset, select(has_peak, sqrt(dot(there, there)) / abs(steepness), Real(kInfinity))};
    }

private:
    /// \param determinant of the map to cosine space.
    NUSSELT_HD LobePlane(const ScaledPlane<Real>& light, const Vec3<Real>& image_of_origin,
                         const Vec3<Real>& image_of_across, const Vec3<Real>& image_of_along,
                         const Real& determinant) noexcept
        : origin_(image_of_origin), across_(light.scale * image_of_across), scale_(light.scale) {
        const Real squared = dot(image_of_along, image_of_along);
        const Real length = sqrt(squared);
        const Real inverse = Real(1) / select(length > Real(0), length, Real(1));
        along_ = inverse * image_of_along;
        stretch_ = scale_ * length;
        const Real lit = Sides::lit(light.height);
        factor_ = (Real(1 / (2 * kPi<scalar_t<Real>>)) * determinant) * (lit * inverse);
    }

    Vec3<Real> origin_; ///< image of that of the light
    Vec3<Real> across_; ///< per metre on the light [1/m]
    Vec3<Real> along_;  ///< unit
    Real stretch_;      ///< of lengths along the lines [1/m]
    Real factor_;
    Real scale_; ///< of the light [1/m]
};

/// The contribution of a part of a line to a Lambertian surface [1/m].
/// \param cosine the line, by a LobePlane without lobe.
/// \param part   with finite ends [m].
template <class Real>
NUSSELT_HD inline Real diffuse_part(const LobeLine<Real>& cosine, const Interval<Real>& part) noexcept {
    return cosine.integral(cosine.clipped(part));
}

/// The contribution of a part of a line to a glossy surface [1/m]. Light from below the surface does not count.
/// \param cosine as for diffuse_part().
/// \param lobe   the same line, by the LobePlane of the lobe.
/// \param part   with finite ends [m].
template <class Real>
NUSSELT_HD inline Real lobe_part(const LobeLine<Real>& cosine, const LobeLine<Real>& lobe,
                                 const Interval<Real>& part) noexcept {
    return lobe.integral(lobe.clipped(cosine.clipped(part)));
}

NUSSELT_NAMESPACE_END
