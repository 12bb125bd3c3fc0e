#pragma once
/// Pairs of techniques: one for the diffuse component of a surface, one for the specular component.

#include <nusselt/cones/cone_ltc.h>
#include <nusselt/cones/cone_projected_solid_angle.h>
#include <nusselt/estimate/surface.h>
#include <nusselt/sampling/cylinder_ltc.h>
#include <nusselt/sampling/cylinder_projected_solid_angle.h>
#include <nusselt/sampling/line_ltc.h>
#include <nusselt/sampling/line_projected_solid_angle.h>
#include <nusselt/sampling/polygon_brdf.h>
#include <nusselt/sampling/polygon_ltc.h>
#include <nusselt/sampling/polygon_projected_solid_angle.h>
#include <nusselt/sampling/polygon_solid_angle.h>

NUSSELT_NAMESPACE_BEGIN

// A pair has two static functions for each kind of light in shading space, diffuse(light, surface) and
// specular(light, surface), that make techniques; and two that estimate the integral of a normalised component over the
// light: diffuse_integral(technique), specular_integral(technique).

/// The common part of pairs whose techniques have the integrals of the components as their measures.
struct CosineMeasures {
    template <class Technique>
    NUSSELT_HD static auto diffuse_integral(const Technique& technique) noexcept {
        using Real = decltype(technique.measure());
        return Real(1 / kPi<scalar_t<Real>>) * technique.measure();
    }
    template <class Technique>
    NUSSELT_HD static auto specular_integral(const Technique& technique) noexcept {
        return technique.measure();
    }
};

/// Projected solid angle and linearly transformed cosine, as published: next to no noise except from shadows.
struct ProjectedSolidAngleAndLtc : CosineMeasures {
    template <class Real, int N, class Surface>
    NUSSELT_HD static auto diffuse(const ConvexPolygon<Real, N>& light, const Surface& /*surface*/) noexcept {
        return PolygonProjectedSolidAngle<Real, N>(light);
    }
    template <class Real, int N, class Surface>
    NUSSELT_HD static auto specular(const ConvexPolygon<Real, N>& light, const Surface& surface) noexcept {
        return PolygonLtc<Real, N>(light, surface.lobe);
    }
    template <class Real, class Surface>
    NUSSELT_HD static auto diffuse(const LineSegment<Real>& light, const Surface& /*surface*/) noexcept {
        return LineProjectedSolidAngle<Real>(light);
    }
    template <class Real, class Surface>
    NUSSELT_HD static auto specular(const LineSegment<Real>& light, const Surface& surface) noexcept {
        return LineLtc<Real>(light, surface.lobe);
    }
    template <class Real, class Surface>
    NUSSELT_HD static auto diffuse(const Cylinder<Real>& light, const Surface& /*surface*/) noexcept {
        return CylinderProjectedSolidAngle<Real>(light);
    }
    template <class Real, class Surface>
    NUSSELT_HD static auto specular(const Cylinder<Real>& light, const Surface& surface) noexcept {
        return CylinderLtc<Real>(light, surface.lobe);
    }
    template <class Real, class Surface>
    NUSSELT_HD static auto diffuse(const Sphere<Real>& light, const Surface& /*surface*/) noexcept {
        return ConeProjectedSolidAngle<Real, Sphere>(light);
    }
    template <class Real, class Surface>
    NUSSELT_HD static auto specular(const Sphere<Real>& light, const Surface& surface) noexcept {
        return ConeLtc<Real, Sphere>(light, surface.lobe);
    }
    template <class Real, class Surface>
    NUSSELT_HD static auto diffuse(const Disk<Real>& light, const Surface& /*surface*/) noexcept {
        return ConeProjectedSolidAngle<Real, Disk>(light);
    }
    template <class Real, class Surface>
    NUSSELT_HD static auto specular(const Disk<Real>& light, const Surface& surface) noexcept {
        return ConeLtc<Real, Disk>(light, surface.lobe);
    }
    template <class Real, class Surface>
    NUSSELT_HD static auto diffuse(const Ellipse<Real>& light, const Surface& /*surface*/) noexcept {
        return ConeProjectedSolidAngle<Real, Ellipse>(light);
    }
    template <class Real, class Surface>
    NUSSELT_HD static auto specular(const Ellipse<Real>& light, const Surface& surface) noexcept {
        return ConeLtc<Real, Ellipse>(light, surface.lobe);
    }
    template <class Real, class Surface>
    NUSSELT_HD static auto diffuse(const Ellipsoid<Real>& light, const Surface& /*surface*/) noexcept {
        return ConeProjectedSolidAngle<Real, Ellipsoid>(light);
    }
    template <class Real, class Surface>
    NUSSELT_HD static auto specular(const Ellipsoid<Real>& light, const Surface& surface) noexcept {
        return ConeLtc<Real, Ellipsoid>(light, surface.lobe);
    }
};

/// The same for polygons without iteration and with a fast arctangent (Peters 2021, polygonal lights, Sec. 6.4): cheaper,
/// slightly biased.
struct BiasedProjectedSolidAngleAndLtc : CosineMeasures {
    template <class Real, int N, class Surface>
    NUSSELT_HD static auto diffuse(const ConvexPolygon<Real, N>& light, const Surface& /*surface*/) noexcept {
        return PolygonProjectedSolidAngleBiased<Real, N>(light);
    }
    template <class Real, int N, class Surface>
    NUSSELT_HD static auto specular(const ConvexPolygon<Real, N>& light, const Surface& surface) noexcept {
        return PolygonLtcBiased<Real, N>(light, surface.lobe);
    }
};

/// The base of pairs with sampling of the BRDF, the published competitors, for polygons only. Such samples are not
/// confined to the light, so that the integral of the specular component is unknown: heuristics with
/// coefficients give them no weight. Meant for BalanceHeuristic.
/// \tparam Lobe GgxVisibleNormals or GgxBoundedVisibleNormals.
template <template <class...> class Lobe>
struct BrdfSampling {
    template <class Real, int N, class Surface>
    NUSSELT_HD static auto specular(const ConvexPolygon<Real, N>& light, const Surface& surface) noexcept {
        return PolygonBrdf<Real, N, Lobe<Real>>(light, Lobe<Real>(surface.wo, surface.alpha));
    }
    template <class Technique>
    NUSSELT_HD static auto diffuse_integral(const Technique& technique) noexcept {
        return CosineMeasures::diffuse_integral(technique);
    }
    template <class Real, int N>
    NUSSELT_HD static Real specular_integral(const PolygonBrdf<Real, N, Lobe<Real>>& /*technique*/) noexcept {
        return Real(0);
    }
};

/// Projected solid angle and visible normals.
template <template <class...> class Lobe>
struct ProjectedSolidAngleAndBrdf : BrdfSampling<Lobe> {
    template <class Real, int N, class Surface>
    NUSSELT_HD static auto diffuse(const ConvexPolygon<Real, N>& light, const Surface& /*surface*/) noexcept {
        return PolygonProjectedSolidAngle<Real, N>(light);
    }
};

/// Solid angle and visible normals: what most renderers do.
template <template <class...> class Lobe>
struct SolidAngleAndBrdf : BrdfSampling<Lobe> {
    template <class Real, int N, class Surface>
    NUSSELT_HD static auto diffuse(const ConvexPolygon<Real, N>& light, const Surface& /*surface*/) noexcept {
        return PolygonSolidAngle<Real, N>(light);
    }
};

NUSSELT_NAMESPACE_END
