#pragma once
/// Sampling of the directions in which the visible ones of GGX normals reflect: what one uses for glossy surfaces where
/// nothing is known of the lights.
///
/// E. Heitz 2018, Sampling the GGX Distribution of Visible Normals, JCGT 7(4), as J. Dupuy, A. Benyoub 2023, Sampling
/// Visible GGX Normals with Spherical Caps, doi:10.1111/cgf.14867, do it; and K. Eto, Y. Tokuyoshi 2023, Bounded VNDF
/// Sampling for Smith-GGX Reflections, doi:10.1145/3610543.3626163. docs/techniques/ggx_visible_normals.md derives it.
/// Deviations: heights above the rim of the cap instead of heights, and half vectors that are not normalised, so that
/// nothing cancels in narrow lobes.

#include <nusselt/bsdf/ggx.h>
#include <nusselt/core/broadcast.h>

NUSSELT_NAMESPACE_BEGIN

/// All visible normals, also those that reflect to directions below the surface.
struct VisibleCap {
    /// The fraction of the part of the cap below the equator that is sampled, in [0, 1].
    template <class Real>
    NUSSELT_HD static Real reach(const Vec3<Real>&, const Real&) noexcept {
        return Real(1);
    }
};

/// The cap without normals that are sure to reflect to directions below the surface.
struct BoundedCap {
    template <class Real>
    NUSSELT_HD static Real reach(const Vec3<Real>& wo, const Real& alpha2) noexcept {
        const Real root = Real(1) + sqrt(wo.x * wo.x + wo.y * wo.y);
        const Real root2 = root * root;
        return (Real(1) - alpha2) * root2 / (root2 + alpha2 * wo.z * wo.z);
    }
};

/// \tparam Real float, double, long double or a pack of float or double: one surface point per lane, or many samples of
///              one surface point (see the broadcasting constructor).
/// \tparam Cap  VisibleCap or BoundedCap.
///
/// All directions are unit vectors in shading space, pointing away from the surface.
/// Measure: densities of directions with respect to solid angle [1/sr]; their integral over the sphere is 1. Samples may
/// lie below the surface, wi.z <= 0: they count, with a contribution of zero.
/// The specular part of Frostbite times the cosine over pdf() is at most the Fresnel term; all of the narrow peak
/// cancels, up to rounding, since both compute it alike.
/// Edge cases: wo parallel to the normal is fine. wo.z <= 0: nothing is visible, pdf() is 0, sample() any unit vector.
template <class Real, class Cap = VisibleCap>
class GgxVisibleNormals {
    using Scalar = scalar_t<Real>;

public:
    /// Uninitialised: to be assigned to before it is used.
    GgxVisibleNormals() = default;

    /// \param wo    unit direction to the eye.
    /// \param alpha of GGX, such as ggx_alpha(roughness); clamped to [kSmallestGgxAlpha, 1].
    NUSSELT_HD GgxVisibleNormals(const Vec3<Real>& wo, const Real& alpha) noexcept
        : alpha_(min(max(alpha, Real(Scalar(kSmallestGgxAlpha))), Real(1))) {
        const auto lit = wo.z > Real(0);
        wo_ = select(lit, wo, Vec3<Real>{Real(0), Real(0), Real(1)});
        const Real alpha2 = alpha_ * alpha_;
        const Real plane2 = alpha2 * (wo_.x * wo_.x + wo_.y * wo_.y);
        const Real length = sqrt(plane2 + wo_.z * wo_.z);
        inverse_length_ = Real(1) / length;
        stretched_ = inverse_length_ * Vec3<Real>{alpha_ * wo_.x, alpha_ * wo_.y, wo_.z};
        const Real reach = Cap::reach(wo_, alpha2);
        height_ = Real(1) + reach * stretched_.z;
        rim_ = (Real(1) - reach) * stretched_.z;
        const Real above_pole = inverse_length_ * inverse_length_ * plane2 / (Real(1) + stretched_.z);
        rim_above_pole_ = rim_ + above_pole;
        factor_ = select(lit, Real(Scalar(0.5)) / (reach * wo_.z + length), Real(0));
    }

