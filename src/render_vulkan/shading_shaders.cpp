#include "render_vulkan/shading_shaders.h"

#include "shaders/integrate_lights_4_fused.h"
#include "shaders/integrate_lights_4_split.h"
#include "shaders/integrate_lights_8_fused.h"
#include "shaders/integrate_lights_8_split.h"
#include "shaders/sample_lights_bvh_4_fused.h"
#include "shaders/sample_lights_bvh_4_split.h"
#include "shaders/sample_lights_bvh_8_fused.h"
#include "shaders/sample_lights_bvh_8_split.h"
#include "shaders/sample_lights_query_4_fused.h"
#include "shaders/sample_lights_query_4_split.h"
#include "shaders/sample_lights_query_8_fused.h"
#include "shaders/sample_lights_query_8_split.h"
#include "shaders/sample_lights_unshadowed_4_fused.h"
#include "shaders/sample_lights_unshadowed_4_split.h"
#include "shaders/sample_lights_unshadowed_8_fused.h"
#include "shaders/sample_lights_unshadowed_8_split.h"

namespace nusselt::render_vulkan {

namespace {

using Words = std::span<const std::uint32_t>;

/// One shader in all variants.
struct Variants {
    Words split4, fused4, split8, fused8;

    Words get(const ShaderVariant& variant) const {
        if (variant.polygon_slots == 4) return variant.fused_fma ? fused4 : split4;
        return variant.fused_fma ? fused8 : split8;
    }
};

constexpr Variants kByBvh = {shaders::kSampleLightsBvh4Split, shaders::kSampleLightsBvh4Fused,
                             shaders::kSampleLightsBvh8Split, shaders::kSampleLightsBvh8Fused};
constexpr Variants kByQuery = {shaders::kSampleLightsQuery4Split, shaders::kSampleLightsQuery4Fused,
                               shaders::kSampleLightsQuery8Split, shaders::kSampleLightsQuery8Fused};
constexpr Variants kUnshadowed = {
    shaders::kSampleLightsUnshadowed4Split, shaders::kSampleLightsUnshadowed4Fused,
    shaders::kSampleLightsUnshadowed8Split, shaders::kSampleLightsUnshadowed8Fused};
constexpr Variants kIntegration = {shaders::kIntegrateLights4Split, shaders::kIntegrateLights4Fused,
                                   shaders::kIntegrateLights8Split, shaders::kIntegrateLights8Fused};

} // namespace

Words sampling_shader(const ShaderVariant& variant, ShadowRays way) {
    switch (way) {
    case ShadowRays::query:
        return kByQuery.get(variant);
    case ShadowRays::bvh:
        return kByBvh.get(variant);
    case ShadowRays::none:
        break;
    }
    return kUnshadowed.get(variant);
}

Words integration_shader(const ShaderVariant& variant) { return kIntegration.get(variant); }

} // namespace nusselt::render_vulkan
