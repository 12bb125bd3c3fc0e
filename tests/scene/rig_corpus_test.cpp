/// Applies each rig of tests/scene/rigs to lamps.pbrt beside it, or to the "scene" of its section, and compares with expectations.txt.

#include "common/source_folder.h"
#include "scene/import/importers.h"
#include "scene/rig/light_edit.h"
#include "scene/rig/light_image.h"
#include "scene/rig/light_profile.h"
#include "scene/rig/rig.h"
#include "scene/rig/rig_json.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace nusselt::scene {
namespace {

const std::filesystem::path kRigs = std::filesystem::path(nusselt_test::kSourceFolder) / "tests/scene/rigs";

using Facts = std::vector<std::pair<std::string, std::string>>;

/// The lines "KEY: VALUE" of each section "[FILE]".
std::map<std::string, Facts> read_expectations() {
    std::map<std::string, Facts> result;
    std::ifstream file(kRigs / "expectations.txt");
    std::string section;
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line[0] == '#') continue;
        const std::size_t colon = line.find(": ");
        if (line[0] == '[')
            section = line.substr(1, line.size() - 2);
        else if (colon != std::string::npos)
            result[section].emplace_back(line.substr(0, colon), line.substr(colon + 2));
        else
            throw std::runtime_error("expectations.txt: no colon in: " + line);
    }
    return result;
}

const std::map<std::string, Facts> kExpectations = read_expectations();

template <class... Numbers>
std::string text(const Numbers&... numbers) {
    std::ostringstream stream;
    stream.precision(9);
    ((stream << numbers << ' '), ...);
    return stream.str();
}

std::string text(const Float3& v) { return text(v.x, v.y, v.z); }

/// The bounds of the triangles for which `is_counted` holds.
template <class Predicate>
std::string bounds(const Scene& scene, const Predicate& is_counted) {
    Float3 low = {1e30f, 1e30f, 1e30f};
    Float3 high = {-1e30f, -1e30f, -1e30f};
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        if (!is_counted(i)) continue;
        for (const std::uint32_t vertex : scene.triangles[i].vertex) {
            const Float3& p = scene.positions[vertex];
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
    }
    return text(low) + text(high);
}

