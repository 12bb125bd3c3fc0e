#pragma once
/// Partly shadowed lights over glossy surfaces, and the light that the surfaces reflect, by quadrature.

#include <cstdint>
#include <string>
#include <vector>

#include <nusselt/estimate/direct_light.h>

#include "geometry/adaptive_quadrature.h"
#include "geometry/cylinder_reference.h"
#include "sampling/lights.h"
#include "shipped_table.h"

namespace nusselt_test {

using Direction = nusselt::Vec3<double>;
using Surface = nusselt::GlossySurface<double>;

struct NamedSurface {
    std::string name;
    Surface surface;
};

/// Plastic and metal, seen from the normal to almost the horizon.
inline std::vector<NamedSurface> surfaces(const std::vector<double>& roughnesses) {
    static const ShippedTable table("ltc-frostbite.bin");
    std::vector<NamedSurface> list;
    for (const double roughness : roughnesses) {
        for (const double inclination : {0.0, 1.0, 1.5}) {
            const std::string name =
                "roughness " + std::to_string(roughness) + ", inclination " + std::to_string(inclination);
            const double cos_o = std::cos(inclination);
            list.push_back({name + ", plastic",
                            nusselt::make_glossy_surface<double>(cos_o, {0.8, 0.4, 0.1}, {0.04, 0.04, 0.04},
                                                                 roughness, table.view())});
            list.push_back({name + ", metal", nusselt::make_glossy_surface<double>(
                                                  cos_o, {0, 0, 0}, {1, 0.7, 0.3}, roughness, table.view())});
        }
    }
    return list;
}

/// wo is in the xz half-plane with x >= 0, highlights are in that with x <= 0.
inline std::vector<PolygonCase> polygons_to_reflect() {
    return {
        {"in the highlight", {{-1.5, -0.5, 0.7}, {-1.5, 0.4, 0.7}, {-1.2, 0.4, 1.3}, {-1.2, -0.5, 1.3}}},
        {"wall through the floor", {{-1, -1, -0.5}, {-1, 1, -0.5}, {-1, 1, 1}, {-1, -1, 1}}},
        {"beyond the lobe", {{1.2, -0.6, 0.05}, {1.2, 0.8, 0.05}, {1.1, 0.8, 0.4}, {1.1, -0.6, 0.4}}},
        {"around the zenith", {{-0.4, -0.5, 1}, {0.5, -0.3, 1}, {0.1, 0.7, 1}}},
        {"large and close", {{-8, -9, 0.5}, {7, -9, 0.5}, {7, 6, 0.5}, {-8, 6, 0.5}}},
    };
}

inline std::vector<LineCase> lines_to_reflect() {
    return {
        {"along the highlight", {-2, -0.3, 0.2}, {-0.1, 0.1, 1.2}},
        {"through the floor", {-1, 0.8, -0.5}, {-1.2, -0.6, 1}},
        {"beyond the lobe", {1.2, -0.6, 0.05}, {1.1, 0.8, 0.4}},
        {"overhead", {-3, 0.1, 0.4}, {2, -0.2, 0.4}},
    };
}

inline std::vector<CylinderCase> cylinders_to_reflect() {
    return {
        {"across the highlight", {-1.5, -1, 0.8}, {-1.2, 1, 0.9}, 0.25},
        {"through the horizon", {-1, -1, -0.2}, {-1, 1, 0.4}, 0.3},
        {"in front of a cap", {-0.6, 0.05, 0.7}, {-2, 0.2, 2}, 0.4},
        {"in front of a cap, through the horizon", {-2, 0.1, -0.2}, {-0.6, 0.1, 0.1}, 0.4},
        {"beyond the lobe", {1.2, -0.6, 0.2}, {1.1, 0.8, 0.4}, 0.1},
        {"overhead and thin", {-3, 0.1, 0.4}, {2, -0.2, 0.4}, 0.02},
    };
}

/// An object beside the surface lets little light through. The edge of its shadow halves highlights.
inline constexpr double kTransmitted = 0.3;
inline constexpr Direction kFree{0, 1, 0};

/// The share of the light from a direction that arrives.
using Visibility = double (*)(const Direction& wi);

inline double half_shadow(const Direction& wi) { return dot(kFree, wi) > 0 ? 1 : kTransmitted; }

/// A shadow without an edge, since quadrature over curved surfaces is slow along edges.
inline double gradual_shadow(const Direction& wi) {
    return 0.5 * ((1 + kTransmitted) + (1 - kTransmitted) * dot(kFree, wi));
}

inline double sum_of_channels(const Direction& colour) { return colour.x + colour.y + colour.z; }

/// A light over a surface. `truth` is the sum of the channels of the reflected light, for a radiance of 1.
template <class Light>
struct ReflectedLight {
    std::string name;
    Surface surface;
    Light light;
    Visibility visibility;
    double truth;
};

constexpr long double kQuadratureTolerance = 1e-6L;

inline auto integrand_of(const Surface& surface) {
    return [brdf = surface.brdf](const Point& wi) {
        return wi.z * sum_of_channels(brdf.eval(nusselt::broadcast<double>(wi)));
    };
}

/// \param integral computes the integral over the part of a light on the side of a plane to which a normal points.
template <class Integral>
double with_shadow(const Integral& integral) {
    const Point free = nusselt::broadcast<long double>(kFree);
    return static_cast<double>(integral(free) + kTransmitted * integral(-free));
}

/// All combinations of lights and surfaces.
inline std::vector<ReflectedLight<nusselt::ConvexPolygon<double, 4>>>
reflected_polygons(const std::vector<NamedSurface>& surfaces) {
    std::vector<ReflectedLight<nusselt::ConvexPolygon<double, 4>>> list;
    for (const NamedSurface& s : surfaces) {
        for (const PolygonCase& light : polygons_to_reflect()) {
            const auto polygon = make_light<double>(light);
            const Polygon lit = above_horizon(vertices_of(polygon));
            const auto f = integrand_of(s.surface);
            const auto truth = with_shadow([&](const Point& side) {
                return integrate_solid_angle(cut(lit, side), f, kQuadratureTolerance);
            });
            list.push_back({s.name + ", " + light.name, s.surface, polygon, half_shadow, truth});
        }
    }
    return list;
}

/// \copydoc reflected_polygons
inline std::vector<ReflectedLight<nusselt::LineSegment<double>>>
reflected_lines(const std::vector<NamedSurface>& surfaces) {
    std::vector<ReflectedLight<nusselt::LineSegment<double>>> list;
    for (const NamedSurface& s : surfaces) {
        for (const LineCase& light : lines_to_reflect()) {
            const auto line = make_light<double>(light);
            const Segment lit = cut(Segment{widened_begin(line), widened_end(line)}, {0, 0, 1});
            const auto f = integrand_of(s.surface);
            const auto truth =
                with_shadow([&](const Point& side) { return integrate_per_radius(cut(lit, side), f); });
            list.push_back({s.name + ", " + light.name, s.surface, line, half_shadow, truth});
        }
    }
    return list;
}

/// \copydoc reflected_polygons
inline std::vector<ReflectedLight<nusselt::Cylinder<double>>>
reflected_cylinders(const std::vector<NamedSurface>& surfaces) {
    std::vector<ReflectedLight<nusselt::Cylinder<double>>> list;
    for (const NamedSurface& s : surfaces) {
        for (const CylinderCase& light : cylinders_to_reflect()) {
            const auto cylinder = make_light<double>(light);
            const auto f = [brdf = integrand_of(s.surface)](const Point& wi) {
                return wi.z > 0 ? gradual_shadow(nusselt::broadcast<double>(wi)) * brdf(wi) : 0;
            };
            const auto truth =
                static_cast<double>(integrate_solid_angle(solid(cylinder), f, kQuadratureTolerance));
            list.push_back({s.name + ", " + light.name, s.surface, cylinder, gradual_shadow, truth});
        }
    }
    return list;
}

} // namespace nusselt_test
