#pragma once
/// Groups of code that turns samples into estimates of direct light: heuristics, visible normals, and whole estimates.

#include "lab/parity/function_parity.h"
#include "lab/parity/table_words.h"
#include "render/settings.h"
#include "shaders/brdf_direct_light.h"
#include "shaders/line_direct_light.h"
#include "shaders/mis.h"
#include "shaders/polygon_brdf.h"
#include "shaders/polygon_direct_light.h"
#include "shaders/visible_normals.h"

#include <nusselt/estimate/direct_light.h>

namespace nusselt::parity {

using render::Mis;

template <class Real, class Estimate>
auto with_heuristic(Mis mis, const Real& visibility, const Estimate& estimate) {
    switch (mis) {
    case Mis::balance:
        return estimate(BalanceHeuristic());
    case Mis::power:
        return estimate(PowerHeuristic());
    case Mis::weighted_balance:
        return estimate(WeightedBalanceHeuristic());
    case Mis::optimal:
        return estimate(OptimalHeuristic<Real>{visibility});
    case Mis::separate:
        return estimate(SeparateComponents());
    case Mis::clamped_optimal:
    case Mis::one_sample:
        break;
    }
    return estimate(ClampedOptimalHeuristic<Real>{visibility});
}

/// Draws a heuristic that combines two samples.
inline Mis draw_heuristic(RandomSource& random) {
    const Mis heuristics[] = {Mis::balance,         Mis::power,   Mis::weighted_balance,
                              Mis::clamped_optimal, Mis::optimal, Mis::separate};
    return heuristics[random.index(6)];
}

inline Mis heuristic_of(float input) { return static_cast<Mis>(static_cast<std::uint32_t>(input)); }

struct Heuristics {
    static constexpr const char* kName = "heuristics";
    static constexpr Shader kShader{"mis", shaders::kMis};
    static constexpr std::size_t kInputs = 20;
    static constexpr Output kOutputs[] = {{"shadowed, red", Error::relative},
                                          {"shadowed, green", Error::relative},
                                          {"shadowed, blue", Error::relative},
                                          {"constant, red", Error::absolute},
                                          {"constant, green", Error::absolute},
                                          {"constant, blue", Error::absolute},
                                          {"probability of diffuse", Error::relative},
                                          {"probability of specular", Error::relative},
                                          {"decision", Error::absolute},
                                          {"one sample, red", Error::relative},
                                          {"one sample, green", Error::relative},
                                          {"one sample, blue", Error::relative}};

