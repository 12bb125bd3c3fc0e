/// Published methods for polygons: the contract of techniques, on lights for which they are made, and what they fail on.

#include <nusselt/related/polygon_projected_solid_angle_arvo.h>
#include <nusselt/related/polygon_projected_solid_angle_bisection.h>
#include <nusselt/related/polygon_projected_solid_angle_peters.h>
#include <nusselt/related/polygon_solid_angle_arvo.h>
#include <nusselt/related/polygon_subdivision_urena.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

#include "geometry/adaptive_quadrature.h"
#include "related/random_polygons.h"

namespace nusselt_test {
namespace {

using nusselt::Pack;
using nusselt::Vec2;
using nusselt::Vec3;
using nusselt::lab::kCentral;
using nusselt::lab::kDecentral;
using nusselt::lab::LightClass;

constexpr int kCorners = 5;
template <class T>
using Polygons = std::vector<nusselt::ConvexPolygon<T, kCorners>>;

constexpr LightClass kClasses[] = {kDecentral, kCentral, kClipped};

struct SolidAngleArvo {
    template <class Real>
    using Technique = nusselt::PolygonSolidAngleArvo<Real, kCorners>;
    static constexpr bool kIsClipped = false;
    static constexpr double kIterationError = 0; ///< that 99 % of samples do not exceed, in random numbers
};
struct ProjectedPeters {
    template <class Real>
    using Technique = nusselt::PolygonProjectedSolidAnglePeters<Real, kCorners>;
    static constexpr bool kIsClipped = true;
    static constexpr double kIterationError = 1e-8;
};
struct ProjectedArvo {
    template <class Real>
    using Technique = nusselt::PolygonProjectedSolidAngleArvo<Real, kCorners>;
    static constexpr bool kIsClipped = true;
    static constexpr double kIterationError = 1e-2;
};
struct ConvergedArvo : ProjectedArvo {
    template <class Real>
    using Technique = nusselt::PolygonProjectedSolidAngleArvo<Real, kCorners, 12>;
    static constexpr double kIterationError = 0;
};
struct Bisection {
    template <class Real>
    using Technique = nusselt::PolygonProjectedSolidAngleBisection<Real, kCorners>;
    static constexpr bool kIsClipped = true;
    static constexpr double kIterationError = 1e-2;
};
struct ConvergedBisection : Bisection {
    template <class Real>
    using Technique = nusselt::PolygonProjectedSolidAngleBisection<Real, kCorners, 64>;
    static constexpr double kIterationError = 0;
};
struct SubdivisionUrena {
    template <class Real>
    using Technique = nusselt::PolygonSubdivisionUrena<Real, kCorners>;
    static constexpr bool kIsClipped = true;
    static constexpr double kIterationError = 0;
};

/// Random numbers away from 0 and 1.
template <class T>
std::vector<Vec2<T>> random_numbers(int count) {
    std::mt19937 generator(11);
    std::uniform_real_distribution<T> uniform(T(0.01), T(0.99));
    std::vector<Vec2<T>> result;
    for (int i = 0; i < count; ++i) {
        const T x = uniform(generator);
        result.push_back({x, uniform(generator)});
    }
    return result;
}

template <class Kind, class T>
Polygon lit_part(const nusselt::ConvexPolygon<T, kCorners>& light) {
    const Polygon whole = vertices_of(light);
    return Kind::kIsClipped ? above_horizon(whole) : whole;
}

/// Relative errors of measures.
template <class Kind, class T>
Errors measure_errors(const LightClass& light_class) {
    Errors errors;
    for (const auto& light : random_polygons<T, kCorners>(light_class, 200)) {
        const typename Kind::template Technique<T> technique(light);
        const Polygon part = lit_part<Kind>(light);
        const long double expected = Kind::kIsClipped ? lambert(part) : girard(part);
        errors.add(technique.measure() / expected - 1);
    }
    return errors;
}

/// The errors of invert(sample(u)).
template <class Kind, class T>
Errors inversion_errors(const LightClass& light_class) {
    Errors errors;
    const auto u = random_numbers<T>(16);
    for (const auto& light : random_polygons<T, kCorners>(light_class, 200)) {
        const typename Kind::template Technique<T> technique(light);
        for (const auto& x : u) {
            const auto back = technique.invert(technique.sample(x).wi);
            errors.add(std::max(std::fabs(back.x - x.x), std::fabs(back.y - x.y)));
        }
    }
    return errors;
}

/// Errors of the density, as the reciprocal of the Jacobian of the map by central differences.
template <class Kind>
Errors jacobian_errors(const LightClass& light_class) {
    constexpr double kStep = 1e-5;
    Errors errors;
    for (const auto& light : random_polygons<double, kCorners>(light_class, 100)) {
        const typename Kind::template Technique<double> technique(light);
        for (const auto& u : random_numbers<double>(8)) {
            const auto wi = [&](double x, double y) { return technique.sample({x, y}).wi; };
            const auto by_x = wi(u.x + kStep, u.y) - wi(u.x - kStep, u.y);
            const auto by_y = wi(u.x, u.y + kStep) - wi(u.x, u.y - kStep);
            const double jacobian = length(cross(by_x, by_y)) / (4 * kStep * kStep);
            errors.add(technique.sample(u).pdf * jacobian - 1);
        }
    }
    return errors;
}

/// Relative errors of the integral of a function over the directions of lights, as a mean over primary sample space.
template <class Kind>
Errors integral_errors(const LightClass& light_class) {
    constexpr int kSide = 100;
    const auto f = [](const auto& wi) { return wi.z * (1 + wi.x + wi.z); };
    Errors errors;
    for (const auto& light : random_polygons<double, kCorners>(light_class, 12)) {
        const typename Kind::template Technique<double> technique(light);
        long double sum = 0;
        for (int i = 0; i < kSide * kSide; ++i) {
            const auto s = technique.sample({(i % kSide + 0.5) / kSide, (i / kSide + 0.5) / kSide});
            sum += f(s.wi) / s.pdf / (kSide * kSide);
        }
        errors.add(sum / integrate_solid_angle(lit_part<Kind>(light), f, 1e-7L) - 1);
    }
    return errors;
}

// Most of these errors come from lights that are seen almost edge-on.
template <class T>
constexpr long double kMedianError = 500 * std::numeric_limits<T>::epsilon();
template <class T>
constexpr long double kRareError = 1e6L * std::numeric_limits<T>::epsilon();
constexpr double kJacobianError = 1e-4;
constexpr double kIntegralError = 5e-3;

template <class KindType, class RealType>
struct Case {
    using Kind = KindType;
    using T = RealType;
};
template <class TestCase>
class PublishedPolygonsTest : public ::testing::Test {};
using Cases =
    ::testing::Types<Case<SolidAngleArvo, float>, Case<SolidAngleArvo, double>,
                     Case<SolidAngleArvo, long double>, Case<ProjectedPeters, float>,
                     Case<ProjectedPeters, double>, Case<ProjectedArvo, float>, Case<ProjectedArvo, double>,
                     Case<ProjectedArvo, long double>, Case<ConvergedArvo, double>, Case<Bisection, float>,
                     Case<Bisection, double>, Case<ConvergedBisection, double>,
                     Case<ConvergedBisection, long double>, Case<SubdivisionUrena, float>,
                     Case<SubdivisionUrena, double>, Case<SubdivisionUrena, long double>>;
TYPED_TEST_SUITE(PublishedPolygonsTest, Cases);

TYPED_TEST(PublishedPolygonsTest, MeasureIsThatOfTheReference) {
    using T = typename TypeParam::T;
    for (const LightClass& lights : kClasses) {
        Errors errors = measure_errors<typename TypeParam::Kind, T>(lights);
        EXPECT_LE(errors.quantile(0.5), kMedianError<T>) << lights.name;
        EXPECT_LE(errors.largest(), kRareError<T>) << lights.name;
    }
}

TYPED_TEST(PublishedPolygonsTest, InversionGivesTheRandomNumbersBack) {
    using T = typename TypeParam::T;
    using Kind = typename TypeParam::Kind;
    for (const LightClass& lights : kClasses) {
        Errors errors = inversion_errors<Kind, T>(lights);
        const long double iteration = Kind::kIterationError;
        EXPECT_LE(errors.quantile(0.5), std::max(kMedianError<T>, iteration)) << lights.name;
        EXPECT_LE(errors.quantile(0.98), std::max(kRareError<T>, iteration)) << lights.name;
    }
}

TYPED_TEST(PublishedPolygonsTest, SamplesAreOnTheLightWithTheDensityOfTheirDirection) {
    using T = typename TypeParam::T;
    using Kind = typename TypeParam::Kind;
    for (const LightClass& lights : kClasses) {
        Errors density, length_of_wi, plane, along;
        for (const auto& light : random_polygons<T, kCorners>(lights, 100)) {
            const typename Kind::template Technique<T> technique(light);
            for (const auto& u : random_numbers<T>(8)) {
                const auto s = technique.sample(u);
                density.add(technique.pdf(s.wi) / s.pdf - 1);
                length_of_wi.add(length(s.wi) - 1);
                plane.add(dot(light.normal, s.p - light.vertex[0]));
                along.add(length(cross(s.wi, s.p)));
                EXPECT_TRUE(s.wi.z >= 0 || !Kind::kIsClipped) << lights.name;
            }
        }
        // The density of the subdivision jumps, and rounding moves some directions across.
        EXPECT_LE(density.quantile(0.95), 10 * std::numeric_limits<T>::epsilon()) << lights.name;
        EXPECT_LE(length_of_wi.largest(), 50 * std::numeric_limits<T>::epsilon()) << lights.name;
        EXPECT_LE(plane.quantile(0.99), kRareError<T>) << lights.name;
        EXPECT_LE(along.quantile(0.99), kRareError<T>) << lights.name;
    }
}

/// Scalars and packs must agree. In float, this holds for most lights, as both amplify rounding.
template <class Kind, class T, int Lanes>
void expect_packs_like_scalars() {
    using Real = Pack<T, Lanes>;
    for (const LightClass& lights : kClasses) {
        const auto singles = random_polygons<T, kCorners>(lights, 40 * Lanes);
        const auto u = random_numbers<T>(static_cast<int>(singles.size()));
        Errors of_lights, of_samples;
        const auto compare = [&](const auto& packs, const auto& packed_u, int lane, const auto& scalar,
                                 const Vec2<T>& x) {
            const auto ps = packs.sample(packed_u);
            const auto pu = packs.invert(ps.wi);
            const auto s = scalar.sample(x);
            const auto su = scalar.invert(s.wi);
            const auto gap = get_lane<T, Vec3<T>>(ps.wi, lane) - s.wi;
            const auto p_gap = get_lane<T, Vec3<T>>(ps.p, lane) - s.p;
            of_lights.add(packs.measure().lane(lane) / scalar.measure() - 1);
            of_samples.add(length(gap));
            of_samples.add(length(p_gap));
            of_samples.add(ps.pdf.lane(lane) / s.pdf - 1);
            of_samples.add(packs.pdf(ps.wi).lane(lane) / scalar.pdf(s.wi) - 1);
            of_samples.add(std::max(std::fabs(pu.x.lane(lane) - su.x), std::fabs(pu.y.lane(lane) - su.y)));
        };
        for (std::size_t i = 0; i < singles.size(); i += Lanes) {
            const typename Kind::template Technique<Real> packs(packed<Lanes, T>(&singles[i]));
            const auto packed_u = packed<Lanes, T>(&u[i]);
            const typename Kind::template Technique<T> first(singles[i]);
            const typename Kind::template Technique<Real> of_first(first);
            for (int lane = 0; lane < Lanes; ++lane) {
                const auto k = i + static_cast<std::size_t>(lane);
                compare(packs, packed_u, lane, typename Kind::template Technique<T>(singles[k]), u[k]);
                compare(of_first, packed_u, lane, first, u[k]);
            }
        }
        EXPECT_LE(of_lights.largest(), kRareError<T>) << lights.name;
        EXPECT_LE(of_samples.quantile(0.5), kMedianError<T>) << lights.name;
        EXPECT_LE(of_samples.quantile(0.98), kRareError<T>) << lights.name;
    }
}

TYPED_TEST(PublishedPolygonsTest, PacksAgreeWithScalars) {
    using T = typename TypeParam::T;
    using Kind = typename TypeParam::Kind;
    if constexpr (std::is_same_v<T, float>) expect_packs_like_scalars<Kind, float, 8>();
    if constexpr (std::is_same_v<T, double>) expect_packs_like_scalars<Kind, double, 4>();
}

TYPED_TEST(PublishedPolygonsTest, LightsBelowTheHorizonAreDark) {
    using T = typename TypeParam::T;
    using Kind = typename TypeParam::Kind;
    if (!Kind::kIsClipped) return;
    constexpr LightClass kBelow = {"below", -0.7, -0.6, 0.3, false};
    const auto lights = random_polygons<T, kCorners>(kBelow, 4);
    for (const auto& light : lights) {
        const typename Kind::template Technique<T> technique(light);
        EXPECT_EQ(technique.measure(), 0);
        const auto s = technique.sample({T(0.5), T(0.5)});
        EXPECT_EQ(s.pdf, 0);
        EXPECT_EQ(length(s.wi), 1);
        EXPECT_EQ(technique.pdf(s.wi), 0);
    }
    if constexpr (std::is_same_v<T, float>) {
        const typename Kind::template Technique<Pack<T, 4>> packs(packed<4, T>(lights.data()));
        EXPECT_EQ(packs.measure().lane(3), 0);
        EXPECT_EQ(packs.sample({Pack<T, 4>(0.5f), Pack<T, 4>(0.5f)}).pdf.lane(3), 0);
    }
}

/// Techniques whose iteration has converged, or that do not iterate.
template <class KindType>
class ExactPolygonsTest : public ::testing::Test {};
using ExactKinds =
    ::testing::Types<SolidAngleArvo, ProjectedPeters, ConvergedArvo, ConvergedBisection, SubdivisionUrena>;
TYPED_TEST_SUITE(ExactPolygonsTest, ExactKinds);

TYPED_TEST(ExactPolygonsTest, DensityIsTheReciprocalOfTheJacobian) {
    for (const LightClass& lights : kClasses) {
        Errors errors = jacobian_errors<TypeParam>(lights);
        EXPECT_LE(errors.quantile(0.5), 1e-6) << lights.name;
        EXPECT_LE(errors.quantile(0.98), kJacobianError) << lights.name;
    }
}

TYPED_TEST(ExactPolygonsTest, EstimatesIntegrals) {
    for (const LightClass& lights : kClasses)
        EXPECT_LE(integral_errors<TypeParam>(lights).largest(), kIntegralError) << lights.name;
}

/// A mistake in the second step: angles along an arc are uniform, instead of their cosines.
struct UniformAngles : SolidAngleArvo {
    template <class Real>
    struct Technique : SolidAngleArvo::Technique<Real> {
        using SolidAngleArvo::Technique<Real>::PolygonSolidAngleArvo;
        nusselt::LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
            return SolidAngleArvo::Technique<Real>::sample({u.x, u.y * u.y});
        }
    };
};
/// The cubic polynomial alone.
struct WithoutNewton : ProjectedArvo {
    template <class Real>
    using Technique = nusselt::PolygonProjectedSolidAngleArvo<Real, kCorners, 0>;
};
/// Descends in proportion to projected solid angles, but states the density of a descent in proportion to solid angles.
struct WrongProbability : SubdivisionUrena {
    template <class Real>
    struct Technique : SubdivisionUrena::Technique<Real> {
        explicit Technique(const nusselt::ConvexPolygon<Real, kCorners>& light)
            : SubdivisionUrena::Technique<Real>(light), whole(light) {}
        nusselt::LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
            auto s = SubdivisionUrena::Technique<Real>::sample(u);
            s.pdf = whole.pdf(s.wi);
            return s;
        }
        nusselt::PolygonSubdivisionUrena<Real, kCorners, 0> whole;
    };
};

