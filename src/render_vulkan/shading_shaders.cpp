#include "render_vulkan/shading_shaders.h"

#include "shaders/integrate_lights_buffer_fused_4.h"
#include "shaders/integrate_lights_buffer_fused_8.h"
#include "shaders/integrate_lights_buffer_split_4.h"
#include "shaders/integrate_lights_buffer_split_8.h"
#include "shaders/integrate_lights_images_fused_4.h"
#include "shaders/integrate_lights_images_fused_8.h"
#include "shaders/integrate_lights_images_split_4.h"
#include "shaders/integrate_lights_images_split_8.h"
#include "shaders/sample_lights_bvh_buffer_fused_4.h"
#include "shaders/sample_lights_bvh_buffer_fused_8.h"
#include "shaders/sample_lights_bvh_buffer_split_4.h"
#include "shaders/sample_lights_bvh_buffer_split_8.h"
#include "shaders/sample_lights_bvh_images_fused_4.h"
#include "shaders/sample_lights_bvh_images_fused_8.h"
#include "shaders/sample_lights_bvh_images_split_4.h"
#include "shaders/sample_lights_bvh_images_split_8.h"
#include "shaders/sample_lights_query_buffer_fused_4.h"
#include "shaders/sample_lights_query_buffer_fused_8.h"
#include "shaders/sample_lights_query_buffer_split_4.h"
#include "shaders/sample_lights_query_buffer_split_8.h"
#include "shaders/sample_lights_query_images_fused_4.h"
#include "shaders/sample_lights_query_images_fused_8.h"
#include "shaders/sample_lights_query_images_split_4.h"
#include "shaders/sample_lights_query_images_split_8.h"
#include "shaders/sample_lights_unshadowed_buffer_fused_4.h"
#include "shaders/sample_lights_unshadowed_buffer_fused_8.h"
#include "shaders/sample_lights_unshadowed_buffer_split_4.h"
#include "shaders/sample_lights_unshadowed_buffer_split_8.h"
#include "shaders/sample_lights_unshadowed_images_fused_4.h"
#include "shaders/sample_lights_unshadowed_images_fused_8.h"
#include "shaders/sample_lights_unshadowed_images_split_4.h"
#include "shaders/sample_lights_unshadowed_images_split_8.h"

namespace nusselt::render_vulkan {

namespace {

using Words = std::span<const std::uint32_t>;

/// One shader in all variants: for fma that rounds twice or once, with 4 or 8 vertices.
struct Variants {
    struct Access {
        Words split4, split8, fused4, fused8;

        Words get(const ShaderVariant& variant) const {
            const bool is_small = variant.polygon_slots == 4;
            if (variant.fused_fma) return is_small ? fused4 : fused8;
            return is_small ? split4 : split8;
        }
    };
    Access images, buffer;

    Words get(const ShaderVariant& variant) const {
        return (variant.textures == TextureAccess::images ? images : buffer).get(variant);
    }
};

constexpr Variants kByBvh = {{shaders::kSampleLightsBvhImagesSplit4, shaders::kSampleLightsBvhImagesSplit8,
                              shaders::kSampleLightsBvhImagesFused4, shaders::kSampleLightsBvhImagesFused8},
                             {shaders::kSampleLightsBvhBufferSplit4, shaders::kSampleLightsBvhBufferSplit8,
                              shaders::kSampleLightsBvhBufferFused4, shaders::kSampleLightsBvhBufferFused8}};
constexpr Variants kByQuery = {
    {shaders::kSampleLightsQueryImagesSplit4, shaders::kSampleLightsQueryImagesSplit8,
     shaders::kSampleLightsQueryImagesFused4, shaders::kSampleLightsQueryImagesFused8},
    {shaders::kSampleLightsQueryBufferSplit4, shaders::kSampleLightsQueryBufferSplit8,
     shaders::kSampleLightsQueryBufferFused4, shaders::kSampleLightsQueryBufferFused8}};
constexpr Variants kUnshadowed = {
    {shaders::kSampleLightsUnshadowedImagesSplit4, shaders::kSampleLightsUnshadowedImagesSplit8,
     shaders::kSampleLightsUnshadowedImagesFused4, shaders::kSampleLightsUnshadowedImagesFused8},
    {shaders::kSampleLightsUnshadowedBufferSplit4, shaders::kSampleLightsUnshadowedBufferSplit8,
     shaders::kSampleLightsUnshadowedBufferFused4, shaders::kSampleLightsUnshadowedBufferFused8}};
constexpr Variants kIntegration = {
    {shaders::kIntegrateLightsImagesSplit4, shaders::kIntegrateLightsImagesSplit8,
     shaders::kIntegrateLightsImagesFused4, shaders::kIntegrateLightsImagesFused8},
    {shaders::kIntegrateLightsBufferSplit4, shaders::kIntegrateLightsBufferSplit8,
     shaders::kIntegrateLightsBufferFused4, shaders::kIntegrateLightsBufferFused8}};

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
