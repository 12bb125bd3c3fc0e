#pragma once
/// Luminaires that scenes and light rigs name by their IES files.

#include "scene/model/profiles/luminaire.h"

#include <filesystem>
#include <map>
#include <memory>

namespace nusselt::scene {

/// Reads an IES file as a luminaire, which is black if no intensity reaches kDarkest. Throws as read_ies() does.
std::shared_ptr<const Luminaire> read_luminaire(const std::filesystem::path& path);

/// The luminaires of one scene. Each file is read once.
class Luminaires {
public:
    /// \copydoc read_luminaire
    std::shared_ptr<const Luminaire> read(const std::filesystem::path& path);

private:
    std::map<std::filesystem::path, std::shared_ptr<const Luminaire>> luminaires_;
};

} // namespace nusselt::scene