TEST(PublishedPolygons, ChecksRejectMutants) {
    EXPECT_GT((inversion_errors<UniformAngles, double>(kDecentral).quantile(0.5)), 0.1);
    EXPECT_GT(jacobian_errors<UniformAngles>(kDecentral).quantile(0.5), 0.1);
    EXPECT_GT(integral_errors<UniformAngles>(kDecentral).quantile(0.5), 4 * kIntegralError);
    EXPECT_GT((inversion_errors<WithoutNewton, double>(kDecentral).quantile(0.98)),
              4 * ProjectedArvo::kIterationError);
    EXPECT_GT(jacobian_errors<WithoutNewton>(kDecentral).quantile(0.5), 10 * kJacobianError);
    EXPECT_GT(jacobian_errors<Bisection>(kDecentral).quantile(0.5), 0.99)
        << "six bisections do not move with the random number";
    EXPECT_GT(jacobian_errors<WrongProbability>(kDecentral).quantile(0.5), 10 * kJacobianError);
    EXPECT_GT(integral_errors<WrongProbability>(kClipped).largest(), 4 * kIntegralError);
}

/// The errors of random numbers of Arvo's method on large triangles of any shape.
template <int Steps>
Errors errors_on_large_triangles() {
    std::mt19937 generator(5);
    std::uniform_real_distribution<double> uniform(-2, 2);
    Errors errors;
    for (int i = 0; i < 10000; ++i) {
        Vec3<double> v[3];
        for (auto& x : v) {
            const double first = uniform(generator), second = uniform(generator);
            x = {first, second, uniform(generator)};
        }
        const auto light = nusselt::make_polygon<3>(v, 3);
        const nusselt::PolygonProjectedSolidAngleArvo<double, 3, Steps> technique(light);
        // Not seen edge-on.
        if (std::fabs(dot(light.normal, v[0])) < 0.05 || technique.measure() < 0.02) continue;
        for (const auto& u : random_numbers<double>(4))
            errors.add(technique.invert(technique.sample(u).wi).x - u.x);
    }
    return errors;
}

