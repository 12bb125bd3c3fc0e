#pragma once
/// Shadow rays on a Vulkan device, in both ways, and on the CPU.

#include "exact_shadow.h"
#include "gpu/compute_pipeline.h"
#include "visibility/triangle_bvh.h"

#include <memory>
#include <ostream>
#include <vector>

namespace nusselt::gpu_visibility_test {

enum class Way { bvh, query };
inline std::ostream& operator<<(std::ostream& stream, Way way) {
    return stream << (way == Way::bvh ? "bvh" : "query");
}

/// The data about alpha for shaders/parity/trace_rays.glsl: the coordinates of each triangle of a scene, and its
/// material's alpha; triangles without an alpha texture lie in its bright half.
std::vector<float> alphas_of(const scene::Scene& scene);

/// A scene on a device.
class GpuTracer {
public:
    GpuTracer(const gpu::Device& device, const scene::Scene& scene, Way way);
    /// \param bvh in place of that of the scene
    GpuTracer(const gpu::Device& device, const scene::Scene& scene, const visibility::TriangleBvh& bvh);

    /// \returns whether each is blocked: 0 or 1
    std::vector<std::uint32_t> trace(const std::vector<Ray>& rays);

private:
    GpuTracer(const gpu::Device& device, Way way);
    void bind(const scene::Scene& scene, const visibility::TriangleBvh& bvh);
    void bind_query(const scene::Scene& scene);
    template <class T>
    const gpu::Buffer* add(const std::vector<T>& values);

    const gpu::Device* device_;
    gpu::ComputePipeline pipeline_;
    gpu::Buffer rays_, results_;
    std::vector<std::unique_ptr<gpu::Buffer>> buffers_;
    std::unique_ptr<gpu::AccelerationStructure> structure_;
};

/// The same by visibility::EmbreeScene.
std::vector<std::uint32_t> trace_on_cpu(const scene::Scene& scene, const std::vector<Ray>& rays);

} // namespace nusselt::gpu_visibility_test
