/// The table of shaders that the build writes.

#include "render_vulkan/shading_shaders.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <stdexcept>
#include <vector>

namespace nusselt::render_vulkan_test {
namespace {

using render_vulkan::ShadingPassKind;
using render_vulkan::TextureAccess;

TEST(ShadingShaders, AreCompiledOnceForAllVariants) {
    EXPECT_EQ(render_vulkan::shading_shaders().size(), 4u * 2 * (2 + 1));
    std::set<std::vector<std::uint32_t>> all_words;
    const auto expect_shader = [&](ShadingPassKind pass, const render_vulkan::ShaderVariant& variant) {
        const auto words = render_vulkan::shading_shader(pass, variant);
        EXPECT_EQ(words.front(), 0x07230203u) << "not SPIR-V";
        EXPECT_TRUE(all_words.emplace(words.begin(), words.end()).second)
            << "two variants have the same shader";
    };
    for (const auto pass : {ShadingPassKind::integrate_lights, ShadingPassKind::sample_lights_bvh,
                            ShadingPassKind::sample_lights_query, ShadingPassKind::sample_lights_unshadowed})
        for (const auto textures : {TextureAccess::images, TextureAccess::buffer}) {
            for (const int slots : {4, 8}) expect_shader(pass, {slots, textures, false});
            expect_shader(pass, {8, textures, true});
        }
    EXPECT_THROW(static_cast<void>(render_vulkan::shading_shader(ShadingPassKind::integrate_lights,
                                                                 {5, TextureAccess::images, false})),
                 std::logic_error);
}

} // namespace
} // namespace nusselt::render_vulkan_test
