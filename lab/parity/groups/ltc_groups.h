#pragma once
/// Groups of functions on linearly transformed cosines below the techniques.

#include "lab/accuracy/lobe_lights.h"
#include "lab/parity/function_parity.h"
#include "lab/parity/table_words.h"
#include "shaders/engine_table.h"
#include "shaders/line_shading.h"
#include "shaders/lobe.h"
#include "shaders/ltc_table.h"
#include "shaders/polygon_shading.h"
#include "shaders/shading_frame.h"
#include "tables/engine_table.h"

#include <nusselt/ltc/line_shading.h>
#include <nusselt/ltc/polygon_shading.h>

namespace nusselt::parity {

/// Draws a lobe from the shipped table, or a hostile one.
inline void draw_table_lobe(RandomSource& random, std::vector<float>& inputs) {
    LtcCoefficients<float> c{};
    if (is_degenerate(random))
        c = hostile::HostileLights<float>(1, static_cast<std::uint64_t>(random.uniform() * 0x1p53)).lobe();
    else
        c = lab::lobe_of_table([&] { return random.uniform(); });
    for (const float x : {c.m00, c.m02, c.m11, c.m20, c.m22, c.albedo}) inputs.push_back(x);
}

template <class Real>
Ltc<Real> get_lobe(const float* inputs) {
    return Ltc<Real>({inputs[0], inputs[1], inputs[2], inputs[3], inputs[4], inputs[5]});
}

/// The layout is that of shaders/parity/lobe_input.glsl.
inline constexpr std::size_t kLobeSize = 6;

struct ShadingFrames {
    static constexpr const char* kName = "shading frames";
    static constexpr Shader kShader{"shading_frame", shaders::kShadingFrame};
    static constexpr std::size_t kInputs = 6;
    static constexpr Output kOutputs[] = {
        {"t.x", Error::absolute}, {"t.y", Error::absolute}, {"t.z", Error::absolute},
        {"b.x", Error::absolute}, {"b.y", Error::absolute}, {"b.z", Error::absolute},
        {"n.x", Error::absolute}, {"n.y", Error::absolute}, {"n.z", Error::absolute}};

    static void draw(RandomSource& random, std::vector<float>& inputs) {
        const Vec3<double> normal = is_degenerate(random) ? axis(random) : random.direction();
        put(inputs, normal);
        // Parallel to the normal, or at an angle that float can resolve.
        const double angle = is_degenerate(random) ? 0 : random.log_between(1e-6, 1);
        put(inputs, (random.index(2) == 0 ? -1.0 : 1.0) * normalize(normal + angle * random.direction()));
    }
    template <class Real>
    static Results<Real> call(const float* inputs) {
        const auto frame = shading_frame(get<Real>(inputs), get<Real>(inputs + 3));
        Results<Real> results{};
        put(results, 0, frame.t);
        put(results, 3, frame.b);
        put(results, 6, frame.n);
        return results;
    }
};

struct Lobes {
    static constexpr const char* kName = "lobes";
    static constexpr Shader kShader{"lobe", shaders::kLobe};
    static constexpr std::size_t kInputs = kLobeSize + 3;
    static constexpr Output kOutputs[] = {{"to_cosine, x", Error::relative},
                                          {"to_cosine, y", Error::relative},
                                          {"to_cosine, z", Error::relative},
                                          {"to_shading, x", Error::relative},
                                          {"to_shading, y", Error::relative},
                                          {"to_shading, z", Error::relative},
                                          {"normal_to_cosine, x", Error::relative},
                                          {"normal_to_cosine, y", Error::relative},
                                          {"normal_to_cosine, z", Error::relative},
                                          {"minor", Error::relative},
                                          {"density", Error::relative},
                                          {"radius_ratio", Error::relative}};

