/// Tests of BRDF sampling of polygons: which directions hit, quadrature over the light, hostile lights, and packs.

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/bsdf/frostbite.h>
#include <nusselt/random/sobol.h>
#include <nusselt/random/unit_interval.h>
#include <nusselt/sampling/polygon_brdf.h>

#include "bsdf/ggx_reference.h"
#include "contract.h"
#include "lights.h"

namespace nusselt_test {
namespace {

using nusselt::BoundedCap;
using nusselt::broadcast;
using nusselt::ConvexPolygon;
using nusselt::dot;
using nusselt::GgxVisibleNormals;
using nusselt::PolygonBrdf;
using nusselt::Vec2;
using nusselt::VisibleCap;

template <class Real>
using Direction = nusselt::Vec3<Real>;
template <class Real, class Cap, int N = 4>
using Technique = PolygonBrdf<Real, N, GgxVisibleNormals<Real, Cap>>;

constexpr std::uint32_t kSamples = 1 << 18;

Vec2<double> net_point(std::uint32_t i) {
    const nusselt::UInt2 bits = nusselt::sobol(i);
    return {nusselt::to_unit<double>(bits.x), nusselt::to_unit<double>(bits.y)};
}

/// Lobes that reflect towards the lights of polygon_cases().
const std::vector<GgxReference>& lobes() {
    static const std::vector<GgxReference> list = {
        {direction_at(0.7L, 3.6L), 0.3L}, {direction_at(1.3L, 3), 0.15L}, {direction_at(0.2L, 1), 1}};
    return list;
}

template <class Cap>
Technique<double, Cap> technique_for(const PolygonCase& light, const GgxReference& lobe) {
    const GgxVisibleNormals<double, Cap> normals(broadcast<double>(lobe.wo), static_cast<double>(lobe.alpha));
    return {make_light<double>(light), normals};
}

template <class Cap>
class PolygonBrdfTest : public ::testing::Test {};
using Caps = ::testing::Types<VisibleCap, BoundedCap>;
TYPED_TEST_SUITE(PolygonBrdfTest, Caps);

/// The boundary of a light crosses boxes of the net, which leaves an error of order kSamples^(-3/4), 9e-5.
TYPED_TEST(PolygonBrdfTest, DensityIntegratesToTheShareOfHits) {
    for (const PolygonCase& light : polygon_cases()) {
        for (const GgxReference& lobe : lobes()) {
            const auto technique = technique_for<TypeParam>(light, lobe);
            int hits = 0;
            for (std::uint32_t i = 0; i < kSamples; ++i) {
                const auto sample = technique.sample(net_point(i));
                hits += sample.pdf > 0 && sample.wi.z > 0;
            }
            const Polygon lit = above_horizon(vertices_of(make_light<double>(light)));
            const auto density = [&](const Point& wi) {
                return std::is_same_v<TypeParam, BoundedCap> ? lobe.bounded_pdf(wi) : lobe.pdf(wi);
            };
            EXPECT_NEAR(static_cast<double>(hits) / kSamples, integrate_solid_angle(lit, density, 1e-7L),
                        2e-4)
                << light.name;
        }
    }
}

TYPED_TEST(PolygonBrdfTest, EstimatesSpecularReflection) {
    for (const PolygonCase& light : polygon_cases()) {
        for (const GgxReference& lobe : lobes()) {
            const auto technique = technique_for<TypeParam>(light, lobe);
            const auto roughness = static_cast<double>(std::sqrt(lobe.alpha));
            const nusselt::Frostbite<double> brdf(broadcast<double>(lobe.wo), {0, 0, 0}, {0.3, 0, 0},
                                                  roughness);
            double sum = 0;
            for (std::uint32_t i = 0; i < kSamples; ++i) {
                const auto sample = technique.sample(net_point(i));
                if (sample.pdf > 0) sum += brdf.eval_specular(sample.wi).x * sample.wi.z / sample.pdf;
            }
            const Polygon lit = above_horizon(vertices_of(make_light<double>(light)));
            const auto reflected = [&](const Point& wi) {
                return brdf.eval_specular(broadcast<double>(wi)).x * wi.z;
            };
            EXPECT_NEAR(sum / kSamples, integrate_solid_angle(lit, reflected, 1e-7L), 5e-5) << light.name;
        }
    }
}

/// How far inside a polygon the intersection of its plane with a ray from the origin is, relative to the polygon's
/// extent. It is negative outside and for rays that point away.
long double depth(const Polygon& polygon, const Point& wi) {
    const Point normal = cross(polygon[1] - polygon[0], polygon[2] - polygon[0]);
    const long double along = dot(normal, polygon[0]) / dot(normal, wi);
    if (along < 0) return -1;
    const Point p = along * wi;
    long double smallest = 1;
    long double extent = length(p);
    for (std::size_t j = 0; j < polygon.size(); ++j) {
        const Point edge = polygon[(j + 1) % polygon.size()] - polygon[j];
        const Point inwards = normalize(cross(normal, edge));
        smallest = std::min(smallest, dot(inwards, p - polygon[j]));
        extent = std::max(extent, length(polygon[j]));
    }
    return smallest / extent;
}

template <int N>
void expect_hits_where_the_light_is(const std::vector<PolygonCase>& lights) {
    int hits = 0;
    for (const PolygonCase& light : lights) {
        const auto polygon = make_light<float, N>(light);
        const GgxVisibleNormals<float> normals({0.28f, -0.48f, 0.8314f}, 0.5f);
        const PolygonBrdf technique(polygon, normals);
        for (std::uint32_t i = 0; i < 4096; ++i) {
            const auto sample = technique.sample(broadcast<float>(net_point(i)));
            const long double inside = depth(vertices_of(polygon), broadcast<long double>(sample.wi));
            if (std::fabs(inside) < 1e-6L) continue;
            ASSERT_EQ(sample.pdf > 0, inside > 0) << light.name;
            if (inside < 0) continue;
            ++hits;
            ASSERT_EQ(sample.pdf, normals.pdf(sample.wi));
        }
    }
    EXPECT_GT(hits, 1000);
}

TEST(PolygonBrdf, HitsWhereTheLightIs) {
    expect_hits_where_the_light_is<4>(polygon_cases());
    expect_hits_where_the_light_is<8>(many_vertex_cases());
}

TEST(PolygonBrdf, Inverts) {
    for (const PolygonCase& light : polygon_cases()) {
        const auto technique = technique_for<VisibleCap>(light, lobes()[0]);
        const auto sample = technique.sample({0.3, 0.4});
        EXPECT_NEAR(technique.invert(sample.wi).x, 0.3, 1e-12);
        EXPECT_NEAR(technique.invert(sample.wi).y, 0.4, 1e-12);
    }
}

/// The facts that the contract needs about the technique.
struct Kind : PolygonKind<4> {
    static constexpr Measure kMeasure = Measure::solid_angle;
    static constexpr Horizon kHorizon = Horizon::ignored;
};

template <class T>
struct HostileCase {
    ConvexPolygon<T, 4> light;
    Direction<T> wo;
    T roughness;
    Vec2<T> u;
};

/// Hostile lights, most of them in the middle of a lobe.
template <class T>
class HostileCases {
public:
    HostileCase<T> next() {
        HostileCase<T> result;
        result.light = lights_.template polygon<4>();
        const Direction<T> half = normalize(result.light.vertex[0] + result.light.vertex[2]);
        const Direction<T> mirrored{-half.x, -half.y, std::fabs(half.z)};
        const Direction<T> any = normalize(broadcast<T>(random_.direction()));
        result.wo = random_.index(4) == 0 ? any : mirrored;
        result.roughness = random_.index(4) == 0 ? T(0) : static_cast<T>(random_.uniform());
        result.u = {lights_.random_number(), lights_.random_number()};
        return result;
    }

private:
    HostileLights<T> lights_{21};
    RandomSource random_{22};
};

template <class T, class Cap>
Technique<T, Cap> technique_of(const HostileCase<T>& c) {
    return {c.light, GgxVisibleNormals<T, Cap>(c.wo, nusselt::ggx_alpha(c.roughness))};
}

template <class T, class Cap>
void expect_contract() {
    HostileCases<T> cases;
    int hits = 0;
    for (int i = 0; i < 200000; ++i) {
        const auto c = cases.next();
        const auto technique = technique_of<T, Cap>(c);
        const auto sample = technique.sample(c.u);
        hits += sample.pdf > 0;
        // The technique has no measure, so 1 takes its place.
        const Outputs<T, Vec2<T>> outputs{sample, sample.pdf > 0 ? technique.pdf(sample.wi) : T(0),
                                          technique.invert(sample.wi), T(1)};
        const char* broken = nusselt::hostile::violation<Kind, T>(c.light, outputs);
        ASSERT_EQ(broken, nullptr) << broken << ": " << hexadecimal<T>(c);
    }
    EXPECT_GT(hits, 20000);
}

TYPED_TEST(PolygonBrdfTest, KeepsTheContractOnHostileLights) {
    expect_contract<float, TypeParam>();
    expect_contract<double, TypeParam>();
    expect_contract<long double, TypeParam>();
}

TYPED_TEST(PolygonBrdfTest, NothingHitsWhatCannotBeSeen) {
    const GgxVisibleNormals<float, TypeParam> normals({0, 0, 1}, 1);
    const std::vector<std::vector<Direction<double>>> dark = {
        {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}},     // in a plane with the shading point
        {{-1, 1, 1}, {1, 1, 1}, {0, 1, 1}, {0.5, 1, 1}},  // without area
        {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, // around the shading point
    };
    for (const auto& vertices : dark) {
        const PolygonBrdf technique(make_light<float>(PolygonCase{"", vertices}), normals);
        EXPECT_EQ(technique.pdf({0, 0, 1}), 0);
        for (std::uint32_t i = 0; i < 4096; ++i)
            ASSERT_EQ(technique.sample(broadcast<float>(net_point(i))).pdf, 0);
    }
    // Seen from below the surface.
    const GgxVisibleNormals<float, TypeParam> none({0, 0.6f, -0.8f}, 1);
    const PolygonBrdf below(make_light<float>(polygon_cases()[0]), none);
    EXPECT_EQ(below.sample({0.2f, 0.3f}).pdf, 0);
    EXPECT_EQ(below.pdf({0, 0, 1}), 0);
}

/// First, one lane at a time has a hostile light while its neighbours hold NaN; then all lanes have the same light.
template <class P, class Cap>
void expect_lanes_equal_scalars() {
    using T = nusselt::scalar_t<P>;
    constexpr int kLanes = nusselt::RealTraits<P>::kLanes;
    HostileCases<T> cases;
    for (int i = 0; i < 20000; ++i) {
        const auto c = cases.next();
        const int lane = i % kLanes;
        HostileCase<P> lanes;
        std::memset(&lanes, 0xff, sizeof lanes); // quiet NaN in every number
        set_lane<T>(lanes.light, lane, c.light);
        set_lane<T>(lanes.wo, lane, c.wo);
        set_lane<T>(lanes.roughness, lane, c.roughness);
        set_lane<T>(lanes.u, lane, c.u);
        const auto scalar = technique_of<T, Cap>(c);
        const auto expected = scalar.sample(c.u);
        for (const auto& packed : {technique_of<P, Cap>(lanes), Technique<P, Cap>(scalar)}) {
            const auto samples = packed.sample(lanes.u);
            const auto sample = get_lane<T, nusselt::LightSample<T>>(samples, lane);
            ASSERT_EQ(sample.pdf, expected.pdf);
            ASSERT_EQ(sample.wi.x, expected.wi.x);
            ASSERT_EQ(sample.wi.z, expected.wi.z);
            ASSERT_EQ(sample.p.x, expected.p.x);
            ASSERT_EQ(sample.p.z, expected.p.z);
            ASSERT_EQ(packed.pdf(samples.wi).lane(lane), scalar.pdf(expected.wi));
        }
    }
}

TYPED_TEST(PolygonBrdfTest, LanesEqualScalars) {
    expect_lanes_equal_scalars<NativeFloat, TypeParam>();
    expect_lanes_equal_scalars<NativeDouble, TypeParam>();
}

} // namespace
} // namespace nusselt_test
