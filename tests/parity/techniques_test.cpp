#include "experiments/accuracy_cases.h"
#include "experiments/hostile/lights.h"
#include "gpu/fused_fma.h"
#include "gpu_test.h"
#include "parity_check.h"
#include "shaders/perturbed_polygon.h"
#include "shaders/unguarded_polygon.h"
#include "technique_shaders.h"
#include "twin.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <iostream>
#include <mutex>

namespace nusselt::parity {

namespace {

using experiments::Case;

const auto& classes_of(const experiments::PolygonClass*) { return experiments::polygon_classes(); }
const auto& classes_of(const experiments::LineClass*) { return experiments::line_classes(); }

/// Polygons with more vertices need the larger bound; all fit into it.
bool is_judged_with_bound(const experiments::PolygonClass& lights, int bound) {
    return bound == (lights.vertex_count <= 4 ? 4 : 8);
}
bool is_judged_with_bound(const experiments::LineClass&, int) { return true; }

/// Judges the twin on one class of lights.
template <class Pair>
Verdict judge_class(const typename Pair::Traits::Class& lights, int count, Twin<typename Pair::Kind>& twin) {
    using Kind = typename Pair::Kind;
    using Traits = typename Pair::Traits;
    constexpr int kBlock = 4096;
    const bool dark = experiments::is_dark<Traits>(lights);
    Errors device, cpp, floor;
    std::mutex mutex;
    tbb::parallel_for(0, (count + kBlock - 1) / kBlock, [&](int block) {
        const auto cases = experiments::make_cases<Traits, float>(lights, block * kBlock,
                                                                  std::min((block + 1) * kBlock, count));
        std::vector<typename Twin<Kind>::Input> inputs;
        for (const auto& c : cases) inputs.push_back({c.light, c.u});
        std::vector<typename Twin<Kind>::Outputs> outputs;
        {
            const std::lock_guard lock(mutex);
            outputs = twin.run(inputs);
        }
        Errors block_device, block_cpp, block_floor;
        for (std::size_t i = 0; i < cases.size(); ++i) {
            judge(cases[i], dark, outputs[i], block_device);
            judge(cases[i], dark, hostile::outputs_of<Kind, float>(cases[i].light, cases[i].u), block_cpp);
            if (!dark) judge(cases[i], dark, rounded_outputs<Kind>(cases[i]), block_floor);
        }
        const std::lock_guard lock(mutex);
        device.append(block_device);
        cpp.append(block_cpp);
        floor.append(block_floor);
    });
    return compare(device, cpp, floor);
}

/// Judges the twin on all classes with together at least `count` lights.
template <class Pair>
Verdict judge_twin(const gpu::Device& device, std::span<const std::uint32_t> shader, int count) {
    using Traits = typename Pair::Traits;
    Twin<typename Pair::Kind> twin(device, shader);
    std::vector<const typename Traits::Class*> judged;
    for (const auto& lights : classes_of(static_cast<const typename Traits::Class*>(nullptr)))
        if (is_judged_with_bound(lights, Traits::kVertexBound)) judged.push_back(&lights);
    const int per_class = (count + static_cast<int>(judged.size()) - 1) / static_cast<int>(judged.size());
    Verdict verdict;
    for (const auto* lights : judged)
        verdict.add(lights->name + std::string(": "), judge_class<Pair>(*lights, per_class, twin));
    return verdict;
}

/// Random lights of each technique, in all classes together. Polygons come with two bounds on the number of vertices.
constexpr int kRandomLights = 1'000'000;
template <class Kind>
constexpr int kLightsPerPair = hostile::kIsPolygon<Kind> ? kRandomLights / 2 : kRandomLights;
constexpr int kHostileLights = 100'000;

void draw(hostile::HostileLights<float>& source, LineSegment<float>& light, float& u) {
    light = source.line();
    u = source.random_number();
}
template <int N>
void draw(hostile::HostileLights<float>& source, ConvexPolygon<float, N>& light, Vec2<float>& u) {
    light = source.polygon<N>();
    u.x = source.random_number();
    u.y = source.random_number();
}

template <class Kind>
std::string first_violation(const gpu::Device& device, std::span<const std::uint32_t> shader) {
    Twin<Kind> twin(device, shader);
    std::vector<typename Twin<Kind>::Input> inputs(kHostileLights);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        hostile::HostileLights<float> source(1, i);
        draw(source, inputs[i].light, inputs[i].u);
    }
    const auto outputs = twin.run(inputs);
    std::string first;
    int count = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const char* text = hostile::violation<Kind, float>(inputs[i].light, outputs[i]);
        if (text == nullptr) continue;
        if (count++ == 0) first = fmt::format("light {} of seed 1: {}", i, text);
    }
    return count == 0 ? "" : fmt::format("{}; {} in all", first, count);
}