TEST(ProjectedSolidAngleArvo, DoesNotAlwaysConvergeInThreeSteps) {
    Errors start = errors_on_large_triangles<0>(), errors = errors_on_large_triangles<3>();
    EXPECT_GT(start.quantile(0.9), 0.1);
    EXPECT_GT(errors.quantile(0.99), 0.01);
    EXPECT_GT(errors.largest(), 0.2);
    EXPECT_LT(errors.quantile(0.5), 1e-12);
    EXPECT_LT(errors_on_large_triangles<20>().largest(), 1e-7) << "but it does in twenty";
}

TEST(ProjectedSolidAngleBisection, HasSixtyFourAzimuthsInEachSector) {
    for (const auto& light : random_polygons<double, kCorners>(kDecentral, 5)) {
        const Bisection::Technique<double> technique(light);
        std::set<double> azimuths;
        for (int i = 0; i < 10000; ++i) azimuths.insert(technique.sample({(i + 0.5) / 10000, 0.5}).wi.x);
        EXPECT_LE(azimuths.size(), std::size_t{64 * (kCorners - 1)});
        EXPECT_GT(azimuths.size(), 64u);
    }
}

/// Errors of samples in float, as the random numbers for which a technique in double gives the same directions.
template <class Kind, class Exact>
Errors backward_errors_in_float(const LightClass& light_class) {
    const auto narrow = random_polygons<float, kCorners>(light_class, 200);
    const auto wide = random_polygons<double, kCorners>(light_class, 200);
    Errors errors;
    for (std::size_t i = 0; i < narrow.size(); ++i) {
        const typename Kind::template Technique<float> technique(narrow[i]);
        const typename Exact::template Technique<double> exact(wide[i]);
        for (const auto& u : random_numbers<float>(8)) {
            const auto back = exact.invert(nusselt::broadcast<double>(technique.sample(u).wi));
            errors.add(std::max(std::fabs(back.x - double{u.x}), std::fabs(back.y - double{u.y})));
        }
    }
    return errors;
}

