#include "lab/parity/textured_parity.h"

#include "lab/accuracy/lobe_lights.h"
#include "lab/parity/parity.h"
#include "lab/parity/shader_runner.h"
#include "lab/parity/textured_lights.h"

#include <tbb/parallel_for.h>

#include <bit>
#include <cstring>
#include <functional>
#include <mutex>

namespace nusselt::parity {

namespace {

using hostile::RandomSource;
using proof::Exact;

/// The projected solid angle of each cell has a rounding error of up to 1e-7. Of lights that are dimmer than this,
/// nothing else may remain, as where a lobe hardly reaches them.
constexpr Exact kSmallestWeight = 3e-5L;

/// The layout in which shaders/parity/textured_input.glsl writes its results.
struct TexturedOutputs {
    Vec3<float> wi;
    float pdf;
    Vec2<float> at;
    float off;        ///< distance of the point from the one with these texture coordinates
    float unshadowed; ///< of the second channel
    float pdf_of_wi;
    Vec2<float> inverse;
    float measure;
};

/// A light at a place in shading space.
struct Scene {
    const TexturedTestLight* light;
    TexturePlane<float> plane;
    LtcCoefficients<float> lobe;
    Vec2<float> u;
};

struct Diffuse {
    static constexpr const char* kName = "TexturedPolygon";
    static constexpr bool kHasLobe = false;
    template <class Real>
    using Technique = TexturedPolygon<Real, 8, DescentByProduct>;

    template <class Real>
    static Technique<Real> prepare(const TexturePlane<Real>& plane, const TexturedLight<Real, 8>& light,
                                   const LtcCoefficients<float>&) {
        return Technique<Real>(plane, light);
    }
};

struct OnLobe {
    static constexpr const char* kName = "TexturedPolygonLtc";
    static constexpr bool kHasLobe = true;
    template <class Real>
    using Technique = TexturedPolygonLtc<Real, 8, DescentByProduct>;

