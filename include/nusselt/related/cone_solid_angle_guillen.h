#pragma once
/// A published method, to compare with: an area-preserving map from the square to the spherical ellipse of a disk.
///
/// I. Guillén, C. Ureña, A. King, M. Fajardo, I. Georgiev, J. López-Moreno, A. Jarabo 2017, Area-Preserving Parameterizations for
/// Spherical Ellipses, CGF 36(4), doi:10.1111/cgf.13234, the radial map: the solid angle of a sector of the ellipse is an incomplete
/// elliptic integral, which is inverted for the angle in a quadrant; along the radius the height over the tangent plane is uniform.
///
/// Deviations: the sector's solid angle, a difference of elliptic integrals of the first and third kind that cancels for small
/// lights, is a quadrature of the positive integrand 1 / (1 + w) with w the height of the rim. Newton's method takes the place of
/// bisection or a table. Ellipses, spheres and ellipsoids are spherical ellipses, too.
/// Known failures: cost; ConeSolidAngle interpolates the same density instead.

#include <nusselt/cones/spherical_ellipse.h>
#include <nusselt/core/gauss_legendre.h>

NUSSELT_NAMESPACE_BEGIN

/// The turn around the axis by the inverse of the solid angle of a sector.
template <class Real>
class SectorTurn {
    using Scalar = scalar_t<Real>;
    static constexpr int kNodes = kIsSingle<Real> ? 8 : 20; ///< of the quadrature
    static constexpr int kSteps = kIsSingle<Real> ? 3 : 5;  ///< of Newton's method

public:
    static constexpr bool kIsExact = true;

    SectorTurn() = default;
    NUSSELT_HD explicit SectorTurn(const RimDrop<Real>& drop) noexcept
        : drop_(drop), quadrant_(below(Real(1))) {}
    template <class Single>
    NUSSELT_HD explicit SectorTurn(const SectorTurn<Single>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    NUSSELT_HD Real drop(const Real& cosine, const Real& sine) const noexcept { return drop_(cosine, sine); }
    NUSSELT_HD const Real& integral() const noexcept { return quadrant_; }
    NUSSELT_HD Real invert(const Real& share) const noexcept {
        Real part = share;
        NUSSELT_UNROLL
        for (int i = 0; i < kSteps; ++i) {
            const auto turn = sincos_quarter_turn(Real(kPi<Scalar> / 2) * part);
            const Real step = (below(part) - share * quadrant_) / drop_(turn.cos, turn.sin);
            part = min(max(part - step, Real(0)), Real(1));
        }
        return part;
    }
    /// The integral of the drop from 0 to a part of the quadrant.
    NUSSELT_HD Real below(const Real& part) const noexcept {
        constexpr GaussLegendre<Scalar, kNodes> kRule;
        Real sum = Real(0);
        for (int i = 0; i < kNodes; ++i) {
            const auto turn = sincos_quarter_turn(min(part, Real(1)) * Real(kPi<Scalar> / 2 * kRule.node(i)));
            sum = multiply_add(Real(kRule.weight(i)), drop_(turn.cos, turn.sin), sum);
        }
        return part * sum;
    }

private:
    RimDrop<Real> drop_;
    Real quadrant_;

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.drop_, self.quadrant_);
    }
};

/// \tparam Real  float, double, long double or a pack of float or double: one light and shading point per lane, or many samples
///               of one light (see the broadcasting constructor).
/// \tparam Light Sphere, Disk, Ellipse or Ellipsoid.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr], the constant 1 / measure().
/// Space, edge cases: those of ConeSolidAngle.
template <class Real, template <class> class Light>
using ConeSolidAngleGuillen = SphericalEllipse<Real, Light, SectorTurn>;
template <class Real>
using DiskSolidAngleGuillen = ConeSolidAngleGuillen<Real, Disk>;

NUSSELT_NAMESPACE_END
