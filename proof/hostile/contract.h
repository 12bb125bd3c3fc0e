#pragma once
/// The contract of a technique: it never fails, for any light and random number. Works for scalars and packs alike.

#include <limits>

#include "proof/techniques/registry.h"

NUSSELT_NAMESPACE_BEGIN
namespace hostile {

/// Everything that a technique returns for one light and random number.
template <class Real, class Random>
struct Outputs {
    LightSample<Real> sample;
    Real pdf; ///< result of pdf() for the sampled direction
    Random inverse;
    Real measure;
};

template <class Kind, class Real>
Outputs<Real, typename Kind::template Random<Real>>
outputs_of(const typename Kind::template Light<Real>& light,
           const typename Kind::template Random<Real>& u) noexcept {
    const typename Kind::template Technique<Real> technique(light);
    const LightSample<Real> sample = technique.sample(u);
    return {sample, technique.pdf(sample.wi), technique.invert(sample.wi), technique.measure()};
}

template <class Real>
mask_t<Real> all_finite(const Vec3<Real>& v) noexcept {
    // A sum of finite numbers might overflow. These products are 0 or NaN.
    const Real zero = Real(0) * v.x + Real(0) * v.y + Real(0) * v.z;
    return zero == Real(0);
}

template <class Real>
auto in_unit_interval(const Real& u) noexcept {
    return (u >= Real(0)) & (u < Real(1));
}
template <class Real>
auto in_unit_interval(const Vec2<Real>& u) noexcept {
    return in_unit_interval(u.x) & in_unit_interval(u.y);
}

template <class Real>
Real largest_coordinate(const Vec3<Real>& v) noexcept {
    return max(max(abs(v.x), abs(v.y)), abs(v.z));
}

/// Axis-aligned box of a light.
template <class Real>
struct Bounds {
    Vec3<Real> low, high;
    Real extent; ///< largest distance of a vertex from the origin, in the maximum norm

    template <int N>
    explicit Bounds(const ConvexPolygon<Real, N>& polygon) noexcept
        : low(polygon.vertex[0]), high(low), extent(largest_coordinate(low)) {
        for (int j = 1; j < N; ++j) include(polygon.vertex[j]);
    }
    explicit Bounds(const LineSegment<Real>& line) noexcept
        : low(line.p0), high(low), extent(largest_coordinate(low)) {
        include(line.p0 + line.length * line.s);
    }

    explicit Bounds(const Cylinder<Real>& cylinder) noexcept : Bounds(cylinder.axis) {
        const Vec3<Real> half{cylinder.radius, cylinder.radius, cylinder.radius};
        low = low - half;
        high = high + half;
        extent = extent + cylinder.radius;
    }

    /// A box around round lights that is up to sqrt(3) times as large as needed: squares may leave the range of numbers.
    explicit Bounds(const Sphere<Real>& light) noexcept
        : Bounds(light.center, Vec3<Real>{light.radius, light.radius, light.radius}) {}
    explicit Bounds(const Disk<Real>& light) noexcept
        : Bounds(light.center, Vec3<Real>{light.radius, light.radius, light.radius}) {}
    explicit Bounds(const Ellipse<Real>& light) noexcept
        : Bounds(light.center, magnitudes(light.u) + magnitudes(light.v)) {}
    explicit Bounds(const Ellipsoid<Real>& light) noexcept
        : Bounds(light.center,
                 magnitudes(light.axis[0]) + magnitudes(light.axis[1]) + magnitudes(light.axis[2])) {}

