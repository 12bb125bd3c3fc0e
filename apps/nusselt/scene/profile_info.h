#pragma once
/// `nusselt info FILE.ies`: what a photometric file contains, and what a light can show of it.

#include <filesystem>

namespace nusselt::app {

/// Prints format, photometry, flux, angles, opening and the light that they make to standard output.
/// \returns 0
int run_profile_info(const std::filesystem::path& file);

} // namespace nusselt::app
