#pragma once

#include <filesystem>
#include <fstream>
#include <functional>

namespace nusselt::base {

/// Writes a file so that other programs, and whoever looks after a crash of the machine, see either the old contents or
/// the complete new ones: `write` fills a temporary file of a unique name in the same folder, which is stored on the disk
/// and then renamed. An existing file keeps its permissions (and its owner may read it). Symbolic links stay: the file to
/// which they lead is written. On failure, also an exception of `write` or a full disk, the temporary file is removed and
/// an existing file stays as it was.
/// \param name of the file, with an existing folder
/// \throws std::runtime_error  naming the path, if the folder is missing or not writable, the disk is full, or the path
///                             is a folder or a device; other exceptions of `write` pass through
void write_atomically(const std::filesystem::path& name, const std::function<void(std::ofstream&)>& write);

/// Checks before a long computation that write_atomically() can create this file. An existing file stays as it is.
/// \throws std::runtime_error see there
void check_writable(const std::filesystem::path& path);

} // namespace nusselt::base