void add_light_facts(const Scene& scene, std::map<std::string, std::string>& facts) {
    const std::vector<EditableLight> lights = editable_lights(scene);
    const std::vector<std::uint32_t> emitters = light_emitters(scene);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const std::string of_light = " of light " + std::to_string(i);
        facts["name " + std::to_string(i)] = lights[i].name;
        facts["power" + of_light] = text(luminous_power(lights[i], scene.radius));
        const LightProfile profile = profile_of(scene, lights[i]);
        facts["profile" + of_light] = (profile.luminaire != nullptr ? profile.luminaire->name : "-") + " " +
                                      text(profile.spread, profile.honeycomb.along, profile.honeycomb.across);
        facts["image" + of_light] =
            std::filesystem::path(image_path(scene, lights[i]) + map_path(scene, lights[i]))
                .filename()
                .string();
        if (lights[i].triangles.empty()) continue;
        facts["material" + of_light] = text(lights[i].material);
        facts["bounds" + of_light] = bounds(scene, [&](std::size_t triangle) {
            const std::int32_t number = scene.triangle_light[triangle];
            return number >= 0 && emitters[static_cast<std::size_t>(number)] == i;
        });
    }
    for (std::size_t i = 0; i < scene.lights.of<PolygonLight>().size(); ++i) {
        const PolygonLight& light = scene.lights.of<PolygonLight>()[i];
        const std::string index = std::to_string(i);
        for (const Float3& p : light.vertices) facts["polygon " + index] += text(p);
        const Double3 p0 = to_double(light.vertices[0]);
        facts["normal " + index] = text(to_float(
            normalized(cross(to_double(light.vertices[1]) - p0, to_double(light.vertices[2]) - p0))));
        facts["polygon radiance " + index] = text(light.radiance);
        facts["sides " + index] = light.two_sided ? "2" : "1";
    }
    for (std::size_t i = 0; i < scene.lights.of<RoundLight>().size(); ++i) {
        const RoundLight& light = scene.lights.of<RoundLight>()[i];
        const std::string index = std::to_string(i);
        facts["round " + index] = text(light.center) + text(light.u) + text(light.v) + text(light.w);
        facts["round radiance " + index] = text(light.radiance);
        facts["round model " + index] = text(static_cast<int>(light.model));
        facts["round normal " + index] =
            text(to_float(normalized(cross(to_double(light.u), to_double(light.v)))));
    }
    for (std::size_t i = 0; i < scene.lights.of<LineLight>().size(); ++i) {
        const LineLight& light = scene.lights.of<LineLight>()[i];
        const std::string index = std::to_string(i);
        facts["tube " + index] = text(light.start) + text(light.end) + text(light.radius);
        facts["tube radiance " + index] = text(light.radiance);
        facts["solid " + index] = light.model == TubeModel::solid ? "1" : "0";
        facts["open " + index] = light.model == TubeModel::open ? "1" : "0";
        facts["strip " + index] = light.model == TubeModel::strip ? text(light.normal) : "0";
    }
    for (std::size_t i = 0; i < scene.lights.of<PointLight>().size(); ++i) {
        const PointLight& light = scene.lights.of<PointLight>()[i];
        const std::string index = std::to_string(i);
        facts["point " + index] = text(light.position) + text(light.intensity);
        facts["axis " + index] = text(light.z_axis);
        facts["cone " + index] = text(light.cone_angle) + text(light.full_angle);
        facts["distribution " + index] = text(static_cast<int>(light.distribution));
    }
    for (std::size_t i = 0; i < scene.lights.of<EnvironmentLight>().size(); ++i) {
        const EnvironmentLight& light = scene.lights.of<EnvironmentLight>()[i];
        const std::string index = std::to_string(i);
        facts["environment " + index] = text(light.radiance);
        facts["axes " + index] = text(light.x_axis) + text(light.y_axis) + text(light.z_axis);
        for (const Float3& p : light.portal) facts["portal " + index] += text(p);
    }
    for (std::size_t i = 0; i < scene.lights.of<DistantLight>().size(); ++i) {
        const DistantLight& light = scene.lights.of<DistantLight>()[i];
        facts["distant " + std::to_string(i)] = text(light.direction) + text(light.irradiance);
    }
}

/// Everything that an expectation may name.
std::map<std::string, std::string> facts(const Scene& scene) {
    const auto emits = [&](std::size_t triangle) { return scene.triangle_light[triangle] >= 0; };
    std::size_t emitting = 0;
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) emitting += emits(i) ? 1 : 0;
    std::map<std::string, std::string> result = {
        {"emitters", text(scene.emitters.size())},
        {"polygon lights", text(scene.lights.of<PolygonLight>().size())},
        {"round lights", text(scene.lights.of<RoundLight>().size())},
        {"line lights", text(scene.lights.of<LineLight>().size())},
        {"point lights", text(scene.lights.of<PointLight>().size())},
        {"distant lights", text(scene.lights.of<DistantLight>().size())},
        {"triangles", text(scene.triangles.size())},
        {"emitting triangles", text(emitting)},
        {"vertices", text(scene.positions.size())},
        {"materials", text(scene.materials.size())},
        {"bounds", bounds(scene, [](std::size_t) { return true; })}};
    for (const Material& material : scene.materials) {
        result["diffuse " + material.name] = text(material.diffuse);
        result["f0 " + material.name] = text(material.f0);
        result["roughness " + material.name] = text(material.roughness);
        result["lambert " + material.name] = material.model == BrdfModel::lambert ? "1" : "0";
        result["phong " + material.name] = material.model == BrdfModel::phong ? "1" : "0";
        result["exponent " + material.name] = text(material.exponent);
    }
    add_light_facts(scene, result);
    return result;
}

