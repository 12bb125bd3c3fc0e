#include "lab/parity/emission/environment_parity.h"

#include "lab/accuracy/lobe_lights.h"
#include "lab/parity/emission/emission_parity.h"
#include "lab/parity/emission/environment_maps.h"

#include <nusselt/emission/environment_sampling.h>

namespace nusselt::parity {

namespace {

using hostile::RandomSource;
using proof::Exact;

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
std::vector<EmissionOutputs> run(ShaderRunner& runner, std::size_t first_word,
                                 const std::vector<Scene>& scenes) {
    std::vector<float> inputs;
    for (const Scene& scene : scenes) {
        inputs.push_back(static_cast<float>(first_word));
        for (const Vec3<float>& v : {scene.frame.t, scene.frame.b, scene.frame.n})
            inputs.insert(inputs.end(), {v.x, v.y, v.z});
        inputs.insert(inputs.end(), {scene.u.x, scene.u.y});
        if (Pair::kHasLobe) append_lobe(scene.lobe, inputs);
    }
    return run_emission(runner, inputs);
}

/// The way leads to the point at infinity; the place is the radiance there, of the second channel.
template <class Real, class Technique>
EmissionOutputs sample_in_cpp(const Technique& technique, const EnvironmentMap<Real, 8>& map,
                              const Vec2<float>& u) {
    const auto s = technique.sample(broadcast<Real>(u));
    return outputs_of(technique, s, s.p, map.radiance.lookup(s.at).y);
}

/// Judges one surface.
template <class Pair>
void judge_scene(const Class& of, const TestMap& map, const Scene& scene,
                 const std::vector<EmissionOutputs>& device_outputs, MethodErrors& errors) {
    if (of.surfaces == Surfaces::hostile) {
        // Rounding decides what samples are, but they keep the contract.
        for (std::size_t k = 0; k < device_outputs.size(); ++k)
            errors.device[k].invalid += !is_valid(device_outputs[k]);
        return;
    }
    const auto frame = orthonormal(scene.frame);
    const auto exact = Pair::prepare(map.exact(), frame, scene.lobe);
    const ExactTotals totals = totals_of(exact);
    const auto way_of = [&](const EmissionOutputs& out) -> ExactWay {
        const Vec2<Exact> at = broadcast<Exact>(out.at);
        return {frame.to_local(octahedral_direction(at)),
                broadcast<Exact>(out.way) / EnvironmentCosine<Exact, 8>::kDistance,
                std::fabs(out.place / map.exact().radiance.lookup(at).y - 1)};
    };
    const auto judge_one = [&](const EmissionOutputs& out, Errors& to) {
        judge_outputs(exact, totals, scene.u, out, way_of, to);
    };
    for (std::size_t k = 0; k < device_outputs.size(); ++k) judge_one(device_outputs[k], errors.device[k]);
    const auto single = Pair::prepare(map.in_float(), scene.frame, scene.lobe);
    judge_one(sample_in_cpp(single, map.in_float(), scene.u), errors.cpp);
    if (totals.measure > 0) judge_one(sample_in_cpp(exact, map.exact(), scene.u), errors.floor);
}

template <class Pair>
std::vector<Verdict> judge_pair(const ShaderPlatform& platform, const std::vector<VariantShader>& shaders,
                                int count) {
    const TestMaps maps;
    return judge_classes(
        platform, kClasses, count, shaders, Pair::kHasLobe ? 18 : 12, maps.words(),
        [](const Class& of, int number) { return draw_scene(of.surfaces, number); },
        [&](ShaderRunner& runner, const Class& of, const std::vector<Scene>& scenes) {
            return run<Pair>(runner, maps.first_word(of.surroundings), scenes);
        },
        [&](const Class& of, const Scene& scene, const std::vector<EmissionOutputs>& of_devices,
            MethodErrors& errors) {
            judge_scene<Pair>(of, maps.of(of.surroundings), scene, of_devices, errors);
        });
}

} // namespace

std::vector<Verdict> judge_environment(const ShaderPlatform& platform, EnvironmentTechnique technique,
                                       const std::vector<VariantShader>& shaders, int count) {
    return technique == EnvironmentTechnique::cosine ? judge_pair<Cosine>(platform, shaders, count)
                                                     : judge_pair<OnLobe>(platform, shaders, count);
}

void add_environment_cases(std::vector<ParityCase>& cases) {
    cases.push_back(emission_case(Cosine::kName, 2, judge_pair<Cosine>));
    cases.push_back(emission_case(OnLobe::kName, 2, judge_pair<OnLobe>));
}

} // namespace nusselt::parity