TEST(PublishedPolygons, LoseSmallLightsInFloat) {
    EXPECT_GT((backward_errors_in_float<SolidAngleArvo, SolidAngleArvo>(kSmall).quantile(0.5)), 0.03);
    EXPECT_GT((backward_errors_in_float<ProjectedArvo, ConvergedArvo>(kSmall).quantile(0.99)), 1e-3);
    EXPECT_GT((measure_errors<Bisection, float>(kSmall).quantile(0.9)), 1e-4);
    EXPECT_GT((backward_errors_in_float<SubdivisionUrena, SubdivisionUrena>(kSmall).quantile(0.5)), 0.03);
}

TEST(PublishedPolygons, HaveNoPointWherePlanesContainTheOrigin) {
    const Vec3<float> v[] = {{1, 0, 0.5f}, {2, 0.5f, 1}, {2, -0.5f, 1}};
    const auto light = nusselt::make_polygon<kCorners>(v, 3);
    const Vec2<float> u{0.5f, 0.5f};
    const auto point_is_missing = [](const auto& s) {
        return !(s.pdf > 0) || !nusselt::is_finite(length(s.p)) || std::fabs(s.p.x - 1.5f) > 0.6f;
    };
    EXPECT_TRUE(point_is_missing(SolidAngleArvo::Technique<float>(light).sample(u)));
    EXPECT_TRUE(point_is_missing(ProjectedArvo::Technique<float>(light).sample(u)));
    EXPECT_TRUE(point_is_missing(Bisection::Technique<float>(light).sample(u)));
    EXPECT_TRUE(point_is_missing(SubdivisionUrena::Technique<float>(light).sample(u)));
}

