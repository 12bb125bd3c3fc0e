#pragma once
/// What all kinds of experiments are told.

#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>

namespace nusselt::lab {

enum class Effort {
    quick, ///< small images and few samples: the order of techniques shows, published numbers do not
    full,  ///< as the experiment defines
};

struct RunSettings {
    std::filesystem::path scenes; ///< folder with the shipped scenes
    Effort effort = Effort::full;
    int threads = 0; ///< 0: all cores
};

/// The number of threads in the settings, or one per hardware thread.
int thread_count(const RunSettings& settings);

/// The folder with published scenes that NUSSELT_SCENES names; none if the variable is unset or empty.
std::optional<std::filesystem::path> published_scenes();

/// Called with a line about each step before it is taken.
using ProgressText = std::function<void(std::string_view)>;

} // namespace nusselt::lab
