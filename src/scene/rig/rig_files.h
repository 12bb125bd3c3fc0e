#pragma once
/// The files that rigs give to lights: profiles, images and maps. Each is read once.

#include "scene/build/limits.h"
#include "scene/build/textures/emission_images.h"
#include "scene/import/ies/luminaires.h"
#include "scene/model/scene.h"

#include <filesystem>
#include <map>
#include <memory>

namespace nusselt::scene {

/// All functions throw std::runtime_error with the file and the reason if it cannot be used.
class RigFiles {
public:
    RigFiles();
    RigFiles(const RigFiles&) = delete;
    RigFiles& operator=(const RigFiles&) = delete;
    ~RigFiles();

    std::shared_ptr<const Luminaire> profile(const std::filesystem::path& path);
    std::shared_ptr<const EmissionTexture> image(const std::filesystem::path& path);
    /// Square maps are octahedral, those twice as wide as high in latitudes and longitudes; others are refused.
    std::shared_ptr<const EnvironmentMapTexels> map(const std::filesystem::path& path);

private:
    SceneBudget budget_;
    Luminaires luminaires_;
    EmissionImages images_;
    std::map<std::filesystem::path, std::shared_ptr<const EnvironmentMapTexels>> maps_;
};

} // namespace nusselt::scene
