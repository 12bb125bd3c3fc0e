/// Tests of lines on hostile lights: all results are finite, no light comes from behind, and no part is brighter than
/// the whole.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include <nusselt/line_samples/phong.h>

#include "proof/hostile/lights.h"
#include "sampling/flush_denormals.h"

namespace nusselt_test {
namespace {

using nusselt::BothSides;
using nusselt::Interval;
using nusselt::LineFamily;
using nusselt::LinePlane;
using nusselt::LobePlane;
using nusselt::Vec3;
using nusselt::hostile::HostileLights;
using nusselt::hostile::RandomSource;

template <class T>
bool finite(const Vec3<T>& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

template <class T>
struct HostileCase {
    explicit HostileCase(std::uint64_t seed, std::uint64_t index)
        : lights(seed, index),
          random(seed + 1, index),
          light(lights.template polygon<8>()),
          family(light, static_cast<T>(random.index(4) == 0 ? random.log_between(1e-12, 1e-3)
                                                            : random.between(0, 3.141592))) {}

    T share() {
        return random.index(6) == 0 ? static_cast<T>(random.index(2)) : static_cast<T>(random.uniform());
    }

    HostileLights<T> lights;
    RandomSource random;
    nusselt::ConvexPolygon<T, 8> light;
    LineFamily<T, 8> family;
};

/// The defect of the offsets of a family; empty if they are correct.
template <class T>
std::string problem_of_offsets(HostileCase<T>& c) {
    const auto& family = c.family;
    const T u = c.lights.random_number();
    const Interval<T> all = family.offsets();
    const auto& plane = family.plane();
    if (!finite(plane.along) || !finite(plane.across) || !(all.begin <= all.end)) return "plane";
    for (const auto& choice : {family.sample_by_length(u), family.sample_uniform(u)}) {
        if (!(choice.offset >= all.begin && choice.offset <= all.end)) return "offset beyond the light";
        if (!(choice.pdf >= 0) || !std::isfinite(choice.pdf)) return "density";
        const Interval<T> chord = family.chord(choice.offset).extent;
        if (!std::isfinite(chord.begin) || !std::isfinite(chord.end) || chord.end < chord.begin)
            return "chord";
    }
    const T offset = family.sample_by_length(u).offset;
    for (const T inverse : {family.invert_by_length(offset), family.invert_uniform(offset)})
        if (!(inverse >= 0 && inverse < 1)) return "inverse";
    if (!(family.area() >= 0)) return "area";
    return {};
}

/// The defect of the integrals along a line; empty if they are correct.
template <class T>
std::string problem_of_parts(HostileCase<T>& c) {
    const auto& family = c.family;
    const auto& plane = family.plane();
    const T offset = family.sample_by_length(c.lights.random_number()).offset;
    const Interval<T> whole = family.chord(offset).extent;
    const auto at = [&](T x) {
        return std::min(std::max(whole.begin + x * (whole.end - whole.begin), whole.begin), whole.end);
    };
    const T a = at(c.share());
    const T b = at(c.share());
    const Interval<T> part{std::min(a, b), std::max(a, b)};
    const nusselt::Ltc<T> ltc(c.lights.lobe());
    const Vec3<T> mirror = nusselt::broadcast<T>(c.random.direction());
    const T exponent = static_cast<T>(c.random.log_between(1, 1e5));
    const nusselt::ScaledPlane<T> light(plane, family.reach());
    const auto line = LobePlane<T, BothSides>(light).line(offset);
    // Rounding moves the ends of lines across the horizon and turns lines that are close to the point.
    const auto e = line.extent(line.clipped(whole));
    const T rounding =
        64 * std::numeric_limits<T>::epsilon() / (e.visible() ? std::min(e.distance, T(1)) : T(1));
    const T above_horizon = e.visible() ? 2 * nusselt::kPi<T> * line.factor * e.sine_extent().difference : 0;
    const T diffuse = diffuse_part(line, whole);
    const T diffuse_of_part = diffuse_part(line, part);
    const T phong = phong_part(line, whole, mirror, exponent);
    const T phong_of_part = phong_part(line, part, mirror, exponent);
    const T lobe = lobe_part(line, LobePlane<T, BothSides>(light, ltc).line(offset), whole);
    for (const T value : {diffuse, diffuse_of_part, phong, phong_of_part, lobe})
        if (!std::isfinite(value) || value < 0) return "not finite or negative";
    if (diffuse_of_part >
        diffuse + rounding * diffuse + 8 * std::numeric_limits<T>::epsilon() * above_horizon)
        return "a part is brighter than the whole";
    // The narrower a lobe, the more rounding changes it. The quadrature adds an error that is small relative to the
    // lobe.
    if (phong_of_part > phong + (rounding * std::sqrt(exponent) + T(1e-5)) * (phong + above_horizon))
        return "a part is brighter than the whole in a Phong lobe";
    const T diffuse_front = diffuse_part(LobePlane<T>(light).line(offset), part);
    if (diffuse_front != (light.height > 0 ? diffuse_of_part : 0)) return "light from behind";
    return {};
}

template <class T>
void expect_no_problems(std::uint64_t seed, int cases) {
    int failures = 0;
    int lit = 0;
    for (int k = 0; k < cases && failures < 5; ++k) {
        HostileCase<T> c(seed, static_cast<std::uint64_t>(k));
        std::string problem = problem_of_offsets(c);
        if (problem.empty()) problem = problem_of_parts(c);
        lit += c.family.sample_by_length(T(0.5)).pdf > 0;
        if (problem.empty()) continue;
        ++failures;
        ADD_FAILURE() << problem << ", case " << k;
    }
    EXPECT_GT(lit, cases / 2);
}

TEST(HostileLineFamily, NeverFailsInFloat) { expect_no_problems<float>(1, 1'000'000); }
TEST(HostileLineFamily, NeverFailsInDouble) { expect_no_problems<double>(2, 200'000); }
TEST(HostileLineFamily, NeverFailsWithDenormalsFlushed) {
    const FlushDenormalsToZero flush;
    expect_no_problems<float>(3, 100'000);
}

} // namespace
} // namespace nusselt_test