/// Relative standard deviation of estimates of the projected solid angle.
template <int Depth>
double deviation_of_subdivision(const LightClass& light_class) {
    double sum = 0;
    int count = 0;
    for (const auto& light : random_polygons<double, kCorners>(light_class, 100)) {
        const nusselt::PolygonSubdivisionUrena<double, kCorners, Depth> technique(light);
        for (const auto& u : random_numbers<double>(64)) {
            const auto s = technique.sample(u);
            const double deviation = s.wi.z / (s.pdf * technique.measure()) - 1;
            sum += deviation * deviation;
            ++count;
        }
    }
    return std::sqrt(sum / count);
}

TEST(PolygonSubdivisionUrena, KeepsVarianceThatEachLevelHalves) {
    const double coarse = deviation_of_subdivision<2>(kDecentral);
    EXPECT_GT(coarse, 0.01);
    EXPECT_NEAR(deviation_of_subdivision<4>(kDecentral) / coarse, 0.25, 0.05);
    EXPECT_GT(deviation_of_subdivision<4>(kClipped), 0.01);
}

TEST(PolygonSubdivisionUrena, JumpsBetweenNeighbouringRandomNumbers) {
    const auto light = random_polygons<double, kCorners>(kCentral, 1)[0];
    const SubdivisionUrena::Technique<double> technique(light);
    double largest = 0;
    constexpr int kCount = 10000;
    for (int i = 1; i < kCount; ++i) {
        const auto gap =
            technique.sample({(i + 0.5) / kCount, 0.3}).wi - technique.sample({(i - 0.5) / kCount, 0.3}).wi;
        largest = std::max(largest, length(gap));
    }
    EXPECT_GT(largest, 0.1);
}

TEST(PolygonSubdivisionUrena, LosesProjectedSolidAnglesOfSmallTrianglesInFloat) {
    constexpr LightClass kTenth = {"a tenth", 0.5, 0.7, 0.05, false};
    const auto narrow = random_polygons<float, kCorners>(kTenth, 100);
    const auto wide = random_polygons<double, kCorners>(kTenth, 100);
    Errors errors;
    for (std::size_t i = 0; i < narrow.size(); ++i) {
        const SubdivisionUrena::Technique<float> technique(narrow[i]);
        const SubdivisionUrena::Technique<double> exact(wide[i]);
        for (const auto& u : random_numbers<float>(4)) {
            const auto s = technique.sample(u);
            errors.add(s.pdf / exact.pdf(nusselt::broadcast<double>(s.wi)) - 1);
        }
    }
    EXPECT_GT(errors.quantile(0.5), 1e-3);
    EXPECT_GT(errors.quantile(0.95), 1e-2);
}

} // namespace
} // namespace nusselt_test
