#include "render_cpu/lights/round_records.h"

#include "render_cpu/lights/light_kernel.h"
#include "scene/model/scene.h"
#include "scene/model/vector_math.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace nusselt::render_cpu {

namespace {

using scene::Double3;
using scene::RoundModel;

bool is_flat(const scene::RoundLight& light) { return light.model == RoundModel::ellipse; }

/// Whether the semi-diameters are perpendicular and equally long, up to the rounding of transforms.
bool is_circular(const scene::RoundLight& light) {
    constexpr double kTolerance = 1e-6;
    const Double3 u = to_double(light.u), v = to_double(light.v), w = to_double(light.w);
    const double square = dot(u, u);
    const auto is_small = [&](double x) { return std::fabs(x) <= kTolerance * square; };
    if (!is_small(dot(v, v) - square) || !is_small(dot(u, v))) return false;
    return is_flat(light) || (is_small(dot(w, w) - square) && is_small(dot(u, w)) && is_small(dot(v, w)));
}

RoundRecord make_record(const scene::RoundLight& light) {
    RoundRecord record{};
    const bool is_round = is_circular(light);
    record.shape = is_flat(light) ? (is_round ? RoundShape::disk : RoundShape::ellipse)
                                  : (is_round ? RoundShape::sphere : RoundShape::ellipsoid);
    const Double3 axis[] = {to_double(light.u), to_double(light.v), to_double(light.w)};
    record.center = light.center;
    record.axis[0] = light.u;
    record.axis[1] = light.v;
    record.axis[2] = light.w;
    record.radius = static_cast<float>(scene::semi_axes(light)[1]);
    record.radiance = light.radiance;
    record.emits_outwards = light.two_sided || light.model != RoundModel::hollow;
    record.emits_inwards = light.two_sided || light.model == RoundModel::hollow;
    record.shell = 1;
    record.normal = to_float(normalized(cross(axis[0], axis[1])));
    if (is_flat(light)) return record;
    const double volume = dot(axis[0], cross(axis[1], axis[2]));
    for (std::size_t i = 0; i < 3; ++i)
        record.inverse[i] = to_float((1 / volume) * cross(axis[(i + 1) % 3], axis[(i + 2) % 3]));
    return record;
}

Double3 in_unit_sphere(const RoundRecord& record, const scene::Float3& p) {
    const Double3 offset = to_double(p) - to_double(record.center);
    return {dot(to_double(record.inverse[0]), offset), dot(to_double(record.inverse[1]), offset),
            dot(to_double(record.inverse[2]), offset)};
}

/// The distance of the plane of a triangle from the centre, in the space of the unit sphere.
double plane_distance(const scene::Scene& scene, const RoundRecord& record, const scene::Triangle& triangle) {
    Double3 p[3];
    for (std::size_t i = 0; i < 3; ++i) p[i] = in_unit_sphere(record, scene.positions[triangle.vertex[i]]);
    return std::fabs(dot(normalized(cross(p[1] - p[0], p[2] - p[0])), p[0]));
}

/// Shrinks the shells of lights that emit inwards into their surfaces.
/// \param first the number of the first record among all lights of the scene
void fit_shells(const scene::Scene& scene, std::size_t first, std::vector<RoundRecord>& records) {
    const auto is_relevant = [](const RoundRecord& record) {
        return record.emits_inwards != 0 &&
               (record.shape == RoundShape::sphere || record.shape == RoundShape::ellipsoid);
    };
    if (std::none_of(records.begin(), records.end(), is_relevant)) return;
    constexpr double kMargin = 1e-4; // for rounding, and because shadow rays have to end before the surface
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        const std::int64_t index = std::int64_t{scene.triangle_light[i]} - static_cast<std::int64_t>(first);
        if (index < 0 || index >= static_cast<std::int64_t>(records.size())) continue;
        RoundRecord& record = records[static_cast<std::size_t>(index)];
        if (!is_relevant(record)) continue;
        const double distance = plane_distance(scene, record, scene.triangles[i]);
        // Comparisons with NaN, of triangles without area, are false.
        if (distance * (1 - kMargin) < record.shell)
            record.shell = static_cast<float>(distance * (1 - kMargin));
    }
}

} // namespace

std::shared_ptr<const void> make_round_records(const scene::Scene& scene, const scene::LightList& list) {
    const auto* const lights = dynamic_cast<const scene::LightsOf<scene::RoundLight>*>(&list);
    if (lights == nullptr) return nullptr;
    const auto records = std::make_shared<std::vector<RoundRecord>>();
    for (const scene::RoundLight& light : lights->lights) records->push_back(make_record(light));
    fit_shells(scene, scene.lights.of<scene::PolygonLight>().size(), *records);
    return {records, records->data()};
}

} // namespace nusselt::render_cpu
