#pragma once
/// Sampling of closed cylinders without rejection: first a half-plane of the fan around the direction of the axis, then
/// a direction in it. What the techniques for cylinders share; docs/techniques/cylinder.md has the derivation.
///
/// A half-plane cuts a rectangle out of the cylinder, caps included, which spans one interval of directions. Their
/// integral is known in closed form and is sampled as that of a line; the azimuth of the half-plane follows an
/// interpolant of these integrals.
///
/// Accuracy: samples are unbiased, but the interpolant has few nodes. Seen from the side, the weight of a sample has a
/// relative standard deviation below 0.1. In front of a cap, an integral can fall from its largest value to nothing
/// between two nodes: up to 0.3, and up to 0.5 with a lobe. The integral of the interpolant, which measure() returns,
/// is off by up to 8 % without a lobe and 22 % with one, and by up to a third for a cylinder that lies on the horizon or
/// whose axis is as far away as its surface.

#include <nusselt/core/broadcast.h>
#include <nusselt/geometry/cylinder.h>
#include <nusselt/sampling/cosine_arc.h>
#include <nusselt/sampling/piecewise_linear.h>

NUSSELT_NAMESPACE_BEGIN

/// Nodes of the interpolant: preparing a light takes an integral for each.
inline constexpr int kAzimuthNodes = 7;

/// Share of the largest integral that is added at all nodes: no visible half-plane has a density near zero, whatever
/// happens between the nodes.
template <class Scalar>
inline constexpr Scalar kLeastShare = Scalar(1) / 128;

/// Directions closer to the axis than its reciprocal cannot be distinguished from the axis.
template <class Scalar>
inline constexpr Scalar kSteepest = power_of_two<Scalar>(std::numeric_limits<Scalar>::digits / 2 * 3);

/// Shading space where a fan asks for the cosine space of a lobe: the lobe is the clamped cosine.
template <class Real>
struct ShadingSpace {
    NUSSELT_HD static Vec3<Real> to_cosine(const Vec3<Real>& v) noexcept { return v; }
    NUSSELT_HD static Vec3<Real> normal_to_cosine(const Vec3<Real>& n) noexcept { return n; }
    NUSSELT_HD static Real minor() noexcept { return Real(1); }
};
template <class Real, class Single>
NUSSELT_HD inline ShadingSpace<Real> broadcast(const ShadingSpace<Single>&) noexcept {
    return {};
}

/// Importance of directions: all alike. Integrals are twice those over the solid angle, per azimuth.
struct UniformImportance {
    static constexpr bool kEndsAtHorizon = false;

    template <class Real>
    NUSSELT_HD static void clip(CenteredLine<Real>&) noexcept {}
    template <class Real>
    NUSSELT_HD static Real integral(const LineExtent<Real>& e) noexcept {
        return Real(2) * e.sine_extent().difference;
    }
    template <class Real>
    struct Arc {
        LineMap<Real> map;
        Real sign; ///< of the line

        NUSSELT_HD LinePoint<Real> point(const Real& u) const noexcept {
            return map.point_at(select(sign > Real(0), u, Real(1) - u));
        }
        NUSSELT_HD Real invert(const Vec3<Real>& wi) const noexcept {
            const Real share = map.share_in(wi);
            return below_one(select(sign > Real(0), share, Real(1) - share));
        }
    };
    template <class Real>
    NUSSELT_HD static Arc<Real> arc(const LineExtent<Real>& e) noexcept {
        return {LineMap<Real>(e), e.line.sign};
    }
};

/// Importance of directions: the cosine at the surface, 0 below it.
struct CosineImportance {
    static constexpr bool kEndsAtHorizon = true;

    template <class Real>
    NUSSELT_HD static void clip(CenteredLine<Real>& line) noexcept {
        clip_to_horizon(line);
    }
    template <class Real>
    NUSSELT_HD static Real integral(const LineExtent<Real>& e) noexcept {
        return cosine_integral(e);
    }
    template <class Real>
    NUSSELT_HD static CosineArc<Real> arc(const LineExtent<Real>& e) noexcept {
        return CosineArc<Real>(e);
    }
};

