#pragma once
/// The blue noise that ships with the library.

#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/random/blue_noise.h>

#include "common/source_folder.h"

namespace nusselt::test {

/// A view of data/blue-noise.bin, which is read once.
inline BlueNoiseView shipped_blue_noise() {
    static const std::vector<char> bytes = [] {
        const auto path = std::filesystem::path(nusselt_test::kSourceFolder) / "data" / "blue-noise.bin";
        std::ifstream file(path, std::ios::binary);
        std::vector<char> all{std::istreambuf_iterator<char>(file), {}};
        EXPECT_EQ(all.size(), BlueNoiseView::kBytes) << path;
        all.resize(BlueNoiseView::kBytes);
        return all;
    }();
    return {reinterpret_cast<const unsigned char*>(bytes.data())};
}

} // namespace nusselt::test
