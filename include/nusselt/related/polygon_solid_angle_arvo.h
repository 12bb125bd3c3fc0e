#pragma once
/// A published method, to compare with: uniform sampling of the solid angle of a polygon as a fan of spherical triangles.
///
/// J. Arvo 1995, Stratified Sampling of Spherical Triangles, SIGGRAPH 95, doi:10.1145/218380.218500, and for polygons
/// J. Arvo 2001, Stratified Sampling of 2-Manifolds, SIGGRAPH course State of the Art in Monte Carlo Ray Tracing for
/// Realistic Image Synthesis. All arcs of samples begin at vertex 0. Use PolygonSolidAngle instead.
///
/// Known failures, which the tests show:
/// - Small lights lose digits to 1 - cos(c) and to the sine of an arc that follows from its cosine: in float, samples of
///   lights of a thousandth of their distance are off by a tenth of their random number in the median.
/// - Coordinates must be of order one, and the plane of the light must not contain the shading point.

#include <nusselt/core/broadcast.h>
#include <nusselt/core/light_sample.h>
#include <nusselt/geometry/convex_polygon.h>
#include <nusselt/related/spherical_triangle_arvo.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real float, double, long double or a pack of float or double: one light and shading point per lane, or many
///              samples of one light (see the broadcasting constructor).
/// \tparam N    bound on the number of vertices.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr], the constant 1 / measure().
/// Space: any frame with the shading point as origin; no normal is involved and nothing is clipped.
/// Edge cases: no area: pdf = 0, measure 0.
template <class Real, int N>
class PolygonSolidAngleArvo {
    using Triangle = SphericalTriangleArvo<Real>;
    using Mask = mask_t<Real>;
    static constexpr int kTriangles = N - 2;

public:
    /// \param light relative to the shading point, either winding [m].
    NUSSELT_HD explicit PolygonSolidAngleArvo(const ConvexPolygon<Real, N>& light) noexcept
        : plane_normal_(light.normal), plane_distance_(dot(light.normal, light.vertex[0])) {
        Vec3<Real> v[N];
        NUSSELT_UNROLL
        for (int j = 0; j < N; ++j)
            v[j] = (Real(1) / sqrt(dot(light.vertex[j], light.vertex[j]))) * light.vertex[j];
        total_ = Real(0);
        NUSSELT_UNROLL
        for (int j = 0; j < kTriangles; ++j) {
            triangle_[j] = Triangle(v[j + 1], v[0], v[j + 2]);
            total_ = total_ + triangle_[j].solid_angle;
        }
        const Mask lit = total_ > Real(0);
        inverse_total_ = select(lit, Real(1) / select(lit, total_, Real(1)), Real(0));
    }

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit PolygonSolidAngleArvo(const PolygonSolidAngleArvo<Single, N>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1)^2; x moves along the outline of the light, y from vertex 0 to it.
    /// \returns the direction alone; sample() adds density and point.
    NUSSELT_HD Vec3<Real> direction(const Vec2<Real>& u) const noexcept {
        Real part = u.x * total_;
        // Scalars read the triangle in place.
        if constexpr (peters::kIsScalar<Real>) {
            int j = 0;
            while (j < kTriangles - 1 && part >= triangle_[j].solid_angle) part -= triangle_[j++].solid_angle;
            return triangle_[j].direction(part, u.y);
        } else {
            Triangle t = triangle_[0];
            NUSSELT_UNROLL
            for (int j = 1; j < kTriangles; ++j) {
                const Mask reached = (triangle_[j].solid_angle > Real(0)) & (part >= t.solid_angle);
                part = select(reached, part - t.solid_angle, part);
                t = select(reached, triangle_[j], t);
            }
            return t.direction(part, u.y);
        }
    }

    /// \copydoc direction
    NUSSELT_HD LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const Vec3<Real> up{Real(0), Real(0), Real(1)};
        const Vec3<Real> wi = select(inverse_total_ > Real(0), direction(u), up);
        return {wi, inverse_total_, (plane_distance_ / dot(plane_normal_, wi)) * wi};
    }

    /// Constant on the light; the caller knows that wi hits it.
    NUSSELT_HD Real pdf(const Vec3<Real>&) const noexcept { return inverse_total_; }

    /// The random numbers for which sample() returns wi, a unit direction on the light.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept {
        // Seen from the shading point, a light whose normal points away has its vertices in clockwise order.
        const Real side = select(plane_distance_ < Real(0), Real(1), Real(-1));
        Real part = Real(0);
        Real along = Real(0);
        for (int j = 0; j < kTriangles; ++j) {
            const auto place = triangle_[j].place_of(wi, side);
            part = part + place.part;
            along = j == 0 ? place.u : select(place.behind, place.u, along);
        }
        return {below_one(part * inverse_total_), below_one(along)};
    }

    /// Solid angle of the light [sr].
    NUSSELT_HD Real measure() const noexcept { return total_; }

private:
    Vec3<Real> plane_normal_;
    Real plane_distance_;
    Triangle triangle_[kTriangles];
    Real total_;
    Real inverse_total_; ///< the density; 0 without light

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.plane_normal_, self.plane_distance_, self.triangle_, self.total_, self.inverse_total_);
    }
};

NUSSELT_NAMESPACE_END