    mask_t<Real> contain(const Vec3<Real>& p, const Real& slack) const noexcept {
        return (p.x >= low.x - slack) & (p.x <= high.x + slack) & (p.y >= low.y - slack) &
               (p.y <= high.y + slack) & (p.z >= low.z - slack) & (p.z <= high.z + slack);
    }

private:
    Bounds(const Vec3<Real>& center, const Vec3<Real>& half) noexcept
        : low(center - half),
          high(center + half),
          extent(max(largest_coordinate(low), largest_coordinate(high))) {}
    static Vec3<Real> magnitudes(const Vec3<Real>& v) noexcept { return {abs(v.x), abs(v.y), abs(v.z)}; }
    void include(const Vec3<Real>& v) noexcept {
        low = min(low, v);
        high = max(high, v);
        extent = max(extent, largest_coordinate(v));
    }
};

/// Width of a polygon relative to its extent, at most 1. Rounded vertices tilt the plane by the ratio of the rounding
/// error to the width.
template <class Real, int N>
Real relative_width(const ConvexPolygon<Real, N>& light, const Real& extent) noexcept {
    // Areas must not overflow.
    const Real scale = reciprocal_power_of_two(extent);
    ConvexPolygon<Real, N> scaled = light;
    Real longest = Real(0);
    for (Vec3<Real>& edge : scaled.edge) {
        edge = scale * edge;
        longest = max(longest, largest_coordinate(edge));
    }
    const Real area = largest_coordinate(doubled_area_normal(scaled));
    return min(area / select(longest > Real(0), longest, Real(1)), Real(1));
}

/// The error of the angles of a technique apart from rounding: the error bound of FastAngles for biased techniques.
template <class Kind>
inline constexpr double kAngleError = Kind::kBiased ? 1.3e-5 : 0;

/// A point of a line must be on the line. The overloads of is_off() for lines, cylinders and polygons do not test the box around the light.
template <class Real>
mask_t<Real> is_off(const LineSegment<Real>& light, const Bounds<Real>&, const Vec3<Real>& p,
                    const Real& slack, const Real&) noexcept {
    return length(cross(p - light.p0, light.s)) > slack;
}

/// A point of a cylinder must be on its lateral surface or on a cap.
template <class Real>
mask_t<Real> is_off(const Cylinder<Real>& light, const Bounds<Real>&, const Vec3<Real>& p, const Real& slack,
                    const Real&) noexcept {
    const Vec3<Real> offset = p - light.axis.p0;
    const Real along = dot(offset, light.axis.s);
    const Real beyond = max(-along, along - light.axis.length);
    const Real outwards = length(cross(offset, light.axis.s)) - light.radius;
    const auto on_surface = abs(max(beyond, outwards)) <= slack;
    return !on_surface;
}

/// Rounding errors of directions move points of round lights along their surface, and points of flat ones also across it.
template <class Real>
mask_t<Real> is_off(const Sphere<Real>& light, const Bounds<Real>& bounds, const Vec3<Real>& p,
                    const Real& slack, const Real& angle_error) noexcept {
    const Real moved = Real(8) * angle_error * bounds.extent;
    const auto on_surface = abs(length(p - light.center) - light.radius) <= slack + moved;
    return !on_surface;
}

/// Whether a point is off the plane through another one, or far beyond the rim. As for polygons, nothing is required where the
/// plane contains the shading point up to rounding.
/// \param width relative to the length of the light.
template <class Real>
mask_t<Real> is_off_plane(const Vec3<Real>& normal, const Vec3<Real>& center, const Real& width,
                          const Bounds<Real>& bounds, const Vec3<Real>& p, const Real& slack,
                          const Real& angle_error) noexcept {
    const Real distance = width * abs(dot(normal, center));
    const auto apart = distance > slack;
    // Next to the rim and the plane, the point moves with the angle to the plane, and that angle with its reciprocal.
    const Real steepness = bounds.extent / select(apart, distance, Real(1));
    const Real moved = Real(8) * angle_error * bounds.extent * steepness * steepness;
    const auto off_plane = width * abs(dot(normal, p - center)) > slack + moved;
    const auto outside = !bounds.contain(p, slack + moved);
    return apart & (off_plane | outside);
}
template <class Real>
mask_t<Real> is_off(const Disk<Real>& light, const Bounds<Real>& bounds, const Vec3<Real>& p,
                    const Real& slack, const Real& angle_error) noexcept {
    return is_off_plane(light.normal, light.center, Real(1), bounds, p, slack, angle_error);
}

/// The normal of an ellipse, and its width relative to its length, at most 1.
template <class Real>
struct EllipsePlane {
    Vec3<Real> normal;
    Real width;
};
template <class Real>
EllipsePlane<Real> plane_of(const Ellipse<Real>& light) noexcept {
    const Real scale = reciprocal_power_of_two(max(largest_coordinate(light.u), largest_coordinate(light.v)));
    const Vec3<Real> u = scale * light.u, v = scale * light.v;
    const Vec3<Real> area = cross(u, v);
    const Real longest = max(max(dot(u, u), dot(v, v)), Real(std::numeric_limits<scalar_t<Real>>::min()));
    return {normalize(area), min(length(area) / longest, Real(1))};
}
/// Rounded semi-diameters tilt the plane by the ratio of the rounding error to the width.
template <class Real>
mask_t<Real> is_off(const Ellipse<Real>& light, const Bounds<Real>& bounds, const Vec3<Real>& p,
                    const Real& slack, const Real& angle_error) noexcept {
    const auto plane = plane_of(light);
    return is_off_plane(plane.normal, light.center, plane.width, bounds, p, slack, angle_error);
}

/// The space in which an ellipsoid is the unit sphere, where points have the coordinates dot(row, p - center) / unit.
template <class Real>
struct EllipsoidSpace {
    Vec3<Real> row[3];
    Real unit;      ///< a power of two [m]
    Real thickness; ///< a bound on the shortest semi-axis relative to the unit
};
template <class Real>
EllipsoidSpace<Real> space_of(const Ellipsoid<Real>& light) noexcept {
    const Real scale =
        reciprocal_power_of_two(max(max(largest_coordinate(light.axis[0]), largest_coordinate(light.axis[1])),
                                    largest_coordinate(light.axis[2])));
    const Vec3<Real> a = scale * light.axis[0], b = scale * light.axis[1], c = scale * light.axis[2];
    const Real volume = dot(a, cross(b, c));
    const Real inverse = Real(1) / select(volume != Real(0), volume, Real(1));
    const Real longest = length(a) + length(b) + length(c);
    return {{inverse * cross(b, c), inverse * cross(c, a), inverse * cross(a, b)},
            reciprocal_power_of_two(scale),
            abs(volume) / max(longest * longest, Real(std::numeric_limits<scalar_t<Real>>::min()))};
}
/// A point of an ellipsoid must be on its surface. Nothing is required of the thinnest ones, whose space is a matter of rounding.
template <class Real>
mask_t<Real> is_off(const Ellipsoid<Real>& light, const Bounds<Real>& bounds, const Vec3<Real>& p,
                    const Real& slack, const Real& angle_error) noexcept {
    const auto space = space_of(light);
    const Real inverse_unit = reciprocal_power_of_two(space.unit);
    const Vec3<Real> at = inverse_unit * (p - light.center);
    const Vec3<Real> y{dot(space.row[0], at), dot(space.row[1], at), dot(space.row[2], at)};
    // Rounding of the semi-diameters moves the surface by this in the space of the sphere.
    const Real turned = Real(8) * angle_error * bounds.extent;
    const Real moved = (slack + turned) * inverse_unit / (space.thickness * space.thickness);
    return (moved < Real(0.1)) & (abs(length(y) - Real(1)) > moved);
}

/// The rounding errors of vertices and hit points across the plane of a polygon [m].
/// \param slack for hit points.
template <class Real, int N>
Real plane_slack(const ConvexPolygon<Real, N>& light, const Real& slack) noexcept {
    return slack + Real(84) * warp_of(light, plane_distance(light));
}

/// A point of a polygon must be in its plane, which rounding tilts by its ratio to the width, unless the plane contains the
/// shading point up to rounding. Rounding of directions to a light seen edge-on may move a point beyond the
/// box along the plane, and moving it back into the box takes it off the plane again.
/// \param angle_error of directions.
template <class Real, int N>
mask_t<Real> is_off(const ConvexPolygon<Real, N>& light, const Bounds<Real>& bounds, const Vec3<Real>& p,
                    const Real& slack, const Real& angle_error) noexcept {
    const Real distance = plane_distance(light);
    const Real width = relative_width(light, bounds.extent);
    const Real rounding = plane_slack(light, slack);
    const auto apart = width * abs(distance) > rounding;
    const Real turned = fma(angle_error, bounds.extent, warp_of(light, distance));
    const Real moved = Real(8) * turned / select(apart, abs(distance) / bounds.extent, Real(1));
    const auto off_plane = width * abs(dot(light.normal, p) - distance) > rounding + moved;
    return apart & off_plane;
}

/// The largest distance of a hit point from the ray along wi [m]. A tilt of the plane turns the directions to a light
/// seen edge-on. The point where a ray meets the plane moves more at smaller angles to the plane. The smaller of the
/// angles of wi and of the way to p counts, because rounding may have turned wi away from the plane. Nothing is required
/// if the plane contains the shading point up to rounding.
template <class Real, int N>
Real aim_slack(const ConvexPolygon<Real, N>& light, const Vec3<Real>& wi, const Vec3<Real>& p,
               const Real& extent, const Real& slack) noexcept {
    const Real width = relative_width(light, extent);
    const Real distance = abs(plane_distance(light));
    const Real reach = length(p);
    const Real sturdiness =
        width * min(abs(dot(light.normal, wi)), distance / select(reach > Real(0), reach, Real(1)));
    const Real squared = sturdiness * sturdiness;
    const Real rounding = plane_slack(light, slack);
    const auto apart = (squared > Real(0)) & (width * distance > rounding);
    return select(apart, rounding / squared, Real(std::numeric_limits<scalar_t<Real>>::max()));
}
template <class Real>
Real aim_slack(const LineSegment<Real>&, const Vec3<Real>&, const Vec3<Real>&, const Real&,
               const Real& slack) noexcept {
    return slack;
}
template <class Real>
Real aim_slack(const Cylinder<Real>&, const Vec3<Real>&, const Vec3<Real>&, const Real&,
               const Real& slack) noexcept {
    return slack;
}
/// Hit points of round lights are on the ray.
template <class Real, template <class> class Shape>
Real aim_slack(const Shape<Real>&, const Vec3<Real>&, const Vec3<Real>&, const Real&,
               const Real& slack) noexcept {
    return slack;
}

/// The largest difference between the density of a sample of the area of a light and that of its direction, relative
/// to the density: rounding moves the point where the direction meets the light, and it moves it more at smaller
/// angles to the light. Infinite where the density consists of rounding errors.
template <class Real, int N>
Real area_pdf_tolerance(const ConvexPolygon<Real, N>& light, const Vec3<Real>& p, const Real& extent,
                        const Real& slack) noexcept {
    const Real rounding = plane_slack(light, slack);
    return Real(4) * rounding / (relative_width(light, extent) * abs(dot(light.normal, p)));
}
template <class Real>
Real area_pdf_tolerance(const LineSegment<Real>& light, const Vec3<Real>& p, const Real&,
                        const Real& slack) noexcept {
    return Real(4) * slack / length(cross(light.s, p));
}

/// On the lateral surface, the cosine changes, too, and more so at smaller angles. Next to a rim, the direction may
/// meet the surface on either side of the rim.
template <class Real>
Real area_pdf_tolerance(const Cylinder<Real>& light, const Vec3<Real>& p, const Real&,
                        const Real& slack) noexcept {
    using T = scalar_t<Real>;
    const Vec3<Real> from_begin = p - light.axis.p0;
    const Real along = dot(from_begin, light.axis.s);
    const Vec3<Real> across = cross(light.axis.s, cross(from_begin, light.axis.s));
    const Real rho = length(across);
    const Real to_ends = min(abs(along), abs(light.axis.length - along));
    const Real to_side = abs(light.radius - rho);
    const auto on_side = to_side <= to_ends;
    const Vec3<Real> normal = select(on_side, normalize(across), light.axis.s);
    const Real cosine = abs(dot(normalize(p), normal));
    const Real moved = slack / cosine;
    const Real smallest = min(light.radius, length(p));
    const auto inside_one_part = max(to_ends, to_side) > Real(4) * moved;
    return select(inside_one_part, Real(4) * moved / (cosine * smallest),
                  Real(std::numeric_limits<T>::max()));
}

template <class Real>
Real area_pdf_tolerance(const Disk<Real>& light, const Vec3<Real>& p, const Real&,
                        const Real& slack) noexcept {
    return Real(4) * slack / abs(dot(light.normal, p));
}
template <class Real>
Real area_pdf_tolerance(const Ellipse<Real>& light, const Vec3<Real>& p, const Real&,
                        const Real& slack) noexcept {
    const auto plane = plane_of(light);
    return Real(4) * slack / (plane.width * abs(dot(plane.normal, p)));
}

/// How much a lobe magnifies rounding errors of directions on their way from cosine space; 1 for other lights.
template <class Real, class Light>
Real magnification_of(const Light&, const Vec3<Real>&) noexcept {
    return Real(1);
}
/// Close to the horizon of cosine space, where samples carry next to nothing, the rim of a wide image loses half of the digits.
template <class Real, template <class> class Shape>
Real magnification_of(const RoundOnLobe<Real, Shape>& light, const Vec3<Real>& wi) noexcept {
    const Ltc<Real> ltc(light.lobe);
    // The largest entry of the map to cosine space is of order one.
    const Real back = max(largest_coordinate(ltc.to_shading({Real(1), Real(1), Real(1)})),
                          largest_coordinate(ltc.to_shading({Real(1), Real(1), Real(-1)})));
    constexpr auto kLeast = power_of_two<scalar_t<Real>>(-std::numeric_limits<scalar_t<Real>>::digits / 2);
    const Real cosine = max(normalize(ltc.to_cosine(wi)).z, Real(kLeast));
    return max(Real(4) * back / ltc.minor(), Real(1)) / cosine;
}

/// Calls report(mask, text) for each rule of the contract, with the lanes that break it and a description.
template <class Kind, class Real, class Report>
void check_contract(const typename Kind::template Light<Real>& light,
                    const Outputs<Real, typename Kind::template Random<Real>>& out,
                    const Report& report) noexcept {
    using T = scalar_t<Real>;
    // Rounding of a unit vector, and of a hit point relative to the farthest point of the light: 1e-5 in float, which
    // is far below what an image shows, and enough for sums of up to nine weighted vertices.
    constexpr T kTolerance = 84 * std::numeric_limits<T>::epsilon();
    const auto& [wi, pdf, p] = out.sample;
    report(!all_finite(wi), "wi is not finite");
    report(!(is_finite(pdf) & (pdf >= Real(0))), "the density of the sample is negative or not finite");
    report(!(is_finite(out.pdf) & (out.pdf >= Real(0))), "pdf(wi) is negative or not finite");
    report(!(is_finite(out.measure) & (out.measure >= Real(0))), "measure is negative or not finite");
    report(!in_unit_interval(out.inverse), "invert(wi) leaves [0, 1)");

    const auto sampled = pdf > Real(0);
    report(sampled & !(out.measure > Real(0)), "the density is positive without a measure");
    report(sampled & !(abs(dot(wi, wi) - Real(1)) <= Real(kTolerance)), "wi is not a unit vector");
    // Exactly: a program may take it for granted, since clipped techniques leave out all that lies below the horizon.
    if constexpr (Kind::kHorizon == Horizon::clipped)
        report(sampled & !(wi.z >= Real(0)), "wi is below the horizon");
    report(sampled & !all_finite(p), "p is not finite");
    const Bounds<Real> bounds(light);
    // The rounding errors of denormal numbers are absolute.
    const Real slack = fma(Real(kTolerance), bounds.extent, Real(16 * std::numeric_limits<T>::min()));
    const Real angle_error =
        magnification_of<Real>(light, wi) * Real(kAngleError<Kind> > 0 ? static_cast<T>(4 * kAngleError<Kind>)
                                                                       : std::numeric_limits<T>::epsilon());
    // Where less of a lobe than the rounding unit reaches a polygon, the map from cosine space magnifies rounding errors: hit
    // points are in the box around the light only.
    const auto reached =
        mask_t<Real>(Kind::kMeasure != Measure::lobe || !(kIsPolygon<Kind> || kIsRound<Kind>)) |
        (out.measure > Real(std::numeric_limits<T>::epsilon()));
    // For round lights, is_off() tests the box as well where it has to.
    const auto outside = mask_t<Real>(!kIsRound<Kind>) & !bounds.contain(p, slack);
    report(sampled & (outside | (reached & is_off(light, bounds, p, slack, angle_error))),
           "p is off the light");
    // For 6e4 ordinary lights, the largest errors are 12 times the error of the angles.
    const Real turned = Real(static_cast<T>(32 * kAngleError<Kind>)) * bounds.extent;
    const Real aim = aim_slack(light, wi, p, bounds.extent, slack + turned);
    const auto on_line = largest_coordinate(cross(wi, p)) <= aim;
    const auto ahead = dot(wi, p) >= -aim;
    report(sampled & !(on_line & ahead), "wi does not lead to p");
    if constexpr (Kind::kMeasure == Measure::area) {
        // With larger tolerances, the density is noise.
        const Real tolerance = area_pdf_tolerance(light, p, bounds.extent, slack);
        report(sampled & (tolerance < Real(0.1)) & !(abs(out.pdf / pdf - Real(1)) <= tolerance),
               "the density of the sample is not pdf(wi)");
    } else {
        report(sampled & (pdf != out.pdf), "the density of the sample is not pdf(wi)");
    }
}

/// A description of the first rule that a scalar technique breaks, or nullptr.
template <class Kind, class T>
const char* violation(const typename Kind::template Light<T>& light,
                      const Outputs<T, typename Kind::template Random<T>>& out) noexcept {
    const char* first = nullptr;
    check_contract<Kind, T>(light, out, [&](bool broken, const char* text) {
        if (broken && first == nullptr) first = text;
    });
    return first;
}

} // namespace hostile
NUSSELT_NAMESPACE_END
