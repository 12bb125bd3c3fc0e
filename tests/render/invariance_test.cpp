/// Threads, instruction sets and the unit of length do not change the image.

#include "scenes.h"

#include "image/metrics.h"

#include <gtest/gtest.h>

namespace nusselt::render_test {
namespace {

constexpr int kSize = 64;

image::Image render(const scene::Scene& scene, int threads, base::Isa isa, render::Technique technique) {
    render::RenderSettings settings;
    settings.technique = technique;
    settings.samples = 4;
    return render_cpu::Renderer(scene, threads).render(settings, isa).image;
}

TEST(Invariance, ThreadCountChangesNoBit) {
    const scene::Scene scene = make_box_scene(kSize);
    const base::Isa isa = base::choose_isa();
    for (const auto technique : render::kTechniques) {
        const image::Image one = render(scene, 1, isa, technique);
        for (const int threads : {2, 5})
            EXPECT_EQ(one.pixels, render(scene, threads, isa, technique).pixels)
                << render::name_of(technique) << ", " << threads << " threads";
    }
}

class IsaInvariance : public testing::TestWithParam<base::Isa> {};

TEST_P(IsaInvariance, HardlyAnyPixelDiffers) {
    if (!is_supported(GetParam())) GTEST_SKIP() << "this processor does not support it";
    // A few pixels of an image differ; enough of them that chance decides nothing. Where light grazes a surface, the cosine is
    // rounding: pixels of a hundred-thousandth of the mean differ by more than the tolerance.
    constexpr double kDarkest = 0.01;
    const scene::Scene scene = make_box_scene(8 * kSize);
    for (const auto technique : render::kTechniques) {
        const image::Image baseline = render(scene, 2, base::Isa::sse42, technique);
        const image::Image other = render(scene, 2, GetParam(), technique);
        EXPECT_LE(differing_share(other, baseline, 1e-4, kDarkest), 1e-4) << render::name_of(technique);
    }
}

INSTANTIATE_TEST_SUITE_P(AllIsas, IsaInvariance, testing::Values(base::Isa::avx2, base::Isa::avx512),
                         [](const auto& test) { return std::string(name_of(test.param)); });

/// Multiplication by powers of two rounds nothing.
TEST(Invariance, PowersOfTwoAsUnitOfLengthChangeNoBit) {
    const scene::Scene scene = make_box_scene(kSize);
    const base::Isa isa = base::choose_isa();
    for (const auto technique : render::kTechniques) {
        const image::Image reference = render(scene, 2, isa, technique);
        for (const float factor : {0x1p-10f, 0x1p10f})
            EXPECT_EQ(reference.pixels, render(scaled(scene, factor), 2, isa, technique).pixels)
                << render::name_of(technique) << ", " << factor;
    }
}

/// Other factors round coordinates: shadow rays that graze an edge may fall on its other side.
TEST(Invariance, UnitOfLengthChangesNextToNothing) {
    const scene::Scene scene = make_box_scene(kSize);
    const base::Isa isa = base::choose_isa();
    for (const auto technique : render::kTechniques) {
        const image::Image reference = render(scene, 2, isa, technique);
        for (const float factor : {1e-3f, 1e3f})
            EXPECT_LE(differing_share(render(scaled(scene, factor), 2, isa, technique), reference, 1e-3, 0),
                      2e-3)
                << render::name_of(technique) << ", " << factor;
    }
}

} // namespace
} // namespace nusselt::render_test
