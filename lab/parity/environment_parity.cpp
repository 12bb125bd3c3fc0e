#include "lab/parity/environment_parity.h"

#include "lab/accuracy/lobe_lights.h"
#include "lab/parity/environment_maps.h"
#include "lab/parity/parity.h"
#include "lab/parity/shader_runner.h"

#include <nusselt/emission/environment_sampling.h>

#include <tbb/parallel_for.h>

#include <bit>
#include <functional>
#include <iterator>
#include <mutex>

namespace nusselt::parity {

namespace {

using hostile::RandomSource;
using proof::Exact;

/// The layout in which shaders/parity/environment_input.glsl writes its results.
struct EnvironmentOutputs {
    Vec3<float> p;
    float pdf;
    Vec2<float> at;
    float radiance;   ///< there, of the second channel
    float unshadowed; ///< of the second channel
    float pdf_of_wi;
    Vec2<float> inverse;
    float measure;
};

/// A surface in a map.
struct Scene {
    Frame<float> frame;
    LtcCoefficients<float> lobe;
    Vec2<float> u;
};

struct Cosine {
    static constexpr const char* kName = "EnvironmentCosine";
    static constexpr bool kHasLobe = false;

    template <class Real>
    static auto prepare(const EnvironmentMap<Real, 8>& map, const Frame<Real>& frame,
                        const LtcCoefficients<float>&) {
        return EnvironmentCosine<Real, 8>(map, frame);
    }
};

struct OnLobe {
    static constexpr const char* kName = "EnvironmentLtc";
    static constexpr bool kHasLobe = true;

