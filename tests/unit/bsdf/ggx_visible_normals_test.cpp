/// Tests of sampling visible normals: the textbook's densities, quadrature, inversion and hostile input.

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/bsdf/frostbite.h>
#include <nusselt/bsdf/ggx_visible_normals.h>
#include <nusselt/random/sobol.h>
#include <nusselt/random/unit_interval.h>
#include <nusselt/simd/pack.h>

#include "ggx_reference.h"
#include "sampling/techniques.h"

namespace nusselt_test {
namespace {

using nusselt::BoundedCap;
using nusselt::broadcast;
using nusselt::dot;
using nusselt::Frostbite;
using nusselt::GgxVisibleNormals;
using nusselt::VisibleCap;

template <class Real>
using Direction = nusselt::Vec3<Real>;

const std::vector<GgxReference>& lobes() {
    static const std::vector<GgxReference> list = {
        {direction_at(0.3L, 0.5L), 0.3L},  {direction_at(0, 0), 0.5L},        {direction_at(1.2L, 4), 0.1L},
        {direction_at(1.5L, -2), 0.4L},    {direction_at(0.8L, 3), 1},        {direction_at(1.55L, 1), 1},
        {direction_at(0.6L, -1.5L), 0.2L}, {direction_at(1.569L, 2.5L), 0.2L}};
    return list;
}

template <class Real, class Cap>
GgxVisibleNormals<Real, Cap> sampler(const GgxReference& lobe) {
    return {broadcast<Real>(lobe.wo), static_cast<Real>(lobe.alpha)};
}

template <class Cap>
long double reference_pdf(const GgxReference& lobe, const Point& wi) {
    return std::is_same_v<Cap, BoundedCap> ? lobe.bounded_pdf(wi) : lobe.pdf(wi);
}

constexpr std::uint32_t kSamples = 1 << 20;

/// Calls f(wi) for the samples of a (0, 20, 2)-net.
template <class Technique, class Function>
void for_each_sample(const Technique& technique, const Function& f) {
    for (std::uint32_t i = 0; i < kSamples; ++i) {
        const nusselt::UInt2 bits = nusselt::sobol(i);
        f(technique.sample({nusselt::to_unit<double>(bits.x), nusselt::to_unit<double>(bits.y)}));
    }
}

template <class Cap>
class VisibleNormalsTest : public ::testing::Test {};
using Caps = ::testing::Types<VisibleCap, BoundedCap>;
TYPED_TEST_SUITE(VisibleNormalsTest, Caps);

TYPED_TEST(VisibleNormalsTest, DensityIsTheTextbooks) {
    std::mt19937 random(1);
    std::uniform_real_distribution<long double> uniform(0, 1);
    for (const GgxReference& lobe : lobes()) {
        const auto normals = sampler<long double, TypeParam>(lobe);
        for (int i = 0; i < 1000; ++i) {
            const Point wi = direction_at(std::acos(uniform(random)), 2 * kPi * uniform(random));
            const long double expected = reference_pdf<TypeParam>(lobe, wi);
            ASSERT_NEAR(normals.pdf(wi) / expected, 1, 1e-13L);
        }
    }
}

TYPED_TEST(VisibleNormalsTest, MomentsOfSamplesAreThoseOfTheDensity) {
    for (const GgxReference& lobe : lobes()) {
        const auto normals = sampler<double, TypeParam>(lobe);
        const auto moments = [&](const auto& wi, auto* sums, auto weight) {
            if (wi.z <= 0) return;
            sums[0] += weight;
            sums[1] += weight * wi.x;
            sums[2] += weight * wi.y;
            sums[3] += weight * wi.z;
            sums[4] += weight * wi.x * wi.y;
            sums[5] += weight * wi.z * wi.z;
        };
        double sums[6] = {};
        for_each_sample(normals, [&](const auto& wi) { moments(wi, sums, 1.0); });
        for (int k = 0; k < 6; ++k) {
            const auto integrand = [&](const Point& wi) {
                long double values[6] = {};
                moments(wi, values, reference_pdf<TypeParam>(lobe, wi));
                return values[k];
            };
            EXPECT_NEAR(sums[k] / kSamples, integrate_directions(lobe.wo, 0, integrand, 1e-6L), 2e-5L) << k;
        }
    }
}

/// The density of a direction times the solid angle of the image of a cell of random numbers is the area of the cell,
/// above and below the surface.
TYPED_TEST(VisibleNormalsTest, DensityIsTheReciprocalOfTheJacobian) {
    constexpr long double kStep = 1e-6L;
    for (const GgxReference& lobe : lobes()) {
        const auto normals = sampler<long double, TypeParam>(lobe);
        for (const long double x : {0.02L, 0.13L, 0.49L, 0.51L, 0.72L, 0.98L}) {
            for (const long double y : {0.01L, 0.3L, 0.6L, 0.9L, 0.999L}) {
                const Point along_x = normals.sample({x + kStep, y}) - normals.sample({x - kStep, y});
                const Point along_y = normals.sample({x, y + kStep}) - normals.sample({x, y - kStep});
                const long double jacobian = length(cross(along_x, along_y)) / (4 * kStep * kStep);
                ASSERT_NEAR(jacobian * normals.pdf(normals.sample({x, y})), 1, 3e-6L) << x << " " << y;
            }
        }
    }
}

template <class Real, class Cap>
void expect_round_trips(Real tolerance) {
    for (const GgxReference& lobe : lobes()) {
        const auto normals = sampler<Real, Cap>(lobe);
        for (const Real x : {Real(0), Real(0.2L), Real(0.5L), Real(0.51L), Real(0.9L)}) {
            for (const Real y : {Real(0.05L), Real(0.4L), Real(0.8L), Real(0.95L)}) {
                const auto u = normals.invert(normals.sample({x, y}));
                const Real turn = std::fabs(u.x - x);
                ASSERT_NEAR(std::min(turn, 1 - turn), 0, tolerance) << x << " " << y;
                ASSERT_NEAR(u.y, y, tolerance) << x << " " << y;
            }
        }
    }
}

TYPED_TEST(VisibleNormalsTest, Inverts) {
    // The measured errors reach 22 roundings, where half vectors cancel.
    expect_round_trips<float, TypeParam>(4e-6f);
    expect_round_trips<double, TypeParam>(1e-14);
    expect_round_trips<long double, TypeParam>(5e-18L);
}

TYPED_TEST(VisibleNormalsTest, SamplesAreContinuousAroundTheNormal) {
    for (const GgxReference& lobe : lobes()) {
        const auto normals = sampler<double, TypeParam>(lobe);
        for (const double x : {0.0, 0.5}) {
            const double before = x == 0 ? 1 - 1e-9 : x - 1e-9;
            EXPECT_LT(length(normals.sample({before, 0.4}) - normals.sample({x, 0.4})), 1e-7);
        }
    }
}

/// A bounded cap that lacked a direction above the surface would be too small.
TEST(BoundedVisibleNormals, ReachAllDirectionsAboveTheSurface) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int i = 0; i < 200000; ++i) {
        const double inclination = i % 4 == 0 ? std::acos(1e-3 * uniform(random)) : 1.57 * uniform(random);
        const auto wo = broadcast<double>(direction_at(inclination, 7 * uniform(random)));
        const double alpha = std::pow(uniform(random), 2);
        const auto wi = GgxVisibleNormals<double>(wo, alpha).sample({uniform(random), uniform(random)});
        // The critical directions are those just above the horizon. Any closer, rounding decides.
        if (wi.z <= 1e-6) continue;
        const GgxVisibleNormals<double, BoundedCap> bounded(wo, alpha);
        ASSERT_LT(length(bounded.sample(bounded.invert(wi)) - wi), 1e-6) << i;
    }
}

