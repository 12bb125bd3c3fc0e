#include "base/temporary_folder.h"
#include "common/source_folder.h"
#include "viewer/lights/light_edits.h"

#include "scene/colour/colour_space.h"
#include "scene/import/importers.h"
#include "scene/model/fingerprint.h"
#include "scene/rig/rig_files.h"
#include "scene/rig/rig_json.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

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

/// Up to rounding.
void expect_near(const scene::Float3& a, const scene::Float3& b) {
    EXPECT_NEAR(a.x, b.x, 1e-6);
    EXPECT_NEAR(a.y, b.y, 1e-6);
    EXPECT_NEAR(a.z, b.z, 1e-6);
}

TEST_F(LightEditsTest, TheRigDoesTheSame) {
    LightEdits edits;
    edits.set(0, {{0.1, 0.2, -0.3}, 1.5, 0.25, true});
    edits.set(1, {{0, 0, 0}, 1, 1, false});
    LightEdit turned;
    turned.turn = {10, -20, 30};
    turned.colour = Temperature{3000};
    turned.brightness = 2;
    const std::size_t panel =
        edits.add(scene_, {"panel", LightShape::panel, {0, 1, 0}, {0, -1, 0}, 0.5, {3, 2, 1}});
    turned.added = edits.get(panel).added;
    edits.set(panel, turned);
    const std::size_t tube =
        edits.add(scene_, {"tube", LightShape::tube, {0, 1, 0}, {1, 0, 0}, 0.5, {3, 2, 1}});
    LightEdit red = edits.get(tube);
    red.colour = scene::Float3{7, 0, 0};
    red.brightness = 0.5;
    edits.set(tube, red);
    for (const LightShape shape : {LightShape::sphere, LightShape::disk}) {
        const std::size_t light =
            edits.add(scene_, {std::string(name_of(shape)), shape, {0, 1, 0}, {0, -1, 0}, 0.5, {3, 2, 1}});
        turned.added = edits.get(light).added;
        turned.move = {0.1, 0, 0.2};
        turned.size = 1.5;
        edits.set(light, turned);
    }
    const base::TemporaryFolder folder;
    const std::filesystem::path path = folder / "rig.json";
    std::ofstream(path) << edits.rig_text(scene_);
    scene::Scene by_rig = scene_;
    scene::apply_rig(scene::read_rig(path), by_rig);
    const scene::Scene edited = edits.applied_to(scene_);
    ASSERT_EQ(by_rig.lights.of<scene::PolygonLight>().size(), edited.lights.of<scene::PolygonLight>().size());
    ASSERT_EQ(by_rig.lights.of<scene::LineLight>().size(), edited.lights.of<scene::LineLight>().size());
    EXPECT_EQ(edited.lights.of<scene::LineLight>().back().radiance, (scene::Float3{3.5f, 0, 0}));
    for (std::size_t i = 0; i < edited.lights.of<scene::LineLight>().size(); ++i) {
        EXPECT_EQ(by_rig.lights.of<scene::LineLight>()[i].radiance,
                  edited.lights.of<scene::LineLight>()[i].radiance);
        EXPECT_EQ(by_rig.lights.of<scene::LineLight>()[i].start,
                  edited.lights.of<scene::LineLight>()[i].start);
    }
    const auto& rounds = edited.lights.of<scene::RoundLight>();
    const auto& rounds_by_rig = by_rig.lights.of<scene::RoundLight>();
    ASSERT_EQ(rounds.size(), 2u);
    ASSERT_EQ(rounds_by_rig.size(), 2u);
    EXPECT_NEAR(semi_axes(rounds[0])[2], 0.375, 1e-6) << "the sphere";
    EXPECT_NEAR(rounds[0].center.x, 0.1, 1e-6);
    EXPECT_EQ(rounds[1].model, scene::RoundModel::ellipse);
    for (std::size_t i = 0; i < rounds.size(); ++i) {
        EXPECT_EQ(rounds[i].radiance, rounds_by_rig[i].radiance);
        EXPECT_EQ(rounds[i].model, rounds_by_rig[i].model);
        for (const auto axis : {&scene::RoundLight::center, &scene::RoundLight::u, &scene::RoundLight::v,
                                &scene::RoundLight::w})
            expect_near(rounds[i].*axis, rounds_by_rig[i].*axis);
    }
    for (std::size_t i = 0; i < edited.lights.of<scene::PolygonLight>().size(); ++i) {
        EXPECT_EQ(by_rig.lights.of<scene::PolygonLight>()[i].radiance,
                  edited.lights.of<scene::PolygonLight>()[i].radiance);
        for (std::size_t k = 0; k < edited.lights.of<scene::PolygonLight>()[i].vertices.size(); ++k) {
            const scene::Float3& a = edited.lights.of<scene::PolygonLight>()[i].vertices[k];
            const scene::Float3& b = by_rig.lights.of<scene::PolygonLight>()[i].vertices[k];
            EXPECT_EQ(a.x, b.x);
            EXPECT_EQ(a.y, b.y);
            EXPECT_EQ(a.z, b.z);
        }
    }
}

