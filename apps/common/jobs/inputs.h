#pragma once
/// What the results of a job depend on, as hashes.

#include "job.h"

#include <filesystem>
#include <string>

namespace nusselt::app {

/// A hash of the bytes of a file. \throws std::runtime_error if it cannot be read
std::string file_hash(const std::filesystem::path& path);

/// Adds a program, so that results of an older build are not taken for those of this one.
/// \param name as in program_path()
void add_program_input(Job& job, const std::string& name = "");

/// Adds all files among options, such as light rigs.
void add_file_inputs(Job& job, const Words& options);

} // namespace nusselt::app
