#pragma once
/// The arrays behind KernelScene.

#include "render_cpu/kernel.h"

#include <vector>

namespace nusselt::render_cpu {

/// Owns what kernels need beyond the arrays of a scene.
class KernelArrays {
public:
    /// \param scene must outlive this object
    /// \throws std::runtime_error if the scene has more data than 32-bit indices reach, or a light with
    ///         fewer than 3 vertices
    explicit KernelArrays(const scene::Scene& scene);

    /// Views of this object and its scene.
    KernelScene view(BrdfChoice brdf) const;

private:
    const scene::Scene& scene_;
    std::vector<MaterialRow> materials_;
    std::vector<MaterialRow> lambert_materials_;
    std::vector<std::int32_t> material_texture_;
    std::vector<TextureView> textures_;
    std::vector<PolygonLightRecord> polygon_lights_;
    std::vector<scene::Float3> polygon_corners_;
    std::vector<LineLightRecord> line_lights_;
};

} // namespace nusselt::render_cpu
