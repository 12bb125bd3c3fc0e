#pragma once
/// The arrays behind KernelScene.

#include "render/pixel_filter.h"
#include "render_cpu/lights/light_kernel.h"

#include <memory>
#include <span>
#include <vector>

namespace nusselt::render_cpu {

/// Owns the data that kernels need besides the arrays of a scene.
class KernelArrays {
public:
    /// \param scene,kernels must outlive this object
    /// \throws std::runtime_error if the scene has more data than 32-bit indices reach, lights of a kind without a kernel,
    ///         a light with fewer than 3 vertices, an instance whose transform cannot be inverted or a pixel filter without weight
    KernelArrays(const scene::Scene& scene, std::span<const LightKernel> kernels);

    /// Views of this object and its scene, without the sets of lights.
    KernelScene view(BrdfChoice brdf) const;
    /// The lights of each kind, before a job chooses how to sample them.
    std::vector<LightSet> light_sets(base::Isa isa) const;
    /// Whether the scene has lights that LightSamples::lines samples by lines.
    bool take_lines() const;

private:
    /// The lights of one kind.
    struct Lights {
        std::shared_ptr<const void> records;
        const LightKernel* kernel;
        std::int32_t first, count; ///< see LightSet
    };

    void add_lights(const scene::LightList& list, std::span<const LightKernel> kernels);

    const scene::Scene& scene_;
    std::vector<MaterialRow> materials_;
    std::vector<MaterialRow> lambert_materials_;
    std::vector<std::uint32_t> material_texture_kinds_;
    std::vector<MaterialTextures> material_textures_;
    std::vector<TextureView> textures_;
    std::vector<InstanceRecord> instances_;
    PixelFilterTable filter_x_;
    PixelFilterTable filter_y_;
    std::vector<Lights> light_sets_;
    std::vector<std::uint32_t> light_emitter_;
};

} // namespace nusselt::render_cpu