    static void draw(RandomSource& random, std::vector<float>& inputs) {
        draw_table_lobe(random, inputs);
        const Ltc<double> ltc = get_lobe<double>(&inputs[inputs.size() - kLobeSize]);
        // Half of the directions are around the peak of the lobe or on its horizon.
        Vec3<double> v = is_degenerate(random) ? axis(random) : random.direction();
        if (random.index(4) == 0) v = normalize(ltc.to_shading(v));
        if (random.index(4) == 0) v = normalize(ltc.to_shading({v.x, v.y, 0}));
        put(inputs, v);
    }
    template <class Real>
    static Results<Real> call(const float* inputs) {
        const auto ltc = get_lobe<Real>(inputs);
        const auto v = get<Real>(inputs + kLobeSize);
        Results<Real> results{};
        put(results, 0, ltc.to_cosine(v));
        put(results, 3, ltc.to_shading(v));
        put(results, 6, ltc.normal_to_cosine(v));
        results[9] = ltc.minor();
        results[10] = ltc.density(v);
        results[11] = radius_ratio(v, ltc);
        return results;
    }
};

struct PolygonShading {
    static constexpr const char* kName = "shading with polygons";
    static constexpr Shader kShader{"polygon_shading", shaders::kPolygonShading};
    static constexpr std::size_t kInputs = 12 + kLobeSize;
    static constexpr Output kOutputs[] = {
        {"diffuse_integral", Error::absolute},      {"lobe_integral", Error::absolute},
        {"clipped_lobe_integral", Error::absolute}, {"image, vertex.x", Error::absolute},
        {"image, vertex.y", Error::absolute},       {"image, vertex.z", Error::absolute},
        {"image, edge.x", Error::absolute},         {"image, edge.y", Error::absolute},
        {"image, edge.z", Error::absolute},         {"image, normal.x", Error::absolute},
        {"image, normal.y", Error::absolute},       {"image, normal.z", Error::absolute}};

    static void draw(RandomSource& random, std::vector<float>& inputs) {
        const Parallelogram light(random);
        light.put_corners(inputs);
        draw_table_lobe(random, inputs);
    }
    template <class Real>
    static Results<Real> call(const float* inputs) {
        Vec3<Real> corners[4];
        for (int j = 0; j < 4; ++j) corners[j] = get<Real>(inputs + 3 * j);
        const auto light = make_polygon<4>(corners, 4);
        const auto ltc = get_lobe<Real>(inputs + 12);
        const auto image = to_cosine_space(to_unit_extent(light).light, ltc);
        Results<Real> results{diffuse_integral(light), lobe_integral(light, ltc),
                              lobe_integral<BothHorizons>(light, ltc)};
        put(results, 3, image.vertex[2]);
        put(results, 6, image.edge[1]);
        put(results, 9, image.normal);
        return results;
    }
};

struct LineShading {
    static constexpr const char* kName = "shading with lines";
    static constexpr Shader kShader{"line_shading", shaders::kLineShading};
    static constexpr std::size_t kInputs = 10 + kLobeSize;
    static constexpr Output kOutputs[] = {{"diffuse_integral", Error::measure},
                                          {"lobe_integral", Error::measure},
                                          {"clipped_lobe_integral", Error::measure},
                                          {"tube_integral", Error::measure},
                                          {"tube_integral with clipped caps", Error::measure},
                                          {"caps_integral", Error::measure},
                                          {"strip_integral", Error::measure},
                                          {"diffuse_caps_integral", Error::measure},
                                          {"image, s.x", Error::absolute},
                                          {"image, s.y", Error::absolute},
                                          {"image, s.z", Error::absolute},
                                          {"image, length", Error::relative}};