/// The expected shares of samples above the surface come from another program (2^20 samples, alpha 0.3, wo 0.3 rad
/// from the normal).
TEST(BoundedVisibleNormals, LoseFewerSamples) {
    const GgxReference lobe{direction_at(0.3L, 0), 0.3L};
    const auto share_above = [&](const auto& normals) {
        int above = 0;
        for_each_sample(normals, [&](const auto& wi) { above += wi.z > 0; });
        return static_cast<double>(above) / kSamples;
    };
    EXPECT_NEAR(share_above(sampler<double, VisibleCap>(lobe)), 0.917, 1e-3);
    EXPECT_NEAR(share_above(sampler<double, BoundedCap>(lobe)), 0.982, 1e-3);
}

TEST(VisibleNormals, DensityOfAllDirectionsIsOne) {
    for (const GgxReference& lobe : lobes()) {
        const auto normals = sampler<long double, VisibleCap>(lobe);
        const auto density = [&](const Point& wi) { return normals.pdf(wi); };
        EXPECT_NEAR(integrate_directions(lobe.wo, -lobe.wo.z, density), 1, 1e-7L);
    }
}

/// Beyond the rim of the bounded cap, the density is zero; all these directions are below the surface.
TEST(BoundedVisibleNormals, DensityIsZeroBeyondTheRim) {
    for (const GgxReference& lobe : lobes()) {
        const auto bounded = sampler<double, BoundedCap>(lobe);
        const auto all = sampler<double, VisibleCap>(lobe);
        int beyond = 0;
        double inside = 0;
        for_each_sample(all, [&](const auto& wi) {
            const double density = bounded.pdf(wi);
            inside += density / all.pdf(wi);
            if (density > 0) return;
            ++beyond;
            ASSERT_LE(wi.z, 0);
        });
        EXPECT_NEAR(inside / kSamples, 1, 1e-3);
        EXPECT_GT(beyond, 0);
    }
}

