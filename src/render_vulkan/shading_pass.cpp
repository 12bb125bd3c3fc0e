#include "render_vulkan/shading_pass.h"

#include "gpu/fused_fma.h"
#include "interface/fused_fma.h"
#include "interface/settings.h"
#include "render_vulkan/shading_shaders.h"

#include <algorithm>
#include <vector>

namespace nusselt::render_vulkan {

namespace {

// The shaders in shaders/passes have work groups of this size.
constexpr std::uint32_t kWorkGroupSide = 8;
static_assert(kRowsTogether == kWorkGroupSide);
/// Storage buffers of all shading passes; those for shadow rays follow.
constexpr std::uint32_t kShadingBuffers = interface::kFirstBindingAfterLights + 5;

std::uint32_t groups_for(std::uint32_t pixels) { return (pixels - 1) / kWorkGroupSide + 1; }

/// Whether the pass integrates lights instead of sampling them.
bool is_analytic(const std::vector<std::uint32_t>& constants) {
    return constants[interface::kTechniqueConstant] ==
           static_cast<std::uint32_t>(render::Technique::ltc_analytic);
}

/// Whether the scene has environments without a portal, or images of polygons decide where samples are, or are
/// integrated: see shaders/passes/cells.
bool has_emission_cells(const std::vector<std::uint32_t>& constants) {
    if (constants[interface::kUniformEnvironmentsConstant] != 0 ||
        constants[interface::kMappedEnvironmentsConstant] != 0)
        return true;
    if (constants[interface::kTexturedPolygonsConstant] == 0) return false;
    return is_analytic(constants) || constants[interface::kEmissionSamplingConstant] ==
                                         static_cast<std::uint32_t>(render::EmissionSampling::product);
}

bool has_round_lights(const std::vector<std::uint32_t>& constants) {
    return constants[interface::kEllipsesConstant] != 0 || constants[interface::kEllipsoidsConstant] != 0;
}

gpu::ComputePipeline make_pipeline(const DeviceScene& scene, const std::vector<std::uint32_t>& constants) {
    const gpu::Device& device = scene.device();
    const ShadowScene& shadows = scene.shadows();
    const SceneTextures& textures = scene.textures();
    const ShaderVariant variant{scene.polygon_slots(), textures.access(),
                                has_round_lights(constants) || has_emission_cells(constants)};
    gpu::ComputeInterface interface {
        .storage_buffers = kShadingBuffers, .images = textures.images(),
        .push_constant_size = sizeof(interface::FrameRecord), .constants = constants
    };
    interface.constants[interface::kFusedFmaConstant] = has_fused_fma(device) ? 1 : 0;
    if (is_analytic(constants))
        return {device, shading_shader(ShadingPassKind::integrate_lights, variant), interface};
    interface.storage_buffers += static_cast<std::uint32_t>(shadows.buffers().size());
    interface.ray_scenes = shadows.structure() == nullptr ? 0 : 1;
    return {device, shading_shader(sampling_pass(shadows.way()), variant), interface};
}

std::size_t pixel_count(std::uint32_t width, std::uint32_t height) { return std::size_t{width} * height; }

} // namespace

PixelBuffers::PixelBuffers(const gpu::Device& device, std::uint32_t image_width, std::uint32_t image_height)
    : width(image_width),
      height(image_height),
      numbers(device, pixel_count(width, height) * sizeof(std::uint32_t), gpu::Residence::device_local),
      sums(device, pixel_count(width, height) * sizeof(interface::PixelSum), gpu::Residence::device_local),
      work(device, sizeof(interface::WorkRecord), gpu::Residence::device_local) {
    clear();
}

void PixelBuffers::clear() {
    sums.fill_with_zeros();
    work.fill_with_zeros();
}

std::vector<std::uint32_t> shading_constants(const render::RenderSettings& settings,
                                             const SceneKinds& kinds) {
    std::vector<std::uint32_t> constants = constants_of(kinds);
    const auto set = [&](int number, auto value) {
        constants[static_cast<std::size_t>(number)] = static_cast<std::uint32_t>(value);
    };
    set(interface::kTechniqueConstant, settings.technique);
    set(interface::kStrategiesConstant, settings.strategies);
    set(interface::kSamplerConstant, settings.sample_order);
    set(interface::kBrdfConstant, settings.brdf);
    set(interface::kEmissionSamplingConstant, settings.emission_sampling);
    return constants;
}

ShadingPass::ShadingPass(const DeviceScene& scene, const std::vector<std::uint32_t>& constants,
                         const PixelBuffers& pixels)
    : groups_x_(groups_for(pixels.width)), pipeline_(make_pipeline(scene, constants)) {
    const SceneBuffers& data = scene.buffers();
    const SceneTextures& textures = scene.textures();
    const ShadowScene& shadows = scene.shadows();
    std::vector<const gpu::Buffer*> buffers = {&data.scene,      &data.vertices,  &data.triangles,
                                               &data.instances,  &data.materials, &textures.records(),
                                               &textures.words()};
    for (const gpu::Buffer& array : data.lights) buffers.push_back(&array);
    buffers.insert(buffers.end(),
                   {&scene.ltc_table(), &pixels.numbers, &pixels.sums, &pixels.work, &scene.blue_noise()});
    if (!is_analytic(constants)) {
        for (const gpu::Buffer* buffer : shadows.buffers()) buffers.push_back(buffer);
        if (shadows.structure() != nullptr) pipeline_.bind(*shadows.structure());
    }
    pipeline_.bind(buffers);
}

void ShadingPass::record(const gpu::Device::Commands& commands, const interface::FrameRecord& frame,
                         std::uint32_t rows) const {
    pipeline_.dispatch(commands, std::as_bytes(std::span(&frame, 1)), groups_x_, groups_for(rows));
}

} // namespace nusselt::render_vulkan
