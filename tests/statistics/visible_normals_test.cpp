/// Counts samples of visible normals in cells of directions and compares the counts with quadrature of the textbook's
/// density.

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/bsdf/ggx_visible_normals.h>

#include "bsdf/ggx_reference.h"
#include "hypothesis.h"

namespace nusselt_test {
namespace {

using nusselt::BoundedCap;
using nusselt::broadcast;
using nusselt::GgxVisibleNormals;
using nusselt::VisibleCap;

using Direction = nusselt::Vec3<float>;
using Random = nusselt::Vec2<float>;

constexpr int kSamples = 100'000;
constexpr std::size_t kCellsPerAxis = 8;

const std::vector<GgxReference>& lobes() {
    static const std::vector<GgxReference> list = {
        {direction_at(0.3L, 0), 0.3L}, {direction_at(0, 0), 0.5L},     {direction_at(1.2L, 4), 0.1L},
        {direction_at(0.8L, 3), 1},    {direction_at(1.5L, -2), 0.2L}, {direction_at(0.7L, 1), 0.003L}};
    return list;
}

/// Cells in cosine and azimuth above the surface, which are finer where samples are denser, and one cell for the
/// rest.
template <class Cap>
class Cells {
public:
    /// \param some samples other than those that are counted.
    Cells(const GgxReference& lobe, const std::vector<Direction>& some)
        : lobe_(lobe), mirrored_(std::atan2(-lobe.wo.y, -lobe.wo.x)) {
        std::vector<long double> cosines, azimuths;
        for (const Direction& wi : some) {
            if (wi.z <= 0) continue;
            cosines.push_back(wi.z);
            azimuths.push_back(azimuth(wi));
        }
        cosines_ = quantiles(cosines, 0, 1);
        azimuths_ = quantiles(azimuths, -kPi, kPi);
    }

    std::vector<double> expected() const {
        std::vector<double> counts;
        long double rest = 1;
        for (std::size_t i = 0; i < kCellsPerAxis; ++i) {
            for (std::size_t j = 0; j < kCellsPerAxis; ++j) {
                const long double height = cosines_[i + 1] - cosines_[i];
                const long double width = azimuths_[j + 1] - azimuths_[j];
                const auto density = [&](long double x, long double y) {
                    const Point wi = direction_at(std::acos(cosines_[i] + height * x),
                                                  mirrored_ + azimuths_[j] + width * y);
                    return std::is_same_v<Cap, BoundedCap> ? lobe_.bounded_pdf(wi) : lobe_.pdf(wi);
                };
                const long double share = height * width * integrate_square(density, 1e-6L);
                counts.push_back(static_cast<double>(kSamples * share));
                rest -= share;
            }
        }
        counts.push_back(static_cast<double>(kSamples * std::max(rest, 0.0L)));
        return counts;
    }

    static constexpr std::size_t kCount = kCellsPerAxis * kCellsPerAxis + 1;

    std::size_t index(const Direction& wi) const {
        if (!(wi.z > 0)) return kCount - 1;
        return interval(cosines_, wi.z) * kCellsPerAxis + interval(azimuths_, azimuth(wi));
    }

private:
    using Boundaries = std::array<long double, kCellsPerAxis + 1>;

    static Boundaries quantiles(std::vector<long double>& values, long double low, long double high) {
        std::sort(values.begin(), values.end());
        Boundaries result{low};
        for (std::size_t i = 1; i < kCellsPerAxis; ++i) result[i] = values[values.size() * i / kCellsPerAxis];
        result[kCellsPerAxis] = high;
        return result;
    }
    static std::size_t interval(const Boundaries& boundaries, long double x) {
        const auto inner = std::upper_bound(boundaries.begin() + 1, boundaries.end() - 1, x);
        return static_cast<std::size_t>(inner - boundaries.begin() - 1);
    }
    long double azimuth(const Direction& wi) const {
        return std::remainder(
            std::atan2(static_cast<long double>(wi.y), static_cast<long double>(wi.x)) - mirrored_, 2 * kPi);
    }

    GgxReference lobe_;
    long double mirrored_; ///< azimuth opposite to wo
    Boundaries cosines_, azimuths_;
};

/// Whether samples of many lobes disagree with a density.
/// \tparam Cap the cap of the density.
/// \param make_sampler maps a lobe to a function from random numbers to directions.
template <class Cap, class MakeSampler>
bool samples_are_rejected(const MakeSampler& make_sampler) {
    UniformFloats random(11);
    return reject(lobes(), [&](const GgxReference& lobe) {
        const auto sampler = make_sampler(lobe);
        const auto next = [&] {
            const float x = random();
            return sampler(Random{x, random()});
        };
        std::vector<Direction> some;
        for (int i = 0; i < 4096; ++i) some.push_back(next());
        const Cells<Cap> cells(lobe, some);
        std::vector<std::int64_t> observed(Cells<Cap>::kCount);
        for (int i = 0; i < kSamples; ++i) ++observed[cells.index(next())];
        return chi_square_test(cells.expected(), observed);
    });
}

template <class Cap>
auto sampler_of(const GgxReference& lobe) {
    return
        [normals = GgxVisibleNormals<float, Cap>(broadcast<float>(lobe.wo), static_cast<float>(lobe.alpha))](
            const Random& u) { return normals.sample(u); };
}

/// A sampler that reflects at all normals alike, visible or not.
auto all_normals_sampler_of(const GgxReference& lobe) {
    return [wo = broadcast<float>(lobe.wo), alpha = static_cast<float>(lobe.alpha)](const Random& u) {
        const float slope = alpha * std::sqrt(u.y / (1 - u.y));
        const float phi = 6.2831853f * u.x;
        const Direction m = normalize(Direction{slope * std::cos(phi), slope * std::sin(phi), 1});
        return 2 * dot(wo, m) * m - wo;
    };
}

template <class Cap>
class VisibleNormalsSamplesTest : public ::testing::Test {};
using Caps = ::testing::Types<VisibleCap, BoundedCap>;
TYPED_TEST_SUITE(VisibleNormalsSamplesTest, Caps);

TYPED_TEST(VisibleNormalsSamplesTest, FollowTheirDensity) {
    EXPECT_FALSE(samples_are_rejected<TypeParam>(sampler_of<TypeParam>));
}

TYPED_TEST(VisibleNormalsSamplesTest, MutantsAreRejected) {
    EXPECT_TRUE(samples_are_rejected<TypeParam>([](const GgxReference& lobe) {
        return [sampler = sampler_of<TypeParam>(lobe)](const Random& u) { return sampler({u.x * u.x, u.y}); };
    }));
    EXPECT_TRUE(samples_are_rejected<TypeParam>([](const GgxReference& lobe) {
        return [sampler = sampler_of<TypeParam>(lobe)](const Random& u) { return sampler({u.x, u.y * u.y}); };
    }));
    EXPECT_TRUE(samples_are_rejected<TypeParam>([](const GgxReference& lobe) {
        return sampler_of<TypeParam>({lobe.wo, 1.02L * lobe.alpha});
    }));
    EXPECT_TRUE(samples_are_rejected<TypeParam>(all_normals_sampler_of));
}

TEST(VisibleNormalsMutantsTest, UnboundedPosingAsBoundedIsRejected) {
    EXPECT_TRUE(samples_are_rejected<BoundedCap>(sampler_of<VisibleCap>));
}

TEST(VisibleNormalsMutantsTest, BoundedPosingAsUnboundedIsRejected) {
    EXPECT_TRUE(samples_are_rejected<VisibleCap>(sampler_of<BoundedCap>));
}

} // namespace
} // namespace nusselt_test
