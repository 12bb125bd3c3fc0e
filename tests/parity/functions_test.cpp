// Functions below the techniques: on the device, in C++ with float, and in C++ with long double.

#include "experiments/hostile/lights.h"
#include "gpu/fused_fma.h"
#include "gpu_test.h"
#include "parity_check.h"
#include "shader_runner.h"
#include "shaders/bsdf_fused.h"
#include "shaders/bsdf_split.h"
#include "shaders/frame_fused.h"
#include "shaders/frame_split.h"
#include "shaders/line_fused.h"
#include "shaders/line_split.h"
#include "shaders/polygon_fused.h"
#include "shaders/polygon_split.h"
#include "shaders/random.h"
#include "shaders/trig_fused.h"
#include "shaders/trig_split.h"

#include <nusselt/bsdf/frostbite.h>
#include <nusselt/bsdf/lambert.h>
#include <nusselt/geometry/clip_line.h>
#include <nusselt/geometry/polygon_measures.h>
#include <nusselt/random/pcg.h>
#include <nusselt/random/sobol.h>
#include <nusselt/random/unit_interval.h>

#include <fmt/core.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <iostream>

namespace nusselt::parity {

namespace {

using hostile::RandomSource;

constexpr std::size_t kCalls = 1'200'000;

/// Whether the next inputs shall be degenerate: more than 1e5 of the calls.
bool is_degenerate(RandomSource& random) { return random.index(8) == 0; }

Vec3<double> axis(RandomSource& random) {
    const Vec3<double> axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    return axes[random.index(6)];
}

/// How errors are measured: relative to the exact value, or as they are (of numbers of order one).
enum class Error { relative, absolute };

struct Output {
    const char* name;
    Error error;
};

template <class Real>
using Results = std::array<Real, kOutputSize>;

template <class Real>
void put(Results<Real>& results, std::size_t at, const Vec3<Real>& v) {
    results[at] = v.x;
    results[at + 1] = v.y;
    results[at + 2] = v.z;
}

template <class Real>
Vec3<Real> get(const float* inputs) {
    return {inputs[0], inputs[1], inputs[2]};
}

void put(std::vector<float>& inputs, const Vec3<double>& v) {
    for (const double x : {v.x, v.y, v.z}) inputs.push_back(static_cast<float>(x));
}

/// Each group of functions has a shader, draws inputs and makes the same calls in C++.
struct Trigonometry {
    static constexpr std::span<const std::uint32_t> kSplit = shaders::kTrigSplit;
    static constexpr std::span<const std::uint32_t> kFused = shaders::kTrigFused;
    static constexpr std::size_t kInputs = 4;
    static constexpr Output kOutputs[] = {
        {"atan2_positive", Error::relative},           {"sine of a half turn", Error::absolute},
        {"cosine of a half turn", Error::absolute},    {"sine of a quarter turn", Error::relative},
        {"cosine of a quarter turn", Error::absolute}, {"x_minus_sin", Error::relative},
        {"one_minus_atan_ratio", Error::relative}};

    static void draw(RandomSource& random, std::vector<float>& inputs) {
        // Half of the numbers are of order one, the others of any order down to 1e-6; at the ends of the ranges, or tiny.
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
                x_minus_sin(angle, half_turn.sin),
                one_minus_atan_ratio(Real(inputs[3]))};
    }
};

struct Frames {
    static constexpr std::span<const std::uint32_t> kSplit = shaders::kFrameSplit;
    static constexpr std::span<const std::uint32_t> kFused = shaders::kFrameFused;
    static constexpr std::size_t kInputs = 6;
    static constexpr Output kOutputs[] = {
        {"t.x", Error::absolute},     {"t.y", Error::absolute},     {"t.z", Error::absolute},
        {"b.x", Error::absolute},     {"b.y", Error::absolute},     {"b.z", Error::absolute},
        {"local.x", Error::absolute}, {"local.y", Error::absolute}, {"local.z", Error::absolute},
        {"world.x", Error::absolute}, {"world.y", Error::absolute}, {"world.z", Error::absolute}};