template <class Pair>
class TechniqueParity : public GpuTest {
protected:
    /// The shader for any device, and the one for those that fuse fma where this one does.
    std::vector<std::span<const std::uint32_t>> shaders() const {
        std::vector<std::span<const std::uint32_t>> result{Pair::kSplit};
        if (gpu::has_fused_fma(device())) result.emplace_back(Pair::kFused);
        return result;
    }
};
TYPED_TEST_SUITE(TechniqueParity, TechniquePairs);

TYPED_TEST(TechniqueParity, IsAsAccurateAsCpp) {
    for (const auto shader : this->shaders()) {
        const Verdict verdict =
            judge_twin<TypeParam>(this->device(), shader, kLightsPerPair<typename TypeParam::Kind>);
        for (const std::string& excess : verdict.excesses) ADD_FAILURE() << excess;
        std::cout << fmt::format("largest ratio to C++: {:.2f}, {}\n", verdict.largest_ratio, verdict.where);
    }
}

TYPED_TEST(TechniqueParity, KeepsTheContractOnHostileLights) {
    for (const auto shader : this->shaders())
        EXPECT_EQ(first_violation<typename TypeParam::Kind>(this->device(), shader), "");
}

using ProjectedPair = TechniquePair<experiments::PolygonProjectedSolidAngleTraits<4>,
                                    hostile::PolygonProjectedSolidAngleKindOf<4>, shaders::kPerturbedPolygon,
                                    shaders::kPerturbedPolygon>;

/// Wrong shaders: what accepts them proves nothing.
class MutantParity : public GpuTest {};

TEST_F(MutantParity, RandomNumbersOffBySixteenRoundingsAreFound) {
    const auto excesses =
        judge_twin<ProjectedPair>(device(), shaders::kPerturbedPolygon, kRandomLights / 20).excesses;
    ASSERT_FALSE(excesses.empty());
    EXPECT_NE(excesses[0].find("decentral: first random number, median"), std::string::npos) << excesses[0];
}

TEST_F(MutantParity, MissingClippingIsFound) {
    using Clipped = TechniquePair<experiments::PolygonClippedSolidAngleTraits<4>,
                                  hostile::PolygonClippedSolidAngleKindOf<4>,
                                  shaders::kPolygonSolidAngle4Split, shaders::kPolygonSolidAngle4Split>;
    const auto excesses = judge_twin<Clipped>(device(), Clipped::kSplit, kRandomLights / 20).excesses;
    const auto concerned = [&](const std::string& lights) {
        return std::count_if(excesses.begin(), excesses.end(),
                             [&](const std::string& excess) { return excess.rfind(lights + ":", 0) == 0; });
    };
    EXPECT_GT(concerned("crossing the horizon"), 0);
    EXPECT_EQ(concerned("decentral"), 0) << "above the horizon nothing is missing";
}

TEST_F(MutantParity, TheVariantForAFusedFmaIsRejectedWhereFmaRoundsTwice) {
    if (gpu::has_fused_fma(device())) GTEST_SKIP() << "the device fuses fma";
    using Pair = PolygonProjectedSolidAngle4;
    EXPECT_FALSE(judge_twin<Pair>(device(), Pair::kFused, kRandomLights / 20).excesses.empty());
}

TEST_F(MutantParity, InfiniteDensitiesAreFound) {
    const std::string violation = first_violation<ProjectedPair::Kind>(device(), shaders::kUnguardedPolygon);
    EXPECT_NE(violation.find("the density of the sample is negative or not finite"), std::string::npos)
        << violation;
}

} // namespace

} // namespace nusselt::parity
