#pragma once
/// Lights, points and occluders that break visibility: degenerate, touching, coplanar, tiny and huge.

#include <cstdint>
#include <vector>

#include "experiments/hostile/lights.h"
#include "experiments/shadows/cut_by_mesh.h"

NUSSELT_NAMESPACE_BEGIN
namespace shadows {

/// One case: all lines of a light that a point sees past some triangles.
struct HostileCase {
    ConvexPolygon<float, 4> light;
    Vec3<float> point;
    std::vector<Triangle<float>> triangles;
    float angle;
    float u[kLinesPerCase];
};

/// \param index of the case; cases depend on it and the seed only.
inline HostileCase make_hostile_case(std::uint64_t seed, std::uint64_t index) {
    hostile::HostileLights<float> lights(seed, index);
    hostile::RandomSource random(~seed, index);
    HostileCase result;
    result.light = lights.polygon();
    result.point = {0, 0, 0};
    const ConvexPolygon<float, 4>& light = result.light;
    const auto on_light = [&] {
        const int vertex = random.index(4);
        if (random.index(3) == 0) return light.vertex[vertex];
        // An edge, or anywhere in the plane.
        const auto share = [&] { return static_cast<float>(random.between(-0.5, 1.5)); };
        const Vec3<float> on_edge = fma(share(), light.edge[vertex], light.vertex[vertex]);
        if (random.index(2) == 0) return on_edge;
        return fma(share(), light.edge[vertex == 3 ? 0 : vertex + 1], on_edge);
    };
    if (random.index(8) == 0) result.point = on_light();
    const auto corner = [&]() -> Vec3<float> {
        const Vec3<float> to_light = on_light() - result.point;
        switch (random.index(8)) {
        case 0:
            return result.point;
        case 1:
            return result.point + to_light;
        case 2: // almost the point, or the light
            return fma(static_cast<float>(random.log_between(1e-9, 1)), to_light, result.point);
        case 3:
            return fma(static_cast<float>(1 - random.log_between(1e-9, 1)), to_light, result.point);
        case 4: // behind one of them
            return fma(static_cast<float>(random.between(-1, 2)), to_light, result.point);
        case 5: {
            const auto coordinate = [&] {
                const double x = random.log_between(1e-20, 1e15);
                return static_cast<float>(random.index(2) == 0 ? x : -x);
            };
            return {coordinate(), coordinate(), coordinate()};
        }
        default: {
            const double size = static_cast<double>(length(to_light)) * random.log_between(1e-3, 10);
            const Vec3<double> v = size * random.direction();
            return result.point +
                   Vec3<float>{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
        }
        }
    };
    const int count = 1 + random.index(24);
    for (int i = 0; i < count; ++i) {
        Triangle<float> triangle{corner(), corner(), corner()};
        if (i > 0 && random.index(2) == 0) triangle[0] = result.triangles.back()[1];
        if (random.index(16) == 0) triangle[2] = triangle[0];
        result.triangles.push_back(in_order_of_position(triangle));
    }
    result.angle = random.index(4) == 0 ? 0 : static_cast<float>(random.between(0, 3.14));
    for (float& u : result.u) u = lights.random_number();
    return result;
}

/// Whether lines of a case lose what is hidden and nothing else: parts are finite, disjoint and within the line, and no
/// occluder makes more of it visible.
/// \param length of what is visible in the end, added up.
/// \returns what is wrong, or null
inline const char* violation(const HostileCase& test, double& length) {
    constexpr int kCapacity = 12; // some lines have more parts
    const LineFamily<float, 4> family(test.light, test.angle);
    const ShadowFrame<float> frame = make_shadow_frame(family.plane(), test.point);
    const LineFamily<Lines, 4> families(family);
    const Lines offset = families.sample_by_length(Lines::load(test.u)).offset;
    const Interval<Lines> whole = families.chord(offset).extent;
    Interval<Lines> storage[kCapacity];
    VisibleParts<Lines> parts(storage, kCapacity);
    parts.reset(whole);
    const auto visible = [&] {
        Lines sum(0.0f);
        for (int k = 0; k < parts.count(); ++k) sum = sum + max(parts[k].end - parts[k].begin, Lines(0.0f));
        return sum;
    };
    const char* problem = nullptr;
    const Lines whole_length = whole.end - whole.begin;
    const Lines rounding = Lines(1e-5f) * whole_length;
    Lines before = visible();
    if (any(before > whole_length)) problem = "more is visible than there is";
    constexpr float kLargest = std::numeric_limits<float>::max();
    for_each_shadow<kLinesPerCase>(frame, test.triangles, {family.offsets(), {-kLargest, kLargest}},
                                   [&](const auto& shadow) {
                                       parts.cut(hidden_from(shadow, offset));
                                       const Lines after = visible();
                                       if (!all(after <= before + rounding))
                                           problem = "an occluder adds light";
                                       before = after;
                                   });
    if (parts.count() < 0 || parts.count() > kCapacity) problem = "too many parts";
    for (int k = 0; k < parts.count(); ++k) {
        const auto used = parts[k].begin < parts[k].end;
        if (any(used & ((parts[k].begin < whole.begin) | (parts[k].end > whole.end))))
            problem = "a part is not on the line";
        if (any(used & ((parts[k].begin < parts.bounds().begin) | (parts[k].end > parts.bounds().end))))
            problem = "a part is out of the bounds of all parts";
        for (int j = 0; j < k; ++j)
            if (any(used & (parts[j].begin < parts[j].end) & (parts[k].begin < parts[j].end) &
                    (parts[j].begin < parts[k].end)))
                problem = "parts overlap";
    }
    if (!all(is_finite(before) & (before >= Lines(0.0f)))) problem = "the visible length is not a number";
    for (int i = 0; i < kLinesPerCase; ++i)
        if (whole_length.lane(i) > 0) length += before.lane(i) / whole_length.lane(i);
    return problem;
}

} // namespace shadows
NUSSELT_NAMESPACE_END
