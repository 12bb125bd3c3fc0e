/// Kinds of light are rows of tables; a kind without a twin in GLSL is refused.

#include "gpu_test.h"
#include "scenes.h"
#include "toy_light/disc.h"

#include "render_vulkan/backend.h"
#include "render_vulkan/scene_records.h"
#include "scene/model/profiles/line_profile.h"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace nusselt::render_vulkan_test {
namespace {

using render_vulkan::LightRecords;
using render_vulkan::make_light_records;
using render_vulkan::make_scene_records;
using scene::DiscLight;

std::string error_of(const std::function<void()>& run) {
    try {
        run();
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

constexpr const char* kRefusal = "disc lights are not supported on GPUs; use --backend cpu";

scene::Scene make_scene_with_disc() {
    scene::Scene scene = render_test::make_floor(4);
    scene.emitters.push_back({"disc"});
    scene.lights.of<DiscLight>().push_back({.center = {0, 0, 1}, .radius = 1, .radiance = {1, 1, 1}});
    return scene;
}

TEST(LightRecords, RefuseKindsWithoutARow) {
    scene::Scene scene = make_scene_with_disc();
    EXPECT_EQ(error_of([&] { make_light_records(scene); }), kRefusal);
    EXPECT_EQ(error_of([&] { make_scene_records(scene); }), kRefusal);
    scene.lights.of<DiscLight>().clear();
    EXPECT_EQ(error_of([&] { make_scene_records(scene); }), "");
}

class LightKindsOnGpu : public parity::GpuTest {};

TEST_F(LightKindsOnGpu, WithoutARowAreRefused) {
    const render_vulkan::VulkanBackend backend({.validation = gpu::Validation::on},
                                               render_vulkan::ShadowRays::none);
    scene::Scene scene = make_scene_with_disc();
    EXPECT_EQ(error_of([&] { static_cast<void>(backend.prepare(scene)); }), kRefusal);
    EXPECT_EQ(backend.why_unsupported(scene, {}), "disc lights are not supported on GPUs");
    EXPECT_THROW(static_cast<void>(render::render(backend, scene, {})), std::invalid_argument);
    scene.lights.of<DiscLight>().clear();
    EXPECT_EQ(error_of([&] { static_cast<void>(backend.prepare(scene)); }), "");
    EXPECT_EQ(backend.why_unsupported(scene, {}), std::nullopt);
}

/// The constants of shapes that a scene has.
std::vector<int> shapes_of(const scene::Scene& scene) {
    std::vector<int> shapes;
    const std::vector<std::uint32_t> constants = constants_of(make_scene_records(scene).kinds);
    for (int i = interface::kFirstLightConstant; i < interface::kConstantCount; ++i)
        if (constants.at(static_cast<std::size_t>(i)) != 0) shapes.push_back(i);
    return shapes;
}

TEST(LightRecords, HaveWhatShadersReadOfEachKind) {
    scene::Scene scene = render_test::make_floor(4);
    EXPECT_EQ(shapes_of(scene), std::vector<int>());
    const scene::PolygonLight polygon{0, -1, {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, {1, 2, 3}, true};
    scene.lights.of<scene::PolygonLight>() = {polygon, polygon};
    EXPECT_EQ(shapes_of(scene), std::vector<int>{interface::kPolygonsConstant});
    const auto shapes_with_textures = [&](bool has_uniform) {
        scene::Scene other = render_test::make_floor(4);
        auto texture = std::make_shared<scene::EmissionTexture>();
        texture->width = 2;
        texture->height = 1;
        texture->texels = {{1, 1, 1}, {3, 3, 3}};
        scene::PolygonLight textured = polygon;
        textured.texture = 0;
        other.emission_textures = {{texture, {{{0, 0}, {1, 0}, {0, 1}}}, {2, 2, 2}}};
        other.lights.of<scene::PolygonLight>() = {textured};
        if (has_uniform) other.lights.of<scene::PolygonLight>().push_back(polygon);
        return shapes_of(other);
    };
    EXPECT_EQ(shapes_with_textures(false), std::vector<int>{interface::kTexturedPolygonsConstant});
    EXPECT_EQ(shapes_with_textures(true),
              (std::vector<int>{interface::kPolygonsConstant, interface::kTexturedPolygonsConstant}));
    const scene::LineLight line{1, {0, 0, 1}, {1, 0, 1}, 0.1f, {2, 2, 2}, scene::TubeModel::linear};
    scene.lights.of<scene::LineLight>() = {line, line, line};
    EXPECT_EQ(shapes_of(scene), (std::vector<int>{interface::kPolygonsConstant, interface::kLinesConstant}));
    scene.lights.of<scene::LineLight>()[1].model = scene::TubeModel::solid;
    const auto shapes_with = [&](scene::TubeModel model) {
        scene::Scene other = render_test::make_floor(4);
        other.lights.of<scene::LineLight>() = {line};
        other.lights.of<scene::LineLight>()[0].model = model;
        return shapes_of(other);
    };
    EXPECT_EQ(shapes_with(scene::TubeModel::strip), std::vector<int>{interface::kLinesConstant});
    EXPECT_EQ(shapes_with(scene::TubeModel::open), std::vector<int>{interface::kTubesConstant});
    const auto shapes_with_texture = [&](scene::TubeModel model) {
        scene::Scene other = render_test::make_floor(4);
        auto texture = std::make_shared<scene::EmissionTexture>();
        texture->width = 1;
        texture->height = 2;
        texture->texels = {{1, 1, 1}, {3, 3, 3}};
        other.emission_textures = {{texture, {}, {2, 2, 2}}};
        other.lights.of<scene::LineLight>() = {line};
        other.lights.of<scene::LineLight>()[0].model = model;
        other.lights.of<scene::LineLight>()[0].texture = 0;
        return shapes_of(other);
    };
    EXPECT_EQ(shapes_with_texture(scene::TubeModel::linear),
              std::vector<int>{interface::kTexturedLinesConstant});
    EXPECT_EQ(shapes_with_texture(scene::TubeModel::solid),
              std::vector<int>{interface::kTexturedTubesConstant});
    const auto shapes_with_profile = [&](scene::TubeModel model) {
        scene::Scene other = render_test::make_floor(4);
        scene::LineLight light = line;
        light.model = model;
        light.normal = {0, 0, 1};
        light.profile = 0;
        other.emission_profiles = scene::profile_line(light, {nullptr, 90, 0}).emissions;
        other.lights.of<scene::LineLight>() = {light};
        return shapes_of(other);
    };
    EXPECT_EQ(shapes_with_profile(scene::TubeModel::linear),
              std::vector<int>{interface::kProfiledLinesConstant});
    EXPECT_EQ(shapes_with_profile(scene::TubeModel::open),
              std::vector<int>{interface::kProfiledTubesConstant});
    scene.lights.of<scene::PolygonLight>().resize(1);
    EXPECT_EQ(shapes_of(scene), (std::vector<int>{interface::kPolygonsConstant, interface::kLinesConstant,
                                                  interface::kTubesConstant}));

    scene::PointLight point{.distribution = scene::PointDistribution::smooth_cone};
    const auto shapes_with_point = [&] {
        scene::Scene other = render_test::make_floor(4);
        other.lights.of<scene::PointLight>() = {point};
        return shapes_of(other);
    };
    EXPECT_EQ(shapes_with_point(), std::vector<int>{interface::kPointsConstant});
    point.distribution = scene::PointDistribution::projected_image;
    EXPECT_EQ(shapes_with_point(), std::vector<int>{interface::kPointImagesConstant});
    const auto shapes_with_environment = [&](std::int32_t map, const scene::PolygonVertices& portal) {
        scene::Scene other = render_test::make_floor(4);
        scene::EnvironmentMapTexels texels{"black", 16, {}, {0, 0, 0}};
        texels.texels.resize(16 * 16);
        other.environment_maps = {std::make_shared<const scene::EnvironmentMapTexels>(texels)};
        scene::EnvironmentLight light;
        light.map = map;
        light.portal = portal;
        other.lights.of<scene::EnvironmentLight>() = {light};
        return shapes_of(other);
    };
    EXPECT_EQ(shapes_with_environment(-1, {}), std::vector<int>{interface::kUniformEnvironmentsConstant});
    EXPECT_EQ(shapes_with_environment(0, {}), std::vector<int>{interface::kMappedEnvironmentsConstant});
    EXPECT_EQ(shapes_with_environment(-1, polygon.vertices),
              std::vector<int>{interface::kUniformPortalsConstant});
    EXPECT_EQ(shapes_with_environment(0, polygon.vertices),
              std::vector<int>{interface::kMappedPortalsConstant});
    const auto shapes_with_round = [&](scene::RoundModel model) {
        scene::Scene other = render_test::make_floor(4);
        other.lights.of<scene::RoundLight>() = {{.model = model}};
        return shapes_of(other);
    };
    EXPECT_EQ(shapes_with_round(scene::RoundModel::ellipse), std::vector<int>{interface::kEllipsesConstant});
    EXPECT_EQ(shapes_with_round(scene::RoundModel::hollow), std::vector<int>{interface::kEllipsoidsConstant});
    scene.lights.of<scene::PointLight>() = {point, point};
    scene.lights.of<scene::DistantLight>().resize(3);

    const render_vulkan::SceneRecords records = make_scene_records(scene);
    const interface::LightRange& polygons = records.scene.lights[interface::kPolygonKind];
    const interface::LightRange& lines = records.scene.lights[interface::kLineKind];
    EXPECT_EQ(polygons.first, 0u);
    EXPECT_EQ(polygons.count, 1u);
    EXPECT_EQ(lines.first, 1u);
    EXPECT_EQ(lines.count, 3u);
    LightRecords lights = records.lights;
    const auto bytes_at = [&](int binding) {
        return sizeof(std::uint32_t) * lights.array_at(binding).words.size();
    };
    EXPECT_EQ(bytes_at(interface::kPolygonLightsBinding), sizeof(interface::PolygonLightRecord));
    EXPECT_EQ(bytes_at(interface::kPolygonCornersBinding),
              2 * 4 * sizeof(scene::Float3) + sizeof(std::uint32_t))
        << "vertices and edges after the first word of all arrays";
    EXPECT_EQ(bytes_at(interface::kLineLightsBinding), 3 * sizeof(interface::LineLightRecord));
    EXPECT_EQ(bytes_at(interface::kPointLightsBinding), 2 * sizeof(interface::PointLightRecord));
    EXPECT_EQ(bytes_at(interface::kDistantLightsBinding), 3 * sizeof(interface::DistantLightRecord));
}

} // namespace
} // namespace nusselt::render_vulkan_test
