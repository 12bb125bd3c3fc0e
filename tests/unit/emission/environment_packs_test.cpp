/// Tests of sampling of environment maps in packs: each lane does what a scalar does for the same surface.

#include <cmath>

#include <gtest/gtest.h>

#include "emission/environments.h"
#include "emission/pack_comparison.h"
#include "ltc/lobes.h"

namespace nusselt_test {
namespace {

using nusselt::CosineFactor;
using nusselt::EnvironmentSampler;
using nusselt::Frame;
using nusselt::LobeFactor;
using nusselt::Pack;
using nusselt::Vec2;
using nusselt::Vec3;

constexpr int kLanes = 8;

template <class Real>
CosineFactor<Real> factor_of(CosineFactor<Real>*) {
    return {};
}
template <class Real>
LobeFactor<Real> factor_of(LobeFactor<Real>*) {
    const auto c = tilted_lobe(0.5L, 0.4L, 1.1L, 0.1L);
    return {nusselt::Ltc<Real>({Real(c.m00), Real(c.m02), Real(c.m11), Real(c.m20), Real(c.m22), Real(1)})};
}

template <class T_, int n_, template <class> class Factor_>
struct Variant {
    using T = T_;
    static constexpr int n = n_;
    template <class Real>
    static EnvironmentSampler<Real, n, Factor_<Real>> make(const nusselt::EnvironmentMap<T, n>& map,
                                                           const Frame<Real>& frame) {
        return {map, frame, factor_of(static_cast<Factor_<Real>*>(nullptr))};
    }
};

template <class Variant>
class EnvironmentPacks : public ::testing::Test {};
using Variants = ::testing::Types<Variant<float, 8, CosineFactor>, Variant<float, 16, LobeFactor>,
                                  Variant<double, 16, CosineFactor>, Variant<double, 8, LobeFactor>>;
TYPED_TEST_SUITE(EnvironmentPacks, Variants);

template <class T>
void set_lane(Vec3<Pack<T, kLanes>>& v, int lane, const Vec3<T>& value) {
    v.x.set_lane(lane, value.x);
    v.y.set_lane(lane, value.y);
    v.z.set_lane(lane, value.z);
}

TYPED_TEST(EnvironmentPacks, DoWhatScalarsDo) {
    using T = typename TypeParam::T;
    constexpr int n = TypeParam::n;
    using Lanes = Pack<T, kLanes>;
    std::mt19937 random(5);
    std::uniform_real_distribution<T> uniform(0, T(0.999999));
    std::normal_distribution<T> normal;
    // Black texels, bright ones, and a sun.
    const auto texels = MapTexels<T>(64, [&](int i, int j) {
        const T r = (i / 5 + j / 5) % 3 == 0 ? T(0) : std::pow(uniform(random), T(8));
        return Vec3<T>{r, T(0.5) * r, i == 20 && j == 40 ? T(500) : T(2) * r};
    });
    const StoredMap<T, n> stored(texels.view());
    Comparison<T> weights, samples, densities, inverses;
    int lit = 0;
    for (int round = 0; round < 250; ++round) {
        Frame<T> frames[kLanes];
        Frame<Lanes> packed_frame{};
        Vec2<T> u[kLanes], at[kLanes];
        Vec2<Lanes> packed_u{}, packed_at{};
        for (int k = 0; k < kLanes; ++k) {
            frames[k] =
                Frame<T>::from_normal(normalize(Vec3<T>{normal(random), normal(random), normal(random)}));
            set_lane(packed_frame.t, k, frames[k].t);
            set_lane(packed_frame.b, k, frames[k].b);
            set_lane(packed_frame.n, k, frames[k].n);
            u[k] = {uniform(random), uniform(random)};
            at[k] = {uniform(random), uniform(random)};
            packed_u.x.set_lane(k, u[k].x);
            packed_u.y.set_lane(k, u[k].y);
            packed_at.x.set_lane(k, at[k].x);
            packed_at.y.set_lane(k, at[k].y);
        }
        const auto packed = TypeParam::template make<Lanes>(stored.map, packed_frame);
        const auto s = packed.sample(packed_u);
        const Lanes pdf = packed.pdf(s.wi);
        const Lanes pdf_at = packed.pdf_at(packed_at);
        const Vec2<Lanes> again = packed.invert(s.wi);
        const Vec3<Lanes> unshadowed = packed.unshadowed();
        for (int k = 0; k < kLanes; ++k) {
            const auto single = TypeParam::template make<T>(stored.map, frames[k]);
            weights.add(single.measure(), packed.measure().lane(k));
            weights.add(single.unshadowed().z, unshadowed.z.lane(k));
            const auto expected = single.sample(u[k]);
            samples.add(expected.pdf, s.pdf.lane(k));
            samples.add(expected.at.x, s.at.x.lane(k));
            samples.add(expected.at.y, s.at.y.lane(k));
            densities.add(single.pdf_at(at[k]), pdf_at.lane(k));
            if (expected.pdf == 0) continue;
            ++lit;
            samples.add(expected.wi.z, s.wi.z.lane(k));
            samples.add(expected.p.x, s.p.x.lane(k));
            densities.add(single.pdf(expected.wi), pdf.lane(k));
            inverses.add(single.invert(expected.wi).x, again.x.lane(k));
            inverses.add(single.invert(expected.wi).y, again.y.lane(k));
        }
    }
    EXPECT_GT(lit, 500);
    weights.expect_agreement(3000, 500);
    samples.expect_agreement(3000, 500);
    densities.expect_agreement(3000, 500);
    inverses.expect_agreement(3000, 500);
}

/// Maps without light, and lanes whose frames are not numbers.
TYPED_TEST(EnvironmentPacks, KeepLanesApart) {
    using T = typename TypeParam::T;
    constexpr int n = TypeParam::n;
    using Lanes = Pack<T, kLanes>;
    const auto texels = MapTexels<T>(32, [](int i, int) { return grey<T>(i); });
    const StoredMap<T, n> stored(texels.view());
    const auto frame = Frame<T>::from_normal(normalize(Vec3<T>{T(0.2), T(0.3), T(1)}));
    auto packed_frame = nusselt::broadcast<Lanes>(frame);
    packed_frame.n.x.set_lane(3, std::numeric_limits<T>::quiet_NaN());
    packed_frame.t.y.set_lane(3, std::numeric_limits<T>::infinity());
    const auto packed = TypeParam::template make<Lanes>(stored.map, packed_frame);
    const Vec2<Lanes> u{Lanes(T(0.4)), Lanes(T(0.7))};
    const auto s = packed.sample(u);
    const auto expected = TypeParam::template make<T>(stored.map, frame).sample({T(0.4), T(0.7)});
    ASSERT_GT(expected.pdf, 0);
    for (int k = 0; k < kLanes; ++k) {
        if (k == 3) {
            EXPECT_EQ(s.pdf.lane(k), 0);
            EXPECT_EQ(s.at.x.lane(k), 0);
        } else {
            EXPECT_NEAR(s.pdf.lane(k), expected.pdf, T(1e-3) * expected.pdf);
        }
    }
    const auto black = MapTexels<T>(32, [](int, int) { return grey<T>(0); });
    const StoredMap<T, n> dark(black.view());
    const auto none = TypeParam::template make<Lanes>(dark.map, nusselt::broadcast<Lanes>(frame));
    EXPECT_FALSE(any(none.sample(u).pdf != Lanes(T(0))));
    EXPECT_FALSE(any(none.pdf(s.wi) != Lanes(T(0))));
    EXPECT_FALSE(any(none.measure() != Lanes(T(0))));
}

} // namespace
} // namespace nusselt_test
