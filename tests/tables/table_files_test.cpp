// Files of LTC tables, the tables in data/ and the one that is compiled in.

#include "common/source_folder.h"
#include "tables/blue_noise.h"
#include "tables/engine_table.h"
#include "tables/ltc_table.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

namespace nusselt::tables {

namespace {

const std::string kData =
    (std::filesystem::path(nusselt_test::kSourceFolder) / "data" / "ltc-frostbite").string();

std::string bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    EXPECT_TRUE(file) << path;
    return {std::istreambuf_iterator<char>(file), {}};
}

std::string error_of(const std::string& bytes) {
    try {
        decode(bytes, "some.bin");
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return {};
}

/// Random lobes from wide to those of a mirror.
LtcTable random_table() {
    std::mt19937 engine(1);
    std::uniform_real_distribution<float> uniform(0, 1);
    LtcTable table{3, 4, 5, {}};
    for (int i = 0; i < 3 * 4 * 5; ++i) {
        const float peak = 1.57f * uniform(engine), tilt = 1.57f * uniform(engine);
        const float width = std::exp2(-14 * uniform(engine)), ratio = std::exp2(-14 * uniform(engine));
        table.entries.insert(table.entries.end(),
                             {std::cos(peak), std::sin(peak), ratio, width * std::sin(tilt),
                              width * std::cos(tilt), uniform(engine)});
    }
    return table;
}

TEST(LtcTableFile, KeepsWhatSixteenBitsCan) {
    const LtcTable table = random_table();
    const LtcTable again = decode(encode(table), "some.bin");
    EXPECT_EQ(again.roughnesses, 3);
    EXPECT_EQ(again.inclinations, 4);
    EXPECT_EQ(again.f0s, 5);
    ASSERT_EQ(again.entries.size(), table.entries.size());
    for (std::size_t i = 0; i < table.entries.size(); i += LtcTableView::kStride) {
        const float* a = &table.entries[i];
        const float* b = &again.entries[i];
        const float half_step = 0.5f / 65535, angle = kPi<float> / 2 * half_step * 1.01f;
        EXPECT_NEAR(std::atan2(a[1], a[0]), std::atan2(b[1], b[0]), angle);
        EXPECT_NEAR(std::atan2(a[3], a[4]), std::atan2(b[3], b[4]), angle);
        EXPECT_NEAR(b[2] / a[2], 1, 1.5e-4);
        EXPECT_NEAR(std::hypot(b[3], b[4]) / std::hypot(a[3], a[4]), 1, 1.5e-4);
        EXPECT_NEAR(a[5], b[5], half_step * 1.01f);
    }
    // Rounding what is rounded changes nothing.
    EXPECT_EQ(encode(again), encode(table));
}

TEST(LtcTableFile, EveryDamageIsFound) {
    const std::string good = encode(random_table());
    ASSERT_EQ(error_of(good), "");
    for (std::size_t i = 0; i < good.size(); ++i) {
        std::string bad = good;
        bad[i] = static_cast<char>(bad[i] ^ 1);
        const std::string error = error_of(bad);
        EXPECT_EQ(error.substr(0, 10), "some.bin: ") << "byte " << i;
        EXPECT_EQ(error.find('\n'), std::string::npos);
    }
    EXPECT_NE(error_of("").find("not an LTC table"), std::string::npos);
    EXPECT_NE(error_of("PF\n2 2\n").find("not an LTC table"), std::string::npos);
    EXPECT_NE(error_of(good.substr(0, 39)).find("not an LTC table"), std::string::npos);
    EXPECT_NE(error_of(good.substr(0, good.size() - 1)).find("truncated"), std::string::npos);
    EXPECT_NE(error_of(good + '\0').find("damaged"), std::string::npos);
    EXPECT_THROW(load_ltc_table(kData + "-that-is-missing.bin"), std::runtime_error);
    EXPECT_THROW(load_ltc_table(std::filesystem::path(kData).parent_path()), std::runtime_error);
}

struct ShippedTable {
    std::string path; ///< without extension
    const LtcTable& compiled;
    int roughnesses, inclinations, f0s;
};

std::vector<ShippedTable> shipped_tables() {
    const std::filesystem::path folder = std::filesystem::path(nusselt_test::kSourceFolder) / "data";
    return {{(folder / "ltc-frostbite").string(), frostbite_ltc_table(), 64, 64, 51},
            {(folder / "ltc-phong").string(), phong_ltc_table(), 32, 64, 2}};
}

TEST(LtcTableFile, TheCompiledTablesAreTheShippedOnes) {
    for (const ShippedTable& shipped : shipped_tables()) {
        SCOPED_TRACE(shipped.path);
        EXPECT_EQ(load_ltc_table(shipped.path + ".bin").entries, shipped.compiled.entries);
        EXPECT_EQ(shipped.compiled.roughnesses, shipped.roughnesses);
        EXPECT_EQ(shipped.compiled.inclinations, shipped.inclinations);
        EXPECT_EQ(shipped.compiled.f0s, shipped.f0s);
    }
}

TEST(BlueNoiseFile, TheCompiledOneIsTheShippedOne) {
    const std::string file =
        bytes_of((std::filesystem::path(nusselt_test::kSourceFolder) / "data" / "blue-noise.bin").string());
    EXPECT_EQ(file, std::string(reinterpret_cast<const char*>(blue_noise().bytes), BlueNoiseView::kBytes));
}

TEST(LtcTableFile, TheSidecarsAreOfTheseFiles) {
    for (const ShippedTable& shipped : shipped_tables()) {
        SCOPED_TRACE(shipped.path);
        const std::string bytes = bytes_of(shipped.path + ".bin");
        const auto json = nlohmann::json::parse(bytes_of(shipped.path + ".json"));
        EXPECT_EQ(json.at("bytes"), bytes.size());
        EXPECT_EQ(std::strtoull(json.at("fnv1a_64_of_bytes_from_40").get<std::string>().c_str(), nullptr, 16),
                  checksum_of(bytes));
        EXPECT_EQ(json.at("commit").get<std::string>().size(), 40u);
        EXPECT_EQ(json.at("axes").at(2).at("samples"), shipped.f0s);
    }
}

TEST(LtcTableFile, EveryMatrixOfTheShippedTablesIsRegular) {
    for (const ShippedTable& shipped : shipped_tables()) {
        SCOPED_TRACE(shipped.path);
        for (std::size_t i = 0; i < shipped.compiled.entries.size(); i += LtcTableView::kStride) {
            const float* e = &shipped.compiled.entries[i];
            ASSERT_GT(e[0], 0) << i;
            ASSERT_GE(e[1], 0) << i;
            ASSERT_GT(e[2], 0) << i;
            ASSERT_GE(e[3], 0) << i;
            ASSERT_GT(e[4], 0) << i;
            ASSERT_GE(e[5], 0) << i;
            ASSERT_LE(e[5], 1) << i;
        }
    }
}

TEST(LtcEngineTable, HasFortyEightKibibytesAndTheSameAlbedo) {
    const std::string bytes = bytes_of(kData + "-engine.bin");
    EXPECT_EQ(bytes.size(), 48u * 1024);
    const LtcTable engine = decode_for_engines(bytes, 64, 64, "the engine table");
    const LtcTable& full = frostbite_ltc_table();
    for (float roughness = 0; roughness <= 1; roughness += 0.07f)
        for (float cos_o = 0; cos_o <= 1; cos_o += 0.09f)
            for (const float f0 : {0.0f, 0.04f, 0.5f, 1.0f})
                EXPECT_NEAR(engine.view().lookup(roughness, cos_o, f0).albedo,
                            full.view().lookup(roughness, cos_o, f0).albedo, 5e-4);
}

TEST(LtcEngineTable, HasTheLobesOfOneReflectance) {
    const LtcTable table = random_table();
    const LtcTable engine = decode_for_engines(encode_for_engines(table, 0.25f), 3, 4, "some.bin");
    for (int cell = 0; cell < 12; ++cell)
        for (int f0 = 0; f0 < 2; ++f0)
            for (int k = 0; k < 5; ++k) {
                const float expected = table.entries[static_cast<std::size_t>((cell * 5 + 1) * 6 + k)];
                const float found = engine.entries[static_cast<std::size_t>((cell * 2 + f0) * 6 + k)];
                EXPECT_NEAR(found, expected, 1e-3f * expected + 1e-6f) << cell << " " << k;
            }
    EXPECT_THROW(decode_for_engines("abc", 3, 4, "some.bin"), std::runtime_error);
}

} // namespace

} // namespace nusselt::tables
