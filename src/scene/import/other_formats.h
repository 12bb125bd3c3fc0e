#pragma once
/// Scene formats that nobody has written an importer for, so that messages can name them.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace nusselt::scene {

/// The extension of a file with the dot, without ".gz" where it is compressed.
std::string extension_of(const std::filesystem::path& path);

/// What a file is and what to do with it: "is a glTF file, which ...", or nothing if it is none of these formats.
/// \param path     for its extension and for the command to type
/// \param contents of the file, decompressed
std::optional<std::string> describe_other_format(const std::filesystem::path& path,
                                                 std::string_view contents);

} // namespace nusselt::scene
