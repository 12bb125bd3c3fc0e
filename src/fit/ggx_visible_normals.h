#pragma once
/// Reflected directions with the density of visible normals: J. Dupuy, A. Benyoub 2023, Sampling Visible GGX Normals
/// with Spherical Caps, doi:10.1111/cgf.14867.

#include <nusselt/core/trig.h>
#include <nusselt/core/vec.h>

namespace nusselt::fit {

template <class Real>
class GgxVisibleNormals {
public:
    /// \param wo    unit, in the xz-plane, z >= 0; \param alpha > 0.
    GgxVisibleNormals(const Vec3<Real>& wo, const Real& alpha) noexcept
        : wo_(wo), alpha_(alpha), stretched_length_(sqrt(alpha * alpha * wo.x * wo.x + wo.z * wo.z)) {}

    /// \param cos_phi, sin_phi  of 2 pi u.x
    Vec3<Real> sample(const Real& cos_phi, const Real& sin_phi, const Real& u_y) const noexcept {
        const Real inverse = Real(1) / stretched_length_;
        const Real sx = inverse * alpha_ * wo_.x;
        const Real sz = inverse * wo_.z;
        const Real z = (Real(1) - u_y) * (Real(1) + sz) - sz;
        const Real r = sqrt(max(Real(1) - z * z, Real(0)));
        const Vec3<Real> normal =
            normalize(Vec3<Real>{alpha_ * (r * cos_phi + sx), alpha_ * r * sin_phi, z + sz});
        const Real cosine = wo_.x * normal.x + wo_.z * normal.z;
        return Real(2) * cosine * normal - wo_;
    }

    /// Density of sample() [1/sr]; the part below the horizon included.
    Real pdf(const Vec3<Real>& wi) const noexcept {
        const Vec3<Real> h = wo_ + wi;
        const Real plane2 = h.x * h.x + h.y * h.y;
        const Real height2 = h.z * h.z;
        const Real alpha2 = alpha_ * alpha_;
        const Real ratio = (plane2 + height2) / (plane2 + alpha2 * height2);
        const Real distribution = alpha2 * ratio * ratio * Real(1 / kPi<double>);
        return select(h.z > Real(0), distribution / (Real(2) * (wo_.z + stretched_length_)), Real(0));
    }

private:
    Vec3<Real> wo_;
    Real alpha_;
    Real stretched_length_;
};

} // namespace nusselt::fit
