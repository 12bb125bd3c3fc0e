/// Compares sample_direct_light, which works in world space, with DirectLight, which works in shading space.

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/estimate/direct_light.h>

#include "sampling/lights.h"

namespace nusselt_test {
namespace {

using nusselt::DirectLight;
using nusselt::Frame;
using nusselt::LtcTableView;
using nusselt::SurfacePoint;
using nusselt::Vec2;
using nusselt::Vec3;
using Point = Vec3<double>;
using Heuristic = nusselt::OptimalHeuristic<double>;

/// Provides a table of random lobes, since the test does not depend on the BRDF.
class WorldSpaceTest : public testing::Test {
protected:
    WorldSpaceTest() {
        std::mt19937 engine(1);
        std::uniform_real_distribution<float> value(0.1f, 1.0f);
        for (int i = 0; i < 3 * 3 * 2 * LtcTableView::kStride; ++i) entries_.push_back(value(engine));
    }
    LtcTableView table() const { return {entries_.data(), 3, 3, 2}; }

private:
    std::vector<float> entries_;
};

constexpr Vec2<double> kRandomNumbers[][2] = {
    {{0.1, 0.7}, {0.4, 0.2}}, {{0.3, 0.2}, {0.9, 0.5}}, {{0.75, 0.4}, {0.01, 0.99}}};

/// The origin and the axes of shading space in world space.
struct Placement {
    Point position;
    Frame<double> frame;

    Point operator()(const Point& p) const { return position + frame.to_world(p); }
};

Placement somewhere() {
    Frame<double> frame = Frame<double>::from_normal(nusselt::normalize(Point{0.3, -0.8, 0.4}));
    // Turn the frame about the normal.
    const Point t = 0.6 * frame.t + 0.8 * frame.b;
    return {{3, -2, 5}, {t, cross(frame.n, t), frame.n}};
}

auto placed(const PolygonCase& light, const Placement& placement) {
    PolygonCase result = light;
    for (Point& v : result.vertices) v = placement(v);
    return make_light<double>(result);
}
auto placed(const LineCase& light, const Placement& placement) {
    return make_light<double>(LineCase{"", placement(light.begin), placement(light.end)});
}
auto placed(const CylinderCase& light, const Placement& placement) {
    return make_light<double>(CylinderCase{"", placement(light.begin), placement(light.end), light.radius});
}

SurfacePoint<double> surface_point(const Placement& placement, double cos_o, double roughness) {
    const Point wo{std::sqrt((1 - cos_o) * (1 + cos_o)), 0, cos_o};
    return {placement.position, placement.frame.n, placement.frame.to_world(wo),
            {0.5, 0.25, 0.75},  {0.04, 0.5, 1},    roughness};
}

double largest_coordinate(const Point& p) {
    return std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
}

template <class Case>
void expect_invariant(const Case& light, double cos_o, double roughness, const LtcTableView& table) {
    const Placement placement = somewhere();
    const SurfacePoint<double> point = surface_point(placement, cos_o, roughness);
    const auto local = make_light<double>(light);
    const auto surface = nusselt::make_glossy_surface(cos_o, point.albedo, point.f0, roughness, table);
    const DirectLight<double, std::decay_t<decltype(local)>> estimator(local, surface);
    const Heuristic heuristic{0.5};
    for (const auto& u : kRandomNumbers) {
        const auto world = nusselt::sample_direct_light(point, placed(light, placement), table, heuristic, u);
        const nusselt::DirectLightSample<double> expected[] = {estimator.sample_diffuse(heuristic, u[0]),
                                                               estimator.sample_specular(heuristic, u[1])};
        for (int k = 0; k < 2; ++k) {
            const auto& w = world.sample[k];
            const auto& e = expected[k];
            const auto same = [&](const Point& a, const Point& b) {
                EXPECT_LT(largest_coordinate(a - b), 1e-9 * (1 + largest_coordinate(b)))
                    << light.name << ", technique " << k;
            };
            same(w.shadowed, e.shadowed);
            same(w.constant, e.constant);
            if (largest_coordinate(e.shadowed) == 0) continue;
            same(w.direction, placement.frame.to_world(e.wi));
            EXPECT_NEAR(length(w.direction), 1, 1e-14);
            same(placement.position + w.distance * w.direction, placement(e.p));
        }
    }
}

TEST_F(WorldSpaceTest, RotationAndTranslationChangeNothing) {
    for (const double cos_o : {0.9, 0.5, 0.02}) {
        for (const double roughness : {0.2, 0.9}) {
            for (const PolygonCase& light : polygon_cases())
                expect_invariant(light, cos_o, roughness, table());
            for (const LineCase& light : line_cases()) expect_invariant(light, cos_o, roughness, table());
            for (CylinderCase light : cylinder_cases()) {
                // In front of the cap of a horizontal cylinder, rounding would decide on the range of azimuths.
                light.end.z -= 0.01;
                expect_invariant(light, cos_o, roughness, table());
            }
        }
    }
}

/// Along the normal, any tangent is valid. Samples depend on the choice, but they must lie on the light.
TEST_F(WorldSpaceTest, SeenFromTheNormalRaysEndOnTheLight) {
    const Placement placement = somewhere();
    const SurfacePoint<double> point = surface_point(placement, 1, 0.5);
    for (const PolygonCase& light : polygon_cases()) {
        const auto polygon = placed(light, placement);
        for (const auto& u : kRandomNumbers) {
            for (const auto& s :
                 nusselt::sample_direct_light(point, polygon, table(), Heuristic{0.5}, u).sample) {
                if (largest_coordinate(s.shadowed) == 0) continue;
                const Point hit = placement.position + s.distance * s.direction;
                EXPECT_NEAR(dot(polygon.normal, hit - polygon.vertex[0]), 0, 1e-12) << light.name;
                EXPECT_TRUE(std::isfinite(s.shadowed.x) && s.shadowed.x >= 0) << light.name;
            }
        }
    }
}

TEST_F(WorldSpaceTest, SeenFromBelowTheSurfaceIsBlack) {
    const Placement placement = somewhere();
    const SurfacePoint<double> point = surface_point(placement, -0.5, 0.5);
    const auto polygon = placed(polygon_cases()[0], placement);
    const nusselt::ClampedOptimalHeuristic<double> heuristic{0.5};
    for (const auto& u : kRandomNumbers)
        for (const auto& s : nusselt::sample_direct_light(point, polygon, table(), heuristic, u).sample)
            EXPECT_EQ(largest_coordinate(s.shadowed) + largest_coordinate(s.constant), 0);
}

} // namespace
} // namespace nusselt_test
