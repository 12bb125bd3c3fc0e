#pragma once
/// Linearly transformed cosines (LTCs): the lobe of a glossy surface as the image of a clamped cosine.
///
/// E. Heitz, J. Dupuy, S. Hill, D. Neubelt 2016, Real-Time Polygonal-Light Shading with Linearly Transformed Cosines,
/// doi:10.1145/2897824.2925895; used as by C. Peters 2021, BRDF Importance Sampling for Polygonal Lights, Sec. 4.1,
/// and Linear Lights, Sec. 4.1.
///
/// Two spaces: shading space, where the normal is +z and wo lies in the xz half-plane with x >= 0 (shading_frame()),
/// and cosine space, where the density of the lobe is that of a clamped cosine.

#include <nusselt/core/broadcast.h>
#include <nusselt/core/frame.h>
#include <nusselt/core/trig.h>
#include <nusselt/ltc/coefficients.h>

NUSSELT_NAMESPACE_BEGIN

/// The frame of a surface in which LTCs are meant: normal +z, wo in the xz half-plane with x >= 0. Where wo is (anti-)
/// parallel to the normal up to rounding, any tangent will do: the lobe is the same around it.
/// \param normal unit, in world space.
/// \param wo     unit direction to the eye, in world space.
template <class Real>
NUSSELT_HD inline Frame<Real> shading_frame(const Vec3<Real>& normal, const Vec3<Real>& wo) noexcept {
    // The components of this cross product are accurate relative to themselves: it stays perpendicular to the normal
    // until nothing is left of it, unlike wo minus its part along the normal.
    const Vec3<Real> across = cross(normal, wo);
    const Real extent = max(max(abs(across.x), abs(across.y)), abs(across.z));
    const auto oblique = extent > Real(std::numeric_limits<scalar_t<Real>>::epsilon());
    const Vec3<Real> b = select(oblique, normalize(across), Frame<Real>::from_normal(normal).b);
    return {cross(b, normal), b, normal};
}

/// A lobe: the density of directions in shading space that a linear map takes to the clamped cosine.
/// \tparam Real float, double, long double or a pack with one lobe per lane.
template <class Real>
class Ltc {
public:
    /// Uninitialised: to be assigned to before it is used.
    Ltc() = default;

    /// \param coefficients with a positive determinant and m11 > 0, as those of a table; the albedo is not used.
    NUSSELT_HD explicit Ltc(const LtcCoefficients<Real>& coefficients) noexcept {
        const LtcCoefficients<Real>& c = coefficients;
        const Real scale = reciprocal_power_of_two(
            max(max(max(abs(c.m00), abs(c.m02)), max(abs(c.m20), abs(c.m22))), abs(c.m11)));
        m00_ = scale * c.m00;
        m02_ = scale * c.m02;
        m11_ = scale * c.m11;
        m20_ = scale * c.m20;
        m22_ = scale * c.m22;
        minor_ = difference_of_products(m00_, m22_, m02_, m20_);
        lateral_ = minor_ / m11_;
    }

    /// Broadcasts one lobe to all lanes of a pack.
    template <class Single>
    NUSSELT_HD explicit Ltc(const Ltc<Single>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// A vector of shading space in cosine space, scaled by a number of the order of one that depends on the lobe only.
    /// Narrow lobes make both terms of a component large and their sum small: it is accurate relative to itself.
    NUSSELT_HD Vec3<Real> to_cosine(const Vec3<Real>& v) const noexcept {
        return {difference_of_products(m00_, v.x, -m02_, v.z), m11_ * v.y,
                difference_of_products(m20_, v.x, -m22_, v.z)};
    }

    /// A vector of cosine space in shading space: to_shading(to_cosine(v)) is minor() v.
    NUSSELT_HD Vec3<Real> to_shading(const Vec3<Real>& v) const noexcept {
        return {difference_of_products(m22_, v.x, m02_, v.z), lateral_ * v.y,
                difference_of_products(m00_, v.z, m20_, v.x)};
    }

    /// The normal of a plane of shading space in cosine space, of any length:
    /// dot(normal_to_cosine(n), to_cosine(v)) is minor() dot(n, v).
    NUSSELT_HD Vec3<Real> normal_to_cosine(const Vec3<Real>& n) const noexcept {
        return {difference_of_products(m22_, n.x, m20_, n.z), lateral_ * n.y,
                difference_of_products(m00_, n.z, m02_, n.x)};
    }

    /// The factor by which to_shading() and normal_to_cosine() are scaled, > 0.
    NUSSELT_HD Real minor() const noexcept { return minor_; }

    /// Density of the lobe with respect to solid angle [1/sr]: it integrates to 1 over the sphere. 0 beyond the horizon
    /// of cosine space, which is not that of the surface: the lobe also has directions below the surface.
    /// \param wi unit direction in shading space.
    NUSSELT_HD Real density(const Vec3<Real>& wi) const noexcept {
        const Vec3<Real> o = to_cosine(wi);
        const Real squared = dot(o, o);
        const auto usable = squared > Real(0);
        const Real inverse = Real(1) / select(usable, squared, Real(1));
        // Each factor is in the range of float, also where the lobe is as narrow as 1e-5.
        const Real density = (minor_ * inverse) * (m11_ * (max(o.z, Real(0)) * inverse));
        return select(usable, Real(1 / kPi<scalar_t<Real>>) * density, Real(0));
    }

private:
    // cosine_from_shading, scaled by a power of two such that its largest entry is of order one.
    Real m00_, m02_, m11_, m20_, m22_;
    Real minor_;   ///< m00 m22 - m02 m20
    Real lateral_; ///< minor / m11

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.m00_, self.m02_, self.m11_, self.m20_, self.m22_, self.minor_, self.lateral_);
    }
};

NUSSELT_NAMESPACE_END