/// \tparam Space      ShadingSpace, or Ltc for its cosine space: where directions have the importance.
/// \tparam Importance UniformImportance or CosineImportance.
template <class Real, class Space, class Importance>
class CylinderFan {
    using Scalar = scalar_t<Real>;

public:
    /// Uninitialised: to be assigned to before it is used.
    CylinderFan() = default;

    /// \param cylinder in shading space, with coordinates of order one.
    NUSSELT_HD CylinderFan(const Cylinder<Real>& cylinder, const Space& space) noexcept
        : space_(space), view_(make_cylinder_view(cylinder, horizon_normal(space))) {
        // Map the axis and the basis across it to the space of the importance.
        const Vec3<Real> s = space.to_cosine(view_.s);
        const Vec3<Real> m = space.to_cosine(view_.m);
        const Vec3<Real> n = space.to_cosine(view_.n);
        // The image of the plane across n contains those of s and m. Products, not differences: images may be flat.
        const Vec3<Real> across = space.normal_to_cosine(view_.n);
        const Real lateral = space.to_cosine({Real(0), Real(1), Real(0)}).y;

        // Express the images in an orthonormal basis along the image of the axis.
        stretch_ = length(s);
        s_ = normalize(s);
        n_ = normalize(across);
        m_ = cross(n_, s_);
        const Real safe_stretch = select(stretch_ > Real(0), stretch_, Real(1));
        m_along_m_ = lateral * length(across) / safe_stretch;
        n_along_n_ =
            space.minor() / select(m_along_m_ > Real(0), m_along_m_, Real(1)) * lateral / safe_stretch;
        n_along_m_ = dot(n, m_);
        m_along_s_ = dot(m, s_);
        n_along_s_ = dot(n, s_);
        height_of_m_ = m.z;
        height_of_n_ = n.z;
        start_height_ = space.to_cosine(view_.start).z;
        end_height_ = space.to_cosine(view_.end).z;

        // Find the azimuths of what is visible.
        set_range();

        // Integrate the importance over half-planes at the nodes. The integral of their interpolant estimates the whole
        // one.
        Real value[kAzimuthNodes];
        Real largest = Real(0);
        NUSSELT_UNROLL
        for (int i = 0; i < kAzimuthNodes; ++i) {
            const Real angle = fma(Real(Warp::node(i)), range_, low_);
            value[i] = half_plane(azimuth_at(angle)).integral;
            largest = max(value[i], largest);
        }
        integral_ = Real(0.5) * range_ * Warp(value).integral();

        // Interpolate these integrals: the density of azimuths.
        NUSSELT_UNROLL
        for (int i = 0; i < kAzimuthNodes; ++i) value[i] = fma(largest, Real(kLeastShare<Scalar>), value[i]);
        warp_ = Warp(value);
        const Real normalization = warp_.integral() * range_;
        const auto fits = is_finite(max(normalization, Real(1) / normalization));
        // Callers divide the integral by pi, and denormal numbers may be flushed.
        const auto shines = integral_ > Real(4 * std::numeric_limits<Scalar>::min());
        const auto lit = view_.visible & shines & fits;
        integral_ = select(lit, integral_, Real(0));
        inverse_normalization_ = select(lit, Real(1) / select(lit, normalization, Real(1)), Real(0));
    }

