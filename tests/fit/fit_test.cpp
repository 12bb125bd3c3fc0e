// Fits of lobes and tables: known answers, minima, independence of threads and interruptions.

#include "quadrature.h"

#include "base/temporary_folder.h"
#include "fit/table_error.h"
#include "fit/table_fit.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>

namespace nusselt::fit {

namespace {

const Brdf& specular_brdf() { return find_brdf("frostbite-specular"); }

bool operator==(const FittedLobe& a, const FittedLobe& b) {
    return a.lobe.peak == b.lobe.peak && a.lobe.tilt == b.lobe.tilt && a.lobe.width_x == b.lobe.width_x &&
           a.lobe.width_y == b.lobe.width_y && a.albedo == b.albedo && a.error == b.error;
}

/// Density of a lobe [1/sr] from the matrix, as the documentation of LtcCoefficients defines it.
double density(const LtcCoefficients<double>& m, const test::Direction& w) {
    const double x = m.m00 * w.x + m.m02 * w.z, y = m.m11 * w.y, z = m.m20 * w.x + m.m22 * w.z;
    const double determinant = m.m11 * (m.m00 * m.m22 - m.m02 * m.m20);
    return std::max(z, 0.0) * determinant / (std::acos(-1.0) * std::pow(x * x + y * y + z * z, 2));
}

TEST(LobeFit, TheCosineIsALobe) {
    for (const FittedLobe& entry : fit_column(find_brdf("lambert"), 0.5, 0.5, 4)) {
        EXPECT_NEAR(entry.albedo, 1, 1e-4);
        EXPECT_LT(entry.error, 2e-3);
        // The peak can undo the effect of the tilt on a cosine, so compare the matrices.
        const auto m = coefficients_of(entry.lobe, 1);
        EXPECT_NEAR(density(m, {0, 0, 1}) * std::acos(-1.0), 1, 5e-3);
        EXPECT_NEAR(density(m, {0.6, 0, 0.8}) * std::acos(-1.0), 0.8, 5e-3);
        EXPECT_NEAR(density(m, {0, 0.6, 0.8}) * std::acos(-1.0), 0.8, 5e-3);
    }
}

/// Half vectors of narrow lobes have half their slopes.
TEST(LobeFit, NarrowLobesAreTwiceAlphaWide) {
    for (const double roughness : {0.0, 0.1, 0.2}) {
        const double alpha = std::max(roughness * roughness, 1e-4);
        const FittedLobe entry = fit_column(specular_brdf(), roughness, 1, 2).front();
        EXPECT_NEAR(entry.lobe.width_x / (2 * alpha), 1, 0.002 + alpha * alpha);
        EXPECT_EQ(entry.lobe.width_x, entry.lobe.width_y);
        EXPECT_EQ(entry.lobe.peak, 0);
        EXPECT_EQ(entry.lobe.tilt, 0);
    }
}

/// They point into the direction of mirrors, and foreshorten with the cosine.
TEST(LobeFit, NarrowLobesReflect) {
    const auto column = fit_column(specular_brdf(), 0.1, 1, 10);
    for (int i = 1; i < 8; ++i) {
        const double inclination = kPi<double> / 2 * i / 9;
        const Lobe& lobe = column[static_cast<std::size_t>(i)].lobe;
        EXPECT_NEAR(lobe.peak, inclination, 0.01);
        EXPECT_NEAR(lobe.width_y / (0.02 * std::cos(inclination)), 1, 0.1);
    }
}

TEST(LobeFit, CoefficientsAndLobesAreTheSame) {
    const Lobe lobe{0.7, 0.4, 0.3, 0.2};
    auto m = coefficients_of(lobe, 0.5);
    EXPECT_NEAR(std::hypot(m.m00, m.m02), 1, 1e-15);
    EXPECT_NEAR(test::over_sphere([&](const test::Direction& w) { return density(m, w); }), 1, 1e-4);
    for (double* x : {&m.m00, &m.m02, &m.m11, &m.m20, &m.m22}) *x *= 3;
    const Lobe again = lobe_of(m);
    EXPECT_NEAR(again.peak, lobe.peak, 1e-14);
    EXPECT_NEAR(again.tilt, lobe.tilt, 1e-14);
    EXPECT_NEAR(again.width_x, lobe.width_x, 1e-14);
    EXPECT_NEAR(again.width_y, lobe.width_y, 1e-14);
}

TEST(LobeFit, ErrorsAndAlbedosAgreeWithQuadrature) {
    for (const double roughness : {0.45, 0.7, 1.0})
        for (const double f0 : {0.04, 1.0}) {
            const auto column = fit_column(specular_brdf(), roughness, f0, 8);
            for (const int i : {0, 3, 6}) {
                const FittedLobe& entry = column[static_cast<std::size_t>(i)];
                const Slice slice{roughness, kPi<double> / 2 * i / 7, f0};
                const double albedo = test::albedo(slice);
                EXPECT_NEAR(entry.albedo, albedo, 3e-4);
                const auto m = coefficients_of(entry.lobe, albedo);
                const double error = test::over_sphere([&](const test::Direction& w) {
                    return std::fabs(test::specular(slice, w) / albedo - density(m, w));
                });
                EXPECT_NEAR(entry.error, error, 0.002 + 0.03 * error) << roughness << " " << f0 << " " << i;
            }
        }
}

/// A mutant of a lobe, whichever number is changed, fits worse.
TEST(LobeFit, LobesAreMinima) {
    const auto nodes = std::make_unique<Nodes>();
    for (const double roughness : {0.1, 0.4, 0.8}) {
        const auto column = fit_column(specular_brdf(), roughness, 0.3, 6);
        for (const int i : {1, 3, 4}) {
            const Slice slice{roughness, kPi<double> / 2 * i / 5, 0.3};
            const double albedo = specular_brdf().moments(slice).albedo;
            specular_brdf().place_nodes(slice, albedo, *nodes);
            const auto objective = [&](const Lobe& lobe) {
                return specular_brdf().error(slice, albedo, *nodes, lobe, 2);
            };
            const Lobe lobe = column[static_cast<std::size_t>(i)].lobe;
            const double best = objective(lobe);
            for (const double sign : {-1.0, 1.0}) {
                const double angle = sign * 0.1 * std::min(lobe.width_x, 1.0);
                EXPECT_GT(objective({lobe.peak + angle, lobe.tilt, lobe.width_x, lobe.width_y}), best);
                // The horizon is far from narrow lobes.
                if (roughness > 0.3) {
                    EXPECT_GT(objective({lobe.peak, lobe.tilt + 3 * angle, lobe.width_x, lobe.width_y}),
                              best);
                }
                EXPECT_GT(objective({lobe.peak, lobe.tilt, lobe.width_x * (1 + 0.1 * sign), lobe.width_y}),
                          best);
                EXPECT_GT(objective({lobe.peak, lobe.tilt, lobe.width_x, lobe.width_y * (1 + 0.1 * sign)}),
                          best);
            }
        }
    }
}

TEST(Brdfs, AreFoundByName) {
    for (const Brdf& one : brdfs()) EXPECT_EQ(&find_brdf(one.name), &one);
    try {
        find_brdf("velvet");
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(
            error.what(),
            "unknown BRDF 'velvet'; use one of frostbite-specular, frostbite-diffuse, lambert, phong");
    }
}

class TableFitTest : public testing::Test {
protected:
    static constexpr TableSize kSize{4, 3, 3};