    static void draw(RandomSource& random, std::vector<float>& inputs) {
        const auto number = [&](double low, double high) {
            inputs.push_back(is_degenerate(random) ? 0 : static_cast<float>(random.log_between(low, high)));
        };
        inputs.push_back(static_cast<float>(draw_heuristic(random)));
        inputs.push_back(static_cast<float>(random.index(2)));
        inputs.push_back(static_cast<float>(random.uniform()));
        for (int k = 0; k < 2; ++k) inputs.push_back(static_cast<float>(1 + random.index(8)));
        for (int k = 0; k < 6; ++k) number(1e-4, 1);   // coefficients
        for (int k = 0; k < 2; ++k) number(1e-6, 1e6); // densities
        for (int k = 0; k < 6; ++k) number(1e-6, 1e3); // components
        inputs.push_back(std::min(static_cast<float>(random.uniform()), 1 - 0x1p-24f));
    }
    template <class Real>
    static Results<Real> call(const float* inputs) {
        const MisTechniques<Real, 2> techniques{{inputs[3], inputs[4]},
                                                {get<Real>(inputs + 5), get<Real>(inputs + 8)}};
        const MisSample<Real, 2> sample{{inputs[11], inputs[12]},
                                        {get<Real>(inputs + 13), get<Real>(inputs + 16)}};
        const auto estimate =
            with_heuristic<Real>(heuristic_of(inputs[0]), inputs[2], [&](const auto& heuristic) {
                return inputs[1] == 0 ? heuristic.template estimate<0>(techniques, sample)
                                      : heuristic.template estimate<1>(techniques, sample);
            });
        const OneSampleChoice<Real, 2> choice(techniques);
        const auto decision = choice.decide(inputs[19]);
        Results<Real> results{};
        put(results, 0, estimate.shadowed);
        put(results, 3, estimate.constant);
        results[6] = choice.probability(0);
        results[7] = choice.probability(1);
        results[8] = (decision.chosen[1] ? Real(1) : Real(0)) + decision.u;
        put(results, 9, choice.estimate(sample).shadowed);
        return results;
    }
};

/// Draws wo and alpha, two random numbers, and a direction that is often in the lobe.
inline void draw_ggx_lobe(RandomSource& random, std::vector<float>& inputs) {
    Vec3<double> wo = is_degenerate(random) ? axis(random) : random.direction();
    if (random.index(16) > 0) wo.z = std::fabs(wo.z);
    const double alpha = is_degenerate(random) ? 1e-4 : random.log_between(1e-3, 1);
    put(inputs, wo);
    inputs.push_back(static_cast<float>(alpha));
    for (int i = 0; i < 2; ++i)
        inputs.push_back(std::min(static_cast<float>(random.uniform()), 1 - 0x1p-24f));
    Vec3<double> wi = random.direction();
    if (random.index(4) > 0)
        wi = normalize(Vec3<double>{-wo.x, -wo.y, wo.z} + alpha * random.log_between(1e-2, 10) * wi);
    put(inputs, wi);
}

struct VisibleNormals {
    static constexpr const char* kName = "visible normals";
    static constexpr Shader kShader{"visible_normals", shaders::kVisibleNormals};
    static constexpr std::size_t kInputs = 9;
    static constexpr Output kOutputs[] = {{"sample.x", Error::absolute},
                                          {"sample.y", Error::absolute},
                                          {"sample.z", Error::absolute},
                                          {"density", Error::relative},
                                          {"first inverse", Error::absolute},
                                          {"second inverse", Error::absolute},
                                          {"bounded sample.x", Error::absolute},
                                          {"bounded sample.y", Error::absolute},
                                          {"bounded sample.z", Error::absolute},
                                          {"bounded density", Error::measure},
                                          {"bounded first inverse", Error::absolute},
                                          {"bounded second inverse", Error::absolute}};

    static void draw(RandomSource& random, std::vector<float>& inputs) { draw_ggx_lobe(random, inputs); }
    template <class Real>
    static Results<Real> call(const float* inputs) {
        const auto wo = get<Real>(inputs);
        const auto wi = get<Real>(inputs + 6);
        const Vec2<Real> u{inputs[4], inputs[5]};
        Results<Real> results{};
        const auto evaluate = [&](std::size_t at, const auto& normals) {
            put(results, at, normals.sample(u));
            results[at + 3] = normals.pdf(wi);
            const auto inverse = normals.invert(wi);
            results[at + 4] = abs(inverse.x - Real(0.5));
            results[at + 5] = inverse.y;
        };
        evaluate(0, GgxVisibleNormals<Real>(wo, inputs[3]));
        evaluate(6, GgxBoundedVisibleNormals<Real>(wo, inputs[3]));
        return results;
    }
};

struct PolygonBrdfSampling {
    static constexpr const char* kName = "sampling of the BRDF";
    static constexpr Shader kShader{"polygon_brdf", shaders::kPolygonBrdf};
    static constexpr std::size_t kInputs = 21;
    static constexpr Output kOutputs[] = {
        {"wi.x", Error::absolute}, {"wi.y", Error::absolute},
        {"wi.z", Error::absolute}, {"density of the sample", Error::measure},
        {"p.x", Error::absolute},  {"p.y", Error::absolute},
        {"p.z", Error::absolute},  {"density", Error::relative}};