    /// Broadcasts a fan to all lanes of a pack.
    template <class Single, class SingleSpace>
    NUSSELT_HD explicit CylinderFan(const CylinderFan<Single, SingleSpace, Importance>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// The point of the cylinder for random numbers in [0, 1)^2: u.x chooses the half-plane, u.y the direction in it,
    /// rising along the axis. Without meaning if integral() is 0.
    NUSSELT_HD Vec3<Real> point(const Vec2<Real>& u) const noexcept {
        const HalfPlane h = half_plane_at(u.x);
        return point_in(h, Importance::arc(h.extent), u.y);
    }

    /// The points in the half-plane that u.x chooses, as a function of u.y.
    NUSSELT_HD auto points_at(const Real& u) const noexcept {
        const HalfPlane h = half_plane_at(u);
        return [this, h, arc = Importance::arc(h.extent)](const Real& y) { return point_in(h, arc, y); };
    }

    /// Density with respect to solid angle in the space of the importance, over the importance [1/sr].
    /// \param wi unit direction in shading space that hits the cylinder.
    NUSSELT_HD Real density_per_importance(const Vec3<Real>& wi) const noexcept {
        const HalfPlane h = half_plane(view_.azimuth_of(wi));
        const Real density = warp_.value(share_of(h.slice.azimuth)) * inverse_normalization_;
        const Real ratio = Real(2) * density / select(h.integral > Real(0), h.integral, Real(1));
        return select((h.integral > Real(0)) & is_finite(ratio), ratio, Real(0));
    }

    /// The random numbers for which point() lies in direction wi.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept {
        const HalfPlane h = half_plane(view_.azimuth_of(wi));
        const auto lit = integral_ > Real(0);
        const Real below = warp_.below(share_of(h.slice.azimuth));
        return {below_one(below / select(lit, warp_.integral(), Real(1))),
                Importance::arc(h.extent).invert(normalize(space_.to_cosine(wi)))};
    }

    /// Estimate of the integral of the importance over the cylinder, by the interpolant; 0 if nothing is visible.
    NUSSELT_HD const Real& integral() const noexcept { return integral_; }

private:
    using Warp = PiecewiseLinear<Real, kAzimuthNodes>;

    /// A half-plane of the fan and its image.
    struct HalfPlane {
        CylinderSlice<Real> slice;
        Real widening, shear;    ///< image of slice.t across and along the axis
        LineExtent<Real> extent; ///< of the image, on the line at distance one
        Real integral;           ///< of the importance
    };

    NUSSELT_HD HalfPlane half_plane_at(const Real& u) const noexcept {
        return half_plane(azimuth_at(fma(warp_.invert(u), range_, low_)));
    }
    /// \param arc of the half-plane.
    template <class Arc>
    NUSSELT_HD Vec3<Real> point_in(const HalfPlane& h, const Arc& arc, const Real& u) const noexcept {
        const LinePoint<Real> point = arc.point(u);
        // The line is at distance one: the reciprocal distance of a point is the cosine of its angle.
        const Real mapped = h.extent.line.sign * LineMap<Real>(h.extent).sine_at(point.share) /
                            max(point.inverse_distance, Real(1 / kSteepest<Scalar>));
        // In a half-plane without importance the map may not exist. Any point will do, its density is 0.
        const Real steepness = select(h.integral > Real(0), mapped, Real(0));
        const Real tangent = (h.widening * steepness - h.shear) / stretch_;
        const Vec2<Real> p = view_.first_point(h.slice, tangent);
        return p.x * view_.s + p.y * h.slice.t;
    }

    /// The normal of the horizon in shading space: directions with a positive product have importance.
    NUSSELT_HD static Vec3<Real> horizon_normal(const Space& space) noexcept {
        const Real zero = Real(0);
        const Real one = Real(1);
        return {space.to_cosine({one, zero, zero}).z, space.to_cosine({zero, one, zero}).z,
                space.to_cosine({zero, zero, one}).z};
    }

    /// The image of a half-plane direction, in the basis m_, n_.
    NUSSELT_HD Vec2<Real> image_of(const Vec2<Real>& azimuth) const noexcept {
        return {fma(azimuth.x, m_along_m_, azimuth.y * n_along_m_), azimuth.y * n_along_n_};
    }

    /// Azimuth of the image, in [-pi, pi].
    /// \param azimuth of any length.
    NUSSELT_HD Real angle_of(const Vec2<Real>& azimuth) const noexcept {
        const Vec2<Real> image = image_of(azimuth);
        return copysign(atan2_positive(abs(image.y), image.x), image.y);
    }
    NUSSELT_HD Vec2<Real> azimuth_at(const Real& angle) const noexcept {
        const SinCos<Real> turn = sincos_half_turn(min(abs(angle), Real(kPi<Scalar>)));
        const Real sin = copysign(turn.sin, angle);
        const Vec3<Real> azimuth = normalize(Vec3<Real>{
            difference_of_products(n_along_n_, turn.cos, n_along_m_, sin), m_along_m_ * sin, Real(0)});
        return xy(azimuth);
    }
    /// Position in the range of azimuths, in [0, 1].
    NUSSELT_HD Real share_of(const Vec2<Real>& azimuth) const noexcept {
        const Real safe_range = select(range_ > Real(0), range_, Real(1));
        return min(max((angle_of(azimuth) - low_) / safe_range, Real(0)), Real(1));
    }

