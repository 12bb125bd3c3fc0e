#pragma once
/// The variants of the shading passes.

#include "render_vulkan/scene_textures.h"
#include "render_vulkan/shadows/shadow_scene.h"

#include <cstdint>
#include <span>

namespace nusselt::render_vulkan {

/// The passes of shaders/passes/<name>.comp.
enum class ShadingPassKind {
    integrate_lights,
    sample_lights_bvh,
    sample_lights_query,
    sample_lights_unshadowed
};

/// The pass that samples lights with this kind of shadow rays.
ShadingPassKind sampling_pass(ShadowRays way);

/// The options that a shader is compiled with.
struct ShaderVariant {
    int polygon_slots; ///< 4 or 8, see LightRecords
    TextureAccess textures;
    /// For environments without a portal, where images of polygons decide where samples are, and for spheres, disks, ellipses and
    /// ellipsoids: with 8 slots only.
    bool all_lights;
    bool operator==(const ShaderVariant&) const = default;
};

struct ShadingShader {
    ShadingPassKind pass;
    ShaderVariant variant;
    std::span<const std::uint32_t> words; ///< SPIR-V
};

/// All passes in all variants that there are.
std::span<const ShadingShader> shading_shaders();

/// The words of the SPIR-V.
/// \throws std::logic_error if the pass is not compiled for the variant
std::span<const std::uint32_t> shading_shader(ShadingPassKind pass, const ShaderVariant& variant);

} // namespace nusselt::render_vulkan
