/// Published methods for lines and cylinders with which benches compare: they are right where they are made for,
/// and fail where their headers say so.

#include <nusselt/related/cylinder_rejection_gamito.h>
#include <nusselt/related/line_projected_solid_angle_li.h>
#include <nusselt/related/line_rectangle_urena.h>
#include <nusselt/sampling/line_area.h>
#include <nusselt/sampling/line_projected_solid_angle.h>
#include <nusselt/sampling/line_solid_angle.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

#include <gtest/gtest.h>

#include "geometry/cylinder_reference.h"
#include "sampling/lights.h"
#include "sampling/lit_part.h"

namespace nusselt_test {

namespace {

using LiKind = LineProjectedSolidAngleLiKind;
using UrenaKind = LineRectangleUrenaKind;
using GamitoKind = CylinderRejectionGamitoKind;
using ProjectedGamitoKind = CylinderProjectedRejectionGamitoKind;
using Kinds = KindList<LiKind, UrenaKind, GamitoKind, ProjectedGamitoKind>;

template <class Kind>
constexpr bool kHasTolerance = std::is_same_v<Kind, LiKind>;
/// The error of the random number at which the method of Li et al. stops, with a little rounding.
constexpr double kLiTolerance = 1.001e-5;

/// Relative rounding error of a result: directions to the short line of the list lose two digits, those to the long
/// one and to the thin cylinder one.
template <class T>
constexpr T kRounding = 500 * std::numeric_limits<T>::epsilon();

/// Relative to the second number.
template <class T>
T deviation(T found, T expected) {
    return std::fabs(found / expected - 1);
}

template <class T>
T largest_difference(const nusselt::Vec2<T>& a, const nusselt::Vec2<T>& b) {
    return std::max(std::fabs(a.x - b.x), std::fabs(a.y - b.y));
}
template <class T>
T largest_difference(T a, T b) {
    return std::fabs(a - b);
}

// Tests with every number type.

template <class Test>
class RelatedLinesTest : public ::testing::Test {};
using Types = Instances<Kinds, float, double, long double>;
TYPED_TEST_SUITE(RelatedLinesTest, Types, InstanceNames);

TYPED_TEST(RelatedLinesTest, InvertsItsSamples) {
    using T = typename TypeParam::Real;
    using Kind = typename TypeParam::Kind;
    constexpr T kBudget = kRounding<T> + T(kHasTolerance<Kind> ? kLiTolerance : 0);
    for (const auto& light : cases<Kind>()) {
        const typename TypeParam::Technique technique(light_for<Kind, T>(light));
        for (const auto& u : midpoints<Kind, T>(17)) {
            const auto sample = technique.sample(u);
            EXPECT_LE(deviation(length(sample.wi), T(1)), kRounding<T>) << light.name;
            if (!(sample.pdf > 0)) continue;
            EXPECT_LE(largest_difference(technique.invert(sample.wi), u), kBudget) << light.name;
        }
    }
}

TYPED_TEST(RelatedLinesTest, SamplesHaveTheDensityAndThePointOfTheirDirection) {
    using T = typename TypeParam::Real;
    using Kind = typename TypeParam::Kind;
    for (const auto& light : cases<Kind>()) {
        const auto local = light_for<Kind, T>(light);
        const typename TypeParam::Technique technique(local);
        for (const auto& u : midpoints<Kind, T>(17)) {
            const auto sample = technique.sample(u);
            if (!(sample.pdf > 0)) {
                EXPECT_TRUE(kIsCylinder<Kind>) << "only cylinders are missed: " << light.name;
                continue;
            }
            EXPECT_LE(deviation(technique.pdf(sample.wi), sample.pdf), kRounding<T>) << light.name;
            EXPECT_LE(length(normalize(sample.p) - sample.wi), kRounding<T>) << light.name;
            if constexpr (!kIsCylinder<Kind>) {
                const T along = dot(sample.p - local.p0, local.s);
                const T scale = length(local.p0) + local.length;
                EXPECT_LE(length(sample.p - (local.p0 + along * local.s)), kRounding<T> * scale)
                    << light.name;
                EXPECT_GE(along, -kRounding<T> * scale) << light.name;
                EXPECT_LE(along, local.length + kRounding<T> * scale) << light.name;
            }
        }
    }
}

TYPED_TEST(RelatedLinesTest, IsDarkWithoutLight) {
    using T = typename TypeParam::Real;
    using Kind = typename TypeParam::Kind;
    using Case = decltype(cases<Kind>()[0]);
    std::vector<std::decay_t<Case>> dark;
    if constexpr (kIsCylinder<Kind>) {
        dark = {{"inside", {-1, 0.125, 0.125}, {1, 0.125, 0.125}, 0.5},
                {"no radius", {-1, 0.5, 1}, {1, 0.5, 1}, 0},
                {"no length", {1, 0.5, 1}, {1, 0.5, 1}, 0.25}};
        if (Kind::kHorizon == Horizon::clipped) dark.push_back({"below", {-1, 1, -1}, {1, 1, -1}, 0.5});
    } else {
        dark = {{"through the point", {-1, 0, 0}, {1, 0, 0}}, {"no length", {1, 0.5, 1}, {1, 0.5, 1}}};
        if (Kind::kHorizon == Horizon::clipped) dark.push_back({"below", {-1, 1, -1}, {1, 1, -0.5}});
    }
    for (const auto& light : dark) {
        const typename TypeParam::Technique technique(light_for<Kind, T>(light));
        EXPECT_EQ(technique.measure(), 0) << light.name;
        const auto sample = technique.sample(random_of<Kind>(T(0.25), T(0.625)));
        EXPECT_EQ(sample.pdf, 0) << light.name;
        EXPECT_LE(length(sample.wi), 1 + kRounding<T>) << "not finite: " << light.name;
    }
}

// Integrals and densities, which also have to reject wrong techniques.

/// An integrand for which weights f / pdf vary.
template <class Kind>
long double integrand(const Point& wi) {
    const long double f = 1 + wi.x / 2;
    return Kind::kMeasure == Measure::projected_solid_angle ? f * std::max(wi.z, 0.0L) : f;
}

/// Largest relative error of the mean of f / pdf among lights. Samples without a density weigh nothing.
/// \tparam Technique takes lights of the kind in double.
template <class Kind, class Technique, class Case>
double estimate_error(const std::vector<Case>& lights) {
    constexpr int kCount = kIsCylinder<Kind> ? 400 : 10'000;
    double worst = 0;
    for (const auto& light : lights) {
        const auto local = light_for<Kind, double>(light);
        const Technique technique(local);
        long double sum = 0;
        const auto points = midpoints<Kind, double>(kCount);
        for (const auto& u : points) {
            const auto sample = technique.sample(u);
            if (sample.pdf > 0)
                sum += integrand<Kind>(nusselt::broadcast<long double>(sample.wi)) / sample.pdf;
        }
        long double expected = 0;
        if constexpr (kIsCylinder<Kind>) {
            expected = integrate_solid_angle(solid(local), integrand<Kind>, 1e-5L);
        } else {
            expected = integrate_per_radius(lit_part<Kind>(local), integrand<Kind>);
        }
        const long double mean = sum / static_cast<long double>(points.size());
        worst = std::max(worst, static_cast<double>(std::fabs(mean / expected - 1)));
    }
    return worst;
}

/// The midpoint rule errs by 1 / count along the outline of the light in the rectangle, and lines by the tolerance
/// of the method.
template <class Kind>
constexpr double kEstimateBudget = kIsCylinder<Kind> ? 2e-3 : 1e-5;

template <class Kind>
class RelatedEstimateTest : public ::testing::Test {};
using KindTypes = ::testing::Types<LiKind, UrenaKind, GamitoKind, ProjectedGamitoKind>;
TYPED_TEST_SUITE(RelatedEstimateTest, KindTypes);

TYPED_TEST(RelatedEstimateTest, DensityIntegratesFunctionsOverTheLight) {
    using Technique = typename TypeParam::template Technique<double>;
    EXPECT_LE((estimate_error<TypeParam, Technique>(cases<TypeParam>())), kEstimateBudget<TypeParam>);
}

/// The width of the rectangle taken for its half.
struct HalfOfTheDensity : nusselt::LineRectangleUrena<double> {
    using LineRectangleUrena::LineRectangleUrena;
    nusselt::LightSample<double> sample(double u) const {
        auto s = LineRectangleUrena::sample(u);
        s.pdf /= 2;
        return s;
    }
};

/// Directions that are uniform in length.
struct UniformInLength : nusselt::LineProjectedSolidAngleLi<double> {
    nusselt::LineArea<double> area;
    explicit UniformInLength(const nusselt::LineSegment<double>& light)
        : LineProjectedSolidAngleLi(light), area(light) {}
    nusselt::LightSample<double> sample(double u) const {
        const auto s = area.sample(u);
        return {s.wi, pdf(s.wi), s.p};
    }
};

/// Counts misses as hits.
template <class Kind>
struct WithoutRejection : Kind::template Technique<double> {
    using Technique = typename Kind::template Technique<double>;
    using Technique::Technique;
    nusselt::LightSample<double> sample(const nusselt::Vec2<double>& u) const {
        auto s = Technique::sample(u);
        s.pdf = Technique::pdf(s.wi);
        return s;
    }
};

TEST(RelatedEstimateTest, RejectsWrongTechniques) {
    const std::vector<LineCase> lines = line_cases();
    const std::vector<CylinderCase> cylinders = {cylinder_cases()[3]}; // begins ahead
    EXPECT_GE((estimate_error<UrenaKind, HalfOfTheDensity>(lines)), 0.5);
    EXPECT_GE((estimate_error<LiKind, UniformInLength>(lines)), 0.3);
    EXPECT_GE((estimate_error<GamitoKind, WithoutRejection<GamitoKind>>(cylinders)), 0.5);
    EXPECT_GE((estimate_error<ProjectedGamitoKind, WithoutRejection<ProjectedGamitoKind>>(cylinders)), 0.5);
}

/// Largest difference between a random number and the share of the projected solid angle before its sample, by
/// quadrature.
template <class Technique>
double share_error() {
    double worst = 0;
    const auto cosine = [](const Point& wi) { return std::max(wi.z, 0.0L); };
    for (const LineCase& light : line_cases()) {
        const auto local = make_light<double>(light);
        const Technique technique(local);
        const Segment whole = lit_part<LiKind>(local);
        const long double total = integrate_per_radius(whole, cosine);
        for (const double u : {0.0, 1e-3, 0.1, 0.25, 0.5, 0.7, 0.95, 0.9999}) {
            const Point end = nusselt::broadcast<long double>(technique.sample(u).p);
            const long double before = integrate_per_radius(Segment{whole.begin, end}, cosine);
            worst = std::max(worst, std::fabs(static_cast<double>(before / total) - u));
        }
    }
    return worst;
}

TEST(LineProjectedSolidAngleLi, SamplesUpToItsTolerance) {
    const double error = share_error<nusselt::LineProjectedSolidAngleLi<double>>();
    EXPECT_LE(error, kLiTolerance);
    EXPECT_GE(error, 1e-6) << "it stops as soon as the tolerance is met";
    EXPECT_GE(share_error<UniformInLength>(), 0.1) << "a wrong technique passes";
}

TEST(LineProjectedSolidAngleLi, HasTheMeasureOfOurs) {
    for (const LineCase& light : line_cases()) {
        const auto local = make_light<double>(light);
        const nusselt::LineProjectedSolidAngleLi<double> li(local);
        const nusselt::LineProjectedSolidAngle<double> ours(local);
        EXPECT_NEAR(li.measure() / ours.measure(), 1, 1e-12) << light.name;
        EXPECT_NEAR(li.sample(0.3).pdf / ours.pdf(li.sample(0.3).wi), 1, 1e-12) << light.name;
    }
}

/// Largest deviation of pdf times the Jacobian from one, by central differences.
template <class Kind, class Technique = typename Kind::template Technique<double>>
double jacobian_error() {
    constexpr double kStep = 1e-5;
    double worst = 0;
    for (const auto& light : cases<Kind>()) {
        const auto local = light_for<Kind, double>(light);
        const Technique technique(local);
        for (const auto& u : midpoints<Kind, double>(9)) {
            const auto sample = technique.sample(u);
            if (!(sample.pdf > 0)) continue;
            double jacobian = 0;
            if constexpr (kIsCylinder<Kind>) {
                const auto wi = [&](double x, double y) { return technique.sample({x, y}).wi; };
                const auto by_x = wi(u.x + kStep, u.y) - wi(u.x - kStep, u.y);
                const auto by_y = wi(u.x, u.y + kStep) - wi(u.x, u.y - kStep);
                jacobian = length(cross(by_x, by_y)) / (4 * kStep * kStep);
            } else {
                // A thin cylinder is as wide as the cosine of the angle to the closest point over its distance.
                const double angle = length(technique.sample(u + kStep).wi - technique.sample(u - kStep).wi);
                const double cosine = length(cross(sample.wi, local.s));
                jacobian = 2 * cosine / length(cross(local.p0, local.s)) * angle / (2 * kStep);
            }
            worst = std::max(worst, std::fabs(sample.pdf * jacobian - 1));
        }
    }
    return worst;
}

/// The density of the other way to sample the rectangle.
struct ConstantDensity : nusselt::CylinderProjectedRejectionGamito<double> {
    using CylinderRejectionGamito::CylinderRejectionGamito;
    nusselt::LightSample<double> sample(const nusselt::Vec2<double>& u) const {
        auto s = CylinderRejectionGamito::sample(u);
        s.pdf = 1 / measure();
        return s;
    }
};

// Differences have errors of 1000 h^2 (third derivatives), those across corners of the map of projected solid angle
// up to h.
TEST(RelatedJacobianTest, IsTheReciprocalOfTheDensity) {
    EXPECT_LE(jacobian_error<UrenaKind>(), 1e-6);
    EXPECT_LE(jacobian_error<GamitoKind>(), 1e-6);
    EXPECT_LE(jacobian_error<ProjectedGamitoKind>(), 1e-5);
    EXPECT_GE((jacobian_error<UrenaKind, HalfOfTheDensity>()), 0.5) << "a wrong technique passes";
    EXPECT_GE((jacobian_error<GamitoKind, ConstantDensity>()), 0.5) << "a wrong technique passes";
}

// Packs.

template <class Test>
class RelatedPacksTest : public ::testing::Test {};
using PackTypes = Instances<Kinds, nusselt::Pack<float, 8>, nusselt::Pack<double, 4>>;
TYPED_TEST_SUITE(RelatedPacksTest, PackTypes, InstanceNames);

/// Scalars of float take the vertices of the rectangle as lanes and round in another way; and the method of Li et
/// al. may stop at another step.
template <class Kind, class T>
constexpr T kPackBudget = kRounding<T> + T(kHasTolerance<Kind> ? 4 * kLiTolerance : 0);

/// Compares a lane with the technique for a single light.
template <class Case>
void expect_lane(const typename Case::Technique& packs, const typename Case::Random& u, int lane,
                 const typename Case::ScalarTechnique& single, const typename Case::ScalarRandom& single_u) {
    using T = typename Case::Scalar;
    constexpr T kBudget = kPackBudget<typename Case::Kind, T>;
    const auto sample = get_lane<T, nusselt::LightSample<T>>(packs.sample(u), lane);
    const auto expected = single.sample(single_u);
    const T measure = get_lane<T, T>(packs.measure(), lane);
    EXPECT_LE(deviation(measure, single.measure()), kRounding<T>);
    // Rounding decides whether a direction hits the outline of a cylinder.
    if (!(sample.pdf > 0) || !(expected.pdf > 0)) return;
    EXPECT_LE(deviation(sample.pdf, expected.pdf), kBudget);
    EXPECT_LE(length(sample.wi - expected.wi), kBudget);
    EXPECT_LE(length(sample.p - expected.p), 4 * kBudget * length(expected.p));
    const auto inverse = get_lane<T, typename Case::ScalarRandom>(packs.invert(packs.sample(u).wi), lane);
    EXPECT_LE(largest_difference(inverse, single.invert(sample.wi)), kRounding<T>);
}

TYPED_TEST(RelatedPacksTest, LanesAgreeWithScalars) {
    using T = typename TypeParam::Scalar;
    using Kind = typename TypeParam::Kind;
    constexpr int kLanes = TypeParam::kLanes;
    const auto lights = cases<Kind>();
    const auto us = midpoints<Kind, T>(7);
    for (std::size_t round = 0; round < 50; ++round) {
        typename TypeParam::Light packed;
        typename TypeParam::Random u;
        const auto light = [&](int lane) {
            return light_for<Kind, T>(lights[(round + static_cast<std::size_t>(lane)) % lights.size()]);
        };
        const auto single_u = [&](int lane) {
            return us[(round + 3 * static_cast<std::size_t>(lane)) % us.size()];
        };
        for (int lane = 0; lane < kLanes; ++lane) {
            set_lane<T>(packed, lane, light(lane));
            set_lane<T>(u, lane, single_u(lane));
        }
        const typename TypeParam::Technique packs(packed);
        const typename TypeParam::ScalarTechnique first(light(0));
        const typename TypeParam::Technique copies(first);
        for (int lane = 0; lane < kLanes; ++lane) {
            const typename TypeParam::ScalarTechnique single(light(lane));
            expect_lane<TypeParam>(packs, u, lane, single, single_u(lane));
            expect_lane<TypeParam>(copies, u, lane, first, single_u(lane));
        }
    }
}

// What the headers promise and what they warn of.

/// Largest error of points along a light, over its length.
template <class Technique>
double point_error(const nusselt::LineSegment<float>& light) {
    const nusselt::Vec3<double> p0 = nusselt::broadcast<double>(light.p0);
    const nusselt::Vec3<double> s = normalize(nusselt::broadcast<double>(light.s));
    const nusselt::LineProjectedSolidAngle<double> exact(nusselt::LineSegment<double>{p0, s, light.length});
    const Technique technique(light);
    double worst = 0;
    for (int i = 0; i < 100; ++i) {
        const float u = (static_cast<float>(i) + 0.5f) / 100;
        const auto p = nusselt::broadcast<double>(technique.sample(u).p);
        worst = std::max(worst, std::fabs(dot(p - exact.sample(double{u}).p, s)) / double{light.length});
    }
    return worst;
}

TEST(LineProjectedSolidAngleLi, LosesShortLinesInFloat) {
    const auto light = make_light<float>(LineCase{"short", {1, 0.5, 2}, {1.0004, 0.5008, 2.0004}});
    EXPECT_LE(point_error<nusselt::LineProjectedSolidAngle<float>>(light), 2e-4) << "the spacing of points";
    EXPECT_GE(point_error<nusselt::LineProjectedSolidAngleLi<float>>(light), 4e-4);
}

/// So its samples are neither continuous nor monotone, and the middle of the line has a probability of its own.
TEST(LineProjectedSolidAngleLi, JumpsWhereTheNumberOfStepsChanges) {
    const nusselt::LineProjectedSolidAngleLi<double> technique(make_light<double>(line_cases()[1]));
    double smallest = 1;
    double largest = 0;
    int repeated = 0;
    constexpr int kCount = 1'000'000;
    double last = technique.invert(technique.sample(0).wi);
    for (int i = 1; i < kCount; ++i) {
        const double next = technique.invert(technique.sample(static_cast<double>(i) / kCount).wi);
        smallest = std::min(smallest, next - last);
        largest = std::max(largest, next - last);
        repeated += next == last ? 1 : 0;
        last = next;
    }
    EXPECT_GE(largest, 9e-6);
    EXPECT_LE(smallest, -8e-6);
    EXPECT_LE(std::max(largest, -smallest), 2 * kLiTolerance + 1.0 / kCount);
    EXPECT_NEAR(repeated, 2e-5 * kCount, 2);
}

/// A line that almost points at the shading point.
nusselt::LineSegment<float> end_on_line() {
    return make_light<float>(LineCase{"end-on", {0.30001, 0.4, 0.5}, {0.90001, 1.2, 1.5}});
}

TEST(LineProjectedSolidAngleLi, HasWrongDirectionsToLinesThatPointAtTheShadingPoint) {
    const nusselt::LineProjectedSolidAngle<float> ours(end_on_line());
    const nusselt::LineProjectedSolidAngleLi<float> technique(end_on_line());
    double worst = 0;
    for (const float u : midpoints<LiKind, float>(20)) {
        EXPECT_NEAR(length(ours.sample(u).wi), 1, 1e-6);
        worst = std::max(worst, std::fabs(double{length(technique.sample(u).wi)} - 1));
    }
    EXPECT_GE(worst, 1e-3);
}

TEST(LineProjectedSolidAngleLi, IsDarkWhereSquaresOverflow) {
    const auto light = make_light<float>(LineCase{"huge", {-1e20, 5e19, 1e20}, {1e20, 5e19, 1e20}});
    EXPECT_GT(nusselt::LineProjectedSolidAngle<float>(light).measure(), 0);
    const nusselt::LineProjectedSolidAngleLi<float> technique(light);
    EXPECT_EQ(technique.measure(), 0);
    EXPECT_EQ(technique.sample(0.5f).pdf, 0);
}

TYPED_TEST(RelatedLinesTest, RectanglesAreAsGoodAsLines) {
    using T = typename TypeParam::Real;
    if constexpr (std::is_same_v<typename TypeParam::Kind, UrenaKind>) {
        for (const LineCase& light : line_cases()) {
            const auto local = make_light<T>(light);
            const nusselt::LineRectangleUrena<T> rectangle(local);
            const nusselt::LineSolidAngle<T> line(local);
            EXPECT_LE(deviation(rectangle.measure(), line.measure()), kRounding<T> / 50) << light.name;
            for (const T u : midpoints<UrenaKind, T>(9)) {
                const auto sample = rectangle.sample(u);
                EXPECT_LE(length(sample.wi - line.sample(u).wi), kRounding<T> / 50) << light.name;
                EXPECT_LE(deviation(sample.pdf, line.pdf(sample.wi)), kRounding<T> / 50) << light.name;
            }
        }
    }
}

/// The bias that the header names: of a rectangle as wide as a tube of a tenth of its distance.
TEST(LineRectangleUrena, WouldBeBiasedWithTheRadiusOfATube) {
    const auto light = make_light<double>(LineCase{"a", {-1, 0, 1}, {1, 0, 1}});
    const double radius = 0.1;
    const auto polygon =
        nusselt::rectangle_polygon<double>({-1, -radius, 1}, {2, 0, 0}, {0, 2 * radius, 0}, {0, 0, 1});
    const double wide = nusselt::RectangleSolidAngle<double>(polygon).measure() / radius;
    const double bias = wide / nusselt::LineSolidAngle<double>(light).measure() - 1;
    EXPECT_LT(bias, -1e-3);
    EXPECT_GT(bias, -radius * radius / 2);
    EXPECT_NEAR(nusselt::LineRectangleUrena<double>(light).measure() /
                    nusselt::LineSolidAngle<double>(light).measure(),
                1, 1e-15);
}

TEST(LineRectangleUrena, LosesDigitsOfLinesThatPointAtTheShadingPoint) {
    const auto light = end_on_line();
    const double exact =
        nusselt::LineSolidAngle<double>(
            nusselt::LineSegment<double>{nusselt::broadcast<double>(light.p0),
                                         normalize(nusselt::broadcast<double>(light.s)), light.length})
            .measure();
    EXPECT_NEAR(double{nusselt::LineSolidAngle<float>(light).measure()} / exact, 1, 1e-6);
    EXPECT_GE(std::fabs(double{nusselt::LineRectangleUrena<float>(light).measure()} / exact - 1), 1e-3);
}

TYPED_TEST(RelatedLinesTest, HitsAreThoseOfTheCylinder) {
    using T = typename TypeParam::Real;
    using Kind = typename TypeParam::Kind;
    if constexpr (kIsCylinder<Kind>) {
        for (const CylinderCase& light : cylinder_cases()) {
            const auto local = make_light<T>(light);
            const typename TypeParam::Technique technique(local);
            int different = 0;
            for (const auto& u : midpoints<Kind, T>(50)) {
                const auto sample = technique.sample(u);
                const auto hit = intersect(local, sample.wi);
                if (hit.hits != (sample.pdf > 0)) {
                    ++different;
                } else if (hit.hits) {
                    // Along the outline, the root of a rounding error decides on the distance.
                    EXPECT_LE(deviation(length(sample.p), hit.distance), std::sqrt(kRounding<T>))
                        << light.name;
                }
            }
            EXPECT_LE(different, 2) << "more than rounding explains: " << light.name;
        }
    }
}

double share_of_hits(const CylinderCase& light) {
    const nusselt::CylinderRejectionGamito<double> technique(make_light<double>(light));
    int hits = 0;
    const auto points = midpoints<GamitoKind, double>(200);
    for (const auto& u : points) hits += technique.sample(u).pdf > 0 ? 1 : 0;
    return static_cast<double>(hits) / static_cast<double>(points.size());
}

TEST(CylinderRejectionGamito, MissesTubesThatBeginAhead) {
    EXPECT_GE(share_of_hits({"from the side", {-1, 2, 1}, {1, 2, 1}, 0.125}), 0.99);
    EXPECT_LE(share_of_hits({"seen end-on", {1.1, 0, 10}, {1.1, 0, 12}, 1}), 0.36);
    EXPECT_LE(share_of_hits({"beside the edge of a cap", {1.01, 0, 10}, {1.01, 0, 12}, 1}), 0.16);
    EXPECT_NEAR(share_of_hits({"before a distant cap", {0, 0, 100}, {0, 0, 101}, 1}), 0.7853981633974483,
                2e-3);
}

} // namespace
} // namespace nusselt_test
