/// Loads each scene of tests/scene/corpus and compares it with its comments, see docs/testing.md.

#include "common/source_folder.h"
#include "scene/import/importers.h"
#include "scene/model/polygon.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace nusselt::scene {
namespace {

const std::filesystem::path kCorpus =
    std::filesystem::path(nusselt_test::kSourceFolder) / "tests/scene/corpus";

/// The expected outcome in each file, in lines "# expect KEY: VALUE".
struct Expectations {
    std::optional<std::string> error;
    std::vector<std::string> warnings;
    std::vector<std::pair<std::string, std::string>> facts;
};

Expectations read_expectations(const std::filesystem::path& path) {
    Expectations result;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        constexpr std::string_view kMark = "# expect ";
        if (line.rfind(kMark, 0) != 0) continue;
        const std::size_t colon = line.find(": ");
        if (colon == std::string::npos) throw std::runtime_error(path.string() + ": no colon in: " + line);
        const std::string key = line.substr(kMark.size(), colon - kMark.size());
        const std::string value = line.substr(colon + 2);
        if (key == "error")
            result.error = value;
        else if (key == "warning")
            result.warnings.push_back(value);
        else
            result.facts.emplace_back(key, value);
    }
    return result;
}

using Numbers = std::vector<double>;

void append(Numbers& numbers, const Float3& v) { numbers.insert(numbers.end(), {v.x, v.y, v.z}); }

class Box {
public:
    void add(const Double3& p) {
        const double entries[] = {p.x, p.y, p.z};
        for (std::size_t i = 0; i < 3; ++i) {
            box_[i] = std::min(box_[i], entries[i]);
            box_[i + 3] = std::max(box_[i + 3], entries[i]);
        }
    }
    const Numbers& numbers() const { return box_; }

private:
    static constexpr double kMax = std::numeric_limits<double>::max();
    Numbers box_ = {kMax, kMax, kMax, -kMax, -kMax, -kMax};
};

Double3 transformed(const std::array<float, 12>& rows, const Float3& p) {
    const auto row = [&](std::size_t i) {
        return static_cast<double>(rows[i]) * p.x + static_cast<double>(rows[i + 1]) * p.y +
               static_cast<double>(rows[i + 2]) * p.z + static_cast<double>(rows[i + 3]);
    };
    return {row(0), row(4), row(8)};
}

/// The bounds of all visible triangles.
Numbers bounds(const Scene& scene) {
    Box box;
    const auto add = [&](std::size_t begin, std::size_t end, const auto& place) {
        for (std::size_t i = begin; i < end; ++i)
            for (const std::uint32_t vertex : scene.triangles[i].vertex)
                box.add(place(scene.positions[vertex]));
    };
    add(0, world_triangle_count(scene), [](const Float3& p) { return to_double(p); });
    for (const Instance& instance : scene.instances) {
        const Object& object = scene.objects[instance.object];
        add(object.first_triangle, object.first_triangle + object.triangle_count,
            [&](const Float3& p) { return transformed(instance.world_from_object, p); });
    }
    return box.numbers();
}

/// The integral of the distribution over all directions, by quadrature for cones [sr].
Double3 directions_of(const PointLight& light) {
    if (light.distribution >= PointDistribution::octahedral_image) return to_double(light.image_integral);
    if (light.distribution == PointDistribution::isotropic) {
        constexpr double kAll = 4 * std::numbers::pi;
        return {kAll, kAll, kAll};
    }
    const auto cosine = [](double degrees) { return std::cos(degrees * std::numbers::pi / 180); };
    double sum = 0;
    constexpr int kSteps = 20000;
    for (int i = 0; i < kSteps; ++i) {
        const double c = -1 + 2 * (i + 0.5) / kSteps;
        const double t = std::clamp((c - cosine(light.cone_angle)) /
                                        std::max(cosine(light.full_angle) - cosine(light.cone_angle), 1e-9),
                                    0.0, 1.0);
        sum += light.distribution == PointDistribution::smooth_cone ? t * t * (3 - 2 * t) : t * t * t * t;
    }
    const double all = 4 * std::numbers::pi * sum / kSteps;
    return {all, all, all};
}

