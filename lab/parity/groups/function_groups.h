#pragma once
/// Groups of functions below the techniques: each has a shader, draws inputs, and makes the calls of the shader in C++.

#include "lab/parity/function_parity.h"
#include "shaders/arithmetic.h"
#include "shaders/bsdf.h"
#include "shaders/clip.h"
#include "shaders/frame.h"
#include "shaders/line.h"
#include "shaders/phong.h"
#include "shaders/polygon.h"
#include "shaders/trig.h"

#include <nusselt/bsdf/frostbite.h>
#include <nusselt/bsdf/lambert.h>
#include <nusselt/bsdf/phong.h>
#include <nusselt/geometry/clip_line.h>
#include <nusselt/geometry/clip_polygon.h>
#include <nusselt/geometry/polygon_measures.h>

#include <cmath>

namespace nusselt::parity {

struct Arithmetic {
    static constexpr const char* kName = "arithmetic";
    static constexpr Shader kShader{"arithmetic", shaders::kArithmetic};
    static constexpr std::size_t kInputs = 11;
    static constexpr Output kOutputs[] = {{"difference_of_products", Error::relative},
                                          {"two_product_error", Error::relative},
                                          {"exact_fma, x", Error::relative},
                                          {"exact_fma, y", Error::relative},
                                          {"exact_fma, z", Error::relative},
                                          {"inverse_length", Error::relative},
                                          {"nusselt_length", Error::relative},
                                          {"nusselt_normalize, x", Error::absolute},
                                          {"nusselt_normalize, y", Error::absolute},
                                          {"nusselt_normalize, z", Error::absolute},
                                          {"reciprocal_power_of_two", Error::relative},
                                          {"atan_up_to_one", Error::relative}};

    static void draw(RandomSource& random, std::vector<float>& inputs) {
        const auto number = [&] {
            return static_cast<float>((random.index(2) == 0 ? -1 : 1) * random.log_between(1e-5, 1));
        };
        const float a = number(), b = number();
        // Half of the differences cancel up to roundings, some of them entirely.
        float c = number(), d = number();
        if (random.index(2) == 0) {
            c = b;
            d = is_degenerate(random) ? a : a * static_cast<float>(random.between(0.999999, 1.000001));
        }
        Vec3<double> moderate = random.log_between(1e-25, 1) * random.direction();
        // Half of the sums of a product and a number cancel, too.
        if (random.index(2) == 0) moderate.x = -b / a < 1 ? -b / a : 1;
        // Components beyond rounding are normal numbers: devices may take others for 0.
        Vec3<double> any = random.log_between(1e-30, 1e36) * random.direction();
        if (is_degenerate(random)) moderate = random.index(2) == 0 ? axis(random) : Vec3<double>{0, 0, 0};
        if (is_degenerate(random)) any = random.index(2) == 0 ? axis(random) : Vec3<double>{0, 0, 0};
        for (const float x : {a, b, c, d}) inputs.push_back(x);
        put(inputs, moderate);
        put(inputs, any);
        inputs.push_back(is_degenerate(random) ? std::ldexp(1.0f, random.index(200) - 100)
                                               : static_cast<float>(random.log_between(1e-36, 1e36)));
    }
    template <class Real>
    static Results<Real> call(const float* inputs) {
        const Real a = inputs[0], b = inputs[1], c = inputs[2], d = inputs[3];
        const auto moderate = get<Real>(inputs + 4), any = get<Real>(inputs + 7);
        const float product = inputs[0] * inputs[1];
        Results<Real> results{difference_of_products(a, b, c, d), fma(a, b, Real(-product))};
        put(results, 2, fma(a, moderate, {b, c, d}));
        results[5] = inverse_length(moderate);
        results[6] = length(any);
        put(results, 7, normalize(any));
        results[10] = reciprocal_power_of_two(Real(inputs[10]));
        results[11] = atan_up_to_one(abs(a));
        return results;
    }
};

struct Trigonometry {
    static constexpr const char* kName = "trigonometry";
    static constexpr Shader kShader{"trig", shaders::kTrig};
    static constexpr std::size_t kInputs = 4;
    static constexpr Output kOutputs[] = {
        {"atan2_positive", Error::relative},           {"sine of a half turn", Error::absolute},
        {"cosine of a half turn", Error::absolute},    {"sine of a quarter turn", Error::relative},
        {"cosine of a quarter turn", Error::absolute}, {"angle_minus_sine", Error::relative},
        {"one_minus_atan_ratio", Error::relative}};

