/// Chi-square tests of samples of polygons with textures against their density. Wrong samplers must be rejected.

#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "emission/textured_lights.h"
#include "hypothesis.h"
#include "ltc/lobes.h"

namespace nusselt_test {
namespace {

using nusselt::DescentByProduct;
using nusselt::DescentByRadiance;
using nusselt::LobeCells;
using nusselt::NearestFilter;
using nusselt::TexturedPolygon;
using nusselt::TexturedPolygonLtc;
using nusselt::Vec2;
using nusselt::Vec3;
using Plane = nusselt::TexturePlane<double>;

constexpr int kTexels = 64;
constexpr int kSamples = 100000;
constexpr double kRejected = 1e-9;
constexpr double kAccepted = 1e-4;

/// Smooth on the left, where cells are sampled by projected solid angle, and rough on the right, with black texels.
const SquareTexture<double>& texture() {
    static const SquareTexture<double> result(kTexels, [](int i, int j) {
        const int noise = (i * 37 + j * 101 + i * j * 13) % 11;
        return i < 32 ? 2 + 0.02 * j : noise < 4 ? 0 : noise;
    });
    return result;
}

std::vector<Plane> planes() {
    return {
        nusselt::make_texture_plane<double>({-0.4, -0.3, 0.5}, {1, 0.1, 0}, {0, 0.9, 0.4}),
        nusselt::make_texture_plane<double>({1, -0.6, -0.4}, {0, 1, 0.1}, {0.1, 0, 1}),
        // A wall nearby, where angles and cosines vary much in a cell.
        nusselt::make_texture_plane<double>({0.15, -0.3, 0.02}, {0, 1, 0}, {0.1, 0, 0.8}),
    };
}

/// The surface that a technique is for. Points have density where they have a positive height.
template <class Technique>
struct SurfaceOf {
    static Technique make(const Plane& plane, const typename Technique::Light& light) {
        return Technique(plane, light);
    }
    static double height(const Vec3<double>& p) { return p.z; }
};
template <int n, class Descent>
struct SurfaceOf<TexturedPolygon<double, n, Descent, LobeCells<double>>> {
    using Technique = TexturedPolygon<double, n, Descent, LobeCells<double>>;

