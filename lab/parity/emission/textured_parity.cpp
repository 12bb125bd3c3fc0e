#include "lab/parity/emission/textured_parity.h"

#include "lab/accuracy/lobe_lights.h"
#include "lab/parity/emission/emission_parity.h"
#include "lab/parity/emission/textured_lights.h"

namespace nusselt::parity {

namespace {

using hostile::RandomSource;
using proof::Exact;

/// The projected solid angle of each cell has a rounding error of up to 1e-7. Of lights that are dimmer than this,
/// nothing else may remain, as where a lobe hardly reaches them.
constexpr Exact kSmallestWeight = 3e-5L;

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
std::vector<EmissionOutputs> run(ShaderRunner& runner, const std::vector<Scene>& scenes) {
    std::vector<float> inputs;
    for (const Scene& scene : scenes) {
        for (const Vec3<float>& v :
             {scene.plane.corner, scene.plane.side_x, scene.plane.side_y, scene.plane.normal})
            inputs.insert(inputs.end(), {v.x, v.y, v.z});
        inputs.insert(inputs.end(), {static_cast<float>(scene.light->first_word()), scene.u.x, scene.u.y});
        if (Pair::kHasLobe) append_lobe(scene.lobe, inputs);
    }
    return run_emission(runner, inputs);
}

/// The way is the direction; the place is the distance of the point from the one with the texture coordinates.
template <class Real, class Technique>
EmissionOutputs sample_in_cpp(const Technique& technique, const TexturePlane<Real>& plane,
                              const Vec2<float>& u) {
    const auto s = technique.sample(broadcast<Real>(u));
    return outputs_of(technique, s, s.wi, length(s.p - plane.point_at(s.at)));
}

/// Judges one light.
template <class Pair>
void judge_scene(const Class& of, const Scene& scene, const std::vector<EmissionOutputs>& device_outputs,
                 MethodErrors& errors) {
    const auto single = Pair::prepare(scene.plane, scene.light->in_float(), scene.lobe);
    const EmissionOutputs of_cpp = sample_in_cpp(single, scene.plane, scene.u);
    if (of.place == Place::hostile) {
        // Rounding decides what they are, but they keep the contract.
        for (std::size_t k = 0; k < device_outputs.size(); ++k)
            errors.device[k].invalid += !is_valid(device_outputs[k]);
        return;
    }
    const auto plane =
        make_texture_plane(broadcast<Exact>(scene.plane.corner), broadcast<Exact>(scene.plane.side_x),
                           broadcast<Exact>(scene.plane.side_y));
    const auto exact = Pair::prepare(plane, scene.light->exact(), scene.lobe);
    const ExactTotals totals = totals_of(exact);
    if (totals.measure > 0 && totals.measure < kSmallestWeight) return;
    const auto way_of = [&](const EmissionOutputs& out) -> ExactWay {
        return {normalize(plane.point_at(broadcast<Exact>(out.at))), broadcast<Exact>(out.way),
                out.place / std::max(length(plane.side_x), length(plane.side_y))};
    };
    for (std::size_t k = 0; k < device_outputs.size(); ++k)
        judge_outputs(exact, totals, scene.u, device_outputs[k], way_of, errors.device[k]);
    judge_outputs(exact, totals, scene.u, of_cpp, way_of, errors.cpp);
    if (totals.measure > 0)
        judge_outputs(exact, totals, scene.u, sample_in_cpp(exact, plane, scene.u), way_of, errors.floor);
}

template <class Pair>
std::vector<Verdict> judge_pair(const ShaderPlatform& platform, const std::vector<VariantShader>& shaders,
                                int count) {
    const TexturedTestLights lights;
    return judge_classes(
        platform, kClasses, count, shaders, Pair::kHasLobe ? 21 : 15, lights.words(),
        [&](const Class& of, int number) { return draw_scene(lights, of, number); },
        [](ShaderRunner& runner, const Class&, const std::vector<Scene>& scenes) {
            return run<Pair>(runner, scenes);
        },
        judge_scene<Pair>);
}

} // namespace

std::vector<Verdict> judge_textured(const ShaderPlatform& platform, TexturedTechnique technique,
                                    const std::vector<VariantShader>& shaders, int count) {
    return technique == TexturedTechnique::diffuse ? judge_pair<Diffuse>(platform, shaders, count)
                                                   : judge_pair<OnLobe>(platform, shaders, count);
}

void add_textured_cases(std::vector<ParityCase>& cases) {
    cases.push_back(emission_case(Diffuse::kName, 8, judge_pair<Diffuse>));
    cases.push_back(emission_case(OnLobe::kName, 8, judge_pair<OnLobe>));
}

} // namespace nusselt::parity
