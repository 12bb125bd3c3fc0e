#pragma once

#include <filesystem>
#include <fstream>
#include <functional>

namespace nusselt::base {

/// Writes a file so that other programs, and whoever looks after a crash of the machine, see either the old contents or
/// the complete new ones: `write` fills a temporary file of a unique name in the same folder, which is stored on the disk
/// and then renamed. On failure, also an exception of `write` or a full disk, the temporary file is removed and an
/// existing file stays as it was.
/// \throws std::runtime_error  naming the path, if the folder is missing or not writable, the disk is full, or the path
///                             is a folder or a device; other exceptions of `write` pass through
void write_atomically(const std::filesystem::path& path, const std::function<void(std::ofstream&)>& write);

} // namespace nusselt::base