    static void draw(RandomSource& random, std::vector<float>& inputs) {
        // Half of the numbers are of order one, the others of any order down to 1e-6. Degenerate numbers are at the
        // ends of the range, or tiny.
        const auto number = [&](double largest) {
            if (is_degenerate(random)) {
                const double ends[] = {0, largest, largest / 2, 1e-30};
                return static_cast<float>(ends[random.index(4)]);
            }
            return static_cast<float>(random.index(2) == 0 ? random.between(0, largest)
                                                           : random.log_between(1e-6, largest));
        };
        inputs.push_back((random.index(2) == 0 ? -1.0f : 1.0f) * number(1));
        inputs.push_back(number(1));
        inputs.push_back(number(3.1415925));
        inputs.push_back(number(1));
    }
    template <class Real>
    static Results<Real> call(const float* inputs) {
        const Real angle = inputs[2];
        const auto half_turn = sincos_half_turn(angle);
        const auto quarter_turn = sincos_quarter_turn(Real(0.5) * angle);
        return {atan2_positive(Real(inputs[1]), Real(inputs[0])),
                half_turn.sin,
                half_turn.cos,
                quarter_turn.sin,
                quarter_turn.cos,
                angle_minus_sine(Real(inputs[3])),
                one_minus_atan_ratio(Real(inputs[3]))};
    }
};

struct Frames {
    static constexpr const char* kName = "frames";
    static constexpr Shader kShader{"frame", shaders::kFrame};
    static constexpr std::size_t kInputs = 6;
    static constexpr Output kOutputs[] = {
        {"t.x", Error::absolute},     {"t.y", Error::absolute},     {"t.z", Error::absolute},
        {"b.x", Error::absolute},     {"b.y", Error::absolute},     {"b.z", Error::absolute},
        {"local.x", Error::absolute}, {"local.y", Error::absolute}, {"local.z", Error::absolute},
        {"world.x", Error::absolute}, {"world.y", Error::absolute}, {"world.z", Error::absolute}};

    static void draw(RandomSource& random, std::vector<float>& inputs) {
        Vec3<double> normal = random.direction();
        // Half of the normals are close to the poles, where the frame turns quickly.
        if (random.index(2) == 0) {
            normal.x *= random.log_between(1e-6, 1);
            normal.y *= random.log_between(1e-6, 1);
        }
        put(inputs, is_degenerate(random) ? axis(random) : normalize(normal));
        put(inputs, random.direction());
    }
    template <class Real>
    static Results<Real> call(const float* inputs) {
        const auto frame = Frame<Real>::from_normal(get<Real>(inputs));
        const auto v = get<Real>(inputs + 3);
        Results<Real> results{};
        put(results, 0, frame.t);
        put(results, 3, frame.b);
        put(results, 6, frame.to_local(v));
        put(results, 9, frame.to_world(v));
        return results;
    }
};

struct Brdfs {
    static constexpr const char* kName = "BRDFs";
    static constexpr Shader kShader{"bsdf", shaders::kBsdf};
    static constexpr std::size_t kInputs = 13;
    static constexpr Output kOutputs[] = {
        {"Frostbite, red", Error::relative},  {"Frostbite, green", Error::relative},
        {"Frostbite, blue", Error::relative}, {"diffuse, red", Error::relative},
        {"diffuse, green", Error::relative},  {"diffuse, blue", Error::relative},
        {"specular, red", Error::relative},   {"specular, green", Error::relative},
        {"specular, blue", Error::relative},  {"Lambert, red", Error::relative},
        {"Lambert, green", Error::relative},  {"Lambert, blue", Error::relative}};

