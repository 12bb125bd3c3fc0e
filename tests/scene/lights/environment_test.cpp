// Environments of scene files: which way images and skies lie, and how bright they are.

#include "scene_fixture.h"

#include "image/io.h"
#include "scene/build/lights/environment.h"
#include "scene/model/content_hash.h"
#include "scene/model/lights/light_geometry.h"
#include "scene/model/transform.h"

#include <cmath>
#include <numbers>

namespace nusselt::scene {
namespace {

/// The texel of the square that shows a direction, by the formulas of Clarberg 2008.
Float3 texel_towards(const EnvironmentMapTexels& map, const Double3& direction) {
    const double r = std::sqrt(1 - std::fabs(direction.z));
    const double b = r * 2 / std::numbers::pi * std::atan2(std::fabs(direction.y), std::fabs(direction.x));
    const double x = direction.z < 0 ? 1 - b : r - b;
    const double y = direction.z < 0 ? 1 - (r - b) : b;
    const auto index = [&](double offset, double sign) {
        const double at = (0.5 + 0.5 * std::copysign(offset, sign)) * map.size;
        return static_cast<std::size_t>(std::min(at, map.size - 1.0));
    };
    return map.texels[index(y, direction.y) * static_cast<std::size_t>(map.size) + index(x, direction.x)];
}

class Environments : public SceneTest {
protected:
    /// An image from a function of column and row, with row 0 at the top.
    template <class Colour>
    void write_picture(const std::string& name, int width, int height, const Colour& colour) const {
        image::Image image = image::make_image(width, height);
        for (int j = 0; j < height; ++j) {
            for (int i = 0; i < width; ++i) {
                const Float3 c = colour(i, j);
                float* const pixel = &image.pixels[3 * static_cast<std::size_t>(j * width + i)];
                pixel[0] = c.x;
                pixel[1] = c.y;
                pixel[2] = c.z;
            }
        }
        image::write_image(folder_ / name, image);
    }

