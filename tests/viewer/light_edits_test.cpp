#include "common/source_folder.h"
#include "viewer/light_edits.h"

#include "scene/import/importers.h"
#include "scene/rig/rig_json.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace nusselt::viewer {

namespace {

class LightEditsTest : public testing::Test {
protected:
    scene::Scene scene_ =
        scene::load_scene(std::filesystem::path(nusselt_test::kSourceFolder) / "scenes/room.pbrt");
};

TEST_F(LightEditsTest, DoNothingByDefault) {
    LightEdits edits;
    edits.set(0, {{0, 1, 0}, 2, 1, true});
    EXPECT_FALSE(edits.empty());
    edits.set(0, LightEdit());
    EXPECT_TRUE(edits.empty());
    EXPECT_EQ(edits.applied_to(scene_).lights.of<scene::PolygonLight>().size(),
              scene_.lights.of<scene::PolygonLight>().size());
}

TEST_F(LightEditsTest, MoveAndResizeOneLight) {
    ASSERT_GE(scene_.emitters.size(), 2u);
    ASSERT_FALSE(scene_.lights.of<scene::PolygonLight>().empty());
    const std::size_t light = scene_.lights.of<scene::PolygonLight>().front().emitter;
    LightEdits edits;
    edits.set(light, {{0.25, -0.5, 1}, 0.5, 3, true});
    const scene::Scene edited = edits.applied_to(scene_);
    const scene::PolygonLight& before = scene_.lights.of<scene::PolygonLight>().front();
    const scene::PolygonLight& after = edited.lights.of<scene::PolygonLight>().front();
    EXPECT_NEAR(after.radiance.y, 3 * before.radiance.y, 1e-4f * before.radiance.y);
    const auto width = [](const scene::PolygonLight& l) {
        return length(to_double(l.vertices[1]) - to_double(l.vertices[0]));
    };
    EXPECT_NEAR(width(after), 0.5 * width(before), 1e-5);
    scene::Double3 shift{0, 0, 0};
    for (std::size_t i = 0; i < before.vertices.size(); ++i)
        shift = shift + (1.0 / static_cast<double>(before.vertices.size())) *
                            (to_double(after.vertices[i]) - to_double(before.vertices[i]));
    ASSERT_EQ(before.vertices.size(), 4u) << "of a rectangle the centroid is the mean of the vertices";
    EXPECT_NEAR(shift.x, 0.25, 1e-4);
    EXPECT_NEAR(shift.y, -0.5, 1e-4);
    EXPECT_NEAR(shift.z, 1, 1e-4);
}

TEST_F(LightEditsTest, SwitchedOffLightsEmitNothing) {
    LightEdits edits;
    for (std::size_t i = 0; i < scene_.emitters.size(); ++i) edits.set(i, {{0, 0, 0}, 1, 1, false});
    const scene::Scene dark = edits.applied_to(scene_);
    EXPECT_TRUE(dark.lights.of<scene::PolygonLight>().empty());
    EXPECT_TRUE(dark.lights.of<scene::LineLight>().empty());
}

TEST_F(LightEditsTest, TheRigDoesTheSame) {
    LightEdits edits;
    edits.set(0, {{0.1, 0.2, -0.3}, 1.5, 0.25, true});
    edits.set(1, {{0, 0, 0}, 1, 1, false});
    const std::string path = testing::TempDir() + "nusselt_light_edits.json";
    std::ofstream(path) << edits.rig_text();
    scene::Scene by_rig = scene_;
    scene::apply_rig(scene::read_rig(path), by_rig);
    const scene::Scene edited = edits.applied_to(scene_);
    ASSERT_EQ(by_rig.lights.of<scene::PolygonLight>().size(), edited.lights.of<scene::PolygonLight>().size());
    ASSERT_EQ(by_rig.lights.of<scene::LineLight>().size(), edited.lights.of<scene::LineLight>().size());
    for (std::size_t i = 0; i < edited.lights.of<scene::LineLight>().size(); ++i)
        EXPECT_EQ(by_rig.lights.of<scene::LineLight>()[i].radiance.y,
                  edited.lights.of<scene::LineLight>()[i].radiance.y);
    for (std::size_t i = 0; i < edited.lights.of<scene::PolygonLight>().size(); ++i) {
        EXPECT_EQ(by_rig.lights.of<scene::PolygonLight>()[i].radiance.y,
                  edited.lights.of<scene::PolygonLight>()[i].radiance.y);
        for (std::size_t k = 0; k < edited.lights.of<scene::PolygonLight>()[i].vertices.size(); ++k) {
            const scene::Float3& a = edited.lights.of<scene::PolygonLight>()[i].vertices[k];
            const scene::Float3& b = by_rig.lights.of<scene::PolygonLight>()[i].vertices[k];
            EXPECT_EQ(a.x, b.x);
            EXPECT_EQ(a.y, b.y);
            EXPECT_EQ(a.z, b.z);
        }
    }
}

} // namespace

} // namespace nusselt::viewer