    static void draw(RandomSource& random, std::vector<float>& inputs) {
        Vec3<double> normal = random.direction();
        // Half of them close to the poles, where the frame turns quickly.
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
    static constexpr std::span<const std::uint32_t> kSplit = shaders::kBsdfSplit;
    static constexpr std::span<const std::uint32_t> kFused = shaders::kBsdfFused;
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
        // Some below the horizon, others close to the mirror direction.
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

/// A point and normal somewhere around lights of order one; the point may be a corner of the light, or next to it.
void draw_surface(RandomSource& random, const Vec3<double>& corner, std::vector<float>& inputs) {
    if (is_degenerate(random)) {
        put(inputs, corner + (random.index(2) == 0 ? 0 : 1e-6) * random.direction());
        put(inputs, axis(random));
        return;
    }
    put(inputs, random.between(0.1, 2) * random.direction());
    put(inputs, random.direction());
}

struct Polygons {
    static constexpr std::span<const std::uint32_t> kSplit = shaders::kPolygonSplit;
    static constexpr std::span<const std::uint32_t> kFused = shaders::kPolygonFused;
    static constexpr std::size_t kInputs = 18;
    static constexpr Output kOutputs[] = {{"area", Error::relative},
                                          {"solid angle", Error::relative},
                                          {"projected solid angle", Error::relative},
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
        // Multiples of 2^-10, so that the corners of a parallelogram are exactly in a plane.
        const auto rounded = [&] {
            const Vec3<double> v = random.direction();
            return 0x1p-10 *
                   Vec3<double>{std::round(0x1p10 * v.x), std::round(0x1p10 * v.y), std::round(0x1p10 * v.z)};
        };
        const Vec3<double> corner = rounded(), a = rounded(), b = rounded();
        for (const Vec3<double>& v : {corner, corner + a, corner + a + b, corner + b}) put(inputs, v);
        draw_surface(random, corner, inputs);
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

struct Lines {
    static constexpr std::span<const std::uint32_t> kSplit = shaders::kLineSplit;
    static constexpr std::span<const std::uint32_t> kFused = shaders::kLineFused;
    static constexpr std::size_t kInputs = 12;
    static constexpr Output kOutputs[] = {{"length", Error::relative},
                                          {"solid angle", Error::relative},
                                          {"projected solid angle", Error::relative},
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

double error(const Output& output, long double value, long double exact) {
    const long double off = std::fabs(value - exact);
    if (off == 0) return 0;
    return static_cast<double>(output.error == Error::absolute ? off : off / std::fabs(exact));
}

template <class Group>
class FunctionParity : public GpuTest {};
using Groups = testing::Types<Trigonometry, Frames, Brdfs, Polygons, Lines>;
TYPED_TEST_SUITE(FunctionParity, Groups);

TYPED_TEST(FunctionParity, IsAsAccurateAsCpp) {
    std::vector<float> inputs;
    for (std::size_t i = 0; i < kCalls; ++i) {
        RandomSource random(1, i);
        TypeParam::draw(random, inputs);
    }
    std::vector<std::span<const std::uint32_t>> variants{TypeParam::kSplit};
    if (gpu::has_fused_fma(this->device())) variants.emplace_back(TypeParam::kFused);
    for (const auto shader : variants) {
        const auto results = ShaderRunner(this->device(), shader, TypeParam::kInputs).run(inputs);
        constexpr std::size_t kCount = std::size(TypeParam::kOutputs);
        std::array<std::vector<double>, kCount> device, cpp, floor;
        for (std::size_t i = 0; i < kCalls; ++i) {
            const float* in = &inputs[TypeParam::kInputs * i];
            const auto exact = TypeParam::template call<long double>(in);
            const auto single = TypeParam::template call<float>(in);
            for (std::size_t k = 0; k < kCount; ++k) {
                const Output& output = TypeParam::kOutputs[k];
                ASSERT_TRUE(std::isfinite(results[i][k])) << output.name << " of call " << i;
                device[k].push_back(error(output, results[i][k], exact[k]));
                cpp[k].push_back(error(output, single[k], exact[k]));
                floor[k].push_back(error(output, static_cast<float>(exact[k]), exact[k]));
            }
        }
        Verdict verdict;
        for (std::size_t k = 0; k < kCount; ++k)
            verdict.add("",
                        compare(TypeParam::kOutputs[k].name, device[k], cpp[k], floor[k], Tail::quantiles));
        for (const std::string& excess : verdict.excesses) ADD_FAILURE() << excess;
        std::cout << fmt::format("largest ratio to C++: {:.2f}, {}\n", verdict.largest_ratio, verdict.where);
    }
}

class RandomParity : public GpuTest {};

TEST_F(RandomParity, HasTheBitsOfCpp) {
    std::vector<float> inputs;
    const auto bits = [](RandomSource& random) {
        // A word with any bits might be a signalling NaN, which must not pass through arithmetic; loads and stores
        // keep it.
        return std::bit_cast<float>(static_cast<std::uint32_t>(random.uniform() * 0x1p32));
    };
    for (std::size_t i = 0; i < kCalls; ++i) {
        RandomSource random(2, i);
        for (int k = 0; k < 4; ++k) inputs.push_back(bits(random));
        inputs.push_back(static_cast<float>(random.uniform() * 0.9999));
    }
    const auto results = ShaderRunner(device(), shaders::kRandom, 5).run(inputs);
    for (std::size_t i = 0; i < kCalls; ++i) {
        std::uint32_t key[4], words[8];
        std::memcpy(key, &inputs[5 * i], sizeof key);
        std::memcpy(words, results[i].data(), sizeof words);
        const auto hash = pcg4d({key[0], key[1], key[2], key[3]});
        const auto plain = sobol(key[0]);
        const auto scrambled = owen_scrambled_sobol(key[0], {key[1], key[2], key[3]});
        const std::uint32_t expected[] = {hash.x,  hash.y,  hash.z,      hash.w,
                                          plain.x, plain.y, scrambled.x, scrambled.y};
        for (std::size_t k = 0; k < std::size(expected); ++k)
            ASSERT_EQ(words[k], expected[k]) << i << ", " << k;
        ASSERT_EQ(results[i][8], to_unit<float>(key[0])) << i;
        const std::uint32_t points = 1 + key[2] % 1024;
        const float jittered = uniform_jittered(inputs[5 * i + 4], key[1] % points, points);
        // Division on a GPU may err by two and a half roundings.
        ASSERT_NEAR(results[i][9], jittered, 3 * 0x1p-24) << i;
        ASSERT_LT(results[i][9], 1) << i;
    }
}

} // namespace

} // namespace nusselt::parity
