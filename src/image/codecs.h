#pragma once
/// The file formats behind read_image() and write_image(). Errors are std::exceptions that describe the
/// contents; io.cpp adds the path.

#include "image/image.h"
#include "image/layers.h"

#include <cstdint>
#include <fstream>
#include <string>

namespace nusselt::image {

/// Larger images are taken for damaged or hostile files: 2^28 pixels are 3 GiB of floats.
inline constexpr std::int64_t kMaxPixelCount = std::int64_t(1) << 28;

/// \throws std::runtime_error  unless the size is positive and at most kMaxPixelCount
void check_size(std::int64_t width, std::int64_t height);

/// \param name  of the file, for messages of OpenEXR
void encode_exr(std::ofstream& stream, const std::string& name, const Image& image, const Metadata& metadata);
Image decode_exr(std::ifstream& stream, const std::string& name);
LayeredImage decode_exr_layers(std::ifstream& stream, const std::string& name);
Metadata decode_exr_metadata(std::ifstream& stream, const std::string& name);

void encode_hdr(std::ostream& stream, const Image& image);
Image decode_hdr(std::istream& stream);

/// \param scale  factor before the transfer function
void encode_png(std::ostream& stream, const Image& image, double scale);
/// PNG, JPG or TGA, whichever the contents are.
Image decode_srgb(std::istream& stream);

} // namespace nusselt::image
