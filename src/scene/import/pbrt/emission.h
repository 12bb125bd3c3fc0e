#pragma once
/// AreaLightSource directives.

#include "scene/build/texture_image.h"
#include "scene/import/pbrt/syntax/parameters.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace nusselt::scene {

struct Emission {
    Float3 radiance = {0, 0, 0}; ///< to be scaled to `power`, if there is one
    bool two_sided = false;
    /// What each shape would emit in all if the luminance of `radiance` were one [W].
    std::optional<double> power;
};

inline bool is_black(const Float3& c) { return c.x == 0 && c.y == 0 && c.z == 0; }

/// Mean colours of images that lights emit, each decoded once.
class EmissionImages {
public:
    /// Throws SceneError at the location of the request if the image cannot be read.
    Float3 mean_colour(const ImageRequest& request, SceneBudget& budget, Warnings& warnings);

private:
    std::map<std::filesystem::path, Float3> mean_colours_;
};

/// Reduces an AreaLightSource directive; docs/materials.md has the rules. Unknown types do not emit, with a warning.
/// \param image_path  of the file that the parameter "filename" names; unused if there is none
/// Throws SceneError at values that are negative or not finite, and if the image cannot be read.
Emission read_emission(const std::string& type, ParameterList& parameters,
                       const std::filesystem::path& image_path, EmissionImages& images, Warnings& warnings);

/// The radiance of a shape of this area [m^2], counted once where it emits to both sides. Throws SceneError at
/// `location` if it is not finite in single precision.
Float3 radiance_of(const Emission& emission, double area, const Location& location);

} // namespace nusselt::scene
