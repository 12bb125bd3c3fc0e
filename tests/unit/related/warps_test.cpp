/// Solid angle sampling with warped random numbers (Hart et al. 2020): the contract of techniques, and mutants that break it.

#include <nusselt/simd/pack.h>

#include "lab/timing/scalar/lights.h"
#include "sampling/techniques.h"
#include "warp_checks.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>
#include <string>

namespace nusselt::warp_test {

namespace {

using nusselt_test::get_lane;
using nusselt_test::set_lane;

template <class T>
constexpr T kEpsilon = std::numeric_limits<T>::epsilon();

// A direction has an error of one rounding, which changes random numbers by the reciprocal of the light's angular width,
// about 100 for the small lights. Densities are up to 9 times steeper.
template <class Real>
constexpr double kInversionTolerance = 4000 * static_cast<double>(kEpsilon<Real>);

template <class Kind>
class WarpHartTest : public ::testing::Test {};

using Kinds = ::testing::Types<OfPolygon<PolygonBilinearWarpHart, PolygonSolidAngle, 4>,
                               OfPolygon<PolygonClippedBilinearWarpHart, PolygonClippedSolidAngle, 4>,
                               OfPolygon<PolygonBiquadraticWarpHart, PolygonSolidAngle, 4>,
                               OfPolygon<PolygonClippedBiquadraticWarpHart, PolygonClippedSolidAngle, 4>,
                               OfPolygon<PolygonBilinearWarpHart, PolygonSolidAngle, 7>,
                               OfPolygon<PolygonClippedBiquadraticWarpHart, PolygonClippedSolidAngle, 7>,
                               OfLine<LineLinearWarpHart, LineSolidAngle>,
                               OfLine<LineClippedLinearWarpHart, LineClippedSolidAngle>,
                               OfLine<LineQuadraticWarpHart, LineSolidAngle>,
                               OfLine<LineClippedQuadraticWarpHart, LineClippedSolidAngle>>;
struct KindNames {
    template <class Kind>
    static std::string GetName(int index) {
        static const char* const kNames[] = {"PolygonBilinear4",    "PolygonClippedBilinear4",
                                             "PolygonBiquadratic4", "PolygonClippedBiquadratic4",
                                             "PolygonBilinear7",    "PolygonClippedBiquadratic7",
                                             "LineLinear",          "LineClippedLinear",
                                             "LineQuadratic",       "LineClippedQuadratic"};
        return kNames[index];
    }
};
TYPED_TEST_SUITE(WarpHartTest, Kinds, KindNames);

TYPED_TEST(WarpHartTest, DensityIntegratesToOne) {
    for (const Corners& light : TypeParam::lights())
        EXPECT_LE(normalisation_error<TypeParam>(light, 64), 2e-4) << light[0].x << " " << light[0].z;
}

TYPED_TEST(WarpHartTest, EstimatesProjectedSolidAngle) {
    // Weights grow without bound next to vertex 0 where it is on the horizon, so that quadrature converges slowly.
    constexpr double kTolerance = 6e-3;
    for (const Corners& light : TypeParam::lights()) {
        const double coarse = estimation_error<TypeParam>(light, TypeParam::kIsLine ? 4096 : 64);
        EXPECT_LE(coarse, kTolerance) << light[0].x << " " << light[0].z;
        const double fine = estimation_error<TypeParam>(light, TypeParam::kIsLine ? 65536 : 256);
        EXPECT_LE(fine, std::max(coarse / 2, 1e-4)) << light[0].x << " " << light[0].z;
    }
}

TYPED_TEST(WarpHartTest, SamplesHaveTheirDensity) {
    for (const Corners& light : TypeParam::lights())
        EXPECT_LE(jacobian_error<TypeParam>(light), 1e-6) << light[0].x << " " << light[0].z;
}

TYPED_TEST(WarpHartTest, InvertReturnsTheRandomNumbers) {
    for (const Corners& light : TypeParam::lights()) {
        const auto expect = [&]<class Real>(Real) {
            EXPECT_LE((inversion_error<TypeParam, Real>(light)), kInversionTolerance<Real>)
                << light[0].x << " " << light[0].z;
            EXPECT_LE((pdf_error<TypeParam, Real>(light)), 4 * kInversionTolerance<Real>)
                << light[0].x << " " << light[0].z;
        };
        expect(0.0f);
        expect(0.0);
        expect(0.0L);
    }
}

/// All that a technique returns.
template <class Kind, class Real>
struct Outputs {
    LightSample<Real> sample;
    Real pdf, measure;
    typename Kind::template Random<Real> inverse;
};
template <class Kind, class Real>
Outputs<Kind, Real> outputs_of(const typename Kind::template Technique<Real>& technique,
                               const typename Kind::template Random<Real>& u) {
    const LightSample<Real> sample = technique.sample(u);
    return {sample, technique.pdf(sample.wi), technique.measure(), technique.invert(sample.wi)};
}

/// Whether all numbers are equal.
template <class Struct>
bool same_numbers(const Struct& a, const Struct& b) {
    constexpr std::size_t kCount = sizeof(Struct) / sizeof(float);
    float x[kCount], y[kCount];
    std::memcpy(x, &a, sizeof x);
    std::memcpy(y, &b, sizeof y);
    return std::equal(x, x + kCount, y);
}

TYPED_TEST(WarpHartTest, PacksComputeWhatScalarsCompute) {
    using Kind = TypeParam;
    constexpr int kLanes = 8;
    using Real = Pack<float, kLanes>;
    using Scalars = Outputs<Kind, float>;
    std::mt19937 generator(5);
    std::uniform_real_distribution<float> uniform(0, 1);
    for (int group = 0; group < 60; ++group) {
        typename Kind::template Light<Real> lights;
        typename Kind::template Random<Real> us;
        std::vector<typename Kind::template Light<float>> light;
        std::vector<typename Kind::template Random<float>> u;
        for (int lane = 0; lane < kLanes; ++lane) {
            const lab::LightClass& c = lane % 3 == 0   ? lab::kCrossing
                                       : lane % 3 == 1 ? lab::kDecentral
                                                       : lab::kCentral;
            const auto corners = lab::random_light(c, Kind::kRandomCorners, generator);
            light.push_back(
                Kind::template make<float>(Corners(corners.begin(), corners.begin() + Kind::kRandomCorners)));
            const float x = uniform(generator), y = uniform(generator);
            u.push_back(random_numbers<Kind, float>(x, y));
            set_lane<float>(lights, lane, light.back());
            set_lane<float>(us, lane, u.back());
        }
        const typename Kind::template Technique<Real> packs(lights);
        const typename Kind::template Technique<float> single(light[0]);
        const typename Kind::template Technique<Real> copies(single);
        const auto of_lights = outputs_of<Kind, Real>(packs, us),
                   of_copies = outputs_of<Kind, Real>(copies, us);
        for (int lane = 0; lane < kLanes; ++lane) {
            const auto i = static_cast<std::size_t>(lane);
            const typename Kind::template Technique<float> scalar(light[i]);
            EXPECT_TRUE(same_numbers(get_lane<float, Scalars>(of_lights, lane),
                                     outputs_of<Kind, float>(scalar, u[i])));
            EXPECT_TRUE(same_numbers(get_lane<float, Scalars>(of_copies, lane),
                                     outputs_of<Kind, float>(single, u[i])));
        }
    }
}

TYPED_TEST(WarpHartTest, NeverFails) {
    using Kind = TypeParam;
    const Corners unit = {{0.5, 0.2, 1}, {1.5, 0.3, 1}, {1.4, 1.2, 1}, {0.4, 1, 1}};
    std::vector<Corners> lights = {
        {{1, 0, 1}, {1, 0, 1}, {1, 0, 1}},          // no extent
        {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},          // contains the shading point
        {{1, 0, 0}, {2, 1, 0}, {1, 2, 0}},          // on the horizon
        {{1, 0, -1}, {2, 1, -1}, {1, 2, -1}},       // below the horizon
        {{1, 0, 1e-30}, {1, 1, 0}, {2, 2, -1e-30}}, // almost on the horizon
        {{0, 0, 1}, {0, 0, 2}, {0, 0, 3}},          // towards the shading point
    };
    for (const double scale : {1e-25, 1e-19, 1e-12, 1e12, 1e18, 1e20}) {
        lights.push_back(unit);
        for (auto& v : lights.back()) v = scale * v;
    }
    for (const Corners& corners : lights) {
        const Corners used(corners.begin(), corners.begin() + (Kind::kIsLine ? 2 : 3));
        const auto light = Kind::template make<float>(used);
        const typename Kind::template Technique<float> technique(light);
        for (const float x : {0.0f, 1e-30f, 0.3f, 1 - kEpsilon<float> / 2}) {
            for (const float y : {0.0f, 1e-30f, 0.3f, 1 - kEpsilon<float> / 2}) {
                const auto out = outputs_of<Kind, float>(technique, random_numbers<Kind, float>(x, y));
                EXPECT_TRUE(is_finite(dot(out.sample.wi, out.sample.wi)));
                EXPECT_TRUE(is_finite(out.sample.pdf) && out.sample.pdf >= 0);
                EXPECT_TRUE(is_finite(out.pdf) && out.pdf >= 0);
                EXPECT_TRUE(is_finite(out.measure) && out.measure >= 0);
                if constexpr (Kind::kIsLine) {
                    EXPECT_TRUE(out.inverse >= 0 && out.inverse < 1);
                } else {
                    EXPECT_TRUE(out.inverse.x >= 0 && out.inverse.x < 1);
                    EXPECT_TRUE(out.inverse.y >= 0 && out.inverse.y < 1);
                }
            }
        }
    }
}

// Deliberately wrong warps.

template <template <class> class Warp>
struct Wrong {
    /// Warps, but keeps the density of the base.
    template <class Real>
    struct Density : Warp<Real> {
        explicit Density(const Warp<Real>& right) : Warp<Real>(right) {}
        template <class... Arguments>
        static Density fit(const Arguments&... arguments) {
            return Density(Warp<Real>::fit(arguments...));
        }
        template <class Point>
        Real density(const Point&) const {
            return Real(1);
        }
    };
    /// Has the density without the warp.
    template <class Real>
    struct Sample : Warp<Real> {
        explicit Sample(const Warp<Real>& right) : Warp<Real>(right) {}
        template <class... Arguments>
        static Sample fit(const Arguments&... arguments) {
            return Sample(Warp<Real>::fit(arguments...));
        }
        template <class Point>
        Point sample(const Point& u) const {
            return u;
        }
    };
    /// Is not normalised.
    template <class Real>
    struct Scale : Warp<Real> {
        explicit Scale(const Warp<Real>& right) : Warp<Real>(right) {}
        template <class... Arguments>
        static Scale fit(const Arguments&... arguments) {
            return Scale(Warp<Real>::fit(arguments...));
        }
        template <class Point>
        Real density(const Point& x) const {
            return Real(1.01) * Warp<Real>::density(x);
        }
    };
};

template <template <class> class Warp>
struct OnPolygons {
    using Kind = OfPolygon<PolygonBilinearWarpHart, PolygonSolidAngle, 4>;
    template <class Real>
    using Technique = PolygonWarpHart<Real, 4, Warp, PolygonSolidAngle>;
    static Corners light() { return polygons()[1]; }
};
template <template <class> class Warp>
struct OnLines {
    using Kind = OfLine<LineLinearWarpHart, LineSolidAngle>;
    template <class Real>
    using Technique = LineWarpHart<Real, Warp, LineSolidAngle>;
    static Corners light() { return lines()[2]; }
};

/// The checks reject the mutants and accept the original.
template <template <template <class> class> class On, template <class> class Warp>
void expect_that_mutants_fail() {
    using Right = On<Warp>;
    using Density = On<Wrong<Warp>::template Density>;
    using Sample = On<Wrong<Warp>::template Sample>;
    using Scale = On<Wrong<Warp>::template Scale>;
    using Kind = typename Right::Kind;
    const Corners light = Right::light();
    EXPECT_LE((jacobian_error<Kind, Right::template Technique>(light)), 1e-6);
    EXPECT_GE((jacobian_error<Kind, Density::template Technique>(light)), 1e-2);
    EXPECT_GE((jacobian_error<Kind, Sample::template Technique>(light)), 1e-2);
    EXPECT_LE((inversion_error<Kind, double, Right::template Technique>(light)), kInversionTolerance<double>);
    EXPECT_GE((inversion_error<Kind, double, Sample::template Technique>(light)), 1e-3);
    EXPECT_LE((estimation_error<Kind, Right::template Technique>(light, 128)), 1e-4);
    EXPECT_GE((estimation_error<Kind, Density::template Technique>(light, 128)), 1e-3);
    EXPECT_LE((normalisation_error<Kind, Right::template Technique>(light, 128)), 2e-4);
    EXPECT_GE((normalisation_error<Kind, Scale::template Technique>(light, 128)), 5e-3);
}

TEST(WarpHartMutants, AreRejected) {
    expect_that_mutants_fail<OnPolygons, hart::BilinearWarp>();
    expect_that_mutants_fail<OnPolygons, hart::BiquadraticWarp>();
    expect_that_mutants_fail<OnLines, hart::LinearWarp>();
    expect_that_mutants_fail<OnLines, hart::QuadraticWarp>();
}

} // namespace

} // namespace nusselt::warp_test