/// The area of an ellipsoid or an ellipse, by quadrature over the unit sphere [m^2].
double area_by_quadrature(const RoundLight& light) {
    const Double3 u = to_double(light.u), v = to_double(light.v), w = to_double(light.w);
    if (light.model == RoundModel::ellipse) return std::numbers::pi * length(cross(u, v));
    constexpr int kSteps = 200;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        const double z = -1 + 2 * (i + 0.5) / kSteps;
        for (int k = 0; k < kSteps; ++k) {
            const double angle = 2 * std::numbers::pi * (k + 0.5) / kSteps;
            const double rho = std::sqrt(1 - z * z);
            sum += length((rho * std::cos(angle)) * cross(v, w) + (rho * std::sin(angle)) * cross(w, u) +
                          z * cross(u, v));
        }
    }
    return 4 * std::numbers::pi * sum / (kSteps * kSteps);
}

/// Emitted by all lights [W].
Numbers power(const Scene& scene) {
    Double3 sum;
    for (const PolygonLight& light : scene.lights.of<PolygonLight>()) {
        std::vector<Double3> vertices;
        for (const Float3& p : light.vertices) vertices.push_back(to_double(p));
        const double sides = light.two_sided ? 2 : 1;
        sum = sum +
              (sides * std::numbers::pi * 0.5 * length(area_vector(vertices))) * to_double(light.radiance);
    }
    for (const RoundLight& light : scene.lights.of<RoundLight>())
        sum = sum + ((light.two_sided ? 2 : 1) * std::numbers::pi * area_by_quadrature(light)) *
                        to_double(light.radiance);
    for (const LineLight& light : scene.lights.of<LineLight>()) {
        const double extent = length(to_double(light.end) - to_double(light.start));
        const double radius = light.radius;
        const double caps = light.model == TubeModel::solid ? 2 * std::numbers::pi * radius * radius : 0;
        const double around = light.model == TubeModel::strip ? 4 : 2 * std::numbers::pi;
        sum = sum + (std::numbers::pi * (around * radius * extent + caps)) * to_double(light.radiance);
    }
    for (const PointLight& light : scene.lights.of<PointLight>())
        sum = sum + per_channel_product(directions_of(light), to_double(light.intensity));
    for (const DistantLight& light : scene.lights.of<DistantLight>())
        sum = sum + (std::numbers::pi * scene.radius * scene.radius) * to_double(light.irradiance);
    return {sum.x, sum.y, sum.z};
}

/// Light sources are numbered by kind.
void add_light_sources(const Scene& scene, std::map<std::string, Numbers>& facts) {
    const auto add = [&](const std::string& key, std::initializer_list<Float3> vectors) {
        for (const Float3& v : vectors) append(facts[key], v);
    };
    std::size_t i = 0;
    for (const PointLight& light : scene.lights.of<PointLight>()) {
        const std::string number = " " + std::to_string(i++);
        add("position" + number, {light.position});
        add("intensity" + number, {light.intensity});
        add("axes" + number, {light.x_axis, light.y_axis, light.z_axis});
        add("directions" + number, {to_float(directions_of(light))});
        facts["distribution" + number] = {static_cast<double>(light.distribution)};
        facts["cone" + number] = {light.cone_angle, light.full_angle};
        facts["image" + number] = {static_cast<double>(light.texture), light.half_extent.x,
                                   light.half_extent.y};
    }
    i = 0;
    for (const DistantLight& light : scene.lights.of<DistantLight>())
        add("distant " + std::to_string(i++), {light.direction, light.irradiance});
    i = 0;
    for (const EnvironmentLight& light : scene.lights.of<EnvironmentLight>()) {
        facts["environment " + std::to_string(i)] = {light.radiance.x, light.radiance.y, light.radiance.z};
        for (const Float3& vertex : light.portal) append(facts["portal " + std::to_string(i)], vertex);
        ++i;
    }
}