    static nusselt::Ltc<double> lobe() {
        const auto c = tilted_lobe(0.6L, 0.3L, 1.1L, 0.1L);
        return nusselt::Ltc<double>(
            {double(c.m00), double(c.m02), double(c.m11), double(c.m20), double(c.m22), 1});
    }
    static Technique make(const Plane& plane, const typename Technique::Light& light) {
        return Technique(plane, light, {lobe()});
    }
    static double height(const Vec3<double>& p) { return lobe().to_cosine(p).z; }
};

/// Expected numbers of samples per texel, by quadrature of the density.
template <class Technique>
std::vector<double> expected_counts(const Technique& technique, const Plane& plane) {
    constexpr int kSteps = 2; // per texel and direction
    constexpr double kNode[kSteps] = {0.2113248654051871, 0.7886751345948129};
    constexpr double kWeight = 0.25;
    std::vector<double> counts;
    for (int j = 0; j < kTexels; ++j) {
        for (int i = 0; i < kTexels; ++i) {
            double sum = 0;
            for (int k = 0; k < kSteps * kSteps; ++k) {
                const Vec2<double> at{(i + kNode[k % kSteps]) / kTexels, (j + kNode[k / kSteps]) / kTexels};
                if (SurfaceOf<Technique>::height(plane.point_at(at)) > 0)
                    sum += kWeight * technique.pdf_at(at) * solid_angle_density(plane, at);
            }
            counts.push_back(sum * kSamples / (kTexels * kTexels));
        }
    }
    return counts;
}

/// \param sample maps random numbers to a TexturedSample.
template <class Sample>
std::vector<std::int64_t> observed_counts(const Sample& sample) {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<std::int64_t> counts(kTexels * kTexels, 0);
    for (int k = 0; k < kSamples; ++k) {
        const double x = uniform(random);
        const auto s = sample(Vec2<double>{x, uniform(random)});
        const auto texel = static_cast<std::size_t>(static_cast<int>(s.at.y * kTexels) * kTexels +
                                                    static_cast<int>(s.at.x * kTexels));
        if (s.pdf > 0) ++counts[texel];
    }
    return counts;
}

/// Texels that the horizon cuts are off by the error of the quadrature, and some of their samples have no density. All of these
/// samples together are one more cell.
template <class Technique, class Sample>
double p_value(const Technique& technique, const Plane& plane, const Sample& sample) {
    std::vector<double> expected = expected_counts(technique, plane);
    std::vector<std::int64_t> observed = observed_counts(sample);
    for (int j = 0; j < kTexels; ++j) {
        for (int i = 0; i < kTexels; ++i) {
            int above = 0;
            for (int k = 0; k < 4; ++k)
                above += SurfaceOf<Technique>::height(
                             plane.point_at({static_cast<double>(i + k % 2) / kTexels,
                                             static_cast<double>(j + k / 2) / kTexels})) > 0;
            if (above == 0 || above == 4) continue;
            const auto texel = static_cast<std::size_t>(j * kTexels + i);
            expected[texel] = static_cast<double>(observed[texel] = 0);
        }
    }
    const auto add_rest = [](auto& counts) {
        counts.push_back(
            std::accumulate(counts.begin(), counts.end(), decltype(counts[0] + 0)(kSamples), std::minus<>()));
    };
    add_rest(expected);
    add_rest(observed);
    return chi_square_test(expected, observed);
}

template <class Technique>
class TexturedSamplesTest : public ::testing::Test {};
using Techniques = ::testing::Types<TexturedPolygon<double, 16>, TexturedPolygon<double, 8, DescentByProduct>,
                                    TexturedPolygonLtc<double, 16>>;
TYPED_TEST_SUITE(TexturedSamplesTest, Techniques);

template <class Technique>
using LightOf = StoredLight<double, Technique::Light::kCells == 256 ? 16 : 8>;

TYPED_TEST(TexturedSamplesTest, FollowTheirDensity) {
    const LightOf<TypeParam> stored(NearestFilter(), texture().view(), unit_square<double>());
    for (const Plane& plane : planes()) {
        const TypeParam technique = SurfaceOf<TypeParam>::make(plane, stored.light);
        EXPECT_GT(p_value(technique, plane, [&](const Vec2<double>& u) { return technique.sample(u); }),
                  kAccepted);
    }
}

TYPED_TEST(TexturedSamplesTest, ShiftOfATexelIsRejected) {
    const LightOf<TypeParam> stored(NearestFilter(), texture().view(), unit_square<double>());
    const Plane plane = planes()[2];
    const TypeParam technique = SurfaceOf<TypeParam>::make(plane, stored.light);
    const auto shifted = [&](const Vec2<double>& u) {
        auto s = technique.sample(u);
        s.at.x = std::min(s.at.x + 1.0 / kTexels, 0.999999);
        return s;
    };
    EXPECT_LT(p_value(technique, plane, shifted), kRejected);
}

/// Samples in smooth cells that are uniform in area: the solid angle per area is left out.
TYPED_TEST(TexturedSamplesTest, MissingJacobianIsRejected) {
    const LightOf<TypeParam> stored(NearestFilter(), texture().view(), unit_square<double>());
    const Plane plane = planes()[2];
    const TypeParam technique = SurfaceOf<TypeParam>::make(plane, stored.light);
    std::mt19937 random(9);
    std::uniform_real_distribution<double> uniform(0, 1);
    const double cells = TypeParam::Light::kCells == 256 ? 16 : 8;
    const auto uniform_in_area = [&](const Vec2<double>& u) {
        auto s = technique.sample(u);
        if (s.at.x < 0.5) {
            s.at.x = (std::floor(s.at.x * cells) + uniform(random)) / cells;
            s.at.y = (std::floor(s.at.y * cells) + uniform(random)) / cells;
        }
        return s;
    };
    EXPECT_LT(p_value(technique, plane, uniform_in_area), kRejected);
}

/// One sample in fifty has no density, where the horizon cuts nothing.
TYPED_TEST(TexturedSamplesTest, LostSamplesAreRejected) {
    const LightOf<TypeParam> stored(NearestFilter(), texture().view(), unit_square<double>());
    const Plane plane = planes()[0];
    const TypeParam technique = SurfaceOf<TypeParam>::make(plane, stored.light);
    std::mt19937 random(10);
    const auto lossy = [&](const Vec2<double>& u) {
        auto s = technique.sample(u);
        if (random() % 50 == 0) s.pdf = 0;
        return s;
    };
    EXPECT_LT(p_value(technique, plane, lossy), kRejected);
}

/// The surface is turned by a tenth of a radian.
TYPED_TEST(TexturedSamplesTest, WrongCosineIsRejected) {
    const LightOf<TypeParam> stored(NearestFilter(), texture().view(), unit_square<double>());
    const Plane plane = planes()[2];
    const TypeParam technique = SurfaceOf<TypeParam>::make(plane, stored.light);
    const auto frame = nusselt::Frame<double>::from_normal({std::sin(0.1), 0, std::cos(0.1)});
    const TypeParam turned =
        SurfaceOf<TypeParam>::make(to_shading_space(plane, {0, 0, 0}, frame), stored.light);
    EXPECT_LT(p_value(technique, plane, [&](const Vec2<double>& u) { return turned.sample(u); }), kRejected);
}

} // namespace
} // namespace nusselt_test
