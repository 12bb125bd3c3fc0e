/// Tests of sampling of lines whose radiance varies in packs: each lane does what a scalar does for the same view of the light.

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <nusselt/line_emission/textured_line.h>

#include "emission/pack_comparison.h"
#include "line_emission/textured_lines.h"

namespace nusselt_test {
namespace {

using nusselt::LineSegment;
using nusselt::LobeLines;
using nusselt::make_line;
using nusselt::Pack;
using nusselt::ProjectedLines;
using nusselt::TexturedLine;
using nusselt::Vec3;

constexpr int kLanes = 8;
template <class T>
using Lanes = Pack<T, kLanes>;

template <class T>
struct Views {
    LineSegment<T> of_lane[kLanes];
    LineSegment<Lanes<T>> all;
};

/// Lines across the horizon, far, close, below the horizon, through the shading point, without length.
template <class T>
Views<T> some_views(std::mt19937& random) {
    std::uniform_real_distribution<double> uniform(0, 1);
    std::normal_distribution<double> normal;
    Views<T> views;
    for (int k = 0; k < kLanes; ++k) {
        const double distance = std::pow(10, 4 * uniform(random) - 2);
        const bool is_even = uniform(random) < 0.2;
        const auto point = [&](double scale) {
            double c[3];
            for (double& x : c) x = is_even ? std::round(2 * uniform(random) - 1) : normal(random);
            return Vec3<T>{static_cast<T>(scale * c[0]), static_cast<T>(scale * c[1]),
                           static_cast<T>(scale * c[2])};
        };
        const Vec3<T> start = point(distance);
        const LineSegment<T> line = make_line(start, start + point(1));
        views.of_lane[k] = line;
        const auto set = [&](Vec3<Lanes<T>>& all, const Vec3<T>& one) {
            all.x.set_lane(k, one.x);
            all.y.set_lane(k, one.y);
            all.z.set_lane(k, one.z);
        };
        set(views.all.p0, line.p0);
        set(views.all.s, line.s);
        views.all.length.set_lane(k, line.length);
    }
    return views;
}

template <class T_, template <class> class Measure_>
struct Variant {
    using T = T_;
    template <class Real>
    static auto make(const LineSegment<Real>& line, const nusselt::LineProfile<T>& profile) {
        using Measure = Measure_<Real>;
        if constexpr (std::is_same_v<Measure, LobeLines<Real>>)
            return TexturedLine<Real, 64, Measure>(line, profile, {glossy_lobe<Real>()});
        else
            return TexturedLine<Real, 64, Measure>(line, profile);
    }
};

template <class Variant>
class TexturedLinePacks : public ::testing::Test {};
using Variants = ::testing::Types<Variant<float, ProjectedLines>, Variant<float, LobeLines>,
                                  Variant<double, ProjectedLines>, Variant<double, LobeLines>>;
TYPED_TEST_SUITE(TexturedLinePacks, Variants);

TYPED_TEST(TexturedLinePacks, DoWhatScalarsDo) {
    using T = typename TypeParam::T;
    std::mt19937 random(12);
    std::uniform_real_distribution<T> uniform(0, T(0.999999));
    const nusselt::LineProfile<T> profiles[] = {
        profile_of<T>(1, [](double) { return 1; }), profile_of<T>(13, [](double x) { return 0.1 + x; }),
        profile_of<T>(64, [](double x) { return dots(x) ? 1 + x : 0; })};
    Comparison<T> weights, samples, densities, inverses;
    int lit = 0;
    for (int round = 0; round < 240; ++round) {
        const auto& profile = profiles[round % 3];
        const Views<T> views = some_views<T>(random);
        const auto packed = TypeParam::make(views.all, profile);
        Lanes<T> u(T(0)), at(T(0));
        for (int k = 0; k < kLanes; ++k) {
            u.set_lane(k, uniform(random));
            at.set_lane(k, uniform(random));
        }
        const auto s = packed.sample(u);
        const Lanes<T> pdf = packed.pdf(s.wi);
        const Lanes<T> pdf_at = packed.pdf_at(at);
        const Lanes<T> again = packed.invert(s.wi);
        const auto unshadowed = packed.unshadowed();
        const auto radiance = profile.lookup(s.at);
        for (int k = 0; k < kLanes; ++k) {
            const auto single = TypeParam::make(views.of_lane[k], profile);
            weights.add(single.measure(), packed.measure().lane(k));
            weights.add(single.unshadowed().x, unshadowed.x.lane(k));
            const auto expected = single.sample(u.lane(k));
            samples.add(expected.pdf, s.pdf.lane(k));
            densities.add(single.pdf_at(at.lane(k)), pdf_at.lane(k));
            if (expected.pdf == 0) continue;
            ++lit;
            samples.add(expected.at, s.at.lane(k));
            samples.add(expected.wi.z, s.wi.z.lane(k));
            samples.add(expected.p.x, s.p.x.lane(k));
            samples.add(profile.lookup(expected.at).y, radiance.y.lane(k));
            densities.add(single.pdf(expected.wi), pdf.lane(k));
            inverses.add(single.invert(expected.wi), again.lane(k));
        }
    }
    EXPECT_GT(lit, 700);
    weights.expect_agreement(700, 200);
    samples.expect_agreement(700, 200);
    densities.expect_agreement(700, 200);
    inverses.expect_agreement(700, 200);
}

} // namespace
} // namespace nusselt_test