template <class Brdf>
auto lit_specular(const Brdf& brdf) {
    return [&brdf](const auto& wi) { return brdf.eval_specular(wi).x * wi.z; };
}

TYPED_TEST(VisibleNormalsTest, AlbedoIsThatOfQuadrature) {
    for (const GgxReference& lobe : lobes()) {
        const long double roughness = std::sqrt(lobe.alpha);
        const Frostbite<long double> exact(lobe.wo, {0, 0, 0}, {0.2L, 0, 0}, roughness);
        const auto albedo = integrate_directions(lobe.wo, 0, lit_specular(exact));
        const Frostbite<double> brdf(broadcast<double>(lobe.wo), {0, 0, 0}, {0.2, 0, 0},
                                     static_cast<double>(roughness));
        const auto normals = sampler<double, TypeParam>(lobe);
        double sum = 0;
        for_each_sample(normals, [&](const auto& wi) {
            if (wi.z > 0) sum += lit_specular(brdf)(wi) / normals.pdf(wi);
        });
        EXPECT_NEAR(sum / kSamples, albedo, 1e-6L);
    }
}

struct Hostile {
    Direction<float> wo;
    float roughness;
    nusselt::Vec2<float> u;
};

/// Smooth and rough surfaces, seen along the normal and from close to the horizon, with random numbers that include
/// the ends of their range.
class HostileSurfaces {
public:
    /// \param smallest_cosine of wo.
    explicit HostileSurfaces(double smallest_cosine) : smallest_(smallest_cosine) {}

