#pragma once
/// A plain transcription of a published method, to compare with: accuracy and cost of the formulas as
/// printed.
///
/// C. Peters 2021, BRDF Importance Sampling for Polygonal Lights, ACM TOG 40(4), doi:10.1145/3450626.3459672:
/// Sec. 5, with the determinant by a Householder reflection. Use PolygonSolidAngle instead: this one takes
/// small lights from their rounded directions.

#include <nusselt/core/light_sample.h>
#include <nusselt/geometry/convex_polygon.h>
#include <nusselt/related/peters_arithmetic.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real float, double, long double or a pack of float or double.
/// \tparam N    bound on the number of vertices.
///
/// Measure and space as PolygonSolidAngle.
template <class Real, int N>
class PolygonSolidAnglePeters {
public:
    /// \param light relative to the shading point, either winding [m].
    explicit PolygonSolidAnglePeters(const ConvexPolygon<Real, N>& light) noexcept
        : plane_normal_(light.normal), plane_distance_(dot(light.normal, light.vertex[0])) {
        NUSSELT_UNROLL
        for (int j = 0; j < N; ++j)
            v_[j] = (Real(1) / sqrt(dot(light.vertex[j], light.vertex[j]))) * light.vertex[j];
        total_ = Real(0);
        NUSSELT_UNROLL
        for (int j = 0; j < N - 2; ++j) {
            const Vec3<Real>&a = v_[j + 1], &c = v_[0], &b = v_[j + 2];
            g_[j] = {abs(determinant(a, c, b)), dot(a, b) + dot(c, b), Real(1) + dot(a, c)};
            solid_angle_[j] = Real(2) * peters::atan2_positive(g_[j].x, g_[j].y + g_[j].z);
            total_ = total_ + solid_angle_[j];
        }
    }

    /// \param u in [0, 1)^2.
    /// \returns the direction alone, as the paper does; sample() adds density and point.
    Vec3<Real> direction(const Vec2<Real>& u) const noexcept {
        // Select a triangle. Only packs copy it: scalars read it in place.
        Real part = u.x * total_;
        if constexpr (peters::kIsScalar<Real>) {
            int j = 0;
            while (j < N - 3 && part >= solid_angle_[j]) part -= solid_angle_[j++];
            return direction_in_triangle(v_[j + 1], v_[j + 2], g_[j], part, u.y);
        } else {
            Vec3<Real> a = v_[1], b = v_[2], g = g_[0];
            Real solid_angle = solid_angle_[0];
            NUSSELT_UNROLL
            for (int j = 1; j < N - 2; ++j) {
                const auto reached = (solid_angle_[j] > Real(0)) & (part >= solid_angle);
                part = select(reached, part - solid_angle, part);
                a = select(reached, v_[j + 1], a);
                b = select(reached, v_[j + 2], b);
                g = select(reached, g_[j], g);
                solid_angle = select(reached, solid_angle_[j], solid_angle);
            }
            return direction_in_triangle(a, b, g, part, u.y);
        }
    }

    /// \param u in [0, 1)^2.
    LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const Vec3<Real> wi = direction(u);
        return {wi, Real(1) / total_, (plane_distance_ / dot(plane_normal_, wi)) * wi};
    }

    /// Solid angle of the light [sr].
    Real measure() const noexcept { return total_; }

private:
    /// det(a, b, c) of unit vectors: a reflection maps a to an axis.
    static Real determinant(const Vec3<Real>& a, const Vec3<Real>& b, const Vec3<Real>& c) noexcept {
        const Real sign = select(a.x < Real(0), Real(-1), Real(1));
        const Real k = Real(1) / (Real(1) + abs(a.x));
        const Real kb = k * (dot(a, b) + sign * b.x);
        const Real kc = k * (dot(a, c) + sign * c.x);
        return sign * ((b.y - kb * a.y) * (c.z - kc * a.z) - (b.z - kb * a.z) * (c.y - kc * a.y));
    }

    /// \param a, b, g of a triangle with the first vertex.
    /// \param part solid angle up to the sample.
    NUSSELT_INLINE Vec3<Real> direction_in_triangle(const Vec3<Real>& a, const Vec3<Real>& b,
                                                    const Vec3<Real>& g, const Real& part,
                                                    const Real& u) const noexcept {
        const Vec3<Real>& c = v_[0];
        const SinCos<Real> half = peters::sincos_half_turn(Real(0.5) * part);
        const Vec3<Real> r = (g.x * half.cos - g.y * half.sin) * a + (g.z * half.sin) * b;
        const Vec3<Real> v = (Real(2) * dot(a, r) / dot(r, r)) * r - a;
        const Real s2 = dot(c, v);
        const Real s = (Real(1) - u) + s2 * u;
        const Real t = sqrt(max((Real(1) - s * s) / (Real(1) - s2 * s2), Real(0)));
        return (s - t * s2) * c + t * v;
    }

    Vec3<Real> plane_normal_;
    Real plane_distance_;
    Vec3<Real> v_[N];         ///< unit directions to the vertices
    Vec3<Real> g_[N - 2];     ///< G_0, G_1, G_2
    Real solid_angle_[N - 2]; ///< of the triangles of the fan
    Real total_;
};

NUSSELT_NAMESPACE_END