    static void draw(RandomSource& random, std::vector<float>& inputs) {
        const Vec3<double> wo = is_degenerate(random) ? axis(random) : random.direction();
        put(inputs, {wo.x, wo.y, std::fabs(wo.z)});
        Vec3<double> wi = random.direction();
        // Some directions are below the horizon, others close to the mirror direction.
        const int kind = random.index(4);
        if (kind > 0) wi.z = std::fabs(wi.z);
        if (kind > 1)
            wi = normalize(Vec3<double>{-wo.x, -wo.y, std::fabs(wo.z)} + random.log_between(1e-3, 1) * wi);
        put(inputs, is_degenerate(random) ? axis(random) : wi);
        for (int i = 0; i < 6; ++i) inputs.push_back(static_cast<float>(random.uniform()));
        inputs.push_back(static_cast<float>(random.index(8) == 0 ? 0 : random.uniform()));
    }
    template <class Real>
    static Results<Real> call(const float* inputs) {
        const auto wi = get<Real>(inputs + 3);
        const auto albedo = get<Real>(inputs + 6);
        const Frostbite<Real> brdf(get<Real>(inputs), albedo, get<Real>(inputs + 9), inputs[12]);
        Results<Real> results{};
        put(results, 0, brdf.eval(wi));
        put(results, 3, brdf.eval_diffuse(wi));
        put(results, 6, brdf.eval_specular(wi));
        put(results, 9, Lambert<Real>{albedo}.eval(wi));
        return results;
    }
};

struct PhongLobes {
    static constexpr const char* kName = "Phong lobes";
    static constexpr Shader kShader{"phong", shaders::kPhong};
    static constexpr std::size_t kInputs = 11;
    static constexpr Output kOutputs[] = {{"red", Error::relative},
                                          {"green", Error::relative},
                                          {"blue", Error::relative},
                                          {"alpha", Error::relative},
                                          {"logarithm of the cosine", Error::relative},
                                          {"cosine", Error::relative}};

    static void draw(RandomSource& random, std::vector<float>& inputs) {
        const Vec3<double> wo = is_degenerate(random) ? axis(random) : random.direction();
        put(inputs, {wo.x, wo.y, std::fabs(wo.z)});
        const double exponent = random.index(8) == 0 ? 0 : random.log_between(1, 1e6);
        // Most directions are in the lobe, where the power is not next to 0.
        Vec3<double> wi = random.direction();
        if (random.index(8) > 0) {
            const double width = 3 / std::sqrt(exponent + 1);
            wi = normalize(Vec3<double>{-wo.x, -wo.y, std::fabs(wo.z)} + width * random.uniform() * wi);
        }
        put(inputs, is_degenerate(random) ? axis(random) : wi);
        for (int i = 0; i < 3; ++i) inputs.push_back(static_cast<float>(random.uniform()));
        inputs.push_back(static_cast<float>(exponent));
        inputs.push_back(static_cast<float>(random.log_between(1e-4, 1.57)));
    }
    template <class Real>
    static Results<Real> call(const float* inputs) {
        const Real exponent = inputs[9];
        const Phong<Real> phong(get<Real>(inputs), get<Real>(inputs + 6), exponent);
        const Real logarithm = negative_log_of_cosine(sincos_quarter_turn(Real(inputs[10])));
        Results<Real> results{};
        put(results, 0, phong.eval(get<Real>(inputs + 3)));
        results[3] = phong_alpha(exponent);
        results[4] = logarithm;
        results[5] = exp_of_negative(logarithm);
        return results;
    }
    /// Far from the mirrored direction, single precision has no power left.
    static bool is_defined(std::size_t output, const Results<long double>& exact) {
        return output >= 3 || exact[output] == 0 || exact[output] > 1e-30L;
    }
};

/// Draws a point and a normal around lights whose coordinates are of order one. The point may be a corner of the
/// light, or close to it.
inline void draw_surface(RandomSource& random, const Vec3<double>& corner, std::vector<float>& inputs) {
    if (is_degenerate(random)) {
        put(inputs, corner + (random.index(2) == 0 ? 0 : 1e-6) * random.direction());
        put(inputs, axis(random));
        return;
    }
    if (is_degenerate(random)) { // the corner is on the horizon
        const Vec3<double> normal = axis(random);
        const Vec3<double> away = random.direction();
        put(inputs, corner + (away - dot(normal, away) * normal));
        put(inputs, normal);
        return;
    }
    put(inputs, random.between(0.1, 2) * random.direction());
    put(inputs, random.direction());
}

struct Polygons {
    static constexpr const char* kName = "polygons";
    static constexpr Shader kShader{"polygon", shaders::kPolygon};
    static constexpr std::size_t kInputs = 18;
    static constexpr Output kOutputs[] = {{"area", Error::relative},
                                          {"solid angle", Error::measure},
                                          {"projected solid angle", Error::measure},
                                          {"vertex.x", Error::absolute},
                                          {"vertex.y", Error::absolute},
                                          {"vertex.z", Error::absolute},
                                          {"edge.x", Error::absolute},
                                          {"edge.y", Error::absolute},
                                          {"edge.z", Error::absolute},
                                          {"normal.x", Error::absolute},
                                          {"normal.y", Error::absolute},
                                          {"normal.z", Error::absolute}};