    template <class Real>
    static auto prepare(const EnvironmentMap<Real, 8>& map, const Frame<Real>& frame,
                        const LtcCoefficients<float>& lobe) {
        return EnvironmentLtc<Real, 8>(
            map, frame, {Ltc<Real>({lobe.m00, lobe.m02, lobe.m11, lobe.m20, lobe.m22, lobe.albedo})});
    }
};

/// How surfaces lie in the map.
enum class Surfaces { random, in_planes, at_sunset, hostile };

struct Class {
    const char* name;
    Surroundings surroundings;
    Surfaces surfaces;
};

constexpr Class kClasses[] = {
    {"sky", Surroundings::sky, Surfaces::random},
    {"sky, normals in coordinate planes", Surroundings::sky, Surfaces::in_planes},
    {"sun", Surroundings::sun, Surfaces::random},
    {"sun at the horizon", Surroundings::sun, Surfaces::at_sunset},
    {"rough", Surroundings::rough, Surfaces::random},
    {"spikes", Surroundings::spikes, Surfaces::random},
    {"constant", Surroundings::constant, Surfaces::random},
    {"black", Surroundings::black, Surfaces::random},
    {"hostile", Surroundings::rough, Surfaces::hostile},
};

Vec3<double> draw_normal(RandomSource& random, Surfaces surfaces) {
    const Vec3<double> direction = random.direction();
    if (surfaces == Surfaces::random) return direction;
    if (surfaces == Surfaces::at_sunset) {
        const Vec3<double> sun = normalize(Vec3<double>{0.5, 0.3, 0.6});
        return normalize(normalize(cross(direction, sun)) + random.between(-0.1, 0.1) * sun);
    }
    const double angle = random.between(0, 2 * kPi<double>);
    const double off = random.log_between(1e-20, 1e-3);
    const double x = surfaces == Surfaces::hostile ? 1 - 2 * random.index(2) : std::cos(angle);
    const double y = surfaces == Surfaces::hostile ? off : std::sin(angle);
    const int which = random.index(3);
    return normalize(which == 0   ? Vec3<double>{x, y, 0}
                     : which == 1 ? Vec3<double>{y, 0, x}
                                  : Vec3<double>{0, x, y});
}

Scene draw_scene(Surfaces surfaces, int number) {
    RandomSource random(8, static_cast<std::uint64_t>(number));
    Scene scene{};
    scene.frame = Frame<float>::from_normal(broadcast<float>(draw_normal(random, surfaces)));
    if (surfaces == Surfaces::hostile) {
        hostile::HostileLights<float> lights(1, static_cast<std::uint64_t>(number));
        scene.lobe = lights.lobe();
        scene.u = {lights.random_number(), lights.random_number()};
        return scene;
    }
    scene.lobe = lab::lobe_of_table([&] { return random.uniform(); });
    scene.u = {below_one(static_cast<float>(random.uniform())),
               below_one(static_cast<float>(random.uniform()))};
    return scene;
}

/// Frames of floats are orthonormal up to roundings. The exact one is, so that directions and points of the map belong
/// together.
Frame<Exact> orthonormal(const Frame<float>& frame) {
    const auto n = normalize(broadcast<Exact>(frame.n));
    const auto t = broadcast<Exact>(frame.t);
    const auto along = normalize(t - dot(t, n) * n);
    return {along, cross(n, along), n};
}

template <class Pair>
std::vector<EnvironmentOutputs> run(ShaderRunner& runner, std::size_t first_word,
                                    const std::vector<Scene>& scenes) {
    std::vector<float> inputs;
    for (const Scene& scene : scenes) {
        inputs.push_back(static_cast<float>(first_word));
        for (const Vec3<float>& v : {scene.frame.t, scene.frame.b, scene.frame.n})
            inputs.insert(inputs.end(), {v.x, v.y, v.z});
        inputs.insert(inputs.end(), {scene.u.x, scene.u.y});
        const auto& c = scene.lobe;
        if (Pair::kHasLobe) inputs.insert(inputs.end(), {c.m00, c.m02, c.m11, c.m20, c.m22, c.albedo});
    }
    std::vector<EnvironmentOutputs> results;
    for (const auto& written : runner.run(inputs))
        results.push_back(std::bit_cast<EnvironmentOutputs>(written));
    return results;
}

/// What C++ returns, in float or rounded to it.
template <class Real, class Technique>
EnvironmentOutputs outputs_of(const Technique& technique, const EnvironmentMap<Real, 8>& map,
                              const Vec2<float>& u) {
    const auto s = technique.sample(broadcast<Real>(u));
    const Vec3<float> p = broadcast<float>(s.p);
    const Vec3<Real> rounded = std::is_same_v<Real, float> ? s.wi : normalize(broadcast<Real>(p));
    const auto single = [](const Real& x) { return static_cast<float>(x); };
    const auto inverse = technique.invert(rounded);
    return {p,
            single(s.pdf),
            {below_one(single(s.at.x)), below_one(single(s.at.y))},
            single(map.radiance.lookup(s.at).y),
            single(technique.unshadowed().y),
            single(technique.pdf(rounded)),
            {below_one(single(inverse.x)), below_one(single(inverse.y))},
            single(technique.measure())};
}

bool is_valid(const EnvironmentOutputs& out) {
    for (const float x : {out.pdf, out.radiance, out.unshadowed, out.pdf_of_wi, out.measure})
        if (!(is_finite(x) && x >= 0)) return false;
    return hostile::all_finite(out.p) && hostile::in_unit_interval(out.at) &&
           hostile::in_unit_interval(out.inverse);
}

/// Judges the results of one method.
template <class Technique>
void judge(const Technique& exact, const EnvironmentMap<Exact, 8>& map, const Frame<Exact>& frame,
           const Scene& scene, const EnvironmentOutputs& out, Errors& errors) {
    if (!is_valid(out)) {
        ++errors.invalid;
        return;
    }
    if (exact.measure() == 0) {
        errors.spurious += out.pdf > 0 || out.measure > 0;
        return;
    }
    errors.add(Quantity::measure, std::fabs(out.measure / exact.measure() - 1));
    errors.add(Quantity::measure, std::fabs(out.unshadowed / exact.unshadowed().y - 1));
    if (out.pdf == 0) {
        ++errors.no_sample;
        return;
    }
    const Vec2<Exact> at = broadcast<Exact>(out.at);
    const Vec3<Exact> to_point = frame.to_local(octahedral_direction(at));
    const Vec3<Exact> direction = broadcast<Exact>(out.p) / EnvironmentCosine<Exact, 8>::kDistance;
    const Vec3<Exact> wi = normalize(direction);
    errors.add(Quantity::unit_length, std::fabs(length(direction) - 1));
    errors.add(Quantity::aim, length(cross(wi, to_point)));
    // The point hit is at infinity. What counts is the radiance there.
    errors.add(Quantity::hit_point, std::fabs(out.radiance / map.radiance.lookup(at).y - 1));
    // The point of the map tells the texel of a sample. That of its rounded direction may lie in another one.
    const Vec2<Exact> explained = exact.invert(to_point);
    errors.add(Quantity::first_random, std::fabs(explained.x - scene.u.x));
    errors.add(Quantity::second_random, std::fabs(explained.y - scene.u.y));
    errors.add(Quantity::sample_density, std::fabs(out.pdf / exact.pdf_at(at) - 1));
    errors.add(Quantity::density, std::fabs(out.pdf_of_wi / exact.pdf(wi) - 1));
    const Vec2<Exact> inverse = exact.invert(wi);
    errors.add(Quantity::first_inverse, std::fabs(out.inverse.x - inverse.x));
    errors.add(Quantity::second_inverse, std::fabs(out.inverse.y - inverse.y));
}

/// Judges one surface.
template <class Pair>
void judge_scene(const Class& of, const TestMap& map, const Scene& scene,
                 const std::vector<EnvironmentOutputs>& device_outputs, std::vector<Errors>& device,
                 Errors& cpp, Errors& floor) {
    if (of.surfaces == Surfaces::hostile) {
        // Rounding decides what samples are, but they keep the contract.
        for (std::size_t k = 0; k < device.size(); ++k) device[k].invalid += !is_valid(device_outputs[k]);
        return;
    }
    const auto frame = orthonormal(scene.frame);
    const auto exact = Pair::prepare(map.exact(), frame, scene.lobe);
    const auto judge_one = [&](const EnvironmentOutputs& out, Errors& errors) {
        judge(exact, map.exact(), frame, scene, out, errors);
    };
    for (std::size_t k = 0; k < device.size(); ++k) judge_one(device_outputs[k], device[k]);
    const auto single = Pair::prepare(map.in_float(), scene.frame, scene.lobe);
    judge_one(outputs_of(single, map.in_float(), scene.u), cpp);
    if (exact.measure() > 0) judge_one(outputs_of(exact, map.exact(), scene.u), floor);
}

template <class Pair>
std::vector<Verdict> judge_class(const Class& of, int count, const TestMaps& maps,
                                 std::deque<ShaderRunner>& runners) {
    std::vector<Scene> scenes;
    for (int i = 0; i < count; ++i) scenes.push_back(draw_scene(of.surfaces, i));
    std::vector<std::vector<EnvironmentOutputs>> outputs;
    for (ShaderRunner& runner : runners)
        outputs.push_back(run<Pair>(runner, maps.first_word(of.surroundings), scenes));

    std::vector<Errors> device(runners.size());
    Errors cpp, floor;
    std::mutex mutex;
    constexpr int kBlock = 256;
    tbb::parallel_for(0, (count + kBlock - 1) / kBlock, [&](int block) {
        std::vector<Errors> block_device(runners.size());
        Errors block_cpp, block_floor;
        for (int i = block * kBlock; i < std::min((block + 1) * kBlock, count); ++i) {
            const auto number = static_cast<std::size_t>(i);
            std::vector<EnvironmentOutputs> of_devices;
            for (const auto& of_device : outputs) of_devices.push_back(of_device[number]);
            judge_scene<Pair>(of, maps.of(of.surroundings), scenes[number], of_devices, block_device,
                              block_cpp, block_floor);
        }
        const std::lock_guard lock(mutex);
        for (std::size_t k = 0; k < device.size(); ++k) device[k].append(block_device[k]);
        cpp.append(block_cpp);
        floor.append(block_floor);
    });
    std::vector<Verdict> verdicts;
    for (const Errors& errors : device) {
        // A rounding decides about the texel of a direction, and whether it is above the horizon.
        verdicts.push_back(compare(errors, cpp, floor, Images::rounded));
        verdicts.back().lights = count;
    }
    return verdicts;
}

template <class Pair>
std::vector<Verdict> judge_pair(const gpu::Device& device,
                                const std::vector<std::span<const std::uint32_t>>& shaders, int count) {
    const TestMaps maps;
    std::deque<ShaderRunner> runners;
    for (const auto& shader : shaders)
        runners.emplace_back(device, shader, Pair::kHasLobe ? 18 : 12, maps.words());
    std::vector<Verdict> verdicts(shaders.size());
    for (const Class& of : kClasses) {
        const auto of_class =
            judge_class<Pair>(of, count / static_cast<int>(std::size(kClasses)), maps, runners);
        for (std::size_t k = 0; k < verdicts.size(); ++k) verdicts[k].add(of.name, of_class[k]);
    }
    return verdicts;
}

ParityCase case_of(EnvironmentTechnique technique, const char* name) {
    return {"technique", name, [=](const gpu::Device& device, const ParityEffort& effort) {
                const std::vector<Variant> variants = variants_for(device);
                std::vector<std::span<const std::uint32_t>> shaders;
                for (const Variant variant : variants) shaders.push_back(twin_shader(name, 2, variant));
                const auto verdicts = judge_environment(device, technique, shaders, effort.lights / 3);
                std::vector<VariantVerdict> results;
                for (std::size_t k = 0; k < variants.size(); ++k)
                    results.push_back({variants[k], verdicts[k]});
                return results;
            }};
}

} // namespace

std::vector<Verdict> judge_environment(const gpu::Device& device, EnvironmentTechnique technique,
                                       const std::vector<std::span<const std::uint32_t>>& shaders,
                                       int count) {
    return technique == EnvironmentTechnique::cosine ? judge_pair<Cosine>(device, shaders, count)
                                                     : judge_pair<OnLobe>(device, shaders, count);
}

void add_environment_cases(std::vector<ParityCase>& cases) {
    cases.push_back(case_of(EnvironmentTechnique::cosine, Cosine::kName));
    cases.push_back(case_of(EnvironmentTechnique::on_lobe, OnLobe::kName));
}

} // namespace nusselt::parity
