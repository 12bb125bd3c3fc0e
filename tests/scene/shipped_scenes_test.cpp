// The scenes that come with the project load silently and agree with their comments.

#include "common/source_folder.h"
#include "scene/model/profiles/emission_profile.h"
#include "scene/rig/rig.h"
#include "scene/rig/rig_json.h"
#include "scene_fixture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>

namespace nusselt::scene {
namespace {

const std::filesystem::path kFolder = std::filesystem::path(nusselt_test::kSourceFolder) / "scenes";

Scene shipped(const std::string& name) {
    Scene scene = load_scene(kFolder / name);
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
    return scene;
}

Double3 vertex(const Scene& scene, std::size_t triangle, std::size_t i) {
    return to_double(scene.positions[scene.triangles[triangle].vertex[i]]);
}

/// Whether the right-hand side of triangles [begin, end) is towards a point.
void expect_facing(const Scene& scene, std::size_t begin, std::size_t end, const Double3& point) {
    for (std::size_t i = begin; i < end; ++i) {
        const Double3 p = vertex(scene, i, 0);
        EXPECT_GT(dot(cross(vertex(scene, i, 1) - p, vertex(scene, i, 2) - p), point - p), 0)
            << "triangle " << i;
    }
}

/// Volume inside a closed surface, positive if its normals point outwards.
double volume(const Scene& scene) {
    double result = 0;
    for (std::size_t i = 0; i < scene.triangles.size(); ++i)
        result += dot(vertex(scene, i, 0), cross(vertex(scene, i, 1), vertex(scene, i, 2))) / 6;
    return result;
}

class Parts : public SceneTest {};

TEST_F(Parts, AreClosedAndPointOutwards) {
    const std::string include = "Camera \"perspective\" WorldBegin Include \"";
    EXPECT_NEAR(volume(load(include + (kFolder / "shapes/box.pbrt").string() + '"')), 1, 1e-6);
    // An octagon of circumscribed radius 1/2 has the area 2 sqrt(2) / 4.
    EXPECT_NEAR(volume(load(include + (kFolder / "shapes/prism.pbrt").string() + '"')), std::sqrt(0.5), 1e-5);
    // A torus has the volume 2 pi^2 R r^2; polygons of 48 and 24 sides inside its circles lose 1.7 percent.
    const Scene torus = load("Camera \"perspective\" WorldBegin Shape \"plymesh\" \"string filename\" \"" +
                             (kFolder / "shapes/torus.ply").string() + '"');
    const double ideal = 2 * std::pow(std::numbers::pi * 0.35, 2);
    EXPECT_LT(volume(torus), ideal);
    EXPECT_GT(volume(torus), 0.98 * ideal);
}

TEST(ShippedScenes, CornellTube) {
    const Scene scene = shipped("cornell-tube.pbrt");
    expect_facing(scene, 0, 10, {0, 1, 0.9});
    EXPECT_EQ(scene.triangles.size(), 10u + 2 * 12u);
    for (const Material& material : scene.materials) EXPECT_EQ(material.model, BrdfModel::lambert);
    ASSERT_EQ(scene.lights.of<LineLight>().size(), 1u);
    EXPECT_TRUE(scene.lights.of<PolygonLight>().empty());
    EXPECT_GT(scene.lights.of<LineLight>()[0].start.y, 1.9f);
    EXPECT_LT(scene.lights.of<LineLight>()[0].start.y + scene.lights.of<LineLight>()[0].radius, 2.0f);
    EXPECT_EQ(scene.film.width, 512);
    // The red wall is on the left of the image: there the camera looks to smaller x.
    EXPECT_LT(scene.camera.corner.x, 0);
    EXPECT_GT(scene.camera.right.x, 0);
    EXPECT_LT(scene.camera.down.y, 0);
}

TEST(ShippedScenes, CornellPanel) {
    const Scene scene = shipped("cornell-panel.pbrt");
    expect_facing(scene, 0, 10, {0, 1, 0.9});
    for (const Material& material : scene.materials) {
        EXPECT_EQ(material.model, BrdfModel::frostbite);
        EXPECT_EQ(material.roughness, 1);
    }
    ASSERT_EQ(scene.lights.of<PolygonLight>().size(), 1u);
    EXPECT_EQ(scene.lights.of<PolygonLight>()[0].vertices.size(), 4u);
    EXPECT_TRUE(scene.lights.of<PolygonLight>()[0].two_sided);
}

TEST(ShippedScenes, GridPlanes) {
    const Scene scene = shipped("grid-planes.pbrt");
    // The floor, three grids, and the light.
    EXPECT_EQ(scene.triangles.size(), 2u * (1 + 3 * 64 + 1));
    for (std::size_t i = 2; i < scene.triangles.size() - 2; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_GT(vertex(scene, i, k).y, 0);
            EXPECT_LT(vertex(scene, i, k).y, 4);
        }
    ASSERT_EQ(scene.lights.of<PolygonLight>().size(), 1u);
    EXPECT_EQ(emitting_normal(scene.lights.of<PolygonLight>()[0]).y, -1);
}

/// Whether the segment from a to b cuts the triangle.
bool cuts(const Double3& a, const Double3& b, const Double3 (&triangle)[3]) {
    const auto side = [](const Double3& p, const Double3& q, const Double3& r, const Double3& s) {
        return dot(cross(q - p, r - p), s - p);
    };
    const auto& [p, q, r] = triangle;
    const double u = side(a, b, p, q), v = side(a, b, q, r), w = side(a, b, r, p);
    return side(p, q, r, a) * side(p, q, r, b) < 0 && u * v > 0 && v * w > 0;
}

TEST(ShippedScenes, TrianglesOfTheSoupAreDisjoint) {
    const Scene scene = shipped("soup.pbrt");
    constexpr std::size_t kRoom = 10, kCount = 1000;
    ASSERT_EQ(scene.triangles.size(), kRoom + kCount + 2);
    std::vector<std::array<Double3, 3>> soup;
    for (std::size_t i = kRoom; i < kRoom + kCount; ++i)
        soup.push_back({vertex(scene, i, 0), vertex(scene, i, 1), vertex(scene, i, 2)});
    for (const auto& one : soup)
        for (const auto& other : soup) {
            if (&one == &other) continue;
            const Double3 corners[3] = {other[0], other[1], other[2]};
            for (std::size_t k = 0; k < 3; ++k) ASSERT_FALSE(cuts(one[k], one[(k + 1) % 3], corners));
        }
}

TEST(ShippedScenes, Logo) {
    const Scene scene = shipped("logo.pbrt");
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(scene.materials[0].model, BrdfModel::phong);
    EXPECT_EQ(scene.materials[0].exponent, 1000);
    // The panel shines past the letters towards the camera.
    ASSERT_EQ(scene.lights.of<PolygonLight>().size(), 1u);
    EXPECT_EQ(emitting_normal(scene.lights.of<PolygonLight>()[0]).z, 1);
}

TEST(ShippedScenes, Ring) {
    const Scene scene = shipped("ring.pbrt");
    ASSERT_EQ(scene.lights.of<PolygonLight>().size(), 1u);
    EXPECT_EQ(scene.lights.of<PolygonLight>()[0].vertices.size(), 3u);
    EXPECT_EQ(emitting_normal(scene.lights.of<PolygonLight>()[0]).y, -1);
}

TEST(ShippedScenes, Bollards) {
    const Scene scene = shipped("bollards.pbrt");
    // Ground, puddle and wall come first; the camera sees their right-hand sides.
    expect_facing(scene, 0, 9, to_double(scene.camera.origin));
    EXPECT_EQ(scene.lights.of<LineLight>().size(), 1u);
    EXPECT_EQ(scene.film.width, 1280);
    EXPECT_EQ(scene.film.height, 720);
}

TEST(ShippedScenes, Stage) {
    const Scene scene = shipped("stage.pbrt");
    // Boards and curtain come first; the camera sees their right-hand sides.
    expect_facing(scene, 0, 4, to_double(scene.camera.origin));
    ASSERT_EQ(scene.lights.of<PointLight>().size(), 3u);
    EXPECT_EQ(scene.lights.of<DistantLight>().size(), 1u);
    // The first spot is above the audience and shines on the ring.
    const PointLight& spot = scene.lights.of<PointLight>()[0];
    const Double3 to_ring = Double3{0, 0.5, 0} - to_double(spot.position);
    EXPECT_LT(length(cross(to_ring, to_double(spot.z_axis))), 1e-5);
}

TEST(ShippedScenes, Street) {
    const Scene scene = shipped("street.pbrt");
    // The road comes first; the camera sees its right-hand side.
    expect_facing(scene, 0, 2, to_double(scene.camera.origin));
    std::size_t luminaires = 0;
    for (const PolygonLight& light : scene.lights.of<PolygonLight>()) {
        if (light.profile < 0) continue;
        const ProfiledEmission& emission = scene.emission_profiles[static_cast<std::size_t>(light.profile)];
        const std::shared_ptr<const Luminaire>& luminaire = emission.profile->luminaire;
        if (luminaire == nullptr || luminaire->name != "street.ies") continue;
        ++luminaires;
        EXPECT_LT(emission.profile->lost, 0.01);
        const ProfilePlacement placement = place_profile(light, emission);
        EXPECT_NEAR(placement.z_axis.y, -1, 1e-6);
        // The half-plane of 90 degrees leads to the middle of the road.
        EXPECT_GT(placement.y_axis.x * light.vertices[0].x, 0);
    }
    EXPECT_EQ(luminaires, 5u);
}

TEST(ShippedScenes, Neon) {
    const Scene scene = shipped("neon.pbrt");
    expect_facing(scene, 0, 12, to_double(scene.camera.origin));
    const std::vector<LineLight>& tubes = scene.lights.of<LineLight>();
    ASSERT_EQ(tubes.size(), 9u);
    for (const LineLight& tube : tubes) {
        ASSERT_GE(tube.texture, 0);
        EXPECT_EQ(scene.emission_textures[static_cast<std::size_t>(tube.texture)].texture->height,
                  kMaxLineTexels);
        for (const Float3& end : {tube.start, tube.end}) {
            EXPECT_TRUE(std::fabs(end.x) < 3 - tube.radius && end.z > -2.2f + tube.radius && end.z < 5);
            EXPECT_TRUE(end.y > tube.radius && end.y < 3 - tube.radius);
        }
    }
    // The colours of the sign go on from stroke to stroke.
    EXPECT_LT(length(to_double(tubes[0].end) - to_double(tubes[1].end)), 0.1);
    EXPECT_LT(length(to_double(tubes[1].start) - to_double(tubes[2].start)), 0.1);
}

/// The portal is the hole in the wall, and nothing else of the room is open.
TEST(ShippedScenes, Window) {
    const Scene scene = shipped("window.pbrt");
    ASSERT_EQ(scene.lights.of<EnvironmentLight>().size(), 1u);
    const EnvironmentLight& sky = scene.lights.of<EnvironmentLight>()[0];
    ASSERT_EQ(sky.portal.size(), 4u);
    for (const Float3& corner : sky.portal) {
        EXPECT_EQ(corner.x, -2.2f);
        const auto is_corner = [&](const Float3& p) {
            return p.x == corner.x && p.y == corner.y && p.z == corner.z;
        };
        EXPECT_TRUE(std::any_of(scene.positions.begin(), scene.positions.end(), is_corner));
    }
    // The walls of a box, without the hole.
    double area = 0;
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        const std::string& name = scene.materials[scene.triangle_material[i]].name;
        const Double3 p = vertex(scene, i, 0);
        if (name == "wall" || name == "parquet")
            area += length(cross(vertex(scene, i, 1) - p, vertex(scene, i, 2) - p)) / 2;
    }
    EXPECT_NEAR(area, 2 * (4.4 * 2.5 + 4.4 * 5.4 + 2.5 * 5.4) - 1.3 * 1.8, 1e-4);
}

TEST(ShippedScenes, Wall) {
    const Scene scene = shipped("wall.pbrt");
    expect_facing(scene, 0, 4, to_double(scene.camera.origin));
    EXPECT_EQ(scene.materials[0].roughness, 1);
    EXPECT_NEAR(scene.materials[1].roughness, 0.3, 1e-6);
    ASSERT_EQ(scene.lights.of<PolygonLight>().size(), 1u);
    EXPECT_EQ(emitting_normal(scene.lights.of<PolygonLight>()[0]).x, 1);
}

TEST(ShippedScenes, Planes) {
    const Scene scene = shipped("planes.pbrt");
    expect_facing(scene, 0, 6, to_double(scene.camera.origin));
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(scene.materials[i].roughness, 0.2 * (static_cast<double>(i) + 1), 1e-6);
    ASSERT_EQ(scene.lights.of<PolygonLight>().size(), 1u);
    EXPECT_EQ(emitting_normal(scene.lights.of<PolygonLight>()[0]).y, -1);
}

TEST(ShippedScenes, Biased) {
    const Scene scene = shipped("biased.pbrt");
    expect_facing(scene, 0, 2, to_double(scene.camera.origin));
    EXPECT_NEAR(scene.materials[0].roughness, 0.15, 1e-6);
    ASSERT_EQ(scene.lights.of<PolygonLight>().size(), 1u);
    EXPECT_GT(emitting_normal(scene.lights.of<PolygonLight>()[0]).z, 0);
}

TEST(ShippedScenes, Room) {
    const Scene scene = shipped("room.pbrt");
    expect_facing(scene, 0, 12, to_double(scene.camera.origin));
    ASSERT_EQ(scene.lights.of<LineLight>().size(), 1u);
    ASSERT_EQ(scene.lights.of<PolygonLight>().size(), 2u);
    EXPECT_EQ(emitting_normal(scene.lights.of<PolygonLight>()[0]).y, -1);
    EXPECT_EQ(emitting_normal(scene.lights.of<PolygonLight>()[1]).y, 1);
    // Nothing sticks out of the room.
    for (const Float3& p : scene.positions) {
        EXPECT_LE(std::fabs(p.x), 2.4f);
        EXPECT_GE(p.y, 0);
        EXPECT_LE(p.y, 2.5f);
        EXPECT_GE(p.z, -2);
        EXPECT_LE(p.z, 3.6f);
    }
}

TEST(ShippedRigs, LightTheRoom) {
    const auto lit_by = [](const std::string& rig) {
        Scene scene = shipped("room.pbrt");
        apply_rig(read_rig(kFolder / "rigs" / rig), scene);
        return scene;
    };
    const Scene panel = lit_by("room-panel.json");
    EXPECT_TRUE(panel.lights.of<LineLight>().empty());
    ASSERT_EQ(panel.lights.of<PolygonLight>().size(), 1u);
    EXPECT_EQ(emitting_normal(panel.lights.of<PolygonLight>()[0]).y, -1);
    const Scene tube = lit_by("room-tube.json");
    EXPECT_EQ(tube.lights.of<LineLight>().size(), 1u);
    EXPECT_TRUE(tube.lights.of<PolygonLight>().empty());
    const Scene hundred = lit_by("room-hundred.json");
    EXPECT_TRUE(hundred.lights.of<LineLight>().empty());
    ASSERT_EQ(hundred.lights.of<PolygonLight>().size(), 100u);
    for (const PolygonLight& light : hundred.lights.of<PolygonLight>()) {
        EXPECT_EQ(emitting_normal(light).y, -1);
        for (const Float3& p : light.vertices) EXPECT_TRUE(p.y < 2.5f && std::fabs(p.x) < 2.4f && p.z > -2);
    }
}

TEST_F(Parts, OfTheManualAreGoodRigs) {
    std::ifstream manual(std::filesystem::path(nusselt_test::kSourceFolder) / "docs/lights.md");
    const std::string text{std::istreambuf_iterator<char>(manual), {}};
    const std::string fence = "```json\n";
    const std::size_t begin = text.find(fence) + fence.size();
    write("rig.json", text.substr(begin, text.find("```", begin) - begin));
    Scene scene = shipped("room.pbrt");
    apply_rig(read_rig(folder_ / "rig.json"), scene);
    EXPECT_TRUE(scene.lights.of<LineLight>().empty());
    EXPECT_EQ(scene.lights.of<PolygonLight>().size(), 2u + 4u);
    EXPECT_EQ(scene.emitters.back().name, "spot 3");
}

TEST(ShippedRigs, AreGoodFiles) {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(kFolder / "rigs")) {
        EXPECT_FALSE(read_rig(entry.path()).lights.empty()) << entry.path();
        ++count;
    }
    EXPECT_EQ(count, 10u);
}

TEST(ShippedRigs, SmallLightsHaveThePowerOfLargeOnes) {
    for (const char* name : {"grid-planes.pbrt", "logo.pbrt", "soup.pbrt", "ring.pbrt"}) {
        const Scene large = shipped(name);
        Scene small = shipped(name);
        apply_rig(read_rig(kFolder / "rigs/small-light.json"), small);
        ASSERT_EQ(small.lights.of<PolygonLight>().size(), 1u) << name;
        const PolygonLight& before = large.lights.of<PolygonLight>()[0];
        const PolygonLight& after = small.lights.of<PolygonLight>()[0];
        const auto side = [](const PolygonLight& light) {
            return length(to_double(light.vertices[1]) - to_double(light.vertices[0]));
        };
        EXPECT_NEAR(side(after), 0.1 * side(before), 1e-5) << name;
        EXPECT_NEAR(after.radiance.x, 100 * before.radiance.x, 1e-2f) << name;
    }
}

} // namespace
} // namespace nusselt::scene
