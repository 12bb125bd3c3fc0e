// The shipped tables against quadrature, and against tables that others published.

#include "common/source_folder.h"
#include "quadrature.h"

#include "fit/table_error.h"
#include "tables/engine_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace nusselt::fit {

namespace {

using tables::frostbite_ltc_table;
using tables::LtcTable;

const Brdf& specular_brdf() { return find_brdf("frostbite-specular"); }

LtcTable engine_table() {
    const auto path =
        std::filesystem::path(nusselt_test::kSourceFolder) / "data" / "ltc-frostbite-engine.bin";
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    return tables::decode_for_engines(bytes, 64, 64, "the engine table");
}

void expect_albedo(double roughness, double inclination, double f0) {
    const double expected = test::albedo({roughness, inclination, f0});
    EXPECT_NEAR(frostbite_ltc_table().view().lookup(roughness, std::cos(inclination), f0).albedo, expected,
                1e-3)
        << roughness << " " << inclination << " " << f0;
    EXPECT_LE(expected, 1 + 1e-4);
}

TEST(ShippedLtcTable, HasTheAlbedoOfTheBrdf) {
    for (const int r : {0, 1, 3, 8, 19, 35, 50, 63})
        for (const int i : {0, 8, 20, 31, 45, 58, 61, 62})
            for (const int k : {0, 2, 25, 50}) expect_albedo(r / 63.0, kPi<double> / 2 * i / 63, k / 50.0);
}

/// Up to 80 degrees: beyond, masking and Schlick's term change faster than any table could follow, by up to 0.07 within
/// the last cell.
TEST(ShippedLtcTable, HasTheAlbedoOfTheBrdfBetweenSamples) {
    for (const double roughness : {0.0, 0.01, 0.05, 0.123, 0.3, 0.55, 0.8, 1.0})
        for (const double inclination : {0.01, 0.2, 0.777, 1.2, 1.39})
            for (const double f0 : {0.0, 0.05, 0.5, 0.93, 1.0}) expect_albedo(roughness, inclination, f0);
}

double mean_error(const LtcTable& table, const std::vector<Slice>& slices,
                  const Brdf& brdf = specular_brdf()) {
    return summary_of(fit_errors(brdf, table.view(), slices)).mean;
}

/// Samples of the tables that Heitz et al. published for GGX, without those of roughness 0, which they fitted for a
/// smaller alpha.
std::vector<Slice> published_slices() {
    std::vector<Slice> slices;
    for (int t = 0; t < 64; ++t)
        for (int a = 1; a < 64; ++a) {
            const double x = t / 63.0;
            slices.push_back({a / 63.0, std::acos(std::max(1 - x * x, std::cos(1.57))), 1});
        }
    return slices;
}

/// The errors of the matrices in the npm package three 0.160.0 (examples/jsm/lights/RectAreaLightUniformsLib.js) on all
/// those slices, by fit_error().
constexpr double kPublishedError = 0.12470;

TEST(ShippedLtcTable, FitsBetterThanPublishedOnes) {
    EXPECT_LT(mean_error(frostbite_ltc_table(), published_slices()), kPublishedError);
}

/// The rounding to 16 bits and the interpolation are part of it; a wrong row, sign or axis is not.
TEST(ShippedLtcTable, InterpolatesWell) {
    std::vector<Slice> samples, between;
    for (int r = 4; r < 63; r += 6)
        for (int i = 0; i < 60; i += 5)
            for (int k = 2; k < 50; k += 16) {
                samples.push_back({r / 63.0, kPi<double> / 2 * i / 63, k / 50.0});
                between.push_back({(r + 0.5) / 63, kPi<double> / 2 * (i + 0.5) / 63, (k + 0.5) / 50});
            }
    const double at_samples = mean_error(frostbite_ltc_table(), samples);
    EXPECT_LT(at_samples, 0.1);
    EXPECT_LT(mean_error(frostbite_ltc_table(), between), at_samples * 1.1);

    LtcTable mutant = frostbite_ltc_table();
    for (std::size_t i = 2; i < mutant.entries.size(); i += LtcTableView::kStride) mutant.entries[i] *= 1.1f;
    EXPECT_GT(mean_error(mutant, samples), at_samples * 1.1);
}

/// Its error is far from that of the other table because powers of cosines have no tails.
TEST(ShippedPhongTable, HasTheFitErrorOfItsSidecar) {
    std::vector<Slice> samples;
    for (int r = 1; r < 32; r += 3)
        for (int i = 0; i < 60; i += 5) samples.push_back({r / 31.0, kPi<double> / 2 * i / 63, 0});
    const Brdf& phong = find_brdf("phong");
    const double error = mean_error(tables::phong_ltc_table(), samples, phong);
    EXPECT_LT(error, 0.29);

    // A peak that is turned by a degree, and a lobe that is wider by a tenth.
    LtcTable turned = tables::phong_ltc_table(), wide = turned;
    for (std::size_t i = 0; i < turned.entries.size(); i += LtcTableView::kStride) {
        float* const e = &turned.entries[i];
        const double angle = std::atan2(e[1], e[0]) + kPi<double> / 180;
        e[0] = static_cast<float>(std::cos(angle));
        e[1] = static_cast<float>(std::sin(angle));
        wide.entries[i + 2] *= 1.1f;
    }
    EXPECT_GT(mean_error(turned, samples, phong), 1.05 * error);
    EXPECT_GT(mean_error(wide, samples, phong), 1.005 * error);
}

/// With one lobe for all reflectances, errors grow, by at most 55 %.
TEST(EngineLtcTable, FitsAlmostAsWell) {
    for (const double f0 : {0.04, 0.2, 1.0}) {
        std::vector<Slice> slices;
        for (int r = 1; r < 64; r += 3)
            for (int i = 0; i < 63; i += 3) slices.push_back({r / 63.0, kPi<double> / 2 * i / 63, f0});
        const double best = mean_error(frostbite_ltc_table(), slices);
        const double found = mean_error(engine_table(), slices);
        EXPECT_LT(found, 1.55 * best) << f0;
        EXPECT_GT(found, best) << f0;
    }
}

} // namespace

} // namespace nusselt::fit
