#pragma once
/// Lights as shaders read them.

#include "interface/lights.h"
#include "scene/model/scene.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

namespace nusselt::render_vulkan {

/// The words of a buffer of lights.
struct LightArray {
    const char* what = "lights"; ///< for messages
    std::vector<std::uint32_t> words = std::vector<std::uint32_t>(1);
};

/// The array with these values, and with zeros in place of one value if there are none.
template <class T>
LightArray make_light_array(const char* what, const std::vector<T>& values) {
    static_assert(sizeof(T) % sizeof(std::uint32_t) == 0);
    constexpr std::size_t kWords = sizeof(T) / sizeof(std::uint32_t);
    LightArray array{what, std::vector<std::uint32_t>(kWords * std::max<std::size_t>(values.size(), 1))};
    if (!values.empty()) std::memcpy(array.words.data(), values.data(), sizeof(T) * values.size());
    return array;
}

/// The lights of a scene.
struct LightRecords {
    std::array<interface::LightRange, interface::kLightKinds> ranges = {}; ///< by kind
    /// The element `i` belongs to the binding interface::kFirstLightBinding + i.
    std::array<LightArray, interface::kFirstBindingAfterLights - interface::kFirstLightBinding> arrays;
    /// The element `i` belongs to the specialisation constant interface::kFirstLightConstant + i.
    std::array<bool, interface::kConstantCount - interface::kFirstLightConstant> has_shape = {};
    int polygon_slots = 4; ///< vertices that each polygonal light has room for, 4 or 8

    LightArray& array_at(int binding) {
        return arrays.at(static_cast<std::size_t>(binding - interface::kFirstLightBinding));
    }
    bool& has_shape_of(int constant) {
        return has_shape.at(static_cast<std::size_t>(constant - interface::kFirstLightConstant));
    }
};

// The specialisation constant of the shape that a light is.
int constant_of(const scene::PolygonLight& light);
int constant_of(const scene::LineLight& light);
int constant_of(const scene::EnvironmentLight& light);
int constant_of(const scene::PointLight& light);
int constant_of(const scene::RoundLight& light);

/// The reason for which shaders cannot have all of the lights; nothing if they can.
std::optional<std::string> why_unsupported(const scene::Lights& lights);

/// The round lights of a scene as rays meet them and as shading points see them, in their order.
std::vector<interface::RoundLightRecord> make_round_records(const scene::Scene& scene);

/// \throws std::runtime_error if the scene has more lights than 32-bit numbers reach, or lights that shaders cannot have
LightRecords make_light_records(const scene::Scene& scene);

// The rows of the table of kinds. Each writes the arrays and shapes of lights of its kind.
void write_polygons(const scene::Scene& scene, const scene::LightList& list, LightRecords& records);
void write_lines(const scene::Scene& scene, const scene::LightList& list, LightRecords& records);
void write_points(const scene::Scene& scene, const scene::LightList& list, LightRecords& records);
void write_distants(const scene::Scene& scene, const scene::LightList& list, LightRecords& records);
void write_environments(const scene::Scene& scene, const scene::LightList& list, LightRecords& records);
void write_rounds(const scene::Scene& scene, const scene::LightList& list, LightRecords& records);

} // namespace nusselt::render_vulkan
