// Compares the random numbers of a renderer on the device with C++, bit by bit.

#include "common/effort.h"
#include "gpu/fused_fma.h"
#include "gpu_test.h"
#include "proof/hostile/lights.h"
#include "shader_runner.h"
#include "shaders/light_random_fused.h"
#include "shaders/light_random_split.h"
#include "shaders/unrounded_random.h"

#include <nusselt/random/light_random.h>

#include <bit>

namespace nusselt::parity {

namespace {

std::size_t calls() { return nusselt_test::at_effort<std::size_t>(100'000, 400'000); }

struct Call {
    Sampler sampler;
    std::uint32_t seed, x, y, sample, sample_count, light, pair;
};

Call draw_call(std::size_t i) {
    hostile::RandomSource random(3, i);
    const auto word = [&](double limit) { return static_cast<std::uint32_t>(random.uniform() * limit); };
    // Common numbers of samples, arbitrary ones, and the largest.
    const std::uint32_t counts[] = {1u << word(7), 1 + word(1024), 1 + word(0x1p22), 1u << 22};
    Call call{static_cast<Sampler>(random.index(4)),
              word(0x1p32),
              word(0x1p14),
              word(0x1p14),
              0,
              counts[random.index(4)],
              word(0x1p10),
              word(4)};
    call.sample = word(call.sample_count);
    return call;
}

/// How many numbers of a shader differ from those of C++, for each sampler and, in the last entry, for camera rays.
std::array<int, 5> differences(const gpu::Device& device, std::span<const std::uint32_t> shader) {
    std::vector<float> inputs;
    for (std::size_t i = 0; i < calls(); ++i) {
        const Call c = draw_call(i);
        for (const std::uint32_t word : {static_cast<std::uint32_t>(c.sampler), c.seed, c.x, c.y, c.sample,
                                         c.sample_count, c.light, c.pair})
            inputs.push_back(std::bit_cast<float>(word));
    }
    const auto results = ShaderRunner(device, shader, 8).run(inputs);
    std::array<int, 5> differences{};
    for (std::size_t i = 0; i < calls(); ++i) {
        const Call c = draw_call(i);
        const auto of_light =
            light_random(c.sampler, c.seed, c.x, c.y, c.sample, c.sample_count, c.light, c.pair);
        const auto of_camera = camera_random(c.sampler, c.seed, c.x, c.y, c.sample);
        const auto& result = results[i];
        differences[static_cast<std::size_t>(c.sampler)] +=
            (result[0] != of_light.x) + (result[1] != of_light.y);
        differences[4] += (result[2] != of_camera.x) + (result[3] != of_camera.y);
    }
    return differences;
}

class LightRandomParity : public GpuTest {};

TEST_F(LightRandomParity, HasTheBitsOfCpp) {
    const std::array<int, 5> none{};
    EXPECT_EQ(differences(device(), shaders::kLightRandomSplit), none);
    if (gpu::has_fused_fma(device())) {
        EXPECT_EQ(differences(device(), shaders::kLightRandomFused), none);
    }
}

TEST_F(LightRandomParity, FindsQuotientsOffByARounding) {
    const auto wrong = differences(device(), shaders::kUnroundedRandom);
    EXPECT_EQ(wrong[static_cast<std::size_t>(Sampler::independent)], 0);
    EXPECT_EQ(wrong[static_cast<std::size_t>(Sampler::sobol)], 0);
    EXPECT_GT(wrong[static_cast<std::size_t>(Sampler::jittered)], 0);
    EXPECT_GT(wrong[static_cast<std::size_t>(Sampler::stratified)], 0);
    EXPECT_EQ(wrong[4], 0) << "camera rays need no quotients";
}

} // namespace

} // namespace nusselt::parity