    /// Broadcasts one surface point to all lanes of a pack, to take many samples of it.
    template <class Single>
    NUSSELT_HD explicit GgxVisibleNormals(const GgxVisibleNormals<Single, Cap>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1)^2; x turns around the normal, y leads away from it. Continuous, also from x = 1 to x = 0.
    NUSSELT_HD Vec3<Real> sample(const Vec2<Real>& u) const noexcept {
        const auto first_half = u.x < Real(Scalar(0.5));
        const Real turn = select(first_half, u.x, Real(1) - u.x);
        SinCos<Real> azimuth = sincos_half_turn(Real(2 * kPi<Scalar>) * turn);
        azimuth.sin = select(first_half, azimuth.sin, -azimuth.sin);
        return sample(azimuth, u.y);
    }

    /// The same for those who need the same azimuths 2 pi u.x again and again.
    NUSSELT_HD Vec3<Real> sample(const SinCos<Real>& azimuth, const Real& u_y) const noexcept {
        // A point of the cap, by its heights above the rim of the cap and above the lower pole of the sphere.
        const Real above_rim = (Real(1) - u_y) * height_;
        const Real radius = sqrt(u_y * height_ * (above_rim + rim_above_pole_));
        const Vec3<Real> normal =
            normalize(Vec3<Real>{alpha_ * (radius * azimuth.cos + stretched_.x),
                                 alpha_ * (radius * azimuth.sin + stretched_.y), above_rim + rim_});
        return Real(2) * dot(wo_, normal) * normal - wo_;
    }

    /// Density of sample() [1/sr], at most 1.6e11; 0 where it cannot lead.
    /// \param wi unit direction.
    NUSSELT_HD Real pdf(const Vec3<Real>& wi) const noexcept {
        const Vec3<Real> h = wo_ + wi;
        const Real ratio = ggx_ratio(h, alpha_ * alpha_);
        const Real density = ggx_distribution(ratio, alpha_ * alpha_) * factor_;
        // All directions above the surface are in the cap, despite rounding.
        const auto reached = (wi.z > Real(0)) | ((h.z > Real(0)) & (height_of(h, ratio) >= rim_));
        return select(reached, density, Real(0));
    }

    /// The random numbers for which sample() returns wi; anything in [0, 1)^2 where it cannot.
    /// \param wi unit direction.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept {
        const Vec3<Real> h = wo_ + wi;
        const Real ratio = ggx_ratio(h, alpha_ * alpha_);
        const Real y = ratio * h.y - wo_.y;
        const Real turn = Real(1 / (2 * kPi<Scalar>)) * atan2_positive(abs(y), ratio * h.x - wo_.x);
        const Real above_rim = height_of(h, ratio) - rim_;
        return {below_one(select(y < Real(0), Real(1) - turn, turn)),
                below_one(Real(1) - above_rim / height_)};
    }

private:
    /// The height, above the direction opposite to the stretched wo, of the point of the cap that gives a half vector.
    NUSSELT_HD Real height_of(const Vec3<Real>& h, const Real& ratio) const noexcept {
        return alpha_ * alpha_ * ratio * h.z * inverse_length_;
    }

    Vec3<Real> wo_; ///< the normal where wo.z <= 0
    Real alpha_;
    Real inverse_length_;  ///< of wo stretched by alpha in x and y
    Vec3<Real> stretched_; ///< unit
    Real height_;          ///< of the cap
    Real rim_;             ///< height of the rim above the direction opposite to stretched_
    Real rim_above_pole_;  ///< height of the rim above (0, 0, -1)
    Real factor_;          ///< density of directions over that of normals; 0 where wo.z <= 0

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.wo_, self.alpha_, self.inverse_length_, self.stretched_, self.height_, self.rim_,
              self.rim_above_pole_, self.factor_);
    }
};

/// Fewer samples below the surface, at the cost of a square root per surface point.
template <class Real>
using GgxBoundedVisibleNormals = GgxVisibleNormals<Real, BoundedCap>;

NUSSELT_NAMESPACE_END
