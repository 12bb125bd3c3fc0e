#include "gpu_tracer.h"

#include "render_vulkan/lights/light_records.h"
#include "shaders/trace_rays_bvh.h"
#include "shaders/trace_rays_query.h"
#include "visibility/embree_scene.h"
#include "visibility/query_geometry.h"

#include <algorithm>
#include <span>

namespace nusselt::gpu_visibility_test {

namespace {

constexpr std::uint32_t kBatch = 1 << 14;
constexpr std::uint32_t kWorkGroup = 64; // as in shaders/parity/trace_rays.glsl
static_assert(sizeof(Ray) == 7 * sizeof(float));

gpu::ComputeInterface interface_of(Way way) {
    const std::uint32_t buffers = way == Way::bvh ? 7 : 6;
    return {
        .storage_buffers = buffers, .ray_scenes = 7 - buffers, .push_constant_size = sizeof(std::uint32_t)};
}

std::span<const std::uint32_t> shader_of(Way way) {
    if (way == Way::bvh) return shaders::kTraceRaysBvh;
    return shaders::kTraceRaysQuery;
}

} // namespace

std::vector<float> alphas_of(const scene::Scene& scene) {
    std::vector<float> alphas;
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        const scene::Material& material = scene.materials[scene.triangle_material[i]];
        for (const std::uint32_t vertex : scene.triangles[i].vertex) {
            const scene::Float2 uv =
                material.alpha_texture.texture < 0 ? scene::Float2{1, 1} : scene.uvs[vertex];
            alphas.insert(alphas.end(), {uv.x, uv.y});
        }
        alphas.push_back(material.alpha);
    }
    return alphas;
}

template <class T>
const gpu::Buffer* GpuTracer::add(const std::vector<T>& values) {
    const std::size_t bytes = std::max(values.size(), std::size_t{1}) * sizeof(T);
    buffers_.push_back(std::make_unique<gpu::Buffer>(*device_, bytes, gpu::Residence::host_visible));
    if (!values.empty()) buffers_.back()->write(std::span(values));
    return buffers_.back().get();
}

GpuTracer::GpuTracer(const gpu::Device& device, Way way)
    : device_(&device),
      pipeline_(device, shader_of(way), interface_of(way)),
      rays_(device, kBatch * sizeof(Ray), gpu::Residence::host_visible),
      results_(device, kBatch * sizeof(std::uint32_t), gpu::Residence::host_visible) {}

GpuTracer::GpuTracer(const gpu::Device& device, const scene::Scene& scene, const visibility::TriangleBvh& bvh)
    : GpuTracer(device, Way::bvh) {
    bind(scene, bvh);
}

GpuTracer::GpuTracer(const gpu::Device& device, const scene::Scene& scene, Way way) : GpuTracer(device, way) {
    if (way == Way::bvh)
        bind(scene, visibility::make_triangle_bvh(scene));
    else
        bind_query(scene);
}

void GpuTracer::bind(const scene::Scene& scene, const visibility::TriangleBvh& bvh) {
    pipeline_.bind({&rays_, &results_, add(alphas_of(scene)), add(render_vulkan::make_round_records(scene)),
                    add(bvh.nodes), add(bvh.triangles), add(bvh.instances)});
}

void GpuTracer::bind_query(const scene::Scene& scene) {
    const visibility::QueryGeometry geometry = visibility::make_query_geometry(scene);
    std::vector<gpu::RayTriangles> triangles;
    for (const visibility::QueryPart& part : geometry.parts) triangles.push_back({part.opaque, part.partial});
    std::vector<gpu::RayInstance> instances;
    for (std::size_t i = 0; i < geometry.instances.size(); ++i)
        instances.push_back({geometry.instances[i].part, i == 0 ? scene::Instance{}.world_from_object
                                                                : scene.instances[i - 1].world_from_object});
    const auto* positions = scene.positions.empty() ? nullptr : &scene.positions[0].x;
    structure_ = std::make_unique<gpu::AccelerationStructure>(
        *device_, std::span(positions, 3 * scene.positions.size()), triangles, instances,
        geometry.round_boxes);
    pipeline_.bind({&rays_, &results_, add(alphas_of(scene)), add(render_vulkan::make_round_records(scene)),
                    add(geometry.instances), add(geometry.partial_triangles)});
    pipeline_.bind(*structure_);
}

std::vector<std::uint32_t> GpuTracer::trace(const std::vector<Ray>& rays) {
    std::vector<std::uint32_t> blocked(rays.size());
    for (std::size_t begin = 0; begin < rays.size(); begin += kBatch) {
        const auto count = static_cast<std::uint32_t>(std::min<std::size_t>(kBatch, rays.size() - begin));
        rays_.write(std::span(rays).subspan(begin, count));
        device_->run([&](const gpu::Device::Commands& commands) {
            pipeline_.dispatch(commands, std::as_bytes(std::span(&count, 1)),
                               (count + kWorkGroup - 1) / kWorkGroup);
        });
        results_.read(std::span(blocked).subspan(begin, count));
    }
    return blocked;
}

std::vector<std::uint32_t> trace_on_cpu(const scene::Scene& scene, const std::vector<Ray>& rays) {
    const visibility::EmbreeScene embree(scene);
    const visibility::RayTracer tracer = embree.tracer();
    std::vector<std::uint32_t> blocked;
    for (const Ray& ray : rays) {
        visibility::RayPacket<4> packet = {};
        for (int axis = 0; axis < 3; ++axis) {
            packet.origin[axis][0] = ray.origin[static_cast<std::size_t>(axis)];
            packet.direction[axis][0] = ray.direction[static_cast<std::size_t>(axis)];
        }
        packet.t_far[0] = ray.t_far;
        const visibility::PacketTracer<4>& packets = tracer;
        blocked.push_back(packets.occluded(tracer.context, 1, packet));
    }
    return blocked;
}

} // namespace nusselt::gpu_visibility_test
