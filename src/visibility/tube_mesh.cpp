#include "visibility/tube_mesh.h"

#include "scene/model/scene_size.h"

#include <nusselt/core/frame.h>
#include <nusselt/core/trig.h>

#include <cmath>

namespace nusselt::visibility {

namespace {

Vec3<double> to_double(const scene::Float3& v) { return {v.x, v.y, v.z}; }

scene::Float3 to_float(const Vec3<double>& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Radius of the corners of a regular polygon with the area of the unit circle.
double corner_radius() {
    const double angle = 2 * kPi<double> / kTubeSides;
    return std::sqrt(angle / std::sin(angle));
}

void append_tube(const scene::LineLight& light, TubeMesh& mesh) {
    const Vec3<double> begin = to_double(light.start);
    const Vec3<double> end = to_double(light.end);
    const auto frame = Frame<double>::from_normal(normalize(end - begin));
    const double radius = light.radius * corner_radius();
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::uint32_t side = 0; side < kTubeSides; ++side) {
        const double angle = 2 * kPi<double> * side / kTubeSides;
        const Vec3<double> offset =
            (radius * std::cos(angle)) * frame.t + (radius * std::sin(angle)) * frame.b;
        mesh.positions.push_back(to_float(begin + offset));
        mesh.positions.push_back(to_float(end + offset));
    }
    for (std::uint32_t side = 0; side < kTubeSides; ++side) {
        const std::uint32_t here = first + 2 * side;
        const std::uint32_t next = first + 2 * ((side + 1) % kTubeSides);
        mesh.triangles.push_back({{here, next, here + 1}});
        mesh.triangles.push_back({{next, next + 1, here + 1}});
    }
    for (std::uint32_t side = 1; side + 1 < kTubeSides; ++side) {
        const std::uint32_t here = first + 2 * side;
        mesh.triangles.push_back({{first, here + 2, here}});
        mesh.triangles.push_back({{first + 1, here + 1, here + 3}});
    }
}

} // namespace

TubeMesh make_tube_mesh(const std::vector<scene::LineLight>& lights) {
    scene::check_counts(lights.size() * 2 * kTubeSides, lights.size() * kTrianglesPerTube);
    TubeMesh mesh;
    mesh.positions.reserve(lights.size() * 2 * kTubeSides);
    mesh.triangles.reserve(lights.size() * kTrianglesPerTube);
    for (const scene::LineLight& light : lights) append_tube(light, mesh);
    return mesh;
}

} // namespace nusselt::visibility
