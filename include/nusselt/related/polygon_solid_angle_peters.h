#pragma once
/// A plain transcription of a published method, to compare with: accuracy and cost of the formulas as
/// printed.
///
/// C. Peters 2021, BRDF Importance Sampling for Polygonal Lights, ACM TOG 40(4), doi:10.1145/3450626.3459672:
/// Sec. 5, with the determinant by a Householder reflection. Use PolygonSolidAngle instead: this one takes
/// small lights from their rounded directions.

#include <cmath>

#include <nusselt/core/light_sample.h>
#include <nusselt/geometry/convex_polygon.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real float, double or long double.
/// \tparam N    bound on the number of vertices.
///
/// Measure and space as PolygonSolidAngle.
template <class Real, int N>
class PolygonSolidAnglePeters {
public:
    /// \param light relative to the shading point, either winding [m].
    explicit PolygonSolidAnglePeters(const ConvexPolygon<Real, N>& light) noexcept {
        plane_ = {light.normal, dot(light.normal, light.vertex[0])};
        for (int j = 0; j < N; ++j)
            v_[j] = (Real(1) / sqrt(dot(light.vertex[j], light.vertex[j]))) * light.vertex[j];
        for (int j = 0; j < N - 2; ++j) {
            const Vec3<Real>&a = v_[j + 1], &c = v_[0], &b = v_[j + 2];
            g_[j][0] = abs(determinant(a, c, b));
            g_[j][1] = dot(a, b) + dot(c, b);
            g_[j][2] = Real(1) + dot(a, c);
            solid_angle_[j] = Real(2) * std::atan2(g_[j][0], g_[j][1] + g_[j][2]);
            total_ += solid_angle_[j];
        }
    }

    /// \param u in [0, 1)^2.
    /// \returns the direction alone, as the paper does; sample() adds density and point.
    Vec3<Real> direction(const Vec2<Real>& u) const noexcept {
        Real part = u.x * total_;
        int j = 0;
        while (j < N - 3 && part >= solid_angle_[j]) part -= solid_angle_[j++];
        const Vec3<Real>&a = v_[j + 1], &c = v_[0], &b = v_[j + 2];
        const Real cosine = std::cos(Real(0.5) * part);
        const Real sine = std::sin(Real(0.5) * part);
        const Vec3<Real> r = (g_[j][0] * cosine - g_[j][1] * sine) * a + (g_[j][2] * sine) * b;
        const Vec3<Real> v = (Real(2) * dot(a, r) / dot(r, r)) * r - a;
        const Real s2 = dot(c, v);
        const Real s = (Real(1) - u.y) + s2 * u.y;
        const Real t = sqrt(max((Real(1) - s * s) / (Real(1) - s2 * s2), Real(0)));
        return (s - t * s2) * c + t * v;
    }

    /// \param u in [0, 1)^2.
    LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const Vec3<Real> wi = direction(u);
        return {wi, Real(1) / total_, (plane_.distance / dot(plane_.normal, wi)) * wi};
    }

    /// Solid angle of the light [sr].
    Real measure() const noexcept { return total_; }

private:
    struct Plane {
        Vec3<Real> normal;
        Real distance;
    };

    /// det(a, b, c) of unit vectors: a reflection maps a to an axis.
    static Real determinant(const Vec3<Real>& a, const Vec3<Real>& b, const Vec3<Real>& c) noexcept {
        const Real sign = a.x < Real(0) ? Real(-1) : Real(1);
        const Real k = Real(1) / (Real(1) + abs(a.x));
        const Real kb = k * (dot(a, b) + sign * b.x);
        const Real kc = k * (dot(a, c) + sign * c.x);
        return sign * ((b.y - kb * a.y) * (c.z - kc * a.z) - (b.z - kb * a.z) * (c.y - kc * a.y));
    }

    Plane plane_;
    Vec3<Real> v_[N];         ///< unit directions to the vertices
    Real g_[N - 2][3];        ///< G_0, G_1, G_2
    Real solid_angle_[N - 2]; ///< of the triangles of the fan
    Real total_ = 0;
};

NUSSELT_NAMESPACE_END
