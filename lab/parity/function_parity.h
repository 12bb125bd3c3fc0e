#pragma once
/// Compares the functions below the techniques on the device, in C++ with float and in C++ with long double.

#include "lab/parity/parity.h"
#include "lab/parity/shader_platform.h"
#include "proof/hostile/lights.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <cmath>

namespace nusselt::parity {

using hostile::RandomSource;

/// Whether the next inputs are to be degenerate, as for one call in eight.
inline bool is_degenerate(RandomSource& random) { return random.index(8) == 0; }

inline Vec3<double> axis(RandomSource& random) {
    const Vec3<double> axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    return axes[random.index(6)];
}

/// How errors are measured.
enum class Error {
    relative, ///< relative to the exact value
    absolute, ///< for numbers of order one
    measure,  ///< relative to at least kSmallestMeasure: rounding moves dark lights
};

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

inline void put(std::vector<float>& inputs, const Vec3<double>& v) {
    for (const double x : {v.x, v.y, v.z}) inputs.push_back(static_cast<float>(x));
}

/// A parallelogram whose coordinates are multiples of 2^-10, so that its corners lie exactly in a plane.
struct Parallelogram {
    Vec3<double> corner, a, b;

    explicit Parallelogram(RandomSource& random)
        : corner(rounded(random)), a(rounded(random)), b(rounded(random)) {
        if (!is_degenerate(random)) return;
        switch (random.index(4)) {
        case 0: // repeated vertices
            b = {0, 0, 0};
            break;
        case 1: // no area
            b = 2.0 * a;
            break;
        case 2: // a sliver
            b = a + 0x1p-10 * axis(random);
            break;
        default: // nearly a point
            a = 0x1p-10 * axis(random);
            b = 0x1p-10 * axis(random);
        }
    }

    void put_corners(std::vector<float>& inputs) const {
        for (const Vec3<double>& v : {corner, corner + a, corner + a + b, corner + b}) put(inputs, v);
    }

private:
    static Vec3<double> rounded(RandomSource& random) {
        const Vec3<double> v = random.direction();
        return 0x1p-10 *
               Vec3<double>{std::round(0x1p10 * v.x), std::round(0x1p10 * v.y), std::round(0x1p10 * v.z)};
    }
};

inline double error(const Output& output, long double value, long double exact) {
    const long double off = std::fabs(value - exact);
    if (off == 0) return 0;
    switch (output.error) {
    case Error::absolute:
        return static_cast<double>(off);
    case Error::measure:
        return static_cast<double>(off / std::max(std::fabs(exact), proof::kSmallestMeasure));
    case Error::relative:
        break;
    }
    return static_cast<double>(off / std::fabs(exact));
}

/// Largest share of outputs that mean nothing and differ: more of them would hide errors. One light in 32 has no area, and four
/// of ten outputs tell where its sample is.
inline constexpr double kMostUndefined = 1.0 / 80;
/// The error from which an output that means nothing counts as different.
inline constexpr double kClearDifference = 1e-3;

/// Compares a shader of a group with C++. A group is a struct with a shader. For each call, draw() makes kInputs floats, and call() returns the kOutputs in C++. A group may have a function
/// is_defined(output, exact results): other outputs must be finite only, and few of them may differ from the exact ones.
/// \param tail excludes the largest error where it depends on chance, because samples may fall on either side of an
/// edge.
template <class Group>
Verdict judge_group(const ShaderPlatform& platform, const VariantShader& shader, std::size_t calls,
                    std::span<const std::uint32_t> table = {}, Tail tail = Tail::largest) {
    std::vector<float> inputs;
    for (std::size_t i = 0; i < calls; ++i) {
        RandomSource random(1, i);
        Group::draw(random, inputs);
    }
    const auto results = platform.load(shader, Group::kInputs, table)->run(inputs);
    constexpr std::size_t kCount = std::size(Group::kOutputs);
    std::array<std::vector<double>, kCount> of_device, of_cpp, floor;
    for (std::size_t k = 0; k < kCount; ++k)
        for (auto* errors : {&of_device[k], &of_cpp[k], &floor[k]}) errors->resize(calls);
    std::atomic<std::size_t> undefined = 0;
    tbb::parallel_for(std::size_t{0}, calls, [&](std::size_t i) {
        const float* in = &inputs[Group::kInputs * i];
        const auto exact = Group::template call<long double>(in);
        const auto single = Group::template call<float>(in);
        for (std::size_t k = 0; k < kCount; ++k) {
            if constexpr (requires { Group::is_defined(k, exact); }) {
                if (!Group::is_defined(k, exact)) {
                    if (error(Group::kOutputs[k], results[i][k], exact[k]) > kClearDifference) ++undefined;
                    continue;
                }
            }
            const Output& output = Group::kOutputs[k];
            of_device[k][i] = error(output, results[i][k], exact[k]);
            of_cpp[k][i] = error(output, single[k], exact[k]);
            floor[k][i] = error(output, static_cast<float>(exact[k]), exact[k]);
        }
    });
    Verdict verdict;
    verdict.lights = static_cast<std::int64_t>(calls);
    for (std::size_t i = 0; i < calls; ++i)
        for (std::size_t k = 0; k < kCount; ++k)
            if (!std::isfinite(results[i][k]))
                verdict.excesses.push_back(
                    fmt::format("{} of call {} is not finite", Group::kOutputs[k].name, i));
    if (static_cast<double>(undefined) > kMostUndefined * static_cast<double>(calls * kCount))
        verdict.excesses.push_back(fmt::format("{} outputs that mean nothing differ", undefined.load()));
    for (std::size_t k = 0; k < kCount; ++k)
        verdict.add("", compare(Group::kOutputs[k].name, of_device[k], of_cpp[k], floor[k], {tail}));
    return verdict;
}

/// What a group needs besides its inputs.
struct GroupSettings {
    std::size_t calls_divisor = 1; ///< fewer calls than for other functions, where they take longer
    /// Makes the words of the shader's table, if it has one.
    std::vector<std::uint32_t> (*table)() = nullptr;
    Tail tail = Tail::largest;
};

/// The case of a group.
template <class Group>
ParityCase group_case(const GroupSettings& settings = {}) {
    const auto judge = [settings](const ShaderPlatform& platform, const ParityEffort& effort) {
        const std::size_t calls = effort.function_calls() / settings.calls_divisor;
        const auto table = settings.table ? settings.table() : std::vector<std::uint32_t>();
        std::vector<VariantVerdict> verdicts;
        for (const Variant variant : platform.variants()) {
            const VariantShader shader(Group::kShader, variant);
            verdicts.push_back({variant, judge_group<Group>(platform, shader, calls, table, settings.tail)});
        }
        return verdicts;
    };
    return {"functions", Group::kName, judge};
}

} // namespace nusselt::parity
