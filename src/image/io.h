#pragma once
/// Images in files. Every function here throws std::runtime_error for what the user can repair (missing file,
/// unwritable folder, broken or foreign contents); the message names the path and what to do.

#include "image/image.h"

#include <filesystem>
#include <string>

namespace nusselt::image {

/// The extension in lower case with the dot: ".exr" for "Image.EXR".
[[nodiscard]] std::string lower_case_extension(const std::filesystem::path& path);

/// Whether the extension is that of EXR files.
[[nodiscard]] bool is_exr(const std::filesystem::path& path);

/// Whether the extension is that of PNG files.
[[nodiscard]] bool is_png(const std::filesystem::path& path);

/// Whether images with this extension hold values above 1: those of `.exr`, `.hdr` and `.pfm`.
[[nodiscard]] bool is_high_dynamic_range(const std::filesystem::path& path);

/// Writes an image in the format that the extension names (upper or lower case):
/// - `.exr`: three 32-bit float channels, bit exact; the metadata become string attributes `nusselt:<key>`.
/// - `.png`: 8 bits with the sRGB transfer function; values are multiplied by 2^exposure and clamped to [0, 1]. NaN
///   becomes 0.
/// - `.hdr`: Radiance RGBE, rounded to 8 bits relative to the largest channel of the pixel. Negative values and NaN
///   become 0, values above 2^127 become the largest that the format holds.
/// - `.pfm`: three 32-bit floats, little endian, bit exact.
///
/// The file appears under its name only when it is complete, see base::write_atomically().
/// \param metadata  stored by EXR only; keys of 1 to 200 bytes
/// \param exposure  in stops, used by PNG only
/// \throws std::invalid_argument  if the image is empty or its size does not fit its number of floats, or if a key is too
///                                short or too long
void write_image(const std::filesystem::path& path, const Image& image, const Metadata& metadata = {},
                 double exposure = 0);

/// base::check_writable(), and whether write_image() knows the extension. \throws std::runtime_error
void check_writable_image(const std::filesystem::path& path);

/// Reads `.exr` (channels R, G, B or Y alone, in half, float or integers; the data window of the first part), `.hdr`
/// (Radiance), `.pfm` (colour or grey, in both orders of bytes), `.png`, `.jpg`, `.jpeg` and `.tga` (8 or 16 bits, taken
/// as sRGB and made linear). Other channels, alpha among them, are ignored. Images above 2^28 pixels are refused.
[[nodiscard]] Image read_image(const std::filesystem::path& path);

/// The `nusselt:` attributes of an EXR file, without that prefix. Empty for files of other programs.
[[nodiscard]] Metadata read_exr_metadata(const std::filesystem::path& path);

} // namespace nusselt::image
