#include "render_cpu/kernel/lights/polygon_light.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {
namespace {

void choose(const render_cpu::RenderJob& job, render_cpu::AddLight (&add)[render_cpu::kMostShapes]) noexcept {
    const bool has_lines = job.light_samples == render::LightSamples::lines;
    add[0] = has_lines ? polygon_lines<4>() : polygon_points<4>(job);
    add[1] = has_lines ? polygon_lines<8>() : polygon_points<8>(job);
    add[2] = has_lines ? polygon_lines<4>() : textured_points<4>(job);
    add[3] = has_lines ? polygon_lines<8>() : textured_points<8>(job);
    add[4] = profiled_points<4>(job);
    add[5] = profiled_points<8>(job);
}

std::int32_t shape_of(const render_cpu::LightSet& lights, std::int32_t index) noexcept {
    const render_cpu::PolygonRecord& record = polygon_record(lights, index);
    return (record.slots == 4 ? 0 : 1) + (record.profile >= 0 ? 4 : record.texture >= 0 ? 2 : 0);
}

/// The radiance where a ray meets the plane of a texture.
scene::Float3 radiance_along(const render_cpu::PolygonTexture& texture, const Vec3<float>& origin,
                             const Vec3<float>& direction) noexcept {
    TexturePlane<float> plane = plane_of(texture);
    plane.corner = plane.corner - origin;
    const float distance = dot(plane.normal, plane.corner) / dot(plane.normal, direction);
    const Vec2<float> at = TextureCoordinates<float>(plane)(distance * direction);
    const Vec3<float> radiance = radiance_at(texture, Vec2<float>{at.x > 0 ? at.x : 0, at.y > 0 ? at.y : 0});
    return {radiance.x, radiance.y, radiance.z};
}

scene::Float3 emission(const render_cpu::LightSet& lights, std::int32_t index, const scene::Float3& origin,
                       const scene::Float3& direction) noexcept {
    const render_cpu::PolygonRecord& light = polygon_record(lights, index);
    const bool is_seen = light.two_sided != 0 || dot(to_vec(light.normal), to_vec(direction)) < 0;
    if (!is_seen) return {0, 0, 0};
    if (const render_cpu::PolygonProfile* const profile = profile_of(lights, index)) {
        const Vec3<float> away = -normalize(to_vec(direction));
        const float factor = relative_radiance(*profile, axes_of(*profile), away);
        return {factor * light.radiance.x, factor * light.radiance.y, factor * light.radiance.z};
    }
    const render_cpu::PolygonTexture* const texture = texture_of(lights, index);
    return texture == nullptr ? light.radiance : radiance_along(*texture, to_vec(origin), to_vec(direction));
}

} // namespace
} // namespace kernel
NUSSELT_NAMESPACE_END

namespace nusselt::render_cpu {

LightCode polygon_code(LaneCount<kernel::kLanes>) {
    return {&kernel::choose, &kernel::shape_of, &kernel::emission};
}

} // namespace nusselt::render_cpu