    static void draw(RandomSource& random, std::vector<float>& inputs) {
        const Vec3<double> begin = random.direction();
        put(inputs, begin);
        put(inputs, is_degenerate(random) ? begin : 2.0 * random.direction());
        draw_table_lobe(random, inputs);
        put(inputs, random.direction());
        inputs.push_back(static_cast<float>(random.log_between(1e-4, 1)));
    }
    template <class Real>
    static Results<Real> call(const float* inputs) {
        const auto light = make_line(get<Real>(inputs), get<Real>(inputs + 3));
        const auto ltc = get_lobe<Real>(inputs + 6);
        const float* rest = inputs + 6 + kLobeSize;
        const Real radius = rest[3];
        const Real integral = lobe_integral(light, ltc);
        const Real caps = caps_integral(light, radius, [&](const Vec3<Real>& wi) { return ltc.density(wi); });
        const Real zero(0);
        const auto above = [&](const Vec3<Real>& wi) { return wi.z > zero ? ltc.density(wi) : zero; };
        const auto cosine = [&](const Vec3<Real>& wi) { return max(wi.z, zero) / kPi<Real>; };
        const auto image = to_cosine_space(to_unit_extent(light).light, ltc);
        Results<Real> results{diffuse_integral(light),
                              integral,
                              lobe_integral<BothHorizons>(light, ltc),
                              tube_integral(integral, radius),
                              tube_integral(integral, radius, caps_integral(light, radius, above)),
                              caps,
                              strip_integral(light, get<Real>(rest), radius, integral),
                              caps_integral(light, radius, cosine)};
        put(results, 8, image.s);
        results[11] = image.length;
        return results;
    }
};

/// Draws a coordinate of a table, sometimes exactly that of a sample.
inline float coordinate(RandomSource& random, int samples) {
    if (is_degenerate(random))
        return static_cast<float>(random.index(samples)) / static_cast<float>(samples - 1);
    return static_cast<float>(random.uniform());
}

/// Results for a lobe from a table. The entries m20 and m22 may differ by as little as the width of the lobe, so this
/// compares m20 relative to that width.
template <class Real>
Results<Real> results_of(const LtcCoefficients<Real>& lobe) {
    const Real width = lobe.m22 - lobe.m20;
    return {lobe.m00, lobe.m02, Real(1) / lobe.m11, lobe.m20 / width, width, lobe.albedo};
}

/// The table with 16-bit numbers, which the device decodes.
struct Table {
    static constexpr const char* kName = "table of 16 bits";
    static constexpr Shader kShader{"ltc_table", shaders::kLtcTable};
    static constexpr std::size_t kInputs = 6;
    static constexpr Output kOutputs[] = {{"m00", Error::absolute},
                                          {"m02", Error::absolute},
                                          {"1 / m11", Error::absolute},
                                          {"m20 over width", Error::absolute},
                                          {"width", Error::relative},
                                          {"albedo", Error::absolute},
                                          {"coloured albedo, red", Error::absolute},
                                          {"coloured albedo, green", Error::absolute},
                                          {"coloured albedo, blue", Error::absolute}};

    static void draw(RandomSource& random, std::vector<float>& inputs) {
        inputs.push_back(coordinate(random, 64));
        inputs.push_back(coordinate(random, 2));
        for (int i = 0; i < 4; ++i) inputs.push_back(coordinate(random, 51));
    }
    template <class Real>
    static Results<Real> call(const float* inputs) {
        const LtcTableView view = tables::frostbite_ltc_table().view();
        const Real roughness = inputs[0], cos_o = inputs[1], f0 = inputs[2];
        auto results = results_of(view.lookup(roughness, cos_o, f0));
        put(results, 6, view.albedo(roughness, cos_o, get<Real>(inputs + 3)));
        return results;
    }
};

inline std::string engine_bytes() { return tables::encode_for_engines(tables::frostbite_ltc_table(), 0.2f); }

inline const tables::LtcTable& engine_table() {
    static const tables::LtcTable table = tables::decode_for_engines(engine_bytes(), 64, 64, "");
    return table;
}

/// The table with half-precision floats.
struct EngineTable {
    static constexpr const char* kName = "table of half floats";
    static constexpr Shader kShader{"engine_table", shaders::kEngineTable};
    static constexpr std::size_t kInputs = 3;
    static constexpr Output kOutputs[] = {{"m00", Error::absolute},     {"m02", Error::absolute},
                                          {"1 / m11", Error::absolute}, {"m20 over width", Error::absolute},
                                          {"width", Error::relative},   {"albedo", Error::absolute}};

    static void draw(RandomSource& random, std::vector<float>& inputs) {
        inputs.push_back(coordinate(random, 64));
        inputs.push_back(coordinate(random, 2));
        inputs.push_back(coordinate(random, 51));
    }
    template <class Real>
    static Results<Real> call(const float* inputs) {
        const Real roughness = inputs[0], cos_o = inputs[1], f0 = inputs[2];
        return results_of(engine_table().view().lookup(roughness, cos_o, f0));
    }
};

} // namespace nusselt::parity
