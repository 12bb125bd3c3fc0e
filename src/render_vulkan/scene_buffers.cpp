#include "render_vulkan/scene_buffers.h"

namespace nusselt::render_vulkan {

namespace {

template <class T>
gpu::Buffer upload_all(const gpu::Device& device, const std::vector<T>& values, const char* what) {
    return upload(device, std::span<const T>(values), what);
}

} // namespace

SceneBuffers::SceneBuffers(const gpu::Device& device, const SceneRecords& records)
    : scene(upload(device, std::span(&records.scene, 1), "parameters")),
      vertices(upload_all(device, records.vertices, "vertices")),
      triangles(upload_all(device, records.triangles, "triangles")),
      instances(upload_all(device, records.instances, "instances")),
      materials(upload_all(device, records.materials, "materials")) {
    for (const LightArray& array : records.lights.arrays)
        lights.push_back(upload_all(device, array.words, array.what));
}

} // namespace nusselt::render_vulkan
