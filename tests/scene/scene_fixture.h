#pragma once
/// Fixture that writes scene files into a folder of its own and loads them.

#include "base/temporary_folder.h"
#include "scene/import/importers.h"
#include "scene/model/vector_math.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <stdexcept>
#include <string>
#include <string_view>

namespace nusselt::scene {

/// Enough for a scene with one visible triangle.
constexpr std::string_view kTriangle = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]\n";

class SceneTest : public testing::Test {
protected:
    void write(const std::string& name, std::string_view bytes) const {
        std::filesystem::create_directories((folder_ / name).parent_path());
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
    }
    Scene load(std::string_view text) const {
        write("scene.pbrt", text);
        return load_scene(folder_ / "scene.pbrt");
    }
    /// The message of the error that loading must end with, without the folder.
    std::string error(std::string_view text) const {
        try {
            load(text);
        } catch (const std::runtime_error& failure) {
            return without_folder(failure.what());
        }
        return "no error";
    }
    /// The only warning, without the folder.
    std::string warning(const Scene& scene) const {
        return scene.warnings.size() == 1 ? without_folder(scene.warnings[0])
                                          : std::to_string(scene.warnings.size()) + " warnings";
    }
    std::string without_folder(std::string text) const {
        const std::string prefix = folder_.path().string() + "/";
        for (std::size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix))
            text.erase(at, prefix.size());
        return text;
    }

    nusselt::base::TemporaryFolder folder_;
};

inline void expect_near(const Float3& found, const Float3& expected, float tolerance) {
    EXPECT_NEAR(found.x, expected.x, tolerance);
    EXPECT_NEAR(found.y, expected.y, tolerance);
    EXPECT_NEAR(found.z, expected.z, tolerance);
}

/// The unit normal of the side that a light emits to.
inline Float3 emitting_normal(const PolygonLight& light) {
    const Double3 a = to_double(light.vertices[1]) - to_double(light.vertices[0]);
    const Double3 b = to_double(light.vertices[2]) - to_double(light.vertices[0]);
    return to_float(normalized(cross(a, b)));
}

} // namespace nusselt::scene
