/// Tests of the BRDFs: textbook formulas in long double, values in closed form, energy, reciprocity and hostile
/// input.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <type_traits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/bsdf/frostbite.h>
#include <nusselt/bsdf/lambert.h>
#include <nusselt/simd/pack.h>

namespace {

using nusselt::broadcast;
using nusselt::dot;
using nusselt::Frostbite;
using nusselt::kNativeLanes;
using nusselt::kPi;
using nusselt::Lambert;
using nusselt::Pack;
using nusselt::RealTraits;
using nusselt::scalar_t;
using nusselt::Vec3;

template <class Real>
struct Surface {
    Vec3<Real> wo, wi;
    Vec3<Real> albedo, f0;
    Real roughness;

    Frostbite<Real> frostbite() const { return {wo, albedo, f0, roughness}; }
};

struct Reference {
    long double diffuse, specular;
};

/// The textbook's formulas for the red channel. Directions in float are not unit vectors in long double. The half
/// vector is therefore defined by their sum, and the cosine between it and either direction is half the length of
/// that sum.
Reference reference(const Surface<long double>& s) {
    if (!(s.wo.z > 0 && s.wi.z > 0)) return {0, 0};
    const Vec3<long double> sum = s.wo + s.wi;
    const long double length = std::sqrt(dot(sum, sum));
    const long double n_h = sum.z / length;
    const long double l_h = std::min(length / 2, 1.0L);
    const auto schlick = [](long double f0, long double f90, long double cosine) {
        return f0 + (f90 - f0) * std::pow(std::max(1 - cosine, 0.0L), 5);
    };
    const long double f90 = 0.5L * s.roughness + 2 * s.roughness * l_h * l_h;
    const long double energy = 1 + s.roughness * (1 / 1.51L - 1);
    const long double diffuse =
        s.albedo.x / kPi<long double> * energy * schlick(1, f90, s.wi.z) * schlick(1, f90, s.wo.z);

    const long double alpha = std::max(s.roughness * s.roughness, 1e-4L);
    const long double a2 = alpha * alpha;
    const long double d = a2 / (kPi<long double> * std::pow(n_h * n_h * (a2 - 1) + 1, 2));
    const long double visibility = 0.5L / (s.wi.z * std::sqrt(s.wo.z * s.wo.z * (1 - a2) + a2) +
                                           s.wo.z * std::sqrt(s.wi.z * s.wi.z * (1 - a2) + a2));
    return {diffuse, d * visibility * schlick(s.f0.x, 1, l_h)};
}

Vec3<double> direction(double cosine, double azimuth) {
    const double sine = std::sqrt(std::max(1 - cosine * cosine, 0.0));
    return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}

template <class Real>
Vec3<Real> grey(Real value) {
    return {value, value, value};
}

/// Extreme surfaces: rough, smooth and clamped ones; normal and grazing directions; mirror directions, nearly
/// opposite directions, and some below the horizon.
class HostileSurfaces {
public:
    explicit HostileSurfaces(double smallest_cosine) : smallest_cosine_(smallest_cosine) {}

    Surface<float> next() {
        const double azimuth = number(0, 6.3);
        const Vec3<double> wo = direction(cosine(), azimuth);
        Vec3<double> wi = direction(cosine(), number(0, 6.3));
        const double nudge = std::pow(10.0, number(-9, -0.5));
        switch (choice(5)) {
        case 0:
            wi = {-wo.x, -wo.y, wo.z};
            break;
        case 1:
            wi = unit({-wo.x + nudge * number(-1, 1), -wo.y + nudge * number(-1, 1), wo.z});
            break;
        case 2:
            wi = unit({-wo.x, -wo.y, wo.z * nudge});
            break;
        case 3:
            wi = wo;
            break;
        default:
            break;
        }
        const float special[] = {0.0f, 1.0f, 0.01f, 1e-3f};
        const float roughness = choice(2) == 0 ? special[choice(4)] : static_cast<float>(number(0, 1));
        return {broadcast<float>(wo),
                broadcast<float>(wi),
                {static_cast<float>(number(0, 1)), 0.0f, 1.0f},
                {static_cast<float>(number(0.02, 1)), 0.0f, 1.0f},
                roughness};
    }