    Scene light(const std::string& directive, const std::string& film = "") const {
        return load(film + "Camera \"perspective\"\nWorldBegin\n" + directive + "\n" +
                    std::string(kTriangle));
    }
};

const EnvironmentLight& environment(const Scene& scene) { return scene.lights.of<EnvironmentLight>().at(0); }
std::uint64_t hash_of(const EnvironmentLight& light) {
    ContentHash hash;
    LightKind<EnvironmentLight>::hash(light, hash);
    return hash.value();
}
const EnvironmentMapTexels& map_of(const Scene& scene) {
    return *scene.environment_maps.at(static_cast<std::size_t>(environment(scene).map));
}

TEST_F(Environments, WithoutAnImageTheyAreUniform) {
    const Scene scene = light("LightSource \"infinite\" \"rgb L\" [1 2 3] \"float scale\" 2");
    EXPECT_EQ(environment(scene).map, -1);
    expect_near(environment(scene).radiance, {2, 4, 6}, 1e-6f);
    EXPECT_EQ(scene.emitters[0].name, "environment at scene.pbrt:3");
    const Scene lit = light("LightSource \"infinite\" \"float illuminance\" 10");
    EXPECT_NEAR(environment(lit).radiance.y, 10 / std::numbers::pi, 1e-5);
}

/// Bright towards +x, +y and +z of the light.
TEST_F(Environments, LatitudesHaveZAtTheUpperBorder) {
    write_picture("sky.pfm", 64, 32, [](int i, int j) {
        const float is_upper = j < 4 ? 1.0f : 0.0f;
        const bool is_middle = j >= 12 && j < 20;
        return Float3{is_middle && (i < 4 || i >= 60) ? 1.0f : 0.0f,
                      is_middle && i >= 12 && i < 20 ? 1.0f : 0.0f, is_upper};
    });
    for (const std::string film : {"Film \"image\"\n", ""}) {
        const std::string parameter = film.empty() ? "filename" : "mapname";
        const Scene scene = light("LightSource \"infinite\" \"string " + parameter + "\" \"sky.pfm\"", film);
        EXPECT_TRUE(scene.warnings.empty());
        expect_near(texel_towards(map_of(scene), {1, 0, 0}), {1, 0, 0}, 1e-6f);
        expect_near(texel_towards(map_of(scene), {0, 1, 0}), {0, 1, 0}, 1e-6f);
        expect_near(texel_towards(map_of(scene), {0, 0, 1}), {0, 0, 1}, 1e-6f);
        expect_near(texel_towards(map_of(scene), {-1, 0, 0}), {0, 0, 0}, 1e-6f);
        expect_near(texel_towards(map_of(scene), {0, 0, -1}), {0, 0, 0}, 1e-6f);
        // The cap has the solid angle 2 pi (1 - cos(22.5 degrees)).
        EXPECT_NEAR(environment(scene).radiance.z, 0.5 * (1 - std::cos(std::numbers::pi / 8)), 1e-3);
    }
}

TEST_F(Environments, SquareImagesKeepTheirTexels) {
    write_picture("map.pfm", 32, 32, [](int i, int j) {
        return Float3{static_cast<float>(i), static_cast<float>(j), 1};
    });
    const Scene scene = light("LightSource \"infinite\" \"string filename\" \"map.pfm\"");
    EXPECT_EQ(map_of(scene).size, 32);
    for (const std::size_t index : {std::size_t{0}, std::size_t{31}, std::size_t{32 * 31 + 5}})
        expect_near(map_of(scene).texels[index],
                    {static_cast<float>(index % 32), static_cast<float>(index / 32), 1}, 0);
    expect_near(environment(scene).radiance, {15.5f, 15.5f, 1}, 1e-5f);
}

TEST_F(Environments, TransformsTurnTheMap) {
    const Scene scene = light("Rotate 90 1 0 0\nLightSource \"infinite\" \"rgb L\" [1 1 1]");
    expect_near(environment(scene).z_axis, {0, -1, 0}, 1e-6f);
    expect_near(environment(scene).y_axis, {0, 0, 1}, 1e-6f);
    EXPECT_EQ(error("Camera \"perspective\"\nWorldBegin\nScale 0 1 1\nLightSource \"infinite\""),
              "scene.pbrt:4: LightSource \"infinite\": the transform is singular or not finite");
}

/// As in pbrt, whatever the space of the light.
TEST_F(Environments, PortalsAreInTheWorld) {
    const std::string portal = " \"point3 portal\" [0 0 1 3 0 1 3 2 1 0 2 1]";
    for (const std::string type : {"infinite", "sky"}) {
        const Scene scene = light("Translate 5 5 5\nRotate 90 1 0 0\nLightSource \"" + type + "\"" + portal);
        EXPECT_TRUE(scene.warnings.empty());
        ASSERT_EQ(environment(scene).portal.size(), 4u);
        expect_near(environment(scene).portal[2], {3, 2, 1}, 0);
        expect_near(environment(scene).z_axis, {0, -1, 0}, 1e-6f);
    }
}

TEST_F(Environments, EqualImagesAndSkiesAreOneMap) {
    write_picture("grey.pfm", 64, 32, [](int, int) { return Float3{1, 1, 1}; });
    write_picture("red.pfm", 64, 32, [](int, int) { return Float3{1, 0, 0}; });
    const std::string image = "LightSource \"infinite\" \"string filename\" ";
    const std::string sky = "LightSource \"sky\" \"float turbidity\" ";
    const Scene scene = light(image + "\"grey.pfm\"\n" + image + "\"red.pfm\"\n" + sky + "3\n" + image +
                              "\"grey.pfm\" \"float scale\" 2\n" + sky + "3\n" + sky + "5\n");
    std::vector<std::int32_t> maps;
    for (const EnvironmentLight& part : scene.lights.of<EnvironmentLight>()) maps.push_back(part.map);
    EXPECT_EQ(maps, (std::vector<std::int32_t>{0, 1, 2, 0, 2, 3}));
    EXPECT_EQ(scene.environment_maps.size(), 4u);
    expect_near(scene.lights.of<EnvironmentLight>()[3].radiance, {2, 2, 2}, 1e-5f);
}

/// Light comes from above only.
TEST_F(Environments, DarkPortalsGiveAWarning) {
    write_picture("upper.pfm", 64, 32, [](int, int j) {
        const float l = j < 16 ? 1.0f : 0.0f;
        return Float3{l, l, l};
    });
    const std::string shape = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0.5]\n";
    const std::string object = "ObjectBegin \"o\"\n" + shape + "ObjectEnd\nObjectInstance \"o\"\n";
    const auto with_portal = [&](const std::string& z, const std::string& surfaces, const std::string& turn) {
        const std::string at = " " + z + " ";
        return load("Camera \"perspective\"\nWorldBegin\nAttributeBegin\n" + turn +
                    "LightSource \"infinite\" \"string filename\" \"upper.pfm\" \"point3 portal\" [0 0" + at +
                    "3 0" + at + "3 2" + at + "0 2" + at + "]\nAttributeEnd\n" + surfaces);
    };
    for (const std::string& surfaces : {shape, object}) {
        EXPECT_TRUE(with_portal("2", surfaces, "").warnings.empty());
        EXPECT_TRUE(with_portal("0.2", surfaces, "").warnings.empty());
        EXPECT_EQ(warning(with_portal("-1", surfaces, "")),
                  "scene.pbrt:4: environment: no surface receives light through its portal, because the "
                  "environment "
                  "is black on the side without surfaces");
    }
    // Upside down, it comes from below.
    EXPECT_TRUE(with_portal("-1", shape, "Rotate 180 1 0 0\n").warnings.empty());
    EXPECT_EQ(with_portal("2", shape, "Rotate 180 1 0 0\n").warnings.size(), 1u);
}

/// The camera looks down at a floor with a portal beside it.
TEST_F(Environments, HiddenPortalsGiveAWarning) {
    const std::string floor =
        "Shape \"quad\" \"point o\" [-1.4 -1 -9] \"vector u\" [3.8 0 0] \"vector v\" [0 0 22]\n";
    const auto wall_at = [](const std::string& x) {
        return "Shape \"quad\" \"point o\" [" + x +
               " -99 -99] \"vector u\" [0 198 0] \"vector v\" [0 0 198]\n";
    };
    const std::string portal = "LightSource \"infinite\" \"point3 portal\" [2 0 0  2 0 2  2 2 2  2 2 0]\n";
    const auto scene = [&](const std::string& shapes) {
        return load("LookAt 0 3 2  0 -1 2  0 0 1\nCamera \"perspective\" \"float fov\" 40\nWorldBegin\n" +
                    portal + shapes);
    };
    EXPECT_TRUE(scene(floor).warnings.empty());
    EXPECT_TRUE(scene(floor + wall_at("-1.5")).warnings.empty());
    const std::string expected =
        "scene.pbrt:4: environment: nothing that the camera sees receives light through its "
        "portal; a wall may hide it";
    EXPECT_EQ(warning(scene(floor + wall_at("1.5"))), expected) << "between floor and portal";
    EXPECT_EQ(warning(scene(floor + wall_at("-1.5") + wall_at("2.5"))), expected) << "on both sides";
    const std::string object = "ObjectBegin \"o\"\n" + wall_at("1.5") + "ObjectEnd\nObjectInstance \"o\"\n";
    EXPECT_EQ(warning(scene(floor + object)), expected);
    EXPECT_TRUE(load("LookAt 9 1 1  2 1 1  0 1 0\nCamera \"perspective\"\nWorldBegin\n" + portal + floor +
                     wall_at("-99"))
                    .warnings.empty())
        << "the camera sees the floor through the portal";
}

TEST_F(Environments, PortalsMoveWithTheirLight) {
    using Kind = LightKind<EnvironmentLight>;
    EnvironmentLight light{.radiance = {1, 2, 3}, .portal = {{0, 0, 1}, {3, 0, 1}, {3, 2, 1}, {0, 2, 1}}};
    const EnvironmentLight original = light;
    EXPECT_EQ(
        Kind::describe({&original, 1}, 7),
        "portal of 6 m^2, radiance 1 2 3 W/(sr m^2), power 18.8496 37.6991 56.5487 W through the portal");
    Moment moment;
    Kind::add_moment(light, moment);
    expect_near(to_float(moment.centroid()), {1.5f, 1, 1}, 1e-6f);

    Kind::transform(light, translation({1, 0, -4}));
    expect_near(light.portal[2], {4, 2, -3}, 0);
    EXPECT_TRUE(Kind::is_valid(light));
    EXPECT_FALSE(Kind::same_shape(light, original));
    EXPECT_NE(hash_of(light), hash_of(original));
    EnvironmentLight open = original;
    open.portal = {};
    EXPECT_FALSE(Kind::same_shape(open, original));
    EXPECT_NE(hash_of(open), hash_of(original));
    EXPECT_EQ(hash_of(EnvironmentLight(original)), hash_of(original));

    Kind::transform(light, scaling({1e-15, 1e-15, 1e-15}));
    EXPECT_FALSE(Kind::is_valid(light));
}

TEST_F(Environments, SkiesHaveTheirSunAndTheirGround) {
    const Scene scene = light("LightSource \"sky\" \"vector3 sun\" [0.6 0 0.8] \"rgb ground\" [0.5 0 0]");
    const EnvironmentMapTexels& map = map_of(scene);
    EXPECT_GT(texel_towards(map, {0.6, 0, 0.8}).y, 1e5f);
    const Float3 zenith = texel_towards(map, {0, 0, 1});
    EXPECT_GT(zenith.z, zenith.x);
    EXPECT_LT(zenith.z, 200);
    const Float3 ground = texel_towards(map, {0, 0.6, -0.8});
    EXPECT_EQ(ground.y, 0);
    // What the ground reflects is its albedo over pi times what it receives.
    EXPECT_NEAR(ground.x, 0.5 / std::numbers::pi * irradiance_of(map).x, 1e-4 * ground.x);
    EXPECT_EQ(error("Camera \"perspective\"\nWorldBegin\nLightSource \"sky\" \"float turbidity\" 1"),
              "scene.pbrt:3: LightSource \"sky\": turbidity must be from 2 to 10, found 1");
    EXPECT_EQ(error("Camera \"perspective\"\nWorldBegin\nLightSource \"sky\" \"vector3 sun\" [0 0 0]"),
              "scene.pbrt:3: LightSource \"sky\": the direction to the sun must not be zero");
    EXPECT_EQ(error("Camera \"perspective\"\nWorldBegin\nLightSource \"sky\" \"rgb ground\" [2 0 0]"),
              "scene.pbrt:3: LightSource \"sky\": the albedo of the ground must be from 0 to 1, found 2");
}

TEST_F(Environments, HostileImages) {
    EXPECT_EQ(
        error(
            "Camera \"perspective\"\nWorldBegin\nLightSource \"infinite\" \"string filename\" \"none.exr\""),
        "scene.pbrt:3: texture file 'none.exr': no such file");
    write_picture("black.pfm", 2, 2, [](int, int) { return Float3{0, 0, 0}; });
    const Scene black = light("LightSource \"infinite\" \"string filename\" \"black.pfm\"");
    EXPECT_TRUE(black.lights.of<EnvironmentLight>().empty());
    EXPECT_EQ(warning(black), "scene.pbrt:3: environment: it emits no light because what it shows of the "
                              "image 'black.pfm' is black (below 1e-30)");
    // The illuminance brightens one texel of 256 beyond the limit, but not the mean.
    write_picture("dot.pfm", 16, 16, [](int i, int j) {
        const float value = i == 8 && j == 8 ? 1.0f : 0.0f;
        return Float3{value, value, value};
    });
    const std::string dot = "LightSource \"infinite\" \"string filename\" \"dot.pfm\" \"float illuminance\" ";
    EXPECT_EQ(light(dot + "1e10").lights.of<EnvironmentLight>().size(), 1u);
    EXPECT_TRUE(error("Camera \"perspective\"\nWorldBegin\n" + dot + "5e29")
                    .starts_with("scene.pbrt:3: environment: radiance must be from 0 to 1e+30, found "));
    write_picture("odd.pfm", 5, 3, [](int, int) { return Float3{1, 2, 3}; });
    const Scene odd = light("LightSource \"infinite\" \"string filename\" \"odd.pfm\"");
    expect_near(environment(odd).radiance, {1, 2, 3}, 1e-5f);
    EXPECT_EQ(warning(odd),
              "scene.pbrt:3: environment: the image 'odd.pfm' is neither square nor twice as wide as high; "
              "it is taken for one in latitudes and longitudes");
}

} // namespace
} // namespace nusselt::scene
