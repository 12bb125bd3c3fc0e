#pragma once
/// Runs a technique in GLSL and in C++ on the classes of lights of the accuracy tables, and compares their errors.

#include "common/effort.h"
#include "gpu/fused_fma.h"
#include "gpu_test.h"
#include "inputs/hostile_inputs.h"
#include "parity_check.h"
#include "proof/accuracy/cases.h"
#include "proof/hostile/techniques.h"
#include "shaders/twins.h"
#include "twin.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <string_view>

namespace nusselt::parity {

/// A technique of ours.
/// \tparam AnyTraits of proof/accuracy/references.h.
/// \tparam AnyKind   of proof/hostile/techniques.h, the same technique.
template <class AnyTraits, class AnyKind>
struct TechniquePair {
    using Traits = AnyTraits;
    using Kind = AnyKind;
    static constexpr const char* kName = Traits::kName;
    static constexpr Images kImages = hostile::kHasLobe<Kind> ? Images::rounded : Images::same;
    using Outputs = typename Twin<Traits>::Outputs;

    static Outputs outputs_of(const typename Twin<Traits>::Input& in) {
        return hostile::outputs_of<Kind, float>(in.light, in.u);
    }
    static void judge(const proof::Case<Traits, float>& c, bool dark, const Outputs& out, Errors& errors) {
        parity::judge(c, dark, out, errors);
    }
};

template <int N>
using PolygonAreaPair = TechniquePair<proof::PolygonAreaTraits<N>, hostile::PolygonAreaKindOf<N>>;
template <int N>
using PolygonSolidAnglePair =
    TechniquePair<proof::PolygonSolidAngleTraits<N>, hostile::PolygonSolidAngleKindOf<N>>;
template <int N>
using PolygonClippedSolidAnglePair =
    TechniquePair<proof::PolygonClippedSolidAngleTraits<N>, hostile::PolygonClippedSolidAngleKindOf<N>>;
template <int N>
using PolygonProjectedSolidAnglePair =
    TechniquePair<proof::PolygonProjectedSolidAngleTraits<N>, hostile::PolygonProjectedSolidAngleKindOf<N>>;
template <int N>
using PolygonProjectedSolidAngleBiasedPair =
    TechniquePair<proof::PolygonProjectedSolidAngleBiasedTraits<N>, hostile::PolygonBiasedKindOf<N>>;

/// The shader of a technique.
template <class Pair>
std::span<const std::uint32_t> shader_of(Variant variant) {
    for (const TwinShader& shader : kTwinShaders)
        if (std::string_view(shader.technique) == Pair::kName &&
            shader.vertex_bound == Pair::Traits::kVertexBound && shader.variant == variant)
            return shader.spirv;
    throw std::logic_error(std::string("no such twin of ") + Pair::kName);
}

/// Those that give the right results on a device.
inline std::vector<Variant> variants_for(const gpu::Device& device) {
    if (gpu::has_fused_fma(device)) return {Variant::split, Variant::fused};
    return {Variant::split};
}

inline const auto& classes_of(const proof::PolygonClass*) { return proof::polygon_classes(); }
inline const auto& classes_of(const proof::LineClass*) { return proof::line_classes(); }

/// Judges the twin on at least `count` lights of a class.
template <class Pair>
Verdict judge_class(const typename Pair::Traits::Class& lights, int count,
                    Twin<typename Pair::Traits>& twin) {
    using Traits = typename Pair::Traits;
    constexpr int kBlock = 4096;
    const bool dark = proof::is_dark<Traits>(lights);
    Errors device, cpp, floor;
    std::mutex mutex;
    const auto judge_lights = [&](int begin, int end) {
        const auto cases = proof::make_cases<Traits, float>(lights, begin, end);
        std::vector<typename Twin<Traits>::Input> inputs;
        for (const auto& c : cases) inputs.push_back({c.light, c.u});
        std::vector<typename Twin<Traits>::Outputs> outputs;
        {
            const std::lock_guard lock(mutex);
            outputs = twin.run(inputs);
        }
        Errors block_device, block_cpp, block_floor;
        for (std::size_t i = 0; i < cases.size(); ++i) {
            Pair::judge(cases[i], dark, outputs[i], block_device);
            Pair::judge(cases[i], dark, Pair::outputs_of(inputs[i]), block_cpp);
            if (!dark) Pair::judge(cases[i], dark, rounded_outputs(cases[i]), block_floor);
        }
        const std::lock_guard lock(mutex);
        device.append(block_device);
        cpp.append(block_cpp);
        floor.append(block_floor);
        return static_cast<int>(cases.size());
    };
    // Dim lights are left out; others take their place.
    int begin = 0, judged = 0;
    while (judged < count) {
        const int size = judged == 0 ? count : std::max(count - judged, kBlock);
        std::atomic<int> bright = 0;
        tbb::parallel_for(0, (size + kBlock - 1) / kBlock, [&](int block) {
            bright += judge_lights(begin + block * kBlock, begin + std::min((block + 1) * kBlock, size));
        });
        if (bright == 0) throw std::logic_error(std::string("all lights are too dim: ") + lights.name);
        begin += size;
        judged += bright;
    }
    Verdict verdict = compare(device, cpp, floor, Pair::kImages);
    verdict.lights = judged;
    return verdict;
}

/// Judges the twin on all classes for which `is_judged` holds, with together at least `count` lights.
template <class Pair>
Verdict judge_twin(const gpu::Device& device, std::span<const std::uint32_t> shader, int count,
                   const std::function<bool(const typename Pair::Traits::Class&)>& is_judged) {
    using Class = typename Pair::Traits::Class;
    Twin<typename Pair::Traits> twin(device, shader);
    std::vector<const Class*> judged;
    for (const auto& lights : classes_of(static_cast<const Class*>(nullptr)))
        if (is_judged(lights)) judged.push_back(&lights);
    const int per_class = (count + static_cast<int>(judged.size()) - 1) / static_cast<int>(judged.size());
    Verdict verdict;
    for (const auto* lights : judged)
        verdict.add(lights->name + std::string(": "), judge_class<Pair>(*lights, per_class, twin));
    return verdict;
}

/// Polygons with more vertices need the larger bound; all fit into it.
inline bool is_judged_with_bound(const proof::PolygonClass& lights, int bound) {
    return bound == (lights.vertex_count <= 4 ? 4 : 8);
}
inline bool is_judged_with_bound(const proof::LineClass&, int) { return true; }

/// Likewise, on the classes for the bound of the technique: 4 or 8 vertices, or lines.
template <class Pair>
Verdict judge_twin(const gpu::Device& device, std::span<const std::uint32_t> shader, int count) {
    return judge_twin<Pair>(device, shader, count, [](const auto& lights) {
        return is_judged_with_bound(lights, Pair::Traits::kVertexBound);
    });
}

/// Fails where the device errs too much, or where no error would be too much without a known reason.
void expect_parity(const Verdict& verdict);

/// Random lights of each technique, in all classes together. Polygons come with two bounds on the number of vertices.
inline int random_lights() { return nusselt_test::at_effort(100'000, 1'000'000); }
template <class Pair>
int random_lights_of() {
    return kIsPolygonal<typename Pair::Traits> ? random_lights() / 2 : random_lights();
}
inline int hostile_lights() { return nusselt_test::at_effort(20'000, 100'000); }

/// Wrong shaders are rejected with no more lights than the quick effort has.
inline constexpr int kMutantLights = 50'000;

/// The first of `count` hostile lights on which a twin breaks the contract; empty if there is none.
template <class Pair>
std::string first_violation(const gpu::Device& device, std::span<const std::uint32_t> shader, int count) {
    using TwinOf = Twin<typename Pair::Traits>;
    TwinOf twin(device, shader);
    std::vector<typename TwinOf::Input> inputs(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        hostile::HostileLights<float> source(1, i);
        draw(source, inputs[i].light, inputs[i].u);
    }
    const auto outputs = twin.run(inputs);
    std::string first;
    int broken = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const char* text = hostile::violation<typename Pair::Kind, float>(inputs[i].light, outputs[i]);
        if (text == nullptr) continue;
        if (broken++ == 0) first = fmt::format("light {} of seed 1: {}", i, text);
    }
    return broken == 0 ? "" : fmt::format("{}; {} in all", first, broken);
}

} // namespace nusselt::parity
