#include "scene/import/ies/luminaires.h"

#include "scene/import/ies/ies_profile.h"

#include <system_error>
#include <utility>

namespace nusselt::scene {

std::shared_ptr<const Luminaire> read_luminaire(const std::filesystem::path& path) {
    IntensityProfile profile = make_profile(read_ies(path));
    std::error_code error;
    const std::filesystem::path whole = std::filesystem::weakly_canonical(path, error);
    return std::make_shared<const Luminaire>(
        Luminaire{path.filename().string(), (error ? path : whole).string(), std::move(profile)});
}

std::shared_ptr<const Luminaire> Luminaires::read(const std::filesystem::path& path) {
    std::shared_ptr<const Luminaire>& luminaire = luminaires_[path];
    if (luminaire == nullptr) luminaire = read_luminaire(path);
    return luminaire;
}

} // namespace nusselt::scene