    Hostile next() {
        const double cosines[] = {1, std::pow(smallest_, number()), 1 - std::pow(1e-7, number()), number()};
        const double cosine = std::max(cosines[choice()], smallest_);
        const double sine = std::sqrt(1 - cosine * cosine);
        const double azimuths[] = {0, std::acos(0.0), std::acos(-1.0), 7 * number()};
        const double azimuth = azimuths[choice()];
        const double roughnesses[] = {0, 0.01 * (1 + number()), 1, number()};
        const Direction<double> wo{sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
        const auto roughness = static_cast<float>(roughnesses[choice()]);
        return {broadcast<float>(wo), roughness, {random_number(), random_number()}};
    }

private:
    double number() { return std::uniform_real_distribution<double>(0, 1)(generator_); }
    std::size_t choice() { return generator_() % 4; }
    float random_number() {
        const double numbers[] = {0, 1 - 0x1p-24, number(), std::pow(1e-8, number())};
        return std::min(static_cast<float>(numbers[choice()]), 1 - 0x1p-24f);
    }

    double smallest_;
    std::mt19937 generator_{5};
};

/// The narrow peaks of density and BRDF cancel; the masking term remains.
TYPED_TEST(VisibleNormalsTest, WeightsAreExactInFloat) {
    HostileSurfaces surfaces(1e-9);
    int checked = 0;
    for (int i = 0; i < 500000; ++i) {
        const Hostile s = surfaces.next();
        const float alpha = nusselt::ggx_alpha(s.roughness);
        const GgxVisibleNormals<float, TypeParam> normals(s.wo, alpha);
        const auto wi = normals.sample(s.u);
        ASSERT_NEAR(length(wi), 1, 1.2e-6f);
        const float pdf = normals.pdf(wi);
        ASSERT_TRUE(pdf >= 0 && pdf <= 1.6e11f) << pdf;
        if (wi.z <= 0) continue;
        ASSERT_GT(pdf, 0);
        ++checked;
        const Frostbite<float> brdf(s.wo, {0, 0, 0}, {1, 1, 1}, s.roughness);
        const float weight = lit_specular(brdf)(wi) / pdf;
        const GgxReference lobe{broadcast<long double>(s.wo), alpha};
        const Point exact_wi = broadcast<long double>(wi);
        // Both densities of the quotient use the same half vector, so it adds no error.
        const long double density_ratio =
            std::is_same_v<TypeParam, BoundedCap> ? lobe.pdf(exact_wi) / lobe.bounded_pdf(exact_wi) : 1;
        const long double expected = lobe.masking_weight(exact_wi) * density_ratio;
        ASSERT_NEAR(weight / expected, 1, 2e-6L) << i;
        ASSERT_LE(weight, 1 + 2e-6f);
    }
    EXPECT_GT(checked, 200000);
}

TYPED_TEST(VisibleNormalsTest, NothingIsVisibleFromBelow) {
    for (const Direction<float>& wo :
         {Direction<float>{0, 0, -1}, {1, 0, 0}, {0, -1, 0}, {0.6f, 0, -0.8f}, {0, 0, 0}}) {
        const GgxVisibleNormals<float, TypeParam> normals(wo, 0.25f);
        const auto wi = normals.sample({0.3f, 0.6f});
        EXPECT_NEAR(length(wi), 1, 1e-6f);
        EXPECT_EQ(normals.pdf(wi), 0);
        EXPECT_EQ(normals.pdf({0, 0, 1}), 0);
        EXPECT_EQ(normals.pdf(-wo), 0);
    }
}

TYPED_TEST(VisibleNormalsTest, AlphaIsClamped) {
    const Direction<float> up{0, 0, 1};
    const auto peak = [&](float alpha) { return GgxVisibleNormals<float, TypeParam>(up, alpha).pdf(up); };
    for (const float alpha : {0.0f, -1.0f, 1e-5f, std::numeric_limits<float>::quiet_NaN()})
        EXPECT_EQ(peak(alpha), peak(nusselt::ggx_alpha(0.0f)));
    EXPECT_EQ(peak(std::numeric_limits<float>::infinity()), peak(1));
    EXPECT_NEAR(peak(0) * 4 * kPi * 1e-8L * (std::is_same_v<TypeParam, BoundedCap> ? 1 - 1e-8L : 1), 1,
                1e-6L);
}

TEST(GgxAlpha, IsTheClampedSquare) {
    EXPECT_EQ(nusselt::ggx_alpha(0.5), 0.25);
    EXPECT_EQ(nusselt::ggx_alpha(3.0f), 1);
    EXPECT_EQ(nusselt::ggx_alpha(-3.0f), 1e-4f);
    EXPECT_EQ(nusselt::ggx_alpha(std::numeric_limits<double>::quiet_NaN()), 1e-4);
}

/// First, one lane at a time has a hostile surface while its neighbours hold NaN; then all lanes have the same
/// surface.
template <class P, class Cap>
void expect_lanes_equal_scalars() {
    using T = nusselt::scalar_t<P>;
    using Technique = GgxVisibleNormals<T, Cap>;
    constexpr int kLanes = nusselt::RealTraits<P>::kLanes;
    HostileSurfaces surfaces(1e-30);
    const P nan(std::numeric_limits<T>::quiet_NaN());
    for (int i = 0; i < 20000; ++i) {
        const Hostile s = surfaces.next();
        const auto wo = broadcast<T>(s.wo);
        const auto u = broadcast<T>(s.u);
        const Technique scalar(wo, nusselt::ggx_alpha(T(s.roughness)));
        const int lane = i % kLanes;
        Direction<P> wos{nan, nan, nan};
        nusselt::Vec2<P> us{nan, nan};
        P roughness = nan;
        set_lane<T>(wos, lane, wo);
        set_lane<T>(us, lane, u);
        set_lane<T>(roughness, lane, T(s.roughness));
        const GgxVisibleNormals<P, Cap> per_lane(wos, nusselt::ggx_alpha(roughness));
        for (const auto& packed : {per_lane, GgxVisibleNormals<P, Cap>(scalar)}) {
            const auto wis = packed.sample(us);
            const auto wi = scalar.sample(u);
            const auto packed_wi = get_lane<T, Direction<T>>(wis, lane);
            ASSERT_EQ(packed_wi.x, wi.x);
            ASSERT_EQ(packed_wi.y, wi.y);
            ASSERT_EQ(packed_wi.z, wi.z);
            ASSERT_EQ(packed.pdf(wis).lane(lane), scalar.pdf(wi));
            ASSERT_EQ(packed.invert(wis).x.lane(lane), scalar.invert(wi).x);
            ASSERT_EQ(packed.invert(wis).y.lane(lane), scalar.invert(wi).y);
        }
    }
}

TYPED_TEST(VisibleNormalsTest, LanesEqualScalars) {
    expect_lanes_equal_scalars<nusselt::Pack<float, nusselt::kNativeLanes<float>>, TypeParam>();
    expect_lanes_equal_scalars<nusselt::Pack<double, nusselt::kNativeLanes<double>>, TypeParam>();
}

} // namespace
} // namespace nusselt_test
