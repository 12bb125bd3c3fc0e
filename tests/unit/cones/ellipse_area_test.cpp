/// Tests of sampling of disks and ellipses by area, and how much better projected solid angle is.

#include <gtest/gtest.h>

#include <nusselt/cones/ellipse_area.h>
#include <nusselt/simd/pack.h>

#include "cones/round_cases.h"

namespace nusselt_test {
namespace {

using nusselt::Disk;
using nusselt::Ellipse;
using nusselt::EllipseArea;
using nusselt::Vec2;

template <template <class> class Light>
void expect_samples(const Light<double>& light, const RoundLight& shape) {
    const EllipseArea<double, Light> technique(light);
    EXPECT_NEAR(technique.measure(), static_cast<double>(kPi) * length(cross(shape.axis[0], shape.axis[1])),
                1e-9 * technique.measure());
    const VisiblePart part(silhouette_of(shape));
    const auto cosine = [](const Point& wi) { return std::max(wi.z, 0.0L); };
    const auto expected = static_cast<double>(part.integral(cosine, 0, 1, 0, 1, 64));
    constexpr int kSide = 128;
    double sum = 0;
    for (int i = 0; i < kSide * kSide; ++i) {
        const Vec2<double> u{(i % kSide + 0.5) / kSide, (i / kSide + 0.5) / kSide};
        const auto s = technique.sample(u);
        sum += std::max(s.wi.z, 0.0) / s.pdf / (kSide * kSide);
        if (i % 101 != 0) continue;
        EXPECT_NEAR(technique.pdf(s.wi) / s.pdf, 1, 1e-9);
        EXPECT_NEAR(technique.invert(s.wi).x, u.x, 1e-9);
        EXPECT_NEAR(technique.invert(s.wi).y, u.y, 1e-9);
        EXPECT_NEAR(length(cross(s.p, s.wi)), 0, 1e-12);
    }
    // The cosine has a kink at the horizon.
    EXPECT_NEAR(sum, expected, 1e-4 * technique.measure());
}

TEST(EllipseAreaTest, SamplesAreUniformOnTheLight) {
    RandomLights lights(17);
    for (const Place place : {Place::ordinary, Place::at_horizon}) {
        for (int i = 0; i < 8; ++i) {
            const RoundLight disk = lights(Shape::disk, place);
            expect_samples(Disk<double>{disk.center, normalize(disk.axis[2]), length(disk.axis[0])}, disk);
            const RoundLight ellipse = lights(Shape::ellipse, place);
            expect_samples(Ellipse<double>{ellipse.center, ellipse.axis[0], ellipse.axis[1]}, ellipse);
        }
    }
}

TEST(EllipseAreaTest, LightsWithoutAreaOrInTheirPlaneAreDark) {
    for (const Disk<float>& disk :
         {Disk<float>{{0, 1, 1}, {0, 0, 1}, 0}, Disk<float>{{2, 0, 0}, {0, 0, 1}, 1}}) {
        const EllipseArea<float, Disk> technique(disk);
        EXPECT_EQ(technique.sample({0.3f, 0.6f}).pdf, 0);
        EXPECT_EQ(technique.pdf({0, 0, 1}), 0);
    }
}

TEST(EllipseAreaTest, LanesHaveTheBitsOfScalars) {
    using Real = nusselt::Pack<float, 8>;
    const EllipseArea<float, Disk> scalar(Disk<float>{{0.5f, 1, 2}, {0.6f, 0, 0.8f}, 0.75f});
    const EllipseArea<Real, Disk> pack(scalar);
    const auto one = scalar.sample({0.3f, 0.7f});
    const auto all = pack.sample({Real(0.3f), Real(0.7f)});
    EXPECT_EQ(one.wi.x, all.wi.x.lane(5));
    EXPECT_EQ(one.pdf, all.pdf.lane(5));
    EXPECT_EQ(scalar.invert(one.wi).x, pack.invert(all.wi).x.lane(5));
}

} // namespace
} // namespace nusselt_test