    template <class Real>
    static Technique<Real> prepare(const TexturePlane<Real>& plane, const TexturedLight<Real, 8>& light,
                                   const LtcCoefficients<float>& lobe) {
        return Technique<Real>(plane, light,
                               {Ltc<Real>({lobe.m00, lobe.m02, lobe.m11, lobe.m20, lobe.m22, lobe.albedo})});
    }
};

/// Where lights of a class are.
enum class Place { above, close, far, crossing, below, hostile };

struct Class {
    const char* name;
    Place place;
    Look look;
};

constexpr Class kClasses[] = {
    {"above the horizon, smooth", Place::above, Look::smooth},
    {"above the horizon, busy", Place::above, Look::busy},
    {"above the horizon, spiky", Place::above, Look::spiky},
    {"close, smooth", Place::close, Look::smooth},
    {"close, busy", Place::close, Look::busy},
    {"far, smooth", Place::far, Look::smooth},
    {"far, busy", Place::far, Look::busy},
    {"crossing the horizon, smooth", Place::crossing, Look::smooth},
    {"crossing the horizon, busy", Place::crossing, Look::busy},
    {"black", Place::above, Look::black},
    {"below the horizon", Place::below, Look::smooth},
    {"hostile", Place::hostile, Look::busy},
};

Vec3<double> draw_centre(RandomSource& random, Place place, const Vec3<double>& x, const Vec3<double>& y,
                         const Vec3<double>& normal) {
    if (place == Place::close)
        return random.between(-0.4, 0.4) * x + random.between(-0.4, 0.4) * y +
               random.log_between(0.02, 0.2) * normal;
    const double distance = place == Place::far ? random.log_between(3, 30) : random.log_between(0.7, 3);
    return distance * random.direction();
}

/// Whether the light is where it should be.
bool fits(Place place, const TexturePlane<double>& plane) {
    double low = 1e30, high = -1e30;
    for (const Vec2<double> at : {Vec2<double>{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
        low = std::min(low, plane.point_at(at).z);
        high = std::max(high, plane.point_at(at).z);
    }
    const Vec3<double> centre = plane.point_at({0.5, 0.5});
    const double cosine = std::fabs(dot(plane.normal, centre)) / length(centre);
    switch (place) {
    case Place::above:
    case Place::far:
        return low > 0.02 && cosine > 0.05;
    case Place::crossing:
        return low < -0.05 && high > 0.05 && cosine > 0.05;
    case Place::below:
        return high < 0;
    default:
        return centre.z > 0.01;
    }
}

TexturePlane<double> draw_plane(RandomSource& random, Place place) {
    if (place == Place::hostile) {
        const double coordinates[] = {0, 0, 1, -1, 0.5, 1e-6, -1e-6, 1e-3, 1e6, -1e6, 1e-9, 0.3333333};
        const double scales[] = {1, 1, 1e-3, 1e4};
        const double scale = scales[random.index(4)];
        Vec3<double> v[3];
        for (auto& w : v)
            for (double* x : {&w.x, &w.y, &w.z}) *x = scale * coordinates[random.index(12)];
        return make_texture_plane(v[0], v[1], v[2]);
    }
    for (;;) {
        const Vec3<double> x = random.direction();
        const Vec3<double> normal = normalize(cross(x, random.direction()));
        const Vec3<double> y = random.between(0.5, 1.5) * (cross(normal, x) + random.between(-0.4, 0.4) * x);
        const auto centre = draw_centre(random, place, x, y, normal);
        const auto plane = make_texture_plane(centre - 0.5 * (x + y), x, y);
        if (fits(place, plane)) return plane;
    }
}

Scene draw_scene(const TexturedTestLights& lights, const Class& of, int number) {
    RandomSource random(7, static_cast<std::uint64_t>(number));
    const auto plane = draw_plane(random, of.place);
    Scene scene{};
    scene.light = &lights.draw(of.look, random);
    scene.plane = make_texture_plane(broadcast<float>(plane.corner), broadcast<float>(plane.side_x),
                                     broadcast<float>(plane.side_y));
    if (of.place == Place::hostile)
        scene.lobe = hostile::HostileLights<float>(1, static_cast<std::uint64_t>(number)).lobe();
    else
        scene.lobe = lab::lobe_of_table([&] { return random.uniform(); });
    scene.u = {std::min(static_cast<float>(random.uniform()), 1 - 0x1p-24f),
               std::min(static_cast<float>(random.uniform()), 1 - 0x1p-24f)};
    return scene;
}

template <class Pair>
std::vector<TexturedOutputs> run(ShaderRunner& runner, const std::vector<Scene>& scenes) {
    std::vector<float> inputs;
    for (const Scene& scene : scenes) {
        for (const Vec3<float>& v :
             {scene.plane.corner, scene.plane.side_x, scene.plane.side_y, scene.plane.normal})
            inputs.insert(inputs.end(), {v.x, v.y, v.z});
        inputs.insert(inputs.end(), {static_cast<float>(scene.light->first_word()), scene.u.x, scene.u.y});
        const auto& c = scene.lobe;
        if (Pair::kHasLobe) inputs.insert(inputs.end(), {c.m00, c.m02, c.m11, c.m20, c.m22, c.albedo});
    }
    std::vector<TexturedOutputs> results;
    for (const auto& written : runner.run(inputs)) results.push_back(std::bit_cast<TexturedOutputs>(written));
    return results;
}

/// What C++ returns, in float or rounded to it.
template <class Real, class Technique>
TexturedOutputs outputs_of(const Technique& technique, const TexturePlane<Real>& plane,
                           const Vec2<float>& u) {
    const auto s = technique.sample(broadcast<Real>(u));
    const Vec3<float> wi = broadcast<float>(s.wi);
    const Vec3<Real> rounded = std::is_same_v<Real, float> ? s.wi : normalize(broadcast<Real>(wi));
    const auto single = [](const Real& x) { return static_cast<float>(x); };
    const auto inverse = technique.invert(rounded);
    return {wi,
            single(s.pdf),
            {below_one(single(s.at.x)), below_one(single(s.at.y))},
            single(length(s.p - plane.point_at(s.at))),
            single(technique.unshadowed().y),
            single(technique.pdf(rounded)),
            {below_one(single(inverse.x)), below_one(single(inverse.y))},
            single(technique.measure())};
}

bool is_valid(const TexturedOutputs& out) {
    for (const float x : {out.pdf, out.off, out.unshadowed, out.pdf_of_wi, out.measure})
        if (!(is_finite(x) && x >= 0)) return false;
    return hostile::all_finite(out.wi) && hostile::in_unit_interval(out.at) &&
           hostile::in_unit_interval(out.inverse);
}

/// Judges the results of one method.
template <class Technique>
void judge(const Technique& exact, const TexturePlane<Exact>& plane, const Scene& scene,
           const TexturedOutputs& out, Errors& errors) {
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
    const Vec3<Exact> to_point = normalize(plane.point_at(at));
    const Vec3<Exact> direction = broadcast<Exact>(out.wi);
    const Vec3<Exact> wi = normalize(direction);
    errors.add(Quantity::unit_length, std::fabs(length(direction) - 1));
    errors.add(Quantity::aim, length(cross(wi, to_point)));
    errors.add(Quantity::hit_point, out.off / std::max(length(plane.side_x), length(plane.side_y)));
    // The texture coordinates of a sample tell its texel. Those of its rounded direction may lie in another one.
    const Vec2<Exact> explained = exact.invert(to_point);
    errors.add(Quantity::first_random, std::fabs(explained.x - scene.u.x));
    errors.add(Quantity::second_random, std::fabs(explained.y - scene.u.y));
    errors.add(Quantity::sample_density, std::fabs(out.pdf / exact.pdf_at(at) - 1));
    errors.add(Quantity::density, std::fabs(out.pdf_of_wi / exact.pdf(wi) - 1));
    const Vec2<Exact> inverse = exact.invert(wi);
    errors.add(Quantity::first_inverse, std::fabs(out.inverse.x - inverse.x));
    errors.add(Quantity::second_inverse, std::fabs(out.inverse.y - inverse.y));
}

/// Judges one light.
template <class Pair>
void judge_scene(const Class& of, const Scene& scene, const std::vector<TexturedOutputs>& device_outputs,
                 std::vector<Errors>& device, Errors& cpp, Errors& floor) {
    const auto single = Pair::prepare(scene.plane, scene.light->in_float(), scene.lobe);
    const TexturedOutputs of_cpp = outputs_of(single, scene.plane, scene.u);
    if (of.place == Place::hostile) {
        // Rounding decides what they are, but they keep the contract.
        for (std::size_t k = 0; k < device.size(); ++k) device[k].invalid += !is_valid(device_outputs[k]);
        return;
    }
    const auto plane =
        make_texture_plane(broadcast<Exact>(scene.plane.corner), broadcast<Exact>(scene.plane.side_x),
                           broadcast<Exact>(scene.plane.side_y));
    const auto exact = Pair::prepare(plane, scene.light->exact(), scene.lobe);
    if (exact.measure() > 0 && exact.measure() < kSmallestWeight) return;
    for (std::size_t k = 0; k < device.size(); ++k) judge(exact, plane, scene, device_outputs[k], device[k]);
    judge(exact, plane, scene, of_cpp, cpp);
    if (exact.measure() > 0) judge(exact, plane, scene, outputs_of(exact, plane, scene.u), floor);
}

template <class Pair>
std::vector<Verdict> judge_class(const Class& of, int count, const TexturedTestLights& lights,
                                 std::deque<ShaderRunner>& runners) {
    std::vector<Scene> scenes;
    for (int i = 0; i < count; ++i) scenes.push_back(draw_scene(lights, of, i));
    std::vector<std::vector<TexturedOutputs>> outputs;
    for (ShaderRunner& runner : runners) outputs.push_back(run<Pair>(runner, scenes));

    std::vector<Errors> device(runners.size());
    Errors cpp, floor;
    std::mutex mutex;
    constexpr int kBlock = 256;
    tbb::parallel_for(0, (count + kBlock - 1) / kBlock, [&](int block) {
        std::vector<Errors> block_device(runners.size());
        Errors block_cpp, block_floor;
        for (int i = block * kBlock; i < std::min((block + 1) * kBlock, count); ++i) {
            const auto number = static_cast<std::size_t>(i);
            std::vector<TexturedOutputs> of_devices;
            for (const auto& of_device : outputs) of_devices.push_back(of_device[number]);
            judge_scene<Pair>(of, scenes[number], of_devices, block_device, block_cpp, block_floor);
        }
        const std::lock_guard lock(mutex);
        for (std::size_t k = 0; k < device.size(); ++k) device[k].append(block_device[k]);
        cpp.append(block_cpp);
        floor.append(block_floor);
    });
    std::vector<Verdict> verdicts;
    for (const Errors& errors : device) {
        // A rounding decides about the way in which a cell is sampled, and about the texel that a direction meets.
        verdicts.push_back(compare(errors, cpp, floor, Images::rounded));
        verdicts.back().lights = count;
    }
    return verdicts;
}

template <class Pair>
std::vector<Verdict> judge_pair(const gpu::Device& device,
                                const std::vector<std::span<const std::uint32_t>>& shaders, int count) {
    const TexturedTestLights lights;
    std::deque<ShaderRunner> runners;
    for (const auto& shader : shaders)
        runners.emplace_back(device, shader, Pair::kHasLobe ? 21 : 15, lights.words());
    std::vector<Verdict> verdicts(shaders.size());
    for (const Class& of : kClasses) {
        const auto of_class =
            judge_class<Pair>(of, count / static_cast<int>(std::size(kClasses)), lights, runners);
        for (std::size_t k = 0; k < verdicts.size(); ++k) verdicts[k].add(of.name, of_class[k]);
    }
    return verdicts;
}

ParityCase case_of(TexturedTechnique technique, const char* name) {
    return {"technique", name, [=](const gpu::Device& device, const ParityEffort& effort) {
                const std::vector<Variant> variants = variants_for(device);
                std::vector<std::span<const std::uint32_t>> shaders;
                for (const Variant variant : variants) shaders.push_back(twin_shader(name, 8, variant));
                const auto verdicts = judge_textured(device, technique, shaders, effort.lights / 3);
                std::vector<VariantVerdict> results;
                for (std::size_t k = 0; k < variants.size(); ++k)
                    results.push_back({variants[k], verdicts[k]});
                return results;
            }};
}

} // namespace

std::vector<Verdict> judge_textured(const gpu::Device& device, TexturedTechnique technique,
                                    const std::vector<std::span<const std::uint32_t>>& shaders, int count) {
    return technique == TexturedTechnique::diffuse ? judge_pair<Diffuse>(device, shaders, count)
                                                   : judge_pair<OnLobe>(device, shaders, count);
}

void add_textured_cases(std::vector<ParityCase>& cases) {
    cases.push_back(case_of(TexturedTechnique::diffuse, Diffuse::kName));
    cases.push_back(case_of(TexturedTechnique::on_lobe, OnLobe::kName));
}

} // namespace nusselt::parity