    static void draw(RandomSource& random, std::vector<float>& inputs) {
        Parallelogram(random).put_corners(inputs);
        draw_ggx_lobe(random, inputs);
    }
    template <class Real>
    static Results<Real> call(const float* inputs) {
        Vec3<Real> corners[4];
        for (int j = 0; j < 4; ++j) corners[j] = get<Real>(inputs + 3 * j);
        const GgxVisibleNormals<Real> lobe(get<Real>(inputs + 12), inputs[15]);
        const PolygonBrdf<Real, 4, GgxVisibleNormals<Real>> technique(make_polygon<4>(corners, 4), lobe);
        const auto s = technique.sample({inputs[16], inputs[17]});
        Results<Real> results{};
        put(results, 0, s.wi);
        results[3] = s.pdf;
        if (s.pdf > 0) put(results, 4, s.p);
        results[7] = technique.pdf(get<Real>(inputs + 18));
        return results;
    }
};

/// Draws a surface near lights whose coordinates are of order one.
inline void draw_surface(RandomSource& random, std::vector<float>& inputs) {
    const Vec3<double> normal = is_degenerate(random) ? axis(random) : random.direction();
    put(inputs, random.between(0.1, 2) * random.direction());
    put(inputs, normal);
    const Vec3<double> v = random.direction();
    put(inputs, is_degenerate(random) ? normal : dot(normal, v) < 0 ? -1.0 * v : v);
    for (int i = 0; i < 6; ++i) // albedo and f0
        inputs.push_back(is_degenerate(random) ? 0 : static_cast<float>(random.uniform()));
    inputs.push_back(static_cast<float>(random.uniform()));
}

/// The layout is that of shaders/parity/surface_input.glsl.
inline constexpr std::size_t kSurfaceSize = 16;

template <class Real>
SurfacePoint<Real> get_surface(const float* inputs) {
    return {get<Real>(inputs),     get<Real>(inputs + 3),  get<Real>(inputs + 6),
            get<Real>(inputs + 9), get<Real>(inputs + 12), inputs[15]};
}

/// Selects an estimate of a light.
struct Choice {
    Mis mis;
    float visibility;
    int drawn; ///< technique of the sample
    Vec2<float> u[2];

    static constexpr std::size_t kSize = 7;
    static Choice get(const float* inputs) {
        return {heuristic_of(inputs[0]),
                inputs[1],
                static_cast<int>(inputs[2]),
                {{inputs[3], inputs[4]}, {inputs[5], inputs[6]}}};
    }
    static void draw(RandomSource& random, Mis mis, std::vector<float>& inputs) {
        inputs.push_back(static_cast<float>(mis));
        inputs.push_back(static_cast<float>(random.uniform()));
        inputs.push_back(static_cast<float>(random.index(2)));
        for (int i = 0; i < 4; ++i)
            inputs.push_back(std::min(static_cast<float>(random.uniform()), 1 - 0x1p-24f));
    }
    template <class Real>
    Vec2<Real> random(int i) const {
        return {u[i].x, u[i].y};
    }
};

/// The results of a sample, for groups to inherit.
struct SampleOutputs {
    static constexpr Output kOutputs[] = {
        {"direction.x", Error::absolute},     {"direction.y", Error::absolute},
        {"direction.z", Error::absolute},     {"distance", Error::measure},
        {"shadowed, red", Error::measure},    {"shadowed, green", Error::measure},
        {"shadowed, blue", Error::measure},   {"constant, red", Error::absolute},
        {"constant, green", Error::absolute}, {"constant, blue", Error::absolute}};

