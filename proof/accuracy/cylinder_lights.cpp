#include "proof/accuracy/lights.h"

#include "proof/tube_lights.h"

#include <cmath>
#include <random>

namespace nusselt::proof {

namespace {

using Vec = Vec3<double>;

double uniform(Engine& engine, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
}

Vec direction(Engine& engine) {
    const double z = uniform(engine, -1, 1);
    const double angle = uniform(engine, 0, 2 * kPi<double>);
    const double sine = std::sqrt(1 - z * z);
    return {sine * std::cos(angle), sine * std::sin(angle), z};
}

Cylinder<float> cylinder(const Vec& begin, const Vec& end, double radius) {
    return {make_line(broadcast<float>(begin), broadcast<float>(end)), static_cast<float>(radius)};
}

Cylinder<float> around(Engine& engine, const Vec& middle, double half_length, double radius) {
    const Vec half = half_length * direction(engine);
    return cylinder(middle - half, middle + half, radius);
}

Cylinder<float> moved(Engine& engine, const TubeLight& light) {
    const double angle = uniform(engine, 0, 2 * kPi<double>);
    const double c = std::cos(angle), s = std::sin(angle);
    const auto turned = [&](const Vec& v) { return Vec{c * v.x - s * v.y, s * v.x + c * v.y, v.z}; };
    const auto offset = [&] { return (uniform(engine, 0, 0.02) * light.radius) * direction(engine); };
    const Vec begin = turned(light.begin) + offset();
    return cylinder(begin, turned(light.end) + offset(), light.radius);
}

Vec above(Engine& engine) {
    const Vec v = direction(engine);
    return {v.x, v.y, std::fabs(v.z)};
}

} // namespace

const std::vector<CylinderClass>& cylinder_classes() {
    static const std::vector<CylinderClass> classes = [] {
        std::vector<CylinderClass> result;
        static const auto tubes = tube_lights();
        for (const auto& light : tubes)
            result.push_back(
                {light.name.c_str(), Visibility::everyone, [&light](Engine& e) { return moved(e, light); }});
        result.push_back({"cylinder of 1 cm at 40 m", Visibility::everyone,
                          [](Engine& e) { return around(e, 40.0 * above(e), 0.005, 0.002); }});
        result.push_back({"1e-3 of the radius beside it", Visibility::everyone, [](Engine& e) {
                              const Vec s = direction(e);
                              const Vec off = 0.2002 * normalize(cross(s, direction(e)));
                              const double begin = -uniform(e, 0.1, 0.9);
                              return cylinder(begin * s + off, (begin + 1) * s + off, 0.2);
                          }});
        result.push_back({"below the horizon", Visibility::no_one_above_horizon, [](Engine& e) {
                              return around(e, {uniform(e, -1, 1), uniform(e, -1, 1), -0.8}, 0.4, 0.3);
                          }});
        result.push_back({"around the point", Visibility::no_one,
                          [](Engine& e) { return around(e, 0.1 * direction(e), 0.5, 0.3); }});
        result.push_back(
            {"no radius", Visibility::no_one, [](Engine& e) { return around(e, above(e), 0.3, 0); }});
        result.push_back({"no length", Visibility::no_one, [](Engine& e) {
                              const Vec middle = above(e);
                              return cylinder(middle, middle, 0.2);
                          }});
        return result;
    }();
    return classes;
}

} // namespace nusselt::proof