/// Profiles, images and maps, given by edits and by their rig.
TEST_F(LightEditsTest, ExchangeFilesOfLightsAsTheirRigDoes) {
    const std::filesystem::path folder =
        std::filesystem::path(nusselt_test::kSourceFolder) / "tests/scene/rigs";
    scene::RigFiles files;
    LightEdit measured, spread, picture, sky;
    measured.profile.luminaire = files.profile(folder / "lambert.ies");
    measured.profile.angle = 30;
    spread.profile.spread = 40;
    picture.image.image = files.image(folder / "red-and-blue.pfm");
    picture.image.scale = scene::Float3{1, 2, 3};
    sky.image.map = files.map(folder / "red-and-blue.pfm");
    sky.map_turn = {0, 30, 0};
    const base::TemporaryFolder output;
    std::vector<std::string> seen;
    const auto try_edit = [&](const char* name, std::size_t light, const LightEdit& edit) {
        const scene::Scene loaded = scene::load_scene(folder / name);
        LightEdits edits;
        edits.set(light, edit);
        const scene::Scene edited = edits.applied_to(loaded);
        std::ofstream(output / "lights.json") << edits.rig_text(loaded);
        scene::Scene by_rig = loaded;
        apply_rig(scene::read_rig(output / "lights.json"), by_rig);
        EXPECT_EQ(fingerprint(by_rig), fingerprint(edited)) << edits.rig_text(loaded);
        EXPECT_NE(fingerprint(edited), fingerprint(loaded));
        seen.push_back(fingerprint(edited));
    };
    try_edit("lamps.pbrt", 0, measured);
    try_edit("lamps.pbrt", 2, measured);
    try_edit("lamps.pbrt", 1, spread);
    try_edit("lamps.pbrt", 0, picture);
    try_edit("sky.pbrt", 0, sky);
    sky.map_turn = {0, 40, 0};
    try_edit("sky.pbrt", 0, sky);
    std::sort(seen.begin(), seen.end());
    EXPECT_EQ(std::unique(seen.begin(), seen.end()), seen.end());
}

TEST_F(LightEditsTest, TurnLights) {
    const std::size_t light = scene_.lights.of<scene::PolygonLight>().front().emitter;
    LightEdits edits;
    LightEdit edit;
    edit.turn = {0, 0, 90};
    edits.set(light, edit);
    const scene::Double3 center = edits.center(scene_, light);
    const auto& before = scene_.lights.of<scene::PolygonLight>().front().vertices;
    const scene::Lights placed = edits.placed(scene_, light);
    const scene::Scene edited = edits.applied_to(scene_);
    for (std::size_t i = 0; i < before.size(); ++i) {
        const scene::Double3 way = to_double(before[i]) - center;
        const scene::Double3 expected = center + scene::Double3{-way.y, way.x, way.z};
        for (const scene::Lights* lights : {&placed, &edited.lights})
            EXPECT_LT(length(to_double(lights->of<scene::PolygonLight>().front().vertices[i]) - expected),
                      1e-5);
    }
}

TEST_F(LightEditsTest, CombineRotations) {
    const scene::Double3 x = {90, 0, 0};
    const scene::Double3 y = {0, 90, 0};
    // First x: y becomes z; then y: z becomes x. The axis (1, 1, -1) stays.
    const scene::Double3 both = combined_turn(x, y);
    EXPECT_NEAR(length(both), 120, 1e-9);
    EXPECT_LT(length(normalized(both) - normalized(scene::Double3{1, 1, -1})), 1e-9);
    EXPECT_LT(length(combined_turn(x, {-90, 0, 0})), 1e-9);
    EXPECT_LT(length(combined_turn({}, y) - y), 1e-9);
    EXPECT_LT(length(combined_turn({0, 170, 0}, {0, 30, 0}) - scene::Double3{0, -160, 0}), 1e-9);
}

TEST_F(LightEditsTest, ColourLightsAndKeepTheirLuminance) {
    const std::size_t light = scene_.lights.of<scene::PolygonLight>().front().emitter;
    LightEdits edits;
    LightEdit edit;
    edit.colour = Temperature{2000};
    edits.set(light, edit);
    const scene::Float3 warm = edits.applied_to(scene_).lights.of<scene::PolygonLight>().front().radiance;
    const scene::Float3 before = edits.emission_before(scene_, light);
    EXPECT_GT(warm.x, 3 * warm.z);
    EXPECT_NEAR(luminance(to_double(warm)), luminance(to_double(before)),
                1e-5 * luminance(to_double(before)));
}

TEST_F(LightEditsTest, AddAndRemoveLights) {
    const std::size_t count = scene_.emitters.size();
    LightEdits edits;
    const NewLight panel = {"lamp", LightShape::panel, {0, 1, 0}, {0, -1, 0}, 0.5, {1, 1, 1}};
    EXPECT_EQ(edits.add(scene_, panel), count);
    EXPECT_EQ(edits.add(scene_, {"lamp", LightShape::tube, {0, 1, 0}, {1, 0, 0}, 2, {1, 1, 1}}), count + 1);
    EXPECT_EQ(edits.name(scene_, count), "lamp 1");
    EXPECT_EQ(edits.name(scene_, count + 1), "lamp 2");
    EXPECT_EQ(edits.applied_to(scene_).emitters.size(), count + 2);
    const scene::PolygonLight added = edits.applied_to(scene_).lights.of<scene::PolygonLight>().back();
    EXPECT_NEAR(area(added), 0.25, 1e-6);
    // It emits to the side from which its vertices appear counter-clockwise.
    EXPECT_LT(cross(to_double(added.vertices[1]) - to_double(added.vertices[0]),
                    to_double(added.vertices[2]) - to_double(added.vertices[0]))
                  .y,
              0);
    edits.remove(0);
    EXPECT_FALSE(edits.has(scene_, 0));
    edits.remove(count);
    EXPECT_EQ(edits.lights(scene_).size(), count);
    const scene::Scene edited = edits.applied_to(scene_);
    ASSERT_EQ(edited.emitters.size(), count);
    EXPECT_EQ(edited.emitters.back().name, "lamp 2");
    EXPECT_EQ(edits.rig_text(scene_).find("lamp 1"), std::string::npos);
}

} // namespace

} // namespace nusselt::viewer
