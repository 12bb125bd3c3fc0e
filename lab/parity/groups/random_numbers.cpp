#include "lab/parity/groups/random_numbers.h"
#include "lab/parity/parity.h"
#include "lab/parity/shader_platform.h"
#include "lab/parity/table_words.h"
#include "proof/hostile/lights.h"
#include "shaders/light_random.h"
#include "shaders/random.h"
#include "tables/blue_noise.h"

#include <nusselt/random/light_random.h>
#include <nusselt/random/pcg.h>
#include <nusselt/random/sobol.h>
#include <nusselt/random/unit_interval.h>

#include <bit>
#include <cstring>
#include <fmt/core.h>
#include <numeric>

namespace nusselt::parity {

namespace {

using hostile::RandomSource;

constexpr Shader kWords{"random", shaders::kRandom};
constexpr Shader kLightRandom{"light_random", shaders::kLightRandom};

struct Call {
    Sampler sampler;
    std::uint32_t seed, x, y, sample, sample_count, light, pair;
};

Call draw_call(std::size_t i) {
    hostile::RandomSource random(3, i);
    const auto word = [&](double limit) { return static_cast<std::uint32_t>(random.uniform() * limit); };
    // Common numbers of samples, arbitrary ones, and the largest.
    const std::uint32_t counts[] = {1u << word(7), 1 + word(1024), 1 + word(0x1p22), 1u << 22};
    Call call{static_cast<Sampler>(random.index(kSamplers)),
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

/// How many words and numbers of shaders/parity/functions/random.comp differ from those of C++.
int different_words(const ShaderPlatform& platform, Variant variant, std::size_t calls) {
    std::vector<float> inputs;
    const auto bits = [](RandomSource& random) {
        // A word with random bits may be a signalling NaN. It must not pass through arithmetic, but loads and stores
        // preserve it.
        return std::bit_cast<float>(static_cast<std::uint32_t>(random.uniform() * 0x1p32));
    };
    for (std::size_t i = 0; i < calls; ++i) {
        RandomSource random(2, i);
        for (int k = 0; k < 4; ++k) inputs.push_back(bits(random));
        inputs.push_back(static_cast<float>(random.uniform() * 0.9999));
    }
    int different = 0;
    const auto results = platform.load(VariantShader(kWords, variant), 5)->run(inputs);
    for (std::size_t i = 0; i < calls; ++i) {
        std::uint32_t key[4], words[8];
        std::memcpy(key, &inputs[5 * i], sizeof key);
        std::memcpy(words, results[i].data(), sizeof words);
        const auto hash = pcg4d({key[0], key[1], key[2], key[3]});
        const auto plain = sobol(key[0]);
        const auto scrambled = owen_scrambled_sobol(key[0], {key[1], key[2], key[3]});
        const std::uint32_t expected[] = {hash.x,  hash.y,  hash.z,      hash.w,
                                          plain.x, plain.y, scrambled.x, scrambled.y};
        for (std::size_t k = 0; k < std::size(expected); ++k) different += words[k] != expected[k];
        different += results[i][8] != to_unit<float>(key[0]);
        const std::uint32_t points = 1 + key[2] % 1024;
        const float jittered = uniform_jittered(inputs[5 * i + 4], key[1] % points, points);
        different += results[i][9] != jittered;
    }
    return different;
}

/// A verdict that accepts equal bits only.
VariantVerdict equal_bits(Variant variant, int different, std::size_t calls) {
    VariantVerdict result{variant, {}};
    result.verdict.lights = static_cast<std::int64_t>(calls);
    if (different > 0)
        result.verdict.excesses.push_back(fmt::format("{} numbers have other bits than in C++", different));
    return result;
}

std::vector<VariantVerdict> judge_words(const ShaderPlatform& platform, const ParityEffort& effort) {
    const std::size_t calls = effort.function_calls();
    std::vector<VariantVerdict> results;
    for (const Variant variant : platform.variants())
        results.push_back(equal_bits(variant, different_words(platform, variant, calls), calls));
    return results;
}

std::vector<VariantVerdict> judge_light_random(const ShaderPlatform& platform, const ParityEffort& effort) {
    const std::size_t calls = effort.random_calls();
    std::vector<VariantVerdict> results;
    for (const Variant variant : platform.variants()) {
        const VariantShader shader(kLightRandom, variant);
        const auto different = different_random_numbers(platform, shader, calls);
        results.push_back(equal_bits(variant, std::accumulate(different.begin(), different.end(), 0), calls));
    }
    return results;
}

} // namespace

std::array<int, kSamplers + 1> different_random_numbers(const ShaderPlatform& platform,
                                                        const VariantShader& shader, std::size_t calls) {
    std::vector<float> inputs;
    for (std::size_t i = 0; i < calls; ++i) {
        const Call c = draw_call(i);
        for (const std::uint32_t word : {static_cast<std::uint32_t>(c.sampler), c.seed, c.x, c.y, c.sample,
                                         c.sample_count, c.light, c.pair})
            inputs.push_back(std::bit_cast<float>(word));
    }
    const auto results = platform.load(shader, 8, blue_noise_words())->run(inputs);
    std::array<int, kSamplers + 1> differences{};
    for (std::size_t i = 0; i < calls; ++i) {
        const Call c = draw_call(i);
        const auto of_light = light_random(c.sampler, c.seed, c.x, c.y, c.sample, c.sample_count, c.light,
                                           c.pair, tables::blue_noise());
        const auto of_camera = camera_random(c.sampler, c.seed, c.x, c.y, c.sample);
        const auto& result = results[i];
        differences[static_cast<std::size_t>(c.sampler)] +=
            (result[0] != of_light.x) + (result[1] != of_light.y);
        differences[kSamplers] += (result[2] != of_camera.x) + (result[3] != of_camera.y);
    }
    return differences;
}

void add_random_cases(std::vector<ParityCase>& cases) {
    cases.push_back({"random numbers", "words", judge_words});
    cases.push_back({"random numbers", "of lights and cameras", judge_light_random});
}

} // namespace nusselt::parity
