/// The contract at the ends of the range of float, far beyond the 1e15 m that hostile lights reach.

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "contract.h"
#include "lights.h"

namespace nusselt_test {
namespace {

using Vec = nusselt::Vec3<float>;

Vec times(double scale, const Vec& v) {
    return nusselt::broadcast<float>(scale * nusselt::broadcast<double>(v));
}
template <int N>
void rescale(nusselt::ConvexPolygon<float, N>& light, double scale) {
    Vec vertices[N];
    for (int j = 0; j < N; ++j) vertices[j] = times(scale, light.vertex[j]);
    light = nusselt::make_polygon<N>(vertices, N);
}
void rescale(nusselt::LineSegment<float>& light, double scale) {
    light = nusselt::make_line(times(scale, light.p0), times(scale, end_of(light)));
}
void rescale(nusselt::Cylinder<float>& light, double scale) {
    rescale(light.axis, scale);
    light.radius = static_cast<float>(scale * light.radius);
}

void rescale(nusselt::Sphere<float>& light, double scale) {
    light = {times(scale, light.center), static_cast<float>(scale * light.radius)};
}
void rescale(nusselt::Disk<float>& light, double scale) {
    light = {times(scale, light.center), light.normal, static_cast<float>(scale * light.radius)};
}
void rescale(nusselt::Ellipse<float>& light, double scale) {
    light = {times(scale, light.center), times(scale, light.u), times(scale, light.v)};
}
void rescale(nusselt::Ellipsoid<float>& light, double scale) {
    light = {times(scale, light.center),
             {times(scale, light.axis[0]), times(scale, light.axis[1]), times(scale, light.axis[2])}};
}

template <class Test>
class ExtremeScalesTest : public ::testing::Test {};
struct ContractSuite {
    static constexpr std::string_view kName = "contract";
};
using Tests =
    Instances<TestedBy<ContractSuite, PolygonKinds<4>, PolygonOnLobeKinds<4>, LineKinds, LineOnLobeKinds,
                       CylinderKinds, CylinderOnLobeKinds, RoundKinds, RoundOnLobeKinds>,
              float>;
TYPED_TEST_SUITE(ExtremeScalesTest, Tests, InstanceNames);

/// A quarter of the largest number is the limit: differences of coordinates must fit, and lengths of these.
TYPED_TEST(ExtremeScalesTest, NothingFails) {
    using Kind = typename TypeParam::Kind;
    for (const int exponent : {-149, -140, -126, -110, -90, 65, 80, 100, 120, 126}) {
        HostileLights<float> lights(11);
        for (int i = 0; i < 2000; ++i) {
            auto light = hostile_light<Kind>(lights);
            const auto u = hostile_random<Kind>(lights);
            const double extent = Bounds(light).extent;
            if (!(extent > 0)) continue;
            rescale(light, std::ldexp(1.0, exponent) / extent);
            const auto out = outputs_of<Kind, float>(light, u);
            ASSERT_STREQ((violation<Kind, float>(light, out)), nullptr) << exponent;
        }
    }
}

/// The smallest and the largest light of a kind [m] that docs/conventions.md promises: areas of polygons must fit.
template <class Kind>
constexpr std::array<double, 2> kExtents =
    kIsPolygon<Kind> ? std::array{1e-19, 1e18} : std::array{1e-33, 1e34};

TYPED_TEST(ExtremeScalesTest, MeasuresDoNotDependOnTheUnit) {
    using Kind = typename TypeParam::Kind;
    if constexpr (Kind::kMeasure != Measure::area) {
        constexpr bool kIsLine = !kTakesPairs<Kind>;
        const auto measure = [](const auto& light) {
            return static_cast<double>(typename TypeParam::Technique(light).measure());
        };
        for (const auto& light : cases<Kind>()) {
            const double usual = measure(light_for<Kind, float>(light));
            for (const double extent : kExtents<Kind>) {
                auto scaled = light_for<Kind, float>(light);
                // A power of two keeps the bits of coordinates.
                const double scale = std::exp2(std::round(std::log2(extent / Bounds(scaled).extent)));
                rescale(scaled, scale);
                EXPECT_NEAR(measure(scaled) * (kIsLine ? scale : 1), usual, 1e-4 * usual)
                    << light.name << " " << extent;
            }
        }
    }
}

} // namespace
} // namespace nusselt_test