std::string name_of(FilterKind kind) {
    switch (kind) {
    case FilterKind::box:
        return "box";
    case FilterKind::triangle:
        return "triangle";
    case FilterKind::gaussian:
        return "gaussian";
    case FilterKind::mitchell:
        return "mitchell";
    }
    return "";
}

std::string name_of(TextureWrap wrap) {
    switch (wrap) {
    case TextureWrap::repeat:
        return "repeat";
    case TextureWrap::clamp:
        return "clamp";
    case TextureWrap::black:
        return "black";
    }
    return "";
}

/// Textures are numbered; a texture of a material is its number, scale and offset.
void add_textures(const Scene& scene, std::map<std::string, Numbers>& facts) {
    for (const Material& material : scene.materials) {
        const auto add_use = [&](const std::string& kind, const TextureUse& use) {
            if (use.texture >= 0)
                facts[kind + " texture " + material.name] = {static_cast<double>(use.texture), use.scale.x,
                                                             use.scale.y, use.offset.x, use.offset.y};
        };
        add_use("diffuse", material.diffuse_texture);
        add_use("f0", material.f0_texture);
        add_use("roughness", material.roughness_texture);
        add_use("alpha", material.alpha_texture);
        add_use("bump", material.bump_texture);
        add_use("normal", material.normal_texture);
        facts["alpha " + material.name] = {material.alpha};
        facts["bump " + material.name] = {material.bump};
        facts["bump in texture coordinates " + material.name] = {
            material.bump_unit == BumpUnit::texture_coordinate ? 1.0 : 0.0};
    }
    for (std::size_t i = 0; i < scene.textures.size(); ++i) {
        const Texture& texture = scene.textures[i];
        const std::string filter = texture.filter == TextureFilter::nearest ? "nearest" : "bilinear";
        const Numbers size = {static_cast<double>(texture.width), static_cast<double>(texture.height)};
        facts["texture " + texture.name] = size;
        facts["texture " + std::to_string(i) + ' ' + name_of(texture.wrap) + ' ' + filter] = size;
        facts["texels " + std::to_string(i)] = Numbers(texture.texels.begin(), texture.texels.end());
    }
}

/// Everything that an expectation may name.
std::map<std::string, Numbers> facts(const Scene& scene) {
    const auto count = [](const auto& array) { return Numbers{static_cast<double>(array.size())}; };
    std::map<std::string, Numbers> result = {{"triangles", count(scene.triangles)},
                                             {"vertices", count(scene.positions)},
                                             {"objects", count(scene.objects)},
                                             {"instances", count(scene.instances)},
                                             {"materials", count(scene.materials)},
                                             {"textures", count(scene.textures)},
                                             {"emitters", count(scene.emitters)},
                                             {"polygon lights", count(scene.lights.of<PolygonLight>())},
                                             {"round lights", count(scene.lights.of<RoundLight>())},
                                             {"line lights", count(scene.lights.of<LineLight>())},
                                             {"point lights", count(scene.lights.of<PointLight>())},
                                             {"distant lights", count(scene.lights.of<DistantLight>())},
                                             {"bounds", bounds(scene)},
                                             {"power", power(scene)}};
    for (const Material& material : scene.materials) {
        append(result["diffuse " + material.name], material.diffuse);
        if (material.model == BrdfModel::lambert) continue;
        append(result["f0 " + material.name], material.f0);
        result["roughness " + material.name] = {material.roughness};
    }
    add_textures(scene, result);
    for (std::size_t i = 0; i < scene.lights.of<RoundLight>().size(); ++i) {
        const RoundLight& light = scene.lights.of<RoundLight>()[i];
        const std::string key = light.model == RoundModel::ellipse     ? "ellipse "
                                : light.model == RoundModel::ellipsoid ? "ellipsoid "
                                                                       : "hollow ";
        Numbers& numbers = result[key + std::to_string(i)];
        for (const Float3& p : {light.center, light.u, light.v, light.w}) append(numbers, p);
    }
    add_light_sources(scene, result);
    append(result["camera origin"], scene.camera.origin);
    append(result["camera origin right"], scene.camera.origin_right);
    append(result["camera origin down"], scene.camera.origin_down);
    append(result["camera corner"], scene.camera.corner);
    append(result["camera right"], scene.camera.right);
    append(result["camera down"], scene.camera.down);
    result["film"] = {static_cast<double>(scene.film.width), static_cast<double>(scene.film.height)};
    if (const auto& crop = scene.film.crop)
        result["crop"] = {static_cast<double>(crop->x_begin), static_cast<double>(crop->y_begin),
                          static_cast<double>(crop->x_end), static_cast<double>(crop->y_end)};
    const PixelFilter& filter = scene.film.filter;
    Numbers& shape = result["filter " + name_of(filter.kind)];
    shape = {filter.radius_x, filter.radius_y};
    if (filter.kind == FilterKind::gaussian) shape.push_back(filter.sigma);
    if (filter.kind == FilterKind::mitchell) shape.insert(shape.end(), {filter.b, filter.c});
    return result;
}