    static void draw(RandomSource& random, std::vector<float>& inputs) {
        const Parallelogram light(random);
        light.put_corners(inputs);
        draw_surface(random, light.corner, inputs);
    }
    template <class Real>
    static Results<Real> call(const float* inputs) {
        Vec3<Real> corners[4];
        for (int j = 0; j < 4; ++j) corners[j] = get<Real>(inputs + 3 * j);
        const auto frame = Frame<Real>::from_normal(get<Real>(inputs + 15));
        const auto light = to_shading_space(make_polygon<4>(corners, 4), get<Real>(inputs + 12), frame);
        Results<Real> results{area(light), solid_angle(light), projected_solid_angle(light)};
        put(results, 3, light.vertex[2]);
        put(results, 6, light.edge[1]);
        put(results, 9, light.normal);
        return results;
    }
};

struct Clipping {
    static constexpr const char* kName = "clipping";
    static constexpr Shader kShader{"clip", shaders::kClip};
    static constexpr std::size_t kInputs = 13;
    static constexpr Output kOutputs[] = {
        {"vertex.x", Error::absolute}, {"vertex.y", Error::absolute}, {"vertex.z", Error::absolute},
        {"edge.x", Error::absolute},   {"edge.y", Error::absolute},   {"edge.z", Error::absolute},
        {"normal.x", Error::absolute}, {"normal.y", Error::absolute}, {"normal.z", Error::absolute}};

    static void draw(RandomSource& random, std::vector<float>& inputs) {
        Parallelogram light(random);
        if (is_degenerate(random)) {
            light.corner.z = 0;
            if (random.index(2) == 0) light.a.z = 0;
            if (random.index(2) == 0) light.b.z = 0;
        }
        light.put_corners(inputs);
        inputs.push_back(static_cast<float>(random.index(5)));
    }
    template <class Real>
    static Results<Real> call(const float* inputs) {
        Vec3<Real> corners[4];
        for (int j = 0; j < 4; ++j) corners[j] = get<Real>(inputs + 3 * j);
        const auto clipped = clip_to_horizon(make_polygon<4>(corners, 4));
        const int slot = static_cast<int>(inputs[12]);
        Results<Real> results{};
        put(results, 0, clipped.vertex[slot]);
        put(results, 3, clipped.edge[slot]);
        put(results, 6, clipped.normal);
        return results;
    }
};

struct Lines {
    static constexpr const char* kName = "lines";
    static constexpr Shader kShader{"line", shaders::kLine};
    static constexpr std::size_t kInputs = 12;
    static constexpr Output kOutputs[] = {{"length", Error::relative},
                                          {"solid angle", Error::measure},
                                          {"projected solid angle", Error::measure},
                                          {"begin.x", Error::absolute},
                                          {"begin.y", Error::absolute},
                                          {"begin.z", Error::absolute},
                                          {"along.x", Error::absolute},
                                          {"along.y", Error::absolute},
                                          {"along.z", Error::absolute}};

    static void draw(RandomSource& random, std::vector<float>& inputs) {
        const Vec3<double> begin = random.direction();
        put(inputs, begin);
        put(inputs, is_degenerate(random) ? begin : random.direction());
        draw_surface(random, begin, inputs);
    }
    template <class Real>
    static Results<Real> call(const float* inputs) {
        const auto frame = Frame<Real>::from_normal(get<Real>(inputs + 9));
        const auto light = to_shading_space(make_line(get<Real>(inputs), get<Real>(inputs + 3)),
                                            get<Real>(inputs + 6), frame);
        Results<Real> results{light.length, solid_angle(light), projected_solid_angle(light)};
        put(results, 3, light.p0);
        put(results, 6, light.s);
        return results;
    }
};

} // namespace nusselt::parity
