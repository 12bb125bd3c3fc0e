#include "render_vulkan/shadows/shadow_scene.h"

#include "render_vulkan/scene_buffers.h"
#include "visibility/query_geometry.h"
#include "visibility/triangle_bvh.h"

#include <span>

namespace nusselt::render_vulkan {

namespace {

gpu::AccelerationStructure make_structure(const gpu::Device& device, const scene::Scene& scene,
                                          const visibility::QueryGeometry& geometry) {
    std::vector<gpu::RayTriangles> triangles;
    for (const visibility::QueryPart& part : geometry.parts) triangles.push_back({part.opaque, part.partial});
    std::vector<gpu::RayInstance> instances;
    for (std::size_t i = 0; i < geometry.instances.size(); ++i)
        instances.push_back({geometry.instances[i].part, i == 0 ? scene::Instance{}.world_from_object
                                                                : scene.instances[i - 1].world_from_object});
    const std::span positions(reinterpret_cast<const float*>(scene.positions.data()),
                              3 * scene.positions.size());
    return {device, positions, triangles, instances, geometry.round_boxes};
}

} // namespace

ShadowRays default_shadow_rays(const gpu::Device& device) {
    // Mesa's software device takes up to ten times as long for its own ray queries (docs/performance.md).
    return device.features().ray_queries && !device.description().is_software ? ShadowRays::query
                                                                              : ShadowRays::bvh;
}

ShadowScene::ShadowScene(const gpu::Device& device, const scene::Scene& scene, ShadowRays way) : way_(way) {
    if (way == ShadowRays::query && !device.features().ray_queries)
        throw gpu::Error(device.description().name +
                         ": the device does not support ray queries; use --shadow-rays bvh");
    if (way == ShadowRays::none) return;
    const auto add = [&](const auto& values, const char* what) {
        buffers_.push_back(upload(device, std::span(values), what));
    };
    if (way == ShadowRays::bvh) {
        const visibility::TriangleBvh bvh = visibility::make_triangle_bvh(scene);
        add(bvh.nodes, "nodes of the hierarchy");
        add(bvh.triangles, "triangles of the hierarchy");
        add(bvh.instances, "instances of the hierarchy");
        return;
    }
    const visibility::QueryGeometry geometry = visibility::make_query_geometry(scene);
    add(geometry.instances, "instances for ray queries");
    add(geometry.partial_triangles, "partial triangles for ray queries");
    structure_.emplace(make_structure(device, scene, geometry));
}

std::vector<const gpu::Buffer*> ShadowScene::buffers() const {
    std::vector<const gpu::Buffer*> pointers;
    for (const gpu::Buffer& buffer : buffers_) pointers.push_back(&buffer);
    return pointers;
}

} // namespace nusselt::render_vulkan
