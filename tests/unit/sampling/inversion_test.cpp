/// invert(sample(u)) == u, density() of a sample and hit points, for each technique and scalar.

#include <cmath>

#include <gtest/gtest.h>

#include "lights.h"

namespace nusselt_test {
namespace {

/// Budgets in units of the rounding error of T. All techniques share them, because the condition of the lights
/// dominates: a direction has an error of one rounding, which changes the random number by the reciprocal of the
/// light's angular width, about 100 for small lights.
template <class T>
constexpr T kInversionBudget = 2000 * std::numeric_limits<T>::epsilon();
/// The error of the default number of iterations in exact arithmetic, which only matters in long double. Lobes
/// flatten the octant of the list, for which the error reaches 1.8e-12.
template <class Kind>
constexpr double kIterationBudget = kHasLobe<Kind> ? 2e-12 : 1e-12;
/// Two samples, each normalised from three weighted vertices. A lobe adds a linear map and normalises once more.
template <class Kind, class T>
constexpr T kDirectionBudget = (kHasLobe<Kind> ? 24 : 16) * std::numeric_limits<T>::epsilon();
/// The error of a hit point is one rounding over the cosine at the light, which is at least 0.0128 in the list.
/// Squaring the distance doubles it.
template <class T>
constexpr T kPdfBudget = 600 * std::numeric_limits<T>::epsilon();
/// Rounding of three squares and a root.
template <class T>
constexpr T kUnitBudget = 4 * std::numeric_limits<T>::epsilon();
/// One rounding of the direction and one of the light's distance, both over the cosine at the light, which is at
/// least 0.0128 in the list.
template <class T>
constexpr T kHitBudget = 200 * std::numeric_limits<T>::epsilon();

/// A random number that differs by the budget.
template <class T>
T nudged(T x) {
    return x < T(0.5) ? x + kInversionBudget<T> : x - kInversionBudget<T>;
}

/// Whether inversion recovered one component of a random number. Where the component hardly moves the direction (a
/// fan of rays meets in a vertex or at the zenith, or two boundaries meet at the end of a sector), the direction
/// decides: it may be off by as much as the budget moves it. The same goes for the azimuths 0 and 1 in the central
/// case, where they coincide.
template <class Kind, class Technique, class T>
bool recovered(const Technique& technique, const nusselt::Vec2<T>& u, T error,
               const nusselt::Vec2<T>& with_error, const nusselt::Vec2<T>& with_budget) {
    const auto moved = [&](const nusselt::Vec2<T>& other) {
        return length(technique.sample(other).wi - technique.sample(u).wi);
    };
    return std::fabs(error) <= kInversionBudget<T> + T(kIterationBudget<Kind>) ||
           moved(with_error) <= std::max(kDirectionBudget<Kind, T>, moved(with_budget));
}

/// Leaves out the ends for cylinders. Where a half-plane touches a cylinder or meets the others at the axis, random
/// numbers change with the square root of the change in direction. For round lights, (0, y) and (1, 1 - y) are the same
/// direction, and (0.5, 0.5) may be the axis of a cone, where all angles meet.
template <class Kind, class T>
std::vector<T> coordinates() {
    if (kIsRound<Kind>) return {T(1e-3), T(0.125), T(0.3), T(0.45), T(0.71), T(0.9), T(0.999)};
    if (kIsCylinder<Kind>) return {T(1e-3), T(0.125), T(0.3), T(0.5), T(0.71), T(0.9), T(0.999)};
    return {T(0), T(1e-3), T(0.125), T(0.3), T(0.5), T(0.71), T(0.9), T(0.999), kLargestBelowOne<T>};
}

template <class Test>
class InversionTest : public ::testing::Test {};

/// The name of the suite in techniques.json.
struct InversionSuite {
    static constexpr std::string_view kName = "inversion";
};
using Types = Instances<TestedBy<InversionSuite, KindsWithBounds<4, 8>>, float, double, long double>;
TYPED_TEST_SUITE(InversionTest, Types, InstanceNames);

TYPED_TEST(InversionTest, ReturnsTheRandomNumber) {
    using T = typename TypeParam::Real;
    using Kind = typename TypeParam::Kind;
    for (const auto& light : cases<Kind>()) {
        const typename TypeParam::Technique technique(light_for<Kind, T>(light));
        for (const T x : coordinates<Kind, T>()) {
            for (const T y : coordinates<Kind, T>()) {
                const auto u = random_of<Kind>(x, y);
                const auto inverse = technique.invert(technique.sample(u).wi);
                if constexpr (kTakesPairs<Kind>) {
                    EXPECT_TRUE(recovered<Kind>(technique, u, inverse.x - x, {inverse.x, y}, {nudged(x), y}))
                        << light.name << " at " << x << ", " << y << " x is " << inverse.x;
                    EXPECT_TRUE(recovered<Kind>(technique, u, inverse.y - y, {x, inverse.y}, {x, nudged(y)}))
                        << light.name << " at " << x << ", " << y << " y is " << inverse.y;
                } else {
                    EXPECT_LE(std::fabs(inverse - x), kInversionBudget<T> + T(kIterationBudget<Kind>))
                        << light.name << " at " << x;
                }
            }
        }
    }
}

TYPED_TEST(InversionTest, SampleReturnsItsDensity) {
    using T = typename TypeParam::Real;
    using Kind = typename TypeParam::Kind;
    for (const auto& light : cases<Kind>()) {
        const typename TypeParam::Technique technique(light_for<Kind, T>(light));
        for (const auto& u : midpoints<Kind, T>(7)) {
            const auto sample = technique.sample(u);
            EXPECT_GT(sample.pdf, 0) << light.name;
            EXPECT_NEAR(technique.pdf(sample.wi) / sample.pdf, 1, kPdfBudget<T>) << light.name;
        }
    }
}

TYPED_TEST(InversionTest, HitPointLiesInTheDirectionOfTheSample) {
    using T = typename TypeParam::Real;
    using Kind = typename TypeParam::Kind;
    for (const auto& light : cases<Kind>()) {
        const auto local = light_for<Kind, T>(light);
        const typename TypeParam::Technique technique(local);
        for (const auto& u : midpoints<Kind, T>(7)) {
            const auto sample = technique.sample(u);
            EXPECT_NEAR(length(sample.wi), 1, kUnitBudget<T>) << light.name;
            EXPECT_LE(length(cross(sample.p, sample.wi)), kHitBudget<T> * length(sample.p)) << light.name;
            EXPECT_GT(dot(sample.p, sample.wi), 0) << light.name;
        }
    }
}

/// Distance of a point from a polygon: from its plane, or beyond an edge.
template <class T, int N>
T distance_to(const nusselt::ConvexPolygon<T, N>& polygon, const nusselt::Vec3<T>& p) {
    T distance = std::fabs(dot(polygon.normal, p - polygon.vertex[0]));
    for (int j = 0; j < N; ++j) {
        const auto inwards = cross(polygon.normal, normalize(polygon.edge[j]));
        distance = std::max(distance, -dot(inwards, p - polygon.vertex[j]));
    }
    return distance;
}

template <class T>
T distance_to(const nusselt::LineSegment<T>& line, const nusselt::Vec3<T>& p) {
    const T along = std::clamp(dot(p - line.p0, line.s), T(0), line.length);
    return length(p - line.p0 - along * line.s);
}

/// Distance of a point from the surface of a cylinder.
template <class T>
T distance_to(const nusselt::Cylinder<T>& cylinder, const nusselt::Vec3<T>& p) {
    const auto offset = p - cylinder.axis.p0;
    const T along = dot(offset, cylinder.axis.s);
    const T outwards = length(cross(offset, cylinder.axis.s)) - cylinder.radius;
    return std::fabs(std::max({outwards, -along, along - cylinder.axis.length}));
}

template <class T>
T distance_to(const nusselt::Sphere<T>& sphere, const nusselt::Vec3<T>& p) {
    return std::fabs(length(p - sphere.center) - sphere.radius);
}
template <class T>
T distance_to(const nusselt::Disk<T>& disk, const nusselt::Vec3<T>& p) {
    const auto offset = p - disk.center;
    return std::max(std::fabs(dot(disk.normal, offset)), length(offset) - disk.radius);
}
/// Distance from the plane; beyond the rim, that from it up to a factor.
template <class T>
T distance_to(const nusselt::Ellipse<T>& ellipse, const nusselt::Vec3<T>& p) {
    const auto area = cross(ellipse.u, ellipse.v);
    const auto offset = p - ellipse.center;
    const T x = dot(cross(offset, ellipse.v), area) / dot(area, area);
    const T y = dot(cross(ellipse.u, offset), area) / dot(area, area);
    return std::max(std::fabs(dot(normalize(area), offset)), (std::hypot(x, y) - 1) * length(ellipse.v));
}
/// Distance from the surface up to a factor.
template <class T>
T distance_to(const nusselt::Ellipsoid<T>& e, const nusselt::Vec3<T>& p) {
    const auto offset = p - e.center;
    const T volume = dot(e.axis[0], cross(e.axis[1], e.axis[2]));
    const auto share = [&](int i) {
        return dot(offset, cross(e.axis[(i + 1) % 3], e.axis[(i + 2) % 3])) / volume;
    };
    const T radius = std::hypot(share(0), share(1), share(2));
    return std::fabs(radius - 1) * std::min({length(e.axis[0]), length(e.axis[1]), length(e.axis[2])});
}

TYPED_TEST(InversionTest, HitPointLiesOnTheLight) {
    using T = typename TypeParam::Real;
    using Kind = typename TypeParam::Kind;
    for (const auto& light : cases<Kind>()) {
        const auto local = light_for<Kind, T>(light);
        const typename TypeParam::Technique technique(local);
        for (const auto& u : midpoints<Kind, T>(7)) {
            const auto sample = technique.sample(u);
            EXPECT_LE(distance_to(local, sample.p), kHitBudget<T> * length(sample.p)) << light.name;
            if (Kind::kHorizon == Horizon::clipped) {
                EXPECT_GT(sample.wi.z, 0) << light.name;
            }
        }
    }
}

} // namespace
} // namespace nusselt_test
