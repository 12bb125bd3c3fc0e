/// Area sampling of cylinders against quadrature over their surface.

#include <nusselt/sampling/cylinder_area.h>

#include <cmath>

#include <gtest/gtest.h>

#include "geometry/cylinder_reference.h"
#include "lights.h"

namespace nusselt_test {
namespace {

using Technique = nusselt::CylinderArea<double>;

TEST(CylinderArea, SamplesAreOnTheSurface) {
    for (const CylinderCase& light : cylinder_cases()) {
        const auto cylinder = make_light<double>(light);
        const Technique technique(cylinder);
        for (int i = 0; i < 64; ++i) {
            for (int j = 0; j < 64; ++j) {
                const auto s = technique.sample({i / 64.0, j / 64.0});
                const auto from_begin = s.p - cylinder.axis.p0;
                const double along = dot(from_begin, cylinder.axis.s);
                const double across = length(from_begin - along * cylinder.axis.s);
                const double from_caps = std::min(std::abs(along), std::abs(along - cylinder.axis.length));
                const double from_side = std::abs(across - cylinder.radius);
                EXPECT_NEAR(std::min(from_caps, from_side), 0, 1e-12) << light.name;
                EXPECT_LE(across, cylinder.radius + 1e-12) << light.name;
                EXPECT_NEAR(length(s.wi), 1, 1e-14) << light.name;
                EXPECT_GE(s.pdf, 0) << light.name;
            }
        }
    }
}

TEST(CylinderArea, EstimatesSolidAngles) {
    for (const CylinderCase& light : cylinder_cases()) {
        const auto cylinder = make_light<double>(light);
        const Technique technique(cylinder);
        // A lattice is better than a grid, because the edges of the caps cut through the cells. It leaves errors of
        // up to 6e-4.
        constexpr int kCount = 1 << 20;
        double solid_angle = 0, projected = 0;
        for (int i = 0; i < kCount; ++i) {
            const auto s = technique.sample(
                {std::fmod(i * 0.7548776662466927, 1.0), std::fmod(i * 0.5698402909980532, 1.0)});
            if (!(s.pdf > 0)) continue;
            solid_angle += 1 / s.pdf;
            projected += std::max(s.wi.z, 0.0) / s.pdf;
        }
        const auto one = [](const Point&) { return 1.0L; };
        const auto cosine = [](const Point& wi) { return std::max(wi.z, 0.0L); };
        const long double whole = integrate_solid_angle(solid(cylinder), one, 1e-6L);
        EXPECT_NEAR(solid_angle / kCount / whole, 1, 1e-3) << light.name;
        EXPECT_NEAR(projected / kCount / integrate_solid_angle(solid(cylinder), cosine, 1e-6L), 1, 1e-3)
            << light.name;
    }
}

TEST(CylinderArea, DensityAndRandomNumbersOfADirectionAreThoseOfTheSample) {
    for (const CylinderCase& light : cylinder_cases()) {
        const Technique technique(make_light<double>(light));
        for (int i = 0; i < 64; ++i) {
            for (int j = 0; j < 64; ++j) {
                const auto s = technique.sample({(i + 0.5) / 64, (j + 0.5) / 64});
                // Where a direction grazes the silhouette, its hit point is uncertain.
                if (!(s.pdf > 0 && s.pdf < 1e6)) continue;
                EXPECT_NEAR(technique.pdf(s.wi) / s.pdf, 1, 1e-6) << light.name;
                const auto u = technique.invert(s.wi);
                EXPECT_NEAR(u.x, (i + 0.5) / 64, 1e-6) << light.name;
                EXPECT_NEAR(u.y, (j + 0.5) / 64, 1e-6) << light.name;
            }
        }
    }
}

TEST(CylinderArea, WithoutSurfaceThereAreNoSamples) {
    const nusselt::Cylinder<double> no_radius{nusselt::make_line<double>({-1, 0, 1}, {1, 0, 1}), 0};
    EXPECT_EQ(Technique(no_radius).sample({0.3, 0.6}).pdf, 0);
    const nusselt::Cylinder<double> around{nusselt::make_line<double>({-1, 0, 0}, {1, 0, 0}), 0.5};
    EXPECT_EQ(Technique(around).sample({0.3, 0.6}).pdf, 0);
}

} // namespace
} // namespace nusselt_test
