#pragma once
/// Runs a technique in GLSL and in C++ on the classes of lights of the accuracy tables, and compares their errors.

#include "lab/accuracy/lobe_lights.h"
#include "lab/parity/hostile_inputs.h"
#include "lab/parity/parity_check.h"
#include "lab/parity/twin.h"
#include "lab/parity/twin_shader.h"
#include "proof/accuracy/cases.h"
#include "proof/techniques/registry.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <deque>
#include <functional>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace nusselt::parity {

/// A technique of the library and its twin.
/// \tparam AnyKind a kind of technique from the registry.
template <class AnyKind>
struct TechniquePair {
    using Kind = AnyKind;
    using Traits = proof::Judged<Kind>;
    static constexpr const char* kName = Traits::kName;
    static constexpr Images kImages = hostile::kHasLobe<Kind> ? Images::rounded : Images::same;
    using Outputs = typename Twin<Traits>::Outputs;

    static Outputs outputs_of(const typename Twin<Traits>::Input& in) {
        return hostile::outputs_of<Kind, float>(in.light, in.u);
    }
    static void judge(const proof::Case<Traits, float>& c, bool dark, const Outputs& out, Errors& errors) {
        if constexpr (hostile::kIsCylinder<Kind> && Kind::kMeasure == hostile::Measure::area) {
            const auto facing = cosine_of_sample(c);
            // Nothing is required where rounding decides which side faces the point.
            if (!dark && std::fabs(facing) < kGrazing) return;
            // The side that faces away gives no samples.
            parity::judge(c, dark || facing < 0, out, errors);
        } else {
            parity::judge(c, dark, out, errors);
        }
    }

private:
    static constexpr proof::Exact kGrazing = 1e-3L;

    /// Cosine of the angle between the normal at the sample of a cylinder and the direction back to the origin.
    static proof::Exact cosine_of_sample(const proof::Case<Traits, float>& c) {
        const auto& [axis, radius] = c.exact_light;
        const auto p = c.exact.sample(Traits::template widened<proof::Exact>(c.u)).p;
        const auto from_start = p - axis.p0;
        const auto along = dot(from_start, axis.s);
        const auto across = from_start - along * axis.s;
        const auto to_ends = std::min(along, axis.length - along);
        const auto on_cap = along < axis.length / 2 ? -axis.s : axis.s;
        const auto normal = radius - length(across) < to_ends ? normalize(across) : on_cap;
        return -dot(normalize(p), normal);
    }
};

/// The name of the suite in techniques.json.
struct ParitySuite {
    static constexpr std::string_view kName = "parity";
};

/// The name of the technique and, for polygons, the bound on the number of vertices.
template <class Pair>
std::string name_of_pair() {
    const std::string name = Pair::kName;
    if constexpr (hostile::kIsPolygon<typename Pair::Kind>)
        return name + std::to_string(Pair::Traits::kVertexBound);
    return name;
}

/// The shader of a technique.
template <class Pair>
VariantShader shader_of(Variant variant) {
    return twin_shader(Pair::kName, Pair::Traits::kVertexBound, variant);
}

/// The shaders of a technique.
template <class Pair>
std::vector<VariantShader> shaders_of(const std::vector<Variant>& variants) {
    std::vector<VariantShader> shaders;
    for (const Variant variant : variants) shaders.push_back(shader_of<Pair>(variant));
    return shaders;
}

template <class Pair>
using Twins = std::deque<Twin<typename Pair::Traits>>;

