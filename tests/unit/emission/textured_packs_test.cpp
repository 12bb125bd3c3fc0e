/// Tests of sampling of polygons with textures in packs: each lane does what a scalar does for the same view of the light.

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "emission/pack_comparison.h"
#include "emission/textured_lights.h"
#include "ltc/lobes.h"

namespace nusselt_test {
namespace {

using nusselt::DescentByProduct;
using nusselt::DescentByRadiance;
using nusselt::LobeCells;
using nusselt::NearestFilter;
using nusselt::Pack;
using nusselt::ProjectedCells;
using nusselt::TexturedPolygon;
using nusselt::Vec2;
using nusselt::Vec3;
template <class Real>
using Plane = nusselt::TexturePlane<Real>;

constexpr int kLanes = 8;
template <class T>
using Lanes = Pack<T, kLanes>;

/// Sides and corners of all sizes: lights across the horizon, far, below it, around the shading point, without area.
template <class T>
Plane<T> some_plane(std::mt19937& random) {
    std::uniform_real_distribution<double> uniform(0, 1);
    std::normal_distribution<double> normal;
    const double distance = std::pow(10, 4 * uniform(random) - 2);
    const bool is_even = uniform(random) < 0.2;
    double c[9];
    for (double& x : c) x = is_even ? std::round(2 * uniform(random) - 1) : normal(random);
    const auto vector = [&](int k, double scale) {
        return Vec3<T>{static_cast<T>(scale * c[k]), static_cast<T>(scale * c[k + 1]),
                       static_cast<T>(scale * c[k + 2])};
    };
    return nusselt::make_texture_plane<T>(vector(0, distance), vector(3, 1), vector(6, 1));
}

template <class T, class Get>
Lanes<T> gathered(const std::vector<Plane<T>>& planes, const Get& get) {
    T values[kLanes];
    for (std::size_t k = 0; k < kLanes; ++k) values[k] = get(planes[k]);
    return Lanes<T>::load(values);
}
template <class T>
Vec3<Lanes<T>> gathered(const std::vector<Plane<T>>& planes, Vec3<T> Plane<T>::*member) {
    return {gathered(planes, [&](const Plane<T>& plane) { return (plane.*member).x; }),
            gathered(planes, [&](const Plane<T>& plane) { return (plane.*member).y; }),
            gathered(planes, [&](const Plane<T>& plane) { return (plane.*member).z; })};
}
template <class T>
Plane<Lanes<T>> gathered(const std::vector<Plane<T>>& planes) {
    return {gathered(planes, &Plane<T>::corner), gathered(planes, &Plane<T>::side_x),
            gathered(planes, &Plane<T>::side_y), gathered(planes, &Plane<T>::normal)};
}

template <class Real>
nusselt::Ltc<Real> lobe() {
    const auto c = tilted_lobe(0.5L, 0.4L, 1.1L, 0.1L);
    return nusselt::Ltc<Real>({Real(c.m00), Real(c.m02), Real(c.m11), Real(c.m20), Real(c.m22), Real(1)});
}

template <class Real>
ProjectedCells<Real> measure_of(ProjectedCells<Real>*) {
    return {};
}
template <class Real>
LobeCells<Real> measure_of(LobeCells<Real>*) {
    return {lobe<Real>()};
}

template <class T_, int n_, class Descent_, template <class> class Measure_>
struct Variant {
    using T = T_;
    static constexpr int n = n_;
    template <class Real>
    using Technique = TexturedPolygon<Real, n, Descent_, Measure_<Real>>;
    template <class Real>
    static Technique<Real> make(const Plane<Real>& plane, const nusselt::TexturedLight<T, n>& light) {
        return {plane, light, measure_of(static_cast<Measure_<Real>*>(nullptr))};
    }
};

template <class Variant>
class TexturedPacks : public ::testing::Test {};
using Variants = ::testing::Types<
    Variant<float, 8, DescentByRadiance, ProjectedCells>, Variant<float, 8, DescentByRadiance, LobeCells>,
    Variant<double, 16, DescentByRadiance, ProjectedCells>,
    Variant<double, 8, DescentByProduct, ProjectedCells>, Variant<double, 8, DescentByProduct, LobeCells>>;
TYPED_TEST_SUITE(TexturedPacks, Variants);

TYPED_TEST(TexturedPacks, DoWhatScalarsDo) {
    using T = typename TypeParam::T;
    constexpr int n = TypeParam::n;
    std::mt19937 random(12);
    std::uniform_real_distribution<T> uniform(0, T(0.999999));
    // Rough at the left and smooth at the right: neighbouring lanes need both kinds of cells.
    const SquareTexture<T> texture(64, [&](int i, int j) {
        return i > 32 ? 1 + 0.01 * j : (i / 5 + j / 7) % 3 == 0 ? 0 : std::pow(uniform(random), T(8));
    });
    Comparison<T> weights, samples, densities, inverses;
    int lit = 0;
    for (const auto& outline : outlines<T>()) {
        const StoredLight<T, n> stored(NearestFilter(), texture.view(), outline);
        for (int round = 0; round < 75; ++round) {
            std::vector<Plane<T>> planes;
            for (int k = 0; k < kLanes; ++k) planes.push_back(some_plane<T>(random));
            const auto packed = TypeParam::make(gathered(planes), stored.light);
            Vec2<T> u[kLanes], at[kLanes];
            Vec2<Lanes<T>> packed_u{}, packed_at{};
            for (int k = 0; k < kLanes; ++k) {
                u[k] = {uniform(random), uniform(random)};
                at[k] = {uniform(random), uniform(random)};
                packed_u.x.set_lane(k, u[k].x);
                packed_u.y.set_lane(k, u[k].y);
                packed_at.x.set_lane(k, at[k].x);
                packed_at.y.set_lane(k, at[k].y);
            }
            const auto s = packed.sample(packed_u);
            const Lanes<T> pdf = packed.pdf(s.wi);
            const Lanes<T> pdf_at = packed.pdf_at(packed_at);
            const Vec2<Lanes<T>> again = packed.invert(s.wi);
            const Vec3<Lanes<T>> unshadowed = packed.unshadowed();
            for (int k = 0; k < kLanes; ++k) {
                const auto single = TypeParam::make(planes[static_cast<std::size_t>(k)], stored.light);
                weights.add(single.measure(), packed.measure().lane(k));
                weights.add(single.unshadowed().x, unshadowed.x.lane(k));
                const auto expected = single.sample(u[k]);
                samples.add(expected.pdf, s.pdf.lane(k));
                densities.add(single.pdf_at(at[k]), pdf_at.lane(k));
                if (expected.pdf == 0) continue;
                ++lit;
                samples.add(expected.at.x, s.at.x.lane(k));
                samples.add(expected.at.y, s.at.y.lane(k));
                samples.add(expected.wi.z, s.wi.z.lane(k));
                samples.add(expected.p.x, s.p.x.lane(k));
                densities.add(single.pdf(expected.wi), pdf.lane(k));
                inverses.add(single.invert(expected.wi).x, again.x.lane(k));
                inverses.add(single.invert(expected.wi).y, again.y.lane(k));
            }
        }
    }
    EXPECT_GT(lit, 500);
    weights.expect_agreement(3000, 500);
    samples.expect_agreement(3000, 500);
    densities.expect_agreement(3000, 500);
    inverses.expect_agreement(3000, 500);
}

} // namespace
} // namespace nusselt_test
