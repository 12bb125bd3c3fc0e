// Published scenes, where they are available: the environment variable NUSSELT_SCENES names the folder with
// bathroom/ and sponza/.

#include "common/source_folder.h"
#include "scene/import/importers.h"
#include "scene/model/vector_math.h"
#include "scene/rig/rig.h"
#include "scene/rig/rig_json.h"

#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>

namespace nusselt::scene {
namespace {

class RealScenes : public testing::Test {
protected:
    void SetUp() override {
        const char* const folder = std::getenv("NUSSELT_SCENES");
        if (folder == nullptr) GTEST_SKIP() << "set NUSSELT_SCENES to the folder with bathroom/ and sponza/";
        folder_ = folder;
    }
    static void expect_consistent(const Scene& scene) {
        EXPECT_EQ(scene.normals.size(), scene.positions.size());
        EXPECT_EQ(scene.uvs.size(), scene.positions.size());
        EXPECT_EQ(scene.triangle_material.size(), scene.triangles.size());
        EXPECT_EQ(scene.triangle_light.size(), scene.triangles.size());
        std::size_t bad = 0;
        for (const Triangle& triangle : scene.triangles)
            for (const std::uint32_t vertex : triangle.vertex) bad += vertex >= scene.positions.size();
        for (const std::uint32_t material : scene.triangle_material)
            bad += material >= scene.materials.size();
        for (const Material& material : scene.materials)
            bad += material.diffuse_texture.texture >= static_cast<int>(scene.textures.size());
        for (const Texture& texture : scene.textures)
            bad += texture.texels.size() !=
                   static_cast<std::size_t>(texture.channels * texture.width * texture.height);
        EXPECT_EQ(bad, 0u);
    }
    /// A scene, such as "sponza", with a rig that comes with the project, such as "tube".
    Scene lit_by(const std::string& name, const std::string& rig) const {
        const std::filesystem::path rigs = std::filesystem::path(nusselt_test::kSourceFolder) / "scenes/rigs";
        Scene scene = load_scene(folder_ / name / (name + ".pbrt"));
        apply_rig(read_rig(rigs / (name + "-" + rig + ".json")), scene);
        expect_consistent(scene);
        return scene;
    }
    std::filesystem::path folder_;
};

TEST_F(RealScenes, Rigs) {
    EXPECT_EQ(lit_by("bathroom", "panel").lights.of<PolygonLight>().size(), 2u);
    EXPECT_EQ(lit_by("bathroom", "tube").lights.of<LineLight>().size(), 1u);
    EXPECT_EQ(lit_by("bathroom", "hundred").lights.of<PolygonLight>().size(), 100u);
    EXPECT_EQ(lit_by("sponza", "panel").lights.of<PolygonLight>().size(), 1u);
    EXPECT_EQ(lit_by("sponza", "tube").lights.of<LineLight>().size(), 1u);
    EXPECT_EQ(lit_by("sponza", "hundred").lights.of<LineLight>().size(), 100u);
}

TEST_F(RealScenes, Bathroom) {
    const Scene scene = load_scene(folder_ / "bathroom/bathroom.pbrt");
    expect_consistent(scene);
    EXPECT_EQ(scene.triangles.size(), 558306u);
    EXPECT_EQ(scene.materials.size(), 30u);
    // Two of them serve as bumps and as a mask, one both as bumps and as colour.
    EXPECT_EQ(scene.textures.size(), 11u);
    ASSERT_EQ(scene.lights.of<PolygonLight>().size(), 1u);
    const PolygonLight& window = scene.lights.of<PolygonLight>()[0];
    EXPECT_EQ(window.vertices.size(), 4u);
    const Double3 normal = cross(to_double(window.vertices[1]) - to_double(window.vertices[0]),
                                 to_double(window.vertices[2]) - to_double(window.vertices[0]));
    EXPECT_GT(normal.x, 0); // into the room
    EXPECT_EQ(scene.film.width, 1024);
}

TEST_F(RealScenes, Sponza) {
    const Scene scene = load_scene(folder_ / "sponza/sponza.pbrt");
    expect_consistent(scene);
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(scene.triangles.size(), 66447u);
    EXPECT_EQ(scene.textures.size(), 10u);
    ASSERT_EQ(scene.lights.of<PolygonLight>().size(), 1u);
    EXPECT_EQ(scene.lights.of<PolygonLight>()[0].vertices.size(), 4u);
    const Double3 normal = cross(to_double(scene.lights.of<PolygonLight>()[0].vertices[1]) -
                                     to_double(scene.lights.of<PolygonLight>()[0].vertices[0]),
                                 to_double(scene.lights.of<PolygonLight>()[0].vertices[2]) -
                                     to_double(scene.lights.of<PolygonLight>()[0].vertices[0]));
    EXPECT_LT(normal.y, 0); // down to the courtyard
}

} // namespace
} // namespace nusselt::scene
