#pragma once
/// LightSource directives.

#include "scene/build/lights/light_source.h"
#include "scene/import/ies/luminaires.h"
#include "scene/import/pbrt/textures.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace nusselt::scene {

struct LightSourceDirective {
    std::string type; ///< "point", "spot", ...
    ParameterList parameters;
    Transform world_from_light;
    PbrtVersion version = PbrtVersion::v4;
    std::filesystem::path image_path; ///< of the file that image_parameter() names; unused if there is none
    std::filesystem::path ies_path;   ///< of the file that the parameter "ies" names; unused if there is none
};

bool is_supported_light_source(std::string_view type);

/// The parameter that names the image of a light.
std::string_view image_parameter(PbrtVersion version);

/// Reduces a LightSource directive of a supported type; docs/materials.md has the rules. Nothing, with a warning, if it does
/// not emit light. Throws SceneError at values out of range, and if the transform is singular.
std::optional<LightSourceDescription> read_light_source(LightSourceDirective& directive,
                                                        TexturePlanner& textures, Luminaires& luminaires,
                                                        Warnings& warnings);

} // namespace nusselt::scene