Numbers parse_numbers(const std::string& text) {
    std::istringstream stream(text);
    Numbers numbers;
    for (double number = 0; stream >> number;) numbers.push_back(number);
    return numbers;
}

void expect_numbers(const std::string& key, const Numbers& found, const std::string& expected_text) {
    const Numbers expected = parse_numbers(expected_text);
    ASSERT_EQ(found.size(), expected.size()) << key;
    double scale = 0;
    for (const double number : expected) scale = std::max(scale, std::fabs(number));
    for (std::size_t i = 0; i < found.size(); ++i)
        EXPECT_NEAR(found[i], expected[i], 1e-4 * scale) << key << ", number " << i;
}

/// Paths below the corpus are given relative to the folder of the scene.
std::string without_folder(std::string text, const std::filesystem::path& scene) {
    const std::string folder = scene.parent_path().string() + "/";
    for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder))
        text.erase(at, folder.size());
    return text;
}

class Corpus : public testing::TestWithParam<std::string> {};

TEST_P(Corpus, LoadsAsDocumented) {
    const std::filesystem::path path = kCorpus / GetParam();
    const Expectations expected = read_expectations(path);
    Scene scene;
    try {
        scene = load_scene(path);
    } catch (const std::runtime_error& error) {
        EXPECT_EQ(without_folder(error.what(), path), expected.error.value_or("no error"));
        return;
    }
    ASSERT_FALSE(expected.error) << "loads, in spite of: " << *expected.error;
    std::vector<std::string> warnings;
    for (const std::string& warning : scene.warnings) warnings.push_back(without_folder(warning, path));
    EXPECT_EQ(warnings, expected.warnings);
    ASSERT_FALSE(expected.facts.empty()) << "expects nothing";
    const std::map<std::string, Numbers> found = facts(scene);
    for (const auto& [key, value] : expected.facts) {
        const auto fact = found.find(key);
        if (fact == found.end())
            ADD_FAILURE() << "there is no " << key;
        else
            expect_numbers(key, fact->second, value);
    }
}

/// Scenes that others include end in .inc.
std::vector<std::string> corpus_files() {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kCorpus))
        if (entry.path().extension() == ".pbrt")
            files.push_back(entry.path().lexically_relative(kCorpus).string());
    std::sort(files.begin(), files.end());
    return files;
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
    std::string name = info.param.substr(0, info.param.rfind('.'));
    std::replace_if(
        name.begin(), name.end(), [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; },
        '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Files, Corpus, testing::ValuesIn(corpus_files()), test_name);

} // namespace
} // namespace nusselt::scene