    /// Image height of the unit vector across a half-plane, towards larger azimuths.
    NUSSELT_HD Real height_to_the_left_of(const Vec2<Real>& azimuth) const noexcept {
        return fma(azimuth.x, height_of_n_, -azimuth.y * height_of_m_);
    }

    NUSSELT_HD HalfPlane half_plane(const Vec2<Real>& direction) const noexcept {
        HalfPlane h;

        // Cut the cylinder and map the half-plane to the space of the importance.
        // Integrals start like a square root where half-planes touch the cylinder, which would magnify rounding.
        h.slice = view_.slice(direction, Real(4 * std::numeric_limits<scalar_t<Real>>::epsilon()));
        const Vec2<Real>& azimuth = h.slice.azimuth;
        const Vec2<Real> image = image_of(azimuth);
        h.widening = sqrt(dot(image, image));
        h.shear = fma(azimuth.x, m_along_s_, azimuth.y * n_along_s_);
        const Vec3<Real> t = (Real(1) / h.widening) * (image.x * m_ + image.y * n_);

        // Find the two corners of the rectangle that bound the interval of directions, by their tangents.
        const auto starts_far = view_.l0 > Real(0);
        const auto ends_far = view_.l1 < Real(0);
        const Real rho0 = select(starts_far, h.slice.far, h.slice.near);
        const Real rho1 = select(ends_far, h.slice.far, h.slice.near);
        const Real steepest = Real(kSteepest<Scalar>);
        const auto clamped = [](const Real& x, const Real& limit) { return min(max(x, -limit), limit); };
        const auto tangent = [&](const Real& l, const Real& rho) {
            // rho may be 0.
            const Real slope = clamped(l / rho, Real(1 / kTiny<Scalar>));
            return clamped(fma(stretch_, slope, h.shear) / h.widening, steepest);
        };
        const Real tangent0 = tangent(view_.l0, rho0);
        const Real tangent1 = tangent(view_.l1, rho1);
        const auto steep0 = abs(tangent0) >= steepest;
        const auto steep1 = abs(tangent1) >= steepest;
        // The difference of the tangents as a sum of areas that are not negative.
        const Real beyond = max(max(view_.l0, -view_.l1), Real(0));
        const Real rho = select(beyond > Real(0), h.slice.far, h.slice.near);
        const Real area = fma(view_.length, rho, beyond * (h.slice.far - h.slice.near));
        const Real difference = area / rho0 / rho1 * (stretch_ / h.widening);
        const Real length = select(steep0 | steep1, tangent1 - tangent0, difference);

        // Find the heights of these corners above the horizon, by sums that keep their precision near it.
        const Real height_of_t = fma(azimuth.x, height_of_m_, azimuth.y * height_of_n_);
        const Real height_sideways = h.slice.offset * height_to_the_left_of(azimuth);
        const Real height_across = h.slice.half_chord * height_of_t;
        const auto corner = [&](const Real& steepness, const mask_t<Real>& steep, const mask_t<Real>& far,
                                const Real& axis_height, const Real& distance) {
            Vec3<Real> p = steepness * s_ + t;
            const Real height = axis_height + (height_sideways + select(far, height_across, -height_across));
            p.z = select(steep, p.z, height / (distance * h.widening));
            return p;
        };

        // They are the end points of a line at distance one, whose importance has a closed form.
        CenteredLine<Real> line = line_between(s_, corner(tangent0, steep0, starts_far, start_height_, rho0),
                                               corner(tangent1, steep1, ends_far, end_height_, rho1), t,
                                               Real(1), tangent0, tangent1, length);
        Importance::clip(line);
        h.extent = make_line_extent(line);
        const Real integral = Importance::integral(h.extent);
        const auto visible = h.extent.visible();
        h.integral = select(visible & is_finite(integral), integral, Real(0));
        return h;
    }