    std::filesystem::path checkpoint() const { return folder_ / "checkpoint"; }

    static void expect_equal(const TableFit& a, const TableFit& b) {
        for (int r = 0; r < kSize.roughness; ++r)
            for (int i = 0; i < kSize.inclination; ++i)
                for (int f = 0; f < kSize.f0; ++f) EXPECT_TRUE(a.entry(r, i, f) == b.entry(r, i, f));
    }

    /// The message of TableFit::resume().
    std::string error_of_resuming(const Brdf& brdf, const TableSize& size) const {
        try {
            TableFit(brdf, size).resume(checkpoint());
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return {};
    }

private:
    nusselt::base::TemporaryFolder folder_;
};

TEST_F(TableFitTest, DoesNotDependOnTheNumberOfThreads) {
    TableFit one(specular_brdf(), kSize), several(specular_brdf(), kSize);
    const tbb::global_control five(tbb::global_control::max_allowed_parallelism, 5);
    tbb::task_arena(1).execute([&] { one.run(one.columns()); });
    tbb::task_arena(5).execute([&] { several.run(several.columns()); });
    EXPECT_EQ(one.finished_columns(), 12);
    expect_equal(one, several);
    // The columns are in the order of entry().
    const auto column = fit_column(specular_brdf(), 2.0 / 3, 0.5, 3);
    EXPECT_TRUE(one.entry(2, 1, 1) == column[1]);
}

TEST_F(TableFitTest, ContinuesAfterAnInterruption) {
    TableFit whole(specular_brdf(), kSize), first(specular_brdf(), kSize), second(specular_brdf(), kSize);
    whole.run(whole.columns());
    second.resume(checkpoint());
    EXPECT_EQ(second.finished_columns(), 0) << "there is no file yet";
    first.run(5);
    first.save(checkpoint());
    second.resume(checkpoint());
    EXPECT_EQ(second.finished_columns(), 5);
    second.run(100);
    EXPECT_EQ(second.finished_columns(), 12);
    expect_equal(whole, second);
}

TEST_F(TableFitTest, RejectsOtherCheckpoints) {
    TableFit table(specular_brdf(), kSize);
    table.run(2);
    table.save(checkpoint());
    EXPECT_EQ(error_of_resuming(specular_brdf(), kSize), "");
    const auto rejects = [&](const std::string& error, const std::string& reason) {
        return error.find(checkpoint().string()) == 0 && error.find(reason) != std::string::npos;
    };
    EXPECT_TRUE(rejects(error_of_resuming(specular_brdf(), {3, 3, 4}), "not a checkpoint of"));
    EXPECT_TRUE(rejects(error_of_resuming(find_brdf("lambert"), kSize), "not a checkpoint of"));

    const auto size = std::filesystem::file_size(checkpoint());
    std::ofstream(checkpoint(), std::ios::app) << 'x';
    EXPECT_TRUE(rejects(error_of_resuming(specular_brdf(), kSize), "damaged"));
    std::filesystem::resize_file(checkpoint(), size - 1);
    EXPECT_TRUE(rejects(error_of_resuming(specular_brdf(), kSize), "damaged"));
    table.save(checkpoint());
    std::fstream file(checkpoint(), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(-6 * static_cast<int>(sizeof(double)), std::ios::end);
    const double negative = -1;
    file.write(reinterpret_cast<const char*>(&negative), sizeof negative);
    file.close();
    EXPECT_TRUE(rejects(error_of_resuming(specular_brdf(), kSize), "damaged"));
}

} // namespace

} // namespace nusselt::fit
