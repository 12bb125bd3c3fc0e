#include "scene/import/ies/luminaires.h"

#include "scene/import/ies/ies_profile.h"
#include "scene/model/limits.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace nusselt::scene {

std::shared_ptr<const Luminaire> read_luminaire(const std::filesystem::path& path) {
    IesFile file = read_ies(path);
    // A profile this dark has no shape that single precision could hold.
    if (*std::max_element(file.candelas.begin(), file.candelas.end()) < kDarkest)
        std::fill(file.candelas.begin(), file.candelas.end(), 0.0);
    IntensityProfile profile = make_profile(file);
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
