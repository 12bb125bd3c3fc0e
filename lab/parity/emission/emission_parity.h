#pragma once
/// What the parity of techniques for emission that varies has in common: how their results are judged.

#include "lab/parity/parity.h"
#include "lab/parity/parity_check.h"
#include "lab/parity/shader_platform.h"
#include "lab/parity/twin_shader.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <mutex>
#include <span>
#include <tbb/parallel_for.h>
#include <type_traits>
#include <vector>

namespace nusselt::parity {

/// The layout in which shaders write their results.
struct EmissionOutputs {
    Vec3<float> way; ///< to the sample, in the unit of the kind of light
    float pdf;
    Vec2<float> at;
    float place;      ///< what tells whether the point that was hit is the one at these coordinates
    float unshadowed; ///< of the second channel
    float pdf_of_wi;
    Vec2<float> inverse;
    float measure;
};

/// Where a sample leads, exactly.
struct ExactWay {
    Vec3<proof::Exact> to_point;  ///< unit direction to the point at EmissionOutputs::at
    Vec3<proof::Exact> direction; ///< EmissionOutputs::way with the unit 1
    proof::Exact hit_error;       ///< error of the point that was hit
    /// Whether to_point is the direction with length one, and densities at EmissionOutputs::at are those of this direction.
    bool is_direction = false;
};

/// What does not depend on the sample. Exact results take most of the time, so they are computed once for all methods.
struct ExactTotals {
    proof::Exact measure, unshadowed; ///< as in EmissionOutputs
};

template <class Technique>
ExactTotals totals_of(const Technique& exact) {
    return {exact.measure(), exact.unshadowed().y};
}

/// The words of a lobe for shaders.
inline void append_lobe(const LtcCoefficients<float>& c, std::vector<float>& inputs) {
    inputs.insert(inputs.end(), {c.m00, c.m02, c.m11, c.m20, c.m22, c.albedo});
}

inline std::vector<EmissionOutputs> run_emission(ShaderRunner& runner, const std::vector<float>& inputs) {
    std::vector<EmissionOutputs> results;
    for (const auto& written : runner.run(inputs)) results.push_back(std::bit_cast<EmissionOutputs>(written));
    return results;
}

/// What C++ returns for a sample, in float or rounded to it.
/// \param way, place see EmissionOutputs
template <class Real, class Technique, class Sample>
EmissionOutputs outputs_of(const Technique& technique, const Sample& sample, const Vec3<Real>& way,
                           const Real& place) {
    const Vec3<float> rounded_way = broadcast<float>(way);
    const Vec3<Real> wi = std::is_same_v<Real, float> ? sample.wi : normalize(broadcast<Real>(rounded_way));
    const auto single = [](const Real& x) { return static_cast<float>(x); };
    const auto inverse = technique.invert(wi);
    return {rounded_way,
            single(sample.pdf),
            {below_one(single(sample.at.x)), below_one(single(sample.at.y))},
            single(place),
            single(technique.unshadowed().y),
            single(technique.pdf(wi)),
            {below_one(single(inverse.x)), below_one(single(inverse.y))},
            single(technique.measure())};
}

inline bool is_valid(const EmissionOutputs& out) {
    for (const float x : {out.pdf, out.place, out.unshadowed, out.pdf_of_wi, out.measure})
        if (!(is_finite(x) && x >= 0)) return false;
    return hostile::all_finite(out.way) && hostile::in_unit_interval(out.at) &&
           hostile::in_unit_interval(out.inverse);
}

/// Judges the results of one method.
/// \param totals of the exact technique
/// \param way_of function of the results that gives an ExactWay
template <class Technique, class WayOf>
void judge_outputs(const Technique& exact, const ExactTotals& totals, const Vec2<float>& u,
                   const EmissionOutputs& out, const WayOf& way_of, Errors& errors) {
    using proof::Exact;
    if (!is_valid(out)) {
        ++errors.invalid;
        return;
    }
    if (totals.measure == 0) {
        errors.spurious += out.pdf > 0 || out.measure > 0;
        return;
    }
    errors.add(Quantity::measure, std::fabs(out.measure / totals.measure - 1));
    errors.add(Quantity::measure, std::fabs(out.unshadowed / totals.unshadowed - 1));
    if (out.pdf == 0) {
        ++errors.no_sample;
        return;
    }
    const ExactWay way = way_of(out);
    const Vec3<Exact> wi = normalize(way.direction);
    errors.add(Quantity::unit_length, std::fabs(length(way.direction) - 1));
    errors.add(Quantity::aim, length(cross(wi, way.to_point)));
    errors.add(Quantity::hit_point, way.hit_error);
    const Exact density = exact.pdf(wi);
    const Vec2<Exact> inverse = exact.invert(wi);
    // The coordinates of a sample tell its texel. Those of its rounded direction may lie in another one.
    const Vec2<Exact> explained = way.is_direction ? inverse : exact.invert(way.to_point);
    const Exact density_at = way.is_direction ? density : exact.pdf_at(broadcast<Exact>(out.at));
    errors.add(Quantity::first_random, std::fabs(explained.x - u.x));
    errors.add(Quantity::second_random, std::fabs(explained.y - u.y));
    errors.add(Quantity::sample_density, std::fabs(out.pdf / density_at - 1));
    errors.add(Quantity::density, std::fabs(out.pdf_of_wi / density - 1));
    errors.add(Quantity::first_inverse, std::fabs(out.inverse.x - inverse.x));
    errors.add(Quantity::second_inverse, std::fabs(out.inverse.y - inverse.y));
}

/// The errors of shaders, of C++ in float, and of exact results that are rounded.
struct MethodErrors {
    std::vector<Errors> device;
    Errors cpp, floor;
};

/// Judges all scenes of a class, in parallel.
/// \param outputs     of each shader for each scene
/// \param judge_scene function of the number of a scene, the results of all shaders for it, and MethodErrors to add to
template <class JudgeScene>
std::vector<Verdict> judge_scenes(int count, const std::vector<std::vector<EmissionOutputs>>& outputs,
                                  const JudgeScene& judge_scene) {
    MethodErrors all{std::vector<Errors>(outputs.size()), {}, {}};
    std::mutex mutex;
    constexpr int kBlock = 256;
    tbb::parallel_for(0, (count + kBlock - 1) / kBlock, [&](int block) {
        MethodErrors of_block{std::vector<Errors>(outputs.size()), {}, {}};
        for (int i = block * kBlock; i < std::min((block + 1) * kBlock, count); ++i) {
            const auto number = static_cast<std::size_t>(i);
            std::vector<EmissionOutputs> of_devices;
            for (const auto& of_device : outputs) of_devices.push_back(of_device[number]);
            judge_scene(number, of_devices, of_block);
        }
        const std::lock_guard lock(mutex);
        for (std::size_t k = 0; k < outputs.size(); ++k) all.device[k].append(of_block.device[k]);
        all.cpp.append(of_block.cpp);
        all.floor.append(of_block.floor);
    });
    std::vector<Verdict> verdicts;
    for (const Errors& errors : all.device) {
        // A rounding decides about the way in which a cell is sampled, about the texel that a direction meets, and whether it
        // is above the horizon.
        verdicts.push_back(compare(errors, all.cpp, all.floor, Images::rounded));
        verdicts.back().lights = count;
    }
    return verdicts;
}

/// Judges classes of scenes, which share the lights equally.
/// \param words       of the buffer of lights
/// \param input_words for each scene
/// \param draw        function of a class and a number that gives a scene
/// \param run         function of the runner of a shader, a class and its scenes that gives their results
/// \param judge_scene function of a class, a scene, the results of all shaders for it, and MethodErrors to add to
template <class Classes, class Draw, class Run, class JudgeScene>
std::vector<Verdict> judge_classes(const ShaderPlatform& platform, const Classes& classes, int count,
                                   const std::vector<VariantShader>& shaders, std::size_t input_words,
                                   const std::vector<std::uint32_t>& words, const Draw& draw, const Run& run,
                                   const JudgeScene& judge_scene) {
    std::vector<std::unique_ptr<ShaderRunner>> runners;
    for (const auto& shader : shaders) runners.push_back(platform.load(shader, input_words, words));
    std::vector<Verdict> verdicts(shaders.size());
    for (const auto& of : classes) {
        const int scene_count = count / static_cast<int>(std::size(classes));
        std::vector<decltype(draw(of, 0))> scenes;
        for (int i = 0; i < scene_count; ++i) scenes.push_back(draw(of, i));
        std::vector<std::vector<EmissionOutputs>> outputs;
        for (const auto& runner : runners) outputs.push_back(run(*runner, of, scenes));
        const auto of_class =
            judge_scenes(scene_count, outputs,
                         [&](std::size_t number, const std::vector<EmissionOutputs>& of_devices,
                             MethodErrors& errors) { judge_scene(of, scenes[number], of_devices, errors); });
        for (std::size_t k = 0; k < verdicts.size(); ++k) verdicts[k].add(of.name, of_class[k]);
    }
    return verdicts;
}

/// \param vertices for twin_shader()
/// \param judge    function of a platform, the shaders and the number of lights
template <class Judge>
ParityCase emission_case(const char* name, int vertices, const Judge& judge) {
    return {"technique", name, [=](const ShaderPlatform& platform, const ParityEffort& effort) {
                const std::vector<Variant> variants = platform.variants();
                std::vector<VariantShader> shaders;
                for (const Variant variant : variants)
                    shaders.push_back(twin_shader(name, vertices, variant));
                const auto verdicts = judge(platform, shaders, effort.lights / 3);
                std::vector<VariantVerdict> results;
                for (std::size_t k = 0; k < variants.size(); ++k)
                    results.push_back({variants[k], verdicts[k]});
                return results;
            }};
}

} // namespace nusselt::parity