    std::uint32_t choice(std::uint32_t count) { return static_cast<std::uint32_t>(generator_()) % count; }

private:
    double number(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(generator_);
    }
    double cosine() {
        switch (choice(4)) {
        case 0:
            return 1;
        case 1:
            return std::pow(10.0, number(std::log10(smallest_cosine_), 0));
        default:
            return number(smallest_cosine_, 1);
        }
    }
    static Vec3<double> unit(const Vec3<double>& a) { return nusselt::normalize(a); }

    double smallest_cosine_;
    std::mt19937 generator_{17};
};

template <class Real>
Surface<Real> in_precision(const Surface<float>& s) {
    return {broadcast<Real>(s.wo), broadcast<Real>(s.wi), broadcast<Real>(s.albedo), broadcast<Real>(s.f0),
            Real(s.roughness)};
}

TEST(Lambert, IsAlbedoOverPiAboveTheHorizon) {
    const Lambert<double> lambert{{0.25, 0.5, 1}};
    EXPECT_DOUBLE_EQ(lambert.eval({0, 0.6, 0.8}).x, 0.25 / 3.14159265358979324);
    EXPECT_DOUBLE_EQ(lambert.eval({0, 0.6, 0.8}).z, 1 / 3.14159265358979324);
    EXPECT_EQ(lambert.eval({1, 0, 0}).y, 0);
    EXPECT_EQ(lambert.eval({0, 0.6, -0.8}).y, 0);
}

template <class Real>
class FrostbiteScalar : public testing::Test {};
using Scalars = testing::Types<float, double, long double>;
TYPED_TEST_SUITE(FrostbiteScalar, Scalars);

TYPED_TEST(FrostbiteScalar, ValuesAtNormalIncidence) {
    using Real = TypeParam;
    const Real tolerance = 8 * std::numeric_limits<Real>::epsilon();
    const Vec3<Real> n{0, 0, 1};
    for (const Real r : {Real(0.05L), Real(0.3L), Real(1)}) {
        const Frostbite<Real> brdf(n, {Real(0.5L), 0, 1}, {Real(0.25L), 0, 1}, r);
        const Real peak = 1 / (4 * kPi<Real> * r * r * r * r);
        EXPECT_NEAR(brdf.eval_specular(n).x / (peak / 4), 1, tolerance);
        EXPECT_NEAR(brdf.eval_specular(n).z / peak, 1, tolerance);
        EXPECT_EQ(brdf.eval_specular(n).y, 0);
        const Real energy = 1 - r + r / Real(1.51L);
        EXPECT_NEAR(brdf.eval_diffuse(n).x, energy / (2 * kPi<Real>), tolerance);
    }
}

// Roughness 1: D = 1 / pi everywhere, visibility 1 / (2 (n.l + n.v)), and F90 = 5/2 for the retroreflection.
TYPED_TEST(FrostbiteScalar, ValuesOfRetroreflection) {
    using Real = TypeParam;
    const Real tolerance = 8 * std::numeric_limits<Real>::epsilon();
    const Vec3<Real> w{0, std::sqrt(Real(3)) / 2, Real(0.5L)};
    const Frostbite<Real> brdf(w, grey(Real(1)), grey(Real(0.5L)), 1);
    EXPECT_NEAR(brdf.eval_specular(w).x, Real(0.25L) / kPi<Real>, tolerance);
    const Real scatter = 1 + Real(1.5L) / 32;
    EXPECT_NEAR(brdf.eval_diffuse(w).x, scatter * scatter / (Real(1.51L) * kPi<Real>), tolerance);
}

// The half vector is the normal: D = 1 / (pi alpha^2), visibility 1 / (2 sqrt(1 + alpha^2)).
TYPED_TEST(FrostbiteScalar, ValuesOfMirrorDirectionsAt45Degrees) {
    using Real = TypeParam;
    const Real root = std::sqrt(Real(0.5L));
    const Real alpha = Real(0.25L);
    const Frostbite<Real> brdf({root, 0, root}, grey(Real(0)), grey(Real(0.04L)), Real(0.5L));
    const Real fresnel = Real(0.04L) + Real(0.96L) * std::pow(1 - root, Real(5));
    const Real expected = fresnel / (kPi<Real> * alpha * alpha * 2 * std::sqrt(1 + alpha * alpha));
    EXPECT_NEAR(brdf.eval({-root, 0, root}).x / expected, 1, 16 * std::numeric_limits<Real>::epsilon());
}

TYPED_TEST(FrostbiteScalar, NothingBelowTheHorizon) {
    using Real = TypeParam;
    const auto expect_zero = [](const Vec3<Real>& wo, const Vec3<Real>& wi) {
        const Vec3<Real> f = Frostbite<Real>(wo, grey(Real(1)), grey(Real(1)), Real(0.5L)).eval(wi);
        EXPECT_EQ(f.x, 0);
        EXPECT_EQ(f.y, 0);
        EXPECT_EQ(f.z, 0);
    };
    const Vec3<Real> up{0, 0, 1}, down{0, 0, -1}, horizon{1, 0, 0}, opposite{-1, 0, 0};
    for (const auto& w : {down, horizon}) {
        expect_zero(up, w);
        expect_zero(w, up);
    }
    // The half vector has length zero: the directions are opposite, along the plane and normal to it.
    expect_zero(horizon, opposite);
    expect_zero(up, down);
}

TYPED_TEST(FrostbiteScalar, RoughnessIsClamped) {
    using Real = TypeParam;
    const Vec3<Real> n{0, 0, 1};
    const auto at = [&](Real r) { return Frostbite<Real>(n, grey(Real(1)), grey(Real(1)), r).eval(n).x; };
    EXPECT_EQ(at(-1), at(0));
    EXPECT_EQ(at(2), at(1));
    EXPECT_EQ(at(std::numeric_limits<Real>::quiet_NaN()), at(0));
    EXPECT_NEAR(at(0) * 4 * kPi<Real> * Real(1e-8L), 1, 1e-6);
}

/// Largest errors over hostile surfaces: relative for the specular part, in units of albedo / pi for the diffuse
/// part.
template <class Real>
Reference largest_errors() {
    HostileSurfaces surfaces(1e-12);
    Reference largest{0, 0};
    for (int i = 0; i < 200000; ++i) {
        const Surface<float> s = surfaces.next();
        const Reference expected = reference(in_precision<long double>(s));
        const Surface<Real> surface = in_precision<Real>(s);
        const Frostbite<Real> brdf = surface.frostbite();
        const auto diffuse = static_cast<long double>(brdf.eval_diffuse(surface.wi).x);
        const auto specular = static_cast<long double>(brdf.eval_specular(surface.wi).x);
        const long double unit = std::max(static_cast<long double>(s.albedo.x), 1e-3L) / kPi<long double>;
        largest.diffuse = std::max(largest.diffuse, std::fabs(diffuse - expected.diffuse) / unit);
        if (expected.specular > 0)
            largest.specular = std::max(largest.specular, std::fabs(specular / expected.specular - 1));
    }
    return largest;
}

/// The two factors, each at most 5/2, carry about three roundings each.
constexpr long double kDiffuseErrorBudget = 20;

TEST(FrostbiteAccuracy, Float) {
    const Reference errors = largest_errors<float>();
    EXPECT_LT(errors.specular, 2e-6L);
    EXPECT_LT(errors.diffuse, kDiffuseErrorBudget * std::numeric_limits<float>::epsilon());
}

// The reference itself loses 1e-19 / alpha^2 where (n.h)^2 (alpha^2 - 1) + 1 cancels.
TEST(FrostbiteAccuracy, Double) {
    const Reference errors = largest_errors<double>();
    EXPECT_LT(errors.specular, 1e-10L);
    EXPECT_LT(errors.diffuse, kDiffuseErrorBudget * std::numeric_limits<double>::epsilon());
}

TYPED_TEST(FrostbiteScalar, IsExactlyReciprocal) {
    using Real = TypeParam;
    HostileSurfaces surfaces(1e-30);
    for (int i = 0; i < 100000; ++i) {
        Surface<Real> s = in_precision<Real>(surfaces.next());
        const Vec3<Real> specular = s.frostbite().eval_specular(s.wi);
        const Vec3<Real> diffuse = s.frostbite().eval_diffuse(s.wi);
        std::swap(s.wo, s.wi);
        ASSERT_EQ(s.frostbite().eval_specular(s.wi).x, specular.x);
        ASSERT_EQ(s.frostbite().eval_diffuse(s.wi).x, diffuse.x);
    }
}

TEST(Frostbite, PartsAddUp) {
    HostileSurfaces surfaces(1e-3);
    for (int i = 0; i < 1000; ++i) {
        const Surface<float> s = surfaces.next();
        const Frostbite<float> brdf = s.frostbite();
        const auto parts = brdf.eval_components(s.wi);
        for (const auto channel : {&Vec3<float>::x, &Vec3<float>::y, &Vec3<float>::z}) {
            ASSERT_EQ(parts.diffuse.*channel, brdf.eval_diffuse(s.wi).*channel);
            ASSERT_EQ(parts.specular.*channel, brdf.eval_specular(s.wi).*channel);
            ASSERT_EQ(brdf.eval(s.wi).*channel, parts.diffuse.*channel + parts.specular.*channel);
        }
    }
}

TEST(Lambert, HasNoSpecularPart) {
    const Lambert<float> lambert{{0.3f, 0.5f, 1}};
    for (const float z : {1.0f, 0.6f, 0.0f, -0.6f}) {
        const Vec3<float> wi{0, std::sqrt(1 - z * z), z};
        const auto parts = lambert.eval_components(wi);
        EXPECT_EQ(parts.diffuse.x, lambert.eval(wi).x);
        EXPECT_EQ(parts.diffuse.y, lambert.eval(wi).y);
        EXPECT_EQ(parts.diffuse.z, lambert.eval(wi).z);
        EXPECT_EQ(dot(parts.specular, parts.specular), 0);
    }
}

// The cosines go down to denormal numbers.
TEST(Frostbite, StaysWithinItsBoundsForAMillionHostileSurfaces) {
    HostileSurfaces surfaces(1e-45);
    for (int i = 0; i < 1000000; ++i) {
        Surface<float> s = surfaces.next();
        if (surfaces.choice(16) == 0) s.wi.z = -s.wi.z;
        if (surfaces.choice(16) == 0) s.wo.z = 0;
        const Frostbite<float> brdf = s.frostbite();
        const float diffuse = brdf.eval_diffuse(s.wi).z;
        const float specular = brdf.eval_specular(s.wi).z;
        ASSERT_TRUE(0 <= diffuse && diffuse <= 1.32f) << diffuse;
        ASSERT_TRUE(0 <= specular && specular <= 1.7e27f) << specular;
        ASSERT_LE(specular * s.wi.z, 1.6e11f);
        const bool lit = s.wi.z > 0 && s.wo.z > 0;
        ASSERT_TRUE(lit || brdf.eval(s.wi).z == 0);
    }
}

/// Albedo of the specular part, by the midpoint rule over the random numbers that sample half vectors with density D
/// n.h.
double specular_albedo(const Frostbite<double>& brdf, const Vec3<double>& wo, double alpha) {
    constexpr int kInclinations = 400;
    constexpr int kAzimuths = 128;
    double sum = 0;
    for (int i = 0; i < kInclinations; ++i) {
        const double u = (i + 0.5) / kInclinations;
        const double tan2 = alpha * alpha * u / (1 - u);
        const double n_h = 1 / std::sqrt(1 + tan2);
        const double root = 1 + tan2 / (alpha * alpha);
        const double d = 1 / (kPi<double> * alpha * alpha * n_h * n_h * n_h * n_h * root * root);
        for (int j = 0; j < kAzimuths; ++j) {
            const Vec3<double> h = direction(n_h, kPi<double> * (j + 0.5) / kAzimuths);
            const double o_h = dot(wo, h);
            if (o_h <= 0) continue;
            const Vec3<double> wi = 2 * o_h * h - wo;
            sum += brdf.eval_specular(wi).x * std::max(wi.z, 0.0) * 4 * o_h / (d * n_h);
        }
    }
    return sum / (kInclinations * kAzimuths);
}

/// Albedo of any smooth BRDF, by the midpoint rule over the random numbers that sample directions with density cosine
/// / pi.
template <class Brdf>
double smooth_albedo(Brdf eval) {
    constexpr int kInclinations = 64;
    constexpr int kAzimuths = 32;
    double sum = 0;
    for (int i = 0; i < kInclinations; ++i)
        for (int j = 0; j < kAzimuths; ++j)
            sum += eval(direction(std::sqrt((i + 0.5) / kInclinations), kPi<double> * (j + 0.5) / kAzimuths));
    return kPi<double> * sum / (kInclinations * kAzimuths);
}

/// The diffuse lobe before its renormalisation: F90 starts at 1/2 for every roughness, and the energy factor is
/// missing.
double original_disney(const Vec3<double>& wo, const Vec3<double>& wi, double roughness) {
    const Vec3<double> sum = wo + wi;
    const double f90 = 0.5 + 2 * roughness * 0.25 * dot(sum, sum);
    return (1 + (f90 - 1) * std::pow(1 - wi.z, 5)) * (1 + (f90 - 1) * std::pow(1 - wo.z, 5)) / kPi<double>;
}

struct AlbedoRange {
    double low = 1e9, high = 0;
    void add(double albedo) {
        low = std::min(low, albedo);
        high = std::max(high, albedo);
    }
};

TEST(FrostbiteAlbedo, IsAtMostOneButForDielectricsAtGrazingAngles) {
    AlbedoRange dielectric, grazing, metal, original;
    for (const double roughness : {0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.85, 1.0}) {
        const double alpha = roughness * roughness;
        for (const double inclination : {0.0, 0.3, 0.7, 1.0, 1.1, 1.2, 1.35, 1.45, 1.52, 1.56, 1.5705}) {
            const Vec3<double> wo = direction(std::cos(inclination), 0);
            const Frostbite<double> coated(wo, grey(1.0), grey(0.04), roughness);
            const double specular = specular_albedo(coated, wo, alpha);
            const double diffuse = smooth_albedo([&](auto wi) { return coated.eval_diffuse(wi).x; });
            (inclination > 1.2 ? grazing : dielectric).add(diffuse + specular);
            for (const double f0 : {0.2, 0.5, 0.9, 1.0}) {
                const Frostbite<double> bare(wo, grey(0.0), grey(f0), roughness);
                const double albedo = specular_albedo(bare, wo, alpha);
                metal.add(albedo);
                EXPECT_GT(albedo, specular) << f0;
            }
            if (inclination <= 1.2)
                original.add(specular +
                             smooth_albedo([&](auto wi) { return original_disney(wo, wi, roughness); }));
        }
    }
    EXPECT_LE(dielectric.high, 1);
    EXPECT_GT(dielectric.low, 0.6);
    // This is a property of the model: towards the horizon at roughness 1, the lobes add up to 1.117.
    EXPECT_LE(grazing.high, 1.12);
    EXPECT_GT(grazing.high, 1.1);
    EXPECT_LE(metal.high, 1);
    EXPECT_GT(metal.high, 0.99);
    // The renormalisation is needed, and this test detects its absence.
    EXPECT_GT(original.low, 1);
    EXPECT_GT(original.high, 1.1);
}

/// Covers all inclinations down to the horizon, where the albedo goes to zero and so must the estimate.
TEST(FrostbiteAlbedo, OfTheDiffusePartIsEstimatedWithin5Percent) {
    double largest = 0;
    for (int i = 0; i <= 20; ++i) {
        const double roughness = i / 20.0;
        for (int k = 0; k <= 40; ++k) {
            const Vec3<double> wo = direction(std::max(std::cos(kPi<double> / 2 * k / 40), 1e-4), 0);
            const Frostbite<double> brdf(wo, {1, 0.5, 0}, grey(0.04), roughness);
            const double albedo = smooth_albedo([&](auto wi) { return brdf.eval_diffuse(wi).x; });
            largest = std::max(largest, std::fabs(brdf.diffuse_albedo().x / albedo - 1));
            EXPECT_DOUBLE_EQ(brdf.diffuse_albedo().y, brdf.diffuse_albedo().x / 2);
            EXPECT_EQ(brdf.diffuse_albedo().z, 0);
        }
    }
    EXPECT_LT(largest, 0.05);
    const Frostbite<double> horizontal({1, 0, 0}, grey(1.0), grey(0.04), 0);
    EXPECT_EQ(horizontal.diffuse_albedo().x, 0);
}

/// One lane at a time computes a hostile surface while its neighbours hold NaN, infinities or zeros.
template <class P>
void expect_lanes_equal_scalars() {
    using Scalar = scalar_t<P>;
    constexpr int kLanes = RealTraits<P>::kLanes;
    HostileSurfaces surfaces(1e-40);
    const Scalar nan = std::numeric_limits<Scalar>::quiet_NaN();
    const Scalar infinity = std::numeric_limits<Scalar>::infinity();
    for (int i = 0; i < 20000; ++i) {
        const int lane = i % kLanes;
        const Surface<Scalar> s = in_precision<Scalar>(surfaces.next());
        Surface<P> lanes = {grey(P(nan)), grey(P(infinity)), grey(P(nan)), grey(P(-infinity)), P(nan)};
        if (i % 2 == 0) lanes = {grey(P(0)), grey(P(0)), grey(P(infinity)), grey(P(0)), P(infinity)};
        const auto put = [&](Vec3<P>& to, const Vec3<Scalar>& from) {
            to.x.set_lane(lane, from.x);
            to.y.set_lane(lane, from.y);
            to.z.set_lane(lane, from.z);
        };
        put(lanes.wo, s.wo);
        put(lanes.wi, s.wi);
        put(lanes.albedo, s.albedo);
        put(lanes.f0, s.f0);
        lanes.roughness.set_lane(lane, s.roughness);
        const Vec3<P> packed = lanes.frostbite().eval(lanes.wi);
        const Vec3<Scalar> scalar = s.frostbite().eval(s.wi);
        ASSERT_EQ(packed.x.lane(lane), scalar.x);
        ASSERT_EQ(packed.y.lane(lane), scalar.y);
        ASSERT_EQ(packed.z.lane(lane), scalar.z);
        const Vec3<P> lambert = Lambert<P>{lanes.albedo}.eval(lanes.wi);
        ASSERT_EQ(lambert.x.lane(lane), Lambert<Scalar>{s.albedo}.eval(s.wi).x);
    }
}

TEST(FrostbitePack, LanesEqualScalars) {
    expect_lanes_equal_scalars<Pack<float, kNativeLanes<float>>>();
    expect_lanes_equal_scalars<Pack<double, kNativeLanes<double>>>();
}

} // namespace