    /// A light without area may have a measure by rounding alone, and then reflects next to nothing. Nobody can tell whether it
    /// has a sample, and where.
    static bool is_defined(std::size_t output, const Results<long double>& exact) {
        return output >= 4 || std::max({exact[4], exact[5], exact[6]}) > proof::kSmallestMeasure;
    }
};

template <class Real>
Results<Real> results_of(const WorldLightSample<Real>& s) {
    Results<Real> results{};
    if (s.shadowed.x != 0 || s.shadowed.y != 0 || s.shadowed.z != 0) {
        put(results, 0, s.direction);
        results[3] = s.distance;
    }
    put(results, 4, s.shadowed);
    put(results, 7, s.constant);
    return results;
}

/// One sample of a light in world space, for any pair of techniques.
template <class Strategies, class Real, class Light>
Results<Real> sample_pair(const SurfacePoint<Real>& point, const Light& light, const Choice& choice) {
    const auto frame = shading_frame(point.normal, point.wo);
    const auto surface = make_glossy_surface(dot(point.normal, point.wo), point.albedo, point.f0,
                                             point.roughness, tables::frostbite_ltc_table().view());
    const auto local = to_shading_space(light, point.position, frame);
    const DirectLight<Real, std::remove_const_t<decltype(local)>, Frostbite<Real>, Strategies> estimator(
        local, surface);
    const auto to_world = [&](const DirectLightSample<Real>& s) {
        return results_of<Real>({frame.to_world(s.wi), length(s.p), s.shadowed, s.constant});
    };
    if (choice.mis == Mis::one_sample) return to_world(estimator.sample_one(choice.random<Real>(0)));
    return with_heuristic<Real>(choice.mis, choice.visibility, [&](const auto& heuristic) {
        return to_world(choice.drawn == 0 ? estimator.sample_diffuse(heuristic, choice.random<Real>(0))
                                          : estimator.sample_specular(heuristic, choice.random<Real>(1)));
    });
}

/// The same sample from a single call of sample_direct_light.
template <class Real, class Light>
Results<Real> sample_light(const SurfacePoint<Real>& point, const Light& light, const Choice& choice) {
    if (choice.mis == Mis::one_sample) return sample_pair<ProjectedSolidAngleAndLtc>(point, light, choice);
    return with_heuristic<Real>(choice.mis, choice.visibility, [&](const auto& heuristic) {
        const Vec2<Real> u[2] = {choice.random<Real>(0), choice.random<Real>(1)};
        const auto samples =
            sample_direct_light(point, light, tables::frostbite_ltc_table().view(), heuristic, u);
        return results_of(samples.sample[choice.drawn]);
    });
}

inline Mis draw_estimate(RandomSource& random) {
    return random.index(7) == 0 ? Mis::one_sample : draw_heuristic(random);
}

struct PolygonDirectLight : SampleOutputs {
    static constexpr const char* kName = "estimates for polygons";
    static constexpr Shader kShader{"polygon_direct_light", shaders::kPolygonDirectLight};
    static constexpr std::size_t kInputs = 12 + kSurfaceSize + Choice::kSize;

    static void draw(RandomSource& random, std::vector<float>& inputs) {
        Parallelogram(random).put_corners(inputs);
        draw_surface(random, inputs);
        Choice::draw(random, draw_estimate(random), inputs);
    }
    template <class Real>
    static ConvexPolygon<Real, 4> light(const float* inputs) {
        Vec3<Real> corners[4];
        for (int j = 0; j < 4; ++j) corners[j] = get<Real>(inputs + 3 * j);
        return make_polygon<4>(corners, 4);
    }
    template <class Real>
    static Results<Real> call(const float* inputs) {
        return sample_light(get_surface<Real>(inputs + 12), light<Real>(inputs),
                            Choice::get(inputs + 12 + kSurfaceSize));
    }
};

struct LineDirectLight : SampleOutputs {
    static constexpr const char* kName = "estimates for lines";
    static constexpr Shader kShader{"line_direct_light", shaders::kLineDirectLight};
    static constexpr std::size_t kInputs = 6 + kSurfaceSize + Choice::kSize;

    static void draw(RandomSource& random, std::vector<float>& inputs) {
        const Vec3<double> begin = random.direction();
        put(inputs, begin);
        put(inputs, is_degenerate(random) ? begin : random.direction());
        draw_surface(random, inputs);
        Choice::draw(random, draw_estimate(random), inputs);
    }
    template <class Real>
    static Results<Real> call(const float* inputs) {
        return sample_light(get_surface<Real>(inputs + 6),
                            make_line(get<Real>(inputs), get<Real>(inputs + 3)),
                            Choice::get(inputs + 6 + kSurfaceSize));
    }
};

/// A pair of techniques whose densities the test sets and whose samples may miss the light.
struct BrdfDirectLight : SampleOutputs {
    static constexpr const char* kName = "estimates for other pairs";
    static constexpr Shader kShader{"brdf_direct_light", shaders::kBrdfDirectLight};
    static constexpr std::size_t kInputs = PolygonDirectLight::kInputs;

    static void draw(RandomSource& random, std::vector<float>& inputs) {
        Parallelogram(random).put_corners(inputs);
        draw_surface(random, inputs);
        Choice::draw(random, draw_heuristic(random), inputs);
    }
    template <class Real>
    static Results<Real> call(const float* inputs) {
        return sample_pair<SolidAngleAndBrdf<GgxBoundedVisibleNormals>>(
            get_surface<Real>(inputs + 12), PolygonDirectLight::light<Real>(inputs),
            Choice::get(inputs + 12 + kSurfaceSize));
    }
};

} // namespace nusselt::parity
