#pragma once

#include "base/temporary_folder.h"
#include "image/image.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <set>
#include <stdexcept>
#include <string>

namespace nusselt::image::test {

/// A fixture with an empty folder of its own, removed after the test.
class ImageTest : public testing::Test {
protected:
    std::filesystem::path in_folder(const std::string& name) const { return folder_ / name; }

    std::set<std::string> file_names() const {
        std::set<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
            names.insert(entry.path().filename().string());
        return names;
    }

private:
    nusselt::base::TemporaryFolder folder_;
};

inline std::string read_bytes(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

inline void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

/// Noise with exponentially distributed values of mean 1.
inline Image random_image(int width, int height, unsigned seed) {
    std::mt19937 engine(seed);
    std::exponential_distribution<float> distribution(1.0f);
    Image image = make_image(width, height);
    for (float& value : image.pixels) value = distribution(engine);
    return image;
}

/// The message of the std::runtime_error that the call throws, empty if it throws none.
template <class Call>
std::string error_of(const Call& call) {
    try {
        call();
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return {};
}

} // namespace nusselt::image::test
