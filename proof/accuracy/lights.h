#pragma once
/// Classes of difficult lights in shading space. Their coordinates are floats, so every number type gets the same
/// light. Lights without area or seen edge-on are exactly that.

#include <nusselt/cones/round_lights.h>
#include <nusselt/geometry/convex_polygon.h>
#include <nusselt/geometry/cylinder.h>
#include <nusselt/geometry/line_segment.h>
#include <nusselt/ltc/coefficients.h>

#include <functional>
#include <random>
#include <string_view>
#include <vector>

namespace nusselt::proof {

using Engine = std::mt19937_64;

/// A convex polygon, given by its first vertex and its edges. The last edge closes it.
struct PolygonLight {
    Vec3<float> first;
    Vec3<float> edge[7];
    int count; ///< of vertices, 3 to 8
};

/// Which techniques see anything of a light.
enum class Visibility {
    everyone,
    no_one_above_horizon, ///< dark to the techniques that clip
    no_one,               ///< without area or length, or seen edge-on
};

struct PolygonClass {
    const char* name;
    Visibility visibility;
    int vertex_count;
    PolygonLight (*make)(Engine& engine);
};

struct LineClass {
    const char* name;
    Visibility visibility;
    LineSegment<float> (*make)(Engine& engine);
};

struct CylinderClass {
    const char* name;
    Visibility visibility;
    std::function<Cylinder<float>(Engine&)> make;
};

struct RoundClass {
    const char* name;
    Visibility visibility;
    Ellipsoid<float> (*make)(Engine& engine); ///< from which other round lights are made
};

const std::vector<PolygonClass>& polygon_classes();
const std::vector<LineClass>& line_classes();
/// The lights of proof/tube_lights.h, turned around the normal and moved a little, as well as distant lights, lights
/// that almost touch the point, and dark lights.
const std::vector<CylinderClass>& cylinder_classes();
/// Where a class makes spheres, disks or ellipses invisible, ellipsoids are, too.
const std::vector<RoundClass>& round_classes();

/// Draws a lobe, for example from a fitted table.
using LobeSource = LtcCoefficients<float> (*)(Engine&);

/// A class of lights, each with a lobe.
template <class Base>
struct OnLobes {
    const Base* base;
    LobeSource lobe;
    const char* name = base->name;
    Visibility visibility = base->visibility;

    auto make(Engine& engine) const {
        struct Light {
            decltype(base->make(engine)) light;
            LtcCoefficients<float> lobe;
        };
        const auto light = base->make(engine);
        return Light{light, lobe(engine)};
    }
};

template <class Base>
std::vector<OnLobes<Base>> on_lobes(const std::vector<Base>& bases, LobeSource lobe) {
    std::vector<OnLobes<Base>> result;
    for (const Base& base : bases) {
        result.push_back({&base, lobe});
        // These lights are on the side of the eye, from which lobes lean away.
        if (base.name == std::string_view("in the horizon plane"))
            result.back().visibility = Visibility::no_one;
    }
    return result;
}

} // namespace nusselt::proof
