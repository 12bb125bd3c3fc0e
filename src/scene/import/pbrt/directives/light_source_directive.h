#pragma once
/// LightSource directives.

#include "scene/build/lights/light_source.h"
#include "scene/import/ies/luminaires.h"
#include "scene/import/pbrt/textures.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace nusselt::scene {

struct LightSourceDirective {
    std::string type; ///< "point", "spot", ...
    ParameterList parameters;
    Transform world_from_light;
    PbrtVersion version = PbrtVersion::v4;
    std::function<std::filesystem::path(const std::string&)> resolve; ///< the path of a file that it names
};

bool is_supported_light_source(std::string_view type);

/// Reduces a LightSource directive of a supported type; docs/materials.md has the rules. Nothing, with a warning, if it does
/// not emit light. Throws SceneError at values out of range, and if the transform is singular.
std::optional<LightSourceDescription> read_light_source(LightSourceDirective& directive,
                                                        TexturePlanner& textures, Luminaires& luminaires,
                                                        Warnings& warnings);

} // namespace nusselt::scene