std::vector<double> parse_numbers(const std::string& text) {
    std::istringstream stream(text);
    std::vector<double> numbers;
    for (double number = 0; stream >> number;) numbers.push_back(number);
    return numbers;
}

/// Numbers agree up to the rounding of floats, names exactly.
void expect_fact(const std::string& key, const std::string& found, const std::string& expected) {
    if (key.rfind("name ", 0) == 0 || key.rfind("image ", 0) == 0) {
        EXPECT_EQ(found, expected) << key;
        return;
    }
    if (key.rfind("profile ", 0) == 0) {
        EXPECT_EQ(found, expected + " ") << key;
        return;
    }
    const std::vector<double> a = parse_numbers(found);
    const std::vector<double> b = parse_numbers(expected);
    ASSERT_EQ(a.size(), b.size()) << key << ": " << found;
    double scale = 0;
    for (const double number : b) scale = std::max(scale, std::fabs(number));
    for (std::size_t i = 0; i < a.size(); ++i)
        EXPECT_NEAR(a[i], b[i], 1e-6 * scale) << key << ", number " << i << " of " << found;
}

/// Paths are given relative to the folder; % stands for the rig.
std::string short_message(std::string text, const std::string& rig) {
    const std::string folder = kRigs.string() + "/";
    for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder))
        text.erase(at, folder.size());
    return text.rfind(rig, 0) == 0 ? "%" + text.substr(rig.size()) : text;
}

class RigCorpus : public testing::TestWithParam<std::string> {};

TEST_P(RigCorpus, DoesWhatIsExpected) {
    const std::string& name = GetParam();
    ASSERT_TRUE(std::filesystem::exists(kRigs / name));
    ASSERT_EQ(kExpectations.count(name), 1u) << "expectations.txt has no section for it";
    const Facts& expected = kExpectations.at(name);
    ASSERT_FALSE(expected.empty());
    const bool has_scene = expected[0].first == "scene";
    const std::size_t first = has_scene && expected.size() > 1 ? 1 : 0;
    const bool must_fail = expected[first].first == "error";
    Scene scene = load_scene(kRigs / (has_scene ? expected[0].second : "lamps.pbrt"));
    const std::size_t warnings_before = scene.warnings.size();
    try {
        apply_rig(read_rig(kRigs / name), scene);
    } catch (const std::runtime_error& error) {
        EXPECT_EQ(short_message(error.what(), name), must_fail ? expected[first].second : "no error");
        return;
    }
    ASSERT_FALSE(must_fail) << "is applied, in spite of: " << expected[first].second;
    std::vector<std::string> warnings;
    for (std::size_t i = warnings_before; i < scene.warnings.size(); ++i)
        warnings.push_back(short_message(scene.warnings[i], name));
    std::vector<std::string> expected_warnings;
    const std::map<std::string, std::string> found = facts(scene);
    for (const auto& [key, value] : expected) {
        if (key == "scene") continue;
        if (key == "warning") {
            expected_warnings.push_back(value);
            continue;
        }
        const auto fact = found.find(key);
        if (fact == found.end())
            ADD_FAILURE() << "there is no " << key;
        else
            expect_fact(key, fact->second, value);
    }
    EXPECT_EQ(warnings, expected_warnings);
}

/// All files and all sections.
std::vector<std::string> rigs() {
    std::vector<std::string> names;
    for (const auto& [name, facts] : kExpectations) names.push_back(name);
    for (const auto& entry : std::filesystem::directory_iterator(kRigs))
        if (entry.path().extension() == ".json") names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
    std::string name = info.param.substr(0, info.param.rfind('.'));
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Files, RigCorpus, testing::ValuesIn(rigs()), test_name);

} // namespace
} // namespace nusselt::scene
