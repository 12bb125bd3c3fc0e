#pragma once
/// The arrays behind KernelScene.

#include "render/pixel_filter.h"
#include "render_cpu/kernel.h"

#include <vector>

namespace nusselt::render_cpu {

/// Owns what kernels need beyond the arrays of a scene.
class KernelArrays {
public:
    /// \param scene must outlive this object
    /// \throws std::runtime_error if the scene has more data than 32-bit indices reach, a light with fewer than 3
    ///         vertices, an instance whose transform cannot be inverted or a pixel filter without weight
    explicit KernelArrays(const scene::Scene& scene);

    /// Views of this object and its scene.
    KernelScene view(BrdfChoice brdf) const;

private:
    const scene::Scene& scene_;
    std::vector<MaterialRow> materials_;
    std::vector<MaterialRow> lambert_materials_;
    std::vector<std::uint32_t> material_texture_kinds_;
    std::vector<MaterialTextures> material_textures_;
    std::vector<TextureView> textures_;
    std::vector<PolygonLightRecord> polygon_lights_;
    std::vector<scene::Float3> polygon_corners_;
    std::vector<LineLightRecord> line_lights_;
    std::vector<InstanceRecord> instances_;
    PixelFilterTable filter_x_;
    PixelFilterTable filter_y_;
    std::vector<std::uint32_t> light_emitter_; ///< of polygonal lights, then of line lights
};

} // namespace nusselt::render_cpu
