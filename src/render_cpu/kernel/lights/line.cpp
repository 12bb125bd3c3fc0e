#include "render_cpu/kernel/lights/line_light.h"
#include "render_cpu/kernel/point_samples.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {
namespace {

void choose(const render_cpu::RenderJob& job, render_cpu::AddLight (&add)[render_cpu::kMostShapes]) noexcept {
    add[0] = line_points(job);
    add[1] = tube_points(job);
    add[2] = textured_lines(job);
    add[3] = textured_tubes(job);
    add[4] = profiled_lines(job);
    add[5] = profiled_tubes(job);
}

/// Whether it is sampled as a line: a linear light or a strip, in place of a tube.
bool is_thin(const render_cpu::LineRecord& record) noexcept {
    return record.model == scene::TubeModel::linear || record.model == scene::TubeModel::strip;
}

std::int32_t shape_of(const render_cpu::LightSet& lights, std::int32_t index) noexcept {
    const render_cpu::LineRecord& record = line_record(lights, index);
    return (is_thin(record) ? 0 : 1) + (record.directions != nullptr ? 4 : record.profile != nullptr ? 2 : 0);
}

/// Where a ray that meets a light does so, as a share of the length. Cameras see a cylinder with flat sides: rays that miss
/// the round one have the closest point of its axis.
float position_along(const render_cpu::LineRecord& record, const Cylinder<float>& tube,
                     const Vec3<float>& wi) noexcept {
    const LineSegment<float>& axis = tube.axis;
    float along;
    const LightHit<float> hit = intersect(tube, wi);
    if (record.model == scene::TubeModel::strip) {
        const Vec3<float> normal = to_vec(record.normal);
        along = dot(dot(normal, axis.p0) / dot(normal, wi) * wi - axis.p0, axis.s);
    } else if (hit.hits) {
        along = dot(hit.distance * wi - axis.p0, axis.s);
    } else {
        const Vec3<float> across = normalize(cross(wi, cross(axis.s, wi)));
        along = -dot(axis.p0, across) / dot(axis.s, across);
    }
    // Comparisons with NaN are false.
    return along > 0 ? min(along / axis.length, 1.0f) : 0.0f;
}

/// The radiance of a light with a profile over its mean. \param wi unit, towards the light
float relative_radiance(const render_cpu::LineRecord& record, const Cylinder<float>& tube,
                        const Vec3<float>& wi) noexcept {
    const LightHit<float> hit = intersect(tube, wi);
    // Beside the round cylinder, cameras see no normal.
    if (is_thin(record) || !hit.hits) return radiance_of_line(record, -wi);
    const Vec3<float> from_start = hit.distance * wi - tube.axis.p0;
    const Vec3<float> across = from_start - dot(from_start, tube.axis.s) * tube.axis.s;
    const Vec3<float> normal = meets_cap(tube, wi) ? tube.axis.s : normalize(across);
    return spread_share(*record.directions, normal, wi) * luminance_of_line(*record.directions, -wi);
}

scene::Float3 emission(const render_cpu::LightSet& lights, std::int32_t index, const scene::Float3& origin,
                       const scene::Float3& direction) noexcept {
    const render_cpu::LineRecord& record = line_record(lights, index);
    if (record.model != scene::TubeModel::open && record.profile == nullptr && record.directions == nullptr)
        return record.radiance;
    const Cylinder<float> tube{
        {to_vec(record.begin) - to_vec(origin), to_vec(record.direction), record.length}, record.radius};
    const Vec3<float> wi = normalize(to_vec(direction));
    if (record.model == scene::TubeModel::open && meets_cap(tube, wi)) return {0, 0, 0};
    if (record.directions != nullptr) {
        const float factor = relative_radiance(record, tube, wi);
        return {factor * record.radiance.x, factor * record.radiance.y, factor * record.radiance.z};
    }
    if (record.profile == nullptr) return record.radiance;
    const Vec3<float> radiance =
        static_cast<const LineRadiance*>(record.profile)->lookup(position_along(record, tube, wi));
    return {radiance.x, radiance.y, radiance.z};
}

} // namespace

render_cpu::AddLight line_points(const render_cpu::RenderJob& job) noexcept {
    return point_samples<LinearLight>(job);
}
render_cpu::AddLight tube_points(const render_cpu::RenderJob& job) noexcept {
    return point_samples<TubeLight>(job);
}

} // namespace kernel
NUSSELT_NAMESPACE_END

namespace nusselt::render_cpu {

LightCode line_code(LaneCount<kernel::kLanes>) {
    return {&kernel::choose, &kernel::shape_of, &kernel::emission};
}

} // namespace nusselt::render_cpu