    /// The azimuths of the part of the cylinder above the horizon. They are bounded by half-planes that touch the
    /// cylinder, if these reach above the horizon, or else by points of the rims in the horizon.
    NUSSELT_HD void set_range() noexcept {
        // Half-planes that touch the cylinder bound what is seen from outside; from inside, everything around is seen.
        const Real half_turn = Real(kPi<Scalar>);
        const Vec2<Real> left = view_.touching;
        const Vec2<Real> right{left.x, -left.y};
        const Real leftmost = select(view_.outside, angle_of(left), half_turn);
        const Real rightmost = select(view_.outside, angle_of(right), -half_turn);
        mask_t<Real> sees_left = mask_t<Real>(true);
        mask_t<Real> sees_right = mask_t<Real>(true);
        Real low = rightmost;
        Real high = leftmost;
        if constexpr (Importance::kEndsAtHorizon) {
            // Tell which of them reach above the horizon.
            const Real axis_height = max(start_height_, end_height_);
            const auto rises = [&](const Vec2<Real>& azimuth, const Real& offset) {
                return axis_height + offset * height_to_the_left_of(azimuth) > Real(0);
            };
            // From inside, the fan covers everything around the axis if the axis rises.
            const Real axis_slope = select(view_.l0 > Real(0), s_.z, -s_.z);
            const auto surrounded = (!view_.outside) & (axis_slope > Real(kTiny<Scalar>));
            sees_left = surrounded | (view_.outside & rises(left, view_.radius));
            sees_right = surrounded | (view_.outside & rises(right, -view_.radius));

            // Otherwise points of the rims in the horizon are the bounds.
            low = leftmost;
            high = rightmost;
            const Vec3<Real> up = normalize(Vec3<Real>{height_of_m_, height_of_n_, Real(0)});
            const Real rise = view_.radius * fma(up.x, height_of_m_, up.y * height_of_n_);
            // A rim wholly above the horizon: the lines that touch it rise too, despite rounding.
            const auto has_rim_above = axis_height >= rise;
            sees_left = sees_left | has_rim_above;
            sees_right = sees_right | has_rim_above;
            const auto include_rim = [&](const Real& height) {
                const auto crosses = abs(height) < rise;
                const Real upwards = -height / select(crosses, rise, Real(1));
                const Real sideways = sqrt(max((Real(1) - upwards) * (Real(1) + upwards), Real(0)));
                const Vec2<Real> middle = view_.center + (upwards * view_.radius) * xy(up);
                const Vec2<Real> half = (sideways * view_.radius) * Vec2<Real>{-up.y, up.x};
                const Real angle0 = angle_of(middle - half);
                const Real angle1 = angle_of(middle + half);
                low = select(crosses, min(low, min(angle0, angle1)), low);
                high = select(crosses, max(high, max(angle0, angle1)), high);
            };
            include_rim(start_height_);
            include_rim(end_height_);
        }
        low_ = select(sees_right, rightmost, max(low, rightmost));
        range_ = max(select(sees_left, leftmost, min(high, leftmost)) - low_, Real(0));
    }

    Space space_;
    CylinderView<Real> view_;

    // The image of the axis and of the basis of the view: image(m) = m_along_m m_ + m_along_s s_, and so on.
    Vec3<Real> s_, m_, n_; ///< right-handed, orthonormal
    Real stretch_;         ///< of the axis
    Real m_along_m_, n_along_m_, n_along_n_, m_along_s_, n_along_s_;
    Real height_of_m_, height_of_n_, start_height_, end_height_;

    Real low_, range_; ///< azimuths around s_, from m_ to n_
    Warp warp_;
    Real integral_;
    Real inverse_normalization_; ///< 0 if nothing is visible

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.space_, self.view_, self.s_, self.m_, self.n_, self.stretch_, self.m_along_m_,
              self.n_along_m_, self.n_along_n_, self.m_along_s_, self.n_along_s_, self.height_of_m_,
              self.height_of_n_, self.start_height_, self.end_height_, self.low_, self.range_, self.warp_,
              self.integral_, self.inverse_normalization_);
    }
};

NUSSELT_NAMESPACE_END