/// Judges twins of one technique on about `count` lights of a class, the same for each: most of the time goes into the
/// exact results.
template <class Pair>
std::vector<Verdict> judge_class(const typename Pair::Traits::Class& lights, int count, Twins<Pair>& twins) {
    using Traits = typename Pair::Traits;
    constexpr int kBlock = 4096;
    const bool dark = proof::is_dark<Traits>(lights);
    std::vector<Errors> device(twins.size());
    Errors cpp, floor;
    std::mutex mutex;
    const auto judge_lights = [&](int begin, int end) {
        const auto cases = proof::make_cases<Traits, float>(lights, begin, end);
        std::vector<typename Twin<Traits>::Input> inputs;
        for (const auto& c : cases) inputs.push_back({c.light, c.u});
        std::vector<std::vector<typename Twin<Traits>::Outputs>> outputs;
        {
            const std::lock_guard lock(mutex);
            for (auto& twin : twins) outputs.push_back(twin.run(inputs));
        }
        std::vector<Errors> block_device(twins.size());
        Errors block_cpp, block_floor;
        for (std::size_t i = 0; i < cases.size(); ++i) {
            for (std::size_t k = 0; k < twins.size(); ++k)
                Pair::judge(cases[i], dark, outputs[k][i], block_device[k]);
            Pair::judge(cases[i], dark, Pair::outputs_of(inputs[i]), block_cpp);
            if (!dark) Pair::judge(cases[i], dark, rounded_outputs(cases[i]), block_floor);
        }
        const std::lock_guard lock(mutex);
        for (std::size_t k = 0; k < twins.size(); ++k) device[k].append(block_device[k]);
        cpp.append(block_cpp);
        floor.append(block_floor);
        return static_cast<int>(dark ? cases.size() : block_floor.samples());
    };
    // Other lights take the place of those that are too dim, and of those of whose samples nothing is required. Where only
    // one light in many counts, fewer have to do.
    constexpr int kMostLights = 8; // for each one that is asked for
    int begin = 0, judged = 0;
    while (judged < count && begin < kMostLights * count) {
        const int size = judged == 0 ? count : std::max(count - judged, kBlock);
        std::atomic<int> of_use = 0;
        tbb::parallel_for(0, (size + kBlock - 1) / kBlock, [&](int block) {
            of_use += judge_lights(begin + block * kBlock, begin + std::min((block + 1) * kBlock, size));
        });
        begin += size;
        judged += of_use;
    }
    if (judged == 0) throw std::logic_error(std::string("no sample to judge: ") + lights.name);
    std::vector<Verdict> verdicts;
    for (const Errors& errors : device) {
        verdicts.push_back(compare(errors, cpp, floor, Pair::kImages));
        verdicts.back().lights = judged;
    }
    return verdicts;
}

/// Judges shaders of one technique on all classes for which `is_judged` holds, with about `count` lights in total.
/// \return a verdict for each shader
template <class Pair>
std::vector<Verdict> judge_twins(const ShaderPlatform& platform, const std::vector<VariantShader>& shaders,
                                 int count,
                                 const std::function<bool(const typename Pair::Traits::Class&)>& is_judged) {
    using Class = typename Pair::Traits::Class;
    Twins<Pair> twins;
    for (const auto& shader : shaders) twins.emplace_back(platform, shader);
    std::vector<const Class*> judged;
    for (const auto& lights : lab::classes_of(static_cast<const Class*>(nullptr)))
        if (is_judged(lights)) judged.push_back(&lights);
    const int per_class = (count + static_cast<int>(judged.size()) - 1) / static_cast<int>(judged.size());
    std::vector<Verdict> verdicts(shaders.size());
    for (const auto* lights : judged) {
        const auto of_class = judge_class<Pair>(*lights, per_class, twins);
        for (std::size_t k = 0; k < verdicts.size(); ++k) verdicts[k].add(lights->name, of_class[k]);
    }
    return verdicts;
}

/// Judges shaders of one technique on the classes that match its bound: 4 or 8 vertices, or lines.
template <class Pair>
std::vector<Verdict> judge_twins(const ShaderPlatform& platform, const std::vector<VariantShader>& shaders,
                                 int count) {
    return judge_twins<Pair>(platform, shaders, count, [](const auto& lights) {
        return lab::fits_bound(lights, Pair::Traits::kVertexBound);
    });
}

/// Judges one shader of a technique likewise.
template <class Pair>
Verdict judge_twin(const ShaderPlatform& platform, const VariantShader& shader, int count) {
    return judge_twins<Pair>(platform, {shader}, count).front();
}

/// The first of `count` hostile lights on which a twin breaks the contract; empty if there is none.
template <class Pair>
std::string first_violation(const ShaderPlatform& platform, const VariantShader& shader, int count) {
    using TwinOf = Twin<typename Pair::Traits>;
    TwinOf twin(platform, shader);
    std::vector<typename TwinOf::Input> inputs(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        hostile::HostileLights<float> source(1, i);
        draw(source, inputs[i].light, inputs[i].u);
        inputs[i].light = Pair::Kind::from(inputs[i].light);
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
